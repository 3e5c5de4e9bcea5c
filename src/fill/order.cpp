// SPDX-License-Identifier: Apache-2.0
#include "fill/order.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "base/job.h"
#include "fill/near_points.h"

namespace msq {

namespace {

constexpr size_t near_ends = 6;
/// Paths of a run that is moved elsewhere, at most.
constexpr size_t max_run = 3;
/// On average, of all paths: how often each is tried, and how many of the order each try may move.
constexpr uint64_t max_tries = 32, max_moved = 1000;

/// A path in the order: from its first to its last point or the other way.
struct Leg {
  uint32_t path;
  bool is_reversed;
};

double way_between(Vec2 a, Vec2 b) {
  return length(b - a);
}

Vec2 relative(IntPoint p, IntPoint origin) {
  return {static_cast<double>(p.x - origin.x), static_cast<double>(p.y - origin.y)};
}

/// Tours, each followed by the nearest one that is left.
class NearestTours {
 public:
  NearestTours(const CountedVector<Tour>& tours, IntPoint start) : is_taken_(tours.size(), false) {
    for (uint32_t t = 0; t < tours.size(); ++t) {
      const auto add = [&](IntPoint p, uint32_t index) {
        places_.push_back(relative(p, start));
        begins_.push_back({t, index});
      };
      const CountedVector<IntPoint>& first = tours[t].front().points;
      if (is_ring(tours[t])) {
        for (uint32_t i = 0; i < first.size(); ++i) add(first[i], i);
      } else {
        add(first.front(), 0);
        add(tours[t].back().points.back(), 1);
      }
    }
  }

  static bool is_ring(const Tour& tour) { return tour.size() == 1 && tour[0].is_closed; }

  /// Where a tour begins: of a ring the number of the point, of others 0, or 1 if reversed.
  struct Begin {
    uint32_t tour, index;
  };
  Begin take_nearest(Vec2 p) {
    if (!grid_ || 2 * left_ < places_.size()) build();
    grid_->find(p, 1, found_);
    const Begin best = begins_[found_.front()];
    is_taken_[best.tour] = true;
    // Begins of one tour follow each other.
    size_t first = found_.front(), last = first;
    while (first > 0 && begins_[first - 1].tour == best.tour) --first;
    while (last + 1 < begins_.size() && begins_[last + 1].tour == best.tour) ++last;
    for (size_t i = first; i <= last; ++i) grid_->remove(static_cast<uint32_t>(i));
    left_ -= last + 1 - first;
    return best;
  }

 private:
  /// Of what is left, so that squares are not much finer than that.
  void build() {
    size_t kept = 0;
    for (size_t i = 0; i < begins_.size(); ++i)
      if (!is_taken_[begins_[i].tour]) {
        places_[kept] = places_[i];
        begins_[kept++] = begins_[i];
      }
    places_.resize(kept);
    begins_.resize(kept);
    left_ = kept;
    grid_.emplace(places_);
  }

  CountedVector<bool> is_taken_;
  CountedVector<Vec2> places_;
  CountedVector<Begin> begins_;
  size_t left_ = 0;
  std::optional<NearPoints> grid_;
  CountedVector<uint32_t> found_;
};

/// An order of legs, made shorter. Ends of paths have numbers 2 * path and 2 * path + 1.
class Legs {
 public:
  Legs(CountedVector<Leg> order, CountedVector<Vec2> ends)
      : order_(std::move(order)), ends_(std::move(ends)), places_(order_.size()) {
    for (uint32_t i = 0; i < order_.size(); ++i) places_[order_[i].path] = i;
  }

  CountedVector<Leg> shorten();

 private:
  /// The order, or the order from its end to its begin: what holds for last ends holds for first.
  struct View {
    const Legs& legs;
    bool is_back;

    size_t size() const { return legs.order_.size(); }
    size_t place(size_t i) const { return is_back ? size() - 1 - i : i; }
    size_t place_of(uint32_t end) const { return place(legs.places_[end / 2]); }
    uint32_t first(size_t i) const { return legs.end_of(place(i), is_back); }
    uint32_t last(size_t i) const { return legs.end_of(place(i), !is_back); }
    Vec2 at(uint32_t end) const { return legs.ends_[end]; }
    /// From the leg i to the next one, if both are there: i may be -1, as a number without sign.
    double way(size_t i) const { return way(i, i + 1); }
    double way(size_t i, size_t j) const {
      return i < size() && j < size() ? way_between(at(last(i)), at(first(j))) : 0;
    }
  };
  /// What becomes of the legs from begin to end - 1: the order reversed as a whole, then the parts
  /// before and after a place reversed again, as far as said.
  struct Move {
    double gain = 0;
    size_t begin = 0, end = 0, middle = 0;
    bool again_before = false, again_after = false;
  };

  uint32_t end_of(size_t place, bool is_last) const {
    return 2 * order_[place].path + (order_[place].is_reversed != is_last);
  }
  bool improve(uint32_t path);
  void find_moves(const View& view, size_t i, Move& best) const;
  void find_run(const View& view, size_t i, size_t begin, size_t end, bool is_reversed,
                Move& best) const;
  void apply(const View& view, const Move& move);
  void reverse(const View& view, size_t begin, size_t end);

  CountedVector<Leg> order_;
  CountedVector<Vec2> ends_;
  CountedVector<uint32_t> places_;  // of each path in the order
  CountedVector<uint32_t> near_;    // near_ends ends of other paths for each end, or itself
  CountedVector<uint32_t> changed_;
  uint64_t moved_ = 0;
};

CountedVector<Leg> Legs::shorten() {
  const size_t count = order_.size();
  near_.resize(2 * count * near_ends);
  NearPoints grid(ends_);
  CountedVector<uint32_t> found;
  CancelPoll poll(current_job());
  for (uint32_t end = 0; end < 2 * count; ++end) {
    poll();
    grid.find(ends_[end], near_ends + 2, found);
    size_t n = 0;
    for (const uint32_t other : found)
      if (other / 2 != end / 2 && n < near_ends) near_[end * near_ends + n++] = other;
    for (; n < near_ends; ++n) near_[end * near_ends + n] = end;
  }
  CountedVector<uint32_t> waiting(count);
  CountedVector<bool> waits(count, true);
  for (uint32_t i = 0; i < count; ++i) waiting[i] = order_[i].path;
  JobPoll poll_tries(current_job());
  for (size_t next = 0;
       next < waiting.size() && next < max_tries * count && moved_ < max_moved * count; ++next) {
    poll_tries();
    waits[waiting[next]] = false;
    while (improve(waiting[next]))
      for (const uint32_t path : changed_)
        if (!waits[path] && path != waiting[next]) {
          waits[path] = true;
          waiting.push_back(path);
        }
  }
  return std::move(order_);
}

bool Legs::improve(uint32_t path) {
  for (const bool is_back : {false, true}) {
    const View view{*this, is_back};
    Move best;
    find_moves(view, view.place(places_[path]), best);
    if (best.gain > 0 && moved_ < max_moved * order_.size()) {
      apply(view, best);
      return true;
    }
  }
  return false;
}

/// Moves by which another end than now follows the last end of leg i.
void Legs::find_moves(const View& view, size_t i, Move& best) const {
  const double now = view.way(i);
  const uint32_t end = view.last(i);
  for (size_t n = 0; n < near_ends; ++n) {
    const uint32_t other = near_[end * near_ends + n];
    if (other == end) return;
    const double way = way_between(ends_[end], ends_[other]);
    if (!(way < now)) return;
    const size_t j = view.place_of(other);
    if (other == view.first(j)) {
      for (size_t run = 1; run <= max_run && j + run <= view.size(); ++run)
        find_run(view, i, j, j + run, false, best);
      continue;
    }
    for (size_t run = 1; run <= max_run && run <= j + 1; ++run)
      find_run(view, i, j + 1 - run, j + 1, true, best);
    const auto [low, high] = std::minmax(i, j);
    double gain = now + view.way(j) - way;
    if (high + 1 < view.size())
      gain -= way_between(view.at(view.first(low + 1)), view.at(view.first(high + 1)));
    if (gain > best.gain + 1e-9 * now) best = {gain, low + 1, high + 1, low + 1, false, false};
  }
}

/// Moves the legs from begin to end - 1 behind leg i.
void Legs::find_run(const View& view, size_t i, size_t begin, size_t end, bool is_reversed,
                    Move& best) const {
  if ((i >= begin && i < end) || i + 1 == begin) return;
  const uint32_t first = is_reversed ? view.last(end - 1) : view.first(begin);
  const uint32_t last = is_reversed ? view.first(begin) : view.last(end - 1);
  double gain = view.way(i) + view.way(begin - 1) + view.way(end - 1) - view.way(begin - 1, end) -
                way_between(view.at(view.last(i)), view.at(first));
  if (i + 1 < view.size()) gain -= way_between(view.at(last), view.at(view.first(i + 1)));
  if (!(gain > best.gain + 1e-9 * view.way(i))) return;
  const size_t run = end - begin;
  if (begin > i)
    best = {gain, i + 1, end, i + 1 + run, !is_reversed, true};
  else
    best = {gain, begin, i + 1, i + 1 - run, true, !is_reversed};
}

void Legs::apply(const View& view, const Move& move) {
  changed_.clear();
  for (const size_t i :
       {move.begin - 1, move.begin, move.middle - 1, move.middle, move.end - 1, move.end})
    if (i < view.size()) changed_.push_back(order_[view.place(i)].path);
  reverse(view, move.begin, move.end);
  if (move.again_before) reverse(view, move.begin, move.middle);
  if (move.again_after) reverse(view, move.middle, move.end);
  for (const size_t i : {move.begin, move.middle - 1, move.middle, move.end - 1})
    if (i < view.size()) changed_.push_back(order_[view.place(i)].path);
}

void Legs::reverse(const View& view, size_t begin, size_t end) {
  if (begin == end) return;
  const size_t a = view.place(begin), b = view.place(end - 1);
  const auto first = order_.begin() + static_cast<ptrdiff_t>(std::min(a, b));
  const auto last = order_.begin() + static_cast<ptrdiff_t>(std::max(a, b)) + 1;
  std::reverse(first, last);
  for (auto leg = first; leg != last; ++leg) {
    leg->is_reversed = !leg->is_reversed;
    places_[leg->path] = static_cast<uint32_t>(leg - order_.begin());
  }
  moved_ += end - begin;
}

void begin_at(IntPath& ring, size_t index) {
  std::rotate(ring.points.begin(), ring.points.begin() + static_cast<ptrdiff_t>(index),
              ring.points.end());
}

IntPoint last_of(const IntPath& path) {
  return path.is_closed ? path.points.front() : path.points.back();
}

/// Closed paths begin where the way to them and from them is shortest.
void turn_rings(CountedVector<IntPath>& paths) {
  CancelPoll poll(current_job());
  for (size_t i = 0; i < paths.size(); ++i) {
    if (!paths[i].is_closed) continue;
    const CountedVector<IntPoint>& points = paths[i].points;
    const auto ways = [&](IntPoint p) {
      poll();
      return (i > 0 ? length(relative(p, last_of(paths[i - 1]))) : 0) +
             (i + 1 < paths.size() ? length(relative(p, paths[i + 1].points.front())) : 0);
    };
    size_t best = 0;
    double least = ways(points[0]);
    for (size_t k = 1; k < points.size(); ++k)
      if (const double sum = ways(points[k]); sum < least) {
        least = sum;
        best = k;
      }
    begin_at(paths[i], best);
  }
}

}  // namespace

CountedVector<IntPath> order_paths(CountedVector<Tour> tours, IntPoint start) {
  CountedVector<IntPath> paths;
  CountedVector<Leg> order;
  NearestTours nearest(tours, start);
  IntPoint at = start;
  CancelPoll poll(current_job());
  for (size_t n = 0; n < tours.size(); ++n) {
    poll();
    const auto [number, index] = nearest.take_nearest(relative(at, start));
    Tour& tour = tours[number];
    const bool is_ring = NearestTours::is_ring(tour);
    if (is_ring) begin_at(tour[0], index);
    const bool is_reversed = !is_ring && index != 0;
    if (is_reversed) std::reverse(tour.begin(), tour.end());
    at = is_reversed ? tour.back().points.front() : last_of(tour.back());
    for (IntPath& path : tour) {
      order.push_back({static_cast<uint32_t>(paths.size()), is_reversed});
      paths.push_back(std::move(path));
    }
  }
  CountedVector<Vec2> ends;
  ends.reserve(2 * paths.size());
  for (const IntPath& path : paths) {
    ends.push_back(relative(path.points.front(), start));
    ends.push_back(relative(last_of(path), start));
  }
  CountedVector<IntPath> ordered;
  ordered.reserve(paths.size());
  for (const auto& [path, is_reversed] : Legs(std::move(order), std::move(ends)).shorten()) {
    // A ring stays as it is: it ends where it begins.
    if (is_reversed && !paths[path].is_closed)
      std::reverse(paths[path].points.begin(), paths[path].points.end());
    ordered.push_back(std::move(paths[path]));
  }
  turn_rings(ordered);
  return ordered;
}

}  // namespace msq
