// SPDX-License-Identifier: Apache-2.0
#include "fill/trails.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

#include "base/job.h"
#include "base/polled_sort.h"
#include "fill/matching.h"
#include "fill/side_by_side.h"

namespace msq {

namespace {

/// Ends of lines: 2 * line, and 2 * line + 1.
using End = uint32_t;
constexpr End no_end = UINT32_MAX;
/// More lines meet only where coordinates are coarse. These are joined as they come.
constexpr size_t max_compared = 16;

class Trails {
 public:
  /// `single`: lines that are not printed twice, by number among those that are neither closed nor
  /// left out.
  Trails(CountedVector<IntPath> lines, double min_length, const LinePairs& pairs,
         const CountedVector<uint32_t>& single)
      : lines_(std::move(lines)), min_length_(min_length), pairs_(pairs), single_(single) {}

  CountedVector<Tour> find();
  /// After find(): the pairs of which a line, or one that is joined to it, leaves the polygon.
  CountedVector<uint32_t> leaving() const;

 private:
  struct Place {
    IntPoint point;
    End end;

    friend bool operator<(const Place& a, const Place& b) {
      if (a.point.x != b.point.x) return a.point.x < b.point.x;
      if (a.point.y != b.point.y) return a.point.y < b.point.y;
      return a.end < b.end;
    }
  };
  /// Two pairs of ends at a point that may be exchanged, and what that costs.
  struct Exchange {
    double cost;
    End a, b, c, d;  // pairs a, b and c, d; then a, c and b, d

    friend bool operator<(const Exchange& p, const Exchange& q) {
      if (p.cost != q.cost) return p.cost < q.cost;
      return std::array{p.a, p.b, p.c, p.d} < std::array{q.a, q.b, q.c, q.d};
    }
  };

  IntPoint point_of(End end) const {
    const CountedVector<IntPoint>& points = lines_[end / 2].points;
    return end % 2 == 0 ? points.front() : points.back();
  }
  Vec2 direction(End end) const;
  /// The end of the other line of a pair at the same point, or no_end.
  End twin(End end) const {
    const uint32_t other = end / 2 < twins_.size() ? twins_[end / 2] : no_end;
    return other == no_end ? no_end : 2 * other + end % 2;
  }
  bool is_way(uint32_t line) const { return line >= printed_; }
  /// 0: straight; 2: back again. A path ends where a way begins: the turn there does not matter.
  double turn(End a, End b) const {
    return is_way(a / 2) || is_way(b / 2) ? 0 : 1 + dot(directions_[a], directions_[b]);
  }

  void find_points();
  void leave_out_short_lines();
  void add_pairs();
  void add_ways();
  void pair_ends();
  void pair_at(size_t begin, size_t end);
  void pair(End a, End b);
  void pair_twins(size_t& begin, size_t end);
  double side(End end) const;
  IntPoint joint(End end) const;
  IntPath in_place(End from) const;
  bool leaves(End from) const;
  void connect();
  void connect_pairs(size_t i, size_t j, CountedVector<Exchange>& exchanges) const;
  void exchange(const Exchange& exchange);
  uint32_t tour_of(uint32_t line);
  Tour follow(End end);

  CountedVector<IntPath> lines_;  // and from number printed_ on the ways
  double min_length_;
  LinePairs pairs_;
  const CountedVector<uint32_t>& single_;  // sorted
  size_t printed_ = 0;
  CountedVector<uint32_t>
      twins_;  // of each line that is printed: the other one of its pair, or no_end
  CountedVector<Vec2> directions_;  // at each end
  CountedVector<uint32_t> starts_;  // of each point in ends_
  CountedVector<End> ends_;         // by point; then pairs follow each other
  CountedVector<End> partners_;     // the end that a tour goes on with at the same point
  CountedVector<uint32_t> parents_;
  CountedVector<bool> is_used_;
};

Vec2 Trails::direction(End end) const {
  const CountedVector<IntPoint>& points = lines_[end / 2].points;
  const size_t last = points.size() - 1;
  const IntPoint from = points[end % 2 ? last : 0], to = points[end % 2 ? last - 1 : 1];
  const Vec2 way{static_cast<double>(to.x - from.x), static_cast<double>(to.y - from.y)};
  return unit(way);
}

void Trails::find_points() {
  CountedVector<Place> places(2 * lines_.size());
  for (End end = 0; end < places.size(); ++end) places[end] = {point_of(end), end};
  CancelPoll poll(current_job());
  polled_sort(places.begin(), places.end(), std::less<>(), poll);
  starts_.clear();
  ends_.clear();
  for (size_t i = 0; i < places.size(); ++i) {
    if (i == 0 || !(places[i].point == places[i - 1].point))
      starts_.push_back(static_cast<uint32_t>(i));
    ends_.push_back(places[i].end);
  }
  starts_.push_back(static_cast<uint32_t>(places.size()));
}

void Trails::leave_out_short_lines() {
  CountedVector<uint32_t> point_of_end(2 * lines_.size()), counts(starts_.size() - 1);
  for (uint32_t n = 0; n < counts.size(); ++n) {
    counts[n] = starts_[n + 1] - starts_[n];
    for (uint32_t i = starts_[n]; i < starts_[n + 1]; ++i) point_of_end[ends_[i]] = n;
  }
  CountedVector<std::pair<double, uint32_t>> found;
  for (uint32_t line = 0; line < lines_.size(); ++line)
    if (const double length = length_of(lines_[line]); length < min_length_)
      found.emplace_back(length, line);
  CancelPoll poll(current_job());
  polled_sort(found.begin(), found.end(), std::less<>(), poll);
  const auto is_junction = [&](uint32_t n) { return counts[n] >= 3 && counts[n] % 2 == 1; };
  for (const auto& [length, line] : found) {
    const uint32_t a = point_of_end[2 * line], b = point_of_end[2 * line + 1];
    const bool is_alone = counts[a] == 1 && counts[b] == 1;
    if (!is_alone && (a == b || !is_junction(a) || !is_junction(b))) continue;
    --counts[a];
    --counts[b];
    lines_[line].points.clear();
  }
  std::erase_if(lines_, [](const IntPath& line) { return line.points.empty(); });
}

/// Shortest lines first: as much is printed in addition as the travel that it saves is long.
void Trails::add_pairs() {
  const size_t count = lines_.size();
  CountedVector<uint32_t> point_of_end(2 * count), counts(starts_.size() - 1);
  for (uint32_t n = 0; n < counts.size(); ++n) {
    counts[n] = starts_[n + 1] - starts_[n];
    for (uint32_t i = starts_[n]; i < starts_[n + 1]; ++i) point_of_end[ends_[i]] = n;
  }
  const auto is_candidate = [&](uint32_t line) {
    const uint32_t a = point_of_end[2 * line], b = point_of_end[2 * line + 1];
    return a != b && counts[a] % 2 == 1 && counts[b] % 2 == 1 && counts[a] + counts[b] > 2 &&
           !std::binary_search(single_.begin(), single_.end(), line);
  };
  CountedVector<std::pair<double, uint32_t>> found;
  for (uint32_t line = 0; line < count; ++line)
    if (is_candidate(line)) found.emplace_back(length_of(lines_[line]), line);
  CancelPoll poll(current_job());
  polled_sort(found.begin(), found.end(), std::less<>(), poll);
  twins_.assign(count, no_end);
  for (const auto& [length, line] : found) {
    poll();
    const uint32_t a = point_of_end[2 * line], b = point_of_end[2 * line + 1];
    if (!is_candidate(line) || !fit_beside(lines_[line], 0.5 * pairs_.distance, counts[a] == 1,
                                           counts[b] == 1, *pairs_.polygon))
      continue;
    ++counts[a];
    ++counts[b];
    twins_[line] = static_cast<uint32_t>(lines_.size());
    twins_.push_back(line);
    lines_.push_back(lines_[line]);
  }
}

void Trails::add_ways() {
  printed_ = lines_.size();
  if (lines_.empty()) return;
  CountedVector<Vec2> places;
  CountedVector<IntPoint> points;
  const IntPoint origin = point_of(0);
  for (size_t n = 0; n + 1 < starts_.size(); ++n)
    if ((starts_[n + 1] - starts_[n]) % 2) {
      const IntPoint p = point_of(ends_[starts_[n]]);
      points.push_back(p);
      places.push_back({static_cast<double>(p.x - origin.x), static_cast<double>(p.y - origin.y)});
    }
  const CountedVector<uint32_t> partners = match(places);
  for (uint32_t i = 0; i < partners.size(); ++i)
    if (i < partners[i]) lines_.push_back({{points[i], points[partners[i]]}, false});
}

void Trails::pair(End a, End b) {
  partners_[a] = b;
  partners_[b] = a;
  const uint32_t p = tour_of(a / 2), q = tour_of(b / 2);
  parents_[std::max(p, q)] = std::min(p, q);
}

uint32_t Trails::tour_of(uint32_t line) {
  while (parents_[line] != line) line = parents_[line] = parents_[parents_[line]];
  return line;
}

void Trails::pair_ends() {
  partners_.assign(2 * lines_.size(), no_end);
  parents_.resize(lines_.size());
  std::iota(parents_.begin(), parents_.end(), 0u);
  CancelPoll poll(current_job());
  for (size_t n = 0; n + 1 < starts_.size(); ++n) {
    poll();
    pair_at(starts_[n], starts_[n + 1]);
  }
}

/// Whether direction u comes before v in a turn to the left that begins at direction d.
bool comes_before(Vec2 d, Vec2 u, Vec2 v) {
  const auto cross = [](Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; };
  const bool u_is_left = cross(d, u) >= 0, v_is_left = cross(d, v) >= 0;
  return u_is_left != v_is_left ? u_is_left : cross(u, v) > 0;
}

/// Each line of a pair goes on with a line of its own, so that none turns back.
void Trails::pair_twins(size_t& begin, size_t end) {
  for (size_t i = begin; i < end && end - begin >= 4; ++i) {
    const End one = ends_[i], two = twin(one);
    if (two == no_end) continue;
    const auto swap_to = [&](End known, size_t to) {
      std::swap(*std::find(ends_.begin() + static_cast<ptrdiff_t>(begin),
                           ends_.begin() + static_cast<ptrdiff_t>(end), known),
                ends_[to]);
    };
    swap_to(one, begin);
    swap_to(two, begin + 1);
    for (const size_t to : {begin + 2, begin + 3}) {
      size_t best = to;
      for (size_t k = to; k < end; ++k)
        if (turn(one, ends_[k]) < turn(one, ends_[best])) best = k;
      std::swap(ends_[to], ends_[best]);
    }
    std::swap(ends_[begin + 1], ends_[begin + 2]);  // one, its partner, two, its partner
    pair(ends_[begin], ends_[begin + 1]);
    pair(ends_[begin + 2], ends_[begin + 3]);
    begin += 4;
    i = begin - 1;
  }
}

/// Those that are most nearly straight, then the next ones; last the one that is left with the way.
void Trails::pair_at(size_t begin, size_t end) {
  const auto swap_to = [this](size_t from, size_t to) { std::swap(ends_[from], ends_[to]); };
  for (size_t i = begin; i < end; ++i)
    if (is_way(ends_[i] / 2)) swap_to(i, end - 1);
  if (!twins_.empty()) pair_twins(begin, end);
  for (; end - begin >= 2; begin += 2) {
    size_t best_a = begin, best_b = begin + 1;
    if (end - begin > 2 && end - begin <= max_compared) {
      double best = 3;
      for (size_t a = begin; a < end; ++a)
        for (size_t b = a + 1; b < end && !is_way(ends_[b] / 2); ++b)
          if (turn(ends_[a], ends_[b]) < best) {
            best = turn(ends_[a], ends_[b]);
            best_a = a;
            best_b = b;
          }
    }
    swap_to(begin, best_a);
    swap_to(begin + 1, best_b);
    pair(ends_[begin], ends_[begin + 1]);
  }
}

void Trails::connect_pairs(size_t i, size_t j, CountedVector<Exchange>& exchanges) const {
  const End a = ends_[i], b = partners_[a], c = ends_[j], d = partners_[c];
  const double now = turn(a, b) + turn(c, d);
  exchanges.push_back({turn(a, c) + turn(b, d) - now, a, b, c, d});
  exchanges.push_back({turn(a, d) + turn(b, c) - now, a, b, d, c});
}

/// Two tours through a point become one by an exchange of their pairs.
void Trails::exchange(const Exchange& exchange) {
  const auto& [cost, a, b, c, d] = exchange;
  if (partners_[a] != b || partners_[c] != d || tour_of(a / 2) == tour_of(c / 2)) return;
  pair(a, c);
  pair(b, d);
}

/// Exchanges that cost least first, as in Kruskal's minimum spanning tree of the tours.
void Trails::connect() {
  CountedVector<Exchange> exchanges;
  CancelPoll poll(current_job());
  for (size_t n = 0; n + 1 < starts_.size(); ++n) {
    const size_t begin = starts_[n], end = starts_[n + 1];
    if (end - begin > max_compared) continue;
    for (size_t i = begin; i < end; i += 2)
      for (size_t j = i + 2; j < end; j += 2) {
        poll();
        if (tour_of(ends_[i] / 2) != tour_of(ends_[j] / 2)) connect_pairs(i, j, exchanges);
      }
  }
  polled_sort(exchanges.begin(), exchanges.end(), std::less<>(), poll);
  for (const Exchange& one : exchanges) exchange(one);
  // Where more than two tours met, or many lines: pairs are others now, so all ends are looked at.
  for (size_t n = 0; n + 1 < starts_.size(); ++n)
    for (size_t i = starts_[n] + 1; i < starts_[n + 1]; ++i) {
      poll();
      exchanges.clear();
      if (tour_of(ends_[i - 1] / 2) == tour_of(ends_[i] / 2)) continue;
      connect_pairs(i - 1, i, exchanges);
      exchange(*std::min_element(exchanges.begin(), exchanges.end()));
    }
}

/// On which side of its pair a line is at an end, seen from there: 1 is the left, -1 the right. The
/// line that goes on to the left is the left one. 0 where the pair turns back.
double Trails::side(End end) const {
  const End other = twin(end);
  if (other == no_end || partners_[end] == other) return 0;
  const Vec2 d = directions_[end], u = directions_[partners_[end]],
             v = directions_[partners_[other]];
  if (comes_before(d, u, v)) return 1;
  return comes_before(d, v, u) || end > other ? -1 : 1;
}

/// Where the line with an end meets its partner there.
IntPoint Trails::joint(End end) const {
  End partner = partners_[end];
  if (side(end) == 0) std::swap(end, partner);
  const double aside = 0.5 * pairs_.distance * side(end);
  if (aside == 0) return point_of(end);
  const double limit =
      is_way(partner / 2) ? 0 : std::min(pairs_.distance, 0.5 * length_of(lines_[partner / 2]));
  return moved(point_of(end), corner_beside(directions_[end], aside, directions_[partner], limit));
}

/// A line from an end on, beside its twin if it has one.
IntPath Trails::in_place(End from) const {
  IntPath line = lines_[from / 2];
  if (from % 2) std::reverse(line.points.begin(), line.points.end());
  const double aside = 0.5 * pairs_.distance, side_from = side(from), side_to = -side(from ^ 1);
  if (side_from != 0 || side_to != 0) line = beside(line, aside * side_from, aside * side_to);
  line.points.front() = joint(from);
  line.points.back() = joint(from ^ 1);
  return line;
}

/// Whether a line in its place leaves the polygon where it is not where it was.
bool Trails::leaves(End from) const {
  IntPath line = in_place(from);
  CountedVector<IntPoint>& points = line.points;
  const size_t last = points.size() - 1;
  const bool begins_there = points[0] == point_of(from),
             ends_there = points[last] == point_of(from ^ 1);
  if (begins_there && ends_there && side(from) == 0 && side(from ^ 1) == 0) return false;
  // Ends that stay may be on the border.
  if (begins_there) points[0] = short_of(points[0], points[1]);
  if (ends_there) points[last] = short_of(points[last], points[last - 1]);
  CountedVector<IntPath> parts;
  pairs_.polygon->cut(line, parts);
  return parts.size() != 1 || !(parts[0].points == points);
}

CountedVector<uint32_t> Trails::leaving() const {
  CountedVector<uint32_t> found;
  const auto add = [&](uint32_t line) {
    if (line < twins_.size() && twins_[line] != no_end)
      found.push_back(std::min(line, twins_[line]));
  };
  for (uint32_t line = 0; line < printed_; ++line) {
    if (!leaves(2 * line)) continue;
    add(line);
    for (const End end : {2 * line, 2 * line + 1})
      if (!is_way(partners_[end] / 2)) add(partners_[end] / 2);
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

Tour Trails::follow(End end) {
  // The lines of the tour, each from an end.
  CountedVector<End> order;
  size_t first = 0;
  double longest = -1;
  for (const End begin = end;;) {
    is_used_[end / 2] = true;
    order.push_back(end);
    end = partners_[end ^ 1];
    if (is_way(order.back() / 2)) {
      const IntPoint a = point_of(order.back()), b = point_of(order.back() ^ 1);
      const double x = static_cast<double>(b.x - a.x), y = static_cast<double>(b.y - a.y);
      if (x * x + y * y > longest) {
        longest = x * x + y * y;
        first = order.size();
      }
    }
    if (end == begin) break;
  }
  std::rotate(order.begin(), order.begin() + static_cast<ptrdiff_t>(first % order.size()),
              order.end());
  Tour tour;
  IntPath path;
  for (const End from : order) {
    if (is_way(from / 2)) {
      tour.push_back(std::move(path));
      path = {};
      continue;
    }
    const CountedVector<IntPoint> points = in_place(from).points;
    const bool goes_on = !path.points.empty();
    path.points.insert(path.points.end(), points.begin() + goes_on, points.end());
  }
  if (!path.points.empty()) {  // the tour is closed; along one line and back it is no ring
    path.is_closed = path.points.size() > 3;
    if (path.is_closed) path.points.pop_back();
    tour.push_back(std::move(path));
  }
  return tour;
}

CountedVector<Tour> Trails::find() {
  CountedVector<Tour> tours;
  for (IntPath& line : lines_)
    if (line.is_closed) {
      tours.emplace_back();
      tours.back().push_back(std::move(line));
    }
  std::erase_if(lines_, [](const IntPath& line) { return line.is_closed; });
  find_points();
  leave_out_short_lines();
  find_points();
  if (pairs_.distance > 0) {
    add_pairs();
    find_points();
  }
  add_ways();
  find_points();
  directions_.resize(2 * lines_.size());
  for (End end = 0; end < directions_.size(); ++end) directions_[end] = direction(end);
  pair_ends();
  connect();
  is_used_.assign(lines_.size(), false);
  CancelPoll poll(current_job());
  for (uint32_t line = 0; line < lines_.size(); ++line) {
    poll();
    if (!is_used_[line]) tours.push_back(follow(2 * line));
  }
  for (Tour& tour : tours)
    std::erase_if(tour, [this](const IntPath& path) { return length_of(path) < min_length_; });
  std::erase_if(tours, [](const Tour& tour) { return tour.empty(); });
  return tours;
}

}  // namespace

CountedVector<Tour> find_trails(CountedVector<IntPath> lines, double min_length,
                                const LinePairs& pairs) {
  CountedVector<uint32_t> single;
  if (pairs.distance == 0) return Trails(std::move(lines), min_length, pairs, single).find();
  // A pair's lines are known to leave the polygon when all are joined.
  for (;;) {
    Trails trails(lines, min_length, pairs, single);
    CountedVector<Tour> tours = trails.find();
    const CountedVector<uint32_t> leaving = trails.leaving();
    if (leaving.empty()) return tours;
    single.insert(single.end(), leaving.begin(), leaving.end());
    std::sort(single.begin(), single.end());
  }
}

}  // namespace msq
