// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/rays/strut_entry.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>

#include "structure/foam/point/edge_line.h"
#include "structure/foam/point/stretched_line.h"
#include "structure/foam/point/weighted_line.h"
#include "strut/segment.h"

namespace msq {

namespace {

double square(double x) {
  return x * x;
}

Vec3 corner_of(CellIndex cell, Vec3 scale) {
  return Vec3{double(cell.x), double(cell.y), double(cell.z)} * scale;
}

/// The number strictly between two numbers that is divisible by the highest power of two. There
/// must be one.
int64_t simplest_between(int64_t low, int64_t high) {
  const int64_t first = low + 1, last = high - 1;
  const auto unlike = static_cast<uint64_t>(first ^ last);
  if (unlike == 0) return first;
  // The smallest number that has the bits with which both begin, and whose next bit is 1; or the
  // first, if it has only the common bits.
  const auto next = uint64_t{1} << (std::bit_width(unlike) - 1);
  if ((static_cast<uint64_t>(first) & (2 * next - 1)) == 0) return first;
  return static_cast<int64_t>(static_cast<uint64_t>(last) & ~(next - 1));
}

/// Distance of a point of the ray beyond an end of a strut, along the strut's line.
inline double beyond_ends(const FoamRay& ray, const StrutLine& strut, double t) {
  const double s = dot(ray.at(t) - strut.corner - strut.a, strut.along);
  return std::max(std::min(0.0, strut.length) - s, s - std::max(0.0, strut.length));
}

}  // namespace

double capsule_entry(Vec3 a, Vec3 ab, Vec3 u, double radius) {
  const double z0 = dot(a, u), dz = dot(ab, u);
  const Vec3 p = a - u * z0, q = ab - u * dz;
  const double qq = dot(q, q), length_squared = dot(ab, ab);
  double s = dz > 0 ? 0 : 1;  // along the axis
  if (qq > 1e-24) {
    const double s0 = -dot(p, q) / qq;
    const Vec3 across = p + q * s0;
    const double room = radius * radius - dot(across, across);
    if (room < 0) return std::numeric_limits<double>::infinity();
    s = std::clamp(s0 - dz * std::sqrt(room / (qq * length_squared)), 0.0, 1.0);
  }
  const Vec3 v = p + q * s;
  const double under = radius * radius - dot(v, v);
  if (under < 0) return std::numeric_limits<double>::infinity();
  return z0 + s * dz - std::sqrt(under);
}

bool comes_before(const StrutEntry& entry, const StrutEntry& other) {
  if (!entry.is_met || !other.is_met) return entry.is_met;
  const auto rank = [](const StrutEntry& e) {
    return std::make_tuple(e.t, !e.at_from, e.by_ends, e.normal.x, e.normal.y, e.normal.z);
  };
  return rank(entry) < rank(other);
}

StrutEntries::StrutEntries(const FoamData& foam)
    : foam_(foam),
      radius_(foam.max_radius()),
      inverse_radius_(1 / radius_),
      frame_{&foam.neighbourhood(), 1 / foam.unit(), foam.ray_tolerance() / foam.unit()} {}

bool StrutEntries::inside(const FoamRay& ray, double t) const {
  return foam_.inside(ray.model_point(t, foam_.unit()));
}

// Bisection would make the result depend on the bracket. Here all brackets around a number test the
// same, simplest numbers first, as in a tree of all numbers whose root is 0 or a power of two.
StrutEntry StrutEntries::settle(const FoamRay& ray, double before, double beyond) const {
  const double step = 0.5 * ray.tolerance;
  auto low = static_cast<int64_t>(std::floor(before / step));
  auto high = static_cast<int64_t>(std::ceil(beyond / step));
  const int64_t last = high;
  while (high - low > 1) {
    const int64_t middle = simplest_between(low, high);
    (inside(ray, static_cast<double>(middle) * step) ? high : low) = middle;
  }
  StrutEntry entry;
  entry.is_met = true;
  entry.t = std::max(ray.from, static_cast<double>(high) * step);
  // Rounding may put the point behind `beyond` outside.
  if (high == last && !inside(ray, entry.t)) entry.t = beyond;
  return entry;
}

/// By membership. `middle` is where the ray is deepest in the strut, unless an end comes before.
StrutEntry StrutEntries::graze(const FoamRay& ray, const StrutLine& strut, double middle,
                               double half) const {
  // The part of the ray between the ends.
  double before = middle - half, after = middle + half;
  const double room = end_error + ray.error, low = std::min(0.0, strut.length) - room,
               high = std::max(0.0, strut.length) + room;
  const double at = dot(ray.at(middle) - strut.corner - strut.a, strut.along);
  const double by = dot(ray.direction, strut.along);
  StrutEntry entry;
  if (std::abs(by) * half > room) {
    const double one = middle + (low - at) / by, other = middle + (high - at) / by;
    before = std::max(before, std::min(one, other));
    after = std::min(after, std::max(one, other));
  } else if (at < low || at > high) {
    return entry;
  }
  before = std::max(before, ray.from);
  after = std::min(after, ray.to);
  if (before > after) return entry;
  if (before == ray.from && inside(ray, before)) {
    entry.is_met = entry.at_from = true;
    entry.t = ray.from;
    return entry;
  }
  // If another strut contains the ray before, then that strut has an earlier entry.
  const double deepest = std::clamp(middle, before, after);
  return inside(ray, deepest) ? settle(ray, before, deepest) : entry;
}

StrutEntry StrutEntries::find_by_ends(const FoamRay& ray, const StrutLine& strut) const {
  const Vec3 o = ray.origin - strut.corner;
  const double about = dot(strut.a - o, ray.direction);
  const Vec3 a = strut.a - (o + ray.direction * about);
  const double room = end_error + ray.error, inner = std::max(0.0, radius_ - room);
  const double first = about + capsule_entry(a, strut.ab, ray.direction, radius_ + room);
  const double last = about + capsule_entry(a, strut.ab, ray.direction, inner);
  StrutEntry entry;
  if (!(first <= ray.to)) return entry;
  const double before = std::max(ray.from, first - room);
  if (inside(ray, before)) {
    entry.is_met = entry.at_from = before == ray.from;
    entry.t = ray.from;
    return entry;
  }
  if (last < ray.to && last >= ray.from && inside(ray, last)) return settle(ray, before, last);
  // A graze, or a ray that begins near the surface: steps from there to where it has left the
  // strut.
  const double exit =
      about - capsule_entry(a, strut.ab, ray.direction * -1.0, radius_ + room) + room;
  // First where the ray is deepest in the strut: the steps may miss that if the ray begins after
  // the first entry.
  const double deepest = 0.5 * (first - room + exit);
  if (deepest > before && deepest < ray.to && inside(ray, deepest))
    return settle(ray, before, deepest);
  constexpr int steps = 8;
  for (int n = 1; n <= steps; ++n) {
    const double t = before + (std::min(exit, ray.to) - before) * n / steps;
    if (t > before && inside(ray, t)) return settle(ray, before, t);
  }
  return entry;
}

FoamRay FoamFrame::ray(const RaySearch& search) const {
  FoamRay ray;
  ray.origin = grid->to_grid(search.ray.origin) * to_foam;
  ray.direction = grid->rotation.apply_inverse(search.ray.direction);
  ray.from = search.from * to_foam;
  ray.to = search.to * to_foam;
  // The error of points' coordinates is a few units of 2^-53 of their magnitude: here, and in
  // membership, which computes them in the model's frame first.
  const double max = std::max(std::max(max_magnitude(ray.origin), max_magnitude(ray.at(ray.to))),
                              to_foam * max_coordinate(search.ray, search.to));
  ray.error = coordinate_rounding(8 + max);
  ray.tolerance = std::max(tolerance, coordinate_rounding(max));
  ray.search = &search;
  return ray;
}

StrutLine StrutEntries::line(const std::array<CellIndex, 3>& cells) const {
  const FoamSeeds& seeds = foam_.seeds();
  const CellIndex home = cells[0];
  const auto seed = [&](size_t i) {
    return foam_.diagram_seeds().at(home, cells[i].x - home.x, cells[i].y - home.y,
                                    cells[i].z - home.z);
  };
  StrutLine strut;
  double by_more = 1;
  if (const Stretch* stretch = foam_.stretch()) {
    const StretchedLine line(stretch->factor(), seed(0), seed(1), seed(2));
    strut.line = line.of_foam;
    // The error of the line in diagram units, in foam units.
    by_more = stretch->max_factor() * std::sqrt(line.of_diagram.inverse_squared /
                                                std::max(1e-300, line.of_foam.inverse_squared));
  } else if (foam_.is_weighted()) {
    const auto lifted = [&](size_t i) {
      return LiftedSeed{seed(i), seeds.lift(seeds.bits(cells[i]))};
    };
    strut.line = WeightedLine(lifted(0), lifted(1), lifted(2)).line;
    // Seeds are up to 4 apart, twice the empty radius: products are below 2^8.
    by_more = 8;
  } else {
    strut.line = EdgeLine(seed(0), seed(1), seed(2));
  }
  strut.has_line = strut.line.exists();
  // The line's offset and direction come from products of seeds' differences u and v. Their error
  // is 2^-52 |u| |v| (|u| + |v| + 4) over the triangle's size, |direction|. For products above 2^5,
  // that size is above 1, or the seeds' circle is so wide that it is not the circle of an empty
  // ball.
  const double inverse_size = std::sqrt(strut.line.inverse_squared);
  strut.home = corner_of(home, seeds.scale());
  strut.along = strut.line.direction * inverse_size;
  strut.error = 0x1p-47 * inverse_size * by_more;
  return strut;
}

StrutLine StrutEntries::line(const RayBrick& brick, size_t edge) const {
  StrutLine strut;
  if (brick.knows_seeds(edge)) strut = line(brick.seeds(edge));
  set_ends(brick.end(edge, 0), brick.end(edge, 1), brick.middle(), strut);
  return strut;
}

void StrutEntries::set_ends(const std::array<float, 3>& a, const std::array<float, 3>& b,
                            CellIndex corner, StrutLine& strut) const {
  strut.corner = corner_of(corner, foam_.seeds().scale());
  strut.a = {a[0], a[1], a[2]};
  strut.ab = Vec3{b[0], b[1], b[2]} - strut.a;
  if (!strut.has_line) {
    const double size = length(strut.ab);
    strut.along = size > 0 ? strut.ab * (1 / size) : Vec3{};
  }
  strut.length = dot(strut.ab, strut.along);
}

StrutEntry StrutEntries::find(const FoamRay& ray, const StrutLine& strut) const {
  if (!foam_.has_capsules()) return find_tapered(ray, strut);
  if (!strut.has_line) {
    StrutEntry entry = find_by_ends(ray, strut);
    entry.by_ends = true;
    return entry;
  }
  const EdgeLine& line = strut.line;
  // Relative to the ray's point nearest to the middle of the owner's cell, which is near the line.
  const Vec3 o = ray.origin - strut.home, u = ray.direction;
  const double t0 = dot(foam_.seeds().scale() * 0.5 - o, u);
  const Vec3 w = o + u * t0 - line.seed - line.offset;
  const Vec3 p = w - strut.along * dot(w, strut.along);
  const Vec3 q = u - strut.along * dot(u, strut.along);
  const double qq = dot(q, q), pq = dot(p, q);
  const double under = pq * pq - qq * (dot(p, p) - radius_ * radius_);
  const double error = ray.error + strut.error, tolerance = ray.tolerance;
  const double end_room = end_error + error;
  StrutEntry entry;
  double in = -std::numeric_limits<double>::infinity(), out = -in;
  if (qq < parallel_squared) {
    // If rounding leaves a doubt, membership at the start of the ray decides.
    if (length(p) > radius_ + error) return entry;
  } else {
    const double room = error * (8 * radius_ + error) * qq;
    if (under < -room) return entry;
    const double inverse = 1 / qq, middle = t0 - pq * inverse;
    const double root = std::sqrt(std::max(under, 0.0)), half = root * inverse;
    in = middle - half;
    out = middle + half;
    if (under <= 0 || error * radius_ > 0.25 * tolerance * root)
      return find_shallow(ray, strut, {under, room, inverse, middle, end_room});
  }
  if (out < ray.from || in > ray.to) return entry;

  if (in > ray.from) {
    const double by = beyond_ends(ray, strut, in);
    if (by > end_room) return entry;
    if (by > -end_room && !inside(ray, in) && !inside(ray, in + tolerance)) return entry;
    entry.is_met = entry.is_sure = true;
    entry.t = in;
    entry.normal = foam_.neighbourhood().rotation.apply((p + q * (in - t0)) * inverse_radius_);
    return entry;
  }
  return begin(ray, strut, out, end_room);
}

StrutEntry StrutEntries::find_shallow(const FoamRay& ray, const StrutLine& strut,
                                      const Section& section) const {
  const auto [under, room, inverse, middle, end_room] = section;
  const double widest = std::sqrt(std::max(under, 0.0) + room) * inverse + ray.tolerance;
  // If the ray is deep in the strut, then it enters after `before` and by `after`.
  const double before = middle - widest;
  const double after = middle - std::sqrt(std::max(under - room, 0.0)) * inverse;
  if (!(under > 4 * room && before > ray.from && after <= ray.to))
    return graze(ray, strut, middle, widest);
  if (std::max(beyond_ends(ray, strut, before), beyond_ends(ray, strut, after)) > -end_room)
    return graze(ray, strut, middle, widest);
  StrutEntry entry = settle(ray, before, after);
  entry.is_sure = true;
  return entry;
}

StrutEntry StrutEntries::begin(const FoamRay& ray, const StrutLine& strut, double out,
                               double end_room) const {
  const double tolerance = ray.tolerance;
  StrutEntry entry;
  entry.t = ray.from;
  // The ball around an end is solid, too; some strut contains it.
  const Vec3 place = ray.at(ray.from) - strut.corner;
  const bool is_sure = Segment(strut.a, strut.a + strut.ab).distance_squared(place) <
                       square(std::max(0.0, radius_ - end_room));
  if (!is_sure && beyond_ends(ray, strut, ray.from) > end_room) return entry;
  if (is_sure || inside(ray, ray.from)) {
    entry.is_met = entry.at_from = true;
  } else if (ray.from + tolerance < out && inside(ray, ray.from + tolerance)) {
    entry.is_met = true;
    entry.t = ray.from + tolerance;
  }
  return entry;
}

}  // namespace msq
