// SPDX-License-Identifier: Apache-2.0
// The struts of a lattice in warped cells as a graph.
#pragma once

#include "field/field.h"
#include "structure/common/struts.h"
#include "structure/lattice/warped/placed_graph.h"

namespace msq {

/// In blocks of cells. Ids are those of lattices in equal cells (graph/lattice_graph.h).
class WarpedStruts final : public StrutsOfOne {
 public:
  /// Refers to all but the selection. Throws Error(limit) if the box reaches cells beyond
  /// max_cell_index.
  WarpedStruts(const PlacedGraph& graph, const Neighbourhood& grid, const Parameter& radius,
               const StrutSelection& selection);

  uint64_t count() const override { return parts_; }
  void append(uint64_t part, StrutList& list) const override;
  double radius_at(const Strut& strut, double factor, double t, Vec3 p) const override;

 private:
  struct Block {
    CellBlock cells;
    uint64_t first_part, parts[3];
  };

  const PlacedGraph& graph_;
  const Neighbourhood& grid_;
  const Parameter& radius_;
  const StrutSelection selection_;
  Box3 box_;         // that selected struts meet
  double side_ = 1;  // of a part, in cells
  uint64_t parts_ = 0;
  std::vector<Block> blocks_;
};

}  // namespace msq
