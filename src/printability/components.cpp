// SPDX-License-Identifier: Apache-2.0
#include "printability/components.h"

#include <algorithm>
#include <bit>
#include <tuple>

#include "base/job.h"
#include "printability/bit_row.h"

namespace msq {

void ComponentTotals::add_run(uint32_t first, uint32_t last, uint32_t row) {
  samples += last - first + 1;
  low[0] = std::min(low[0], first);
  high[0] = std::max(high[0], last);
  low[1] = std::min(low[1], row);
  high[1] = std::max(high[1], row);
}

void ComponentTotals::merge(const ComponentTotals& other) {
  if (std::tuple(other.first_layer, other.place[1], other.place[0]) <
      std::tuple(first_layer, place[1], place[0])) {
    first_layer = other.first_layer;
    std::copy_n(other.place, 2, place);
  }
  last_layer = std::max(last_layer, other.last_layer);
  samples += other.samples;
  height_sum += other.height_sum;
  for (int axis = 0; axis < 2; ++axis) {
    low[axis] = std::min(low[axis], other.low[axis]);
    high[axis] = std::max(high[axis], other.high[axis]);
  }
}

Components::Components(uint64_t nx, uint64_t ny, Rules rules, Take take_ended, Take take_island)
    : nx_(nx),
      ny_(ny),
      words_(words_for(nx)),
      rules_(rules),
      take_ended_(std::move(take_ended)),
      take_island_(std::move(take_island)),
      has_anchor_(rules.anchors_sides || rules.anchors_first_layer),
      has_rest_(ny) {
  for (Mask* mask : {&known_, &known_below_, &rest_, &rest_below_}) {
    mask->bits.resize(words_ * ny);
    mask->words = words_;
  }
  runs_.begin.assign(ny + 1, 0);
  below_.begin.assign(ny + 1, 0);
}

uint32_t Components::find(uint32_t node) {
  while (parents_[node] != node) {
    parents_[node] = parents_[parents_[node]];
    node = parents_[node];
  }
  return node;
}

/// The smaller node is the root, so 0 stays one.
void Components::unite(uint32_t a, uint32_t b) {
  a = find(a);
  b = find(b);
  if (a < b) parents_[b] = a;
  if (b < a) parents_[a] = b;
}

void Components::add_layer(const uint64_t* rows, double height) {
  flood(rows);
  list_runs();
  join_layers();
  join_in_layer();
  resolve(height);
  if (!has_anchor_) {
    measure_known(height);
    adopt();
  }
  std::swap(runs_, below_);
  std::swap(live_, next_);
  std::swap(known_, known_below_);
  std::swap(rest_, rest_below_);
  ++layer_;
}

void Components::end() {
  for (const ComponentTotals& totals : live_) take_ended_(totals);
  live_.clear();
  if (known_totals_.samples) take_ended_(known_totals_);
  known_totals_ = {};
}

/// Marks the runs of a row that touch the known component below, beside or at a side.
void Components::flood_row(const uint64_t* row, uint64_t j, const uint64_t* beside) {
  uint64_t *known = known_.row(j), *rest = rest_.row(j);
  has_rest_[j] = 0;
  if (!split_row(row, known_below_.row(j), known, rest, words_)) return;
  if (rules_.anchors_sides) {
    const uint64_t last = (nx_ - 1) / bits_per_word;
    known[0] |= row[0] & 1;
    known[last] |= row[last] & (uint64_t{1} << (nx_ - 1) % bits_per_word);
  }
  if (beside && rules_.joins_corners) {
    for (size_t w = 0; w < words_; ++w)
      if (rest[w]) known[w] |= rest[w] & spread_word(beside, words_, w);
  } else if (beside) {
    for (size_t w = 0; w < words_; ++w) known[w] |= rest[w] & beside[w];
  }
  has_rest_[j] = fill_runs(row, words_, known, rest);
}

/// Finds most of what the known component has in this layer: row by row upwards and downwards.
/// Spirals are left to join_in_layer().
void Components::flood(const uint64_t* rows) {
  if (layer_ == 0 && rules_.anchors_first_layer) {
    std::copy_n(rows, words_ * ny_, known_.bits.data());
    std::fill(has_rest_.begin(), has_rest_.end(), uint8_t{0});
    return;
  }
  CancelPoll poll(current_job());
  for (uint64_t j = 0; j < ny_; ++j) {
    poll();
    const uint64_t* row = rows + j * words_;
    if (rules_.anchors_sides && (j == 0 || j + 1 == ny_)) {
      std::copy_n(row, words_, known_.row(j));
      has_rest_[j] = 0;
      continue;
    }
    flood_row(row, j, j > 0 ? known_.row(j - 1) : nullptr);
  }
  for (uint64_t j = ny_ - 1; j-- > 0;) {
    if (!has_rest_[j]) continue;
    const uint64_t* beside = known_.row(j + 1);
    uint64_t *known = known_.row(j), *rest = rest_.row(j);
    uint64_t found = 0;
    for (size_t w = 0; w < words_; ++w) {
      const uint64_t more =
          rest[w] & (rules_.joins_corners ? spread_word(beside, words_, w) : beside[w]);
      known[w] |= more;
      found |= more;
    }
    if (found) has_rest_[j] = fill_runs(rows + j * words_, words_, known, rest);
  }
}

/// The runs that are not known, each a node.
void Components::list_runs() {
  runs_.runs.clear();
  CancelPoll poll(current_job());
  for (uint64_t j = 0; j < ny_; ++j) {
    poll();
    runs_.begin[j] = runs_.runs.size();
    if (!has_rest_[j]) continue;
    for_each_run(rest_.row(j), words_, [&](uint64_t first, uint64_t last) {
      runs_.runs.push_back({static_cast<uint32_t>(first), static_cast<uint32_t>(last), 0});
    });
  }
  runs_.begin[ny_] = runs_.runs.size();
  const size_t nodes = 1 + live_.size() + runs_.runs.size();
  if (nodes > UINT32_MAX)
    fail(Status::limit, "layer %llu has %zu runs of samples to label; the limit is 2^32 - 1",
         static_cast<unsigned long long>(layer_), nodes);
  parents_.resize(nodes);
  for (size_t i = 0; i < nodes; ++i) parents_[i] = static_cast<uint32_t>(i);
}

namespace {

/// Calls join(a, b) for the pairs of runs of two rows, in [a, a_end) and [b, b_end), that overlap
/// or, with a reach of 1, are next to each other, if must_join(a, b).
template <class Run, class Must, class Join>
void for_each_overlap(const std::vector<Run>& of_a, size_t a, size_t a_end,
                      const std::vector<Run>& of_b, size_t b, size_t b_end, uint32_t reach,
                      Must&& must_join, Join&& join) {
  while (a < a_end && b < b_end) {
    const Run &x = of_a[a], &y = of_b[b];
    // One branch, which is easily predicted where most pairs are joined already.
    const bool overlaps = (x.first <= y.last + reach) & (y.first <= x.last + reach);
    if (overlaps & must_join(a, b)) join(a, b);
    const size_t is_a_next = x.last < y.last;
    a += is_a_next;
    b += 1 - is_a_next;
  }
}

}  // namespace

/// A run's first component below becomes its parent at once. So runs of one component mostly have
/// the same parent, and join_in_layer() has little to do.
void Components::join_layers() {
  const auto base = static_cast<uint32_t>(1 + live_.size());
  for (uint64_t j = 0; j < ny_; ++j) {
    const size_t begin = below_.begin[j], end = below_.begin[j + 1];
    if (begin == end) continue;
    for_each_overlap(
        runs_.runs, runs_.begin[j], runs_.begin[j + 1], below_.runs, begin, end, 0,
        [&](size_t a, size_t b) { return parents_[base + a] != below_.runs[b].component; },
        [&](size_t a, size_t b) {
          const uint32_t node = base + static_cast<uint32_t>(a),
                         component = below_.runs[b].component;
          if (parents_[node] == node)
            parents_[node] = find(component);
          else
            unite(node, component);
        });
    const uint64_t *known = known_.row(j), *rest = rest_below_.row(j);
    uint64_t any = 0;
    for (size_t w = 0; w < words_; ++w) any |= known[w] & rest[w];
    if (!any) continue;
    for (size_t r = begin; r < end; ++r) {
      const Run& run = below_.runs[r];
      if (any_bit(known, run.first, run.last)) unite(0, run.component);
    }
  }
}

/// Whether a run of the row that is not known touches a known one in the rows beside it.
bool Components::touches_known(uint64_t j) const {
  const uint64_t* rest = rest_.row(j);
  const uint64_t* beside[2] = {j > 0 ? known_.row(j - 1) : nullptr,
                               j + 1 < ny_ ? known_.row(j + 1) : nullptr};
  uint64_t any = 0;
  for (const uint64_t* row : beside) {
    if (!row) continue;
    for (size_t w = 0; w < words_; ++w)
      any |= rest[w] & (rules_.joins_corners ? spread_word(row, words_, w) : row[w]);
  }
  return any != 0;
}

void Components::join_in_layer() {
  const auto base = static_cast<uint32_t>(1 + live_.size());
  const uint32_t reach = rules_.joins_corners ? 1 : 0;
  const auto touches = [&](const Run& run, uint64_t row) {
    const uint64_t first = run.first >= reach ? run.first - reach : 0;
    return any_bit(known_.row(row), first, std::min<uint64_t>(run.last + reach, nx_ - 1));
  };
  for (uint64_t j = 0; j < ny_; ++j) {
    const size_t begin = runs_.begin[j], end = runs_.begin[j + 1];
    if (begin == end) continue;
    if (j > 0)
      for_each_overlap(
          runs_.runs, runs_.begin[j - 1], begin, runs_.runs, begin, end, reach,
          [&](size_t a, size_t b) { return parents_[base + a] != parents_[base + b]; },
          [&](size_t a, size_t b) {
            const uint32_t low = base + static_cast<uint32_t>(a),
                           node = base + static_cast<uint32_t>(b);
            if (parents_[node] == node)
              parents_[node] = find(low);
            else
              unite(low, node);
          });
    if (!touches_known(j)) continue;
    for (size_t r = begin; r < end; ++r) {
      const Run& run = runs_.runs[r];
      if ((j > 0 && touches(run, j - 1)) || (j + 1 < ny_ && touches(run, j + 1)))
        unite(0, base + static_cast<uint32_t>(r));
    }
  }
}

/// Numbers the components that have runs in this layer, and takes those that have none.
void Components::resolve(double height) {
  const auto base = static_cast<uint32_t>(1 + live_.size());
  numbers_.assign(parents_.size(), 0);
  next_.clear();
  bool has_known_runs = false;
  for (uint64_t j = 0; j < ny_; ++j)
    for (size_t r = runs_.begin[j]; r < runs_.begin[j + 1]; ++r) {
      Run& run = runs_.runs[r];
      const uint32_t root = find(base + static_cast<uint32_t>(r));
      if (root == 0) {
        set_bits(known_.row(j), run.first, run.last);
        has_known_runs = true;
        continue;  // its component is 0
      }
      const auto row = static_cast<uint32_t>(j);
      if (numbers_[root] == 0) {
        ComponentTotals& totals = next_.emplace_back();
        totals.first_layer = totals.last_layer = layer_;
        totals.place[0] = run.first;
        totals.place[1] = row;
        numbers_[root] = static_cast<uint32_t>(next_.size());
      }
      run.component = numbers_[root];
      next_[run.component - 1].add_run(run.first, run.last, row);
    }
  if (has_known_runs) remove_known_runs();
  for (ComponentTotals& totals : next_)
    totals.height_sum = static_cast<double>(totals.samples) * height;
  // A root is the smallest node, so a component whose root is a run has nothing below.
  if (rules_.finds_islands && layer_ > 0)
    for (size_t root = base; root < parents_.size(); ++root)
      if (numbers_[root]) take_island_(next_[numbers_[root] - 1]);
  for (uint32_t c = 1; c < base; ++c) {
    const ComponentTotals& totals = live_[c - 1];
    const uint32_t root = find(c);
    if (root == 0) {
      if (!has_anchor_) known_totals_.merge(totals);
    } else if (numbers_[root]) {
      next_[numbers_[root] - 1].merge(totals);
    } else {
      take_ended_(totals);
    }
  }
}

/// Runs of component 0.
void Components::remove_known_runs() {
  size_t kept = 0;
  for (uint64_t j = 0; j < ny_; ++j) {
    const size_t begin = runs_.begin[j], end = runs_.begin[j + 1];
    runs_.begin[j] = kept;
    if (begin == end) continue;
    for (size_t r = begin; r < end; ++r)
      if (runs_.runs[r].component) runs_.runs[kept++] = runs_.runs[r];
    for (size_t w = 0; w < words_; ++w) rest_.row(j)[w] &= ~known_.row(j)[w];
  }
  runs_.begin[ny_] = kept;
  runs_.runs.resize(kept);
}

/// Adds what the known component has in this layer to its totals; takes it where that is nothing.
void Components::measure_known(double height) {
  if (!known_totals_.samples) return;
  ComponentTotals here;
  for (uint64_t j = 0; j < ny_; ++j) {
    const uint64_t* row = known_.row(j);
    size_t first = 0, last = words_;
    while (first < words_ && !row[first]) ++first;
    if (first == words_) continue;
    while (!row[last - 1]) --last;
    for (size_t w = first; w < last; ++w)
      here.samples += static_cast<uint64_t>(std::popcount(row[w]));
    const uint64_t low =
        first * bits_per_word + static_cast<uint64_t>(std::countr_zero(row[first]));
    const uint64_t high =
        last * bits_per_word - 1 - static_cast<uint64_t>(std::countl_zero(row[last - 1]));
    here.low[0] = std::min(here.low[0], static_cast<uint32_t>(low));
    here.high[0] = std::max(here.high[0], static_cast<uint32_t>(high));
    here.low[1] = std::min(here.low[1], static_cast<uint32_t>(j));
    here.high[1] = static_cast<uint32_t>(j);
  }
  if (here.samples == 0) {
    take_ended_(known_totals_);
    known_totals_ = {};
    return;
  }
  here.first_layer = UINT64_MAX;  // it began below
  here.last_layer = layer_;
  here.height_sum = static_cast<double>(here.samples) * height;
  known_totals_.merge(here);
}

/// If no component is known, makes the largest one known. Results do not depend on which.
void Components::adopt() {
  if (known_totals_.samples || next_.empty()) return;
  const auto largest = std::max_element(
      next_.begin(), next_.end(),
      [](const ComponentTotals& a, const ComponentTotals& b) { return a.samples < b.samples; });
  const auto number = static_cast<uint32_t>(largest - next_.begin()) + 1;
  known_totals_ = *largest;
  const auto moved = static_cast<uint32_t>(next_.size());  // takes the free number
  *largest = next_.back();
  next_.pop_back();
  for (uint64_t j = 0; j < ny_; ++j)
    for (size_t r = runs_.begin[j]; r < runs_.begin[j + 1]; ++r) {
      Run& run = runs_.runs[r];
      if (run.component == number) {
        set_bits(known_.row(j), run.first, run.last);
        run.component = 0;
      } else if (run.component == moved) {
        run.component = number;
      }
    }
  remove_known_runs();
}

}  // namespace msq
