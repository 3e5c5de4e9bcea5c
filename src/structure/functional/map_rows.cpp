// SPDX-License-Identifier: Apache-2.0
// The error of the turns, in units of u = 2^-24 and with D the largest difference of neighbouring
// nodes. A node less whole cells is in [0, 1], and is rounded by u / 2. The difference is rounded
// by u D, and the position in the voxel by u / 2, which is multiplied by D. The product and the
// sum, at most 1 + D in magnitude, are rounded once each. So the error is below (4 D + 2) u, and
// the multiplication by a frequency adds (1 + D) u times that. The nodes and the definition are
// computed in double precision; the rounding of each is bounded by SampledMap::rounding().
#include "structure/functional/map_rows.h"

#include <algorithm>
#include <cmath>

#include "structure/functional/doubtful_samples.h"

namespace msq {

namespace {

constexpr size_t map_batch_words = single_points / bits_per_word;
constexpr size_t map_stride = single_points + batch_padding;

}  // namespace

MapRows::MapRows(const Functional& structure, const RowBlock& block)
    : structure_(structure),
      map_(*structure.angles().sampled()),
      form_(*structure.form()),
      block_(block),
      grid_(*block.grid),
      values_(form_.values()) {
  const std::array<int, 3> sample_axes = structure.neighbourhood().sample_axes();
  for (int axis = 0; axis < 3; ++axis) axes_[sample_axes[static_cast<size_t>(axis)]] = axis;
  slack_ = slack();
  tabulate_columns();
  serves_ = serves_ && slack_ < 1e-2;
  if (!serves_) return;
  rows_ = find_positions(1, block.y0, block.rows());
  layers_ = find_positions(2, block.z0, block.layers());
  for (int c = 0; c < 3; ++c) {
    for (auto& nodes : nodes_[c]) nodes.resize(voxels_ + 1 + map_padding);
    starts_[c].resize(voxels_ + map_padding);
    rises_[c].resize(voxels_ + map_padding);
  }
  const size_t waves = form_.waves().size();
  at_ = allocate_aligned(2 * waves * map_stride);
  std::fill_n(at_.get(), 2 * waves * map_stride, 0.0f);
  for (size_t i = 0; i < 2 * waves; ++i) values_.set_input(i, {at_.get() + i * map_stride, false});
  for (size_t i = 0; i < waves; ++i) {
    const TrigonometricForm::Wave& wave = form_.waves()[i];
    float* const to = at_.get() + 2 * i * map_stride;
    waves_.push_back({wave.axis, static_cast<float>(wave.frequency), to, to + map_stride});
  }
  if (structure.level().is_constant()) bounds_.set(structure.level().range(), slack_);
}

double MapRows::slack() const {
  double most = 0;
  for (int c = 0; c < 3; ++c)
    most = std::max(most, map_.slopes()[c] * map_.frame().spacing[axes_[0]]);
  const double turns = (5 * most + 3) * 0x1p-24 + 2 * map_.rounding();
  return form_.slack(two_pi * 1.01 * turns, map_wave_error);
}

MapRows::Positions MapRows::find_positions(int sample_axis, uint64_t begin, uint64_t count) const {
  const Image& image = map_.image(0);
  const int axis = axes_[sample_axis];
  const double top = static_cast<double>(image.size(axis) - 1);
  Positions positions;
  Vec3 p = grid_.at(0, block_.y0, block_.z0);
  for (uint64_t i = begin; i < begin + count; ++i) {
    p[sample_axis] = sample_axis == 0 ? grid_.x(i) : sample_axis == 1 ? grid_.y(i) : grid_.z(i);
    // The other two coordinates do not matter.
    const double u = image.to_voxels(p)[axis];
    const Image::Located located = image.locate(u, axis);
    positions.voxels.push_back(located.cell);
    positions.fractions.push_back(located.fraction);
    positions.in_box.push_back(u >= 0 && u <= top);
  }
  return positions;
}

void MapRows::tabulate_columns() {
  const Positions all = find_positions(0, 0, grid_.nx);
  const auto [low, high] = std::minmax(all.voxels.front(), all.voxels.back());
  first_voxel_ = low;
  voxels_ = high - low + 1;
  const size_t columns = block_.row_words() * bits_per_word;
  in_box_.assign(block_.row_words(), 0);
  serves_ = true;
  for (size_t i = 0; i < columns; ++i) {
    const size_t at = std::min<size_t>(i, grid_.nx - 1);
    columns_.push_back(static_cast<uint32_t>(all.voxels[at] - low));
    fractions_.push_back(static_cast<float>(all.fractions[at]));
    if (at == i && all.in_box[i]) in_box_[i / bits_per_word] |= uint64_t{1} << i % bits_per_word;
    const uint32_t before = columns_[i > 0 ? i - 1 : 0];
    serves_ = serves_ && std::max(before, columns_[i]) - std::min(before, columns_[i]) <= 1;
  }
}

void MapRows::keep(const Job* job) {
  for (RowGroup group{0, 0, block_.z0, 0}; group.z0 < block_.z1; group.z0 = group.z1) {
    check_cancelled(job);
    group.z1 = std::min(block_.z1, group.z0 + max_group_layers);
    for (group.y0 = block_.y0; group.y0 < block_.y1; group.y0 = group.y1) {
      group.y1 = std::min(block_.y1, group.y0 + max_group_rows);
      keep_group(group);
    }
  }
}

void MapRows::keep_group(const RowGroup& group) {
  if (!structure_.level().is_constant()) {
    words_.clear();
    for (uint32_t w = 0; w < block_.row_words(); ++w) words_.push_back(w);
    bounds_.set(structure_.level(), slack_, grid_, group, words_);
  }
  for (size_t row = 0; row < group.rows(); ++row) {
    if (!find_words(group.y(row), group.z(row))) continue;
    find_row(group.y(row), group.z(row));
    for (size_t first = 0; first < words_.size(); first += map_batch_words)
      decide(group, row, first, std::min(map_batch_words, words_.size() - first));
  }
}

bool MapRows::find_words(uint64_t j, uint64_t k) {
  uint64_t* const row = block_.row(j, k);
  const bool is_in_box = rows_.in_box[j - block_.y0] && layers_.in_box[k - block_.z0];
  words_.clear();
  for (uint32_t w = 0; w < block_.row_words(); ++w) {
    row[w] &= is_in_box ? in_box_[w] : 0;
    if (row[w]) words_.push_back(w);
  }
  return !words_.empty();
}

template <class T>
void MapRows::find_nodes(const T* samples, uint64_t y, uint64_t z, double fraction,
                         double* nodes) const {
  const Image& image = map_.image(0);
  const uint64_t strides[3] = {1, image.size(0), image.size(0) * image.size(1)};
  const uint64_t along = strides[axes_[0]], up = strides[axes_[2]];
  const T* const from = samples + first_voxel_ * along + y * strides[axes_[1]] + z * up;
  for (size_t i = 0; i <= voxels_; ++i) {
    const double low = static_cast<double>(from[i * along]),
                 high = static_cast<double>(from[i * along + up]);
    nodes[i] = low + fraction * (high - low);
  }
}

void MapRows::find_row(uint64_t j, uint64_t k) {
  const uint64_t y = rows_.voxels[j - block_.y0], z = layers_.voxels[k - block_.z0];
  if (y != nodes_row_ || k != nodes_layer_) {
    nodes_row_ = y;
    nodes_layer_ = k;
    for (int c = 0; c < 3; ++c)
      map_.image(c).visit([&](const auto* samples) {
        const double fraction = layers_.fractions[k - block_.z0];
        find_nodes(samples, y, z, fraction, nodes_[c][0].data());
        find_nodes(samples, y + 1, z, fraction, nodes_[c][1].data());
      });
  }
  for (int c = 0; c < 3; ++c)
    blend_nodes(nodes_[c][0].data(), nodes_[c][1].data(), rows_.fractions[j - block_.y0], voxels_,
                starts_[c].data(), rises_[c].data());
}

void MapRows::decide(const RowGroup& group, size_t row, size_t first, size_t count) {
  const MapRow samples{columns_.data(),
                       fractions_.data(),
                       {starts_[0].data(), starts_[1].data(), starts_[2].data()},
                       {rises_[0].data(), rises_[1].data(), rises_[2].data()}};
  find_map_waves(samples, words_.data() + first, count, waves_.data(), waves_.size());
  values_.run(count * bits_per_word);
  const ValuesOf<float> values = values_.output(0);
  uint64_t at_most_low[map_batch_words], at_most_high[map_batch_words];
  compare_singles(values, words_.data() + first, count, bounds_.low.data(), bounds_.high.data(),
                  structure_.level().is_constant(), at_most_low, at_most_high);
  uint64_t* const words = block_.row(group.y(row), group.z(row));
  for (size_t n = 0; n < count; ++n) {
    uint64_t& word = words[words_[first + n]];
    uint64_t in = at_most_low[n];
    in |= decide_doubtful(structure_, slack_, grid_, words_[first + n] * bits_per_word,
                          group.y(row), group.z(row), at_most_high[n] & ~in & word,
                          [&](size_t i) { return values[n * bits_per_word + i]; });
    word &= in;
  }
}

}  // namespace msq
