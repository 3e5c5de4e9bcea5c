// SPDX-License-Identifier: Apache-2.0
// Tips of gaps, and whether these go on.
#include <algorithm>
#include <bit>
#include <iterator>
#include <tuple>

#include "slice/contour_gaps.h"

namespace msq {

namespace {

/// Of the pitch: tips between crossings that are nearer to each other are looked at as closely as
/// divided cells.
constexpr double narrow_tip = 0.75;
/// Parts of the edges around other tips, and of lines so many pitches beyond these. What is
/// narrower there is a corner rather than a gap, and little of it is lost.
constexpr uint32_t parts_of_tip = 4, parts_beyond_tip = 16;
constexpr double depth_beyond_tip = 0.5;

}  // namespace

/// The edges around tips, each with nodes inside at both ends.
std::vector<ContourGaps::Edge> ContourGaps::find_tips(const Job* job) const {
  std::vector<Edge> edges;
  const ContourGrid& grid = section_.grid();
  const size_t words = grid.row_words();
  const uint32_t last = grid.top_edge() - 1;  // of the inner rows
  const double narrow = narrow_tip * grid.pitch();
  for (uint32_t r = ContourGrid::first_inner_row + 1; r < last; ++r) {
    if (r % 64 == 0) check_cancelled(job);
    const uint64_t *const here = grid.row(r), *const below = grid.row(r - 1),
                          *const above = grid.row(r + 1),
                          *const beyond = grid.row(std::min(r + 2, last));
    for (size_t w = 1; w < words; ++w) {
      const uint64_t outside = ~here[w];
      if (outside == 0) continue;
      const auto next = [&](const uint64_t* row) {
        return row[w] >> 1 | (w + 1 < words ? row[w + 1] << 63 : 0);
      };
      const auto second = [&](const uint64_t* row) {
        return row[w] >> 2 | (w + 1 < words ? row[w + 1] << 62 : 0);
      };
      const auto before = [&](const uint64_t* row) { return row[w] << 1 | row[w - 1] >> 63; };
      const uint64_t first = outside & before(here);
      const uint64_t along1 = first & next(here), along2 = first & ~next(here) & second(here);
      const uint64_t lowest = outside & below[w];
      const uint64_t up1 = lowest & above[w], up2 = lowest & ~above[w] & beyond[w];
      if ((along1 | along2 | up1 | up2) == 0) continue;
      const auto put = [&](uint64_t tips, auto&& edges_of) {
        for (; tips; tips &= tips - 1)
          edges_of(static_cast<uint32_t>(w * 64) + static_cast<uint32_t>(std::countr_zero(tips)));
      };
      // Between the crossings on both sides of a node; the first one follows a node inside.
      const auto is_narrow = [&](bool is_along, uint32_t c) {
        const double* const ends = section_.ends();
        const uint32_t before =
            is_along ? section_.crossing_of(true, c - 1, r) : section_.crossing_of(false, c, r - 1);
        return ends[section_.crossing_of(is_along, c, r)] + ends[before] < narrow;
      };
      for (const bool is_above : {false, true}) {
        const uint64_t* const line = is_above ? above : below;
        const uint64_t all1 = before(line) & line[w] & next(line), all2 = all1 & second(line);
        for (const uint32_t length : {1u, 2u})
          put(length == 1 ? along1 & all1 : along2 & all2, [&](uint32_t c) {
            const uint32_t low = is_above ? r : r - 1;
            const bool is_fine = length == 1 && is_narrow(true, c);
            for (uint32_t n = 0; n <= length; ++n)
              edges.push_back({is_above ? r + 1 : r - 1, c - 1 + n, true, is_above, is_fine});
            edges.push_back({low, c - 1, false, false, is_fine});
            edges.push_back({low, c + length, false, true, is_fine});
          });
      }
      for (const bool is_right : {false, true}) {
        const auto line = [&](const uint64_t* row) { return is_right ? next(row) : before(row); };
        const uint64_t all1 = line(below) & line(here) & line(above), all2 = all1 & line(beyond);
        for (const uint32_t length : {1u, 2u})
          put(length == 1 ? up1 & all1 : up2 & all2, [&](uint32_t c) {
            const uint32_t low = is_right ? c : c - 1;
            const bool is_fine = length == 1 && is_narrow(false, c);
            for (uint32_t n = 0; n <= length; ++n)
              edges.push_back({r - 1 + n, is_right ? c + 1 : c - 1, false, is_right, is_fine});
            edges.push_back({r - 1, low, true, false, is_fine});
            edges.push_back({r + length, low, true, true, is_fine});
          });
      }
    }
  }
  const auto order = [](const Edge& e) {
    return std::tuple(e.row, e.column, e.is_horizontal, e.is_rising);
  };
  std::sort(edges.begin(), edges.end(), [&](const Edge& a, const Edge& b) {
    return std::pair(order(a), !a.is_fine) < std::pair(order(b), !b.is_fine);
  });
  edges.erase(std::unique(edges.begin(), edges.end(),
                          [&](const Edge& a, const Edge& b) { return order(a) == order(b); }),
              edges.end());
  return edges;
}

/// Those that a gap crosses: on the edge and on a line beyond it are points outside.
std::vector<ContourGaps::Edge> ContourGaps::find_open(const std::vector<Edge>& edges,
                                                      ContourPoints& points) const {
  const Reservation held(points.model().context().budget,
                         3 * edges.size() * sizeof(Edge) +
                             edges_at_once * 2 * max_gap_parts * ContourPoints::bytes_of_point,
                         "the gaps of a layer");
  std::vector<Edge> all;
  for (const bool is_fine : {false, true}) {
    std::vector<Edge> some;
    std::copy_if(edges.begin(), edges.end(), std::back_inserter(some),
                 [&](const Edge& e) { return e.is_fine == is_fine; });
    const uint32_t parts = is_fine ? parts_ : std::min(parts_, parts_of_tip);
    keep_open(some, parts, 0, points);
    keep_open(some, std::max(2 * parts, parts_beyond_tip), depth_beyond_tip, points);
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

/// Keeps edges with a point outside on a line that is so many pitches beyond them, and longer at
/// both ends by as much: gaps cross an edge at any angle.
void ContourGaps::keep_open(std::vector<Edge>& edges, uint32_t parts, double beyond,
                            ContourPoints& points) const {
  const ContourGrid& grid = section_.grid();
  const double part = (1 + 2 * beyond) * grid.pitch() / parts, off = beyond * grid.pitch();
  size_t kept = 0;
  for (size_t first = 0; first < edges.size(); first += edges_at_once) {
    const size_t end = std::min(edges.size(), first + edges_at_once);
    points.clear();
    for (size_t n = first; n < end; ++n) {
      const Edge& e = edges[n];
      const double u = grid.u(e.column), v = grid.v(e.row), across = e.is_rising ? off : -off;
      for (uint32_t i = 1; i < parts; ++i) {
        const double along = i * part - off;
        points.add(e.is_horizontal ? Vec2{u + along, v + across} : Vec2{u + across, v + along});
      }
    }
    const std::vector<uint8_t>& inside = points.find_inside();
    for (size_t n = first; n < end; ++n) {
      const auto of = inside.begin() + static_cast<ptrdiff_t>((n - first) * (parts - 1));
      if (std::find(of, of + (parts - 1), 0) != of + (parts - 1)) edges[kept++] = edges[n];
    }
  }
  edges.resize(kept);
}

}  // namespace msq
