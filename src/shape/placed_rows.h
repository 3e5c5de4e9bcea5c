// SPDX-License-Identifier: Apache-2.0
// Rows of a shape that a map has placed: those of a closed mesh by its triangles, placed; those of
// other shapes by their distance (row_boxes.h).
//
// A point p is inside a placed mesh if the mesh holds the point that p is mapped back to. The
// vertices of placed triangles are rounded, and so is the point that p is mapped back to. Let
// `error` exceed both roundings, and those of the crossings of rows in either frame, together
// (mesh_map.h).
//
// Move the placed vertices to their exact places, and p to the exact place of the point it is
// mapped back to. If p is farther than `error` from all placed triangles, no triangle meets p on
// the way. So the winding number about it is the same at the end, and a map that mirrors turns its
// sign. Rounded crossings are within their error of the triangle, and so is the way of a row to its
// exact crossing; the same holds for them.
//
// Samples within `error` of a placed triangle are asked of the definition one by one. They are
// found from the triangle's part between the planes at z - error and z + error.
#pragma once

#include "base/lazy.h"
#include "shape/shape.h"

namespace msq {

class PlacedRows {
 public:
  PlacedRows();
  ~PlacedRows();

  /// Builds what fill() needs; otherwise its first call does. Throws Error(limit) if the memory
  /// limit is exceeded, Error(cancelled) if the job, which may be null, is cancelled.
  void prepare(const Shape& shape, const Job* job) const;
  /// Sets the bits of the samples that are inside the placed shape, always the same one, in a block
  /// of zeros.
  void fill(const Shape& shape, const RowBlock& block) const;

 private:
  class Triangles;
  const Triangles& triangles(const Shape& shape, const Job* job) const;

  Lazy<Triangles> triangles_;
};

}  // namespace msq
