// SPDX-License-Identifier: Apache-2.0
// A lattice with struts and plates in each cell: the union of both.
#pragma once

#include "structure/common/walled_struts.h"
#include "structure/lattice/lattice.h"
#include "structure/lattice/plates/plate_lattice.h"

namespace msq {

class PlatedLattice final : public WalledStruts {
 public:
  /// Both on the same grid.
  PlatedLattice(const Ref<const Lattice>& struts, const Ref<const PlateLattice>& plates)
      : WalledStruts(struts, plates) {}

 private:
  void describe(HashInput& input) const override {
    input.kind("structure: lattice of struts and plates");
    input.object(strut_part());
    input.object(wall_part());
  }
};

}  // namespace msq
