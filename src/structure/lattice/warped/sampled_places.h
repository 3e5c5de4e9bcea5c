// SPDX-License-Identifier: Apache-2.0
// Cells by a map that the host samples. Each node is placed once, when the lattice is made: where
// the map has its coordinates. Nodes whose coordinates the map does not have are none, nor are
// their struts.
//
// The lists of near struts are those of cubes, since the points of a cell have no simple bounds.
// Boxes of the struts of a cell, of 8 cells, of 64 and so on find the struts near a box.
#pragma once

#include <vector>

#include "base/memory.h"
#include "cell/sampled_map.h"
#include "structure/lattice/cell/unit_cell.h"
#include "structure/lattice/warped/cell_places.h"

namespace msq {

class SampledPlaces final : public CellPlaces {
 public:
  static constexpr double max_cells = 1 << 24;

  /// Throws Error(limit) if the map has more than max_cells cells, or if the budget is exceeded.
  SampledPlaces(std::shared_ptr<const SampledMap> map, const UnitCell& cell,
                std::shared_ptr<MemoryBudget> budget);

  const Neighbourhood& smallest() const override { return smallest_; }
  double largest() const override { return map_->largest_size(); }
  bool is_alike_from_origin() const override { return false; }
  CellIndex cell_of(Vec3 g) const override;
  CellIndex list_of(Vec3 g) const override;
  Box3 list_bounds(CellIndex list) const override;
  CellIndex nearest_with_struts(CellIndex cell) const override;
  Vec3 place(CellIndex cell, Vec3 fraction) const override;
  Box3 bounds(const CellBlock& cells) const override;
  void for_each_block(const Box3& box, const TakeBlock& take) const override;
  void describe(HashInput& input) const override { map_->describe(input); }

 private:
  /// In multiples of unit_.
  struct Bounds {
    float min[3], max[3];
    void add(const Bounds& other);
    bool overlaps(const Box3& box) const;
    Box3 box(double unit) const;
  };
  struct Level {
    uint64_t size[3];
    std::vector<Bounds> bounds;
    const Bounds& at(uint64_t x, uint64_t y, uint64_t z) const {
      return bounds[(z * size[1] + y) * size[0] + x];
    }
  };
  void place_nodes();
  void bound_cells();
  /// The place of a cell in the tables; false beyond them.
  bool index_of(CellIndex cell, uint64_t (&at)[3]) const;
  void visit(size_t level, const uint64_t (&block)[3], const Box3& box,
             const TakeBlock& take) const;

  std::shared_ptr<const SampledMap> map_;
  Neighbourhood smallest_;
  double side_;                  // of the lists' cubes
  double unit_;                  // a power of two near that
  std::vector<Vec3> fractions_;  // of nodes, ascending
  CellIndex first_;              // of the tables
  Reservation reservation_;
  std::vector<Vec3> nodes_;    // by cell, then by fraction; NaN: none
  std::vector<Level> levels_;  // cells first
};

}  // namespace msq
