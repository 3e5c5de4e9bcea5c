// SPDX-License-Identifier: Apache-2.0
// The angles from a row's first sample on are the same all over a block. Their sines and cosines,
// with those of the angles at a row's first sample, give the sines and cosines at all samples, by
// the addition theorems; for integer multiples, the wrap at a cell's border has no effect. First
// the sines and cosines at one of each 64 samples are computed in double precision (turned_starts),
// then those at all samples (turned_waves) or the function itself (turned_products) in single
// precision, with a proven bound of the error (trigonometric_form.cpp). Samples nearer to the level
// than that are evaluated one by one.
#include "structure/functional/turned_rows.h"

#include <algorithm>

namespace msq {

TurnedRows::TurnedRows(const Functional& structure, const RowBlock& block)
    : structure_(structure),
      block_(block),
      starts_(structure, block, structure.form()->products() ? 0.5 * bits_per_word - 0.5 : 0) {
  const TrigonometricForm& form = *structure.form();
  if (const WaveProducts* const products = form.products()) {
    slack_ = products->slack(starts_.angle_error());
    products_.emplace(*products, block, starts_);
  } else {
    slack_ = form.slack(starts_.angle_error());
    waves_.emplace(form, starts_);
  }
  if (structure.level().is_constant()) bounds_.set(structure.level().range(), slack_);
}

void TurnedRows::keep(const Job* job) {
  for (RowGroup group{0, 0, block_.z0, 0}; group.z0 < block_.z1; group.z0 = group.z1) {
    check_cancelled(job);
    group.z1 = std::min(block_.z1, group.z0 + max_group_layers);
    for (group.y0 = block_.y0; group.y0 < block_.y1; group.y0 = group.y1) {
      group.y1 = std::min(block_.y1, group.y0 + max_group_rows);
      keep_group(group);
    }
  }
}

void TurnedRows::keep_group(const RowGroup& group) {
  words_.clear();
  const auto is_alive = [&](uint32_t w) {
    for (size_t row = 0; row < group.rows(); ++row)
      if (block_.row(group.y(row), group.z(row))[w]) return true;
    return false;
  };
  uint32_t first = 0, last = static_cast<uint32_t>(block_.row_words());
  while (first < last && !is_alive(first)) ++first;
  while (first < last && !is_alive(last - 1)) --last;
  for (uint32_t w = first; w < last; ++w) words_.push_back(w);
  if (words_.empty()) return;
  if (!structure_.level().is_constant())
    bounds_.set(structure_.level(), slack_, *block_.grid, group, words_);
  for (size_t row = 0; row < group.rows(); ++row) {
    starts_.find(group, row, words_);
    const TurnedRow turned{structure_, block_, group.y(row), group.z(row), words_, bounds_, slack_};
    if (products_)
      products_->keep(turned);
    else
      waves_->keep(turned);
  }
}

}  // namespace msq
