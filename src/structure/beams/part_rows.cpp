// SPDX-License-Identifier: Apache-2.0
// Lengths along a row are relative to x of the part's first end; v and w are the row's offsets from
// that end in y and z. A row cuts a slightly larger and a slightly smaller copy of a part: samples
// beyond the first are outside, those in the second inside.
//
// The frustum. At X on the row a point is at z = ux X + m along the axis, m = uy v + uz w. It is
// inside where 0 <= z <= length and f(X) = X^2 + v^2 + w^2 - z^2 - r(z)^2 <= 0, r = ra + k z.
// Moving a point by d changes z by d, its distance from the axis by d and r by k d. So it changes f
// by at most d (2 R + d) + k d (2 R + k d) near the boundary, R being the larger radius. Where |X|,
// |v| and |w| are at most S, the error of f is at most 2^-45 S^2 (1 + k^2). The larger part has f
// <= F, F the sum of these, and -d <= z <= length + d; the smaller one f <= -F and d <= z <= length
// - d. Cones steeper than `steepest`, which rounding of k would spoil, have no smaller part, and
// their larger part is the cylinder around them.
#include "structure/beams/part_rows.h"

#include "base/sample_grid.h"
#include "structure/beams/cone_interval.h"

namespace msq {

namespace {

constexpr double steepest = 16;
/// Squares of longer lengths might overflow: such rows are in doubt all along.
constexpr double longest = 1e75;

struct Span {
  double low, high;  // empty where low > high
};
constexpr Span nothing{1, 0};

/// Samples whose number is within [first, end), of ascending values.
struct Range {
  size_t first, end;
};
Range range_of(const double* values, size_t count, double low, double high) {
  return {static_cast<size_t>(std::lower_bound(values, values + count, low) - values),
          static_cast<size_t>(std::upper_bound(values, values + count, high) - values)};
}

/// Draws the rows of a target that may meet a box: spans(v, w, outer, inner) finds where, from
/// `origin` on.
template <class Spans>
void draw_rows(const RasterTarget& target, const Box3& box, Vec3 origin, uint32_t number,
               DoubtfulSpans& doubts, Spans&& spans) {
  const Range rows = range_of(target.y, target.rows, box.min.y, box.max.y);
  const Range layers = range_of(target.z, target.layers, box.min.z, box.max.z);
  const double shift = origin.x - target.x0, last = target.last;
  const auto column = [&](double x) { return (x + shift) * target.inverse_dx; };
  for (size_t k = layers.first; k < layers.end; ++k)
    for (size_t j = rows.first; j < rows.end; ++j) {
      Span outer = nothing, inner = nothing;
      spans(target.y[j] - origin.y, target.z[k] - origin.z, outer, inner);
      const double o0 = std::max(0.0, std::ceil(column(outer.low) - target.slack));
      const double o1 = std::min(last, std::floor(column(outer.high) + target.slack));
      if (!(o0 <= o1)) continue;
      const double i0 = std::max(0.0, std::ceil(column(inner.low) + target.slack));
      const double i1 = std::min(last, std::floor(column(inner.high) - target.slack));
      const auto doubt = [&](double from, double to) {
        if (!(from <= to)) return;
        doubts.push_back({number, static_cast<uint32_t>(j), static_cast<uint32_t>(k),
                          static_cast<uint32_t>(from), static_cast<uint32_t>(to - from) + 1});
      };
      if (!(inner.low <= inner.high && i0 <= i1)) {
        doubt(o0, o1);
        continue;
      }
      set_bits(target.row(j, k), static_cast<uint64_t>(i0), static_cast<uint64_t>(i1));
      doubt(o0, i0 - 1);
      doubt(i1 + 1, o1);
    }
}

/// Cuts a span to low <= slope x + at <= high. False where nothing is left: a beam that is shorter
/// than its errors has no smaller part.
bool cut_to_slab(double at, double slope, double low, double high, Span& span) {
  if (low > high) return false;
  if (slope == 0) return at >= low && at <= high;
  const double one = (low - at) / slope, other = (high - at) / slope;
  span.low = std::max(span.low, std::min(one, other));
  span.high = std::min(span.high, std::max(one, other));
  return true;
}

}  // namespace

void draw_frustum(const RasterTarget& target, const Beam& beam, uint32_t number,
                  DoubtfulSpans& doubts) {
  const Vec3 ab = beam.b - beam.a;
  const double length = msq::length(ab), greatest = std::max(beam.radius_a, beam.radius_b);
  Vec3 u = ab * (1 / length);
  double ra = beam.radius_a, slope = (beam.radius_b - beam.radius_a) / length;
  const bool is_steep = std::abs(slope) > steepest;
  if (is_steep) {
    ra = greatest;
    slope = 0;
  }
  const double d = target.margin, size = length + 2 * greatest + 2 * d;
  // A row across the axis, all but exactly: as if it were, within the error of z.
  const double z_error = d + 0x1p-45 * size;
  if (std::abs(u.x) < 0x1p-48) u.x = 0;
  const double square = 1 + slope * slope, k = std::abs(slope);
  const double error = z_error * (2 * greatest + z_error) +
                       k * z_error * (2 * greatest + k * z_error) + 0x1p-45 * size * size * square;
  const double a = u.y * u.y + u.z * u.z - slope * slope * u.x * u.x, grows = slope * u.x;
  draw_rows(target, beam.box().grown(d), beam.a, number, doubts,
            [&](double v, double w, Span& outer, Span& inner) {
              if (!(size < longest)) {
                outer = {-size, size};
                return;
              }
              const double m = u.y * v + u.z * w, r = ra + slope * m;
              const double b = -u.x * (square * m + slope * ra);
              const double c = v * v + w * w - m * m - r * r;
              Span span{-size, size};
              if (!cut_to_slab(m, u.x, -z_error, length + z_error, span) ||
                  !cut_to_cone(a, b, c - error, grows, 0, span.low, span.high))
                return;
              outer = span;
              span = {-size, size};
              if (is_steep || !cut_to_slab(m, u.x, z_error, length - z_error, span) ||
                  !cut_to_cone(a, b, c + error, grows, 0, span.low, span.high))
                return;
              inner = span;
            });
}

void draw_ball(const RasterTarget& target, const Beam& beam, bool is_at_b, uint32_t number,
               DoubtfulSpans& doubts) {
  const Vec3 centre = is_at_b ? beam.b : beam.a, ab = beam.b - beam.a;
  const double radius = is_at_b ? beam.radius_b : beam.radius_a, d = target.margin;
  const bool is_half =
      (is_at_b ? beam.cap_b : beam.cap_a) == BeamCap::hemisphere && beam.has_length();
  Vec3 out = is_half ? ab * ((is_at_b ? 1 : -1) / msq::length(ab)) : Vec3{};
  if (std::abs(out.x) < 0x1p-48) out.x = 0;
  const double thick = radius + d, thin = radius - d, z_error = d + 0x1p-45 * (radius + d);
  const Vec3 by = Vec3{1, 1, 1} * thick;
  draw_rows(target, {centre - by, centre + by}, centre, number, doubts,
            [&](double v, double w, Span& outer, Span& inner) {
              const double across = v * v + w * w, z = out.y * v + out.z * w;
              const double under = thick * thick - across;
              if (under < 0) return;
              Span span{-std::sqrt(under), std::sqrt(under)};
              constexpr double far = std::numeric_limits<double>::infinity();
              if (is_half && !cut_to_slab(z, out.x, -z_error, far, span)) return;
              outer = span;
              const double within = thin > 0 ? thin * thin - across : -1;
              if (within < 0) return;
              span = {-std::sqrt(within), std::sqrt(within)};
              if (is_half && !cut_to_slab(z, out.x, z_error, far, span)) return;
              inner = span;
            });
}

}  // namespace msq
