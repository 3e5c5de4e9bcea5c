// SPDX-License-Identifier: Apache-2.0
// The void of a cell, which is convex, cut out of rows of samples: one span in each.
//
// A sample x (from the seed, in foam units) is in the void where n . x < d - t / 2 for all faces, n
// being a face's normal, d its distance from the seed and t the thickness. Spans are found in
// single precision, twice: of the void with all planes moved inwards by a margin, whose samples are
// cleared, and of that with them moved outwards by it. Samples between are in doubt: the predicate
// decides them.
//
// The error in single precision, in units of 2^-24 and as a shift of a plane. All coordinates are
// within r (ends of spans are cut off there), components of n within 1.25 (a gradient of the
// thickness tilts planes by a quarter at most), and so d within 1.75 r. Rounding of n: 3 r; of d:
// 2 r; of y and z: 2.5 r; of the slopes n_y / n_x and n_z / n_x, which two roundings each go into:
// 5 r; of d / n_x: 3.5 r; of the same with the margin: 2 r; of the products and sums: 7 r; of x and
// of its place among the samples, a few roundings of x and of one step: 4 r + 4. Together 29 r + 4.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/vec.h"
#include "structure/foam/walls/face_brick.h"

namespace msq {

/// In foam units, of cells whose coordinates from the seed are within `reach`.
constexpr double void_margin(double reach) {
  return (30 * reach + 4) * 0x1p-24;
}
/// No point of a cell is farther from its seed.
constexpr double max_void_reach = 2;

/// A plane, foam units along the axes of the samples: n . x <= offset, within `margin`.
struct VoidPlane {
  float n[3];
  float offset, margin;
};

/// The faces of a cell, moved inwards.
struct VoidFaces {
  const FaceBrick::Face* faces;  ///< along the axes of the grid
  size_t count;
  Rotation rotation;  ///< to the axes of the samples
  // By half the thickness: `half` + `tilt` . x, within `margin`, which includes that of rounding.
  double half;
  Vec3 tilt;
  float margin;
  float reach;  ///< of the cell: no coordinate of it, from the seed, is greater

  VoidPlane plane(size_t i) const {
    const FaceBrick::Face& face = faces[i];
    const Vec3 n = rotation.apply({face.normal[0], face.normal[1], face.normal[2]}) + tilt;
    return {{static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)},
            static_cast<float>(face.distance - half),
            margin};
  }
};

/// The samples that may be in the void of a cell.
struct VoidRows {
  const float *y, *z;  ///< of rows, at equal distances, and layers, from the seed; vectors are read
  size_t rows, layers;
  uint32_t first_row, first_layer;  ///< in the block
  uint64_t* words;                  ///< of the first row
  size_t row_stride, layer_stride;
  float per_unit;      ///< samples along x in a foam unit
  float seed_after;    ///< where the seed is along x, in samples after sample `base`
  int64_t base, last;  ///< the latter of the row
};

/// Samples first ... first + count - 1 of a row of the block.
struct DoubtfulSamples {
  uint32_t row, layer;
  uint64_t first;
  uint32_t count;
};

/// More samples than this in a foam unit have no place in single precision.
constexpr double max_per_unit = 1 << 20;

/// Clears the samples of the void; appends those that are not decided.
void clear_void(const VoidFaces& faces, const VoidRows& rows, std::vector<DoubtfulSamples>& doubts);

}  // namespace msq
