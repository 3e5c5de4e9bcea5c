// SPDX-License-Identifier: Apache-2.0
#include "shape/whole_field.h"

#include <algorithm>
#include <cmath>

namespace msq {

std::vector<WholeField::Triangle3>& WholeField::start(const Ball& ball, double scale) {
  centre_ = ball.centre;
  scale_ = scale;
  radius_ = ball.radius * scale;
  return caps_;
}

bool WholeField::set(double beyond, const Expansion& of_loops, double tolerance) {
  terms_ = of_loops;
  tolerance_ = tolerance;
  value_ = beyond + terms_.turns;
  error_ = terms_.error + 0x1p-48 * (1 + std::abs(value_));
  double bend = 0;
  for (const double factor : terms_.second) bend += std::abs(factor);
  slope_ = length(terms_.first);
  spread_ = slope_ * radius_ + bend * radius_ * radius_;
  if (!(error_ < 0.25 && std::abs(value_) + spread_ < 0x1p30)) return false;
  sheets_.clear();
  return std::all_of(caps_.begin(), caps_.end(),
                     [&](const Triangle3& cap) { return add_sheet(cap); });
}

bool WholeField::add_sheet(const Triangle3& cap) {
  const auto& [a, b, c] = cap;
  const Vec3 normal = cross(b - a, c - a);
  const double size = length(normal);
  if (size == 0) return true;
  Sheet sheet;
  sheet.normal = normal * (1 / size);
  sheet.height = dot(a, sheet.normal);
  // Normals of thin triangles are the less exact.
  const double longest = std::max({length(b - a), length(c - b), length(a - c)});
  sheet.height_room = 4 * tolerance_ * (1 + longest * longest / size);
  if (!(std::abs(sheet.height) > sheet.height_room)) return false;
  sheet.jump = sheet.height > 0 ? 1 : -1;
  for (size_t i = 0; i < 3; ++i) {
    const Vec3 from = cap[i], to = cap[(i + 1) % 3];
    sheet.sides[i] = cross(from, to);
    sheet.room[i] =
        0x1p-44 * length(from) * length(to) + 4 * tolerance_ * (length(from) + length(to));
  }
  sheets_.push_back(sheet);
  return true;
}

bool WholeField::is_constant(int64_t& whole) const {
  whole = static_cast<int64_t>(std::floor(value_ + 0.5));
  const double off = std::abs(value_ - static_cast<double>(whole)) + spread_ + error_;
  return sheets_.empty() && off < 0.5;
}

double WholeField::doubtful_part() const {
  const double to_half = 0.5 - std::abs(value_ - std::floor(value_ + 0.5));
  if (to_half > spread_ + error_) return 0;
  return std::min(1.0, error_ / (slope_ * radius_));
}

bool WholeField::pass_caps(Vec3 d, int64_t& whole) const {
  const double way = length(d);
  for (const Sheet& sheet : sheets_) {
    const double beyond = dot(d, sheet.normal) - sheet.height;
    // On the centre's side of the plane.
    if (beyond * static_cast<double>(sheet.jump) < -sheet.height_room) continue;
    bool is_within = true, is_sure = std::abs(beyond) > sheet.height_room;
    for (size_t i = 0; i < 3; ++i) {
      const double side = dot(d, sheet.sides[i]) * static_cast<double>(sheet.jump);
      const double room = sheet.room[i] * way;
      if (side < -room) is_within = false;
      if (std::abs(side) <= room) is_sure = false;
    }
    if (!is_within) continue;
    if (!is_sure) return false;
    whole -= sheet.jump;
  }
  return true;
}

bool WholeField::whole_at(Vec3 p, int64_t& whole) const {
  const Vec3 d = (p - centre_) * scale_;
  const auto& [xx, yy, zz, xy, xz, yz] = terms_.second;
  const double value = value_ + dot(terms_.first, d) + d.x * (xx * d.x + xy * d.y + xz * d.z) +
                       d.y * (yy * d.y + yz * d.z) + zz * d.z * d.z;
  const double nearest = std::floor(value + 0.5);
  whole = static_cast<int64_t>(nearest);
  return std::abs(value - nearest) + error_ < 0.5 && pass_caps(d, whole);
}

}  // namespace msq
