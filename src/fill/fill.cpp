// SPDX-License-Identifier: Apache-2.0
#include "fill/fill.h"

#include <cmath>
#include <utility>

#include "base/job.h"
#include "fill/chain.h"
#include "fill/order.h"
#include "fill/round_corners.h"
#include "structure/common/plane_cells.h"

namespace msq {

namespace {

/// Half of the tolerance is for how lines are found, half for what is dropped of them.
constexpr double dropped = 0.5;

class Rounding {
 public:
  explicit Rounding(const FillPlan& plan) : plan_(plan) {}

  IntPath round(const Polyline& line) const {
    IntPath path;
    path.is_closed = line.is_closed;
    for (const Vec2 p : line.points) {
      const Vec2 q = (p - plan_.origin) * (1 / plan_.scale);
      if (!(std::abs(q.x) < 0x1p60 && std::abs(q.y) < 0x1p60))
        fail(Status::limit,
             "a line near the polygon reaches coordinate %g; the limit is 2^60: the cells are too "
             "large for a scale of %g",
             std::abs(q.x) < 0x1p60 ? q.y : q.x, plan_.scale);
      const IntPoint r{std::llround(q.x), std::llround(q.y)};
      if (path.points.empty() || !(path.points.back() == r)) path.points.push_back(r);
    }
    while (path.is_closed && path.points.size() > 1 && path.points.front() == path.points.back())
      path.points.pop_back();
    if (path.is_closed && path.points.size() < 3) path.is_closed = false;
    return path;
  }

 private:
  const FillPlan& plan_;
};

}  // namespace

Fill::Fill(Context& context, const Structure& structure, const FillPlan& plan)
    : is_int32_(plan.is_int32) {
  const FillPolygon polygon(plan.rings);
  const auto place = [&plan](IntPoint p) {
    return plan.origin + Vec2{static_cast<double>(p.x), static_cast<double>(p.y)} * plan.scale;
  };
  // A coordinate is rounded by half a unit.
  const Box2 window = Box2{place(polygon.min()), place(polygon.max())}.grown(plan.scale);
  const WallSection section{plan.z, window, (1 - dropped) * plan.tolerance};
  structure.for_each_grid([&](const Neighbourhood& grid) { require_finite_cells(grid, section); });
  CountedVector<Polyline> lines = chain(structure.wall_lines(section));
  const Rounding rounding(plan);
  CountedVector<IntPath> parts;
  JobPoll poll(current_job());
  for (Polyline& line : lines) {
    poll();
    simplify(line, dropped * plan.tolerance, window);
    polygon.cut(rounding.round(line), parts);
    line = Polyline();
  }
  lines = CountedVector<Polyline>();
  CountedVector<Tour> tours = find_trails(std::move(parts), plan.min_length / plan.scale,
                                          {plan.pair_distance / plan.scale, &polygon});
  size_t points = 0, count = 0;
  for (Tour& tour : tours) {
    count += tour.size();
    for (IntPath& path : tour) {
      poll();
      if (plan.corner_distance > 0) round_corners(path, plan.corner_distance / plan.scale, polygon);
      points += path.points.size();
    }
  }
  memory_ = Reservation(context.budget, points * (is_int32_ ? 8 : 16) + (count + 1) * 9,
                        "the lines of a fill");
  is_int32_ ? points32_.reserve(2 * points) : points64_.reserve(2 * points);
  starts_.reserve(count + 1);
  closed_.reserve(count);
  store(order_paths(std::move(tours), polygon.min()), plan.scale);
}

void Fill::store(const CountedVector<IntPath>& paths, double scale) {
  double length = 0, travel = 0;
  IntPoint last;
  for (const IntPath& path : paths) {
    if (&path != &paths.front()) travel += distance(last, path.points.front());
    length += length_of(path);
    last = path.is_closed ? path.points.front() : path.points.back();
    for (const IntPoint p : path.points) {
      if (is_int32_) {
        points32_.push_back(static_cast<int32_t>(p.x));
        points32_.push_back(static_cast<int32_t>(p.y));
      } else {
        points64_.push_back(p.x);
        points64_.push_back(p.y);
      }
    }
    starts_.push_back(starts_.back() + path.points.size());
    closed_.push_back(path.is_closed);
  }
  length_ = length * scale;
  travel_ = travel * scale;
}

}  // namespace msq
