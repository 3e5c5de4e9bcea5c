// SPDX-License-Identifier: Apache-2.0
#include "io/beam_lattice.h"

#include <algorithm>
#include <cmath>

#include "base/status.h"

namespace msq {

uint64_t BeamLattice::bytes() const {
  return nodes.size() * sizeof(nodes[0]) + beams.size() * sizeof(beams[0]) +
         radii.size() * sizeof(radii[0]) + caps.size() * sizeof(caps[0]) +
         balls.size() * sizeof(balls[0]) + ball_radii.size() * sizeof(ball_radii[0]) +
         clip.vertices.size() * sizeof(clip.vertices[0]) +
         clip.triangles.size() * sizeof(clip.triangles[0]);
}

void BeamLattice::drop_unused() {
  size_t kept = 0;
  for (size_t i = 0; i < beams.size(); ++i) {
    if (length(nodes[beams[i][1]] - nodes[beams[i][0]]) < min_length) continue;
    beams[kept] = beams[i];
    radii[kept] = radii[i];
    caps[kept] = caps[i];
    ++kept;
  }
  beams.resize(kept);
  radii.resize(kept);
  caps.resize(kept);

  std::vector<uint32_t> numbers(nodes.size(), UINT32_MAX);
  std::vector<Vec3> used;
  const auto number = [&](uint32_t& node) {
    if (numbers[node] == UINT32_MAX) {
      numbers[node] = static_cast<uint32_t>(used.size());
      used.push_back(nodes[node]);
    }
    node = numbers[node];
  };
  for (std::array<uint32_t, 2>& beam : beams)
    for (uint32_t& node : beam) number(node);
  for (uint32_t& ball : balls) number(ball);
  nodes = std::move(used);
}

void BeamLattice::append(const BeamLattice& other, const Transform& transform, double scale) {
  const auto first = static_cast<uint32_t>(nodes.size());
  for (const Vec3& node : other.nodes) nodes.push_back(transform.apply(node));
  for (const std::array<uint32_t, 2>& beam : other.beams)
    beams.push_back({first + beam[0], first + beam[1]});
  for (const std::array<double, 2>& pair : other.radii)
    radii.push_back({pair[0] * scale, pair[1] * scale});
  caps.insert(caps.end(), other.caps.begin(), other.caps.end());
  for (const uint32_t ball : other.balls) balls.push_back(first + ball);
  for (const double radius : other.ball_radii) ball_radii.push_back(radius * scale);
}

double scale_of(const Transform& transform) {
  constexpr double tolerance = 1e-4;
  const Vec3 axes[3] = {transform.x_axis, transform.y_axis, transform.z_axis};
  const double scale = std::cbrt(std::abs(transform.determinant()));
  for (int i = 0; i < 3; ++i) {
    // Written so that numbers that are not finite fail, too.
    bool is_alike = std::abs(length(axes[i]) - scale) <= tolerance * scale;
    const double cosine = dot(axes[i], axes[(i + 1) % 3]);
    is_alike = is_alike && std::abs(cosine) <= tolerance * scale * scale && scale > 0;
    if (!is_alike)
      fail(Status::unsupported,
           "a beam lattice is placed by a transform that scales axes by %g, %g and %g or shears; "
           "it must scale all directions alike",
           length(axes[0]), length(axes[1]), length(axes[2]));
  }
  return scale;
}

}  // namespace msq
