// SPDX-License-Identifier: Apache-2.0
// The void in the hole of a wall, cut out of rows of samples on one side of the face.
//
// A sample x of the cell of a seed that is in the slab of a face b, within half the thickness of
// it, is in the void where it is in the hole of b and, of each other slab that holds it, in that
// one's hole. So the void in the hole of b consists of the convex region
//
//   cell, with all planes but that of b moved inwards by half the thickness, and the cylinder of b
//
// and of samples in another slab, and in its hole. Such a hole meets that of b: both middles are
// within sqrt(radius^2 + (thickness / 2)^2) of the sample. Samples of the region are cleared. Those
// of the region with the planes of such holes not moved are in doubt, as are those within rounding.
// Where rounding may make a face, or leave it out, its plane is moved for the former and not for
// the latter.
//
// In double precision, from planes in single precision; the margin is that of void_spans.h.
#pragma once

#include <vector>

#include "field/field.h"
#include "structure/foam/walls/void_spans.h"
#include "structure/foam/walls/wall_face.h"

namespace msq {

/// A face of a cell, foam units along the axes of the samples, from the seed.
struct VentPlane {
  VoidPlane moved;  ///< inwards, by half the thickness
  Vec3 normal;      ///< of the face, outwards
  double distance;  ///< of the face
  double area;
  Vec3 middle;
  double error;     ///< of the middle, at most
  Interval radius;  ///< of the hole
};

/// The samples near a seed, as VoidRows has them.
struct VentRows {
  const double *y, *z;  ///< of rows and layers in the block, from the seed, foam units
  size_t rows, layers;
  uint32_t first_row, first_layer;  ///< in the block
  uint64_t* words;                  ///< of the first row
  size_t row_stride, layer_stride;
  double per_unit;  ///< samples along x in a foam unit
  double seed;      ///< where the seed is along x, in samples
  int64_t last;     ///< sample of the row
};

/// Clears samples in the void of the cell in holes; appends those that are not decided.
/// `half`: half the thickness at most. `margin`: of planes that are not moved.
void clear_vents(const std::vector<VentPlane>& planes, double half, double margin,
                 const VentRows& rows, std::vector<DoubtfulSamples>& doubts);

}  // namespace msq
