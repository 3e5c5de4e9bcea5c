// SPDX-License-Identifier: Apache-2.0
#include "query/stratified_points.h"

namespace msq {

namespace {

/// Another stream than that of a foam's seeds, so that a sample and a foam of one seed number have
/// nothing in common.
uint64_t key_of(uint64_t seed) {
  return splitmix_finalise(splitmix_finalise(seed + 1) ^ 0x73747261746966ULL);
}

}  // namespace

StratifiedPoints::StratifiedPoints(const Strata& strata)
    : strata_(strata),
      key_(key_of(strata.seed)),
      bricks_(strata.counts, strata.cell_size,
              most_in_part / std::min(most_in_part, strata.per_cell)),
      pieces_((strata.per_cell + most_in_part - 1) / most_in_part) {}

void StratifiedPoints::read(uint64_t first, uint64_t count, Vec3* out) const {
  const uint64_t n = strata_.per_cell, nx = strata_.counts[0], ny = strata_.counts[1];
  uint64_t cell = first / n, rest = first % n;
  uint64_t i = cell % nx, j = cell / nx % ny, k = cell / nx / ny;
  for (uint64_t number = first; number < first + count; ++number) {
    *out++ = at(i, j, k, number);
    if (++rest < n) continue;
    rest = 0;
    if (++i < nx) continue;
    i = 0;
    if (++j < ny) continue;
    j = 0;
    ++k;
  }
}

void StratifiedPoints::gather(uint64_t first, std::span<const uint32_t> numbers, Vec3* out) const {
  const uint64_t nx = strata_.counts[0], ny = strata_.counts[1];
  for (size_t p = 0; p < numbers.size(); ++p) {
    const uint64_t number = first + numbers[p], cell = number / strata_.per_cell;
    out[p] = at(cell % nx, cell / nx % ny, cell / nx / ny, number);
  }
}

void StratifiedPoints::read_part(uint64_t index, Part& part) const {
  part.numbers.clear();
  part.positions.clear();
  const uint64_t n = strata_.per_cell, piece = index % pieces_;
  const uint64_t begin = piece * most_in_part, end = std::min(n, begin + most_in_part);
  bricks_.for_each_cell(index / pieces_, [&](uint64_t i, uint64_t j, uint64_t k) {
    const uint64_t cell = i + strata_.counts[0] * (j + strata_.counts[1] * k);
    for (uint64_t s = begin; s < end; ++s) {
      part.numbers.push_back(cell * n + s);
      part.positions.push_back(at(i, j, k, cell * n + s));
    }
  });
}

}  // namespace msq
