// SPDX-License-Identifier: Apache-2.0
// The margin between the levels of what is certain. The tape's value, and coefficients in double
// precision, are within RowPlan::slack() / 2 of the sum of products that they stand for
// (row_plan.cpp), and the ends of intervals within 2^-24 of the amplitude (single_wave.cpp), which
// is at most sqrt(2) times the most that the slack is made for: together less than slack(). So is
// the value by tables in single precision, from which samples between the levels are decided; those
// within the slack of the level are left to the definition.
#include "structure/functional/single_wave_rows.h"

#include <algorithm>
#include <cmath>

#include "structure/functional/doubtful_samples.h"
#include "strut/restrict_words.h"

namespace msq {

namespace {

RowGroup all_rows(const RowBlock& block) {
  return {block.y0, block.y1, block.z0, block.z1};
}

Interval level_of(const Functional& structure, const SampleGrid& grid, const RowGroup& rows,
                  uint64_t number) {
  const uint64_t j = rows.y(number), k = rows.z(number);
  return structure.level().range({grid.at(0, j, k), grid.at(grid.nx - 1, j, k)});
}

}  // namespace

WaveColumns::Table::Table(const double* from, size_t count) : angles(from, from + count) {
  constexpr size_t window_columns = window_words * bits_per_word;
  for (size_t first = 0; first < count; first += window_columns) {
    const size_t size = std::min(window_columns, count - first);
    std::vector<double> fractions(size);
    std::vector<float> sines(size), cosines(size);
    for (size_t i = 0; i < size; ++i) {
      const double angle = angles[first + i];
      fractions[i] = angle / two_pi;
      sines[i] = static_cast<float>(std::sin(angle));
      cosines[i] = static_cast<float>(std::cos(angle));
    }
    windows.push_back(
        {ColumnSets(fractions.data(), 0, size), std::move(sines), std::move(cosines)});
  }
}

size_t WaveColumns::Table::bytes() const {
  size_t all = angles.capacity() * sizeof(double);
  for (const Window& window : windows)
    all +=
        window.sets.bytes() + (window.sines.capacity() + window.cosines.capacity()) * sizeof(float);
  return all;
}

const std::vector<WaveColumns::Window>& WaveColumns::of(const double* angles, size_t count) {
  for (const Table& table : tables_)
    if (table.angles.size() == count && std::equal(angles, angles + count, table.angles.begin()))
      return table.windows;
  Table made(angles, count);
  while (!tables_.empty() && (tables_.size() == max_tables || bytes_ > max_bytes)) {
    bytes_ -= tables_.front().bytes();
    tables_.pop_front();
  }
  tables_.push_back(std::move(made));
  bytes_ += tables_.back().bytes();
  return tables_.back().windows;
}

// Levels that differ by a thousandth of the largest values leave about as many samples in doubt.
bool SingleWaveRows::serves(const Functional& structure, const RowBlock& block) {
  const RowPlan* const plan = structure.wave_plan();
  if (!plan || block.row_words() > WaveColumns::window_words * WaveColumns::max_windows)
    return false;
  if (structure.level().is_constant()) return true;
  const Interval level = level_of(structure, *block.grid, all_rows(block), 0);
  return level.high - level.low <= 0x1p12 * plan->slack();
}

SingleWaveRows::SingleWaveRows(const Functional& structure, const RowBlock& block)
    : structure_(structure),
      block_(block),
      all_(all_rows(block)),
      plan_(*structure.wave_plan()),
      angles_(structure, block),
      words_(structure.level().is_constant() ? angles_.period(*block.grid) : block.row_words()),
      slack_(plan_.slack()),
      rows_(plan_.rows),
      y_(batch_points + batch_padding),
      z_(batch_points + batch_padding),
      sine_(batch_points + batch_padding),
      cosine_(batch_points + batch_padding),
      threshold_(batch_points + batch_padding),
      level_(batch_points, structure.level().range()) {}

void SingleWaveRows::keep(const Job* job) {
  const std::vector<WaveColumns::Window>* windows = nullptr;
  const Borrowed<WaveLevels> levels;
  const uint64_t rows = all_.rows();
  for (uint64_t first = 0; first < rows; first += batch_points) {
    check_cancelled(job);
    const size_t count = std::min<uint64_t>(batch_points, rows - first);
    size_t row = 0;
    while (row < count && !is_alive(first + row)) ++row;
    if (row == count) continue;
    if (!windows) {
      const size_t columns = std::min<uint64_t>(words_ * bits_per_word, block_.grid->nx);
      windows = &columns_->of(angles_.of[0].data(), columns);
      result_.resize(windows->size() * WaveColumns::window_words);
      doubt_.resize(WaveColumns::window_words);
    }
    find_levels(first, count, *levels);
    for (; row < count; ++row)
      if (is_alive(first + row)) keep_row(*windows, *levels, first + row, row);
  }
}

bool SingleWaveRows::is_alive(uint64_t number) const {
  const uint64_t* const words = block_.row(all_.y(number), all_.z(number));
  return std::any_of(words, words + block_.row_words(), [](uint64_t w) { return w != 0; });
}

void SingleWaveRows::find_levels(uint64_t first, size_t count, WaveLevels& levels) {
  for (size_t row = 0; row < count; ++row) {
    y_[row] = angles_.of[1][all_.y(first + row) - block_.y0];
    z_[row] = angles_.of[2][all_.z(first + row) - block_.z0];
  }
  for (size_t a = 0; a < 3; ++a)
    rows_.set_input(a, {structure_.sample_axis()[a] == 2 ? z_.data() : y_.data(), false});
  rows_.run(count);
  const std::vector<RowPlan::WaveTable>& tables = *plan_.wave;
  for (std::vector<double>* of : {&sine_, &cosine_}) std::fill(of->begin(), of->end(), 0);
  for (size_t t = 0; t < tables.size(); ++t) {
    const Values values = rows_.output(t);
    double* const to = (tables[t].is_sine ? sine_ : cosine_).data();
    for (size_t row = 0; row < count; ++row) to[row] += tables[t].factor * values[row];
  }
  constant_ = rows_.output(tables.size());
  const SingleWaves waves{sine_.data(), cosine_.data(), constant_, count};
  if (!structure_.level().is_constant())
    for (size_t row = 0; row < count; ++row)
      level_[row] = level_of(structure_, *block_.grid, all_, first + row);
  const auto find = [&](size_t level, const auto& threshold) {
    for (size_t row = 0; row < count; ++row) threshold_[row] = threshold(level_[row]);
    find_wave_ends(waves, threshold_.data(), levels.ends[level]);
  };
  find(WaveLevels::least, [&](Interval level) { return level.low - slack_; });
  find(WaveLevels::most, [&](Interval level) { return level.high + slack_; });
  levels.has_hole = plan_.is_absolute;
  if (!plan_.is_absolute) return;
  find(WaveLevels::hole_least, [&](Interval level) { return -(level.high + slack_); });
  find(WaveLevels::hole_most, [&](Interval level) { return -(level.low - slack_); });
}

void SingleWaveRows::keep_row(const std::vector<WaveColumns::Window>& windows,
                              const WaveLevels& levels, uint64_t number, size_t row) {
  const uint64_t j = all_.y(number), k = all_.z(number);
  uint64_t* const words = block_.row(j, k);
  const double sine = sine_[row], cosine = cosine_[row], constant = constant_[row];
  for (size_t n = 0; n < windows.size(); ++n) {
    const WaveColumns::Window& window = windows[n];
    const size_t first = n * WaveColumns::window_words;
    if (!mark_wave(window.sets, levels, row, result_.data() + first, doubt_.data())) continue;
    const size_t end = std::min(words_ - first, WaveColumns::window_words);
    for (size_t w = 0; w < end; ++w) {
      if (!doubt_[w]) continue;
      const uint64_t doubt = doubt_[w] & alive(words, first + w);
      if (!doubt) continue;
      result_[first + w] |= decide_doubtful(
          structure_, slack_, *block_.grid, (first + w) * bits_per_word, j, k, doubt,
          [&](size_t i) {
            const size_t at = w * bits_per_word + i;
            const double value = constant + sine * window.sines[at] + cosine * window.cosines[at];
            return plan_.is_absolute ? std::abs(value) : value;
          });
    }
  }
  restrict_words(words, result_.data(), words_, block_.row_words());
}

/// Of a word of a row and those that repeat it, the samples that are asked for.
uint64_t SingleWaveRows::alive(const uint64_t* words, size_t word) const {
  uint64_t any = 0;
  for (size_t w = word; w < block_.row_words(); w += words_) any |= words[w];
  return any;
}

}  // namespace msq
