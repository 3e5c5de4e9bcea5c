// SPDX-License-Identifier: Apache-2.0
// The error of the angles. The definition adds the shear to the second coordinate and removes whole
// turns, with at most six roundings of numbers up to the sum of the count and the shears. Here the
// two parts have the same roundings, and whole cells are removed from each. So their sum differs by
// at most 16 units of 2^-53 of that sum, in cells. The other coordinates have the same bits. Angles
// and sines have a few more roundings of numbers up to 2 pi: less than 2^-47.
#include "structure/functional/sheared_rows.h"

#include <algorithm>
#include <cmath>

#include "structure/functional/doubtful_samples.h"
#include "structure/functional/warped_places.h"

namespace msq {

namespace {

constexpr uint32_t sheared_batch_words = single_points / bits_per_word;
constexpr size_t sheared_stride = single_points + batch_padding;

double angle_of_cells(double cells) {
  return angle_of(cells - std::floor(cells));
}

}  // namespace

ShearedRows::ShearedRows(const Functional& structure, const RowBlock& block)
    : structure_(structure),
      warp_(*structure.angles().warp()),
      straight_(warp_.straight()),
      form_(*structure.form()),
      block_(block),
      grid_(*block.grid),
      axis_(structure.sample_axis()[2]),
      slack_(slack()),
      program_(wave_program()),
      tables_program_(program_),
      values_(form_.values()) {
  if (!serves()) return;
  const size_t words = block.row_words(), columns = words * bits_per_word,
               room = columns + batch_padding, waves = form_.waves().size();
  x_.resize(room);
  for (size_t i = 0; i < room; ++i) x_[i] = grid_.x(std::min<uint64_t>(i, grid_.nx - 1));
  for (auto& angles : angles_) angles.resize(room);
  radii_.resize(room);
  for (size_t i = 0; i < 2 * waves; ++i) {
    tables_.push_back(allocate_aligned(room));
    std::fill_n(tables_.back().get(), room, 0.0f);
  }
  turned_ = allocate_aligned(2 * waves * sheared_stride);
  std::fill_n(turned_.get(), 2 * waves * sheared_stride, 0.0f);
  of_row_.resize(2 * waves);
  shell_.assign(words + 1, ~uint64_t{0});
  scratch_.resize(words + 1);
  for (uint32_t w = 0; w < words; ++w) all_words_.push_back(w);
  if (structure.level().is_constant()) bounds_.set(structure.level().range(), slack_);
}

double ShearedRows::slack() const {
  const Warp::Image image = warp_.image(block_.box());
  const auto most = [](double low, double high) { return std::max(-low, high); };
  const double sum =
      warp_.shell().count +
      std::abs(warp_.shell().shear_outwards) * most(image.cells.min.x, image.cells.max.x) +
      std::abs(warp_.shell().shear_along) * most(image.cells.min.z, image.cells.max.z);
  return form_.slack(two_pi * 0x1p-49 * sum + 0x1p-47);
}

Program ShearedRows::wave_program() const {
  TapeBuilder builder;
  std::vector<uint32_t> inputs, outputs;
  for (int axis = 0; axis < 3; ++axis) inputs.push_back(builder.coordinate(axis));
  for (const Wave& wave : form_.waves()) {
    const uint32_t angle = builder.apply(Op::multiply, inputs[static_cast<size_t>(wave.axis)],
                                         builder.constant(wave.frequency));
    for (const Op op : {Op::sine, Op::cosine}) outputs.push_back(builder.apply(op, angle));
  }
  std::vector<Node> nodes;
  for (uint32_t i = 0; i < builder.size(); ++i) nodes.push_back(builder[i]);
  return compile(nodes, inputs, outputs);
}

void ShearedRows::find_along(Vec3 p, double& own, double& shear) const {
  const double w = straight_.to_cells(p).z;
  own = angle_of_cells(w);
  shear = angle_of_cells(warp_.shell().shear_along * w);
}

void ShearedRows::find_across(Vec3 p, double& own, double& around) const {
  const Vec3 cells = straight_.to_cells(p);
  own = angle_of_cells(cells.x);
  around = angle_of_cells(cells.y) + angle_of_cells(warp_.shell().shear_outwards * cells.x);
}

void ShearedRows::set_row(const double (&angles)[3], RowWaves& to) const {
  to.clear();
  for (const Wave& wave : form_.waves()) {
    const double angle = wave.frequency * angles[wave.axis];
    to.push_back(static_cast<float>(apply(Op::sine, angle, 0)));
    to.push_back(static_cast<float>(apply(Op::cosine, angle, 0)));
  }
}

void ShearedRows::tabulate(double y, double z) {
  const size_t columns = block_.row_words() * bits_per_word;
  if (is_along()) {
    for (size_t i = 0; i < columns; ++i) find_along({x_[i], y, z}, angles_[2][i], angles_[1][i]);
  } else {
    find_warped_places(straight_, {x_.data(), false}, {&y, true}, {&z, true}, columns,
                       {angles_[0].data(), angles_[1].data(), angles_[2].data()}, radii_.data());
    const double shear = warp_.shell().shear_outwards, inner = warp_.shell().inner,
                 radial = warp_.numbers().radial;
    if (shear != 0)
      for (size_t i = 0; i < columns; ++i)
        angles_[1][i] += angle_of_cells(shear * ((radii_[i] - inner) / radial));
    const double outer = warp_.outer();
    compare_values({&inner, true}, {radii_.data(), false}, columns, shell_.data());
    compare_values({radii_.data(), false}, {&outer, true}, columns, scratch_.data());
    for (size_t w = 0; w < block_.row_words(); ++w) shell_[w] &= scratch_[w];
  }
  for (size_t begin = 0; begin < columns; begin += batch_points) {
    const size_t size = std::min(batch_points, columns - begin);
    for (size_t a = 0; a < 3; ++a) tables_program_.set_input(a, {angles_[a].data() + begin, false});
    tables_program_.run(size);
    for (size_t t = 0; t < tables_.size(); ++t) {
      if (!has_table(form_.waves()[t / 2])) continue;
      const Values values = tables_program_.output(t);
      for (size_t i = 0; i < size; ++i) tables_[t][begin + i] = static_cast<float>(values[i]);
    }
  }
}

void ShearedRows::keep(const Job* job) {
  const bool is_y = axis_ == 1;  // rows are tabulated for a layer
  if (is_along()) {
    tabulate(grid_.y(block_.y0), grid_.z(block_.z0));
  } else {
    const uint64_t begin = is_y ? block_.y0 : block_.z0, end = is_y ? block_.y1 : block_.z1;
    along_.resize(end - begin);
    for (uint64_t n = begin; n < end; ++n) {
      const Vec3 p = is_y ? grid_.at(0, n, block_.z0) : grid_.at(0, block_.y0, n);
      double angles[3] = {};
      find_along(p, angles[2], angles[1]);
      set_row(angles, along_[n - begin]);
    }
  }
  if (axis_ == 2) {
    for (uint64_t j = block_.y0; j < block_.y1; ++j) {
      check_cancelled(job);
      if (is_empty({j, j + 1, block_.z0, block_.z1})) continue;
      tabulate(grid_.y(j), grid_.z(block_.z0));
      for (uint64_t k = block_.z0; k < block_.z1; k += max_group_layers)
        keep_group({j, j + 1, k, std::min(block_.z1, k + max_group_layers)});
    }
    return;
  }
  for (uint64_t k = block_.z0; k < block_.z1; ++k) {
    check_cancelled(job);
    if (is_empty({block_.y0, block_.y1, k, k + 1})) continue;
    if (is_y) tabulate(grid_.y(block_.y0), grid_.z(k));
    for (uint64_t j = block_.y0; j < block_.y1; j += max_group_rows)
      keep_group({j, std::min(block_.y1, j + max_group_rows), k, k + 1});
  }
}

bool ShearedRows::is_empty(const RowGroup& group) const {
  for (size_t row = 0; row < group.rows(); ++row) {
    const uint64_t* const words = block_.row(group.y(row), group.z(row));
    if (!std::all_of(words, words + block_.row_words(), [](uint64_t w) { return w == 0; }))
      return false;
  }
  return true;
}

void ShearedRows::keep_group(const RowGroup& group) {
  if (!structure_.level().is_constant())
    bounds_.set(structure_.level(), slack_, grid_, group, all_words_);
  const auto count = static_cast<uint32_t>(block_.row_words());
  for (size_t row = 0; row < group.rows(); ++row) {
    const uint64_t j = group.y(row), k = group.z(row);
    uint64_t* const words = block_.row(j, k);
    if (is_along()) {
      const Vec3 p = grid_.at(0, j, k);
      if (!warp_.is_in_shell(warp_.radius(p))) {
        std::fill_n(words, count, 0);
        continue;
      }
      double angles[3] = {};
      find_across(p, angles[0], angles[1]);
      set_row(angles, of_row_);
    } else {
      for (uint32_t w = 0; w < count; ++w) words[w] &= shell_[w];
    }
    const RowWaves& waves =
        is_along() ? of_row_ : along_[axis_ == 1 ? j - block_.y0 : k - block_.z0];
    for (uint32_t first = 0; first < count;) {
      if (words[first] == 0) {
        ++first;
        continue;
      }
      uint32_t end = first + 1;
      while (end < count && end - first < sheared_batch_words && words[end]) ++end;
      decide(group, row, waves, first, end - first);
      first = end;
    }
  }
}

void ShearedRows::decide(const RowGroup& group, size_t row, const RowWaves& waves, uint32_t first,
                         uint32_t count) {
  const size_t begin = size_t{first} * bits_per_word;
  for (size_t i = 0; i < form_.waves().size(); ++i) {
    const Wave& wave = form_.waves()[i];
    const float *const sine = &waves[2 * i], *const cosine = sine + 1;
    if (!has_table(wave)) {
      values_.set_input(2 * i, {sine, true});
      values_.set_input(2 * i + 1, {cosine, true});
      continue;
    }
    const float *const sines = tables_[2 * i].get() + begin, *const cosines =
                                                                 tables_[2 * i + 1].get() + begin;
    if (!has_row(wave)) {
      values_.set_input(2 * i, {sines, false});
      values_.set_input(2 * i + 1, {cosines, false});
      continue;
    }
    float *const to_sines = turned_.get() + 2 * i * sheared_stride, *const to_cosines =
                                                                        to_sines + sheared_stride;
    for (size_t at = 0; at < count * bits_per_word; at += bits_per_word)
      turn_angles(sine, cosine, 1, cosines + at, sines + at, to_sines + at, to_cosines + at);
    values_.set_input(2 * i, {to_sines, false});
    values_.set_input(2 * i + 1, {to_cosines, false});
  }
  values_.run(count * bits_per_word);
  const ValuesOf<float> values = values_.output(0);
  uint64_t at_most_low[sheared_batch_words], at_most_high[sheared_batch_words];
  compare_singles(values, all_words_.data() + first, count, bounds_.low.data(), bounds_.high.data(),
                  structure_.level().is_constant(), at_most_low, at_most_high);
  uint64_t* const words = block_.row(group.y(row), group.z(row)) + first;
  for (size_t n = 0; n < count; ++n) {
    uint64_t in = at_most_low[n];
    const size_t from = n * bits_per_word;
    in |= decide_doubtful(structure_, slack_, grid_, begin + from, group.y(row), group.z(row),
                          at_most_high[n] & ~in & words[n],
                          [&](size_t i) { return values[from + i]; });
    words[n] &= in;
  }
}

}  // namespace msq
