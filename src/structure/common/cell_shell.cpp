// SPDX-License-Identifier: Apache-2.0
#include "structure/common/cell_shell.h"

#include <algorithm>
#include <cmath>

namespace msq {

KeptPoint CellShell::kept(Vec3 p) const {
  return {holds(p), std::abs(distance_within(p))};
}

double CellShell::follow(const Ray& ray, double t, double to, double tolerance) const {
  return follow_part(t, to, tolerance, [&](double at) { return holds(ray.at(at)); });
}

bool CellShell::keep_rows(const RowBlock& block, const Job* job) const {
  JobPoll poll(job);
  bool is_any = false;
  for (uint64_t k = block.z0; k < block.z1; ++k)
    for (uint64_t j = block.y0; j < block.y1; ++j) {
      poll();
      Row row(*this, *block.grid, j, k, block.row(j, k));
      if (!row.has_any()) continue;
      keep_row(row);
      is_any = is_any || row.has_any();
    }
  return is_any;
}

bool CellShell::Row::has_any() const {
  return std::any_of(bits_, bits_ + words_for(grid_.nx), [](uint64_t w) { return w != 0; });
}

void CellShell::Row::decide(uint64_t first, uint64_t end) {
  for (uint64_t i = first; i < end; ++i) {
    uint64_t& word = bits_[i / bits_per_word];
    const uint64_t bit = uint64_t{1} << i % bits_per_word;
    if (word & bit && !shell_.holds(grid_.at(i, j_, k_))) word &= ~bit;
  }
}

void CellShell::Row::clear(uint64_t first, uint64_t end) {
  for (uint64_t i = first; i < end;) {
    const uint64_t bit = i % bits_per_word,
                   count = std::min<uint64_t>(bits_per_word - bit, end - i);
    bits_[i / bits_per_word] &= ~(~uint64_t{0} >> (bits_per_word - count) << bit);
    i += count;
  }
}

}  // namespace msq
