// SPDX-License-Identifier: Apache-2.0
#include "structure/lattice/warped/recent_lists.h"

#include "cell/cell_hash.h"

namespace msq {

const NearStruts& RecentLists::find(CellIndex cell) {
  Place& place = places_[hash_of(cell) % places];
  if (!place.list || !(place.cell == cell)) {
    place.list = lattice_.near(cell);
    place.cell = cell;
  }
  last_ = place.list.get();
  return *last_;
}

}  // namespace msq
