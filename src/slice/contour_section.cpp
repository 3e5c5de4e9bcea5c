// SPDX-License-Identifier: Apache-2.0
#include "slice/contour_section.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/memory.h"
#include "base/simd.h"
#include "base/status.h"

namespace msq {

namespace {

/// The end of crossings that no strut has been found for.
constexpr double unknown = std::numeric_limits<double>::infinity();

}  // namespace

uint64_t ContourSection::count_crossings(const Job* job) {
  const uint32_t rows = grid_.rows();
  const size_t words = grid_.row_words();
  uint64_t sum = 0;
  memory_->edges.resize(2 * edge_words());
  EdgeWord* out = memory_->edges.data();
  const auto count = [&](auto&& edges, uint32_t end) {
    for (uint32_t r = 0; r <= rows; ++r) {
      if (r % 64 == 0) check_cancelled(job);
      for (size_t w = 0; w < words; ++w) {
        const uint64_t found = r < end ? edges(r, w) : 0;
        *out++ = {found, static_cast<uint32_t>(sum)};
        // Most words have none, and counting is a call where the instruction is not known to exist.
        if (found) sum += static_cast<uint64_t>(std::popcount(found));
      }
    }
  };
  count([&](uint32_t r, size_t w) { return horizontal(r, w); }, rows);
  const uint64_t across = sum;
  count([&](uint32_t r, size_t w) { return vertical(r, w); }, rows - 1);
  if (sum >= UINT32_MAX)
    fail(Status::limit, "the layer has %llu crossings of the grid; the limit is %u",
         static_cast<unsigned long long>(sum), UINT32_MAX - 1);
  horizontal_count_ = static_cast<uint32_t>(across);
  crossing_count_ = static_cast<uint32_t>(sum);
  return sum;
}

void ContourSection::trace(ContourPoints& points, double accuracy, const PlaneStruts* struts,
                           const ContourGrid* shape) {
  if (memory_->rings.size() <= horizontal_count_)
    memory_->rings.resize(size_t{horizontal_count_} + 1);
  std::fill_n(memory_->rings.begin(), horizontal_count_, no_ring);
  if (memory_->ends.size() <= crossing_count_) memory_->ends.resize(size_t{crossing_count_} + 1);
  find_saddles(points.job());
  locate(points, accuracy, struts, shape);
}

void ContourSection::find_saddles(const Job* job) {
  const uint32_t rows = grid_.rows();
  const size_t words = grid_.row_words();
  saddle_rows_.clear();
  for (uint32_t r = 0; r + 1 < rows; ++r) {
    if (r % 64 == 0) check_cancelled(job);
    saddle_rows_.push_back(static_cast<uint32_t>(saddles_.size()));
    const uint64_t *const low = grid_.row(r), *const high = grid_.row(r + 1);
    for (size_t w = 0; w < words; ++w) {
      const auto next = [&](const uint64_t* row) {
        return row[w] >> 1 | (w + 1 < words ? row[w + 1] << 63 : 0);
      };
      const uint64_t low_left = low[w], high_left = high[w];
      const uint64_t low_right = next(low), high_right = next(high);
      const uint64_t rising = low_left & high_right & ~(low_right | high_left);
      const uint64_t falling = low_right & high_left & ~(low_left | high_right);
      for (uint64_t rest = rising | falling; rest; rest &= rest - 1) {
        const unsigned bit = static_cast<unsigned>(std::countr_zero(rest));
        saddles_.push_back(
            {static_cast<uint32_t>(w * 64 + bit), r, (rising >> bit & 1) != 0, false});
      }
    }
  }
  saddle_rows_.push_back(static_cast<uint32_t>(saddles_.size()));
}

const ContourSection::Saddle& ContourSection::saddle_at(uint32_t column, uint32_t row) const {
  return *std::lower_bound(saddles_.begin() + saddle_rows_[row],
                           saddles_.begin() + saddle_rows_[row + 1], column,
                           [](const Saddle& s, uint32_t c) { return s.column < c; });
}

void ContourSection::prefetch(uint32_t row) const {
  if (row >= grid_.rows()) return;
  const size_t words = grid_.row_words(), first = size_t{row} * words;
  const auto fetch = [](const auto* begin, const auto* end) {
    prefetch_all(begin, static_cast<size_t>(end - begin) * sizeof *begin);
  };
  fetch(grid_.row(row), grid_.row(row) + words);
  for (const EdgeWord* edges : {horizontal_edges(), vertical_edges()}) {
    fetch(edges + first, edges + first + words);
    fetch(ends() + edges[first].first, ends() + edges[first + words].first);
  }
  const uint32_t* const rings = memory_->rings.data();
  fetch(rings + horizontal_edges()[first].first, rings + horizontal_edges()[first + words].first);
}

void ContourSection::settle_saddles(ContourPoints& points) {
  points.clear();
  for (const Saddle& s : saddles_)
    points.add({0.5 * (grid_.u(s.column) + grid_.u(s.column + 1)),
                0.5 * (grid_.v(s.row) + grid_.v(s.row + 1))});
  const std::vector<uint8_t>& inside = points.find_inside();
  // Around the nodes outside where the centre is inside.
  for (size_t i = 0; i < saddles_.size(); ++i)
    saddles_[i].turns_right = saddles_[i].is_rising == (inside[i] != 0);
}

void ContourSection::count_unseen(const PlaneStruts& struts, ContourPoints& points) {
  const std::vector<PlaneStruts::Unseen> unseen = struts.find_unseen(grid_, points.job());
  points.clear();
  for (const PlaneStruts::Unseen& u : unseen) points.add(u.at);
  const std::vector<uint8_t>& inside = points.find_inside();
  const PlaneStruts::Unseen* last = nullptr;
  for (size_t i = 0; i < unseen.size(); ++i) {
    if (!inside[i] || (last && last->column == unseen[i].column && last->row == unseen[i].row))
      continue;
    last = &unseen[i];
    ++unseen_;
  }
}

/// Calls take(id, column, row, is_horizontal) for the crossings that struts do not give: those that
/// they missed, and those where the node outside is outside the shape, too.
template <class Take>
void ContourSection::for_open_edges(const ContourGrid& shape, const Job* job, Take&& take) const {
  const double* const ends = this->ends();
  const size_t words = grid_.row_words();
  const auto look_at = [&](const EdgeWord* edges, auto&& holds, uint32_t rows, bool is_horizontal) {
    for (uint32_t r = 0; r < rows; ++r, edges += words) {
      if (r % 64 == 0) check_cancelled(job);
      uint32_t missed = 0;
      for (uint32_t id = edges[0].first; id < edges[words].first; ++id)
        missed += ends[id] == unknown;
      for (size_t w = 0; w < words; ++w) {
        const uint64_t crossings = edges[w].bits, beside = crossings & ~holds(r, w);
        if (missed == 0 && beside == 0) continue;
        uint32_t id = edges[w].first;
        for (uint64_t rest = crossings; rest; rest &= rest - 1, ++id) {
          const unsigned bit = static_cast<unsigned>(std::countr_zero(rest));
          if (ends[id] == unknown || (beside >> bit & 1))
            take(id, static_cast<uint32_t>(w * 64) + bit, r, is_horizontal);
        }
      }
    }
  };
  // Whether the shape holds the node outside of an edge, as bits of edges: the first node, or the
  // second one where the first is inside.
  const auto choose = [&](uint64_t nodes, uint64_t first, uint64_t second) {
    return (nodes & second) | (~nodes & first);
  };
  look_at(
      horizontal_edges(),
      [&](uint32_t r, size_t w) {
        const uint64_t* const bits = shape.row(r);
        const uint64_t beyond = w + 1 < words ? bits[w + 1] << 63 : 0;
        return choose(grid_.row(r)[w], bits[w], bits[w] >> 1 | beyond);
      },
      grid_.rows(), true);
  look_at(
      vertical_edges(),
      [&](uint32_t r, size_t w) {
        return choose(grid_.row(r)[w], shape.row(r)[w], shape.row(r + 1)[w]);
      },
      grid_.rows() - 1, false);
}

void ContourSection::locate(ContourPoints& points, double accuracy, const PlaneStruts* struts,
                            const ContourGrid* shape) {
  constexpr size_t at_once = size_t{1} << 16;
  std::vector<Edge> open;
  const auto take = [&](uint32_t id, uint32_t column, uint32_t row, bool is_horizontal) {
    if (grid_.is_beyond(is_horizontal, column, row)) return;
    open.push_back({id, column, row, is_horizontal});
    if (open.size() == at_once) {
      locate_some(points, open, accuracy);
      open.clear();
    }
  };
  // Struts give their ends. On edges that the shape ends on, membership tells.
  if (struts) {
    struts->propose(grid_,
                    {grid_.row(0), grid_.row_words(), horizontal_edges(), vertical_edges(),
                     grid_.rows(), memory_->ends.data(), crossing_count_},
                    points.job());
    count_unseen(*struts, points);
    settle_saddles(points);
    for_open_edges(*shape, points.job(), take);
  } else {
    settle_saddles(points);
    const auto take_all = [&](auto&& edges, uint32_t id, uint32_t end, bool is_horizontal) {
      for (uint32_t r = 0; r < end; ++r) {
        if (r % 64 == 0) check_cancelled(points.job());
        for (size_t w = 0; w < grid_.row_words(); ++w)
          for (uint64_t rest = edges(r, w); rest; rest &= rest - 1)
            take(id++,
                 static_cast<uint32_t>(w * 64) + static_cast<uint32_t>(std::countr_zero(rest)), r,
                 is_horizontal);
      }
    };
    take_all([&](uint32_t r, size_t w) { return horizontal(r, w); }, 0, grid_.rows(), true);
    take_all([&](uint32_t r, size_t w) { return vertical(r, w); }, horizontal_count_,
             grid_.rows() - 1, false);
  }
  locate_some(points, open, accuracy);
}

void ContourSection::locate_some(ContourPoints& points, const std::vector<Edge>& edges,
                                 double accuracy) {
  struct Search {
    double ends[2];  // outside and inside
    double line;     // of the edge: v where it is horizontal, else u
    bool is_horizontal;
    double middle() const { return 0.5 * (ends[0] + ends[1]); }
  };
  constexpr uint64_t bytes_of_edge =
      sizeof(Edge) + sizeof(Search) + sizeof(uint32_t) + ContourPoints::bytes_of_point;
  const Reservation held(points.model().context().budget, edges.size() * bytes_of_edge,
                         "the crossings that are looked for together");
  std::vector<Search> searches(edges.size());
  std::vector<uint32_t> open(edges.size());
  const auto low = [&](const Edge& e) {
    return e.is_horizontal ? grid_.u(e.column) : grid_.v(e.row);
  };
  const auto high = [&](const Edge& e) {
    return e.is_horizontal ? grid_.u(e.column + 1) : grid_.v(e.row + 1);
  };
  for (size_t i = 0; i < edges.size(); ++i) {
    const Edge& e = edges[i];
    const bool starts_inside = grid_.inside(e.column, e.row);
    Search& s = searches[i];
    s.ends[starts_inside] = low(e);
    s.ends[!starts_inside] = high(e);
    s.line = e.is_horizontal ? grid_.v(e.row) : grid_.u(e.column);
    s.is_horizontal = e.is_horizontal;
    open[i] = static_cast<uint32_t>(i);
  }
  while (!open.empty()) {
    points.clear();
    for (const uint32_t i : open) {
      const Search& s = searches[i];
      const double at = s.middle();
      // Not one point or the other: what is stored by halves and then loaded whole takes long.
      if (s.is_horizontal)
        points.add({at, s.line});
      else
        points.add({s.line, at});
    }
    const std::vector<uint8_t>& inside = points.find_inside();
    size_t kept = 0;
    for (size_t n = 0; n < open.size(); ++n) {
      // By index: a branch would be predicted wrongly half the time.
      Search& s = searches[open[n]];
      const double middle = s.middle();
      open[kept] = open[n];
      // Not if there is no number between the ends, however small the accuracy is.
      const size_t is_coarse = std::abs(s.ends[inside[n] ^ 1] - middle) > accuracy;
      const size_t is_between = s.ends[inside[n]] != middle;
      kept += is_coarse & is_between;
      s.ends[inside[n]] = middle;
    }
    open.resize(kept);
  }
  for (size_t i = 0; i < edges.size(); ++i) {
    const double at =
        std::clamp(searches[i].middle(), low(edges[i]) + margin_, high(edges[i]) - margin_);
    memory_->ends[edges[i].id] = grid_.inside(edges[i].column, edges[i].row) ? -at : at;
  }
}

}  // namespace msq
