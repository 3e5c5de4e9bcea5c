// SPDX-License-Identifier: Apache-2.0
// The struts that can contain points of each part of a cell, for a lattice whose cells are all
// equal.
#pragma once

#include "structure/lattice/rays/strut_rays.h"

namespace msq {

/// The lists.
class CellParts {
 public:
  /// near: the struts that can contain points of a cell, from its corner; `most`: the maximum
  /// radius.
  CellParts(const std::vector<LatticeStrut>& near, Vec3 cell_size, double most);

  /// Number along each axis of a cell: a power of two.
  int parts() const { return parts_; }
  const CapsuleList& struts() const { return struts_; }
  /// The list of a part, given the number of the parts before it: along x, then y, then z.
  StrutLists::Run run(size_t part) const { return runs_[part]; }
  size_t max_struts() const { return max_struts_; }

 private:
  int parts_ = 1;
  CapsuleList struts_;                 // part by part
  std::vector<StrutLists::Run> runs_;  // of each
  size_t max_struts_ = 0;              // in a list
};

/// The same for every cell.
class PartLists final : public StrutLists {
 public:
  explicit PartLists(const CellParts& parts) : parts_(parts) {}

  const CapsuleList& struts() const override { return parts_.struts(); }
  int parts() const override { return parts_.parts(); }
  void find(CellIndex, const int (&part)[3], std::vector<Run>& runs) override {
    const int n = parts_.parts();
    runs.push_back(parts_.run(static_cast<size_t>((part[2] * n + part[1]) * n + part[0])));
  }

 private:
  const CellParts& parts_;
};

}  // namespace msq
