// SPDX-License-Identifier: Apache-2.0
#include "slice/contour_section.h"

#include <cmath>
#include <limits>
#include <optional>

#include "base/status.h"

namespace msq {

namespace {

constexpr uint32_t bottom = 0, right = 1, top = 2, left = 3;
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

/// Crossings that no strut has been found for.
constexpr double unknown = std::numeric_limits<double>::infinity();
/// By the side of the cell that the boundary comes in by. With the inside on its left, it comes up
/// and from the right where the first node of the edge is inside: then struts leave the edge.
constexpr double unknown_of[4] = {-unknown, -unknown, unknown, unknown};

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
  count([&](uint32_t r, size_t w) { return horizontal(r, w); }, horizontal_, rows);
  const uint64_t across = sum;
  count([&](uint32_t r, size_t w) { return vertical(r, w); }, vertical_, rows - 1);
  if (sum >= UINT32_MAX)
    fail(Status::limit, "the layer has %llu crossings of the grid; the limit is %u",
         static_cast<unsigned long long>(sum), UINT32_MAX - 1);
  horizontal_count_ = static_cast<uint32_t>(across);
  crossing_count_ = static_cast<uint32_t>(sum);
  return sum;
}

void ContourSection::trace(ContourPoints& points, double accuracy, double around) {
  if (crossings_->size() < crossing_count_) crossings_->resize(crossing_count_);
  link(points.job());
  locate(points, accuracy, around);
}

void ContourSection::link(const Job* job) {
  EdgeCrossing* const crossings = this->crossings();
  const uint32_t rows = grid_.rows();
  const size_t words = grid_.row_words();
  for (uint32_t r = 0; r + 1 < rows; ++r) {
    if (r % 64 == 0) check_cancelled(job);
    // Crossings of each kind come in the order of columns.
    uint32_t low = horizontal_[r * words], high = horizontal_[(r + 1) * words];
    uint32_t up = vertical_[r * words];
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
                              code == rising});
        } else {
          const Piece piece = piece_of[code];
          crossings[ids[piece.in]] = {unknown_of[piece.in], ids[piece.out], piece.out};
        }
        low += b;
        high += t;
        up += l;
      }
    }
  }
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
    if (saddles_[i].is_rising) {
      connect(bottom, turns_right ? right : left);
      connect(top, turns_right ? left : right);
    } else {
      connect(left, turns_right ? top : bottom);
      connect(right, turns_right ? bottom : top);
    }
  }
}

void ContourSection::count_unseen(ContourPoints& points) {
  const std::vector<PlaneStruts::Unseen> unseen = struts_->find_unseen(grid_, points.job());
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

void ContourSection::locate(ContourPoints& points, double accuracy, double around) {
  for (const Saddle& s : saddles_)
    for (const uint32_t in : {s.is_rising ? bottom : left, s.is_rising ? top : right})
      crossings()[s.ids[in]].at = unknown_of[in];

  // Struts give their ends. On edges that the shape ends on, membership tells.
  const Scales& resolved = points.resolved();
  std::optional<ContourGrid> shape;
  // Of cells smaller than that few are asked about.
  const auto has_large_cells = [&](const Structure& s) {
    return s.cell_length() >= 2 * grid_.pitch();
  };
  if (resolved.size() == 1 && resolved[0]->skin.is_none() && resolved[0]->structure->has_struts() &&
      has_large_cells(*resolved[0]->structure)) {
    struts_ = std::make_unique<PlaneStruts>(*resolved[0]->structure, grid_, around,
                                            points.model().context().budget, points.job());
    points.use_struts(*struts_);
    struts_->propose(
        grid_, {grid_.row(0), grid_.row_words(), horizontal_.data(), vertical_.data(), crossings()},
        points.job());
    count_unseen(points);
    shape.emplace(grid_);
    shape->find_nodes(points.model(), {}, points.job());
  }
  settle_saddles(points);

  constexpr size_t at_once = size_t{1} << 16;
  std::vector<Edge> open;
  const auto take = [&](uint32_t id, uint32_t column, uint32_t row, bool is_horizontal) {
    EdgeCrossing& c = crossings()[id];
    if (grid_.is_beyond(is_horizontal, column, row)) {
      c.at = is_horizontal ? grid_.u(column) : grid_.v(row);
      return;
    }
    // The node outside.
    const bool is_second = grid_.inside(column, row);
    if (std::isfinite(c.at) &&
        shape->inside(column + (is_second && is_horizontal), row + (is_second && !is_horizontal))) {
      const double low = is_horizontal ? grid_.u(column) : grid_.v(row);
      const double high = is_horizontal ? grid_.u(column + 1) : grid_.v(row + 1);
      c.at = std::clamp(c.at, low + margin_, high - margin_);
      return;
    }
    open.push_back({id, column, row, is_horizontal});
    if (open.size() == at_once) {
      locate_some(points, open, accuracy);
      open.clear();
    }
  };
  const auto take_all = [&](auto&& edges, uint32_t id, uint32_t end, bool is_horizontal) {
    for (uint32_t r = 0; r < end; ++r) {
      if (r % 64 == 0) check_cancelled(points.job());
      for (size_t w = 0; w < grid_.row_words(); ++w)
        for (uint64_t rest = edges(r, w); rest; rest &= rest - 1)
          take(id++, static_cast<uint32_t>(w * 64) + static_cast<uint32_t>(std::countr_zero(rest)),
               r, is_horizontal);
    }
  };
  take_all([&](uint32_t r, size_t w) { return horizontal(r, w); }, 0, grid_.rows(), true);
  take_all([&](uint32_t r, size_t w) { return vertical(r, w); }, horizontal_count_,
           grid_.rows() - 1, false);
  locate_some(points, open, accuracy);
}

void ContourSection::locate_some(ContourPoints& points, const std::vector<Edge>& edges,
                                 double accuracy) {
  struct Ends {
    double inside, outside;
  };
  std::vector<Ends> ends(edges.size());
  std::vector<uint32_t> open;
  const auto low = [&](const Edge& e) {
    return e.is_horizontal ? grid_.u(e.column) : grid_.v(e.row);
  };
  const auto high = [&](const Edge& e) {
    return e.is_horizontal ? grid_.u(e.column + 1) : grid_.v(e.row + 1);
  };
  const auto along = [&](const Edge& e, double at) {
    return e.is_horizontal ? Vec2{at, grid_.v(e.row)} : Vec2{grid_.u(e.column), at};
  };
  for (size_t i = 0; i < edges.size(); ++i) {
    const double a = low(edges[i]), b = high(edges[i]);
    ends[i] = grid_.inside(edges[i].column, edges[i].row) ? Ends{a, b} : Ends{b, a};
    open.push_back(static_cast<uint32_t>(i));
  }
  while (!open.empty()) {
    points.clear();
    for (const uint32_t i : open)
      points.add(along(edges[i], 0.5 * (ends[i].inside + ends[i].outside)));
    const std::vector<uint8_t>& inside = points.find_inside();
    size_t kept = 0;
    for (size_t n = 0; n < open.size(); ++n) {
      Ends& e = ends[open[n]];
      (inside[n] ? e.inside : e.outside) = 0.5 * (e.inside + e.outside);
      if (std::abs(e.outside - e.inside) > accuracy) open[kept++] = open[n];
    }
    open.resize(kept);
  }
  for (size_t i = 0; i < edges.size(); ++i)
    crossings()[edges[i].id].at = std::clamp(0.5 * (ends[i].inside + ends[i].outside),
                                             low(edges[i]) + margin_, high(edges[i]) - margin_);
}

}  // namespace msq
