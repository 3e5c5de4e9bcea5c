// SPDX-License-Identifier: Apache-2.0
#include "shape/primitive.h"

#include <limits>
#include <vector>

#include "base/hash_input.h"
#include "base/pi.h"
#include "base/unit.h"

namespace msq {

namespace {

/// Distance to the nearest edge or wall of two walls at right angles, from a point that lies beyond
/// (positive) or within (negative) each of them.
double corner_distance(double beyond_one, double beyond_other) {
  if (beyond_one <= 0 && beyond_other <= 0) return std::min(-beyond_one, -beyond_other);
  return std::hypot(std::max(beyond_one, 0.0), std::max(beyond_other, 0.0));
}

/// Narrows [from, to] to where a + 2 b t + c t^2 <= 0, c >= 0.
bool clip_to_quadratic(double a, double b, double c, double& from, double& to) {
  if (c == 0) return a <= 0 && from <= to;
  const double discriminant = b * b - a * c;
  if (discriminant < 0) return false;
  const double root = std::sqrt(discriminant);
  // The root of larger magnitude without cancellation, the other by their product.
  const double q = b > 0 ? -b - root : -b + root;
  const double one = q / c, other = q != 0 ? a / q : one;
  from = std::max(from, std::min(one, other));
  to = std::min(to, std::max(one, other));
  return from <= to;
}

/// Finds where a ray enters and leaves a shape, given the section of the ray, [low, high], up to
/// rounding, and membership. Returns false if there is nothing but rounding.
template <class Inside>
bool cross_section(const Ray& ray, double from, double to, double low, double high,
                   double tolerance, Inside&& is_in, double& t, double& end) {
  t = low;
  if (!settle_entry(ray, from, to, tolerance, is_in, t)) {
    // A graze: rounding moves the ends of a section much more than its middle.
    const double middle = 0.5 * (low + high);
    if (!(middle > low) || !is_in(ray.at(middle))) return false;
    t = bisect(low, middle, tolerance, [&](double at) { return is_in(ray.at(at)); });
  }
  end = std::max(t, low) <= high ? high : t;  // as leave() from t on
  return true;
}

}  // namespace

bool Primitive::enter(const Ray& ray, double from, double to, double& t, const Job* job) const {
  double end;
  return cross(ray, from, to, t, end, job);
}

bool Primitive::cross(const Ray& ray, double from, double to, double& t, double& end,
                      const Job*) const {
  const auto is_in = [this](Vec3 p) { return inside(p); };
  double low = from, high = to;
  return section(ray, 0, low, high) &&
         cross_section(ray, from, to, low, high, ray_tolerance(), is_in, t, end);
}

double Primitive::leave(const Ray& ray, double from, double to, const Job*) const {
  double low = from, high = to;
  return section(ray, 0, low, high) ? high : from;
}

// The tolerance is far above the effect of rounding on sections and inside(). Samples in the
// section of the shape reduced by it are inside; samples beyond that of the enlarged shape are
// outside. If a row grazes the shape, rounding moves a section's ends farther, but not past those
// of the other two: squares of radii differ by far more than the rounding of squares.
void Primitive::fill_rows(const RowBlock& block) const {
  const SampleGrid& grid = *block.grid;
  const double tolerance = ray_tolerance(), size = bounds().extent().x;
  for_each_row_in_bounds(block,
                         [&](double y, double z, uint64_t* row, uint64_t first, uint64_t end) {
                           const Ray ray{{bounds().min.x, y, z}, {1, 0, 0}};
                           const auto range = [&](double grow, uint64_t& low, uint64_t& high) {
                             double from = -size, to = 2 * size;
                             low = high = end;
                             if (!section(ray, grow, from, to)) return;
                             const auto sample = [&](double t) {
                               return std::clamp(grid.first_x_from(bounds().min.x + t), first, end);
                             };
                             low = sample(from);
                             high = std::max(low, sample(to));
                           };
                           uint64_t low, high, inner_low, inner_high;
                           range(tolerance, low, high);
                           range(-tolerance, inner_low, inner_high);
                           if (inner_low >= inner_high) inner_low = inner_high = high;
                           const auto ask = [&](uint64_t from, uint64_t to) {
                             for (uint64_t i = from; i < to; ++i)
                               if (inside({grid.x(i), y, z})) set_bits(row, i, i);
                           };
                           ask(low, std::min(inner_low, high));
                           if (inner_low < inner_high) set_bits(row, inner_low, inner_high - 1);
                           ask(inner_high, high);
                         });
}

BoxShape::BoxShape(const Box3& box) {
  const Vec3 e = box.extent();
  facts_.bounds = box;
  facts_.volume = e.x * e.y * e.z;
  facts_.area = 2 * (e.x * e.y + e.y * e.z + e.z * e.x);
}

void BoxShape::fill_rows(const RowBlock& block) const {
  for_each_row_in_bounds(block, [](double, double, uint64_t* row, uint64_t first, uint64_t end) {
    set_bits(row, first, end - 1);
  });
}

/// Subtracts the possible error of a difference and a root, each within a few units of 2^-53.
constexpr double box_rounding = 1 - 0x1p-50;

Vec3 BoxShape::normal(const Ray& ray, double t) const {
  const Vec3 p = ray.at(t);
  double nearest = std::numeric_limits<double>::infinity();
  Vec3 normal = ray.direction * -1.0;
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side) {
      const double gap = std::abs(p[axis] - (side ? bounds().max : bounds().min)[axis]);
      const bool faces = side ? ray.direction[axis] < 0 : ray.direction[axis] > 0;
      if (!faces || gap >= nearest) continue;
      nearest = gap;
      normal = {};
      normal[axis] = side ? 1 : -1;
    }
  return normal;
}

double BoxShape::distance_bound(Vec3 p) const {
  const Vec3 beyond = max(bounds().min - p, p - bounds().max);
  const Vec3 gap = max(beyond, Vec3{});
  const double distance =
      max_component(beyond) > 0 ? std::hypot(gap.x, gap.y, gap.z) : -max_component(beyond);
  return distance * box_rounding;
}

// The depth is the minimum of one number per axis, so a sample is shallow by its x, its y or its z
// alone.
bool BoxShape::fill_shallow_rows(double depth, const RowBlock& block) const {
  const SampleGrid& grid = *block.grid;
  const auto is_shallow = [&](int axis, double at) {
    return -std::max(bounds().min[axis] - at, at - bounds().max[axis]) * box_rounding <= depth;
  };
  std::vector<uint64_t> all(block.row_words()), ends(block.row_words());
  set_bits(all.data(), 0, grid.nx - 1);
  for (uint64_t i = 0; i < grid.nx; ++i)
    if (is_shallow(0, grid.x(i))) set_bits(ends.data(), i, i);
  for (uint64_t k = block.z0; k < block.z1; ++k)
    for (uint64_t j = block.y0; j < block.y1; ++j) {
      const bool is_all = is_shallow(2, grid.z(k)) || is_shallow(1, grid.y(j));
      std::copy_n((is_all ? all : ends).data(), block.row_words(), block.row(j, k));
    }
  return true;
}

SphereShape::SphereShape(Vec3 centre, double radius)
    : centre_(centre), radius_(radius), radius_squared_(radius * radius) {
  facts_.bounds = Box3{centre, centre}.grown(radius);
  facts_.volume = 4.0 / 3.0 * pi * radius * radius * radius;
  facts_.area = 4 * pi * radius * radius;
}

bool SphereShape::inside(Vec3 p) const {
  const Vec3 d = p - centre_;
  return bounds().contains(p) && dot(d, d) <= radius_squared_;
}

bool SphereShape::section(const Ray& ray, double grow, double& from, double& to) const {
  const Vec3 w = ray.origin - centre_;
  const double radius = radius_ + grow;
  if (!(radius > 0)) return false;
  return clip_to_quadratic(dot(w, w) - radius * radius, dot(w, ray.direction), 1, from, to);
}

Vec3 SphereShape::normal(const Ray& ray, double t) const {
  const Vec3 unit = unit_along(ray.at(t) - centre_);
  return unit == Vec3{} ? ray.direction * -1.0 : unit;
}

double SphereShape::distance_bound(Vec3 p) const {
  const Vec3 d = p - centre_;
  const double from_centre = std::hypot(d.x, d.y, d.z);
  // Here and in inside(), d and its length lose a few units of 2^-53 of themselves. The bounds,
  // which inside() also tests, lose those of the centre's coordinates.
  const double slack = 0x1p-48 * (from_centre + radius_ + max_magnitude(centre_));
  return std::max(0.0, std::abs(from_centre - radius_) - slack);
}

CylinderShape::CylinderShape(Vec3 from, Vec3 to, double radius)
    : from_(from),
      axis_(to - from),
      axis_squared_(dot(axis_, axis_)),
      height_(std::sqrt(axis_squared_)),
      unit_axis_(axis_ * (1 / height_)),
      radius_(radius),
      radius_squared_(radius * radius) {
  // A disc normal to the unit vector u extends radius * sqrt(1 - u_i^2) along axis i.
  Vec3 reach;
  for (int i = 0; i < 3; ++i) {
    // 1 - u_i^2 from the other two components, which keeps precision for directions close to axis
    // i.
    const double u = axis_[(i + 1) % 3] / height_, v = axis_[(i + 2) % 3] / height_;
    reach[i] = radius * std::sqrt(u * u + v * v) * (1 + 1e-12);
  }
  facts_.bounds = {min(from, to) - reach, max(from, to) + reach};
  facts_.volume = pi * radius * radius * height_;
  facts_.area = 2 * pi * radius * (radius + height_);
}

bool CylinderShape::inside(Vec3 p) const {
  if (!bounds().contains(p)) return false;
  const Vec3 w = p - from_;
  const double t = dot(w, axis_);
  if (t < 0 || t > axis_squared_) return false;
  const Vec3 across = msq::cross(w, axis_);
  return dot(across, across) <= radius_squared_ * axis_squared_;
}

bool CylinderShape::section(const Ray& ray, double grow, double& from, double& to) const {
  const Vec3 w = ray.origin - from_;
  const double radius = radius_ + grow;
  if (!(radius > 0 && height_ + 2 * grow > 0)) return false;
  const double along = dot(w, unit_axis_), rate = dot(ray.direction, unit_axis_);
  if (rate == 0) {
    if (along < -grow || along > height_ + grow) return false;
  } else {
    const double one = (-grow - along) / rate, other = (height_ + grow - along) / rate;
    from = std::max(from, std::min(one, other));
    to = std::min(to, std::max(one, other));
  }
  const Vec3 across = w - unit_axis_ * along, drift = ray.direction - unit_axis_ * rate;
  const double drift_squared = dot(drift, drift);
  const double c = drift_squared > 0x1p-90 ? drift_squared : 0;
  // About the point nearest to the axis: squares of the way to it would have larger rounding errors
  // than those of the radius of a slender cylinder.
  const double nearest = c > 0 ? -dot(across, drift) / c : 0;
  const Vec3 least = across + drift * nearest;
  double low = -std::numeric_limits<double>::infinity(), high = -low;
  if (!clip_to_quadratic(dot(least, least) - radius * radius, dot(least, drift), c, low, high))
    return false;
  from = std::max(from, low + nearest);
  to = std::min(to, high + nearest);
  return from <= to;
}

Vec3 CylinderShape::normal(const Ray& ray, double t) const {
  const Vec3 w = ray.at(t) - from_;
  const double along = dot(w, unit_axis_);
  const Vec3 across = w - unit_axis_ * along;
  const double distance = length(across);
  if (std::abs(distance - radius_) < std::min(std::abs(along), std::abs(height_ - along)))
    if (const Vec3 unit = unit_along(across); !(unit == Vec3{})) return unit;
  return 2 * along < height_ ? unit_axis_ * -1.0 : unit_axis_;
}

double CylinderShape::distance_bound(Vec3 p) const {
  const Vec3 w = p - from_;
  const double along = dot(w, unit_axis_);
  const double across = length(msq::cross(w, unit_axis_));
  const double distance = corner_distance(across - radius_, std::max(-along, along - height_));
  // Each of w, the axis and the products loses a few units of 2^-53 of its terms, here and in
  // inside().
  const double slack =
      0x1p-47 * (length(w) + height_ + radius_ + max_magnitude(from_) + max_magnitude(p));
  return std::max(0.0, distance - slack);
}

void BoxShape::describe(HashInput& input) const {
  input.kind("shape: box");
  input.point(bounds().min);
  input.point(bounds().max);
}

void SphereShape::describe(HashInput& input) const {
  input.kind("shape: sphere");
  input.point(centre_);
  input.number(radius_);
}

void CylinderShape::describe(HashInput& input) const {
  input.kind("shape: cylinder");
  input.point(from_);
  input.point(axis_);
  input.number(radius_);
}

}  // namespace msq
