// SPDX-License-Identifier: Apache-2.0
#include "query/repeating_rows.h"

#include <algorithm>
#include <cstring>

#include "shape/primitive.h"

namespace msq {

RowRepeats RowRepeats::of_rows(uint64_t from, uint64_t to) const {
  RowRepeats part{std::max(first, from) - from, std::min(end, to) - from, period};
  if (end <= from || first >= to || part.end < part.first + 2 * period) return {};
  return part;
}

namespace {

struct Rows {
  uint64_t begin = 0, end = 0;
};

/// Rows that have the same samples of a shape as each other, in each layer.
Rows alike_rows(const Shape& shape, const SampleGrid& grid) {
  if (!shape.is_bounded()) return {0, grid.ny};
  if (!dynamic_cast<const BoxShape*>(&shape)) return {};
  const Box3& box = shape.bounds();
  return {grid.first_y_from(box.min.y), grid.first_y_from<true>(box.max.y)};
}

}  // namespace

RowRepeats find_row_repeats(const Model& model, const Scales& resolved, const SampleGrid& grid) {
  if (!model.regions().empty() || resolved.size() > 1) return {};
  const Rows rows = alike_rows(model.shape(), grid);
  if (resolved.empty())
    return rows.begin + 1 < rows.end ? RowRepeats{rows.begin, rows.end, 1} : RowRepeats{};
  const auto* structure = dynamic_cast<const RepeatingStructure*>(resolved[0]->structure.get());
  if (!structure || !resolved[0]->skin.is_none() || rows.begin >= rows.end) return {};
  const uint64_t period = structure->row_period(grid, rows.begin, rows.end);
  return period ? RowRepeats{rows.begin, rows.end, period} : RowRepeats{};
}

namespace {

/// A layer of a slab whose rows repeat.
class RepeatingLayer {
 public:
  RepeatingLayer(const Model& model, const Scales& resolved, const SampleGrid& grid,
                 const RowRepeats& repeats, uint64_t layer, uint64_t* words, const Job* job)
      : model_(model),
        structure_(resolved.empty() ? nullptr : resolved[0]->structure.get()),
        grid_(grid),
        repeats_(repeats),
        layer_(layer),
        words_(words),
        row_words_(words_for(grid.nx)),
        job_(job) {}

  /// All rows that do not repeat others.
  void compute(const FinishRows& finish, std::vector<RowFlip>& flips) {
    compute_alone(0, repeats_.first, finish);
    compute_alone(repeats_.end, grid_.ny, finish);
    const RowBlock period = rows(repeats_.first, repeats_.first + repeats_.period);
    fill(period);
    if (structure_)
      dynamic_cast<const RepeatingStructure&>(*structure_)
          .keep_repeated_rows(period, repeats_.end, flips, job_);
  }

  void copy_rows() {
    // Periods together, as many as a core's nearest cache holds.
    constexpr uint64_t near_rows = 64;
    const RowRepeats& r = repeats_;
    const uint64_t most = r.period * std::max<uint64_t>(1, near_rows / r.period);
    for (uint64_t done = r.period; r.first + done < r.end;) {
      const uint64_t count = std::min({done, most, r.end - r.first - done});
      std::memcpy(row(r.first + done), row(r.first), count * row_words_ * sizeof(uint64_t));
      done += count;
    }
  }

  /// Copies rows that are finished, or finishes rows that are copied where some are unlike.
  void finish_rows(const FinishRows& finish, const std::vector<RowFlip>& flips) {
    const RowRepeats& r = repeats_;
    const uint64_t whole = (r.end - r.first) / r.period, rest = (r.end - r.first) % r.period;
    if (finish && flips.empty()) {
      if (rest) finish(rows(r.first, r.first + rest), whole + 1);
      finish(rows(r.first + rest, r.first + r.period), whole);
    }
    copy_rows();
    if (flips.empty()) return;
    for (const RowFlip& flip : flips)
      row(flip.j)[flip.i / bits_per_word] ^= uint64_t{1} << (flip.i % bits_per_word);
    if (finish) finish(rows(r.first, r.end), 1);
  }

 private:
  uint64_t* row(uint64_t j) const { return words_ + j * row_words_; }
  RowBlock rows(uint64_t begin, uint64_t end) const {
    RowBlock block;
    block.grid = &grid_;
    block.y0 = begin;
    block.y1 = end;
    block.z0 = layer_;
    block.z1 = layer_ + 1;
    block.words = row(begin);
    block.row_stride = row_words_;
    block.layer_stride = row_words_ * grid_.ny;
    return block;
  }
  void fill(const RowBlock& block) const {
    std::memset(block.words, 0, block.rows() * row_words_ * sizeof(uint64_t));
    model_.shape().fill_rows(block);
  }
  void compute_alone(uint64_t begin, uint64_t end, const FinishRows& finish) const {
    if (begin >= end) return;
    const RowBlock block = rows(begin, end);
    fill(block);
    if (structure_) structure_->keep_rows(block, job_);
    if (finish) finish(block, 1);
  }

  const Model& model_;
  const Structure* const structure_;  // null: the shape alone
  const SampleGrid& grid_;
  const RowRepeats& repeats_;
  const uint64_t layer_;
  uint64_t* const words_;  // of the layer
  const size_t row_words_;
  const Job* const job_;
};

}  // namespace

void fill_repeating_slab(const Model& model, const Scales& resolved, const SampleGrid& grid,
                         const RowRepeats& repeats, uint64_t z0, uint64_t z1, uint64_t* words,
                         const Job* job, const FinishRows& finish,
                         std::vector<std::vector<RowFlip>>* flips) {
  const size_t layer_words = words_for(grid.nx) * grid.ny;
  model.executor().for_each(z1 - z0, [&](uint64_t n) {
    check_cancelled(job);
    RepeatingLayer layer(model, resolved, grid, repeats, z0 + n, words + n * layer_words, job);
    std::vector<RowFlip> own;
    std::vector<RowFlip>& found = flips ? (*flips)[n] : own;
    found.clear();
    layer.compute(finish, found);
    if (!flips) layer.finish_rows(finish, found);
  });
}

}  // namespace msq
