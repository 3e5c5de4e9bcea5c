// SPDX-License-Identifier: Apache-2.0
// Every position in the cell depends on one coordinate of the sample, to the last bit, and equals
// that of the predicate. Rows are first drawn into separate words, which then restrict the block's
// words.
#include "structure/lattice/rows/lattice_rows.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "base/sample_bounds.h"
#include "base/simd.h"
#include "structure/common/row_period.h"
#include "strut/restrict_words.h"

namespace msq {

namespace {

/// Rows of a layer that share bounds of a radius that is not linear.
constexpr uint64_t bounded_rows = 16;

/// Positions in the cell within this are one, of rows and layers.
double same_position(const RowParts& parts) {
  return 0x1p-40 * parts.extent;
}

}  // namespace

LatticeRows::LatticeRows(const Neighbourhood& grid, const std::array<int, 3>& axis,
                         const RowParts& parts, const Parameter& radius, const RowBlock& block,
                         const Repeats& repeats)
    : cells_(grid),
      axis_(axis),
      parts_(parts),
      radius_(radius),
      block_(block),
      repeats_(repeats),
      grid_(*block.grid),
      same_(same_position(parts)),
      margin_(8 * same_),
      level_margin_(0x1p-24 * parts.extent + parts.error) {
  SampleBounds alive;
  if (!find_bounds(block, alive)) return;
  i0_ = alive.i0;
  i1_ = alive.i1;
  j0_ = alive.j0;
  j1_ = alive.j1;
  k0_ = alive.k0;
  k1_ = alive.k1;
  const Box3 box{grid_.at(i0_, j0_, k0_), grid_.at(i1_ - 1, j1_ - 1, k1_ - 1)};
  is_linear_ = radius.is_linear(box, gradient_);
  if (!is_linear_) return;
  // The field departs from a linear one, at the sample and at its starting point, and positions are
  // rounded.
  const Interval range = radius.range();
  const double positions = max_magnitude(box.min) + max_magnitude(box.max) + grid_.magnitude();
  const double slopes = std::abs(gradient_.x) + std::abs(gradient_.y) + std::abs(gradient_.z);
  const double departure = 0x1p-38 * (range.high - range.low) + 0x1p-48 * slopes * positions;
  margin_ += parts.max_factor * departure;
  level_margin_ += parts.max_factor * departure;
}

std::vector<double> LatticeRows::positions(int axis, uint64_t first, uint64_t end) const {
  std::vector<double> out;
  out.reserve(end - first + max_simd_doubles);
  const int along = axis_[static_cast<size_t>(axis)];
  Vec3 p = grid_.at(i0_, j0_, k0_);
  for (uint64_t i = first; i < end; ++i) {
    p[axis] = axis == 0 ? grid_.x(i) : axis == 1 ? grid_.y(i) : grid_.z(i);
    out.push_back(cells_.locate(p).fraction[along]);
  }
  return out;
}

// Rows of a period are drawn for positions within `same` of their own, or within twice that if they
// are found drawn, along y and along z. Rows that repeat them, and bands that begin with such a
// row, are within `same` more each, along y. So all are drawn for positions within four times that
// along y and twice along z, together less than five times; the margin is eight.
uint64_t LatticeRows::row_period(const Neighbourhood& grid, const std::array<int, 3>& axis,
                                 const RowParts& parts, const SampleGrid& samples, uint64_t y0,
                                 uint64_t y1) {
  std::vector<double> at;
  at.reserve(y1 - y0);
  const int along = axis[1];
  for (uint64_t j = y0; j < y1; ++j)
    at.push_back(grid.locate(samples.at(0, j, 0)).fraction[along] * grid.cell_size[along]);
  return period_of(at.data(), at.size(), same_position(parts));
}

bool LatticeRows::keep(const Job* job, const std::function<bool(Vec3)>& inside) {
  if (i0_ >= i1_) return true;
  if (!(level_margin_ <= parts_.extent)) return false;
  const uint64_t first = i0_ / bits_per_word / ColumnSets::part_words * ColumnSets::part_words;
  for (uint64_t w = first; w * bits_per_word < i1_; w += window_words) keep_window(w, job, inside);
  return true;
}

RowTables::Line LatticeRows::line(int axis, uint64_t begin, uint64_t end) const {
  const auto of = static_cast<size_t>(axis), along = static_cast<size_t>(axis_[of]);
  return {cells_.origin[axis],
          cells_.rotation.m[3 * of + along],
          cells_.cell_size[axis_[of]],
          grid_.origin[axis],
          grid_.spacing[axis],
          grid_.first[of],
          0,
          begin,
          end,
          0};
}

RowTables::Columns LatticeRows::make_columns(uint64_t base, uint64_t begin, uint64_t end) const {
  std::vector<double> x = positions(0, begin, end), samples;
  x.insert(x.begin(), begin - base, 0);
  ColumnSets sets(x.data(), begin - base, end - base);
  for (double& position : x) position *= parts_.cell_size[0];
  samples.reserve(end - base);
  for (uint64_t i = base; i < end; ++i) samples.push_back(grid_.x(i));
  const UnrolledColumns unrolled = unroll(x, begin - base);
  return {std::move(x), std::move(samples), std::move(sets), unrolled};
}

/// Of the positions of columns in the cell, from column `first` on.
UnrolledColumns LatticeRows::unroll(const std::vector<double>& x, size_t first) const {
  const double size = parts_.cell_size[0];
  UnrolledColumns made{};
  made.first = static_cast<double>(first);
  made.last = static_cast<double>(x.size() - 1);
  made.width = cells_.rotation.m[static_cast<size_t>(axis_[0])] * grid_.spacing.x;
  made.zero = x[first] - made.first * made.width;
  for (size_t i = first; i < x.size(); ++i) {
    const double off = x[i] - made.position(static_cast<double>(i));
    made.off = std::max(made.off, std::abs(off - size * std::round(off / size)));
  }
  made.off += 0x1p-48 * (std::abs(made.position(made.last)) + std::abs(made.zero) + parts_.extent);
  return made;
}

/// Rows or layers [begin, end) in the order of their positions in the cell; positions within `same`
/// of each other are one class.
LatticeRows::Classes LatticeRows::make_classes(int axis, uint64_t begin, uint64_t end,
                                               double same) const {
  const std::vector<double> fractions = positions(axis, begin, end);
  Classes made;
  made.members.resize(fractions.size());
  std::iota(made.members.begin(), made.members.end(), begin);
  const auto position = [&](uint64_t i) {
    return fractions[i - begin] * parts_.cell_size[static_cast<size_t>(axis)];
  };
  std::sort(made.members.begin(), made.members.end(), [&](uint64_t i, uint64_t j) {
    return position(i) != position(j) ? position(i) < position(j) : i < j;
  });
  for (size_t n = 0; n < made.members.size(); ++n) {
    const double at = position(made.members[n]);
    if (n > 0 && at - made.positions.back() <= same) continue;
    made.first.push_back(n);
    made.positions.push_back(at);
  }
  made.first.push_back(made.members.size());
  made.positions.resize(made.count() + max_simd_doubles, 0);
  return made;
}

void LatticeRows::keep_window(size_t first_word, const Job* job,
                              const std::function<bool(Vec3)>& inside) {
  const uint64_t base = first_word * bits_per_word;
  const uint64_t begin = std::max(i0_, base), end_of_all = base + window_words * bits_per_word;
  const uint64_t end = std::min(i1_, end_of_all);
  // All columns of the window, so that other tiles find their table, unless few of them are alive.
  RowTables::Line columns = line(0, begin, end);
  columns.base = base;
  const uint64_t last = std::min(grid_.nx, end_of_all);
  if (4 * (end - begin) >= last - base) {
    columns.begin = base;
    columns.end = last;
  }
  const std::shared_ptr<const RowTables::Columns> table =
      tables_->columns(columns, [&] { return make_columns(base, columns.begin, columns.end); });
  const Window window{first_word, base, begin, end, words_for(end) - first_word, *table, columns};
  const uint64_t max_rows = radius_.is_constant() || is_linear_ ? j1_ - j0_ : bounded_rows;
  for (uint64_t j = j0_; j < j1_; j += max_rows)
    keep_rows(window, j, std::min(j1_, j + max_rows), job, inside);
}

void LatticeRows::keep_rows(const Window& window, uint64_t begin, uint64_t end, const Job* job,
                            const std::function<bool(Vec3)>& inside) {
  // If the radius is constant, rows at the same position in the cell are equal.
  const double same = radius_.is_constant() ? same_ : -1;
  RowTables::Line of_rows = line(1, begin, end);
  of_rows.same = same;
  const auto make_rows = [&] { return make_classes(1, begin, end, same); };
  const std::shared_ptr<const Classes> kept = radius_.is_constant()
                                                  ? tables_->classes(of_rows, make_rows)
                                                  : std::make_shared<const Classes>(make_rows());
  const Classes &rows = *kept, layers = make_classes(2, k0_, k1_, same);
  std::vector<double> sample_y;
  for (const uint64_t j : rows.members) sample_y.push_back(grid_.y(j));
  RowTask task;
  task.columns = &window.columns.sets;
  task.x = window.columns.positions.data();
  task.y = rows.positions.data();
  task.rows = rows.count();
  task.words = window.words;
  task.sample_x = window.columns.samples.data();
  task.sample_y = sample_y.data();  // of each row, if they are evaluated one by one
  task.margin = margin_;
  const size_t padded = task.row_words();
  std::vector<uint64_t> all(padded);
  set_bits(all.data(), window.begin - window.base, window.end - 1 - window.base);
  const Borrowed<std::vector<uint64_t>> scratch;
  scratch->resize(rows.count() * padded + 1);
  std::vector<const uint64_t*> alive(rows.count());
  task.alive = alive.data();
  std::vector<LeftSample> left;
  std::vector<Bit> restored;
  const auto draw = [&](std::vector<uint64_t>& words, std::vector<LeftSample>& undecided) {
    std::fill(words.begin(), words.end(), 0);
    task.inside = words.data();
    parts_.mark_inside(task, undecided);
  };
  // Rows that repeat, if those of all layers and windows of the tile find room.
  const size_t windows = (block_.row_words() + window_words - 1) / window_words;
  const bool is_kept =
      radius_.is_constant() && window.is_whole() && 2 * rows.count() <= rows.members.size() &&
      layers.count() * windows * rows.count() * padded * sizeof(uint64_t) <= RowTables::max_drawn;

  for (size_t layer = 0; layer < layers.count(); ++layer) {
    check_cancelled(job);
    const uint64_t k0 = layers.members[layers.first[layer]];
    task.z = layers.positions[layer];
    task.sample_z = grid_.z(k0);
    // Calls visit(class, words) for each row.
    const auto for_each_row = [&](auto&& visit) {
      for (size_t n = layers.first[layer]; n < layers.first[layer + 1]; ++n)
        for (size_t row = 0; row < rows.count(); ++row)
          for (size_t m = rows.first[row]; m < rows.first[row + 1]; ++m)
            visit(row, block_.row(rows.members[m], layers.members[n]) + window.first_word);
    };
    std::fill(alive.begin(), alive.end(), nullptr);
    size_t alive_rows = 0;
    for_each_row([&](size_t row, const uint64_t* words) {
      for (size_t w = 0; w < window.words; ++w) {
        if (!words[w]) continue;
        alive_rows += !alive[row];
        alive[row] = alive[row] ? all.data() : words;
        return;
      }
    });
    if (alive_rows == 0) continue;
    set_levels(task, window, rows, k0);
    // Positions of rows are then known to 2 * same_, which margin_ exceeds.
    const RowTables::DrawnFrom from{&parts_, window.line,           task.radius,
                                    task.z,  rows.positions.data(), rows.count()};
    const RowTables::DrawnRows* kept_rows = is_kept ? tables_->drawn(from, same_) : nullptr;
    if (!kept_rows && is_kept && 2 * alive_rows >= rows.count()) {
      // For all rows and columns, whichever are alive in other tiles.
      std::fill(alive.begin(), alive.end(), all.data());
      RowTables::DrawnRows made = tables_->make_drawn(rows.count() * padded);
      draw(made.words, made.left);
      kept_rows = &tables_->keep_drawn(from, std::move(made));
    }
    if (!kept_rows) draw(*scratch, left);
    const uint64_t* const drawn = kept_rows ? kept_rows->words.data() : scratch->data();

    const std::vector<LeftSample>& all_left = kept_rows ? kept_rows->left : left;
    // Parts that share a surface leave the same samples, and a flip counts once.
    if (repeats_.period) {
      left_once_ = all_left;
      std::sort(left_once_.begin(), left_once_.end());
      left_once_.erase(std::unique(left_once_.begin(), left_once_.end()), left_once_.end());
    }
    for (const LeftSample& sample : repeats_.period ? left_once_ : all_left) {
      const size_t w = sample.column / bits_per_word;
      const uint64_t bit = uint64_t{1} << (sample.column % bits_per_word);
      if (drawn[sample.row * padded + w] & bit) continue;
      for (size_t n = layers.first[layer]; n < layers.first[layer + 1]; ++n)
        for (size_t m = rows.first[sample.row]; m < rows.first[sample.row + 1]; ++m) {
          const uint64_t j = rows.members[m], k = layers.members[n];
          uint64_t& word = block_.row(j, k)[window.first_word + w];
          if (!(word & bit)) continue;
          const uint64_t i = window.base + sample.column;
          const bool holds = inside(grid_.at(i, j, k));
          if (holds) restored.push_back({&word, bit});
          if (!repeats_.period || repeats_.flips->is_full()) continue;
          for (uint64_t other = j + repeats_.period; other < repeats_.end;
               other += repeats_.period) {
            if (++asked_ % 256 == 0) check_cancelled(job);
            if (inside(grid_.at(i, other, k)) != holds) repeats_.flips->add(i, other);
          }
        }
      if (++asked_ % 256 == 0) check_cancelled(job);
    }
    left.clear();
    for_each_row([&](size_t row, uint64_t* words) {
      restrict_words(words, drawn + row * padded, window.words);
    });
    for (const Bit& bit : restored) *bit.word |= bit.mask;
    restored.clear();
  }
}

/// Whether columns lie on a line, so nearly that copies leave few samples to the predicate, and 31
/// bits number all bits of the rows.
bool LatticeRows::may_draw_copies(const RowTask& task, const UnrolledColumns& columns) const {
  constexpr size_t max_bits = size_t{1} << 31;
  return columns.off <= 0x1p-6 * std::abs(columns.width) &&
         task.rows < max_bits / (task.row_words() * bits_per_word);
}

/// Words of a section of a row of that many columns along which the radius changes by `change`. A
/// section costs about three times as much as a doubtful sample. The number of doubtful samples is
/// about three times the columns times the change, in cells, by which a section's ends move.
size_t LatticeRows::section_words(double columns, double change) const {
  const double best = std::sqrt(columns * change / parts_.cell_size[0]);
  size_t words = ColumnSets::part_words;
  while (words > RowTask::min_section_words &&
         columns < best * 0.7 * static_cast<double>(words * bits_per_word))
    words /= 2;
  return words;
}

void LatticeRows::set_whole_rows(RowTask& task, Interval radii, double margin) const {
  task.levels = {{radii.high, margin}, {radii.low, -margin}};
  std::fill_n(task.outer, RowTask::max_sections, 0);
  std::fill_n(task.inner, RowTask::max_sections, 1);
  task.widest = 0;
  task.section_words = ColumnSets::part_words;
}

void LatticeRows::set_levels(RowTask& task, const Window& window, const Classes& rows, uint64_t k) {
  task.field = nullptr;
  task.of_row = nullptr;
  task.unrolled = nullptr;
  task.radius = task.slope = 0;
  if (radius_.is_constant()) {
    task.radius = radius_.range().high;
    return set_whole_rows(task, radius_.range(), level_margin_);
  }
  if (is_linear_) return set_linear(task, window, rows, k);
  task.field = &radius_;
  task.section_words = ColumnSets::part_words;
  task.levels.clear();
  task.widest = 0;
  const auto [low, high] = std::minmax_element(rows.members.begin(), rows.members.end());
  for (size_t section = 0; section < task.sections(); ++section) {
    constexpr uint64_t columns = ColumnSets::part_words * bits_per_word;
    const uint64_t first = window.base + section * columns;
    const uint64_t from = std::min(std::max(window.begin, first), window.end - 1);
    const uint64_t to = std::max(from, std::min(window.end, first + columns) - 1);
    const Interval range = radius_.range({grid_.at(from, *low, k), grid_.at(to, *high, k)});
    task.outer[section] = task.levels.size();
    task.levels.push_back({range.high, level_margin_});
    task.inner[section] = task.levels.size();
    task.levels.push_back({range.low, -level_margin_});
    if (range.high > task.levels[task.widest].radius) task.widest = task.outer[section];
  }
}

void LatticeRows::set_linear(RowTask& task, const Window& window, const Classes& rows, uint64_t k) {
  // The field is evaluated where it is known to be linear.
  const Vec3 from = grid_.at(window.begin, rows.members[0], k);
  task.slope = gradient_.x * grid_.spacing.x;
  task.radius = radius_.at(from) - task.slope * static_cast<double>(window.begin - window.base);
  of_row_.assign(task.rows + max_simd_doubles, 0);
  for (size_t row = 0; row < task.rows; ++row)
    of_row_[row] = gradient_.y * (grid_.y(rows.members[row]) - from.y);
  task.of_row = of_row_.data();
  // Bounds of the radius are levels as good, and columns far apart would lead far beyond them.
  const auto [least_of_row, most_of_row] =
      std::minmax_element(of_row_.begin(), of_row_.begin() + static_cast<ptrdiff_t>(task.rows));
  const double room = 2 * level_margin_ / parts_.min_factor;
  const double lowest = radius_.range().low - *most_of_row - room;
  const double highest = radius_.range().high - *least_of_row + room;
  const auto radius_at = [&](double column) {
    return std::clamp(task.radius + task.slope * column, lowest, highest);
  };
  const auto columns = static_cast<double>(window.end - window.base);
  // Between the columns of two sections, the radius differs from that at either by half its change
  // per column. If that exceeds the margin, one level serves both.
  if (0.5 * std::abs(task.slope) * parts_.min_factor < level_margin_) {
    const double a = radius_at(-0.5), b = radius_at(columns - 0.5);
    return set_whole_rows(task, {std::min(a, b), std::max(a, b)}, level_margin_);
  }
  unrolled_ = window.columns.unrolled;
  unrolled_.first = static_cast<double>(window.begin - window.base);
  unrolled_.last = columns - 1;
  if (may_draw_copies(task, unrolled_)) task.unrolled = &unrolled_;
  task.section_words = section_words(columns, columns * std::abs(task.slope));
  task.levels.clear();
  for (size_t section = 0; section <= task.sections(); ++section) {
    const auto column = static_cast<double>(section * task.section_words * bits_per_word);
    task.levels.push_back({radius_at(std::min(column, columns) - 0.5), 0});
  }
  const size_t rises = task.slope > 0;
  for (size_t section = 0; section < task.sections(); ++section) {
    task.outer[section] = section + rises;
    task.inner[section] = section + 1 - rises;
  }
  task.widest = rises ? task.sections() : 0;
}

}  // namespace msq
