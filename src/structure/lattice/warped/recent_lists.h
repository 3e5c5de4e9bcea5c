// SPDX-License-Identifier: Apache-2.0
// The lists of struts of the cells that were evaluated last, without the locks of the cell cache.
#pragma once

#include "structure/lattice/rays/strut_rays.h"
#include "structure/lattice/warped/warped_lattice.h"

namespace msq {

class RecentLists final : public StrutLists {
 public:
  explicit RecentLists(const WarpedLattice& lattice) : lattice_(lattice) {}

  /// Valid until the next call.
  const NearStruts& find(CellIndex cell);

  // For rays: the struts of the cell that was found last. Each cell is one part.
  const CapsuleList& struts() const override { return last_->struts(); }
  int parts() const override { return 1; }
  void find(CellIndex cell, const int (&)[3], std::vector<Run>& runs) override {
    runs.push_back({0, static_cast<uint32_t>(find(cell).struts().size())});
  }
  const Box3* box_about(Vec3 p, CellIndex& cell) override {
    cell = lattice_.list_of(p);
    return &find(cell).box();
  }

 private:
  static constexpr size_t places = 64;
  struct Place {
    CellIndex cell;
    WarpedLattice::List list;
  };

  const WarpedLattice& lattice_;
  const NearStruts* last_ = nullptr;
  Place places_[places];
};

}  // namespace msq
