// SPDX-License-Identifier: Apache-2.0
// The Voronoi cells of a foam's seeds in a plane. Among the points of the plane, a Voronoi diagram
// in space is a power diagram of its seeds: Aurenhammer, "Power diagrams: properties, algorithms
// and applications", 1987, section 4 (sections of Voronoi diagrams).
//
// Cells are cut out one by one, by the lines that bisect the squared distances of two seeds. A
// corner of three cells is computed from its three seeds in their order, so it has the same bits in
// all three.
#pragma once

#include <cstdint>

#include "structure/foam/section/section_seeds.h"

namespace msq {

class SectionCells {
 public:
  /// The seeds must stay alive.
  SectionCells(const SectionSeeds& seeds, const Box2& window);

  /// A corner of a cell, and the seed beyond the side from there to the next corner.
  struct Corner {
    Vec2 point;
    uint32_t beyond;
  };
  static constexpr uint32_t nobody = UINT32_MAX;
  /// The cell of a seed whose cell meets the window; empty if it has none. Valid until the next
  /// call.
  const CountedVector<Corner>& cell(uint32_t seed);

 private:
  const SectionSeed& seed(uint32_t i) const { return seeds_.seeds[i]; }
  int column(double x) const;
  int row(double y) const;
  /// Finds the seeds that have another above or below them in space that is no farther from the
  /// plane, and takes them out of the squares.
  void find_hidden();
  bool is_hidden(uint32_t seed) const;
  /// Cuts the cell with those of the seeds of a square that may bound it; finds how far it extends.
  void cut(uint32_t own, int column, int row);
  void cut(uint32_t own, uint32_t other, Vec2 to_other, double offset);
  void measure(uint32_t own);
  Vec2 corner(uint32_t own, uint32_t before, uint32_t after, Vec2 about) const;

  const SectionSeeds& seeds_;
  Vec2 low_;
  double side_;  // of squares, each with its seeds
  int columns_, rows_;
  CountedVector<uint32_t> starts_, members_;
  CountedVector<uint8_t> hidden_;  // of the seeds
  // Of the cell that is being cut.
  CountedVector<Corner> corners_, next_;
  CountedVector<double> gaps_;
  double bound_ = 0;  // seeds farther away, in the plane, do not cut it
};

}  // namespace msq
