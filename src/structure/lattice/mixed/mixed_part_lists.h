// SPDX-License-Identifier: Apache-2.0
// The struts that can contain points of each part of a cell, for a lattice whose unit cell changes
// from one cell to the next. For each cell around that can reach the part, and each unit cell of
// the library, they are the unit cell's struts that do reach it.
#pragma once

#include <array>
#include <functional>
#include <span>

#include "structure/lattice/rays/strut_rays.h"

namespace msq {

/// The lists for any choice of unit cells.
class MixedParts {
 public:
  struct Neighbour {
    std::array<int, 3> offset;
    /// By type; struts that may contain a point of the cell, from its corner.
    std::vector<std::span<const LatticeStrut>> near;
  };
  /// `most`: the maximum radius.
  MixedParts(const std::vector<Neighbour>& neighbours, Vec3 cell_size, double most);

 private:
  friend class MixedPartLists;

  struct Source {
    std::array<int, 3> offset;
    size_t first_run;  // of the types
  };

  int parts_;
  CapsuleList struts_;
  std::vector<std::vector<Source>> sources_;  // of each part
  std::vector<StrutLists::Run> runs_;
};

/// The lists of one lattice. Not for several threads at once: it keeps the types of cells.
class MixedPartLists final : public StrutLists {
 public:
  using TypeOf = std::function<size_t(CellIndex)>;
  MixedPartLists(const MixedParts& parts, TypeOf type_of);

  const CapsuleList& struts() const override { return parts_.struts_; }
  int parts() const override { return parts_.parts_; }
  void find(CellIndex cell, const int (&part)[3], std::vector<Run>& runs) override;

 private:
  struct Known {
    CellIndex cell;
    bool is_known = false;
    size_t type = 0;
  };

  size_t type_of(CellIndex cell);

  const MixedParts& parts_;
  TypeOf ask_;
  std::vector<Known> known_;  // by a few bits of the index
};

}  // namespace msq
