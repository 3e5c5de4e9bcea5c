// SPDX-License-Identifier: Apache-2.0
// As CellLists, for foams with graded seeds: the edges come from bricks (graded_edges.h), and the
// list of a cell is kept in the cell cache.
#pragma once

#include <array>
#include <memory>
#include <unordered_map>
#include <vector>

#include "cell/cell_hash.h"
#include "structure/foam/edges/graded_edges.h"
#include "structure/foam/foam_data.h"
#include "structure/foam/rays/strut_entry.h"
#include "strut/capsule_rays.h"

namespace msq {

class GradedLists {
 public:
  void move_to(const FoamData& foam);
  void forget();
  bool is_full() const { return numbers_.size() >= max_bricks / 2; }
  uint64_t era() const { return era_; }

  const CapsuleView& list(CellIndex cell);
  /// The line of a strut of the last list.
  StrutLine line(const StrutEntries& entries, uint32_t id) const;

 private:
  static constexpr uint32_t edge_bits = 20, max_bricks = 1u << (32 - edge_bits);

  /// The cached data of a cell.
  struct Cell final : CellData {
    std::vector<float> ends;  // a x, a y, .. ab z, each for all edges with padding
    std::vector<GradedEdge> edges;
    std::vector<CellIndex> bricks;
    struct Origin {
      uint32_t brick;  // of that brick
      uint32_t number;
    };
    std::vector<Origin> origins;
    uint64_t bytes() const override;
  };
  struct List {
    CellIndex cell;
    std::shared_ptr<const Cell> data;
    std::vector<uint32_t> ids;
    CapsuleView view;
  };

  std::shared_ptr<const Cell> make_cell(CellIndex cell);
  std::shared_ptr<const GradedEdges> brick(CellIndex corner);

  const FoamData* foam_ = nullptr;
  uint64_t era_ = 0;
  std::unordered_map<CellIndex, List, CellHash> lists_;
  std::unordered_map<CellIndex, uint32_t, CellHash> numbers_;  // of bricks
  std::unordered_map<CellIndex, std::shared_ptr<const GradedEdges>, CellHash> bricks_;
  std::array<const List*, 64> recent_{};
  size_t recent_count_ = 0;
};

}  // namespace msq
