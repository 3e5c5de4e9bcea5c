// SPDX-License-Identifier: Apache-2.0
#include "slice/contour_section.h"

#include <bit>
#include <cmath>
#include <limits>
#include <memory>

#include "base/status.h"

namespace msq {

namespace {

enum Side : uint8_t { bottom, right, top, left };

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

}  // namespace

void ContourSection::trace(ContourPoints& points, double accuracy) {
  crossings_.resize(vertical_start_.back());
  next_.resize(crossings_.size());
  list_crossings(points.job());
  link(points.job());
  settle_saddles(points);
  locate(points, accuracy);
  place();
}

void ContourSection::place() {
  places_.resize(crossings_.size());
  for (uint32_t id = 0; id < count(); ++id) {
    const Crossing& c = crossings_[id];
    places_[id] = is_horizontal(id) ? Vec2{c.at, grid_.v(c.row)} : Vec2{grid_.u(c.column), c.at};
  }
}

uint64_t ContourSection::count_crossings(const Job* job) {
  const uint32_t rows = grid_.rows();
  const size_t words = grid_.row_words();
  uint64_t across = 0, up = 0;
  const auto count = [&](auto&& edges, uint64_t& sum, std::vector<uint32_t>& starts, uint32_t end) {
    starts.assign(rows + 1, 0);
    for (uint32_t r = 0; r < rows; ++r) {
      if (r % 64 == 0) check_cancelled(job);
      starts[r] = static_cast<uint32_t>(sum);
      for (size_t w = 0; r < end && w < words; ++w)
        sum += static_cast<uint64_t>(std::popcount(edges(r, w)));
    }
    starts[rows] = static_cast<uint32_t>(sum);
  };
  count([&](uint32_t r, size_t w) { return horizontal(r, w); }, across, horizontal_start_, rows);
  up = across;
  count([&](uint32_t r, size_t w) { return vertical(r, w); }, up, vertical_start_, rows - 1);
  if (up >= UINT32_MAX)
    fail(Status::limit, "the layer has %llu crossings of the grid; the limit is %u",
         static_cast<unsigned long long>(up), UINT32_MAX - 1);
  horizontal_count_ = static_cast<uint32_t>(across);
  return up;
}

void ContourSection::list_crossings(const Job* job) {
  const uint32_t rows = grid_.rows();
  const size_t words = grid_.row_words();
  const auto list = [&](auto&& edges, uint32_t id, uint32_t end) {
    for (uint32_t r = 0; r < end; ++r) {
      if (r % 64 == 0) check_cancelled(job);
      for (size_t w = 0; w < words; ++w)
        for (uint64_t rest = edges(r, w); rest; rest &= rest - 1) {
          const unsigned bit = static_cast<unsigned>(std::countr_zero(rest));
          crossings_[id++] = {static_cast<uint32_t>(w * 64 + bit), r, 0};
        }
    }
  };
  list([&](uint32_t r, size_t w) { return horizontal(r, w); }, 0, rows);
  list([&](uint32_t r, size_t w) { return vertical(r, w); }, horizontal_count_, rows - 1);
}

void ContourSection::link(const Job* job) {
  const uint32_t rows = grid_.rows();
  const size_t words = grid_.row_words();
  for (uint32_t r = 0; r + 1 < rows; ++r) {
    if (r % 64 == 0) check_cancelled(job);
    // Crossings of each kind come in the order of columns.
    uint32_t low = horizontal_start_[r], high = horizontal_start_[r + 1], up = vertical_start_[r];
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
          next_[ids[piece.in]] = ids[piece.out];
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
    // Rising: in by bottom and top; around the nodes outside where the centre is inside.
    const bool turns_right = saddles_[i].is_rising == (inside[i] != 0);
    if (saddles_[i].is_rising) {
      next_[ids[bottom]] = ids[turns_right ? right : left];
      next_[ids[top]] = ids[turns_right ? left : right];
    } else {
      next_[ids[left]] = ids[turns_right ? top : bottom];
      next_[ids[right]] = ids[turns_right ? bottom : top];
    }
  }
}

void ContourSection::locate(ContourPoints& points, double accuracy) {
  constexpr size_t at_once = size_t{1} << 16;
  constexpr double unknown = std::numeric_limits<double>::infinity();
  for (uint32_t id = 0; id < count(); ++id)
    crossings_[id].at = is_beyond(id) ? low(id) : starts_inside(id) ? -unknown : unknown;

  // Struts give their ends. On edges that the shape ends on, membership tells.
  const Scales& resolved = points.resolved();
  std::unique_ptr<ContourGrid> shape;
  // Of cells smaller than that few are asked about.
  const auto has_large_cells = [&](const Structure& s) {
    return s.cell_length() >= 2 * grid_.pitch();
  };
  if (resolved.size() == 1 && resolved[0]->skin.is_none() && resolved[0]->structure->has_struts() &&
      has_large_cells(*resolved[0]->structure)) {
    locate_by_struts(points, *resolved[0]->structure);
    shape = std::make_unique<ContourGrid>(grid_);
    shape->find_nodes(points.model(), {}, points.job());
  }
  std::vector<uint32_t> ids;
  const auto flush = [&] {
    locate_some(points, ids.data(), ids.size(), accuracy);
    ids.clear();
  };
  for (uint32_t id = 0; id < count(); ++id) {
    Crossing& c = crossings_[id];
    if (is_beyond(id)) continue;
    if (std::isfinite(c.at)) {
      const bool is_second = starts_inside(id);  // the node outside
      const uint32_t column = c.column + (is_second && is_horizontal(id));
      const uint32_t row = c.row + (is_second && !is_horizontal(id));
      if (shape->inside(column, row)) {
        c.at = std::clamp(c.at, low(id) + margin_, high(id) - margin_);
        continue;
      }
    }
    ids.push_back(id);
    if (ids.size() == at_once) flush();
  }
  flush();
}

void ContourSection::locate_some(ContourPoints& points, const uint32_t* ids, size_t count,
                                 double accuracy) {
  struct Ends {
    double inside, outside;
  };
  std::vector<Ends> ends(count);
  std::vector<uint32_t> open;
  const auto along = [&](uint32_t id, double at) {
    const Crossing& c = crossings_[id];
    return is_horizontal(id) ? Vec2{at, grid_.v(c.row)} : Vec2{grid_.u(c.column), at};
  };
  for (size_t i = 0; i < count; ++i) {
    const double a = low(ids[i]), b = high(ids[i]);
    ends[i] = starts_inside(ids[i]) ? Ends{a, b} : Ends{b, a};
    open.push_back(static_cast<uint32_t>(i));
  }
  while (!open.empty()) {
    points.clear();
    for (const uint32_t i : open)
      points.add(along(ids[i], 0.5 * (ends[i].inside + ends[i].outside)));
    const std::vector<uint8_t>& inside = points.find_inside();
    size_t kept = 0;
    for (size_t n = 0; n < open.size(); ++n) {
      Ends& e = ends[open[n]];
      (inside[n] ? e.inside : e.outside) = 0.5 * (e.inside + e.outside);
      if (std::abs(e.outside - e.inside) > accuracy) open[kept++] = open[n];
    }
    open.resize(kept);
  }
  for (size_t i = 0; i < count; ++i)
    crossings_[ids[i]].at = std::clamp(0.5 * (ends[i].inside + ends[i].outside),
                                       low(ids[i]) + margin_, high(ids[i]) - margin_);
}

}  // namespace msq
