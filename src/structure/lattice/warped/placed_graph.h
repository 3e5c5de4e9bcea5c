// SPDX-License-Identifier: Apache-2.0
// The struts of a unit cell, placed in cells that vary in size or are bent. A node that several
// cells share is placed from its owner (graph/lattice_graph.h), so it is one point in all of them.
// On an axis and at poles the nodes of all cells around are one: that of the first cell with the
// lowest number.
#pragma once

#include <array>
#include <vector>

#include "structure/lattice/cell/unit_cell.h"
#include "structure/lattice/graph/lattice_graph.h"
#include "structure/lattice/warped/cell_places.h"

namespace msq {

class PlacedGraph {
 public:
  /// Refers to the places.
  PlacedGraph(const UnitCell& cell, const CellPlaces& places);

  /// A strut that each cell owns: numbers of its ends in corners().
  struct Strut {
    uint32_t a, b;
    uint32_t edge;  // in the graph
    double factor;
  };
  /// Of cells that have neighbours on all sides; the thickest first.
  const std::vector<Strut>& struts() const { return struts_[0]; }
  /// Of a cell, in the same order. At the ends of the cells a cell owns the struts of those that
  /// there are.
  const std::vector<Strut>& struts_of(CellIndex cell) const {
    const CellPlaces::Ends ends = places_.ends(cell);
    size_t number = 0;
    for (int axis = 3; axis-- > 0;) number = 3 * number + static_cast<size_t>(ends.along[axis]);
    return struts_[number];
  }
  const std::vector<LatticeGraph::End>& corners() const { return corners_; }
  double max_factor() const { return factors_.front(); }
  /// All values of struts, each once, the greatest first.
  const std::vector<double>& factors() const { return factors_; }
  const CellPlaces& places() const { return places_; }

  struct Node {
    CellIndex cell;
    uint32_t number;
    unsigned folded_axes;  // CellPlaces::folded_axes()
    friend bool operator==(const Node& a, const Node& b) {
      return a.cell == b.cell && a.number == b.number;
    }
  };
  /// The node at a corner of a cell.
  Node node(CellIndex cell, const LatticeGraph::End& corner) const;
  /// Writes the corners of a canonical cell, in grid coordinates.
  void place(CellIndex cell, std::vector<Vec3>& corners) const;
  /// Whether both ends of a strut have a place.
  static bool is_placed(const std::vector<Vec3>& corners, const Strut& strut) {
    return is_finite(corners[strut.a]) && is_finite(corners[strut.b]);
  }
  /// Whether a strut that a canonical cell owns, by its place in struts_of(), is one of the graph:
  /// where nodes are one, so that struts coincide, the thickest is, and none of length 0.
  bool is_in_graph(CellIndex cell, size_t number) const;

 private:
  const CellPlaces& places_;
  LatticeGraph graph_;
  std::vector<LatticeGraph::End> corners_;
  std::array<std::vector<Strut>, 27> struts_;  // by Ends, the first axis changing fastest
  std::vector<double> factors_;
};

}  // namespace msq
