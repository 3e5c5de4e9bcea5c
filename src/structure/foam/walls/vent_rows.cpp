// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/walls/vent_rows.h"

#include <algorithm>
#include <cmath>

#include "base/borrowed.h"
#include "base/sample_grid.h"
#include "structure/foam/walls/vents.h"

namespace msq {

namespace {

struct HalfSpace {
  Vec3 n;
  double offset;
};

struct VentRowsWorkspace {
  std::vector<HalfSpace> certain, possible;

  size_t bytes() const { return 2 * certain.capacity() * sizeof(HalfSpace); }
};

struct Span {
  double low, high;

  bool is_empty() const { return !(low <= high); }
};

/// What a plane leaves of a span of x.
void cut(Span& span, const HalfSpace& plane, double y, double z) {
  const double rest = plane.offset - plane.n.y * y - plane.n.z * z;
  if (plane.n.x > 1e-9)
    span.high = std::min(span.high, rest / plane.n.x);
  else if (plane.n.x < -1e-9)
    span.low = std::max(span.low, rest / plane.n.x);
  else if (rest < 0)
    span.high = span.low - 1;
}

/// The square of the part of an axis across x, if below the former: the axis counts as along x, as
/// x is within 1 of the middle. Up to the latter, a turn by 1 in 1000, its samples are in doubt.
constexpr double along_row = 1e-13, across_row = 1e-6;

bool has_good_axis(Vec3 n) {
  const double across = n.y * n.y + n.z * n.z;
  return across < along_row || across >= across_row;
}

class Vent {
 public:
  Vent(const std::vector<VentPlane>& planes, const VentPlane& own, double half, double margin,
       VentRowsWorkspace& work)
      : own_(own), margin_(margin + own.error), work_(work) {
    const Interval radius = own.radius;
    is_certain_ = radius.low >= min_vent_radius && radius.low > margin_ &&
                  own.area - face_area_error >= vent_area(radius.high) && has_good_axis(own.normal);
    const double ball = reach(radius.high, half) + margin_;
    // Of the cylinder within half the thickness of the face, along each axis.
    for (int axis = 0; axis < 3; ++axis) {
      const double n = std::abs(own.normal[axis]);
      const double of_disc = radius.high * std::sqrt(std::max(0.0, 1 - n * n));
      reach_[axis] = std::min(ball, (of_disc + half * n) * (1 + 1e-6) + 1e-6 + margin_);
    }
    work.certain.clear();
    work.possible.clear();
    // Without those that leave all of the cube of samples about the middle, as most do.
    const auto add = [&](std::vector<HalfSpace>& to, const HalfSpace& plane) {
      const double farthest = reach_.x * std::abs(plane.n.x) + reach_.y * std::abs(plane.n.y) +
                              reach_.z * std::abs(plane.n.z);
      if (plane.offset - dot(plane.n, own.middle) < 1.001 * farthest) to.push_back(plane);
    };
    for (const VentPlane& plane : planes) {
      const HalfSpace whole{plane.normal, plane.distance + margin};
      if (&plane == &own) {
        add(work.certain, {plane.normal, plane.distance - margin});
        add(work.possible, whole);
        continue;
      }
      const Vec3 n{plane.moved.n[0], plane.moved.n[1], plane.moved.n[2]};
      const double offset = plane.moved.offset, moved_margin = plane.moved.margin;
      add(work.certain, {n, offset - moved_margin});
      const bool may_be_none = plane.area < min_face_area + face_area_error;
      const bool meets =
          may_have_hole(plane) &&
          length(plane.middle - own.middle) <= ball + reach(plane.radius.high, half) + plane.error;
      add(work.possible, may_be_none || meets ? whole : HalfSpace{n, offset + moved_margin});
    }
  }

  static bool may_have_hole(const VentPlane& plane) {
    return plane.radius.high >= min_vent_radius && plane.area >= min_face_area &&
           plane.area + face_area_error >= vent_area(plane.radius.low);
  }

  /// From the middle, along each axis.
  Vec3 reach() const { return reach_; }

  Span certain(double y, double z) const {
    if (!is_certain_) return {0, -1};
    Span span = of_cylinder(own_.radius.low - margin_, y, z);
    for (const HalfSpace& plane : work_.certain) {
      if (span.is_empty()) break;
      cut(span, plane, y, z);
    }
    return span;
  }
  Span possible(double y, double z) const {
    Span span =
        has_good_axis(own_.normal) ? of_cylinder(own_.radius.high + margin_, y, z) : around();
    for (const HalfSpace& plane : work_.possible) {
      if (span.is_empty()) break;
      cut(span, plane, y, z);
    }
    return span;
  }

 private:
  static double reach(double radius, double half) {
    return std::sqrt(radius * radius + half * half) * (1 + 1e-9) + 1e-6;
  }
  /// With w from the middle and the axis n, |w|^2 - (w . n)^2 <= radius^2.
  Span of_cylinder(double radius, double y, double z) const {
    const Vec3 n = own_.normal;
    const double v = y - own_.middle.y, w = z - own_.middle.z, along = v * n.y + w * n.z;
    const double across = n.y * n.y + n.z * n.z;
    if (across < along_row)
      return v * v + w * w - along * along <= radius * radius ? around() : Span{0, -1};
    const double turn = v * n.z - w * n.y, root = across * (radius * radius) - turn * turn;
    if (!(root >= 0)) return {0, -1};
    const double inverse = 1 / across;
    const double centre = own_.middle.x + n.x * along * inverse, half = std::sqrt(root) * inverse;
    const Span all = around();
    return {std::max(all.low, centre - half), std::min(all.high, centre + half)};
  }
  Span around() const { return {own_.middle.x - reach_.x, own_.middle.x + reach_.x}; }

  const VentPlane& own_;
  const double margin_;
  VentRowsWorkspace& work_;
  bool is_certain_;
  Vec3 reach_;
};

void clear_bits(uint64_t* row, uint64_t first, uint64_t last) {
  for (uint64_t w = first / bits_per_word; w <= last / bits_per_word; ++w) {
    uint64_t mask = ~uint64_t{0};
    if (w == first / bits_per_word) mask &= ~uint64_t{0} << (first % bits_per_word);
    if (w == last / bits_per_word)
      mask &= ~uint64_t{0} >> (bits_per_word - 1 - last % bits_per_word);
    row[w] &= ~mask;
  }
}

}  // namespace

void clear_vents(const std::vector<VentPlane>& planes, double half, double margin,
                 const VentRows& rows, std::vector<DoubtfulSamples>& doubts) {
  const Borrowed<VentRowsWorkspace> borrowed;
  struct Samples {
    int64_t first, end;
  };
  const auto samples = [&](const Span& span) {
    if (span.is_empty()) return Samples{0, 0};
    const double first = std::ceil(rows.seed + span.low * rows.per_unit),
                 last = std::floor(rows.seed + span.high * rows.per_unit);
    if (!(last >= 0 && first <= static_cast<double>(rows.last) && first <= last))
      return Samples{0, 0};
    return Samples{static_cast<int64_t>(std::max(first, 0.0)),
                   static_cast<int64_t>(std::min(last, static_cast<double>(rows.last))) + 1};
  };
  for (const VentPlane& plane : planes) {
    if (!Vent::may_have_hole(plane)) continue;
    const Vent vent(planes, plane, half, margin, *borrowed);
    const auto part = [&](const double* v, size_t count, int axis, size_t& first) {
      const double at = plane.middle[axis], reach = vent.reach()[axis];
      const double *const begin = std::lower_bound(v, v + count, at - reach), *const end =
                                                                                  std::upper_bound(
                                                                                      begin,
                                                                                      v + count,
                                                                                      at + reach);
      first = static_cast<size_t>(begin - v);
      return static_cast<size_t>(end - v);
    };
    size_t j0, k0;
    const size_t j1 = part(rows.y, rows.rows, 1, j0), k1 = part(rows.z, rows.layers, 2, k0);
    for (size_t k = k0; k < k1; ++k)
      for (size_t j = j0; j < j1; ++j) {
        const Samples possible = samples(vent.possible(rows.y[j], rows.z[k]));
        if (possible.first == possible.end) continue;
        Samples certain = samples(vent.certain(rows.y[j], rows.z[k]));
        if (certain.first == certain.end) {
          certain = {possible.end, possible.end};
        } else {
          clear_bits(rows.words + k * rows.layer_stride + j * rows.row_stride,
                     static_cast<uint64_t>(certain.first), static_cast<uint64_t>(certain.end) - 1);
        }
        const auto doubt = [&](int64_t from, int64_t to) {
          if (from < to)
            doubts.push_back({rows.first_row + static_cast<uint32_t>(j),
                              rows.first_layer + static_cast<uint32_t>(k),
                              static_cast<uint64_t>(from), static_cast<uint32_t>(to - from)});
        };
        doubt(possible.first, certain.first);
        doubt(certain.end, possible.end);
      }
  }
}

}  // namespace msq
