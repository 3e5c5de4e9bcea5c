// SPDX-License-Identifier: Apache-2.0
// What rays hit, against dense samples of membership: it differs about a hit, and changes nowhere
// before. Normals are the gradient of the onset, and point out.
#pragma once

#include <vector>

#include "base/ray_normal.h"
#include "flat_boundary.h"
#include "structures.h"

namespace msq::test {

/// A ray that fails, where failures are counted.
struct RayFailure {};

class RayChecker {
 public:
  /// No coordinate of a ray's points is larger than `max_coordinate`, in the model's frame or from
  /// the grid's origin: hits are then right within 2^-51 of that, and where a ray is no deeper
  /// inside than 2^-52 of it a hit may be overlooked. 0: rounding does not count.
  RayChecker(const StructureRow& row, const Structure& structure, Parameter radius,
             double max_coordinate, bool counts_failures)
      : row_(row),
        structure_(structure),
        radius_(std::move(radius)),
        cell_(min_component(structure.neighbourhood().cell_size)),
        rounding_(0x1p-52 * max_coordinate),
        tolerance_(std::max(structure.ray_tolerance(), 2 * rounding_)),
        // Parts that are shorter may be overlooked.
        part_(std::max(structure.min_ray_step(), tolerance_)),
        normal_step_(std::max(1e-5 * cell_, std::sqrt(rounding_ * cell_))),
        normal_limit_((row.is_lattice() && !row.kind.vary ? 3e-8 : 1e-5) +
                      64 * rounding_ / normal_step_),
        counts_failures_(counts_failures) {}

  RaySearch cast(const Ray& ray, double to) const {
    RaySearch search{ray, 0, to};
    structure_.enter(&search, 1, nullptr);
    return search;
  }

  void check(const RaySearch& search) {
    const Ray& ray = search.ray;
    const double end = search.found ? search.t : search.to;
    window(ray, 0, end, ray_samples);
    if (!search.found) return;
    ++hits;
    const double t = search.t;
    if (t < 0 || t > search.to) fail_at(ray, t, "is out of range");
    if (!structure_.inside(ray.at(t)) && !structure_.inside(ray.at(t + tolerance_)))
      fail_at(ray, t, "is outside");
    if (t > 2 * part_ && is_inside(ray, t - 2 * part_, t - tolerance_, part_samples))
      fail_at(ray, t, "comes late");
    // Where the ray came from, ever nearer.
    for (double width = 0.1 * cell_; width > std::max(1e-8 * cell_, 4 * part_); width *= 0.1)
      window(ray, std::max(0.0, t - width), t, window_samples);
    if (t > 0) check_normal(search);
  }

  /// A point on the ray lies in a part that rays must not overlook.
  bool is_seen(const Ray& ray, double t) const {
    for (double away : {0.0, -1.0, -0.5, 0.5, 1.0})
      if (!is_deep(ray.at(t + away * part_))) return false;
    return is_inside(ray, t - part_, t + part_, window_samples);
  }

  /// It hits at t or before.
  void check_aimed(const RaySearch& search, double t) const {
    if (!search.found || search.t > t + part_) fail_at(search.ray, t, "is inside, and passed");
  }

  /// Between two rays, one beside the other, that meet different surfaces: near the nearer surface.
  void check_graze(Ray near, Ray far, double to, double apart) {
    RaySearch a = cast(near, to), b = cast(far, to);
    const auto end_of = [](const RaySearch& s) { return s.found ? s.t : s.to; };
    if (end_of(a) > end_of(b)) std::swap(a, b);
    while (length(a.ray.origin - b.ray.origin) > apart) {
      Ray middle = a.ray;
      middle.origin = (a.ray.origin + b.ray.origin) * 0.5;
      const RaySearch m = cast(middle, to);
      (std::abs(end_of(m) - end_of(a)) < std::abs(end_of(m) - end_of(b)) ? a : b) = m;
      if (end_of(a) > end_of(b)) std::swap(a, b);
    }
    if (end_of(b) - end_of(a) < 0.01 * cell_) return;  // the same surface
    ++grazes;
    check(a);
    for (double width = 0.1 * cell_; width > std::max(1e-6 * cell_, 4 * part_); width *= 0.25)
      window(b.ray, std::max(0.0, end_of(a) - width), std::min(end_of(b), end_of(a) + width),
             window_samples);
  }

  size_t hits = 0, grazes = 0, normals = 0;
  size_t outward = 0, inward = 0;  // normals
  Flatness flatness;

 private:
  static constexpr size_t ray_samples = 256, window_samples = 64;
  /// Of a part too short for windows: most parts fail soon.
  static constexpr size_t part_samples = 1024;

  /// All samples in [from, to] are inside. Few do not say so: for some tolerances before a ray that
  /// grazes is inside for good, rounding decides, and membership changes from one number to the
  /// next.
  bool is_inside(const Ray& ray, double from, double to, size_t samples) const {
    for (size_t i = 0; i <= samples; ++i) {
      const double part = static_cast<double>(i) / static_cast<double>(samples);
      if (!is_deep(ray.at(from + (to - from) * part))) return false;
    }
    return true;
  }

  /// A point is inside, and by more than rounding.
  bool is_deep(Vec3 p) const {
    if (!structure_.inside(p)) return false;
    if (rounding_ == 0) return true;
    const auto& directions = directions_all_around();
    for (size_t i = 0; i < directions.size(); i += 4)
      if (!structure_.inside(p + directions[i] * rounding_)) return false;
    return true;
  }

  /// All samples in [from, to) are outside, except for parts that may be lost.
  void window(const Ray& ray, double from, double to, size_t samples) {
    points_.clear();
    const auto at = [&](size_t i) {
      return from + (to - from) * static_cast<double>(i) / static_cast<double>(samples);
    };
    for (size_t i = 0; i < samples; ++i) points_.push_back(ray.at(at(i)));
    alive_.assign(samples, 1);
    structure_.keep_points(points_.data(), alive_.data(), samples);
    for (size_t i = 0; i < samples; ++i) {
      if (!alive_[i] || at(i) > to - part_) continue;
      if (is_seen(ray, at(i))) fail_at(ray, to, "has a point inside before it", at(i));
    }
  }

  /// The gradient of the onset by differences, where that is smooth.
  void check_normal(const RaySearch& search) {
    const Vec3 p = search.ray.at(search.t);
    const bool is_found = dot(search.normal, search.normal) > 0;
    const Vec3 n = is_found ? search.normal : structure_.normal(search.ray, search.t);
    if (!(std::abs(length(n) - 1) < 1e-9))
      fail_at(search.ray, search.t, "has a normal of another length");
    const double step = normal_step_;
    const bool is_out = !structure_.inside(p + n * step) && structure_.inside(p - n * step);
    ++(is_out ? outward : inward);
    if (rounding_ == 0)
      flatness.add(
          is_flat_across(p, n, 1e-4 * cell_, [&](Vec3 q) { return structure_.inside(q); }));
    if (!structure_.has_onset()) return;
    Vec3 gradient;
    bool is_smooth = true;
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 along;
      along[axis] = step;
      const Difference wide = differ(p, along), narrow = differ(p, along * 0.6);
      gradient[axis] = wide.slope;
      const double off = std::abs(wide.slope - narrow.slope) + wide.kink;
      is_smooth = is_smooth && off < 0.1 * normal_limit_ * (std::abs(wide.slope) + 1);
    }
    const double size = length(gradient);
    if (!is_smooth || !(size > 0.1)) return;
    // Where it grazes, rounding may hide what was met.
    if (rounding_ > 0 && dot(gradient, search.ray.direction) > -0.05 * size) return;
    ++normals;
    const double off = length(n - gradient * (1 / size));
    if (!(off < normal_limit_)) fail_at(search.ray, search.t, "has another normal", off);
  }

  /// By how much the onset rises above the radius along an axis, and how much that jumps.
  struct Difference {
    double slope, kink;
  };
  Difference differ(Vec3 p, Vec3 step) const {
    double v[5];
    for (int i = 0; i < 5; ++i) {
      const Vec3 q = p + step * (i - 2);
      v[i] = structure_.onset(q) - radius_.at(q);
    }
    const double h = length(step);
    const double bend = v[1] - 2 * v[2] + v[3], wide_bend = v[0] - 2 * v[2] + v[4];
    return {(8 * (v[3] - v[1]) - (v[4] - v[0])) / (12 * h),
            std::abs(wide_bend - 4 * bend) / (4 * h)};
  }

  void fail_at(const Ray& ray, double t, const char* what, double at = 0) const {
    print_error("%s: ray (%.17g, %.17g, %.17g) + t (%.17g, %.17g, %.17g): t = %.17g %s (%.17g)\n",
                row_.name.c_str(), ray.origin.x, ray.origin.y, ray.origin.z, ray.direction.x,
                ray.direction.y, ray.direction.z, t, what, at);
    if (counts_failures_) throw RayFailure{};
    _fail(__FILE__, __LINE__);
  }

  const StructureRow& row_;
  const Structure& structure_;
  const Parameter radius_;
  const double cell_, rounding_, tolerance_, part_, normal_step_, normal_limit_;
  const bool counts_failures_;
  std::vector<Vec3> points_;
  std::vector<uint8_t> alive_;
};

}  // namespace msq::test
