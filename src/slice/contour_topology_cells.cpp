// SPDX-License-Identifier: Apache-2.0
#include "slice/contour_topology_cells.h"

#include <algorithm>
#include <array>
#include "slice/cell_sides.h"

namespace msq {

using namespace cell_sides;

namespace {

constexpr uint32_t max_side = 16;
constexpr uint32_t max_transitions = 4 * max_side;
constexpr uint32_t no_neighbour = UINT32_MAX;
/// Of cells beyond the window.
constexpr uint32_t beyond_row = UINT32_MAX;
constexpr uint8_t no_arc = 4;

/// Where neighbouring bits differ, of `count` bits.
uint32_t transitions(uint32_t bits, uint32_t count) {
  return (bits ^ bits >> 1) & ((uint32_t{1} << (count - 1)) - 1);
}
bool has_two(uint32_t bits) {
  return (bits & (bits - 1)) != 0;
}

/// Whether a cell that is no saddle is plainly as the rings have it: one curve at most, which meets
/// each row of samples once, or each column.
bool is_plain(const CellMask& mask) {
  const uint32_t count = mask.side + 1, last = mask.side;
  uint32_t rows_twice = 0, columns_once = 0, columns_twice = 0, first_column = 0, last_column = 0;
  for (uint32_t j = 0; j < count; ++j) {
    const uint32_t row = mask.rows[j], changes = transitions(row, count);
    rows_twice |= changes & (changes - 1);
    first_column |= (row & 1) << j;
    last_column |= (row >> last & 1) << j;
    if (j == 0) continue;
    const uint32_t up = row ^ mask.rows[j - 1];
    columns_twice |= columns_once & up;
    columns_once |= up;
  }
  const bool by_rows = rows_twice == 0 && !has_two(transitions(first_column, count)) &&
                       !has_two(transitions(last_column, count));
  const bool by_columns = columns_twice == 0 && !has_two(transitions(mask.rows[0], count)) &&
                          !has_two(transitions(mask.rows[last], count));
  return by_rows || by_columns;
}

/// The parts of a cell's mask, by union of samples.
class CellParts {
 public:
  explicit CellParts(const CellMask& mask) : across_(mask.side + 1) {
    const uint32_t n = across_;
    for (uint32_t at = 0; at < n * n; ++at) of_[at] = static_cast<uint16_t>(at);
    for (uint32_t j = 0; j < n; ++j)
      for (uint32_t i = 0; i < n; ++i) {
        const bool is_solid = mask.at(i, j);
        if (i > 0 && mask.at(i - 1, j) == is_solid) join(number(i, j), number(i - 1, j));
        if (j > 0 && mask.at(i, j - 1) == is_solid) join(number(i, j), number(i, j - 1));
        if (!is_solid || j == 0) continue;
        if (i > 0 && mask.at(i - 1, j - 1)) join(number(i, j), number(i - 1, j - 1));
        if (i + 1 < n && mask.at(i + 1, j - 1)) join(number(i, j), number(i + 1, j - 1));
      }
  }
  uint32_t of(uint32_t i, uint32_t j) { return root(number(i, j)); }
  /// The part of a sample reaches the cell's sides.
  void touch(uint32_t i, uint32_t j) { touches_[of(i, j)] = true; }
  /// Numbers of the solid and the empty parts that no touch() named.
  void count_inner(const CellMask& mask, uint16_t& solid, uint16_t& empty) const {
    for (uint32_t j = 0; j < across_; ++j)
      for (uint32_t i = 0; i < across_; ++i)
        if (of_[number(i, j)] == number(i, j) && !touches_[number(i, j)])
          ++(mask.at(i, j) ? solid : empty);
  }

 private:
  uint32_t number(uint32_t i, uint32_t j) const { return j * across_ + i; }
  uint32_t root(uint32_t at) {
    while (of_[at] != at) at = of_[at] = of_[of_[at]];
    return at;
  }
  void join(uint32_t a, uint32_t b) {
    a = root(a);
    b = root(b);
    if (a == b) return;
    of_[std::max(a, b)] = static_cast<uint16_t>(std::min(a, b));
  }

  const uint32_t across_;
  std::array<uint16_t, (max_side + 1) * (max_side + 1)> of_;
  std::array<bool, (max_side + 1) * (max_side + 1)> touches_{};
};

/// A transition on the way around a cell, counter-clockwise.
struct Transition {
  uint32_t before, behind;  // the parts on both sides
};

}  // namespace

void TopologyCells::add(uint32_t column, uint32_t row, const CellMask& mask, bool turns_right,
                        unsigned window_sides) {
  const uint32_t k = mask.side;
  const bool corners[4] = {mask.at(0, 0), mask.at(k, 0), mask.at(k, k), mask.at(0, k)};
  const bool is_saddle =
      corners[0] == corners[2] && corners[1] == corners[3] && corners[0] != corners[1];
  if (!is_saddle && is_plain(mask)) return;
  Cell cell{};
  cell.column = column;
  cell.row = row;
  cell.first = arcs_.size();
  for (unsigned c = 0; c < 4; ++c) cell.corners |= static_cast<uint8_t>(corners[c] << c);
  std::fill(cell.neighbours, cell.neighbours + 4, no_neighbour);
  std::fill(cell.main_arcs, cell.main_arcs + 4, no_arc);

  // Around the cell, side by side.
  CellParts parts(mask);
  std::array<Transition, max_transitions> around;
  uint32_t count = 0;
  for (unsigned side = 0; side < 4; ++side) {
    cell.starts[side] = static_cast<uint8_t>(count);
    const auto place = [&](uint32_t n) -> std::array<uint32_t, 2> {
      switch (side) {
        case bottom:
          return {n, 0};
        case right:
          return {k, n};
        case top:
          return {k - n, k};
        default:
          return {0, k - n};
      }
    };
    for (uint32_t n = 0; n < k; ++n) {
      const auto [i, j] = place(n);
      const auto [next_i, next_j] = place(n + 1);
      parts.touch(i, j);
      if (mask.at(i, j) != mask.at(next_i, next_j))
        around[count++] = {parts.of(i, j), parts.of(next_i, next_j)};
    }
  }
  cell.starts[4] = static_cast<uint8_t>(count);
  // A curve that begins with a part on its left ends where that part is next.
  for (uint32_t n = 0; n < count; ++n) {
    uint32_t other = (n + 1) % count;
    while (around[other].behind != around[n].before) other = (other + 1) % count;
    arcs_.push_back(static_cast<uint8_t>(other));
  }
  parts.count_inner(mask, cell.outer, cell.holes);

  // What the rings join.
  const auto join = [&](unsigned a, unsigned b) {
    cell.main_arcs[a] = static_cast<uint8_t>(b);
    cell.main_arcs[b] = static_cast<uint8_t>(a);
  };
  if (is_saddle) {
    join(bottom, turns_right ? right : left);
    join(top, turns_right ? left : right);
  } else {
    unsigned found = 4;
    for (unsigned side = 0; side < 4; ++side) {
      if (corners[side] == corners[(side + 1) % 4]) continue;
      if (found < 4) join(found, side);
      found = side;
    }
  }
  bool is_alone = true;
  for (unsigned side = 0; side < 4; ++side) is_alone = is_alone && !is_shared(cell, side);
  if (is_alone) {  // with two arcs at most
    const uint8_t* const arcs = arcs_.data() + cell.first;
    alone_ += cell.outer + cell.holes;
    if (count == 4) alone_ += cell.side_of(arcs[0]) != cell.main_arcs[cell.side_of(0)];
    arcs_.resize(cell.first);
    return;
  }
  const uint32_t index = static_cast<uint32_t>(cells_.size());
  cells_.push_back(cell);
  for (unsigned side = 0; side < 4; ++side)
    if ((window_sides >> side & 1) && is_shared(cell, side)) add_beyond(index, side);
}

/// What is beyond a side on the window's edge: a cell that is empty except for that side. The solid
/// on the side ends there.
void TopologyCells::add_beyond(uint32_t inner, unsigned side) {
  const Cell& of = cells_[inner];
  Cell cell{};
  cell.column = of.column;
  cell.row = of.row;
  cell.first = arcs_.size();
  std::fill(cell.neighbours, cell.neighbours + 4, no_neighbour);
  std::fill(cell.main_arcs, cell.main_arcs + 4, no_arc);
  const unsigned shared = (side + 2) % 4;
  // Counter-clockwise around that cell: the shared side leads from corner `begin` to corner `end`,
  // which the cell within has the other way round.
  const bool begin = of.corners >> ((side + 1) % 4) & 1, end = of.corners >> side & 1;
  cell.corners = static_cast<uint8_t>(begin << shared | end << ((shared + 1) % 4));
  uint8_t sizes[4] = {};
  sizes[shared] = static_cast<uint8_t>(of.size(side));
  sizes[(shared + 3) % 4] = begin;
  sizes[(shared + 1) % 4] = end;
  for (unsigned s = 0; s < 4; ++s)
    cell.starts[s + 1] = static_cast<uint8_t>(cell.starts[s] + sizes[s]);
  // In order: the side before, the shared one, the side behind. Two by two they bound the solid.
  std::array<uint8_t, max_transitions + 2> order;
  uint32_t count = 0;
  for (const unsigned s : {(shared + 3) % 4, shared, (shared + 1) % 4})
    for (uint32_t n = cell.starts[s]; n < cell.starts[s + 1]; ++n)
      order[count++] = static_cast<uint8_t>(n);
  arcs_.resize(arcs_.size() + count);
  for (uint32_t n = 0; n + 1 < count; n += 2) {
    arcs_[cell.first + order[n]] = order[n + 1];
    arcs_[cell.first + order[n + 1]] = order[n];
  }
  unsigned found = 4;
  for (unsigned s = 0; s < 4; ++s) {
    if (sizes[s] % 2 == 0) continue;
    if (found < 4) {
      cell.main_arcs[found] = static_cast<uint8_t>(s);
      cell.main_arcs[s] = static_cast<uint8_t>(found);
    }
    found = s;
  }
  const uint32_t index = static_cast<uint32_t>(cells_.size());
  cell.neighbours[shared] = inner;
  cells_[inner].neighbours[side] = index;
  cell.row = beyond_row;
  cells_.push_back(cell);
}

void TopologyCells::link() {
  // Of the cells of the row below, the first that is not before the current one.
  size_t below = 0;
  uint32_t before = no_neighbour;
  for (uint32_t n = 0; n < cells_.size(); ++n) {
    Cell& cell = cells_[n];
    if (cell.row == beyond_row) continue;
    if (is_shared(cell, left) && before != no_neighbour && cell.neighbours[left] == no_neighbour) {
      cell.neighbours[left] = before;
      cells_[before].neighbours[right] = n;
    }
    if (is_shared(cell, bottom) && cell.neighbours[bottom] == no_neighbour) {
      while (cells_[below].row == beyond_row || cells_[below].row + 1 < cell.row ||
             (cells_[below].row + 1 == cell.row && cells_[below].column < cell.column))
        ++below;
      cell.neighbours[bottom] = static_cast<uint32_t>(below);
      cells_[below].neighbours[top] = n;
    }
    before = n;
  }
}

/// The n-th transition on a side, from the least coordinate on; or which one the n-th is.
uint32_t TopologyCells::from_least(const Cell& cell, unsigned side, uint32_t n) const {
  return side == bottom || side == right ? n : cell.size(side) - 1 - n;
}

/// The same transition of the mask in the cell beside.
TopologyCells::Place TopologyCells::opposite(Place p) const {
  const Cell& cell = cells_[p.cell];
  const unsigned side = cell.side_of(p.n), other_side = (side + 2) % 4;
  const uint32_t neighbour = cell.neighbours[side];
  const Cell& other = cells_[neighbour];
  const uint32_t n = from_least(cell, side, p.n - cell.starts[side]);
  return {neighbour, other.starts[other_side] + from_least(other, other_side, n)};
}

uint64_t TopologyCells::steps(const Job* job) {
  link();
  CancelPoll poll(job);
  // Groups of cells that share sides with transitions more.
  std::vector<uint32_t> stack, group;
  std::vector<bool> seen(cells_.size());
  group_.assign(cells_.size(), 0);
  uint64_t steps = alone_;
  for (uint32_t first = 0; first < cells_.size(); ++first) {
    poll();
    if (seen[first]) continue;
    group.clear();
    stack.assign(1, first);
    seen[first] = true;
    size_t ends = 0;
    while (!stack.empty()) {
      const uint32_t n = stack.back();
      stack.pop_back();
      group_[n] = static_cast<uint32_t>(group.size());
      group.push_back(n);
      for (unsigned side = 0; side < 4; ++side) {
        if (!is_shared(cells_[n], side)) continue;
        ++ends;
        const uint32_t next = cells_[n].neighbours[side];
        if (seen[next]) continue;
        seen[next] = true;
        stack.push_back(next);
      }
    }
    // Each shared side has two ends. A tree has one side less than cells.
    steps += ends / 2 < group.size() ? steps_of(group.data(), group.size())
                                     : steps_of_circle(group.data(), group.size());
  }
  return steps;
}

uint64_t TopologyCells::steps_of_circle(const uint32_t* group, size_t count) const {
  uint64_t steps = 0;
  for (size_t i = 0; i < count; ++i) {
    const Cell& cell = cells_[group[i]];
    for (unsigned side = 0; side < 4; ++side)
      if (is_shared(cell, side) && group[i] < cell.neighbours[side]) steps += cell.size(side) / 2;
    steps += cell.outer + cell.holes + std::max(1u, cell.count() / 2) - 1;
  }
  return steps;
}

uint64_t TopologyCells::steps_of(const uint32_t* group, size_t count) {
  // Where curves come into the group and leave it: by cell and side.
  constexpr uint32_t nowhere = UINT32_MAX;
  std::vector<uint32_t> by_mask(4 * count, nowhere), by_rings(4 * count, nowhere);
  Curves of_mask, of_rings;
  const auto number = [&](uint32_t cell, unsigned side) { return 4 * group_[cell] + side; };
  // The shared side that a closed curve meets at the lowest place of a line tells what it holds.
  struct Least {
    bool is_known = false, is_horizontal = false, is_solid = false;
    uint32_t line = 0, along = 0, n = 0;
  };
  const auto look = [&](Least& least, uint32_t at, unsigned side, uint32_t n, bool is_solid) {
    const Cell& cell = cells_[at];
    if (cell.row == beyond_row) return;  // its neighbour is looked at
    const bool is_horizontal = side == bottom || side == top;
    const uint32_t line = is_horizontal ? cell.row + (side == top) : cell.column + (side == right);
    const uint32_t along = is_horizontal ? cell.column : cell.row;
    if (least.is_known && (least.is_horizontal != is_horizontal || least.line != line ||
                           least.along < along || (least.along == along && least.n <= n)))
      return;
    least = {true, is_horizontal, is_solid, line, along, n};
  };
  const auto least_corner = [](const Cell& cell, unsigned side) {
    // Corners 0, 1, 2, 3 lie where bottom, right, top and left begin.
    return (cell.corners >> (side == bottom || side == right ? side : (side + 1) % 4) & 1) != 0;
  };
  const auto close = [](Curves& curves, const Least& least) {
    ++(least.is_solid ? curves.outer : curves.holes);
  };

  // The mask's curves: first those that come from outside of the group.
  size_t transitions = 0;
  std::vector<size_t> firsts(count);
  for (size_t i = 0; i < count; ++i) {
    const Cell& cell = cells_[group[i]];
    firsts[i] = transitions;
    transitions += cell.count();
    of_mask.outer += cell.outer;
    of_mask.holes += cell.holes;
  }
  std::vector<bool> seen(transitions);
  const auto follow = [&](Place p, Least& least) {
    const Place start = p;
    while (true) {
      const Cell* cell = &cells_[p.cell];
      seen[firsts[group_[p.cell]] + p.n] = true;
      p.n = arcs_[cell->first + p.n];
      seen[firsts[group_[p.cell]] + p.n] = true;
      const unsigned side = cell->side_of(p.n);
      if (!is_shared(*cell, side)) return p;
      const uint32_t n = from_least(*cell, side, p.n - cell->starts[side]);
      look(least, p.cell, side, n, least_corner(*cell, side) == (n % 2 != 0));
      p = opposite(p);
      const Cell& next = cells_[p.cell];
      const unsigned next_side = next.side_of(p.n);
      look(least, p.cell, next_side, n, least_corner(next, next_side) == (n % 2 != 0));
      if (p.cell == start.cell && p.n == start.n) return p;
    }
  };
  for (const bool is_closed : {false, true})
    for (size_t i = 0; i < count; ++i) {
      const Cell& cell = cells_[group[i]];
      for (uint32_t n = 0; n < cell.count(); ++n) {
        const unsigned side = cell.side_of(n);
        if (seen[firsts[i] + n] || is_shared(cell, side) != is_closed) continue;
        Least least;
        const Place end = follow({group[i], n}, least);
        if (is_closed) {
          close(of_mask, least);
          continue;
        }
        const uint32_t a = number(group[i], side);
        const uint32_t b = number(end.cell, cells_[end.cell].side_of(end.n));
        by_mask[a] = b;
        by_mask[b] = a;
      }
    }

  // The rings', which have one transition on the sides that are shared, or none.
  std::vector<bool> seen_sides(4 * count);
  const auto follow_ring = [&](Place p, Least& least) {
    const Place start = p;
    while (true) {
      const Cell* cell = &cells_[p.cell];
      seen_sides[number(p.cell, p.n)] = true;
      p.n = cell->main_arcs[p.n];
      seen_sides[number(p.cell, p.n)] = true;
      if (!is_shared(*cell, p.n)) return p;
      look(least, p.cell, p.n, 0, !least_corner(*cell, p.n));
      p = {cell->neighbours[p.n], (p.n + 2) % 4};
      look(least, p.cell, p.n, 0, !least_corner(cells_[p.cell], p.n));
      if (p.cell == start.cell && p.n == start.n) return p;
    }
  };
  for (const bool is_closed : {false, true})
    for (size_t i = 0; i < count; ++i) {
      const Cell& cell = cells_[group[i]];
      for (unsigned side = 0; side < 4; ++side) {
        if (cell.main_arcs[side] == no_arc || seen_sides[4 * i + side] ||
            is_shared(cell, side) != is_closed)
          continue;
        Least least;
        const Place end = follow_ring({group[i], side}, least);
        if (is_closed) {
          close(of_rings, least);
          continue;
        }
        const uint32_t a = number(group[i], side), b = number(end.cell, end.n);
        by_rings[a] = b;
        by_rings[b] = a;
      }
    }

  uint64_t arcs = 0, cycles = 0;
  std::vector<bool> counted(4 * count);
  for (uint32_t n = 0; n < 4 * count; ++n) {
    if (by_mask[n] == nowhere) continue;
    ++arcs;
    if (counted[n]) continue;
    ++cycles;
    for (uint32_t at = n; !counted[at]; at = by_rings[at]) {
      counted[at] = true;
      at = by_mask[at];
      counted[at] = true;
    }
  }
  const auto apart = [](uint64_t a, uint64_t b) { return a > b ? a - b : b - a; };
  return apart(of_mask.outer, of_rings.outer) + apart(of_mask.holes, of_rings.holes) +
         (arcs / 2 - cycles);
}

}  // namespace msq
