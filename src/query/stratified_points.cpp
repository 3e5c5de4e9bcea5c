// SPDX-License-Identifier: Apache-2.0
#include "query/stratified_points.h"

#include "cell/neighbourhood.h"

namespace msq {

namespace {

/// Differs from the stream of a foam's seeds, so that a sample and a foam with the same seed number
/// are independent.
uint64_t key_of(uint64_t seed) {
  return splitmix_finalise(splitmix_finalise(seed + 1) ^ 0x73747261746966ULL);
}

}  // namespace

StratifiedPoints::StratifiedPoints(const Strata& strata)
    : strata_(strata),
      key_(key_of(strata.seed)),
      bricks_(strata.counts, strata.cell_size,
              max_in_part / std::min(max_in_part, strata.per_cell)),
      pieces_((strata.per_cell + max_in_part - 1) / max_in_part) {}

bool StratifiedPoints::find_bounds(Box3& box) const {
  const Vec3 counts{static_cast<double>(strata_.counts[0]), static_cast<double>(strata_.counts[1]),
                    static_cast<double>(strata_.counts[2])};
  const Neighbourhood frame{strata_.origin, strata_.cell_size, strata_.rotation};
  box = frame.from_grid(Box3{{}, counts * strata_.cell_size});
  return true;
}

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
  const uint64_t begin = piece * max_in_part, end = std::min(n, begin + max_in_part);
  bricks_.for_each_cell(index / pieces_, [&](uint64_t i, uint64_t j, uint64_t k) {
    const uint64_t cell = i + strata_.counts[0] * (j + strata_.counts[1] * k);
    for (uint64_t s = begin; s < end; ++s) {
      part.numbers.push_back(cell * n + s);
      part.positions.push_back(at(i, j, k, cell * n + s));
    }
  });
}

}  // namespace msq
