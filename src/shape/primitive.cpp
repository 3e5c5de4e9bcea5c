// SPDX-License-Identifier: Apache-2.0
#include "shape/primitive.h"

namespace msq {

namespace {
constexpr double pi = 3.14159265358979323846;
}

BoxShape::BoxShape(const Box3& box) {
  const Vec3 e = box.extent();
  facts_.bounds = box;
  facts_.volume = e.x * e.y * e.z;
  facts_.area = 2 * (e.x * e.y + e.y * e.z + e.z * e.x);
}

void BoxShape::fill_rows(const RowBlock& block) const {
  const SampleGrid& grid = *block.grid;
  const Box3& box = bounds();
  const uint64_t first = first_sample_from(grid.origin.x, grid.spacing.x, grid.nx, box.min.x);
  const uint64_t end = first_sample_from<true>(grid.origin.x, grid.spacing.x, grid.nx, box.max.x);
  if (first >= end) return;
  for (uint64_t k = block.z0; k < block.z1; ++k) {
    const double z = grid.z(k);
    if (z < box.min.z || z > box.max.z) continue;
    for (uint64_t j = block.y0; j < block.y1; ++j) {
      const double y = grid.y(j);
      if (y >= box.min.y && y <= box.max.y) set_bits(block.row(j, k), first, end - 1);
    }
  }
}

SphereShape::SphereShape(Vec3 centre, double radius)
    : centre_(centre), radius_squared_(radius * radius) {
  facts_.bounds = Box3{centre, centre}.grown(radius);
  facts_.volume = 4.0 / 3.0 * pi * radius * radius * radius;
  facts_.area = 4 * pi * radius * radius;
}

bool SphereShape::inside(Vec3 p) const {
  const Vec3 d = p - centre_;
  return bounds().contains(p) && dot(d, d) <= radius_squared_;
}

CylinderShape::CylinderShape(Vec3 from, Vec3 to, double radius)
    : from_(from),
      axis_(to - from),
      axis_squared_(dot(axis_, axis_)),
      radius_squared_(radius * radius) {
  // A disc normal to the unit vector u reaches radius * sqrt(1 - u_i^2) along axis i.
  const double height = std::sqrt(axis_squared_);
  Vec3 reach;
  for (int i = 0; i < 3; ++i) {
    const double u = axis_[i] / height;
    reach[i] = radius * std::sqrt(std::max(0.0, 1 - u * u)) * (1 + 1e-12);
  }
  facts_.bounds = {min(from, to) - reach, max(from, to) + reach};
  facts_.volume = pi * radius * radius * height;
  facts_.area = 2 * pi * radius * (radius + height);
}

bool CylinderShape::inside(Vec3 p) const {
  if (!bounds().contains(p)) return false;
  const Vec3 w = p - from_;
  const double t = dot(w, axis_);
  if (t < 0 || t > axis_squared_) return false;
  const Vec3 across = cross(w, axis_);
  return dot(across, across) <= radius_squared_ * axis_squared_;
}

}  // namespace msq
