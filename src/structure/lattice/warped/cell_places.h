// SPDX-License-Identifier: Apache-2.0
// Where the cells of a grid are that vary in size or are bent: the map from coordinates in cells to
// grid coordinates. Nodes are placed by it; the struts between them are straight.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/hash_input.h"
#include "base/vec.h"
#include "cell/neighbourhood.h"

namespace msq {

/// The cells from `first` to `last` along each axis: whole numbers; none if last < first.
struct CellBlock {
  double first[3], last[3];

  bool empty() const {
    return !(first[0] <= last[0] && first[1] <= last[1] && first[2] <= last[2]);
  }
  double count() const {
    return empty() ? 0
                   : (last[0] - first[0] + 1) * (last[1] - first[1] + 1) * (last[2] - first[2] + 1);
  }
};

class CellPlaces {
 public:
  virtual ~CellPlaces() = default;

  /// The grid with the smallest of the cells, and the size of the largest.
  virtual const Neighbourhood& smallest() const = 0;
  virtual double largest() const = 0;
  /// Structure::is_alike_from_origin().
  virtual bool is_alike_from_origin() const = 0;
  /// The cell that contains a point in grid coordinates.
  virtual CellIndex cell_of(Vec3 g) const = 0;
  /// The list of near struts that serves a point, and a box that contains all points of a list.
  /// Lists are those of cells, unless these have no simple bounds.
  virtual CellIndex list_of(Vec3 g) const { return cell_of(g); }
  virtual Box3 list_bounds(CellIndex list) const {
    const double at[3] = {double(list.x), double(list.y), double(list.z)};
    CellBlock own;
    for (int axis = 0; axis < 3; ++axis) own.first[axis] = own.last[axis] = at[axis];
    return bounds(own);
  }
  /// The same cell, in the one of its numbers that its nodes are placed by.
  virtual CellIndex canonical(CellIndex cell) const { return cell; }
  /// A canonical cell that has struts, the cell itself or one nearby. Cells without struts are
  /// where points may be.
  virtual CellIndex nearest_with_struts(CellIndex cell) const { return canonical(cell); }
  /// The point at `fraction`, each component in [0, 1), of a canonical cell: the definition. Not
  /// finite if there is none: then nodes there have no struts.
  virtual Vec3 place(CellIndex cell, Vec3 fraction) const = 0;
  /// The axes, bit 0 for x, along which the coordinate of such a point does not count: on the axis
  /// and at poles, which all cells around share.
  virtual unsigned folded_axes(CellIndex cell, Vec3 fraction) const {
    (void)cell;
    (void)fraction;
    return 0;
  }
  /// Where cells end, in each direction: a cell that is the first along an axis, or the one after
  /// the last, which has no struts but those on its lower face.
  enum class End : uint8_t { none, first, last };
  struct Ends {
    End along[3] = {End::none, End::none, End::none};
  };
  virtual Ends ends(CellIndex cell) const {
    (void)cell;
    return {};
  }
  /// A box in grid coordinates that contains the cells, and so the struts between their corners.
  virtual Box3 bounds(const CellBlock& cells) const = 0;
  /// The number of the cell at a place along an axis, as far as queries and shapes reach: no point
  /// beyond is inside.
  static double cell_within_reach(double place) {
    return std::clamp(std::floor(place), -max_cell_index, max_cell_index);
  }
  /// Calls take() for blocks of canonical cells, which together have once each cell whose struts
  /// may meet the box, and others.
  using TakeBlock = std::function<void(const CellBlock&)>;
  virtual void for_each_block(const Box3& box, const TakeBlock& take) const = 0;
  virtual void describe(HashInput& input) const = 0;

  /// Calls visit(cell) for each canonical cell whose struts may meet a box, and for some others.
  /// meets(bounds): whether the box may meet bounds in grid coordinates.
  template <class Meets, class Visit>
  void for_each_cell(const Box3& box, Meets&& meets, Visit&& visit) const {
    for_each_block(box, [&](const CellBlock& cells) { halve(cells, meets, visit); });
  }
  /// The same for cells of a block.
  template <class Meets, class Visit>
  void for_each_cell_of(const CellBlock& cells, Meets&& meets, Visit&& visit) const {
    halve(cells, meets, visit);
  }

 private:
  template <class Meets, class Visit>
  void halve(const CellBlock& cells, Meets& meets, Visit& visit) const {
    if (cells.empty() || !meets(bounds(cells))) return;
    constexpr double few = 4;
    if (cells.count() > few) {
      int axis = 0;
      for (int other = 1; other < 3; ++other)
        if (cells.last[other] - cells.first[other] > cells.last[axis] - cells.first[axis])
          axis = other;
      CellBlock low = cells, high = cells;
      low.last[axis] = std::floor(0.5 * (cells.first[axis] + cells.last[axis]));
      high.first[axis] = low.last[axis] + 1;
      halve(low, meets, visit);
      halve(high, meets, visit);
      return;
    }
    for (double k = cells.first[2]; k <= cells.last[2]; ++k)
      for (double j = cells.first[1]; j <= cells.last[1]; ++j)
        for (double i = cells.first[0]; i <= cells.last[0]; ++i)
          visit(
              CellIndex{static_cast<int32_t>(i), static_cast<int32_t>(j), static_cast<int32_t>(k)});
  }
};

}  // namespace msq
