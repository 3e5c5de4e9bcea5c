// SPDX-License-Identifier: Apache-2.0
// Rows of a closed mesh that an affine map has placed. A point p is inside if the mesh holds the
// point that p is mapped back to. Rows are filled by the mesh's triangles, placed: their vertices
// are rounded, and so is the point that p is mapped back to. Let `error` exceed both roundings, and
// those of the crossings of rows in either frame, together.
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
#include "base/memory.h"
#include "base/triangle_soup.h"
#include "shape/mesh.h"
#include "shape/triangle_bins.h"

namespace msq {

class PlacedRows {
 public:
  /// If a shape is a mesh that can be drawn this way (closed, and much larger than the error), sets
  /// the bits of the samples that are inside, in a block of zeros. Otherwise returns false. rows:
  /// made at first use.
  static bool fill(const Lazy<PlacedRows>& rows, const Shape& shape, const RowBlock& block);
  /// The same, but only makes them.
  static bool prepare(const Lazy<PlacedRows>& rows, const Shape& shape, const Job* job) {
    return find(rows, shape, job) != nullptr;
  }

  /// The mesh must live as long. Throws Error(limit) if its budget is exceeded, Error(cancelled) if
  /// the job, which may be null, is cancelled.
  PlacedRows(const MeshMap& map, const Job* job);

 private:
  class Near;
  static const PlacedRows* find(const Lazy<PlacedRows>& rows, const Shape& shape, const Job* job);
  void fill(const RowBlock& block, const Shape& definition) const;
  void find_near(const RowBlock& block, uint64_t k, Near& near) const;

  const Mesh& mesh_;
  const bool is_mirrored_;
  const Box3 bounds_;
  const double error_;
  Reservation reservation_;
  TriangleSoup soup_;
  TriangleBins sheets_;  // bins of z alone
};

}  // namespace msq
