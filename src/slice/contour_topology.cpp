// SPDX-License-Identifier: Apache-2.0
#include "slice/contour_topology.h"

#include <algorithm>
#include <vector>

#include "base/memory.h"
#include "base/sample_grid.h"
#include "base/status.h"
#include "query/membership.h"
#include "slice/cell_sides.h"
#include "slice/contour_samples.h"
#include "slice/contour_topology_cells.h"

namespace msq {

using namespace cell_sides;

namespace {

/// Of the samples that are held at a time.
constexpr uint64_t topology_band_words = uint64_t{1} << 19;

/// Samples along an axis of the window: from an edge, between nodes, to the other edge.
struct AxisPart {
  uint64_t first, count;
  double start, step;
};
std::vector<AxisPart> parts_of(const ContourAxis& axis, uint32_t k) {
  const double per_cell = k;
  if (axis.inner() == 0)
    return {{0, uint64_t{k} + 1, axis.low(), (axis.high() - axis.low()) / per_cell}};
  const double end = axis.inner_at(axis.inner() - 1);
  return {{0, k, axis.low(), (axis.first() - axis.low()) / per_cell},
          {k, (axis.inner() - 1) * k, axis.first(), axis.pitch() / per_cell},
          {axis.inner() * k, uint64_t{k} + 1, end, (axis.high() - end) / per_cell}};
}

/// Writes `count` bits to where there are none yet.
void put_bits(uint64_t* out, uint64_t at, const uint64_t* words, uint64_t count) {
  uint64_t* const to = out + at / 64;
  const unsigned shift = at % 64;
  for (uint64_t w = 0; w * 64 < count; ++w) {
    to[w] |= words[w] << shift;
    if (shift != 0 && words[w] >> (64 - shift) != 0) to[w + 1] |= words[w] >> (64 - shift);
  }
}
void set_bit(uint64_t* out, uint64_t at, bool value) {
  out[at / 64] = (out[at / 64] & ~(uint64_t{1} << (at % 64))) | uint64_t{value} << (at % 64);
}

class TopologySteps {
 public:
  TopologySteps(const Model& model, const Scales& resolved, const ContourSection& section,
                uint32_t samples, const Job* job)
      : model_(model),
        resolved_(resolved),
        section_(section),
        grid_(section.grid()),
        job_(job),
        k_(samples),
        across_(grid_.u_nodes().inner() + 1),
        up_(grid_.v_nodes().inner() + 1),
        row_words_((across_ * k_ + 64) / 64 + 1) {
    constexpr uint64_t max_samples = uint64_t{1} << 31;
    if (std::max(across_, up_) >= max_samples / k_)
      fail(Status::limit, "%llu samples along an axis; the limit of topology_samples is %llu",
           static_cast<unsigned long long>(std::max(across_, up_) * k_),
           static_cast<unsigned long long>(max_samples));
  }

  uint64_t count() {
    const uint64_t rows = std::clamp<uint64_t>(topology_band_words / (row_words_ * k_), 1, up_);
    const uint64_t words = (rows * k_ + 1) * row_words_;
    // The engine's rows of the same samples, and their scratch memory.
    SampleGrid fine;
    fine.nx = across_ * k_ + 1;
    fine.ny = rows * k_ + 1;
    fine.nz = 1;
    const Reservation held(
        model_.context().budget,
        (2 * words + fill_slab_scratch_words(model_, resolved_, fine, 1)) * sizeof(uint64_t),
        "the samples of topology_samples");
    band_.resize(words);
    for (uint64_t first = 0; first < up_; first += rows) {
      const uint64_t end = std::min(up_, first + rows);
      fill(first, end);
      for (uint64_t j = first; j < end; ++j) {
        check_cancelled(job_);
        look_along(j, j - first);
      }
      // Each cell is named by three more numbers when groups are made.
      held_cells_ = Reservation();
      held_cells_ = Reservation(model_.context().budget, 2 * cells_.bytes(),
                                "the cells that topology_samples found");
    }
    return cells_.steps(job_);
  }

 private:
  uint64_t* row(uint64_t f) { return band_.data() + f * row_words_; }

  /// The samples of rows of cells.
  void fill(uint64_t first, uint64_t end) {
    std::fill(band_.begin(), band_.end(), 0);
    const uint64_t low = first * k_, high = end * k_ + 1;
    for (const AxisPart& v : parts_of(grid_.v_nodes(), k_)) {
      const uint64_t from = std::max(low, v.first), to = std::min(high, v.first + v.count);
      if (from >= to) continue;
      for (const AxisPart& u : parts_of(grid_.u_nodes(), k_)) {
        const SampleBlock block{u.start, v.start + static_cast<double>(from - v.first) * v.step,
                                u.step,  v.step,
                                u.count, to - from};
        for_sample_rows(model_, resolved_, grid_.plane(), block, job_,
                        [&](uint64_t j, const uint64_t* words) {
                          put_bits(row(from - low + j), u.first, words, u.count);
                        });
      }
    }
    // The edges' last positions are rounded in another way than those of nodes.
    for (uint64_t j = first; j <= end; ++j)
      set_bit(row((j - first) * k_), across_ * k_,
              grid_.inside(grid_.right_edge(), ContourGrid::bottom_row + static_cast<uint32_t>(j)));
    if (end == up_)
      for (uint64_t i = 0; i <= across_; ++i)
        set_bit(row((up_ - first) * k_), i * k_,
                grid_.inside(ContourGrid::left_edge + static_cast<uint32_t>(i), grid_.top_edge()));
  }

  void look_along(uint64_t j, uint64_t in_band) {
    const uint64_t* const lowest = row(in_band * k_);
    const uint64_t cells_of_word = 64 / k_;
    unsigned window_rows = 0;
    if (j == 0) window_rows |= 1u << bottom;
    if (j + 1 == up_) window_rows |= 1u << top;
    for (uint64_t w = 0; w * cells_of_word < across_; ++w) {
      // A word holds the samples of its cells except for the last column.
      uint64_t any = 0, all = ~uint64_t{0}, next_any = 0, next_all = 1;
      for (uint32_t s = 0; s <= k_; ++s) {
        const uint64_t* const words = lowest + s * row_words_ + w;
        any |= words[0];
        all &= words[0];
        next_any |= words[1];
        next_all &= words[1];
      }
      if ((any == 0 && (next_any & 1) == 0) || (all == ~uint64_t{0} && (next_all & 1) == 1))
        continue;
      const uint64_t end = std::min(across_, (w + 1) * cells_of_word);
      for (uint64_t i = w * cells_of_word; i < end; ++i) {
        const CellMask mask = mask_of(lowest, i);
        uint32_t some = 0, every = ~uint32_t{0};
        for (uint32_t s = 0; s <= k_; ++s) {
          some |= mask.rows[s];
          every &= mask.rows[s];
        }
        if (some == 0 || every == (uint32_t{2} << k_) - 1) continue;
        unsigned window_sides = window_rows;
        if (i == 0) window_sides |= 1u << left;
        if (i + 1 == across_) window_sides |= 1u << right;
        cells_.add(static_cast<uint32_t>(i), static_cast<uint32_t>(j), mask, turns_right(i, j),
                   window_sides);
      }
    }
  }

  CellMask mask_of(const uint64_t* lowest, uint64_t i) const {
    CellMask mask{k_, {}};
    const uint64_t at = i * k_;
    const unsigned shift = at % 64;
    for (uint32_t s = 0; s <= k_; ++s) {
      const uint64_t* const words = lowest + s * row_words_ + at / 64;
      const uint64_t above = shift + k_ >= 64 ? words[1] << (64 - shift) : 0;
      mask.rows[s] = static_cast<uint32_t>(words[0] >> shift | above) & ((uint32_t{2} << k_) - 1);
    }
    return mask;
  }

  /// Cells are queried in the order of saddles.
  bool turns_right(uint64_t i, uint64_t j) {
    const uint64_t column = ContourGrid::left_edge + i, row = ContourGrid::bottom_row + j;
    const std::vector<ContourSection::Saddle>& saddles = section_.saddles();
    while (saddle_ < saddles.size() &&
           (saddles[saddle_].row < row ||
            (saddles[saddle_].row == row && saddles[saddle_].column < column)))
      ++saddle_;
    return saddle_ < saddles.size() && saddles[saddle_].row == row &&
           saddles[saddle_].column == column && saddles[saddle_].turns_right;
  }

  const Model& model_;
  const Scales& resolved_;
  const ContourSection& section_;
  const ContourGrid& grid_;
  const Job* const job_;
  const uint32_t k_;
  const uint64_t across_, up_, row_words_;
  std::vector<uint64_t> band_;
  TopologyCells cells_;
  Reservation held_cells_;
  size_t saddle_ = 0;
};

}  // namespace

uint64_t count_topology_steps(const Model& model, const Scales& resolved,
                              const ContourSection& section, uint32_t samples, const Job* job) {
  return TopologySteps(model, resolved, section, samples, job).count();
}

}  // namespace msq
