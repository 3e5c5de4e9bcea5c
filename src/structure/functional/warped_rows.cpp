// SPDX-License-Identifier: Apache-2.0
#include "structure/functional/warped_rows.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/borrowed.h"
#include "base/infinity.h"
#include "structure/functional/warped_places.h"
#include "strut/restrict_words.h"

namespace msq {

bool WarpedRows::serves(const Functional& structure) {
  const Warp& warp = *structure.angles().warp();
  return warp.kind() == Warp::Kind::cylindrical && !warp.shell().is_sheared() &&
         structure.sample_axis()[2] >= 0;
}

WarpedRows::WarpedRows(const Functional& structure, const RowBlock& block)
    : structure_(structure),
      warp_(*structure.angles().warp()),
      block_(block),
      grid_(*block.grid),
      axis_(structure.sample_axis()[2]),
      plan_(structure.warped_plan(axis_ == 0 ? 4 : 3)),
      tables_program_(plan_.tables),
      rows_program_(plan_.rows),
      samples_program_(plan_.samples) {
  const size_t words = block.row_words(), columns = words * bits_per_word;
  x_.resize(columns + batch_padding);
  for (size_t i = 0; i < x_.size(); ++i) x_[i] = grid_.x(std::min<uint64_t>(i, grid_.nx - 1));
  for (auto& angles : angles_) angles.resize(columns + batch_padding);
  radii_.resize(columns + batch_padding);
  for (auto& angles : row_angles_) angles.resize(batch_points + batch_padding);
  row_radii_.resize(batch_points + batch_padding);
  row_positions_.resize(batch_points + batch_padding);
  tables_.assign(plan_.tables.outputs.size(), std::vector<double>(columns + batch_padding));
  float_tables_.assign(plan_.is_linear ? tables_.size() : 0,
                       std::vector<float>(columns + batch_padding));
  for (const auto& table : float_tables_) float_pointers_.push_back(table.data());
  shell_.assign(words + 1, ~uint64_t{0});
  result_.resize(words + 1);
  doubt_.resize(words);
  scratch_.resize(words + 1);
  for (uint32_t w = 0; w < words; ++w) all_words_.push_back(w);
  slack_ = plan_.is_linear ? plan_.slack() : 0;
  if (structure.level().is_constant()) bounds_.set(structure.level().range(), slack_);
}

void WarpedRows::find_places(double y, double z) {
  const size_t count = block_.row_words() * bits_per_word;
  find_warped_places(warp_, {x_.data(), false}, {&y, true}, {&z, true}, count,
                     {angles_[0].data(), angles_[1].data(), angles_[2].data()}, radii_.data());
}

void WarpedRows::tabulate() {
  const size_t columns = block_.row_words() * bits_per_word;
  for (size_t begin = 0; begin < columns; begin += batch_points) {
    const size_t size = std::min(batch_points, columns - begin);
    for (size_t a = 0; a < 3; ++a) tables_program_.set_input(a, {angles_[a].data() + begin, false});
    tables_program_.run(size);
    for (size_t t = 0; t < tables_.size(); ++t) {
      const Values values = tables_program_.output(t);
      for (size_t i = 0; i < size; ++i) tables_[t][begin + i] = values[i];
    }
  }
  for (size_t t = 0; t < float_tables_.size(); ++t)
    for (size_t i = 0; i < columns; ++i) float_tables_[t][i] = static_cast<float>(tables_[t][i]);
}

void WarpedRows::keep(const Job* job) {
  if (axis_ == 0)
    keep_along(job);
  else
    keep_across(job);
}

/// Rows along the axis: one table for all rows, which differ in two angles and in the radius.
void WarpedRows::keep_along(const Job* job) {
  find_places(grid_.y(block_.y0), grid_.z(block_.z0));
  tabulate();
  for (uint64_t k = block_.z0; k < block_.z1; ++k)
    for (uint64_t y0 = block_.y0; y0 < block_.y1; y0 += batch_points) {
      check_cancelled(job);
      const uint64_t y1 = std::min<uint64_t>(block_.y1, y0 + batch_points);
      for (uint64_t j = y0; j < y1; ++j) row_positions_[j - y0] = grid_.y(j);
      const double x = x_[0], z = grid_.z(k);
      find_warped_places(warp_, {&x, true}, {row_positions_.data(), false}, {&z, true}, y1 - y0,
                         {row_angles_[0].data(), row_angles_[1].data(), row_angles_[2].data()},
                         row_radii_.data());
      for (size_t a = 0; a < 3; ++a) rows_program_.set_input(a, {row_angles_[a].data(), false});
      rows_program_.run(y1 - y0);
      for (uint64_t j = y0; j < y1;) {
        if (!warp_.is_in_shell(row_radii_[j - y0])) {
          std::fill_n(block_.row(j, k), block_.row_words(), 0);
          ++j;
          continue;
        }
        uint64_t end = j + 1;
        while (end < y1 && end - j < max_group_rows && warp_.is_in_shell(row_radii_[end - y0]))
          ++end;
        keep_group({j, end, k, k + 1}, j - y0);
        j = end;
      }
    }
}

/// Rows across the axis: tables for each position across it, for all rows along it.
void WarpedRows::keep_across(const Job* job) {
  const bool is_z = axis_ == 2;
  const uint64_t first = is_z ? block_.y0 : block_.z0, last = is_z ? block_.y1 : block_.z1;
  const uint64_t begin = is_z ? block_.z0 : block_.y0, end = is_z ? block_.z1 : block_.y1;
  const uint64_t most = is_z ? max_group_layers : max_group_rows;
  const double inner = warp_.shell().inner, outer = warp_.outer();
  for (uint64_t i = first; i < last; ++i) {
    check_cancelled(job);
    const auto row_of = [&](uint64_t n) { return is_z ? block_.row(i, n) : block_.row(n, i); };
    bool is_empty = true;
    for (uint64_t n = begin; n < end && is_empty; ++n)
      is_empty =
          std::all_of(row_of(n), row_of(n) + block_.row_words(), [](uint64_t w) { return w == 0; });
    if (is_empty) continue;
    find_places(is_z ? grid_.y(i) : grid_.y(block_.y0), is_z ? grid_.z(block_.z0) : grid_.z(i));
    const size_t columns = block_.row_words() * bits_per_word;
    compare_values({&inner, true}, {radii_.data(), false}, columns, shell_.data());
    compare_values({radii_.data(), false}, {&outer, true}, columns, scratch_.data());
    for (size_t w = 0; w < block_.row_words(); ++w) shell_[w] &= scratch_[w];
    tabulate();
    for (uint64_t n0 = begin; n0 < end; n0 += batch_points) {
      const uint64_t n1 = std::min<uint64_t>(end, n0 + batch_points);
      for (uint64_t n = n0; n < n1; ++n) row_positions_[n - n0] = is_z ? grid_.z(n) : grid_.y(n);
      const double x = x_[0], other = is_z ? grid_.y(i) : grid_.z(i);
      const Values along{row_positions_.data(), false}, across{&other, true};
      find_warped_places(warp_, {&x, true}, is_z ? across : along, is_z ? along : across, n1 - n0,
                         {row_angles_[0].data(), row_angles_[1].data(), row_angles_[2].data()},
                         row_radii_.data());
      for (size_t a = 0; a < 3; ++a) rows_program_.set_input(a, {row_angles_[a].data(), false});
      rows_program_.run(n1 - n0);
      for (uint64_t n = n0; n < n1; n += most) {
        const uint64_t after = std::min(n1, n + most);
        keep_group(is_z ? RowGroup{i, i + 1, n, after} : RowGroup{n, after, i, i + 1}, n - n0);
      }
    }
  }
}

void WarpedRows::find_words(uint64_t j, uint64_t k) {
  const uint64_t* row = block_.row(j, k);
  words_.clear();
  for (const uint32_t w : all_words_)
    if (row[w] & shell_[w]) words_.push_back(w);
}

void WarpedRows::keep_group(const RowGroup& group, size_t first) {
  if (plan_.is_linear && !structure_.level().is_constant())
    bounds_.set(structure_.level(), slack_, grid_, group, all_words_);
  for (size_t row = 0; row < group.rows(); ++row) {
    const uint64_t j = group.y(row), k = group.z(row);
    find_words(j, k);
    std::fill(result_.begin(), result_.end(), 0);
    if (!words_.empty()) {
      if (plan_.is_linear)
        decide_linear(group, row, first + row);
      else
        decide_samples(group, row, first + row);
    }
    restrict_words(block_.row(j, k), result_.data(), block_.row_words(), block_.row_words());
  }
}

void WarpedRows::decide_linear(const RowGroup& group, size_t row, size_t number) {
  float coefficients[64];
  const size_t terms = tables_.size();
  for (size_t t = 0; t < terms; ++t)
    coefficients[t] = static_cast<float>(rows_program_.output(t)[number]);
  const double constant = rows_program_.output(terms)[number];
  const LinearRow linear{float_pointers_.data(), coefficients, terms, static_cast<float>(constant),
                         plan_.is_absolute};
  const LinearWords words{words_.data(),
                          words_.size(),
                          bounds_.low.data(),
                          bounds_.high.data(),
                          structure_.level().is_constant(),
                          shell_.data()};
  if (!msq::decide_linear(linear, words, {result_.data(), doubt_.data()})) return;
  const uint64_t j = group.y(row), k = group.z(row);
  const uint64_t* alive = block_.row(j, k);
  for (size_t n = 0; n < words_.size(); ++n) {
    const uint32_t w = words_[n];
    for (uint64_t doubt = doubt_[n] & alive[w]; doubt; doubt &= doubt - 1) {
      const uint64_t i = w * bits_per_word + static_cast<uint64_t>(std::countr_zero(doubt));
      if (structure_.inside(grid_.at(i, j, k))) result_[w] |= doubt & -doubt;
    }
  }
}

void WarpedRows::decide_samples(const RowGroup& group, size_t row, size_t number) {
  const uint64_t j = group.y(row), k = group.z(row);
  const uint64_t* alive = block_.row(j, k);
  const Parameter& level = structure_.level();
  const size_t tables = tables_.size();
  double level_of_all = level.is_constant() ? level.at({}) : 0;
  for (size_t t = 0; t < plan_.rows.outputs.size(); ++t) {
    const Values values = rows_program_.output(t);
    samples_program_.set_input(tables + t,
                               {values.is_uniform ? values.data : values.data + number, true});
  }
  levels_.resize(bits_per_word + batch_padding);
  for (const uint32_t w : words_) {
    const uint64_t begin = w * bits_per_word;
    if (!level.is_constant())
      for (uint64_t live = alive[w] & shell_[w]; live; live &= live - 1) {
        const auto bit = static_cast<uint64_t>(std::countr_zero(live));
        levels_[bit] = level.at(grid_.at(begin + bit, j, k));
      }
    for (size_t t = 0; t < tables; ++t)
      samples_program_.set_input(t, {tables_[t].data() + begin, false});
    samples_program_.run(bits_per_word);
    uint64_t bits = 0;
    compare_values(
        samples_program_.output(0),
        level.is_constant() ? Values{&level_of_all, true} : Values{levels_.data(), false},
        bits_per_word, &bits);
    result_[w] = bits & shell_[w];
  }
}

namespace {

/// The positions in the cell, at most two intervals of them, of an interval of cell coordinates.
size_t fractions_of(Interval cells, Interval (&to)[2]) {
  const double first = std::floor(cells.low), last = std::floor(cells.high);
  if (cells.high - cells.low >= 1 || last - first > 1) {
    to[0] = {0, 1};
    return 1;
  }
  if (first == last) {
    to[0] = {cells.low - first, cells.high - first};
    return 1;
  }
  to[0] = {cells.low - first, 1};
  to[1] = {0, cells.high - last};
  return 2;
}

}  // namespace

/// Positions in the cell and angles are monotone in the coordinates, rounding included, so the ends
/// of intervals enclose them.
BoxClass classify_warped(const Functional& structure, const Box3& box) {
  Box3 cells;
  bool is_within;  // whether the cells fill the box
  if (const SampledMap* map = structure.angles().sampled()) {
    const SampledMap::Side side = map->side_of(box);
    if (side == SampledMap::Side::outside) return BoxClass::outside;
    is_within = side == SampledMap::Side::inside;
    cells = map->image_of(box);
  } else {
    const Warp& warp = *structure.angles().warp();
    const Warp::Image image = warp.image(box);
    if (image.radius.high < warp.shell().inner || image.radius.low > warp.outer())
      return BoxClass::outside;
    is_within = warp.is_in_shell(image.radius.low) && warp.is_in_shell(image.radius.high);
    cells = image.cells;
  }
  const Vec3 extent = cells.extent();
  if (min_component(extent) >= 1) return BoxClass::mixed;
  Interval parts[3][2];
  size_t counts[3];
  for (int axis = 0; axis < 3; ++axis)
    counts[axis] = fractions_of({cells.min[axis], cells.max[axis]}, parts[axis]);
  const Borrowed<std::vector<Enclosure>> nodes;
  Interval onset{infinity, -infinity};
  for (size_t x = 0; x < counts[0]; ++x)
    for (size_t y = 0; y < counts[1]; ++y)
      for (size_t z = 0; z < counts[2]; ++z) {
        const Interval of_cell[3] = {parts[0][x], parts[1][y], parts[2][z]};
        Interval angles[3];
        for (int axis = 0; axis < 3; ++axis)
          angles[axis] = {angle_of(of_cell[axis].low), angle_of(of_cell[axis].high)};
        enclose(structure.onset(), angles, *nodes);
        onset.low = std::min(onset.low, nodes->back().low);
        onset.high = std::max(onset.high, nodes->back().high);
      }
  const Interval level = structure.level().range(box);
  if (onset.low > level.high) return BoxClass::outside;
  return is_within && onset.high <= level.low ? BoxClass::inside : BoxClass::mixed;
}

}  // namespace msq
