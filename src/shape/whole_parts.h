// SPDX-License-Identifier: Apache-2.0
// What the winding numbers of the row rule, through mesh and caps, exceed those of an open mesh by,
// for the samples of some layers of a grid.
//
// Far from the holes it is one number over large boxes (OpenMesh::is_whole_about()). About them
// boxes are halved down to `block` samples along a side. There the number is known sample by sample
// except close to where it changes (OpenMesh::expand()). Beside the holes' edges boxes are halved
// down to `side` samples, whose caps are summed (Caps::find_views()).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "base/sample_grid.h"
#include "shape/open_mesh.h"

namespace msq {

/// Samples [low, high) along each axis.
struct SamplePart {
  std::array<uint64_t, 3> low, high;

  uint64_t count(size_t axis) const { return high[axis] - low[axis]; }
};

/// A number for each cube of `side` samples of a part.
template <uint64_t side>
class SampleCubes {
 public:
  void reset(const SamplePart& part) {
    part_ = part;
    for (size_t axis = 0; axis < 3; ++axis) counts_[axis] = (part.count(axis) + side - 1) / side;
    numbers_.assign(counts_[0] * counts_[1] * counts_[2], 0);
  }
  /// Of all cubes that begin in `p`, which begins at a cube.
  void fill(const SamplePart& p, int64_t number) {
    uint64_t begin[3], end[3];
    for (size_t axis = 0; axis < 3; ++axis) {
      begin[axis] = (p.low[axis] - part_.low[axis]) / side;
      end[axis] = begin[axis] + (p.count(axis) + side - 1) / side;
    }
    for (uint64_t z = begin[2]; z < end[2]; ++z)
      for (uint64_t y = begin[1]; y < end[1]; ++y) {
        int64_t* const row = &numbers_[(z * counts_[1] + y) * counts_[0]];
        std::fill(row + begin[0], row + end[0], number);
      }
  }
  /// Once all cubes are filled: where runs of equal numbers end.
  void find_runs() {
    ends_.resize(numbers_.size());
    for (size_t row_end = numbers_.size(); row_end > 0; row_end -= counts_[0])
      for (uint64_t n = 1; n <= counts_[0]; ++n) {
        const size_t at = row_end - n;
        const bool goes_on = n > 1 && numbers_[at] == numbers_[at + 1];
        ends_[at] = goes_on ? ends_[at + 1] : static_cast<uint32_t>(counts_[0] - n + 1);
      }
  }
  /// That of a sample, and of those after it in the row up to `end`.
  int64_t run(uint64_t i, uint64_t j, uint64_t k, uint64_t& end) const {
    const uint64_t row = (k - part_.low[2]) / side * counts_[1] + (j - part_.low[1]) / side;
    const size_t cube = row * counts_[0] + (i - part_.low[0]) / side;
    end = std::min(part_.high[0], part_.low[0] + ends_[cube] * side);
    return numbers_[cube];
  }
  /// Where a sample lies in its cube.
  uint64_t place(uint64_t i, uint64_t j, uint64_t k) const {
    return ((k - part_.low[2]) % side * side + (j - part_.low[1]) % side) * side +
           (i - part_.low[0]) % side;
  }

 private:
  SamplePart part_{};
  std::array<uint64_t, 3> counts_{};
  std::vector<int64_t> numbers_;
  std::vector<uint32_t> ends_;  // in its row, the cube after the run that begins at a cube
};

class WholeParts {
 public:
  static constexpr int64_t not_proven = INT64_MIN;
  /// Layers that share what is proven about boxes of samples.
  static constexpr uint64_t layers = 16;
  /// Rows that are known at once, which bounds what is kept of the parts.
  static constexpr uint64_t band = 64;
  static_assert(layers <= band);

  /// `all`: not empty, and no more layers than `layers`. Far from caps large boxes are proven at
  /// once.
  WholeParts(const OpenMesh& mesh, const SampleGrid& grid, const SamplePart& all);

  /// Goes to the band that begins at a row.
  void set(uint64_t first_row);

  /// The number of a sample, and of those after it up to `end`; not_proven where it is not known.
  int64_t run(uint64_t i, uint64_t j, uint64_t k, uint64_t& end) const {
    const int64_t whole = fine_.run(i, j, k, end);
    if (whole >= first_single) return whole;
    const int16_t* const found =
        &single_[static_cast<size_t>(whole - not_proven)][fine_.place(i, j, k)];
    uint64_t n = 1;
    while (i + n < end && found[n] == *found) ++n;
    end = i + n;
    return *found == single_not_proven ? not_proven : *found;
  }

 private:
  static constexpr uint64_t side = 4;    // samples of a cube
  static constexpr uint64_t block = 16;  // at most, to look into samples of a part by its field
  static_assert(block % side == 0);
  static constexpr size_t cube_samples = side * side * side;
  /// Samples of a cube or less, by z, then y, then x.
  struct Points {
    std::array<Vec3, cube_samples> at;
    size_t count = 0;
  };
  using Numbers = std::array<int64_t, cube_samples>;
  /// Small, as a band may have many. Larger numbers are as good as not proven.
  using Cube = std::array<int16_t, cube_samples>;
  static constexpr int16_t single_not_proven = INT16_MIN;
  static constexpr int64_t first_single = INT64_MIN / 2;
  static int16_t to_single(int64_t number) {
    return number > single_not_proven && number < -single_not_proven ? static_cast<int16_t>(number)
                                                                     : single_not_proven;
  }
  struct Doubtful {
    Vec3 at;
    size_t cube, place;
  };

  Box3 box_of(const SamplePart& p) const {
    return {grid_.at(p.low[0], p.low[1], p.low[2]),
            grid_.at(p.high[0] - 1, p.high[1] - 1, p.high[2] - 1)};
  }
  /// Calls use(half) for the halves of a part, across its longest side among those of more than
  /// `least` samples, at a multiple of `least`. False if there is none.
  template <uint64_t least, class Use>
  bool halve(const SamplePart& p, Use&& use) const;
  void find_coarse(const SamplePart& p);
  /// Of parts larger than a block. Keeps the others.
  void find_fine(const SamplePart& p);
  /// Of the parts that were kept, and of their parts.
  void find_kept();
  void look_into(const SamplePart& p, const Ball& ball, const Expansion& expansion);
  /// False if halves of the part may tell more.
  bool look_by_field(const SamplePart& p, bool is_least);
  /// Of a cube.
  void look_by_views(const SamplePart& p, const Ball& ball);
  Points points_of(const SamplePart& p) const;
  void keep_cube(const SamplePart& p, const Numbers& numbers);
  /// Of samples that are not proven otherwise, by an expansion about each.
  void settle_doubtful();

  const OpenMesh& mesh_;
  const SampleGrid& grid_;
  const SamplePart all_;
  SampleCubes<band> coarse_;
  SampleCubes<side> fine_;  // of the current band; below first_single, its samples are in single_
  std::vector<Cube> single_;
  Caps::Nearby near_;
  WholeField field_;
  std::vector<SamplePart> kept_;
  std::vector<Doubtful> doubtful_;
};

}  // namespace msq
