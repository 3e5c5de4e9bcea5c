// SPDX-License-Identifier: Apache-2.0
// Strut lattice whose unit cell changes from one neighbourhood cell to the next. A field, the
// choice, selects the unit cell of a cell from a library: its value at the cell's centre, rounded
// to the nearest number and clamped to the library. The graph is the union, over all cells, of the
// struts of each cell's own unit cell; the solid is that of Lattice.
//
// All struts of a unit cell lie in the cell. So only the struts of cells within the maximum radius
// of a cell can contain its points. They are listed in advance for each such neighbour and each
// unit cell of the library.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/lazy.h"
#include "field/field.h"
#include "structure/lattice/cell/unit_cell.h"
#include "structure/lattice/graph/lattice_graph.h"
#include "structure/lattice/mixed/mixed_part_lists.h"
#include "structure/structure.h"

namespace msq {

/// The first and the last cell along each axis.
struct CellRange {
  double first[3], last[3];
  double count() const;  ///< of all cells
};
/// The cells whose interior meets a box in model units; on turned grids, those of its bounding box
/// along the grid's axes.
CellRange cells_of(const Neighbourhood& grid, const Box3& box);

/// Faces between cells with different unit cells.
struct MixedFaces {
  uint64_t faces = 0;
  uint64_t unmatched = 0;  ///< of these, with a node on one side that has no copy on the other
  /// The first unmatched face, cells taken by z, then y, then x: between this cell and the next
  /// along `axis`.
  CellIndex cell;
  int axis = 0;
  size_t types[2] = {};
};

class MixedLattice final : public Structure {
 public:
  static constexpr size_t max_types = 256;

  MixedLattice(const Neighbourhood& neighbourhood, std::vector<UnitCell> library, Parameter choice,
               Parameter radius);

  /// The number of a cell's unit cell in the library.
  size_t type_of(CellIndex cell) const;

  bool is_concurrent() const override { return choice_.is_concurrent() && radius_.is_concurrent(); }
  bool inside(Vec3 p) const override;
  void keep_points(const Vec3* points, uint8_t* alive, size_t count) const override;
  bool gains_by_groups() const override { return true; }
  bool gains_by_layers() const override { return true; }
  void keep_rows(const RowBlock& block, const Job* job) const override;
  std::unique_ptr<StrutParts> struts(const StrutSelection& selection) const override;
  /// Exact outside if the radius is constant, up to twice the smallest cell size.
  double distance_bound(Vec3 p) const override;
  const Parameter* sloped_parameter() const override { return &radius_; }

  void enter(RaySearch* searches, size_t count, const Job* job) const override;
  double leave(const Ray& ray, double from, double to, const Job* job) const override;
  Vec3 normal(const Ray& ray, double t) const override;

  /// Counts faces between cells of a range of fewer than 2^31. Evaluates the choice once for each
  /// cell and keeps one byte for each cell of a layer.
  MixedFaces faces(const CellRange& range, Job* job) const;

 private:
  void describe(HashInput& input) const override;
  struct Run {
    uint32_t begin = 0, end = 0;
  };
  struct Neighbour {
    int offset[3];
    double gap;  ///< between its box and that of the cell
  };
  struct OwnStrut {
    Vec3 a, b;  ///< in cell units
    double factor;
    Segment axis;  ///< in model units, from the cell's corner
  };

  std::span<const LatticeStrut> near(size_t neighbour, size_t type) const {
    const Run run = near_runs_[neighbour * library_.size() + type];
    return {near_.data() + run.begin, run.end - run.begin};
  }
  std::span<const OwnStrut> own(size_t type) const {
    return {struts_.data() + own_runs_[type].begin, own_runs_[type].end - own_runs_[type].begin};
  }
  const MixedParts& parts() const;
  MixedPartLists part_lists() const;
  void find_neighbours();
  void find_copies();

  std::vector<UnitCell> library_;
  LatticeGraph graph_;
  Parameter choice_, radius_;
  double max_factor_ = 0;
  double reach_;                       // of distance_bound(): farther struts are left out
  std::vector<Neighbour> neighbours_;  // cells within reach_ of a cell, the nearest first
  size_t near_neighbours_ = 0;         // the first ones, whose struts may contain the cell's points
  std::vector<LatticeStrut> near_;     // that may contain a point of a cell, from its corner
  std::vector<Run> near_runs_;         // for each near neighbour and type
  std::vector<OwnStrut> struts_;       // of all types, the thickest of a type first
  std::vector<Run> own_runs_;          // for each type
  std::vector<double> factors_;        // all values that occur, each once
  std::vector<uint8_t> copies_;        // see find_copies()
  Lazy<MixedParts> parts_;             // for rays
};

}  // namespace msq
