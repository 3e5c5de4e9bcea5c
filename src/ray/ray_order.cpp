// SPDX-License-Identifier: Apache-2.0
#include "ray/ray_order.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/borrowed.h"
#include "base/infinity.h"

namespace msq {

namespace {

/// The length of the direction, in cells: most rays end before.
constexpr double far_in_cells = 8;
constexpr unsigned key_bits = 64 - RayOrder::max_bits;
constexpr uint64_t no_key = (uint64_t{1} << key_bits) - 1;  // of rays that miss the box

constexpr size_t at_once = 1024;
/// Rays whose keys are made, and keys that are sorted, by one thread at a time.
constexpr uint64_t block = uint64_t{1} << 14;
constexpr unsigned bucket_bits = 10;
constexpr size_t buckets = size_t{1} << bucket_bits;
constexpr size_t bucket_of(uint64_t key) {
  return key >> (64 - bucket_bits);
}

/// The rays whose keys are made at once.
struct KeyBatch {
  std::array<uint64_t, at_once> numbers;
  std::array<RaySearch, at_once> searches;
};

/// Rays examined in advance: runs of consecutive rays.
constexpr uint64_t run_length = 16, max_runs = 64;

}  // namespace

bool RayOrder::place(const RaySearch& search, Place& place) const {
  double from = search.from, to = search.to;
  if (!clip_to_box(search.ray, bounds_, from, to)) return false;
  // Rounding may move rays from far away.
  const Vec3 p = max(bounds_.min, min(bounds_.max, search.ray.at(from)));
  const Vec3 d = search.ray.direction * (far_in_cells * cell_size_);
  place = {p.x, p.y, p.z, d.x, d.y, d.z};
  return true;
}

/// Also measures the range of the rays' places.
bool RayOrder::looks_ordered(uint64_t first, uint64_t count, const FillRays& fill) {
  Place low, high;
  low.fill(infinity);
  high.fill(-infinity);
  const uint64_t runs = std::min(count / run_length, max_runs);
  uint64_t together = 0;
  for (uint64_t r = 0; r < runs; ++r) {
    uint64_t numbers[run_length];
    RaySearch searches[run_length];
    const uint64_t begin = first + (count - run_length) / std::max<uint64_t>(1, runs - 1) * r;
    for (uint64_t i = 0; i < run_length; ++i) numbers[i] = begin + i;
    fill(numbers, searches);
    Place of_first{}, p;
    bool is_near = true, is_any = false;
    for (const RaySearch& search : searches) {
      if (!place(search, p)) continue;
      if (!is_any) of_first = p;
      is_any = true;
      for (size_t axis = 0; axis < axes; ++axis) {
        is_near = is_near && std::abs(p[axis] - of_first[axis]) <= cell_size_;
        low[axis] = std::min(low[axis], p[axis]);
        high[axis] = std::max(high[axis], p[axis]);
      }
    }
    together += is_near;
  }
  spread_bits(low, high);
  return 4 * together >= 3 * runs;
}

/// A coordinate with a shorter range has fewer bits: steps are equally long along all axes.
void RayOrder::spread_bits(const Place& low, const Place& high) {
  double range = std::numeric_limits<double>::min();
  for (size_t axis = 0; axis < axes; ++axis) range = std::max(range, high[axis] - low[axis]);
  std::array<unsigned, axes> bits{};
  unsigned max_axis_bits = 16;
  for (;; --max_axis_bits) {
    per_step_ = std::ldexp(1 / range, static_cast<int>(max_axis_bits));
    unsigned sum = 0;
    for (size_t axis = 0; axis < axes; ++axis) {
      const double steps = (high[axis] - low[axis]) * per_step_;
      bits[axis] = steps > 1 ? static_cast<unsigned>(std::ceil(std::log2(steps))) : 0;
      sum += bits[axis];
    }
    if (sum <= key_bits) break;
  }
  low_ = low;
  spread_ = {};
  unsigned to = 0;
  for (unsigned level = 0; level < max_axis_bits; ++level)
    for (size_t axis = 0; axis < axes; ++axis) {
      if (level >= bits[axis]) continue;
      for (size_t n = 0; n < 256; ++n)
        spread_[axis][level / 8][n] |= uint64_t{n >> level % 8 & 1} << to;
      ++to;
    }
  for (size_t axis = 0; axis < axes; ++axis)
    top_[axis] = static_cast<double>((uint64_t{1} << bits[axis]) - 1);
}

uint64_t RayOrder::key_of(const Place& place) const {
  uint64_t key = 0;
  for (size_t axis = 0; axis < axes; ++axis) {
    const double steps = (place[axis] - low_[axis]) * per_step_;
    const auto step = static_cast<uint32_t>(std::clamp(steps, 0.0, top_[axis]));
    key |= spread_[axis][0][step & 255] | spread_[axis][1][step >> 8];
  }
  return key;
}

bool RayOrder::sort(const Executor& executor, uint64_t first, uint64_t count, const FillRays& fill,
                    const Job* job) {
  if (count < run_length || looks_ordered(first, count, fill)) return false;
  first_ = first;
  keys_.resize(count);
  by_block_.resize(count);
  const uint64_t blocks = (count + block - 1) / block;
  std::vector<std::array<uint64_t, buckets>> places(blocks);  // counts first, of keys by bucket
  executor.for_each(blocks, [&](uint64_t b) {
    check_cancelled(job);
    std::array<uint64_t, buckets>& counts = places[b];
    counts.fill(0);
    const Borrowed<KeyBatch> batch;
    auto& [numbers, searches] = *batch;
    const uint64_t end = std::min(count, (b + 1) * block);
    for (uint64_t begin = b * block; begin < end; begin += at_once) {
      const size_t size = std::min<uint64_t>(at_once, end - begin);
      for (size_t i = 0; i < size; ++i) numbers[i] = first + begin + i;
      fill({numbers.data(), size}, searches.data());
      for (size_t i = 0; i < size; ++i) {
        Place p;
        const uint64_t key = place(searches[i], p) ? key_of(p) : no_key;
        by_block_[begin + i] = key << max_bits | (begin + i);
        ++counts[bucket_of(by_block_[begin + i])];
      }
    }
  });
  std::vector<uint64_t> begins(buckets + 1);
  uint64_t sum = 0;
  for (size_t bucket = 0; bucket < buckets; ++bucket) {
    begins[bucket] = sum;
    for (std::array<uint64_t, buckets>& of_block : places) {
      const uint64_t here = of_block[bucket];
      of_block[bucket] = sum;
      sum += here;
    }
  }
  begins[buckets] = sum;
  executor.for_each(blocks, [&](uint64_t b) {
    check_cancelled(job);
    for (uint64_t i = b * block, end = std::min(count, i + block); i < end; ++i)
      keys_[places[b][bucket_of(by_block_[i])]++] = by_block_[i];
  });
  executor.for_each(buckets, [&](uint64_t bucket) {
    check_cancelled(job);
    std::sort(keys_.begin() + static_cast<std::ptrdiff_t>(begins[bucket]),
              keys_.begin() + static_cast<std::ptrdiff_t>(begins[bucket + 1]));
  });
  return true;
}

}  // namespace msq
