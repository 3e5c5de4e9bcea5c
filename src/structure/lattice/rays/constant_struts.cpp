// SPDX-License-Identifier: Apache-2.0
// Each step is that of StrutRays, walk_grid() and settle_entry(), with the same operations. What
// they do through calls for each part of a ray, and for each point, is in one function here.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "structure/lattice/rays/constant_struts.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <cmath>

#include "base/grid_walk.h"
#include "base/infinity.h"
#include "structure/lattice/rays/constant_struts.h"
#include "strut/meet_capsules-inl.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace {

class ConstantStruts {
 public:
  ConstantStruts(const Structure& structure, const CellParts& parts, double radius, const Job* job)
      : structure_(structure),
        grid_(structure.neighbourhood()),
        parts_(parts),
        arrays_(parts.struts().arrays()),
        met_(parts.max_struts()),
        job_(job),
        radius_(radius),
        cell_(min_component(grid_.cell_size)),
        is_turned_(grid_.rotation.m != Rotation().m) {
    while (1 << shift_ < parts.parts()) ++shift_;
    for (int axis = 0; axis < 3; ++axis)
      part_size_[axis] = grid_.cell_size[axis] * (1.0 / parts.parts());
  }

  void enter(RaySearch& search) {
    search.found = false;
    search.normal = {};
    if (!(search.from <= search.to)) return;
    const Ray ray = search.ray;
    const double to = search.to;
    tolerance_ = structure_.ray_tolerance(ray, to);
    const Vec3 direction = along_grid(ray.direction), begin = to_grid(ray.origin);
    const Vec3 start = to_grid(ray.at(search.from));
    const double along[3] = {direction.x, direction.y, direction.z};
    const double origin[3] = {begin.x, begin.y, begin.z};
    int64_t index[3];
    double next[3];
    for (int axis = 0; axis < 3; ++axis) {
      index[axis] = walked_index(start[axis], part_size_[axis]);
      next[axis] = crossing(index[axis], axis, along[axis], origin[axis]);
    }
    // As walk_grid().
    int64_t steps = 3 * 2;
    bool knows_end = false;
    JobPoll poll(job_);
    for (double from = search.from;; --steps) {
      if (steps < 0) {
        if (knows_end) return;
        knows_end = true;
        steps += difference(start, to_grid(ray.at(to)));
        if (steps < 0) return;
      }
      poll();
      const int axis =
          next[0] < next[1] ? (next[0] < next[2] ? 0 : 2) : (next[1] < next[2] ? 1 : 2);
      const double until = std::max(from, std::min(next[axis], to));
      if (enter_part(search, ray, direction, index, from, until) || next[axis] >= to) return;
      from = until;
      index[axis] += along[axis] > 0 ? 1 : -1;
      next[axis] = crossing(index[axis], axis, along[axis], origin[axis]);
    }
  }

 private:
  // Products with 0 add nothing.
  HWY_INLINE Vec3 along_grid(Vec3 v) const {
    return is_turned_ ? grid_.rotation.apply_inverse(v) : v;
  }
  HWY_INLINE Vec3 to_grid(Vec3 p) const { return along_grid(p - grid_.origin); }

  HWY_INLINE double crossing(int64_t index, int axis, double along, double origin) const {
    const double plane = static_cast<double>(index + (along > 0)) * part_size_[axis];
    return along == 0 ? infinity : (plane - origin) / along;
  }

  HWY_NOINLINE int64_t difference(Vec3 start, Vec3 last) const {
    int64_t cells = 0;
    for (int axis = 0; axis < 3; ++axis)
      cells += std::abs(walked_index(last[axis], part_size_[axis]) -
                        walked_index(start[axis], part_size_[axis]));
    return cells;
  }

  /// Returns whether the ray enters a strut in a part of a cell, which it crosses from `begin` to
  /// `end`.
  HWY_INLINE bool enter_part(RaySearch& search, const Ray& ray, Vec3 direction,
                             const int64_t (&index)[3], double begin, double end) {
    const int64_t last = (int64_t{1} << shift_) - 1;
    const StrutLists::Run run = parts_.run(static_cast<size_t>(
        (((index[2] & last) << shift_ | (index[1] & last)) << shift_) | (index[0] & last)));
    cell_index_ = {static_cast<double>(index[0] >> shift_), static_cast<double>(index[1] >> shift_),
                   static_cast<double>(index[2] >> shift_)};
    const CapsuleList::Ray local{to_grid(ray.at(begin)) - cell_index_ * grid_.cell_size, direction,
                                 end - begin + 2 * tolerance_, radius_};
    CapsuleList::Met* const met = met_.data();
    size_t count = meet_capsules(arrays_, run.begin, run.end, local, met);
    if (count == 0) return false;
    for (size_t i = 0; i < count; ++i) {
      met[i].enter = begin + met[i].enter;
      met[i].leave = begin + met[i].leave;
    }
    const double from = std::max(search.from, begin - tolerance_);
    double first = infinity;
    uint32_t strut = 0;
    while (count > 0) {
      size_t next = 0;
      for (size_t i = 1; i < count; ++i)
        if (met[i].enter < met[next].enter) next = i;
      const CapsuleList::Met candidate = met[next];
      if (candidate.enter > std::min(first, end) + formula_error * cell_) break;
      met[next] = met[--count];
      double t;
      if (enter_strut(ray, candidate, from, std::min(first, end + tolerance_), t) && t < first) {
        first = t;
        strut = candidate.capsule;
      }
    }
    if (first > end + tolerance_) return false;
    search.found = true;
    search.t = std::min(first, search.to);
    search.normal = normal_of(strut, ray.at(search.t));
    return true;
  }

  HWY_INLINE bool enter_strut(const Ray& ray, const CapsuleList::Met& candidate, double from,
                              double to, double& t) const {
    const double enter = std::max(candidate.enter, from), leave = std::min(candidate.leave, to);
    const bool is_short = candidate.leave - candidate.enter < short_part * cell_;
    const uint32_t strut = candidate.capsule;
    // As settle_entry().
    t = enter;
    if (is_in(is_short, strut, ray.at(t))) {
      for (double step = tolerance_; t > from; step *= 2) {
        const double before = std::max(from, enter - step);
        if (!is_in(is_short, strut, ray.at(before))) {
          t = bisect_entry(is_short, strut, ray, before, t);
          break;
        }
        t = before;
      }
      return true;
    }
    if (const double beyond = std::min(t + tolerance_, to);
        is_in(is_short, strut, ray.at(beyond))) {
      t = beyond;
      return true;
    }
    const double middle = 0.5 * (enter + leave);
    if (!(middle > enter) || !is_in(is_short, strut, ray.at(middle))) return false;
    t = bisect_entry(is_short, strut, ray, enter, middle);
    return true;
  }

  /// As bisect().
  HWY_INLINE double bisect_entry(bool is_short, uint32_t strut, const Ray& ray, double before,
                                 double beyond) const {
    while (beyond - before > tolerance_) {
      const double middle = 0.5 * (before + beyond);
      if (!(middle > before && middle < beyond)) break;
      (is_in(is_short, strut, ray.at(middle)) ? beyond : before) = middle;
    }
    return beyond;
  }

  HWY_INLINE bool is_in(bool is_short, uint32_t strut, Vec3 p) const {
    if (HWY_UNLIKELY(is_short)) return structure_.inside(p);
    const double own = arrays_.of[7][strut] * radius_;
    const Vec3 way = axis(strut).way_to(locate(p));
    return dot(way, way) <= own * own;
  }

  HWY_INLINE Segment axis(uint32_t i) const {
    Segment s;
    s.a = {arrays_.of[0][i], arrays_.of[1][i], arrays_.of[2][i]};
    s.ab = {arrays_.of[3][i], arrays_.of[4][i], arrays_.of[5][i]};
    s.inverse_length_squared = arrays_.of[6][i];
    return s;
  }

  /// As Neighbourhood::locate(), from the corner of the current cell.
  HWY_INLINE Vec3 locate(Vec3 p) const {
    const Vec3 g = to_grid(p);
    const auto along = [](double at, double size, double cell) HWY_ATTR {
      const double c = at / size, floor = std::floor(c);
      return ((c - floor) + (floor - cell)) * size;
    };
    return {along(g.x, grid_.cell_size.x, cell_index_.x),
            along(g.y, grid_.cell_size.y, cell_index_.y),
            along(g.z, grid_.cell_size.z, cell_index_.z)};
  }

  HWY_INLINE Vec3 normal_of(uint32_t strut, Vec3 p) const {
    const Vec3 away = axis(strut).way_to(locate(p));
    const double distance = length(away);
    if (!(distance > 0)) return {};
    const Vec3 normal = grid_.rotation.apply(away * (1 / distance));
    const double size = length(normal);
    return size > 0 && size < infinity ? normal * (1 / size) : Vec3{};
  }

  // As in StrutRays.
  static constexpr double formula_error = 1e-6, short_part = 0x1p-12;

  const Structure& structure_;
  const Neighbourhood grid_;
  const CellParts& parts_;
  const CapsuleList::Arrays arrays_;
  std::vector<CapsuleList::Met> met_;
  const Job* const job_;
  const double radius_, cell_;
  const bool is_turned_;
  int shift_ = 0;  // of the index of a part, to that of its cell
  double part_size_[3];
  double tolerance_ = 0;  // of the current ray
  Vec3 cell_index_;       // of the current part
};

void enter_all(const Structure& structure, const CellParts& parts, double radius,
               RaySearch* searches, size_t count, const Job* job) {
  ConstantStruts struts(structure, parts, radius, job);
  for (size_t i = 0; i < count; ++i) struts.enter(searches[i]);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

HWY_EXPORT(enter_all);

void enter_constant_struts(const Structure& structure, const CellParts& parts, double radius,
                           RaySearch* searches, size_t count, const Job* job) {
  HWY_DYNAMIC_DISPATCH(enter_all)(structure, parts, radius, searches, count, job);
}

}  // namespace msq
#endif  // HWY_ONCE
