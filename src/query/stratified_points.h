// SPDX-License-Identifier: Apache-2.0
// A stratified random sample: a fixed number of points in each cell of a box, uniform in the cell.
// Each point is a pure function of the seed and of its number (base/random.h), so none is stored.
// Point s of cell (i, j, k) has number s + n (i + nx (j + ny k)), n being the points per cell.
// Source: paper, section "Structured and Unstructured Set Queries"; Cochran, "Sampling Techniques",
// 1977, chapter 5, for the estimates from such samples.
#pragma once

#include "base/random.h"
#include "query/bricks.h"
#include "query/point_set.h"

namespace msq {

struct Strata {
  Vec3 origin;                     ///< corner of cell (0, 0, 0)
  Vec3 cell_size{1, 1, 1};         ///< along the axes of the frame
  Rotation rotation;               ///< of the frame about the origin
  Bricks::Counts counts{1, 1, 1};  ///< of cells
  uint64_t per_cell = 1;
  uint64_t seed = 0;

  uint64_t cells() const { return counts[0] * counts[1] * counts[2]; }
};

class StratifiedPoints final : public PointSet {
 public:
  explicit StratifiedPoints(const Strata& strata);

  const Strata& strata() const { return strata_; }

  uint64_t count() const override { return strata_.cells() * strata_.per_cell; }
  void read(uint64_t first, uint64_t count, Vec3* out) const override;
  void gather(uint64_t first, std::span<const uint32_t> numbers, Vec3* out) const override;
  /// Bricks of whole cells if a cell has at most max_in_part points, otherwise pieces of a cell.
  /// Points of a cell are consecutive.
  uint64_t parts() const override { return bricks_.count() * pieces_; }
  void read_part(uint64_t index, Part& part) const override;
  bool is_compact() const override { return pieces_ == 1; }
  bool find_bounds(Box3& box) const override;

 private:
  Vec3 at(uint64_t i, uint64_t j, uint64_t k, uint64_t number) const {
    const Vec3 cell{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
    const Vec3 within{fraction(3 * number), fraction(3 * number + 1), fraction(3 * number + 2)};
    return strata_.origin + strata_.rotation.apply((cell + within) * strata_.cell_size);
  }
  /// In [0, 1).
  double fraction(uint64_t n) const { return random_fraction(splitmix_output(key_, n)); }

  Strata strata_;
  uint64_t key_;
  Bricks bricks_;
  uint64_t pieces_;  // into which a cell is divided
};

}  // namespace msq
