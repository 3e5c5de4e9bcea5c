// SPDX-License-Identifier: Apache-2.0
// The lines in a plane of constant z on which the function of a functional structure is 0 (sheets:
// the middle of the walls) or its level (networks: the boundary).
//
// Source: marching squares, the plane form of Lorensen and Cline, "Marching cubes", 1987. The
// squares are those of a grid in model coordinates, 32 for each smallest cell size: lines closer
// than that may be joined, and closed lines smaller than that lost. Crossings with the grid are
// found by the Illinois method (Dowell and Jarratt, "A modified regula falsi method", 1971); lines
// that bend more than the tolerance are halved.
#pragma once

#include <vector>

#include "expression/batch.h"
#include "structure/common/line_graph.h"
#include "structure/functional/functional.h"

namespace msq {

class LevelLines {
 public:
  static constexpr double squares_per_cell = 32;

  LevelLines(const Functional& structure, const WallSection& section);

  LineGraph find();

 private:
  static constexpr uint32_t nothing = UINT32_MAX;
  /// A row of nodes of the grid, and the crossings on the sides that begin there.
  struct Row {
    std::vector<double> values;
    std::vector<uint32_t> right, up;
  };

  Vec2 node(int64_t i, int64_t j) const {
    return {pitch_ * static_cast<double>(first_x_ + i), pitch_ * static_cast<double>(first_y_ + j)};
  }
  /// The function less the level: inside where at most 0. What is no number is outside.
  double value(Vec2 p) const;
  void evaluate(int64_t j, Row& row);
  /// The point where the function passes the level between two points, one inside and one outside;
  /// `nothing` where it jumps.
  uint32_t crossing(Vec2 a, double at_a, Vec2 b, double at_b);
  bool find_root(Vec2& a, double& at_a, Vec2& b, double& at_b) const;
  void connect(int64_t j, const Row& low, const Row& high);
  void add_line(uint32_t a, uint32_t b);
  void refine();
  /// Halves a line as long as its middle is farther from the level than the tolerance.
  void halve(uint32_t a, uint32_t b, int depth);

  const Functional& structure_;
  const WallSection& section_;
  const Tape& function_;
  Program program_;
  double pitch_;
  int64_t first_x_, first_y_, columns_, rows_;  // nodes
  std::vector<double> x_, angles_[3], levels_;
  std::vector<Vec3> points_;
  LineGraph graph_;
};

}  // namespace msq
