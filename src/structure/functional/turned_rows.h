// SPDX-License-Identifier: Apache-2.0
// Rows of samples that are oblique to a functional structure's grid.
#pragma once

#include <optional>
#include <vector>

#include "structure/functional/functional.h"
#include "structure/functional/turned_products.h"
#include "structure/functional/turned_starts.h"
#include "structure/functional/turned_waves.h"

namespace msq {

class TurnedRows {
 public:
  TurnedRows(const Functional& structure, const RowBlock& block);

  /// Clears the bits of samples that are outside.
  void keep(const Job* job);

 private:
  void keep_group(const RowGroup& group);

  const Functional& structure_;
  const RowBlock& block_;
  TurnedStarts starts_;
  double slack_ = 0;
  LevelBounds bounds_;
  // One of them.
  std::optional<TurnedWaves> waves_;
  std::optional<TurnedProducts> products_;
  std::vector<uint32_t> words_;  // of a group's rows, from the first to the last with samples alive
};

}  // namespace msq
