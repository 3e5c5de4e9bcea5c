// SPDX-License-Identifier: Apache-2.0
#include "structure/lattice/rays/strut_rays.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/grid_walk.h"
#include "base/infinity.h"
#include "cell/cell_hash.h"
#include "structure/common/leave_strut.h"

namespace msq {

namespace {

/// In smallest cell sizes: the maximum error of entries by formula, except those that only
/// membership decides; and the length below which a part of a ray within a strut may be due to
/// rounding.
constexpr double formula_error = 1e-6, short_part = 0x1p-12;

}  // namespace

StrutRays::StrutRays(const Structure& structure, StrutLists& lists, const Parameter& radius,
                     const Job* job)
    : structure_(structure),
      lists_(lists),
      radius_(radius),
      job_(job),
      grid_(structure.neighbourhood()),
      cell_(min_component(grid_.cell_size)) {}

template <class Visit>
void StrutRays::walk_boxes(const Ray& ray, const Box3* box, Part& part, double to, Visit&& visit) {
  const Vec3 along = grid_.rotation.apply_inverse(ray.direction);
  JobPoll poll(job_);
  while (true) {
    poll();
    const Vec3 q = grid_.to_grid(ray.at(part.from));
    double way = infinity;
    for (int axis = 0; axis < 3; ++axis)
      if (along[axis] != 0)
        way =
            std::min(way, ((along[axis] > 0 ? box->max : box->min)[axis] - q[axis]) / along[axis]);
    // The margin of the box is longer than the tolerance, so the ray gets on.
    part.to = std::min(to, part.from + std::max(way, tolerance_));
    if (!visit(static_cast<const Part&>(part)) || part.to >= to) return;
    part.from = part.to;
    box = lists_.box_about(ray.at(part.from), part.cell);
  }
}

template <class Visit>
void StrutRays::walk(const Ray& ray, double from, double to, Visit&& visit) {
  Part part{};
  part.from = from;
  if (const Box3* box = lists_.box_about(ray.at(from), part.cell)) {
    is_in_boxes_ = true;
    return walk_boxes(ray, box, part, to, visit);
  }
  const Ray in_grid{grid_.to_grid(ray.origin), grid_.rotation.apply_inverse(ray.direction)};
  const int parts = lists_.parts();
  int32_t cell[3] = {};
  int64_t last[3] = {};  // in part 0 of cell 0
  const auto at_end = [&] { return grid_.to_grid(ray.at(to)); };
  walk_grid(in_grid, grid_.to_grid(ray.at(from)), at_end, grid_.cell_size * (1.0 / parts), from, to,
            job_, [&](const int64_t(&index)[3], double begin, double end) {
              for (int i = 0; i < 3; ++i) {
                if (index[i] == last[i]) continue;  // true of two axes, except in the first part
                const int64_t n =
                    index[i] >= 0 ? index[i] / parts : -((-index[i] + parts - 1) / parts);
                cell[i] = static_cast<int32_t>(n);
                part.number[i] = static_cast<int>(index[i] - n * parts);
                last[i] = index[i];
              }
              part.cell = {cell[0], cell[1], cell[2]};
              part.from = begin;
              part.to = end;
              return visit(static_cast<const Part&>(part));
            });
}

Vec3 StrutRays::locate(const Part& part, Vec3 p) const {
  if (is_in_boxes_) return grid_.to_grid(p);
  const Neighbourhood::Located located = grid_.locate(p);
  Vec3 q = located.fraction;
  // Points in other cells belong to struts that reach over.
  q.x += located.cell.x - part.cell.x;
  q.y += located.cell.y - part.cell.y;
  q.z += located.cell.z - part.cell.z;
  return q * grid_.cell_size;
}

bool StrutRays::holds(const Part& part, uint32_t strut, Vec3 p) const {
  const LatticeStrut s{lists_.struts().axis(strut), lists_.struts().factor(strut)};
  return s.holds(locate(part, p), radius_.at(p));
}

Interval StrutRays::radii_in(const Ray& ray, const Part& part) {
  const auto in_part = [&] {
    return radius_.range(
        box_of(ray, part.from, part.to).grown(2 * tolerance_ + formula_error * cell_));
  };
  if (is_in_boxes_ || part.is_short) return in_part();
  const CellIndex cell = part.cell;
  CellRadii& known = radii_[hash_of(cell) % std::size(radii_)];
  if (!known.is_known || !(known.cell == cell)) {
    const Vec3 corner = Vec3{double(cell.x), double(cell.y), double(cell.z)} * grid_.cell_size;
    const Box3 box =
        Box3{corner, corner + grid_.cell_size}.grown(2 * tolerance_ + formula_error * cell_);
    known = {cell, true, radius_.range(grid_.from_grid(box))};
  }
  // If the radius changes much in the cell, the range in the part excludes many struts.
  constexpr double much = 0.25;
  if (known.range.high - known.range.low <= much * known.range.high) return known.range;
  return in_part();
}

void StrutRays::find_candidates(const Ray& ray, const Part& part, bool greatest) {
  check_cancelled(job_);  // a part may have thousands of thick struts
  candidates_.clear();
  runs_.clear();
  lists_.find(part.cell, part.number, runs_);
  const Vec3 p = ray.at(part.from);
  double radius;
  if (radius_.is_constant()) {
    radius = radius_.at(p);
  } else {
    const Interval range = radii_in(ray, part);
    radius = std::max(0.0, greatest ? range.high : range.low);
  }
  // Widened as the lists are.
  const double margin = 2 * tolerance_;
  const Vec3 corner{double(part.cell.x), double(part.cell.y), double(part.cell.z)};
  const CapsuleList::Ray local{
      is_in_boxes_ ? grid_.to_grid(p) : grid_.to_grid(p) - corner * grid_.cell_size,
      grid_.rotation.apply_inverse(ray.direction), part.to - part.from + margin, radius};
  for (const StrutLists::Run run : runs_) {
    if (met_.size() < run.end - run.begin) met_.resize(run.end - run.begin);
    const size_t count = lists_.struts().meet(run.begin, run.end, local, met_.data());
    for (size_t i = 0; i < count; ++i)
      candidates_.push_back(
          {met_[i].capsule, part.from + met_[i].enter, part.from + met_[i].leave});
  }
}

template <class Inside>
bool StrutRays::approach(const Ray& ray, const Part& part, uint32_t strut, Inside&& inside,
                         double& t, double to) const {
  const Segment axis = lists_.struts().axis(strut);
  const double factor = lists_.struts().factor(strut);
  const Vec3 along = grid_.rotation.apply_inverse(ray.direction);
  Vec3 gradient;
  const Vec3 begin = ray.at(t);
  const Box3 way = box_of(ray, t, to);
  const double steepest =
      radius_.is_linear(way, gradient) ? dot(gradient, ray.direction) : radius_.lipschitz(way);
  const double first = t;
  const Vec3 at_first = locate(part, begin);
  // After nearly as many steps a ray only grazes the strut.
  constexpr int fast_steps = 1000;
  // Few steps suffice if the radius is about as steep here as anywhere.
  constexpr int few_steps = 4;
  double stride = to - t;
  JobPoll poll(job_);
  // Each round advances by the minimum step or more.
  for (int n = 0; t <= to; ++n) {
    poll();
    const Vec3 p = ray.at(t), away = axis.way_to(at_first + along * (t - first));
    const double distance = length(away), gap = distance - factor * radius_.at(p);
    // If a ray grazes the strut, the gap may round to 0 long before membership changes.
    if (!(gap > 0) && inside(p)) return true;
    // The distance is convex along the ray, and the radius grows by at most `steepest`.
    const double fall = distance > 0 ? factor * steepest - dot(away, along) / distance : 1;
    if (!(fall > 0)) return false;
    const double least = n < fast_steps ? tolerance_ : std::max(tolerance_, 0x1p-24 * cell_);
    const double next = t + std::max(gap / fall, least);
    if (!(next > t)) return false;
    // It usually is not, and its range over a longer way shows that.
    stride = std::min(stride, to - t);
    if (n >= few_steps && stride > next - t) {
      const Vec3 q = ray.at(t + stride);
      const Interval range = radius_.range(Box3{min(p, q), max(p, q)}.grown(tolerance_));
      const double nearest = distance + std::min(0.0, dot(away, along) / distance) * stride;
      if (nearest - tolerance_ > factor * std::max(0.0, range.high)) {
        t += stride;
        stride *= 2;
        continue;
      }
      stride *= 0.5;
    }
    t = next;
  }
  return false;
}

bool StrutRays::enter_strut(const Ray& ray, const Part& part, const Candidate& candidate,
                            double from, double to, double& t) const {
  double enter = std::max(candidate.enter, from), leave = std::min(candidate.leave, to);
  // For short parts the last bits decide, with all struts together.
  const bool is_short = candidate.leave - candidate.enter < short_part * cell_;
  const auto is_in = [&](Vec3 p) {
    return is_short ? structure_.inside(p) : holds(part, candidate.strut, p);
  };
  if (!radius_.is_constant() && !is_in(ray.at(enter))) {
    if (radius_.lipschitz(box_of(ray, enter, leave)) == infinity) {
      const RayMarch march{std::max(structure_.min_ray_step(), tolerance_), tolerance_};
      return march.find(
          true, ray, enter, std::max(enter, leave), is_in, [](Vec3) { return 0.0; }, t, job_);
    }
    if (!approach(ray, part, candidate.strut, is_in, enter, leave)) return false;
  }
  t = enter;
  if (settle_entry(ray, from, to, tolerance_, is_in, t)) return true;
  // Formulas may be too early, by much if the ray grazes the strut or runs along it.
  const double middle = 0.5 * (enter + leave);
  if (!(middle > enter) || !is_in(ray.at(middle))) return false;
  t = bisect(enter, middle, tolerance_, [&](double at) { return is_in(ray.at(at)); });
  return true;
}

Vec3 StrutRays::normal_of(const Part& part, uint32_t strut, const Ray& ray, double t) const {
  const Segment axis = lists_.struts().axis(strut);
  const Vec3 p = ray.at(t), q = locate(part, p);
  const Vec3 away = axis.way_to(q);
  const double distance = length(away);
  if (!(distance > 0)) return {};
  Vec3 normal = grid_.rotation.apply(away * (1 / distance));
  if (!radius_.is_constant())
    normal = normal - radius_.gradient(p, 0x1p-16 * cell_) * lists_.struts().factor(strut);
  const double size = length(normal);
  return size > 0 && size < infinity ? normal * (1 / size) : Vec3{};
}

void StrutRays::enter(RaySearch* searches, size_t count) {
  for (size_t i = 0; i < count; ++i) enter(searches[i]);
}

void StrutRays::enter(RaySearch& search) {
  search.found = false;
  search.normal = {};
  if (!(search.from <= search.to)) return;
  const Ray& ray = search.ray;
  tolerance_ = structure_.ray_tolerance(ray, search.to);
  walk(ray, search.from, search.to, [&](const Part& part) {
    find_candidates(ray, part, true);
    double first = infinity;
    uint32_t strut = 0;
    while (true) {
      // The next by formula, until the settled entry is before it.
      size_t next = candidates_.size();
      for (size_t i = 0; i < candidates_.size(); ++i)
        if (next == candidates_.size() || candidates_[i].enter < candidates_[next].enter) next = i;
      if (next == candidates_.size() ||
          candidates_[next].enter > std::min(first, part.to) + formula_error * cell_)
        break;
      const Candidate candidate = candidates_[next];
      candidates_[next] = candidates_.back();
      candidates_.pop_back();
      double t;
      const double to = std::min(first, part.to + tolerance_);
      if (enter_strut(ray, part, candidate, std::max(search.from, part.from - tolerance_), to, t) &&
          t < first) {
        first = t;
        strut = candidate.strut;
      }
    }
    if (first > part.to + tolerance_) return true;
    search.found = true;
    search.t = std::min(first, search.to);
    search.normal = normal_of(part, strut, ray, search.t);
    return false;
  });
}

bool StrutRays::follow(const Ray& ray, const Part& part, double& until) {
  const Vec3 begin = ray.at(part.from), end = ray.at(part.to);
  Vec3 gradient;
  const bool is_interval =
      radius_.is_constant() || radius_.is_linear(Box3{min(begin, end), max(begin, end)}, gradient);
  // If a strut may contain more than one interval, that of the minimum radius.
  find_candidates(ray, part, is_interval);
  // Where the ray, in the strut at `until`, leaves it, within the part.
  const auto end_of = [&](const Candidate& c) {
    const auto is_out = [&](double t) { return !holds(part, c.strut, ray.at(t)); };
    const double last = std::min(c.leave, part.to);
    if (!(last > until) || is_out(until)) return until;
    return is_out(last) ? bisect(until, last, tolerance_, is_out) - tolerance_ : last;
  };
  const Candidate* last = nullptr;
  // Each round except the last continues with another strut.
  bool is_longer = true;
  for (size_t rounds = 0; is_longer && until < part.to && rounds <= candidates_.size(); ++rounds) {
    is_longer = false;
    for (const Candidate& c : candidates_) {
      if (c.enter > until + formula_error * cell_) continue;
      const double t = end_of(c);
      if (!(t > until)) continue;
      until = t;
      is_longer = true;
      last = &c;
    }
  }
  if (is_interval || until >= part.to || !last) return is_interval;
  return follow_out(ray, part, last->strut, until);
}

bool StrutRays::follow_out(const Ray& ray, const Part& part, uint32_t strut, double& until) const {
  const Vec3 away = lists_.struts().axis(strut).way_to(locate(part, ray.at(until)));
  const double slope = radius_.lipschitz(box_of(ray, until, part.to).grown(2 * tolerance_));
  return msq::follow_out(
      away, grid_.rotation.apply_inverse(ray.direction), lists_.struts().factor(strut) * slope,
      part.to, tolerance_, [&](double t) { return !holds(part, strut, ray.at(t)); }, until);
}

double StrutRays::leave(const Ray& ray, double from, double to) {
  tolerance_ = structure_.ray_tolerance(ray, to);
  double until = from;
  walk(ray, from, to, [&](const Part& whole) {
    Part part = whole;
    return follow_pieces(whole.to, whole.to - whole.from, tolerance_, until, [&](double end) {
      part.to = end;
      const bool leaves = follow(ray, part, until);
      part.from = until;
      part.is_short = true;
      return leaves;
    });
  });
  return until > from ? until : structure_.Structure::leave(ray, from, to, job_);
}

Vec3 StrutRays::normal(const Ray& ray, double t) {
  // The strut that contains the point where the ray enters, or the nearest one.
  Vec3 normal;
  double least = infinity;
  walk(ray, t, t, [&](const Part& part) {
    runs_.clear();
    lists_.find(part.cell, part.number, runs_);
    const Vec3 p = ray.at(t), q = locate(part, p);
    const double r = radius_.at(p);
    for (const StrutLists::Run run : runs_)
      for (uint32_t i = run.begin; i < run.end; ++i) {
        const double gap =
            std::sqrt(lists_.struts().axis(i).distance_squared(q)) - lists_.struts().factor(i) * r;
        if (!(gap < least)) continue;
        least = gap;
        normal = normal_of(part, i, ray, t);
      }
    return false;
  });
  return dot(normal, normal) > 0 ? normal : ray.direction * -1.0;
}

}  // namespace msq
