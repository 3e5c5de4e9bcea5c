// SPDX-License-Identifier: Apache-2.0
// A foam with struts and walls: the union of both.
#pragma once

#include "structure/common/walled_struts.h"
#include "structure/foam/foam.h"
#include "structure/foam/walls/foam_walls.h"

namespace msq {

class WalledFoam final : public WalledStruts {
 public:
  /// Both of the same seeds.
  WalledFoam(const Ref<const Foam>& struts, const Ref<const FoamWalls>& walls)
      : WalledStruts(struts, walls) {}

 private:
  void describe(HashInput& input) const override {
    input.kind("structure: foam of struts and walls");
    input.object(strut_part());
    input.object(wall_part());
  }
};

}  // namespace msq
