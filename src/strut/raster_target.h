// SPDX-License-Identifier: Apache-2.0
// The inputs and outputs of the raster kernels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/vec.h"

namespace msq {

struct RasterTarget {
  const double *y, *z;  ///< rows and layers; y is padded by a vector
  size_t rows, layers;
  size_t row_words, layer_words;  ///< stride of rows and of layers
  uint64_t* certain;              ///< padded by a word
  double x0, inverse_dx;          ///< column i is at x0 + i / inverse_dx
  double dy, dz;                  ///< step of rows and of layers; dz 0: not evenly spaced
  double last;                    ///< last column
  double slack;                   ///< in columns: bounds the rounding of a column number,
                                  ///< generously
  double margin;                  ///< of radii, in model units

  uint64_t* row(size_t j, size_t k) const { return certain + k * layer_words + j * row_words; }
};

/// Columns [first, first + count) of a row for which one strut of the batch is undecided.
struct DoubtfulSpan {
  uint32_t strut, j, k, first, count;
};

/// Spans, to which kernels add without a branch on each: they write some and say how many count.
class DoubtfulSpans {
 public:
  void clear() { count_ = 0; }
  size_t size() const { return count_; }
  const DoubtfulSpan& operator[](size_t n) const { return spans_[n]; }
  void push_back(const DoubtfulSpan& span) {
    *room(1) = span;
    ++count_;
  }
  /// Where the next spans go, at most `most`. They count once count() has said so.
  DoubtfulSpan* room(size_t most) {
    if (spans_.size() < count_ + most) spans_.resize(2 * (count_ + most));
    return spans_.data() + count_;
  }
  /// The spans before `end` count.
  void count(const DoubtfulSpan* end) { count_ = static_cast<size_t>(end - spans_.data()); }

 private:
  size_t count_ = 0;
  std::vector<DoubtfulSpan> spans_;
};

/// The rows and layers that a strut may meet: [j0, j1) of [k0, k1).
struct RowRange {
  size_t j0, j1, k0, k1;
};

/// The axis of a capsule, from its end a; x is relative to a.x.
struct CapsuleAxis {
  double dx, dy, dz, length, ux, uy, uz;
  double across;  ///< uy^2 + uz^2
  bool is_point, along_x;

  CapsuleAxis(Vec3 a, Vec3 b, double radius) {
    const Vec3 ab = b - a;
    dx = ab.x;
    dy = ab.y;
    dz = ab.z;
    length = msq::length(ab);
    is_point = !(length > 1e-14 * radius);
    const double inverse = is_point ? 0 : 1 / length;
    ux = ab.x * inverse;
    uy = ab.y * inverse;
    uz = ab.z * inverse;
    across = uy * uy + uz * uz;
    along_x = across < 1e-28;
  }
};

}  // namespace msq
