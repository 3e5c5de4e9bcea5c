// SPDX-License-Identifier: Apache-2.0
// The struts that meet the plane of a layer. They give crossings in closed form, and membership of
// points of the plane.
//
// Crossings: where lines of nodes enter and leave capsules. An edge between a node outside and one
// inside is entered first where the nearest of all capsules begins, and left last where the
// farthest ends: the least and the greatest of what the capsules propose, in any order.
//
// Membership: squares of the plane list the struts whose section may reach into them, about one for
// each strut. Struts are known within a margin. A point that a strut holds by more than the margin
// is inside, and one that all struts miss by more is outside. The structure decides the few others,
// and those near struts that are far thinner than the widest: one bound serves for all radii.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/borrowed.h"
#include "base/job.h"
#include "base/memory.h"
#include "base/vec2.h"
#include "slice/contour_grid.h"
#include "slice/plane_strut_kernels.h"
#include "structure/structure.h"

namespace msq {

class PlaneStruts {
 public:
  /// Finds the struts that may hold points of the grid's window or within `around` of it. Lengths
  /// are in the unit of the grid's plane.
  PlaneStruts(const Structure& structure, const ContourGrid& grid, double around,
              std::shared_ptr<MemoryBudget> budget, const Job* job);

  /// Sets the bits of nodes that struts hold. Lists those near a surface, for find().
  void draw(const ContourGrid& grid, const NodeDrawing& out, const Job* job) const;

  /// Sets the ends of the table to where struts are entered and left; those of crossings that no
  /// strut has to infinity.
  void propose(const ContourGrid& grid, const CrossingTable& table, const Job* job) const;

  /// A point that a strut holds, in a cell whose nodes are all outside.
  struct Unseen {
    uint32_t column, row;  ///< of the cell's first node
    Vec2 at;
  };
  /// Such points in the window, where a strut's section is about as wide as it gets: what the grid
  /// misses. Cell by cell, in the order of rows; a cell may have several.
  std::vector<Unseen> find_unseen(const ContourGrid& grid, const Job* job) const;

  enum class Found : uint8_t { outside, inside, doubtful };
  /// Whether any strut holds a point of the plane. Which points are doubtful may depend on the
  /// points beside them in the array.
  Found find(Vec2 p) const;
  void find(const Vec2* points, size_t count, Found* found) const;

 private:
  struct Squares {
    double low, high, inverse_side;
    uint32_t count;
    uint32_t at(double x) const {
      const double i = (x - low) * inverse_side;
      return i > 0 ? static_cast<uint32_t>(std::min(i, static_cast<double>(count - 1))) : 0;
    }
  };

  struct SquareRange {
    uint32_t first_u, last_u, first_v, last_v;
  };

  void collect(const Structure& structure, const LayerPlane& plane, const Job* job);
  void add(const LayerPlane& plane, Vec3 a, Vec3 b, double radius);  // in the plane's unit
  void set_squares(double min_side);
  void sort(const Job* job);
  void list_by_square(const Job* job);

  std::shared_ptr<MemoryBudget> budget_;
  Reservation held_, held_lists_;
  size_t room_ = 0;  // struts that are reserved
  // Kept between calls: fresh memory of this size takes a while to get.
  struct Memory {
    std::vector<PlaneStrut> struts;  // by the square of their section's middle
    std::vector<AxisPart> parts;
    std::vector<uint32_t> thin;           // see find_unseen()
    std::vector<SquareRange> squares;     // that a strut is listed in
    std::vector<uint32_t> starts, lists;  // by square: numbers of struts
    size_t bytes() const;
  };
  const Borrowed<Memory> memory_;
  struct Unsorted {
    std::vector<PlaneStrut> struts;
    std::vector<AxisPart> parts;
    std::vector<uint32_t> starts;  // by square
    std::vector<size_t> squares;   // of struts
    size_t bytes() const {
      return struts.capacity() * sizeof(PlaneStrut) + parts.capacity() * sizeof(AxisPart) +
             starts.capacity() * sizeof(uint32_t) + squares.capacity() * sizeof(size_t);
    }
  };
  Squares u_, v_;
  double margin_;
  double widest_ = 0;  // the largest radius
  double holds_node_;  // the squared radius of discs that hold a node
};

}  // namespace msq
