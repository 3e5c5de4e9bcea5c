// SPDX-License-Identifier: Apache-2.0
// The struts of a structure as a graph: segments with ids, joined at nodes with ids. A strut and
// its ids depend on the structure alone. A selection takes those of a box.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/id_hash.h"
#include "base/vec.h"
#include "cell/neighbourhood.h"

namespace msq {

/// As msq_strut, byte for byte.
struct Strut {
  Id id;
  Id nodes[2];
  Vec3 a, b;
  double radii[2] = {0, 0};
  CellIndex cell;
  uint8_t caps[2] = {0, 0};
  uint8_t cut[2] = {0, 0};
};

/// Struts, and for each the factor of the radius parameter.
struct StrutList {
  std::vector<Strut> struts;
  std::vector<double> factors;

  void clear() {
    struts.clear();
    factors.clear();
  }
  void add(const Strut& strut, double factor) {
    struts.push_back(strut);
    factors.push_back(factor);
  }
};

/// The struts of a box.
struct StrutSelection {
  Box3 box;
  bool is_owned = true;  ///< those whose middle is in the half-open box; otherwise all near the box

  /// Whether the strut from a to b is selected. `reach`: its greatest radius. Its result does not
  /// depend on which end comes first.
  bool selects(Vec3 a, Vec3 b, double reach) const;
  /// Contains a point of each selected strut whose greatest radius is at most `reach`.
  Box3 around(double reach) const;
};

class StrutRadii {
 public:
  virtual ~StrutRadii() = default;
  /// The radius of a strut at p, its point a + t (b - a). Does not depend on the strut's ids.
  virtual double radius_at(const Strut& strut, double factor, double t, Vec3 p) const = 0;
};

/// The selected struts, in parts that threads can find at the same time.
class StrutParts {
 public:
  virtual ~StrutParts() = default;
  virtual uint64_t count() const = 0;
  /// Appends the struts of a part, in the same order in each call.
  virtual void append(uint64_t part, StrutList& list) const = 0;
  /// Of the struts of a part.
  virtual const StrutRadii& radii_of(uint64_t part) const = 0;
};

/// Those of one structure, which knows the radii of all parts.
class StrutsOfOne : public StrutParts, public StrutRadii {
 public:
  const StrutRadii& radii_of(uint64_t) const final { return *this; }
};

/// The first and last cells, in cell sizes, whose closed boxes meet a box in grid coordinates.
/// Throws Error(limit) if they are beyond max_cell_index.
struct StrutCells {
  StrutCells(const Neighbourhood& grid, const Box3& box);
  int64_t first[3], last[3];
};

/// Sets the radii of struts from number `from` on: the parameter's value at each end, times the
/// factor of the strut.
class Parameter;
void set_radii(const Parameter& radius, size_t from, StrutList& list);

}  // namespace msq
