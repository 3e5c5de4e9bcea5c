// SPDX-License-Identifier: Apache-2.0
#include "shape/open_mesh.h"

#include <algorithm>
#include <cmath>

#include "base/pi.h"
#include "base/unit.h"
#include "shape/mesh_diagnosis.h"

namespace msq {

namespace {

double scale_of(const Box3& bounds) {
  return std::ldexp(1.0, std::clamp(-std::ilogb(max_component(bounds.extent())), -1000, 1000));
}

}  // namespace

OpenMesh::OpenMesh(const TriangleSoup& soup, const Box3& bounds)
    : OpenMesh(soup, join_edges(open_edges(soup, current_job()), soup.vertices.size()), bounds,
               scale_of(bounds)) {}

OpenMesh::OpenMesh(const TriangleSoup& soup, const Loops& loops, const Box3& bounds, double scale)
    : scale_(scale),
      rounding_(0x1p-50 *
                (4 + scale * std::max(max_magnitude(bounds.min), max_magnitude(bounds.max)))),
      loops_(soup, loops, scale),
      caps_(soup, loops, bounds, scale),
      volume_of_holes_(msq::volume_of_holes(soup, caps_.soup(), loops.vertices, bounds)) {}

uint64_t OpenMesh::bytes_to_build(uint64_t triangles, uint64_t edges) {
  // Uses of edges; loops, caps, their neighbours, tree and bins.
  return triangles * 64 + edges * 700;
}

int64_t OpenMesh::correction(Vec3 p) const {
  if (loops_.edges() > few_edges)
    for (const double opening : {4.0, 12.0, 36.0}) {
      const Caps::View view = caps_.view(p, opening);
      if (view.margin() > 0) return caps_.count_beyond(p) - view.whole();
      if (static_cast<double>(loops_.edges()) <= 64 * opening * opening) break;
    }
  return -loops_.turns(p);
}

bool OpenMesh::is_whole_about(Vec3 p, double distance, int64_t& whole) const {
  return caps_.is_steady_in(p, distance, &whole);
}

void OpenMesh::expand(const Ball* balls, size_t count, Expansion* made) const {
  if (loops_.edges() <= max_expanded_edges) return loops_.expand(balls, count, rounding_, made);
  for (size_t i = 0; i < count; ++i) made[i].is_known = false;
}

bool OpenMesh::find_field(const Ball& ball, const Expansion& of_loops, WholeField& field) const {
  if (!of_loops.is_known) return false;
  caps_.find_meeting(ball, field.start(ball, scale_));
  const double beyond = static_cast<double>(caps_.count_beyond(ball.centre));
  return field.set(beyond, of_loops, caps_.tolerance());
}

bool OpenMesh::find_whole(Vec3 p, const Expansion& of_loops, int64_t& whole) const {
  const double nearest = std::floor(of_loops.turns + 0.5);
  if (!of_loops.is_known || !(std::abs(of_loops.turns - nearest) + of_loops.error < 0.5))
    return false;
  const RowWinding of_caps = caps_.count(p);
  whole = of_caps.beyond + static_cast<int64_t>(nearest);
  return of_caps.beyond == of_caps.from;
}

// Let w be the winding number before rounding, W = 4 pi w, and M the distance from W to the nearer
// of 2 pi and -2 pi at which membership changes. Within s of p the gradient of W is at most slope /
// (1 - s / nearest)^2. Its integral reaches M at 1 / (slope / M + 1 / nearest) at the earliest.
// Each loop's solid angle changes by at most A / (d - s)^2 - A / d^2. So the sum over all loops
// reaches M at d (1 - sqrt(view / (view + M))) at the earliest, d being the minimum distance to a
// loop. Both bounds change by at most the displacement of p: their derivatives follow from |M'| <=
// slope <= 2 view / d, |slope'| <= 2 slope / nearest and |view'| <= 2 view / d.
double OpenMesh::distance_bound(Vec3 p, int64_t winding, double max) const {
  if (!is_steady()) {
    double radius = max;
    for (int i = 0; i < 20; ++i, radius *= 0.5)
      if (is_steady_in(p, radius)) return radius;
    return 0;
  }
  const BoundaryLoops::Level level = loops_.level(p);
  const double n = static_cast<double>(winding), w = 2 * pi * n - level.rest;  // 2 pi w
  const double to_half = winding == 0 ? pi - std::abs(w) : std::abs(w) - pi;
  const double left = 2 * to_half - level.error;
  if (!(left > 0)) return 0;
  constexpr double most = 1023.0 / 1024;  // level.error is valid up to here
  const double by_edges =
      std::min(1 / (level.slope / left + 1 / level.nearest), most * level.nearest);
  const double part = level.view / (level.view + left);
  const double by_loops =
      level.nearest_loop > 0
          ? level.nearest_loop * std::min(most, (1 - part) / (1 + std::sqrt(part)))
          : 0;
  return std::max(by_edges, by_loops) * (1 - 0x1p-40) / scale_;
}

// With m what is left of 4 pi w to the next of 2 pi and -2 pi, g its derivative towards that and B
// a bound of the second: m - g s - B s^2 / 2 is not negative up to 2 m / (g + sqrt(g^2 + 2 m B)).
// So steps towards the level shrink as Newton's do, and from it on they are long at once: where m
// is no more than rounding, only what is lost in that is to be passed by other means.
double OpenMesh::steady_way(Vec3 p, Vec3 direction, int64_t beyond) const {
  const BoundaryLoops::Course c = loops_.course(p, direction, rounding_);
  const int64_t winding = beyond - c.turns;
  const double turns = 2 * two_pi * static_cast<double>(winding) - 2 * c.rest;  // 4 pi w
  double way = 0.25 * c.nearest;
  const auto stay = [&](double left, double towards) {
    const double g = towards + c.slack;
    left -= c.error;
    if (left < 0 && !(left >= 0x1p12 * rounding_ * g)) way = 0;  // noise for more than a tolerance
    left = std::max(0.0, left);
    const double root = std::sqrt(g * g + 2 * left * c.bend);
    way = std::min(way, g > 0 ? 2 * left / (g + root) : (root - g) / c.bend);
  };
  if (winding == 0) {
    stay(two_pi - turns, c.along);
    stay(turns + two_pi, -c.along);
  } else if (winding > 0) {
    stay(turns - two_pi, -c.along);
  } else {
    stay(-two_pi - turns, c.along);
  }
  return way * (1 - 0x1p-40) / scale_;
}

Vec3 OpenMesh::normal(Vec3 p) const {
  if (!is_steady()) return {};
  return unit_along(loops_.gradient(p));
}

}  // namespace msq
