// SPDX-License-Identifier: Apache-2.0
// Rays through a voxel image. Within a cell the function along a ray is a cubic, and its
// coefficients in Bernstein's form enclose it. The interval is bisected, the first half first,
// until a half has no root or just one. Membership corrects the result. Sources: Parker, Shirley,
// Livnat, Hansen and Sloan, "Interactive ray tracing for isosurface rendering", 1998 (cells and
// their cubics, blocks by minimum and maximum value); Lane and Riesenfeld, "Bounds on a
// polynomial", 1981 (bisection).
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

#include "shape/voxels.h"

namespace msq {

class Voxels::RayWalk {
 public:
  RayWalk(const Voxels& voxels, bool wanted, const Ray& ray, const Job* job)
      : voxels_(voxels),
        image_(voxels.image_),
        wanted_(wanted),
        ray_(ray),
        poll_(job),
        tolerance_(voxels.ray_tolerance()),
        origin_(image_.to_voxels(ray.origin)),
        along_(image_.frame().rotation.apply_inverse(ray.direction) * image_.scale()) {
    const double reach = max_magnitude(voxels.bounds().min) + max_magnitude(voxels.bounds().max);
    position_slack_ = image_.position_slack(reach + max_magnitude(ray.origin));
    // Along each axis a cell's function changes by no more than the range of its corners.
    slack_of_range_ = 2 * length(image_.scale()) * position_slack_;
    sign_ = (voxels.solid_ == Solid::above) == wanted ? 1 : -1;
  }

  /// Whether the ray runs along the faces of cells, closer than rounding can resolve, for longer
  /// than the tolerance. Then neither of the two cells alone decides.
  bool hugs_faces(double from, double to) const {
    for (int axis = 0; axis < 3; ++axis) {
      const double off = 2 * position_slack_ * image_.scale()[axis];
      if (std::abs(along_[axis]) * tolerance_ > 4 * off) continue;
      const double a = origin_[axis] + along_[axis] * from, b = origin_[axis] + along_[axis] * to;
      if (std::floor(std::max(a, b) + off) >= std::ceil(std::min(a, b) - off)) return true;
    }
    return false;
  }

  bool find(double from, double to, double& t) {
    t = from;
    const double last = to;
    if (!clip_to_image(from, to)) return !wanted_;
    if (find_within(from, to, t)) return true;
    // Beyond the image nothing is inside.
    t = to;
    return !wanted_ && to < last;
  }

 private:
  bool find_within(double from, double to, double& t) {
    if (is_there(from)) {
      t = from;
      return true;
    }
    uint64_t cell[3];
    for (int axis = 0; axis < 3; ++axis)
      cell[axis] = image_.locate(origin_[axis] + along_[axis] * from, axis).cell;
    // Each round leaves a block along one axis, and never goes back. So there are at most as many
    // rounds as cells along the three axes.
    for (double at = from; at < to;) {
      poll_();
      uint64_t low[3], high[3];
      const bool may_change = block_about(cell, low, high);
      double end = std::numeric_limits<double>::infinity();
      int out = 0;
      for (int axis = 0; axis < 3; ++axis) {
        if (along_[axis] == 0) continue;
        const double face = static_cast<double>(along_[axis] > 0 ? high[axis] : low[axis]);
        const double here = (face - origin_[axis]) / along_[axis];
        if (here >= end) continue;
        end = here;
        out = axis;
      }
      end = std::max(at, std::min(end, to));
      if (may_change && find_in_cell(cell, at, end, t)) return true;
      for (int axis = 0; axis < 3; ++axis) {
        if (axis == out) continue;
        const double u = origin_[axis] + along_[axis] * end;
        const uint64_t first = along_[axis] > 0 ? cell[axis] : low[axis];
        const uint64_t last = along_[axis] < 0 ? cell[axis] : high[axis] - 1;
        cell[axis] = std::clamp(image_.locate(u, axis).cell, first, last);
      }
      if (along_[out] > 0 ? high[out] >= image_.cells(out) : low[out] == 0) return false;
      cell[out] = along_[out] > 0 ? high[out] : low[out] - 1;
      at = end;
    }
    return false;
  }

  bool is_there(double t) const { return voxels_.inside(ray_.at(t)) == wanted_; }

  bool clip_to_image(double& from, double& to) const {
    const Vec3 around{border, border, border};
    Box3 box{Vec3{} - around, around};
    for (int axis = 0; axis < 3; ++axis) box.max[axis] += static_cast<double>(image_.cells(axis));
    return clip_to_box({origin_, along_}, box, from, to);
  }

  /// Whether there may be a change in the block [low, high) of cells around a cell. The block is
  /// that cell, or larger if it contains no change.
  bool block_about(const uint64_t (&cell)[3], uint64_t (&low)[3], uint64_t (&high)[3]) const {
    const auto& levels = image_.bounds().levels();
    const Side none = wanted_ ? Side::outside : Side::inside;
    const auto is_none = [&](size_t level) {
      const unsigned bits = ImageBounds::leaf_bits + static_cast<unsigned>(level);
      return voxels_.side(levels[level].at(cell[0] >> bits, cell[1] >> bits, cell[2] >> bits)) ==
             none;
    };
    size_t blocks = 0;
    while (blocks < levels.size() && is_none(blocks)) ++blocks;
    const unsigned bits =
        blocks == 0 ? 0 : ImageBounds::leaf_bits + static_cast<unsigned>(blocks - 1);
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = cell[axis] >> bits << bits;
      high[axis] = std::min(((cell[axis] >> bits) + 1) << bits, image_.cells(axis));
    }
    return blocks == 0;
  }

  /// A cubic over [0, 1]: how far the function is on the wanted side.
  using Cubic = std::array<double, 4>;

  bool find_in_cell(const uint64_t (&cell)[3], double from, double to, double& t) {
    if (!(to > from)) return false;
    double v[8];  // bit 0: x, 1: y, 2: z
    image_.corners(cell, v);
    slack_ = slack_of(v);
    bool may_be = false;
    for (double& value : v) {
      value = sign_ * (value - voxels_.threshold_);
      may_be = may_be || value >= -slack_;
    }
    if (!may_be) return false;
    // The trilinear function is affine along each axis. Its values at the corners of the box around
    // the ray's part give the cubic's coefficients (its blossom).
    double f[3], g[3];
    for (int axis = 0; axis < 3; ++axis) {
      const double corner = static_cast<double>(cell[axis]);
      f[axis] = origin_[axis] + along_[axis] * from - corner;
      g[axis] = origin_[axis] + along_[axis] * to - corner;
    }
    for (int axis = 0; axis < 3; ++axis)
      for (int i = 0; i < 8; ++i) {
        if (i >> axis & 1) continue;
        double &a = v[i], &b = v[i | 1 << axis];
        const double step = b - a, base = a;
        a = base + f[axis] * step;
        b = base + g[axis] * step;
      }
    const Cubic cubic{v[0], (v[1] + v[2] + v[4]) / 3, (v[3] + v[5] + v[6]) / 3, v[7]};
    return find_in(cubic, from, to, t);
  }

  /// By how much the values of a cubic may be off in the cell with these corners. That of the whole
  /// image would be too much where another cell has a value of great magnitude, as for missing
  /// data.
  double slack_of(const double (&corners)[8]) const {
    const auto [low, high] = std::minmax_element(std::begin(corners), std::end(corners));
    return 4 * Image::value_slack(std::max(std::abs(*low), std::abs(*high))) +
           (*high - *low) * slack_of_range_;
  }

  /// Finds the start of the first part of [from, to] that is wanted.
  bool find_in(const Cubic& c, double from, double to, double& t) {
    const double most = std::max(std::max(c[0], c[1]), std::max(c[2], c[3]));
    if (most < -slack_) return false;
    const double least = std::min(std::min(c[0], c[1]), std::min(c[2], c[3]));
    if (c[0] < -slack_ && c[3] > slack_) {
      const int changes = (c[0] < 0) != (c[1] < 0) ? 1 : 0;
      const int all = changes + ((c[1] < 0) != (c[2] < 0)) + ((c[2] < 0) != (c[3] < 0));
      if (all == 1) return settle(from, to, root_of(c), t) || settle_by_steps(from, to, t);
    }
    // Too short to resolve, or nearly 0 everywhere.
    if (to - from <= tolerance_ || (most <= slack_ && least >= -slack_))
      return settle_by_steps(from, to, t);
    if (c[0] > slack_)
      return settle_by_steps(from, std::min(to, from + tolerance_), t) ||
             (from + tolerance_ < to && settle_by_steps(from, to, t));
    const double middle = 0.5 * (from + to);
    if (!(middle > from && middle < to)) return settle_by_steps(from, to, t);
    const double ab = 0.5 * (c[0] + c[1]), bc = 0.5 * (c[1] + c[2]), cd = 0.5 * (c[2] + c[3]);
    const double abc = 0.5 * (ab + bc), bcd = 0.5 * (bc + cd), all = 0.5 * (abc + bcd);
    return find_in({c[0], ab, abc, all}, from, middle, t) ||
           find_in({all, bcd, cd, c[3]}, middle, to, t);
  }

  /// The root in (0, 1) of a cubic that goes from below 0 to above.
  static double root_of(const Cubic& c) {
    double low = 0, high = 1, s = -c[0] / (c[3] - c[0]);
    for (int i = 0; i < 40 && high - low > 0x1p-50; ++i) {
      const double r = 1 - s;
      const double value = r * r * (r * c[0] + 3 * s * c[1]) + s * s * (3 * r * c[2] + s * c[3]);
      (value < 0 ? low : high) = s;
      const double slope =
          3 * (r * r * (c[1] - c[0]) + 2 * r * s * (c[2] - c[1]) + s * s * (c[3] - c[2]));
      const double newton = s - value / slope;
      const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
      if (std::abs(next - s) < 0x1p-52) break;
      s = next;
    }
    return s;
  }

  /// Finds the change about a part of [from, to] by membership. Returns false if there is none.
  bool settle(double from, double to, double part, double& t) const {
    const double middle = from + part * (to - from);
    double before = std::max(from, middle - 0.5 * tolerance_);
    double beyond = std::min(to, middle + 0.5 * tolerance_);
    if (is_there(before)) before = from;
    if (!is_there(beyond)) beyond = to;
    if (!is_there(beyond)) return false;
    if (is_there(before)) {
      t = before;
      return true;
    }
    t = bisect(before, beyond, tolerance_, [&](double at) { return is_there(at); });
    return true;
  }

  bool settle_by_steps(double from, double to, double& t) const {
    constexpr int steps = 4;
    double before = from;
    for (int i = 0; i <= steps; ++i) {
      const double at = i == steps ? to : from + (to - from) * i / steps;
      if (is_there(at)) {
        t = bisect(before, at, tolerance_, [&](double middle) { return is_there(middle); });
        return true;
      }
      before = at;
    }
    return false;
  }

  const Voxels& voxels_;
  const Image& image_;
  const bool wanted_;
  const Ray ray_;
  JobPoll poll_;
  const double tolerance_;
  const Vec3 origin_, along_;  // in voxels
  double position_slack_ = 0;  // in model units
  double slack_of_range_ = 0;  // of values, for each unit between those of a cell's corners
  double slack_ = 0;           // of values in the current cell, as the cubics have them
  double sign_ = 1;
};

bool Voxels::find(bool wanted, const Ray& ray, double from, double to, double& t,
                  const Job* job) const {
  RayWalk walk(*this, wanted, ray, job);
  if (!walk.hugs_faces(from, to)) return walk.find(from, to, t);
  return march(wanted, ray, from, to, t, job);
}

bool Voxels::enter(const Ray& ray, double from, double to, double& t, const Job* job) const {
  return clip_to_box(ray, bounds(), from, to) && find(true, ray, from, to, t, job);
}

Vec3 Voxels::normal(const Ray& ray, double t) const {
  const Rotation& rotation = image_.frame().rotation;
  const Vec3 u = image_.to_voxels(ray.at(t));
  const Vec3 along = rotation.apply_inverse(ray.direction) * image_.scale();
  // Hits are rounded, and settled within the tolerance of rays.
  const double near = border + max_component(image_.scale()) * ray_tolerance() * 4;
  const double step = near / length(along);
  const Vec3 before = u - along * step, behind = u + along * (4 * ray_tolerance() + step);
  Vec3 of_face;
  double steepest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double last = static_cast<double>(image_.cells(axis));
    const bool is_on_face = along[axis] > 0 ? u[axis] <= near : u[axis] >= last - near;
    if (!is_on_face || !(std::abs(along[axis]) > steepest)) continue;
    steepest = std::abs(along[axis]);
    of_face = {};
    of_face[axis] = along[axis] > 0 ? -1 : 1;
  }
  if (steepest > 0 && solid(image_.value(before)) && solid(image_.value(behind)))
    return rotation.apply(of_face);
  // Of the cell that the ray comes from: linear along each axis from one end to the other.
  Vec3 gradient;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 low = before, high = before;
    low[axis] = static_cast<double>(image_.locate(before[axis], axis).cell);
    high[axis] = low[axis] + 1;
    gradient[axis] = (image_.value(high) - image_.value(low)) * image_.scale()[axis];
  }
  const double steepness = length(gradient);
  if (!(steepness > 0 && std::isfinite(steepness))) return Shape::normal(ray, t);
  const double sign = solid_ == Solid::above ? -1 : 1;
  const Vec3 outward = rotation.apply(gradient * (sign / steepness));
  return dot(outward, ray.direction) > 0 ? Shape::normal(ray, t) : outward;
}

double Voxels::leave(const Ray& ray, double from, double to, const Job* job) const {
  if (!clip_to_box(ray, bounds(), from, to)) return from;
  double t;
  return find(false, ray, from, to, t, job) ? t : to;
}

}  // namespace msq
