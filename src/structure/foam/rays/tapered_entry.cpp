// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/rays/tapered_entry.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace msq {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// Growing steps for rays that creep, as those of RayMarch.
class Creep {
 public:
  explicit Creep(double least) : least_(least) {}

  double least() const { return least_; }
  void step() {
    if (++steps_ % 64 == 0) least_ *= 2;
  }

 private:
  double least_;
  int steps_ = 0;
};

}  // namespace

TaperedStrut::TaperedStrut(const FoamData& foam, const FoamRay& ray, const StrutLine& strut)
    : foam_(foam), ray_(ray), strut_(strut), tolerance_(ray.tolerance) {
  const Vec3 u = ray.direction;
  Vec3 w;
  if (strut.has_line) {
    const Vec3 o = ray.origin - strut.home;
    t0_ = dot(foam.seeds().scale() * 0.5 - o, u);
    w = o + u * t0_ - strut.line.seed - strut.line.offset;
  } else {
    const Vec3 o = ray.origin - strut.corner;
    t0_ = dot(strut.a - o, u);
    w = o + u * t0_ - strut.a;
  }
  p_ = w - strut.along * dot(w, strut.along);
  q_ = u - strut.along * dot(u, strut.along);
  // Membership also evaluates the field, at points known within the ray's error.
  const double slope = std::min(foam.radius().lipschitz(), 64.0);
  error_ = ray.error * (1 + slope) + (strut.has_line ? strut.error : 2 * end_error);
}

double TaperedStrut::radius(double t) const {
  return foam_.radius().at(ray_.model_point(t, foam_.unit())) / foam_.unit() +
         (strut_.has_line ? 0 : end_error);
}

double TaperedStrut::distance_slope(double t) const {
  const Vec3 v = across(t);
  const double d = length(v);
  return d > 0 ? dot(v, q_) / d : length(q_);
}

double TaperedStrut::beyond_ends(double t) const {
  const double s = dot(ray_.at(t) - strut_.corner - strut_.a, strut_.along);
  return std::max(std::min(0.0, strut_.length) - s, s - std::max(0.0, strut_.length));
}

bool TaperedStrut::clip_to_ends(double room, double& from, double& to) const {
  const double low = std::min(0.0, strut_.length) - room,
               high = std::max(0.0, strut_.length) + room;
  const double at = dot(ray_.at(t0_) - strut_.corner - strut_.a, strut_.along);
  const double by = dot(ray_.direction, strut_.along);
  if (std::abs(by) < 1e-12) return at >= low && at <= high;
  const double one = t0_ + (low - at) / by, other = t0_ + (high - at) / by;
  from = std::max(from, std::min(one, other));
  to = std::min(to, std::max(one, other));
  return from <= to;
}

bool TaperedStrut::clip_to_radius(double radius, double& from, double& to) const {
  const double qq = dot(q_, q_), pq = dot(p_, q_);
  const double under = pq * pq - qq * (dot(p_, p_) - radius * radius);
  if (qq < 1e-24) return dot(p_, p_) <= radius * radius;
  if (under < 0) return false;
  const double middle = t0_ - pq / qq, half = std::sqrt(under) / qq;
  from = std::max(from, middle - half);
  to = std::min(to, middle + half);
  return from <= to;
}

/// The first t from `at` on, outside, with distance(t) <= radius + slope (t - at), where a radius
/// below 0 counts as 0; infinite if there is none.
double TaperedStrut::first_within_cone(double at, double radius, double slope) const {
  if (radius < 0) {
    if (!(slope > 0)) return never;
    at -= radius / slope;
    radius = 0;
  }
  const Vec3 v = across(at);
  const double a = dot(q_, q_) - slope * slope, b = dot(v, q_) - radius * slope;
  const double c = dot(v, v) - radius * radius;
  if (c <= 0) return at;
  const double under = b * b - a * c;
  if (under < 0) return never;
  const double sum = std::sqrt(under) - b;
  if (!(sum > 0)) return never;
  const double by = c / sum;
  // The other half of the cone does not belong to the strut.
  return radius + slope * by >= 0 ? at + by : never;
}

Box3 TaperedStrut::box(double from, double to) const {
  return box_of(ray_.search->ray, from * foam_.unit(), to * foam_.unit());
}

bool TaperedStrut::approach(double& at, double to) const {
  const Parameter& radius = foam_.radius();
  Vec3 gradient;
  if (radius.is_linear(box(at, to), gradient)) {
    const double slope = dot(gradient, ray_.search->ray.direction);
    return approach_by_slopes(slope, slope, at, to);
  }
  const double lipschitz = radius.lipschitz(box(at, to));
  return lipschitz < never ? approach_by_slopes(-lipschitz, lipschitz, at, to)
                           : approach_by_ranges(at, to);
}

bool TaperedStrut::approach_by_slopes(double min_slope, double max_slope, double& at,
                                      double to) const {
  constexpr double room = 1e-6;  // for the rounding of slopes
  double r = radius(at);
  for (Creep creep(0.5 * tolerance_);; creep.step()) {
    const double safe = first_within_cone(at, r, max_slope);
    if (!(safe <= to)) return false;
    // True where the gap falls everywhere up to `end`, and is below 0 there.
    const double falls = min_slope - room - distance_slope(at);
    if (safe - at > tolerance_ && falls > 0) {
      const double end = std::min(to, at + 1.01 * (distance(at) - r) / falls + tolerance_);
      if (distance_slope(end) < min_slope - room && gap(end) <= 0) {
        at = narrow(safe < end && gap(safe) > 0 ? safe : at, end);
        return true;
      }
    }
    double next = std::max(safe, at + creep.least());
    if (!(next > at)) return false;  // steps vanish in rounding
    if (next > to) {
      if (!(to > at)) return false;
      next = to;
    }
    at = next;
    r = radius(at);
    if (distance(at) <= r) return true;
    if (at >= to) return false;
  }
}

// Each advance is by half of creep.least() or more, which doubles every 64 advances: so there are
// no more than 64 (2 + log2((to - at) / tolerance)), or some more where these vanish in rounding.
// Between them the width shrinks to a quarter, down to creep.least(), and grows by advances alone.
bool TaperedStrut::approach_by_ranges(double& at, double to) const {
  const Parameter& radius = foam_.radius();
  const double step = foam_.min_ray_step() / foam_.unit();
  const Interval all = radius.range();
  double width = to - at;
  for (Creep creep(0.5 * tolerance_); at < to;) {
    width = std::max(width, creep.least());
    const double end = std::min(to, at + width);
    const Interval range = radius.range(box(at, end));
    const double safe =
        first_within_cone(at, range.high / foam_.unit() + (strut_.has_line ? 0 : end_error), 0);
    if (!(safe <= end)) {
      creep.step();
      at = end;
      width *= 2;
      continue;
    }
    if (safe - at > 0.5 * width) {
      creep.step();
      at = safe;
      continue;
    }
    at = std::max(at, safe);
    // If the ranges of small boxes are not tighter, samples are used.
    const bool tells = range.high - range.low < 0.5 * (all.high - all.low);
    const double least = tells ? 0x1p-6 * step : step;
    if (width > least) {
      width = std::max(least, 0.25 * width);
      continue;
    }
    double next = std::min(to, at + width);
    if (gap(next) <= 0) {
      if (gap(at) > 0) at = narrow(at, next);
      return true;
    }
    if (tells && width > creep.least()) {  // its parts that may contain an entry and an exit
      width = std::max(creep.least(), 0.25 * width);
      continue;
    }
    creep.step();
    at = next;
  }
  return false;
}

double TaperedStrut::narrow(double from, double to) const {
  double low = gap(from), high = gap(to);
  if (low <= 0) return from;
  for (int n = 0; to - from > 0.25 * tolerance_; ++n) {
    double middle = 0.5 * (from + to);
    if (n % 4 != 3) {
      // Slightly past the secant's zero, so that both ends converge.
      const double nudge = 0.1 * tolerance_;
      middle = from + (to - from) * (low / (low - high));
      middle += low < -high ? nudge : -nudge;
      middle = std::clamp(middle, from + nudge, to - nudge);
    }
    if (!(middle > from && middle < to)) break;
    const double found = gap(middle);
    (found > 0 ? from : to) = middle;
    (found > 0 ? low : high) = found;
  }
  return to;
}

Vec3 TaperedStrut::normal(double t) const {
  const Vec3 v = across(t);
  const Parameter& radius = foam_.radius();
  const Vec3 gradient = radius.gradient(ray_.model_point(t, foam_.unit()), foam_.normal_distance());
  const Vec3 out = foam_.neighbourhood().rotation.apply(v * (1 / length(v))) - gradient;
  return out * (1 / length(out));
}

StrutEntry StrutEntries::find_tapered(const FoamRay& ray, const StrutLine& strut) const {
  const TaperedStrut tapered(foam_, ray, strut);
  const double error = tapered.error(), tolerance = ray.tolerance, end_room = end_error + error;
  StrutEntry entry;
  double from = ray.from, to = ray.to;
  if (!tapered.clip_to_ends(end_room, from, to)) return entry;
  const double between_ends = from;
  if (!tapered.clip_to_radius(radius_ + error, from, to)) return entry;
  const double gap = tapered.gap(from);
  if (from == ray.from) {
    if (gap <= error) {
      const bool is_sure = gap < -error && tapered.beyond_ends(from) < -end_room;
      if (is_sure || inside(ray, from)) {
        entry.is_met = entry.at_from = true;
        entry.t = from;
        return entry;
      }
      if (from + tolerance < to && inside(ray, from + tolerance))
        return settle(ray, from, from + tolerance);
    }
  } else if (from == between_ends && gap < -error) {
    // Another strut contains a ray that comes in past an end, and has an earlier entry. Where it
    // comes in from the side, the gap is `error`, up to the rounding of clip_to_radius(): that may
    // exceed it if the strut is thin and far from the middle of its owner's cell.
    return entry;
  }
  bool is_there = gap <= 0;
  Creep creep(tolerance);
  for (double at = from;; creep.step()) {
    if (!is_there && !tapered.approach(at, to)) return entry;
    entry = tapered_entry(ray, tapered, at, strut.has_line);
    if (entry.is_met) return entry;
    for (double step = creep.least(); tapered.gap(at) <= 0; step *= 2)
      if ((at += step) > to) return entry;
    is_there = false;
  }
}

StrutEntry StrutEntries::find_tapered_near(const FoamRay& ray, const StrutLine& strut, double about,
                                           double near) const {
  const TaperedStrut tapered(foam_, ray, strut);
  const double from = std::max(ray.from, about - near), to = about + near;
  if (!(tapered.gap(from) > 0 && tapered.gap(to) <= 0)) return {};
  return tapered_entry(ray, tapered, tapered.narrow(from, to), strut.has_line);
}

/// The result is a multiple of half the tolerance, as in settle().
StrutEntry StrutEntries::tapered_entry(const FoamRay& ray, const TaperedStrut& tapered, double at,
                                       bool has_line) const {
  const double step = 0.5 * ray.tolerance, error = tapered.error();
  double n = std::ceil(at / step);
  for (int i = 0; i < 4 && tapered.gap((n - 1) * step) <= 0; ++i) --n;
  const double t = std::max(ray.from, n * step);
  const auto entry_at = [&](double found, bool is_sure) {
    StrutEntry entry;
    entry.is_met = true;
    entry.is_sure = is_sure && has_line;
    entry.by_ends = !has_line;
    entry.t = found;
    // The settled entry may belong to another strut.
    if (std::abs(tapered.gap(found)) <= error + 64 * ray.tolerance)
      entry.normal = tapered.normal(found);
    return entry;
  };
  const auto is_between_ends = [&](double place) {
    return tapered.beyond_ends(place) < -(end_error + error);
  };
  if (tapered.gap((n - 1) * step) > error && tapered.gap(n * step) < -error && is_between_ends(t))
    return entry_at(t, true);
  // If rounding leaves a doubt, membership decides: from where the ray is certainly outside to
  // where it is certainly inside.
  const double most = has_line ? 0.5 * double(ray_list_margin) * 0.0625 : 1;
  double before = t - step, after = t;
  for (double by = step; tapered.gap(before) <= error && by < most; by *= 2) before = t - 2 * by;
  for (double by = step; tapered.gap(after) >= -error && by < most; by *= 2) after = t + by;
  if (before > ray.from && after <= ray.to && tapered.gap(before) > error &&
      tapered.gap(after) < -error && is_between_ends(before) && is_between_ends(after))
    return entry_at(settle(ray, before, after).t, true);
  before = std::max(before, ray.from);
  StrutEntry entry;
  if (inside(ray, before)) {
    // If this is not the ray's start, then another strut contains the point, and has an earlier
    // entry.
    entry = entry_at(t, false);
    entry.at_from = before == ray.from;
    if (entry.at_from) entry.t = ray.from;
    return entry;
  }
  const auto settled = [&](double seen) {
    if (seen > before && inside(ray, seen)) entry = entry_at(settle(ray, before, seen).t, false);
    return entry.is_met;
  };
  after = t;
  if (settled(t)) return entry;
  for (double by = step; by < most; by *= 2) {
    after = t + by;
    if (settled(after) || tapered.gap(after) > error) break;
  }
  // A graze: around the deepest point in the strut.
  double low = t, high = after;
  for (int i = 0; i < 64 && high - low > step; ++i) {
    const double one = low + (high - low) / 3, other = high - (high - low) / 3;
    if (tapered.gap(one) > tapered.gap(other))
      low = one;
    else
      high = other;
  }
  const double deepest = 0.5 * (low + high);
  for (double by = 0; !entry.is_met && by < after - t; by = std::max(step, 2 * by))
    if (!settled(deepest - by)) settled(deepest + by);
  return entry;
}

}  // namespace msq
