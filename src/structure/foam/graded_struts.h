// SPDX-License-Identifier: Apache-2.0
// As CellStruts, for foams whose seeds are graded: the edges come from bricks (graded_edges.h), the
// list of a cell is kept in the cell cache.
#pragma once

#include <array>
#include <memory>
#include <unordered_map>
#include <vector>

#include "cell/cell_hash.h"
#include "structure/foam/foam.h"
#include "structure/foam/graded_edges.h"
#include "structure/foam/strut_entry.h"
#include "strut/capsule_rays.h"

namespace msq {

class GradedStruts {
 public:
  void move_to(const Foam& foam);
  void forget();
  bool is_full() const { return numbers_.size() >= most_bricks / 2; }
  uint64_t era() const { return era_; }

  const CapsuleView& list(CellIndex cell);
  /// Of a strut of the lists that were asked for last.
  StrutLine line(const StrutEntries& entries, uint32_t id) const;

 private:
  static constexpr uint32_t edge_bits = 20, most_bricks = 1u << (32 - edge_bits);

  /// What is kept of a cell.
  struct Cell final : CellData {
    std::vector<float> ends;  // a x, a y, .. ab z, each of all edges and padding
    std::vector<GradedEdge> edges;
    std::vector<CellIndex> bricks;
    struct Origin {
      uint32_t brick;  // of the above
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

  const Foam* foam_ = nullptr;
  uint64_t era_ = 0;
  std::unordered_map<CellIndex, List, CellHash> lists_;
  std::unordered_map<CellIndex, uint32_t, CellHash> numbers_;  // of bricks
  std::unordered_map<CellIndex, std::shared_ptr<const GradedEdges>, CellHash> bricks_;
  std::array<const List*, 64> recent_{};
  size_t recent_count_ = 0;
};

}  // namespace msq
