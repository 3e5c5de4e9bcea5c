// SPDX-License-Identifier: Apache-2.0
// The structures that the contract suite runs over. A new structure is a new row of kinds() in
// structures.cpp. Every kind is crossed with the grids and with a constant and a varying radius.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cell/context.h"
#include "field/field.h"
#include "msq_test.h"
#include "structure/beams/beams.h"
#include "structure/foam/foam.h"
#include "structure/functional/functional.h"
#include "structure/lattice/cell/plate_cell.h"
#include "structure/lattice/cell/unit_cell.h"
#include "structure/structure.h"

namespace msq::test {

/// One thread: the suite is about answers, not about who computes them.
Ref<Context> shared_context();

using Factory = std::function<Ref<const Structure>(const Neighbourhood&, Parameter)>;

using FieldRef = Ref<const Field>;

struct Kind {
  std::string family;  ///< counts of samples hold for all rows of a family together
  std::string name;
  double radius;  ///< in units of the largest cell size; of functional structures the level
  double jitter;  ///< of foams; lattices: 1, as they have no ties that the methods may split
  Factory make;
  /// What a varying radius is in place of a linear one; NULL: that.
  FieldRef (*vary)(const Neighbourhood&, FieldRef linear) = nullptr;
  bool holds_beams = false;  ///< whose radii are taken at their ends
};

struct GridVariant {
  std::string name;
  Neighbourhood grid;
  bool is_axis_aligned;
};

/// A row of the suite.
struct StructureRow {
  std::string name;
  Kind kind;
  GridVariant variant;
  bool is_graded;
  size_t family_rows;      ///< rows in the same family
  size_t index;            ///< among them
  double graded_from = 0;  ///< part of the radius that a varying radius begins at
  double cells_away = 0;   ///< its grid, in largest cells along an oblique line

  /// The row with its grid so far from where it was.
  StructureRow moved(double cells) const;
  /// In units within 8 of the grid's origin, no coordinate is larger in the model's frame or the
  /// grid's.
  double max_coordinate() const { return (cells_away + 8) * unit(); }

  bool is_lattice() const { return kind.family.find("foam") == std::string::npos; }
  bool is_beams() const { return kind.family == "beams"; }
  bool is_method_2() const { return kind.family == "foam METHOD_2"; }
  /// Methods whose cells, or whose points, are dear.
  bool is_method_1() const { return kind.family == "foam METHOD_1"; }
  bool has_dear_cells() const { return is_method_1() || is_method_2(); }
  bool has_dear_points() const { return kind.family == "foam POINT"; }
  /// Made of other rows' structures, which have tests of their own.
  bool is_made_of_others() const {
    return kind.family == "combined" || kind.family == "blended" || kind.family == "smooth";
  }
  /// A test's number of samples, cut down where they are dear.
  size_t samples(size_t full) const {
    const size_t part = has_dear_points()                      ? 1000
                        : is_method_1() || is_made_of_others() ? 10
                        : is_method_2()                        ? 4
                                                               : 1;
    return test_count(full / part) / family_rows + 2;
  }
  double unit() const { return max_component(variant.grid.cell_size); }
  double radius() const { return kind.radius * unit(); }

  /// The radius, changed by `extra`; a varying one grows along an oblique line through `centre`,
  /// from graded_from of its greatest value to that.
  Parameter parameter(Vec3 centre, double extra = 0) const;
  /// The structure with that radius.
  Ref<const Structure> make(Vec3 centre, double extra = 0) const {
    return kind.make(variant.grid, parameter(centre, extra));
  }
};

Factory lattice_factory(UnitCell cell);
Factory foam_factory(FoamMethod method, double jitter);
/// Rises from 1 to 30 along an oblique line through the grid's origin.
Parameter rising_density(const Neighbourhood& grid);
/// The radius of the suite stands for the level.
Factory functional_factory(const char* expression, FunctionalKind kind, int clusters);
/// The same in cells whose size varies along an axis of the grid, from half to 1.5 of the grid's.
Factory graded_functional_factory(const char* expression, FunctionalKind kind, int axis);
/// Skew struts that start and end on faces, edges and corners of the cell, one that joins two
/// cells' worth of nodes, and one alone in the middle.
UnitCell skew_unit_cell();
/// The same with struts of six radii.
UnitCell factored_unit_cell();
/// The radius of the suite stands for the thickness.
Factory plates_factory(PlateCell cell);
/// Skew triangles that start and end on faces, edges and corners of the cell, a narrow one, and one
/// alone in the middle.
PlateCell skew_plate_cell();
/// The same with plates of five thicknesses.
PlateCell factored_plate_cell();
/// Cubic, skew, octet and Kelvin cells, by a choice that grows along an oblique line and runs past
/// both ends of the library.
Factory mixed_factory();

enum class BeamSort { capsules, cones, half_balls, flat, all };
/// In and about cells by the grid's origin and at places 1000 cells away, some along the grid's
/// axes and some shorter than they are wide. A radius that varies is taken at either end.
std::vector<Beam> random_beams(const Neighbourhood& grid, const Parameter& radius, BeamSort sort);
Ref<const Beams> make_beams(const std::vector<Beam>& beams);

std::vector<GridVariant> grid_variants(bool is_lattice);
/// Each kind on each grid. Slow builds (MSQ_TEST_SCALE below 0.05) take one grid for each kind.
std::vector<StructureRow> structures();
/// For tests that ask single points only: inside() is one function for all methods of a foam.
std::vector<StructureRow> structures_by_point();
/// Where METHOD_2 may differ from the point query, by the contract: with seeds so nearly on spheres
/// that rounding decides which of them end an edge, within 1e-9 of the boundary. A point is that
/// near if the structure with a radius smaller by that leaves it out and the one with a larger
/// radius holds it.
bool may_differ(const StructureRow& row, Vec3 centre, Vec3 p);

}  // namespace msq::test
