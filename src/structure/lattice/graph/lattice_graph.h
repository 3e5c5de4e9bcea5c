// SPDX-License-Identifier: Apache-2.0
// The graph of a lattice: nodes and struts of tiled unit cells, each once.
//
// A node that lies on a face of its cell, or on an edge or corner, is a node of several cells. Its
// owner is the cell in which its coordinates are in [0, 1), and nodes of the library whose
// positions there are equal are one. A strut between two nodes belongs, along each axis, to the
// lower of their owners. So a strut on a face between two cells belongs to the upper one, whichever
// of the two has it. A strut's box lies in the closed box of its owner.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/checked.h"
#include "structure/common/struts.h"
#include "structure/lattice/cell/unit_cell.h"

namespace msq {

class LatticeGraph {
 public:
  explicit LatticeGraph(const std::vector<UnitCell>& library);

  struct End {
    uint32_t node;
    std::array<int32_t, 3> offset;  ///< of the node's owner from that of the strut, 0 or 1 each
  };
  struct Edge {
    End a, b;
  };
  /// Edges are numbered as struts of the library are; struts that are equal have the number of the
  /// first of them.
  struct Use {
    uint32_t edge;
    double factor;
  };

  /// Position of a node in its owner, in cell sizes.
  Vec3 node(uint32_t number) const { return nodes_[number]; }
  const Edge& edge(uint32_t number) const { return edges_[number]; }
  size_t node_count() const { return nodes_.size(); }
  size_t edge_count() const { return edges_.size(); }

  /// The struts that a cell owns if the cell that is `back` before it (bit 0: along x, bit 1: along
  /// y, bit 2: along z) is of a type of the library.
  const std::vector<Use>& uses(size_t type, uint32_t back) const { return uses_[8 * type + back]; }
  /// The struts that a cell owns if all cells have the only type of the library, in the order of
  /// numbers, with the greatest factor of those that are equal.
  const std::vector<Use>& periodic() const { return periodic_; }
  double max_factor() const { return max_factor_; }

  /// The same order and factors for uses of several cells.
  static void merge(std::vector<Use>& uses);

 private:
  std::vector<Vec3> nodes_;  // by the number of the first of equal nodes
  std::vector<Edge> edges_;
  std::vector<std::vector<Use>> uses_;
  std::vector<Use> periodic_;
  double max_factor_ = 0;
};

/// The struts of cells, in blocks of cells. As it is, all cells have the only type of the library.
class LatticeStruts : public StrutsOfOne {
 public:
  /// Refers to all but the selection.
  LatticeStruts(const LatticeGraph& graph, const Neighbourhood& grid, const Parameter& radius,
                const StrutSelection& selection);

  uint64_t count() const final {
    return checked_product(checked_product(blocks_[0], blocks_[1], "blocks of cells"), blocks_[2],
                           "blocks of cells");
  }
  void append(uint64_t part, StrutList& list) const final;
  double radius_at(const Strut& strut, double factor, double t, Vec3 p) const final;

 protected:
  /// A box of cells.
  struct Block {
    CellIndex first;
    int32_t size[3];
  };
  class Finder {
   public:
    virtual ~Finder() = default;
    /// The struts that a cell owns, by its place in the block; valid until the next call.
    virtual const std::vector<LatticeGraph::Use>& find(int32_t x, int32_t y, int32_t z) = 0;
  };
  virtual std::unique_ptr<Finder> finder(const Block& block) const;

  const LatticeGraph& graph_;

 private:
  const Neighbourhood& grid_;
  const Parameter& radius_;
  const StrutSelection selection_;
  const StrutCells cells_;
  int64_t side_ = 1;  // of a block
  uint64_t blocks_[3];
};

}  // namespace msq
