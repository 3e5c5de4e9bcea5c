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

/// What a cylinder leaves of it. |w|^2 - (w . n)^2 <= radius^2 with w = x - middle.
void cut(Span& span, Vec3 middle, Vec3 n, double radius, double y, double z) {
  const Vec3 w{-middle.x, y - middle.y, z - middle.z};
  const double along = dot(w, n);
  const double a = n.y * n.y + n.z * n.z, b = w.x - along * n.x,
               c = dot(w, w) - along * along - radius * radius;
  if (a < along_row) {
    if (c > 0) span.high = span.low - 1;
    return;
  }
  const double root = b * b - a * c;
  if (!(root >= 0)) {
    span.high = span.low - 1;
    return;
  }
  const double half = std::sqrt(root) / a;
  span.low = std::max(span.low, -b / a - half);
  span.high = std::min(span.high, -b / a + half);
}

class Vent {
 public:
  Vent(const std::vector<VentPlane>& planes, const VentPlane& own, double half, double margin,
       VentRowsWorkspace& work)
      : own_(own), margin_(margin), work_(work) {
    const Interval radius = own.radius;
    is_certain_ = radius.low >= min_vent_radius &&
                  own.area - face_area_error >= vent_area(radius.high) && has_good_axis(own.normal);
    reach_ = reach(radius.high, half) + margin;
    work.certain.clear();
    work.possible.clear();
    for (const VentPlane& plane : planes) {
      const HalfSpace whole{plane.normal, plane.distance + margin};
      if (&plane == &own) {
        work.certain.push_back({plane.normal, plane.distance - margin});
        work.possible.push_back(whole);
        continue;
      }
      const Vec3 n{plane.moved.n[0], plane.moved.n[1], plane.moved.n[2]};
      const double offset = plane.moved.offset, moved_margin = plane.moved.margin;
      work.certain.push_back({n, offset - moved_margin});
      const bool may_be_none = plane.area < min_face_area + face_area_error;
      const bool meets = may_have_hole(plane) && length(plane.middle - own.middle) <=
                                                     reach_ + reach(plane.radius.high, half);
      work.possible.push_back(may_be_none || meets ? whole : HalfSpace{n, offset + moved_margin});
    }
  }

  static bool may_have_hole(const VentPlane& plane) {
    return plane.radius.high >= min_vent_radius && plane.area >= min_face_area &&
           plane.area + face_area_error >= vent_area(plane.radius.low);
  }

  /// From the middle.
  double reach() const { return reach_; }

  Span certain(double y, double z) const {
    Span span = around();
    if (!is_certain_) return {0, -1};
    cut(span, own_.middle, own_.normal, own_.radius.low - margin_, y, z);
    for (const HalfSpace& plane : work_.certain) {
      if (span.is_empty()) break;
      cut(span, plane, y, z);
    }
    return span;
  }
  Span possible(double y, double z) const {
    Span span = around();
    if (has_good_axis(own_.normal))
      cut(span, own_.middle, own_.normal, own_.radius.high + margin_, y, z);
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
  Span around() const { return {own_.middle.x - reach_, own_.middle.x + reach_}; }

  const VentPlane& own_;
  const double margin_;
  VentRowsWorkspace& work_;
  bool is_certain_;
  double reach_;
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
    const auto part = [&](const double* v, size_t count, double at, size_t& first) {
      const double *const begin = std::lower_bound(v, v + count, at - vent.reach()),
                          *const end = std::upper_bound(begin, v + count, at + vent.reach());
      first = static_cast<size_t>(begin - v);
      return static_cast<size_t>(end - v);
    };
    size_t j0, k0;
    const size_t j1 = part(rows.y, rows.rows, plane.middle.y, j0),
                 k1 = part(rows.z, rows.layers, plane.middle.z, k0);
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
