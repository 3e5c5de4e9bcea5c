// SPDX-License-Identifier: Apache-2.0
#include "fill/matching.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "base/job.h"
#include "base/polled_sort.h"
#include "fill/near_points.h"

namespace msq {

namespace {

constexpr uint32_t nobody = UINT32_MAX;
/// Points that a chain may go on to, nearest ones, at each of its steps.
constexpr std::array<size_t, 6> choices = {6, 4, 2, 1, 1, 1};
constexpr size_t near_count = 8;
/// Chains begun per point, on average, at most.
constexpr uint64_t max_chains = 32;

class Matching {
 public:
  explicit Matching(const CountedVector<Vec2>& points)
      : points_(points), mates_(points.size(), nobody) {}

  CountedVector<uint32_t> find() {
    pair_nearest();
    exchange();
    return std::move(mates_);
  }

 private:
  struct Pair {
    double distance;
    uint32_t a, b;

    friend bool operator<(const Pair& p, const Pair& q) {
      if (p.distance != q.distance) return p.distance < q.distance;
      return p.a != q.a ? p.a < q.a : p.b < q.b;
    }
  };

  double distance(uint32_t a, uint32_t b) const { return length(points_[a] - points_[b]); }
  void pair_nearest();
  void pair_some(const CountedVector<uint32_t>& free);
  void exchange();
  /// Looks for a shorter matching without the pair of the chain's first point.
  bool extend(double gain, size_t step);
  bool is_in_chain(uint32_t point) const {
    return std::find(chain_.begin(), chain_.end(), point) != chain_.end();
  }

  const CountedVector<Vec2>& points_;
  CountedVector<uint32_t> mates_;
  CountedVector<uint32_t> near_;  // near_count of each point, or nobody
  // Partners are pairs 0 and 1, 2 and 3 ..; of the new matching 1 and 2, 3 and 4 .., last and 0.
  CountedVector<uint32_t> chain_;
};

void Matching::pair_nearest() {
  near_.assign(points_.size() * near_count, nobody);
  CountedVector<uint32_t> free(points_.size());
  for (uint32_t i = 0; i < free.size(); ++i) free[i] = i;
  // The two that are nearest of all become a pair each time, and most others do.
  while (!free.empty()) {
    pair_some(free);
    std::erase_if(free, [this](uint32_t i) { return mates_[i] != nobody; });
  }
}

void Matching::pair_some(const CountedVector<uint32_t>& free) {
  CountedVector<Vec2> places;
  places.reserve(free.size());
  for (const uint32_t i : free) places.push_back(points_[i]);
  NearPoints grid(places);
  CountedVector<Pair> pairs;
  CountedVector<uint32_t> found;
  CancelPoll poll(current_job());
  const bool is_first = free.size() == points_.size();
  for (uint32_t i = 0; i < free.size(); ++i) {
    poll();
    grid.find(places[i], near_count + 1, found);
    size_t count = 0;
    for (const uint32_t j : found) {
      if (j == i || count == near_count) continue;
      if (is_first) near_[i * near_count + count] = j;
      ++count;
      const auto [a, b] = std::minmax(free[i], free[j]);
      pairs.push_back({distance(a, b), a, b});
    }
  }
  polled_sort(pairs.begin(), pairs.end(), std::less<>(), poll);
  for (const Pair& pair : pairs)
    if (mates_[pair.a] == nobody && mates_[pair.b] == nobody) {
      mates_[pair.a] = pair.b;
      mates_[pair.b] = pair.a;
    }
}

void Matching::exchange() {
  CountedVector<uint32_t> waiting(points_.size());
  CountedVector<bool> waits(points_.size(), true);
  for (uint32_t i = 0; i < waiting.size(); ++i) waiting[i] = i;
  CancelPoll poll(current_job());
  const uint64_t most = max_chains * points_.size();
  for (size_t next = 0; next < waiting.size() && next < most; ++next) {
    poll();
    const uint32_t point = waiting[next];
    waits[point] = false;
    chain_ = {mates_[point], point};
    if (!extend(distance(point, mates_[point]), 0)) continue;
    for (size_t i = 1; i < chain_.size(); i += 2) {
      const uint32_t a = chain_[i], b = chain_[i + 1 < chain_.size() ? i + 1 : 0];
      mates_[a] = b;
      mates_[b] = a;
    }
    for (const uint32_t changed : chain_)
      if (!waits[changed]) {
        waits[changed] = true;
        waiting.push_back(changed);
      }
  }
}

bool Matching::extend(double gain, size_t step) {
  const uint32_t from = chain_.back(), first = chain_.front();
  size_t tried = 0;
  for (size_t n = 0; n < near_count && tried < choices[step]; ++n) {
    const uint32_t to = near_[from * near_count + n];
    if (to == nobody) return false;
    const double left = gain - distance(from, to);
    if (!(left > 0)) return false;
    if (is_in_chain(to)) continue;
    ++tried;
    const uint32_t last = mates_[to];
    const double next = left + distance(to, last);
    chain_.push_back(to);
    chain_.push_back(last);
    // A part of the gain may be rounding.
    if (next - distance(last, first) > 1e-9 * next) return true;
    if (step + 1 < choices.size() && extend(next, step + 1)) return true;
    chain_.resize(chain_.size() - 2);
  }
  return false;
}

}  // namespace

CountedVector<uint32_t> match(const CountedVector<Vec2>& points) {
  return Matching(points).find();
}

}  // namespace msq
