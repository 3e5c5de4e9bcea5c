// SPDX-License-Identifier: Apache-2.0
// Every coordinate in the cell depends on one coordinate of the sample, to the last bit. So values
// of a tape that depend on one coordinate are tabulated, and the tables hold the scalar evaluator's
// bits. If a tape is a sum of products with the tables, single precision decides all samples except
// those within its error of the level (row_plan.cpp). Those are evaluated one by one.
#include "structure/functional/functional_rows.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "strut/restrict_words.h"

namespace msq {

namespace {

/// Samples in a cluster, along a row, above which clusters pay. If a sample costs only a few
/// additions, whole words must be saved.
constexpr double critical_linear = 32, critical_samples = 3;

}  // namespace

FunctionalRows::FunctionalRows(const Functional& structure, const RowBlock& block)
    : structure_(structure),
      block_(block),
      grid_(*block.grid),
      angles_(structure, block),
      words_(block.row_words()),
      works_(structure.row_plans().size()) {
  const Neighbourhood& cells = structure.neighbourhood();
  const auto& sample_axis = structure.sample_axis();
  const auto along = std::find(sample_axis.begin(), sample_axis.end(), 0) - sample_axis.begin();
  const double samples = cells.cell_size[static_cast<int>(along)] / grid_.spacing.x;
  clusters_ = structure.clusters().at_most(
      samples / (structure.row_plans()[0].is_linear ? critical_linear : critical_samples));
  if (structure.level().is_constant()) {
    constant_level_ = structure.level().at({});
    words_ = angles_.period(grid_);
    repeats_ = words_ < block.row_words();
  }
  const uint64_t count[3] = {words_ * bits_per_word, block.rows(), block.layers()};
  for (int axis = 0; axis < 3; ++axis) {
    numbers_[axis].resize(count[axis]);
    if (clusters_)
      for (size_t i = 0; i < numbers_[axis].size(); ++i)
        numbers_[axis][i] = clusters_->number(angles_.of[axis][i]);
  }
  const uint64_t columns = repeats_ ? words_ * bits_per_word : grid_.nx;
  for (uint64_t i = 0; i < columns; ++i) {
    if (i == 0 || numbers_[0][i] != columns_.back().cluster)
      columns_.push_back({i, i, numbers_[0][i]});
    columns_.back().end = i + 1;
  }
  if (structure.row_plans()[0].is_linear || structure.row_plans().size() > 1) {
    sample_numbers_.resize(words_ * bits_per_word + batch_padding);
    for (size_t i = 0; i < sample_numbers_.size(); ++i) sample_numbers_[i] = static_cast<float>(i);
  }
  certain_.resize(words_);
  result_.resize(words_ + 1);
  doubt_.resize(words_);
}

void FunctionalRows::tabulate(Work& work) const {
  const Program& program = work.plan.tables;
  const size_t outputs = program.outputs.size(), columns = words_ * bits_per_word;
  Batch batch(program);
  work.tables.assign(outputs, std::vector<double>(columns + batch_padding));
  for (size_t begin = 0; begin < columns; begin += batch_points) {
    const size_t size = std::min(batch_points, columns - begin);
    for (size_t a = 0; a < 3; ++a)
      if (structure_.sample_axis()[a] == 0)
        batch.set_input(a, {angles_.of[0].data() + begin, false});
    batch.run(size);
    for (size_t o = 0; o < outputs; ++o) {
      const Values values = batch.output(o);
      for (size_t i = 0; i < size; ++i) work.tables[o][begin + i] = values[i];
    }
  }
  work.has_tables = true;
  if (!work.plan.is_linear) return;
  for (const std::vector<double>& table : work.tables) {
    work.float_tables.emplace_back(table.begin(), table.end());
    work.float_pointers.push_back(work.float_tables.back().data());
  }
  work.float_pointers.push_back(sample_numbers_.data());
  work.slack = work.plan.slack();
}

void FunctionalRows::keep(const Job* job) {
  const auto end_of = [&](int axis, uint64_t begin, uint64_t first, uint64_t last, uint64_t most) {
    uint64_t end = begin;
    while (end < last && end - begin < most &&
           numbers_[axis][end - first] == numbers_[axis][begin - first])
      ++end;
    return end;
  };
  for (RowGroup group{0, 0, block_.z0, 0}; group.z0 < block_.z1; group.z0 = group.z1) {
    check_cancelled(job);
    group.z1 = end_of(2, group.z0, block_.z0, block_.z1, max_group_layers);
    for (group.y0 = block_.y0; group.y0 < block_.y1; group.y0 = group.y1) {
      group.y1 = end_of(1, group.y0, block_.y0, block_.y1, max_group_rows);
      keep_group(group);
    }
  }
}

bool FunctionalRows::find_alive(const RowGroup& group, uint64_t& first, uint64_t& last) const {
  const size_t row_words = block_.row_words();
  size_t low = row_words, high = 0;
  for (uint64_t k = group.z0; k < group.z1; ++k)
    for (uint64_t j = group.y0; j < group.y1; ++j) {
      const uint64_t* row = block_.row(j, k);
      for (size_t w = 0; w < low; ++w)
        if (row[w]) low = w;
      for (size_t w = row_words; w > std::max(high, low); --w)
        if (row[w - 1]) high = w;
    }
  first = repeats_ ? 0 : low * bits_per_word;
  last = repeats_ ? words_ * bits_per_word : std::min<uint64_t>(grid_.nx, high * bits_per_word);
  return low < row_words;
}

void FunctionalRows::split(const RowGroup& group, uint64_t first, uint64_t last) {
  std::fill(certain_.begin(), certain_.end(), 0);
  for (Work* work : used_) work->runs.clear();
  used_.clear();
  const auto add = [&](size_t tape, const Run& run) {
    if (!works_[tape]) works_[tape] = std::make_unique<Work>(structure_.row_plans()[tape]);
    Work& work = *works_[tape];
    if (work.runs.empty()) used_.push_back(&work);
    if (!work.runs.empty() && work.runs.back().end == run.begin)
      work.runs.back().end = run.end;
    else
      work.runs.push_back(run);
  };
  if (!clusters_) return add(0, {first, last, 0});
  int number[3] = {0, numbers_[1][group.y0 - block_.y0], numbers_[2][group.z0 - block_.z0]};
  const auto& axis = structure_.sample_axis();
  Interval level{constant_level_, constant_level_};
  for (const Run& column : columns_) {
    if (column.end <= first) continue;
    if (column.begin >= last) break;
    number[0] = column.cluster;
    const Clusters::Cluster& cluster =
        clusters_->at(number[axis[0]], number[axis[1]], number[axis[2]]);
    if (!structure_.level().is_constant())
      level = structure_.level().range({grid_.at(column.begin, group.y0, group.z0),
                                        grid_.at(column.end - 1, group.y1 - 1, group.z1 - 1)});
    if (cluster.onset.low > level.high) continue;
    if (cluster.onset.high <= level.low)
      set_bits(certain_.data(), column.begin, column.end - 1);
    else
      add(cluster.tape, {std::max(first, column.begin), std::min(last, column.end), 0});
  }
}

void FunctionalRows::prepare(Work& work, const RowGroup& group) {
  if (!work.has_tables) tabulate(work);
  work.mask.assign(words_, 0);
  for (const Run& run : work.runs) set_bits(work.mask.data(), run.begin, run.end - 1);
  // Kept, because an angle may itself be one of the rows' values.
  std::vector<double>&y = work.row_angles[0], &z = work.row_angles[1];
  y.resize(group.rows() + batch_padding);
  z.resize(group.rows() + batch_padding);
  for (size_t row = 0; row < group.rows(); ++row) {
    y[row] = angles_.of[1][group.y(row) - block_.y0];
    z[row] = angles_.of[2][group.z(row) - block_.z0];
  }
  for (size_t a = 0; a < 3; ++a) {
    const int axis = structure_.sample_axis()[a];
    work.rows.set_input(a, {axis == 2 ? z.data() : y.data(), false});
  }
  work.rows.run(group.rows());
  if (work.plan.is_linear) {
    mixed_words_.clear();
    for (uint32_t w = 0; w < words_; ++w)
      if (work.mask[w]) mixed_words_.push_back(w);
    work.segments.clear();
    return add_segments(work, group, mixed_words_.data(), mixed_words_.size());
  }
  work.pieces.clear();
  work.samples_at.clear();
  for (const Run& run : work.runs)
    for (uint64_t i = run.begin; i < run.end;) {
      const uint64_t end = std::min(run.end, (i / bits_per_word + 1) * bits_per_word);
      work.pieces.push_back({static_cast<uint32_t>(i / bits_per_word),
                             static_cast<uint32_t>(i % bits_per_word),
                             static_cast<uint32_t>(end - i), work.samples_at.size()});
      for (; i < end; ++i) work.samples_at.push_back(i);
    }
  work.gathered.resize(work.tables.size());
  for (size_t t = 0; t < work.tables.size(); ++t) {
    work.gathered[t].resize(work.samples_at.size() + batch_padding);
    for (size_t i = 0; i < work.samples_at.size(); ++i)
      work.gathered[t][i] = work.tables[t][work.samples_at[i]];
  }
}

void FunctionalRows::keep_group(const RowGroup& group) {
  uint64_t first, last;
  if (!find_alive(group, first, last)) return;
  split(group, first, last);
  for (Work* work : used_) prepare(*work, group);
  const size_t row_words = block_.row_words();
  for (size_t row = 0; row < group.rows(); ++row) {
    uint64_t* words = block_.row(group.y(row), group.z(row));
    if (std::all_of(words, words + row_words, [](uint64_t w) { return w == 0; })) continue;
    std::copy(certain_.begin(), certain_.end(), result_.begin());
    for (Work* work : used_) {
      if (!work->plan.is_linear)
        decide_samples(*work, group, row);
      else
        for (const Segment& segment : work->segments) decide_linear(*work, segment, group, row);
    }
    restrict_words(words, result_.data(), words_, row_words);
  }
}

void FunctionalRows::add_segments(Work& work, const RowGroup& group, const uint32_t* words,
                                  size_t count) const {
  if (count == 0) return;
  Segment segment;
  segment.words.assign(words, words + count);
  const Parameter& level = structure_.level();
  if (level.is_constant()) {
    segment.bounds.set(level.range(), work.slack);
  } else {
    segment.from = uint64_t{words[0]} * bits_per_word;
    const uint64_t last = std::min(grid_.nx, (uint64_t{words[count - 1]} + 1) * bits_per_word) - 1;
    const Box3 box{grid_.at(segment.from, group.y0, group.z0),
                   grid_.at(last, group.y1 - 1, group.z1 - 1)};
    const Interval range = level.range(box);
    if (range.high - range.low <= work.slack) {
      segment.bounds.set(range, work.slack);
    } else if (!find_ramp(work, box, last, segment)) {
      if (count > 1) {
        add_segments(work, group, words, count / 2);
        return add_segments(work, group, words + count / 2, count - count / 2);
      }
      segment.has_one_level = false;
      segment.bounds.set(level, work.slack, grid_, group, segment.words);
    }
  }
  work.segments.push_back(std::move(segment));
}

/// A level that is linear along the rows is one more term: minus its slope, times the number of the
/// sample. It starts from its value at a sample of each row. Its error is the departure of two
/// values from a linear field, and the rounding of two positions.
bool FunctionalRows::find_ramp(const Work& work, const Box3& box, uint64_t last,
                               Segment& segment) const {
  Vec3 gradient;
  if (work.plan.is_absolute || grid_.nx >= 1 << 24 || !structure_.level().is_linear(box, gradient))
    return false;
  segment.has_ramp = true;
  segment.ramp = gradient.x * grid_.spacing.x;
  const Interval range = structure_.level().range();
  const double most = std::max(std::abs(range.low), std::abs(range.high));
  const double steps = 2 * std::abs(segment.ramp) * static_cast<double>(last);
  const double departure =
      0x1p-38 * (range.high - range.low) +
      0x1p-48 * std::abs(gradient.x) *
          (max_magnitude(box.min) + max_magnitude(box.max) + grid_.magnitude());
  segment.bounds.set(Interval{0, 0}, work.plan.slack(2, most + steps) + departure);
  return true;
}

void FunctionalRows::decide_linear(Work& work, const Segment& segment, const RowGroup& group,
                                   size_t row) {
  float coefficients[64];
  size_t terms = work.tables.size();
  for (size_t t = 0; t < terms; ++t) coefficients[t] = static_cast<float>(work.rows.output(t)[row]);
  double constant = work.rows.output(terms)[row];
  if (segment.has_ramp) {
    const double level = structure_.level().at(grid_.at(segment.from, group.y(row), group.z(row)));
    constant -= level - segment.ramp * static_cast<double>(segment.from);
    coefficients[terms++] = static_cast<float>(-segment.ramp);
  }
  const LinearRow linear{work.float_pointers.data(), coefficients, terms,
                         static_cast<float>(constant), work.plan.is_absolute};
  const LinearWords words{segment.words.data(),      segment.words.size(),
                          segment.bounds.low.data(), segment.bounds.high.data(),
                          segment.has_one_level,     work.mask.data()};
  if (!msq::decide_linear(linear, words, {result_.data(), doubt_.data()})) return;
  for (size_t n = 0; n < segment.words.size(); ++n) {
    const uint32_t w = segment.words[n];
    for (uint64_t doubt = doubt_[n]; doubt; doubt &= doubt - 1) {
      const uint64_t i = w * bits_per_word + static_cast<uint64_t>(std::countr_zero(doubt));
      if (decide(work, segment, linear, group, row, i)) result_[w] |= doubt & -doubt;
    }
  }
}

bool FunctionalRows::decide(const Work& work, const Segment& segment, const LinearRow& row,
                            const RowGroup& group, size_t row_number, uint64_t i) const {
  // Samples that are not alive may lie where the definition must not be evaluated. Of samples that
  // repeat, any will do.
  const uint64_t j = group.y(row_number), k = group.z(row_number);
  const uint64_t* alive = block_.row(j, k);
  const uint64_t step = words_ * bits_per_word;
  while (i < grid_.nx && !(alive[i / bits_per_word] >> (i % bits_per_word) & 1)) i += step;
  if (i >= grid_.nx) return false;
  const Vec3 p = grid_.at(i, j, k);
  if (structure_.level().is_constant() || segment.has_ramp) return structure_.inside(p);
  float sum = row.constant;
  for (size_t t = 0; t < row.terms; ++t) sum += row.tables[t][i] * row.coefficients[t];
  if (row.is_absolute) sum = std::abs(sum);
  const double level = structure_.level().at(p);
  if (sum <= level - work.slack) return true;
  if (sum > level + work.slack) return false;
  return structure_.inside(p);
}

void FunctionalRows::decide_samples(Work& work, const RowGroup& group, size_t row) {
  const size_t tables = work.tables.size(), count = work.samples_at.size();
  const size_t outputs = work.plan.rows.outputs.size();
  for (size_t o = 0; o < outputs; ++o) {
    const Values values = work.rows.output(o);
    work.samples.set_input(tables + o, {values.is_uniform ? values.data : values.data + row, true});
  }
  const bool is_constant = structure_.level().is_constant();
  levels_.resize(is_constant ? 1 : count + batch_padding);
  if (is_constant)
    levels_[0] = constant_level_;
  else
    for (size_t i = 0; i < count; ++i)
      levels_[i] = structure_.level().at(grid_.at(work.samples_at[i], group.y(row), group.z(row)));
  std::vector<uint64_t>& bits = held_;
  bits.resize(words_ + 1);
  for (size_t begin = 0; begin < count; begin += batch_points) {
    const size_t size = std::min(batch_points, count - begin);
    for (size_t t = 0; t < tables; ++t)
      work.samples.set_input(t, {work.gathered[t].data() + begin, false});
    work.samples.run(size);
    compare_values(work.samples.output(0),
                   {levels_.data() + (is_constant ? 0 : begin), is_constant}, size,
                   bits.data() + begin / bits_per_word);
  }
  for (const Piece& piece : work.pieces) {
    const size_t w = piece.from / bits_per_word, shift = piece.from % bits_per_word;
    uint64_t part = bits[w] >> shift;
    if (shift + piece.length > bits_per_word) part |= bits[w + 1] << (bits_per_word - shift);
    part &= ~uint64_t{0} >> (bits_per_word - piece.length);
    result_[piece.word] |= part << piece.shift;
  }
}

}  // namespace msq
