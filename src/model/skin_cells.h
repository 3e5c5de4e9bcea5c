// SPDX-License-Identifier: Apache-2.0
// The rows of a skin under a mesh, without a search of its triangles at every sample.
//
// Whole boxes of samples are decided by the depth of their centre and their half diagonal, since
// depths differ by no more than points do. The rest is divided into cells of a few samples along
// each axis. At their corners the distance D to the boundary and its foot are computed. Between the
// corners
// - D is at most the distance to any corner's foot;
// - D^2 is at least the interpolation of the corners' D^2 minus the difference of a square from its
//   own interpolation: the sum over the axes of x (h - x), at the offset x in a cell of width h.
//   For D(p)^2 - |p|^2, the minimum of |f|^2 - 2 p f over the points f of the boundary, is concave,
//   as the minimum of linear functions is.
// The error of both bounds is only about h^2 / D. Samples that they do not decide are searched. If
// the depth of a sample equals the skin's thickness, within the error of depths, the definition
// decides.
#pragma once

#include <cstdint>
#include <vector>

#include "base/job.h"
#include "base/sample_grid.h"
#include "model/skin.h"
#include "shape/boundary_search.h"

namespace msq {

class SkinCells {
 public:
  /// The skin's shape must have the search. `rows`: of the skin; a block of zeros like `alive`.
  SkinCells(const Skin& skin, const BoundarySearch& search, const RowBlock& alive,
            const RowBlock& rows);

  /// Sets the bits of the alive samples in the skin, and of some samples that are not alive.
  void mark(const Job* job);

 private:
  /// Samples along an axis of a brick, and the cells that they are divided into. If `step` is 1, a
  /// cell is a single sample. Otherwise it has the samples from a corner to the next one, which the
  /// last cell includes.
  struct Axis {
    uint64_t first = 0;
    uint32_t count = 0, step = 1, cells = 0;
    double at[bits_per_word];  // coordinates of samples

    uint32_t begin(uint32_t cell) const { return cell * step; }
    uint32_t end(uint32_t cell) const { return cell + 1 == cells ? count : (cell + 1) * step; }
    uint32_t upper_corner(uint32_t cell) const { return step == 1 ? cell : cell + 1; }
    uint32_t sample(uint32_t corner) const { return std::min(corner * step, count - 1); }
    void set(uint64_t from, uint64_t samples);
  };
  struct Cells {
    uint32_t low[3], high[3];  // [low, high) along each axis
  };
  struct Corner {
    double min_squared;  // of D^2
    Vec3 foot;
  };
  using Range = BoundarySearch::Range;

  void choose_steps();
  void set_brick(uint64_t word, uint64_t j, uint64_t k);
  bool any_alive(const Cells& cells) const;
  Box3 samples_box(const Cells& cells) const;
  Range ask_box(const Box3& box);
  void divide(const Cells& cells);
  void fill(const Cells& cells);
  void fill_cell(const Cells& cell);
  const Corner& corner(const uint32_t (&at)[3]);

  void find_alive_words(uint64_t j, uint64_t k);
  uint64_t alive_word(uint32_t j, uint32_t k) const {
    return alive_.row(axes_[1].first + j, axes_[2].first + k)[axes_[0].first / bits_per_word];
  }
  uint64_t& skin_word(uint32_t j, uint32_t k) const {
    return rows_.row(axes_[1].first + j, axes_[2].first + k)[axes_[0].first / bits_per_word];
  }

  const Skin& skin_;
  const BoundarySearch& search_;
  const RowBlock alive_, rows_;
  std::vector<uint64_t> alive_words_;  // of the bricks in a row along x: what is alive in each
  const double error_, margin_;
  Axis axes_[3];
  uint32_t part_ = 0;  // where searches start
  std::vector<Corner> corners_;
  std::vector<uint8_t> is_known_;
};

}  // namespace msq
