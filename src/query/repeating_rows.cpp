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
  // Their positions are computed for each slicer, whichever layers are requested.
  constexpr uint64_t max_rows = uint64_t{1} << 17;
  if (rows.end - rows.begin > max_rows) return {};
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

  /// All rows that do not repeat others; all rows, finished, if there are too many flips.
  void compute(const FinishRows& finish, RowFlips& flips) {
    flips.begin(RowFlips::max_bytes(row_words_ * grid_.ny * sizeof(uint64_t)));
    compute_alone(0, repeats_.first, finish);
    compute_alone(repeats_.end, grid_.ny, finish);
    const RowBlock period = rows(repeats_.first, repeats_.first + repeats_.period);
    fill(period);
    if (structure_)
      dynamic_cast<const RepeatingStructure&>(*structure_)
          .keep_repeated_rows(period, repeats_.end, flips, job_);
    if (flips.is_full()) compute_alone(repeats_.first, repeats_.end, finish);
    flips.sort_by_rows();
  }

  /// Rows that are copied at once: periods together, as many as a core's nearest cache holds.
  uint64_t copied_at_once() const {
    constexpr uint64_t near_rows = 64;
    return repeats_.period * std::max<uint64_t>(1, near_rows / repeats_.period);
  }

  /// Finishes the rows of a period, and copies them to the first rows that are copied at once.
  /// Where some rows are unlike, copies and finishes all.
  void finish_rows(const FinishRows& finish, const std::vector<RowFlip>& flips) {
    const RowRepeats& r = repeats_;
    const uint64_t whole = (r.end - r.first) / r.period, rest = (r.end - r.first) % r.period;
    if (finish && flips.empty()) {
      if (rest) finish(rows(r.first, r.first + rest), whole + 1);
      finish(rows(r.first + rest, r.first + r.period), whole);
    }
    for (uint64_t done = r.period; done < copied_at_once() && r.first + done < r.end; done *= 2)
      copy_to(r.first + done, std::min({done, copied_at_once() - done, r.end - r.first - done}));
    if (flips.empty()) return;
    copy_rows(0, UINT64_MAX);
    for (const RowFlip& flip : flips)
      row(flip.j)[flip.i / bits_per_word] ^= uint64_t{1} << (flip.i % bits_per_word);
    if (finish) finish(rows(r.first, r.end), 1);
  }

  /// Copies [begin, end) of the times that rows are copied at once.
  void copy_rows(uint64_t begin, uint64_t end) {
    for (uint64_t n = begin; n < end; ++n) {
      const uint64_t to = repeats_.first + (n + 1) * copied_at_once();
      if (to >= repeats_.end) return;
      check_cancelled(job_);
      copy_to(to, std::min(copied_at_once(), repeats_.end - to));
    }
  }

 private:
  void copy_to(uint64_t to, uint64_t count) {
    std::memcpy(row(to), row(repeats_.first), count * row_words_ * sizeof(uint64_t));
  }
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
                         const Job* job, const FinishRows& finish, std::vector<RowFlips>* flips) {
  const uint64_t layers = z1 - z0, layer_words = words_for(grid.nx) * grid.ny;
  const auto layer_at = [&](uint64_t n) {
    return RepeatingLayer(model, resolved, grid, repeats, z0 + n, words + n * layer_words, job);
  };
  std::vector<uint8_t> is_copied(layers);
  model.executor().for_each(layers, [&](uint64_t n) {
    check_cancelled(job);
    RepeatingLayer layer = layer_at(n);
    RowFlips own;
    RowFlips& found = flips ? (*flips)[n] : own;
    layer.compute(finish, found);
    if (!flips && !found.is_full()) layer.finish_rows(finish, found.all());
    is_copied[n] = flips || found.is_full() || !found.all().empty();
  });
  if (flips) return;
  // In parts of layers: a layer may be large.
  constexpr uint64_t part_words = uint64_t{1} << 15;
  const uint64_t at_once = layer_at(0).copied_at_once();
  const uint64_t times = (repeats.end - repeats.first) / at_once + 1;
  const uint64_t part = std::max<uint64_t>(1, part_words / (at_once * words_for(grid.nx)));
  const uint64_t parts = (times + part - 1) / part;
  model.executor().for_each(layers * parts, [&](uint64_t n) {
    if (is_copied[n / parts]) return;
    layer_at(n / parts).copy_rows(n % parts * part, (n % parts + 1) * part);
  });
}

}  // namespace msq
