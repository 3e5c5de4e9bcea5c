// SPDX-License-Identifier: Apache-2.0
#include "slice/contour_section.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/memory.h"
#include "base/simd.h"
#include "base/status.h"
#include "slice/cell_sides.h"

namespace msq {

using namespace cell_sides;

namespace {

constexpr uint32_t into_saddle = 4;

/// Where a piece of the boundary comes into a cell and leaves it, by which of its nodes are inside:
/// bits 0 to 3 are the nodes from the lowest on, counter-clockwise. Saddles have two pieces.
struct Piece {
  uint8_t in, out;
};
constexpr Piece piece_of[16] = {
    {0, 0},        {bottom, left},  {right, bottom}, {right, left}, {top, right}, {0, 0},
    {top, bottom}, {top, left},     {left, top},     {bottom, top}, {0, 0},       {right, top},
    {left, right}, {bottom, right}, {left, bottom},  {0, 0},
};
constexpr unsigned rising = 0b0101, falling = 0b1010;

/// The end of crossings that no strut has been found for.
constexpr double unknown = std::numeric_limits<double>::infinity();

}  // namespace

uint64_t ContourSection::count_crossings(const Job* job) {
  const uint32_t rows = grid_.rows();
  const size_t words = grid_.row_words();
  uint64_t sum = 0;
  const auto count = [&](auto&& edges, std::vector<uint32_t>& starts, uint32_t end) {
    starts.resize(size_t{end} * words);
    for (uint32_t r = 0; r < end; ++r) {
      if (r % 64 == 0) check_cancelled(job);
      for (size_t w = 0; w < words; ++w) {
        starts[r * words + w] = static_cast<uint32_t>(sum);
        // Most words have none, and counting is a call where the instruction is not known to exist.
        if (const uint64_t found = edges(r, w)) sum += static_cast<uint64_t>(std::popcount(found));
      }
    }
  };
  count([&](uint32_t r, size_t w) { return horizontal(r, w); }, memory_->horizontal, rows);
  const uint64_t across = sum;
  count([&](uint32_t r, size_t w) { return vertical(r, w); }, memory_->vertical, rows - 1);
  if (sum >= UINT32_MAX)
    fail(Status::limit, "the layer has %llu crossings of the grid; the limit is %u",
         static_cast<unsigned long long>(sum), UINT32_MAX - 1);
  horizontal_count_ = static_cast<uint32_t>(across);
  crossing_count_ = static_cast<uint32_t>(sum);
  return sum;
}

void ContourSection::trace(ContourPoints& points, double accuracy, const PlaneStruts* struts,
                           const ContourGrid* shape) {
  if (memory_->crossings.size() < crossing_count_) memory_->crossings.resize(crossing_count_);
  if (memory_->ends.size() <= crossing_count_) memory_->ends.resize(size_t{crossing_count_} + 1);
  link(points.job());
  locate(points, accuracy, struts, shape);
}

void ContourSection::link(const Job* job) {
  EdgeCrossing* const crossings = this->crossings();
  const uint32_t rows = grid_.rows();
  const size_t words = grid_.row_words();
  for (uint32_t r = 0; r + 1 < rows; ++r) {
    if (r % 64 == 0) check_cancelled(job);
    // Crossings of each kind come in the order of columns.
    uint32_t low = memory_->horizontal[r * words], high = memory_->horizontal[(r + 1) * words];
    uint32_t up = memory_->vertical[r * words];
    for (size_t w = 0; w < words; ++w) {
      const uint64_t below = horizontal(r, w), above = horizontal(r + 1, w);
      const uint64_t before = vertical(r, w);
      const uint64_t behind = before >> 1 | (w + 1 < words ? vertical(r, w + 1) << 63 : 0);
      const uint64_t nodes = grid_.row(r)[w];
      for (uint64_t rest = below | above | before | behind; rest; rest &= rest - 1) {
        const unsigned bit = static_cast<unsigned>(std::countr_zero(rest));
        const auto at = [bit](uint64_t edges) { return static_cast<uint32_t>(edges >> bit & 1); };
        const uint32_t b = at(below), t = at(above), l = at(before);
        const uint32_t ids[4] = {low, up + l, high, up};
        const uint32_t node = at(nodes), second = node ^ b, fourth = node ^ l, third = fourth ^ t;
        const uint32_t code = node | second << 1 | third << 2 | fourth << 3;
        if (code == rising || code == falling) {
          saddles_.push_back({static_cast<uint32_t>(w * 64 + bit),
                              r,
                              {ids[0], ids[1], ids[2], ids[3]},
                              code == rising,
                              false});
        } else {
          const Piece piece = piece_of[code];
          crossings[ids[piece.in]] = {ids[piece.out], piece.out};
        }
        low += b;
        high += t;
        up += l;
      }
    }
  }
}

void ContourSection::prefetch(uint32_t row) const {
  if (row + 1 >= grid_.rows()) return;
  constexpr uint32_t in_line = 64 / sizeof(double);
  const size_t words = grid_.row_words(), next = (size_t{row} + 1) * words;
  const auto fetch = [&](uint32_t id, uint32_t end) {
    for (; id < end; id += in_line) {
      hwy::Prefetch(memory_->crossings.data() + id);
      hwy::Prefetch(memory_->ends.data() + id);
    }
  };
  fetch(memory_->horizontal[row * words], memory_->horizontal[next]);
  fetch(memory_->vertical[row * words],
        next < memory_->vertical.size() ? memory_->vertical[next] : crossing_count_);
}

void ContourSection::settle_saddles(ContourPoints& points) {
  points.clear();
  for (const Saddle& s : saddles_)
    points.add({0.5 * (grid_.u(s.column) + grid_.u(s.column + 1)),
                0.5 * (grid_.v(s.row) + grid_.v(s.row + 1))});
  const std::vector<uint8_t>& inside = points.find_inside();
  for (size_t i = 0; i < saddles_.size(); ++i) {
    const uint32_t* ids = saddles_[i].ids;
    const auto connect = [&](uint32_t in, uint32_t out) {
      EdgeCrossing& c = crossings()[ids[in]];
      c.next = ids[out];
      c.way = out | into_saddle;
    };
    // Rising: in by bottom and top; around the nodes outside where the centre is inside.
    const bool turns_right = saddles_[i].is_rising == (inside[i] != 0);
    saddles_[i].turns_right = turns_right;
    if (saddles_[i].is_rising) {
      connect(bottom, turns_right ? right : left);
      connect(top, turns_right ? left : right);
    } else {
      connect(left, turns_right ? top : bottom);
      connect(right, turns_right ? bottom : top);
    }
  }
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
  const auto look_at = [&](auto&& edges, auto&& holds, const std::vector<uint32_t>& starts,
                           uint32_t rows, uint32_t end_id, bool is_horizontal) {
    for (uint32_t r = 0; r < rows; ++r) {
      if (r % 64 == 0) check_cancelled(job);
      const uint32_t* const first = starts.data() + r * words;
      uint32_t missed = 0;
      for (uint32_t id = first[0], end = r + 1 < rows ? first[words] : end_id; id < end; ++id)
        missed += ends[id] == unknown;
      for (size_t w = 0; w < words; ++w) {
        const uint64_t crossings = edges(r, w), beside = crossings & ~holds(r, w);
        if (missed == 0 && beside == 0) continue;
        uint32_t id = first[w];
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
  look_at([&](uint32_t r, size_t w) { return horizontal(r, w); },
          [&](uint32_t r, size_t w) {
            const uint64_t* const bits = shape.row(r);
            const uint64_t beyond = w + 1 < words ? bits[w + 1] << 63 : 0;
            return choose(grid_.row(r)[w], bits[w], bits[w] >> 1 | beyond);
          },
          memory_->horizontal, grid_.rows(), horizontal_count_, true);
  look_at([&](uint32_t r, size_t w) { return vertical(r, w); },
          [&](uint32_t r, size_t w) {
            return choose(grid_.row(r)[w], shape.row(r)[w], shape.row(r + 1)[w]);
          },
          memory_->vertical, grid_.rows() - 1, crossing_count_, false);
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
                    {grid_.row(0), grid_.row_words(), memory_->horizontal.data(),
                     memory_->vertical.data(), grid_.rows(), memory_->ends.data(), crossing_count_},
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
      kept += std::abs(s.ends[inside[n] ^ 1] - middle) > accuracy;
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
