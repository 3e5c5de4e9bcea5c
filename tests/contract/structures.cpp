// SPDX-License-Identifier: Apache-2.0
#include "structures.h"

#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "expression/parser.h"
#include "field/gradient.h"
#include "field/grid.h"
#include "field/map.h"
#include "foam_structures.h"
#include "host_structures.h"
#include "images.h"
#include "lattice_structures.h"
#include "random.h"
#include "structure/beams/beams.h"
#include "structure/combined/blended_structure.h"
#include "structure/combined/boolean_structure.h"
#include "structure/combined/smooth_boolean.h"
#include "structure/foam/foam.h"
#include "structure/foam/paper/delaunay.h"
#include "structure/functional/functional.h"
#include "structure/functional/presets.h"
#include "structure/lattice/lattice.h"
#include "structure/waves/waves.h"

namespace msq::test {

namespace {

/// Through a bent curve.
FieldRef mapped(const Neighbourhood&, FieldRef linear) {
  const auto [low, high] = linear->range();
  const auto between = [low = low, high = high](double part) { return low + part * (high - low); };
  return make_ref<MapField>(
      linear,
      Curve(
          {{low, low}, {between(0.4), between(0.7)}, {between(0.7), between(0.5)}, {high, high}}));
}

/// Sampled about the grid's origin, on a turned grid of its own.
FieldRef sampled_field(const Neighbourhood& grid, FieldRef linear) {
  const ImageFrame frame{grid.origin - Vec3{4, 4, 4} * max_component(grid.cell_size),
                         grid.cell_size * 0.7, skew_rotation()};
  const ImageSize size{16, 17, 18};
  const auto values = sampled<double>(size, [&](Vec3 u) {
    return linear->at(frame.rotation.apply(u * frame.spacing) + frame.origin);
  });
  return make_ref<GridField>(make_image(values, size, frame));
}

}  // namespace

Parameter rising_density(const Neighbourhood& grid) {
  const Vec3 half = Vec3{1.6, 1.2, 0.9} * grid.cell_size;
  return Parameter(Ref<const Field>(
      make_ref<GradientField>(grid.from_grid(half * -1.0), 1.0, grid.from_grid(half), 30.0)));
}

Ref<Context> shared_context() {
  static const Ref<Context> context = make_ref<Context>(1u, uint64_t{64} << 20, uint64_t{0});
  return context;
}

StructureRow StructureRow::moved(double cells) const {
  StructureRow row = *this;
  row.cells_away += cells;
  Vec3& origin = row.variant.grid.origin;
  origin = origin + Vec3{1, -0.9, 0.8} * (cells * unit());
  char text[40];
  std::snprintf(text, sizeof text, ", %g cells away", cells);
  row.name += text;
  return row;
}

Parameter StructureRow::parameter(Vec3 centre, double extra) const {
  const double most = radius() + extra;
  if (!is_graded) return Parameter(most);
  const Vec3 half = Vec3{1.1, 0.9, 0.7} * unit();
  FieldRef field =
      make_ref<GradientField>(centre - half, graded_from * radius() + extra, centre + half, most);
  if (kind.vary) field = kind.vary(variant.grid, field);
  return Parameter(field);
}

Factory functional_factory(const char* expression, FunctionalKind kind, int clusters) {
  const Tape tape = parse_expression(expression, {});
  return [=](const Neighbourhood& grid, Parameter level) {
    return Ref<const Structure>(make_ref<Functional>(grid, tape, kind, std::move(level), clusters));
  };
}

Factory graded_functional_factory(const char* expression, FunctionalKind kind, int axis) {
  const Tape tape = parse_expression(expression, {});
  return [=](const Neighbourhood& grid, Parameter level) {
    return Ref<const Structure>(
        make_ref<Functional>(grid, tape, kind, std::move(level), 0, graded_period(grid, axis)));
  };
}

namespace {

/// Six cells around the grid's z axis or origin, some of the shell's ends within reach.
Factory warped_factory(const char* expression, FunctionalKind kind, Warp::Kind warp,
                       double inner = 0.4, double shear_outwards = 0, double shear_along = 0) {
  const Tape tape = parse_expression(expression, {});
  return [=](const Neighbourhood& grid, Parameter level) {
    const double size = grid.cell_size.x;
    const Warp::Shell shell{6,
                            warp == Warp::Kind::spherical ? 4u : 0u,
                            inner * size,
                            2.6 * size,
                            shear_outwards,
                            shear_along};
    return Ref<const Structure>(
        make_ref<Functional>(grid, tape, kind, std::move(level), 0, Warp(warp, grid, shell)));
  };
}

Factory sampled_factory(const char* expression, FunctionalKind kind) {
  const Tape tape = parse_expression(expression, {});
  return [=](const Neighbourhood& grid, Parameter level) {
    CellShape cells;
    cells.sampled = sampled_map(grid);
    return Ref<const Structure>(
        make_ref<Functional>(grid, tape, kind, std::move(level), 0, std::move(cells)));
  };
}

/// A turned grid with smaller cells.
Neighbourhood other_grid(const Neighbourhood& grid) {
  return {grid.origin + grid.cell_size * 0.3, grid.cell_size * 0.8, skew_rotation()};
}

using Operation = BooleanStructure::Operation;

/// Two structures, the second on a grid of its own. What is subtracted does not grow with the
/// radius.
Factory boolean_factory(Operation operation, const Factory& first, const Factory& second) {
  return [=](const Neighbourhood& grid, const Parameter& radius) {
    const bool grows = operation != Operation::subtracted;
    const Parameter fixed(0.137 * max_component(grid.cell_size));
    return Ref<const Structure>(make_ref<BooleanStructure>(
        operation,
        StructureList{first(grid, radius), second(other_grid(grid), grows ? radius : fixed)}));
  };
}

/// Of two structures, by a fraction that rises along an oblique line.
Factory blend_factory(const Factory& first, const Factory& second, double low, double high) {
  return [=](const Neighbourhood& grid, const Parameter& radius) {
    const Vec3 half = Vec3{1.4, 0.8, 0.5} * grid.cell_size;
    const FieldRef field =
        make_ref<GradientField>(grid.from_grid(half * -1.0), low, grid.from_grid(half), high);
    return Ref<const Structure>(make_ref<BlendedStructure>(
        first(grid, radius), second(other_grid(grid), radius), Parameter(field)));
  };
}

/// Of two structures, with fillets whose radius rises along an oblique line, in cells. What is
/// subtracted does not grow.
Factory smooth_factory(Operation operation, const Factory& first, const Factory& second, double low,
                       double high) {
  return [=](const Neighbourhood& grid, const Parameter& radius) {
    const double cell = max_component(grid.cell_size);
    const bool grows = operation != Operation::subtracted;
    const Vec3 half = Vec3{0.9, 0.6, 1.1} * grid.cell_size;
    const FieldRef field = make_ref<GradientField>(grid.from_grid(half * -1.0), low * cell,
                                                   grid.from_grid(half), high * cell);
    return Ref<const Structure>(
        make_ref<SmoothBoolean>(operation, first(grid, radius),
                                second(other_grid(grid), grows ? radius : Parameter(0.137 * cell)),
                                low == high ? Parameter(low * cell) : Parameter(field)));
  };
}

/// Of more than two, some within each other. What is subtracted does not grow.
Factory nested_factory() {
  return [](const Neighbourhood& grid, const Parameter& radius) {
    const Ref<const Structure> gyroid =
        functional_factory(preset_expressions[0], FunctionalKind::network, 0)(grid, radius);
    const Parameter fixed(0.1 * max_component(grid.cell_size));
    const Ref<const Structure> octet = lattice_factory(octet_unit_cell())(other_grid(grid), fixed);
    const Ref<const Structure> foam = foam_factory(FoamMethod::direct, 1)(grid, radius);
    const auto beams = [&](const Parameter& of_radius) {
      return Ref<const Structure>(make_beams(random_beams(grid, of_radius, BeamSort::all)));
    };
    const auto make = [](Operation operation, const StructureList& members) {
      return Ref<const Structure>(make_ref<BooleanStructure>(operation, members));
    };
    return make(Operation::united, {make(Operation::subtracted, {gyroid, octet, beams(fixed)}),
                                    make(Operation::intersected, {foam, gyroid}), beams(radius)});
  };
}

Factory beams_factory(BeamSort sort) {
  return [=](const Neighbourhood& grid, Parameter radius) {
    return Ref<const Structure>(make_beams(random_beams(grid, radius, sort)));
  };
}

/// In cones about the axes, so that some waves are nearly parallel.
Factory waves_factory(WavesKind kind, uint32_t count) {
  return [=](const Neighbourhood& grid, Parameter level) {
    WaveDirections directions;
    directions.seed = 11;
    directions.count = count;
    directions.half_angles = {0.5, 0.3, 1.2};
    return Ref<const Structure>(make_ref<Waves>(grid, directions, kind, std::move(level)));
  };
}

Kind holding_beams(Kind kind) {
  kind.holds_beams = true;
  return kind;
}

std::vector<Kind> kinds() {
  std::vector<Kind> kinds = {
      {"cubic", "thin", 0.08, 1, lattice_factory(cubic_unit_cell())},
      {"cubic", "ties", 0.25, 1, lattice_factory(cubic_unit_cell())},
      {"BCC", "thin", 0.06, 1, lattice_factory(bcc_unit_cell())},
      {"BCC", "fat", 0.2, 1, lattice_factory(bcc_unit_cell())},
      {"octet", "thin", 0.03, 1, lattice_factory(octet_unit_cell())},
      {"octet", "ties", 0.125, 1, lattice_factory(octet_unit_cell())},
      {"skew", "thin", 0.05, 1, lattice_factory(skew_unit_cell())},
      {"skew", "beyond its cell", 0.21, 1, lattice_factory(skew_unit_cell())},
      {"factors", "", 0.09, 1, lattice_factory(factored_unit_cell())},
      {"presets", "Kelvin", 0.05, 1, lattice_factory(kelvin_unit_cell())},
      {"presets", "re-entrant", 0.07, 1, lattice_factory(reentrant_unit_cell())},
      {"mixed", "", 0.07, 1, mixed_factory()},
      {"plates", "cubic", 0.16, 1, plates_factory(cubic_plate_cell())},
      {"plates", "cubic and octet, thin", 0.04, 1, plates_factory(cubic_octet_plate_cell())},
      {"plates", "BCC", 0.1, 1, plates_factory(bcc_plate_cell())},
      {"plates", "Kelvin", 0.1, 1, plates_factory(kelvin_plate_cell())},
      {"plates", "skew", 0.08, 1, plates_factory(skew_plate_cell())},
      {"plates", "skew, beyond their cell", 0.3, 1, plates_factory(skew_plate_cell())},
      {"plates", "factors", 0.12, 1, plates_factory(factored_plate_cell())},
      {"plates", "and struts", 0.09, 1, plated_factory(skew_unit_cell(), skew_plate_cell())},
  };
  // A sum with the tables of a row, one of them with its magnitude taken, and what is none.
  const FunctionalKind network = FunctionalKind::network, sheet = FunctionalKind::sheet;
  const char* const choice =
      "min(sin(x)*cos(y)+sin(y)*cos(z)+sin(z)*cos(x), sqrt(4+cos(x)+cos(y)*cos(z))-2)";
  kinds.push_back(
      {"functional", "gyroid", 0.2, 1, functional_factory(preset_expressions[0], network, 0)});
  kinds.push_back(
      {"functional", "split P sheet", 0.1, 1, functional_factory(preset_expressions[7], sheet, 0)});
  kinds.push_back({"functional", "choice", 0.05, 1, functional_factory(choice, network, 0)});
  kinds.push_back(
      {"functional", "choice sheet, few clusters", 0.1, 1, functional_factory(choice, sheet, 3)});
  kinds.push_back({"graded period", "gyroid along z", 0.2, 1,
                   graded_functional_factory(preset_expressions[0], network, 2)});
  kinds.push_back({"graded period", "split P sheet along x", 0.1, 1,
                   graded_functional_factory(preset_expressions[7], sheet, 0)});
  kinds.push_back(
      {"graded period", "choice along y", 0.05, 1, graded_functional_factory(choice, network, 1)});
  constexpr Warp::Kind cylinder = Warp::Kind::cylindrical, sphere = Warp::Kind::spherical;
  kinds.push_back({"warped", "gyroid around an axis", 0.2, 1,
                   warped_factory(preset_expressions[0], network, cylinder)});
  kinds.push_back({"warped", "split P sheet around an axis", 0.1, 1,
                   warped_factory(preset_expressions[7], sheet, cylinder)});
  kinds.push_back({"warped", "choice around an axis, to it", 0.05, 1,
                   warped_factory(choice, network, cylinder, 0)});
  // It jumps where cells end.
  kinds.push_back({"warped", "ramp around an axis", 0.2, 1,
                   warped_factory("x + 0.5*sin(z)*cos(y) - 4", network, cylinder)});
  kinds.push_back({"warped", "gyroid around a point", 0.2, 1,
                   warped_factory(preset_expressions[0], sheet, sphere)});
  kinds.push_back({"warped", "gyroid, sheared", 0.2, 1,
                   warped_factory(preset_expressions[0], network, cylinder, 0.4, 0.3, -0.7)});
  kinds.push_back({"warped", "lidinoid sheet, twisted", 0.1, 1,
                   warped_factory(preset_expressions[6], sheet, cylinder, 0.4, 0, 1.25)});
  kinds.push_back({"warped", "choice, sheared", 0.05, 1,
                   warped_factory(choice, network, cylinder, 0.4, 0.5, 0.5)});
  kinds.push_back({"sampled", "gyroid", 0.2, 1, sampled_factory(preset_expressions[0], network)});
  kinds.push_back(
      {"sampled", "split P sheet", 0.1, 1, sampled_factory(preset_expressions[7], sheet)});
  kinds.push_back({"sampled", "choice", 0.05, 1, sampled_factory(choice, network)});
  kinds.push_back(
      {"graded lattice", "BCC along z", 0.08, 1, graded_lattice_factory(bcc_unit_cell(), 2)});
  kinds.push_back({"graded lattice", "skew along x, fat", 0.21, 1,
                   graded_lattice_factory(skew_unit_cell(), 0)});
  kinds.push_back({"graded lattice", "factors along y", 0.07, 1,
                   graded_lattice_factory(factored_unit_cell(), 1)});
  const auto round = Warp::Kind::cylindrical, ball = Warp::Kind::spherical;
  kinds.push_back({"warped lattice", "BCC around an axis", 0.08, 1,
                   round_lattice_factory(bcc_unit_cell(), round, {-2.3, -2.2, 0}, {20, 0, 0, 0})});
  kinds.push_back({"warped lattice", "skew about its axis, fat", 0.15, 1,
                   round_lattice_factory(skew_unit_cell(), round, {0.1, 0.2, 0.3}, {7, 0, 0, 0})});
  kinds.push_back(
      {"warped lattice", "octet in a shell", 0.06, 1,
       round_lattice_factory(octet_unit_cell(), ball, {0.2, 0.1, -0.3}, {8, 5, 0.5, 1.7})});
  kinds.push_back(
      {"warped lattice", "factors around a point", 0.07, 1,
       round_lattice_factory(factored_unit_cell(), ball, {-1.3, -1.1, -1.7}, {16, 8, 0.4, 0})});
  kinds.push_back(
      {"warped lattice", "BCC, twisted", 0.08, 1,
       round_lattice_factory(bcc_unit_cell(), round, {-2.3, -2.2, 0}, {20, 0, 0, 0, 0, 0.75})});
  kinds.push_back({"warped lattice", "skew, sheared, fat", 0.15, 1,
                   round_lattice_factory(skew_unit_cell(), round, {-1.1, 0.2, 0.3},
                                         {9, 0, 0.5, 2.2, -0.6, 0.9})});
  kinds.push_back({"sampled lattice", "BCC", 0.08, 1, sampled_lattice_factory(bcc_unit_cell())});
  kinds.push_back(
      {"sampled lattice", "skew, fat", 0.15, 1, sampled_lattice_factory(skew_unit_cell())});
  kinds.push_back(
      {"sampled lattice", "factors", 0.07, 1, sampled_lattice_factory(factored_unit_cell())});
  kinds.push_back({"waves", "network", 0.2, 1, waves_factory(WavesKind::network, 40)});
  kinds.push_back({"waves", "sheet", 0.15, 1, waves_factory(WavesKind::sheet, 15)});
  for (bool by_cell : {false, true})
    kinds.push_back({"host", by_cell ? "lattice by cells" : "lattice by points", 0.12, 1,
                     [=](const Neighbourhood& grid, Parameter radius) {
                       return make_copy(shared_context(), octet_unit_cell(), grid,
                                        std::move(radius), by_cell);
                     }});
  struct Function {
    const char* name;
    bool is_sheet, has_range;
    double lipschitz;
  };
  constexpr double unknown = std::numeric_limits<double>::infinity();
  for (const Function& f : {Function{"function", false, false, unknown},
                            Function{"function of bounded slope", false, false, 3.4642},
                            Function{"sheet of known ranges", true, true, unknown}})
    kinds.push_back({"host", f.name, 0.2, 1, [=](const Neighbourhood& grid, Parameter level) {
                       return make_host_gyroid(grid, std::move(level), f.is_sheet, f.has_range,
                                               f.lipschitz);
                     }});
  struct Method {
    const char* family;
    FoamMethod method;
  };
  std::vector<Method> methods = {{"foam POINT", FoamMethod::point},
                                 {"foam METHOD_1", FoamMethod::method_1},
                                 {"foam DIRECT", FoamMethod::direct}};
  if (can_triangulate()) methods.push_back({"foam METHOD_2", FoamMethod::method_2});
  for (const Method& m : methods)
    for (double jitter : {1.0, 0.5, 0.01, 0.0})
      for (double radius : {0.05, 0.1, 0.26, 0.5}) {
        if (m.method == FoamMethod::point && radius == 0.5) continue;
        char name[64];
        std::snprintf(name, sizeof name, "jitter %g r %g", jitter, radius);
        kinds.push_back({m.family, name, radius, jitter, foam_factory(m.method, jitter)});
      }
  for (double jitter : {1.0, 0.01, 0.0})
    for (double radius : {0.02, 0.06, 0.26}) {
      if (jitter < 1 && radius != 0.06) continue;
      char name[64];
      std::snprintf(name, sizeof name, "density 1 to 30, jitter %g r %g", jitter, radius);
      kinds.push_back({"foam DIRECT", name, radius, jitter, graded_foam_factory(jitter)});
    }
  kinds.push_back({"foam stretched", "along z", 0.08, 1, stretched_factory(1, {1, 1, 3})});
  kinds.push_back({"foam stretched", "oblate", 0.06, 0.5, stretched_factory(0.5, {2.5, 1, 0.6})});
  kinds.push_back({"foam stretched", "much", 0.05, 1, stretched_factory(1, {0.25, 2, 1})});
  kinds.push_back({"foam stretched", "jitter 0", 0.1, 0, stretched_factory(0, {2, 1, 1})});
  kinds.push_back(
      {"foam stretched", "sampled radius", 0.1, 1, stretched_factory(1, {1, 2, 1}), sampled_field});
  kinds.push_back({"foam stretched", "walls", 0.06, 1, stretched_walls_factory(1, {1, 2.5, 1})});
  kinds.push_back(
      {"foam stretched", "walls, jitter 0.5", 0.1, 0.5, stretched_walls_factory(0.5, {3, 1, 2})});
  kinds.push_back({"foam weighted", "most", 0.08, 1, weighted_factory(1, 1)});
  kinds.push_back({"foam weighted", "half", 0.06, 0.5, weighted_factory(0.5, 0.5)});
  kinds.push_back({"foam weighted", "jitter 0", 0.1, 0, weighted_factory(0, 0.7)});
  kinds.push_back(
      {"foam weighted", "sampled radius", 0.1, 1, weighted_factory(1, 0.6), sampled_field});
  kinds.push_back({"foam weighted", "walls", 0.06, 1, weighted_walls_factory(1, 1)});
  kinds.push_back({"foam weighted", "walls, jitter 0", 0.1, 0, weighted_walls_factory(0, 0.5)});
  kinds.push_back({"foam placed", "period along z", 0.08, 1, placed_factory(1, by_period<2>)});
  kinds.push_back({"foam placed", "period along x", 0.2, 0.5, placed_factory(0.5, by_period<0>)});
  kinds.push_back({"foam placed", "period, jitter 0", 0.1, 0, placed_factory(0, by_period<1>)});
  kinds.push_back({"foam placed", "period, sampled radius", 0.1, 1, placed_factory(1, by_period<1>),
                   sampled_field});
  kinds.push_back({"foam placed", "walls", 0.06, 1, placed_walls_factory(1, by_period<2>)});
  kinds.push_back(
      {"foam placed", "walls, jitter 0", 0.1, 0, placed_walls_factory(0, by_period<0>)});
  kinds.push_back(
      {"foam placed", "walls with holes", 0.08, 1, placed_walls_factory(1, by_period<1>, 0.15)});
  kinds.push_back({"foam placed", "and struts", 0.09, 1, placed_both_factory(1, by_period<2>)});
  kinds.push_back(
      {"warped foam", "struts", 0.08, 1, shelled_factory(placed_factory(1, by_warp<>))});
  kinds.push_back(
      {"warped foam", "struts, jitter 0", 0.1, 0, shelled_factory(placed_factory(0, by_warp<>))});
  kinds.push_back({"warped foam", "struts, sampled radius", 0.1, 1,
                   shelled_factory(placed_factory(1, by_warp<>)), sampled_field});
  kinds.push_back(
      {"warped foam", "walls", 0.06, 0.5, shelled_factory(placed_walls_factory(0.5, by_warp<>))});
  kinds.push_back({"warped foam", "walls with holes", 0.08, 1,
                   shelled_factory(placed_walls_factory(1, by_warp<>, 0.15))});
  kinds.push_back({"warped foam", "walls and struts", 0.09, 1,
                   shelled_factory(placed_both_factory(1, by_warp<>))});
  kinds.push_back(
      {"warped foam", "sheared struts", 0.08, 1,
       shelled_factory(placed_factory(1, by_warp<FoamWarp::sheared>), FoamWarp::sheared)});
  kinds.push_back(
      {"warped foam", "sheared walls", 0.06, 0.5,
       shelled_factory(placed_walls_factory(0.5, by_warp<FoamWarp::sheared>), FoamWarp::sheared)});
  kinds.push_back(
      {"warped foam", "struts around a point", 0.08, 1,
       shelled_factory(placed_factory(1, by_warp<FoamWarp::sphere>), FoamWarp::sphere)});
  kinds.push_back(
      {"warped foam", "walls around a point", 0.06, 1,
       shelled_factory(placed_walls_factory(1, by_warp<FoamWarp::sphere>), FoamWarp::sphere)});
  kinds.push_back(
      {"warped foam", "struts by samples", 0.08, 1,
       shelled_factory(placed_factory(1, by_warp<FoamWarp::sampled>), FoamWarp::sampled)});
  kinds.push_back({"warped foam", "walls by samples", 0.06, 1,
                   shelled_factory(placed_walls_factory(1, by_warp<FoamWarp::sampled>, 0.15),
                                   FoamWarp::sampled)});
  for (double jitter : {1.0, 0.01, 0.0})
    for (double thickness : {0.02, 0.1, 0.45}) {
      if (jitter < 1 && thickness != 0.1) continue;
      char name[64];
      std::snprintf(name, sizeof name, "jitter %g t %g", jitter, thickness);
      kinds.push_back({"foam walls", name, thickness, jitter, walls_factory(jitter)});
    }
  kinds.push_back({"foam walls", "density 1 to 30", 0.06, 1, walls_factory(1, true)});
  kinds.push_back({"foam walls", "holes", 0.1, 1, vented_factory(1)});
  kinds.push_back({"foam walls", "holes, jitter 0", 0.1, 0, vented_factory(0)});
  kinds.push_back({"foam walls", "holes by a field", 0.3, 1, vented_factory(1, false)});
  kinds.push_back({"foam walls", "holes, density 1 to 30", 0.06, 1, vented_factory(1, true, true)});
  kinds.push_back({"foam walls", "and struts", 0.09, 1, walled_factory(1)});
  kinds.push_back({"foam walls", "and struts, jitter 0", 0.09, 0, walled_factory(0)});
  kinds.push_back(holding_beams({"beams", "capsules", 0.1, 1, beams_factory(BeamSort::capsules)}));
  kinds.push_back(holding_beams({"beams", "cones", 0.14, 1, beams_factory(BeamSort::cones)}));
  kinds.push_back(
      holding_beams({"beams", "half balls", 0.14, 1, beams_factory(BeamSort::half_balls)}));
  kinds.push_back(holding_beams({"beams", "flat ends", 0.12, 1, beams_factory(BeamSort::flat)}));
  kinds.push_back(holding_beams({"beams", "all sorts", 0.12, 1, beams_factory(BeamSort::all)}));
  kinds.push_back({"combined", "BCC or gyroid", 0.12, 1,
                   boolean_factory(Operation::united, lattice_factory(bcc_unit_cell()),
                                   functional_factory(preset_expressions[0], sheet, 0))});
  kinds.push_back({"combined", "BCC or foam", 0.1, 1,
                   boolean_factory(Operation::united, lattice_factory(bcc_unit_cell()),
                                   foam_factory(FoamMethod::direct, 1))});
  kinds.push_back({"combined", "foam and octet", 0.2, 1,
                   boolean_factory(Operation::intersected, foam_factory(FoamMethod::direct, 1),
                                   lattice_factory(octet_unit_cell()))});
  kinds.push_back(
      {"combined", "gyroid without foam", 0.2, 1,
       boolean_factory(Operation::subtracted, functional_factory(preset_expressions[0], network, 0),
                       foam_factory(FoamMethod::direct, 1))});
  kinds.push_back({"combined", "walls without struts", 0.1, 1,
                   boolean_factory(Operation::subtracted, walls_factory(1),
                                   lattice_factory(cubic_unit_cell()))});
  kinds.push_back(
      {"combined", "plates or walls", 0.1, 1,
       boolean_factory(Operation::united, plates_factory(cubic_plate_cell()), walls_factory(1))});
  kinds.push_back({"combined", "walls without plates", 0.15, 1,
                   boolean_factory(Operation::subtracted, walls_factory(1),
                                   plates_factory(cubic_plate_cell()))});
  kinds.push_back(holding_beams({"combined", "nested", 0.1, 1, nested_factory()}));
  kinds.push_back({"blended", "BCC to gyroid", 0.15, 1,
                   blend_factory(lattice_factory(bcc_unit_cell()),
                                 functional_factory(preset_expressions[0], sheet, 0), 0, 1)});
  kinds.push_back({"blended", "foam to octet", 0.12, 1,
                   blend_factory(foam_factory(FoamMethod::direct, 1),
                                 lattice_factory(octet_unit_cell()), 0, 1)});
  kinds.push_back(holding_beams(
      {"blended", "walls to beams", 0.15, 1,
       blend_factory(walls_factory(1), beams_factory(BeamSort::capsules), 0.2, 0.7)}));
  kinds.push_back({"blended", "gyroid to diamond", 0.2, 1,
                   blend_factory(functional_factory(preset_expressions[0], network, 0),
                                 functional_factory(preset_expressions[2], network, 0), 0.1, 1)});
  kinds.push_back({"blended", "waves to octet", 0.15, 1,
                   blend_factory(waves_factory(WavesKind::sheet, 15),
                                 lattice_factory(octet_unit_cell()), 0.2, 1)});
  kinds.push_back(holding_beams(
      {"blended", "nested", 0.12, 1,
       blend_factory(blend_factory(lattice_factory(cubic_unit_cell()),
                                   foam_factory(FoamMethod::direct, 1), 0.3, 0.6),
                     boolean_factory(Operation::united, lattice_factory(bcc_unit_cell()),
                                     beams_factory(BeamSort::cones)),
                     0, 1)}));
  kinds.push_back({"blended", "plates to walls", 0.15, 1,
                   blend_factory(plates_factory(cubic_plate_cell()), walls_factory(1), 0.2, 0.8)});
  kinds.push_back({"smooth", "plates or walls", 0.1, 1,
                   smooth_factory(Operation::united, plates_factory(cubic_plate_cell()),
                                  walls_factory(1), 0.05, 0.1)});
  kinds.push_back({"smooth", "BCC or gyroid", 0.12, 1,
                   smooth_factory(Operation::united, lattice_factory(bcc_unit_cell()),
                                  functional_factory(preset_expressions[0], sheet, 0), 0.3, 0.3)});
  kinds.push_back({"smooth", "foam or walls", 0.1, 1,
                   smooth_factory(Operation::united, foam_factory(FoamMethod::direct, 1),
                                  walls_factory(1), 0, 0.5)});
  kinds.push_back(
      {"smooth", "gyroid without octet", 0.2, 1,
       smooth_factory(Operation::subtracted, functional_factory(preset_expressions[0], network, 0),
                      lattice_factory(octet_unit_cell()), 0.1, 0.1)});
  kinds.push_back(holding_beams(
      {"smooth", "diamond and beams", 0.2, 1,
       smooth_factory(Operation::intersected, functional_factory(preset_expressions[2], network, 0),
                      beams_factory(BeamSort::all), 0.1, 0.3)}));
  kinds.push_back({"smooth", "cubic or waves", 0.1, 1,
                   smooth_factory(Operation::united, lattice_factory(cubic_unit_cell()),
                                  waves_factory(WavesKind::sheet, 15), 0.2, 0.2)});
  kinds.push_back(holding_beams(
      {"smooth", "nested", 0.12, 1,
       smooth_factory(Operation::united,
                      smooth_factory(Operation::intersected, lattice_factory(cubic_unit_cell()),
                                     foam_factory(FoamMethod::direct, 1), 0.05, 0.05),
                      blend_factory(lattice_factory(bcc_unit_cell()),
                                    beams_factory(BeamSort::cones), 0.2, 0.8),
                      0.4, 0.2)}));
  // Fields that are not linear.
  kinds.push_back({"BCC", "mapped radius", 0.15, 1, lattice_factory(bcc_unit_cell()), mapped});
  kinds.push_back({"functional", "gyroid, sampled level", 0.2, 1,
                   functional_factory(preset_expressions[0], network, 0), sampled_field});
  kinds.push_back({"foam DIRECT", "sampled radius 0.1", 0.1, 1, foam_factory(FoamMethod::direct, 1),
                   sampled_field});
  kinds.push_back({"foam walls", "sampled thickness 0.1", 0.1, 1, walls_factory(1), sampled_field});
  return kinds;
}

}  // namespace

std::vector<GridVariant> grid_variants(bool is_lattice) {
  const Vec3 uneven = is_lattice ? Vec3{1.25, 0.75, 1} : Vec3{1, 1, 0.5};
  const double c = std::cos(0.7), s = std::sin(0.7), d = std::cos(-1.1), t = std::sin(-1.1);
  const Rotation skew{{c, -s * d, s * t, s, c * d, -c * t, 0, t, d}};
  const Rotation quarter{{0, -1, 0, 1, 0, 0, 0, 0, 1}};
  return {{"", {}, true},
          {"uneven cells", {{0.5, -0.25, 0.125}, uneven, {}}, true},
          {"turned", {{0.3, 0.2, -0.7}, {2.5, 2.5, 2.5}, skew}, false},
          {"uneven, quarter turn", {{0, 1, 0}, uneven * 4.0, quarter}, true}};
}

std::vector<StructureRow> structures() {
  std::vector<StructureRow> rows;
  size_t number = 0;  // of the kind
  for (const Kind& kind : kinds()) {
    std::vector<GridVariant> variants =
        grid_variants(kind.family.find("foam") == std::string::npos);
    // The second structure is on a turned grid in any case.
    if (kind.family == "blended" || kind.family == "smooth")
      std::erase_if(variants, [](const GridVariant& v) {
        return v.name.find("uneven") != std::string::npos;
      });
    // Rows of functional structures are found in other ways if they lie along the axis or across
    // it.
    if (kind.family == "warped") {
      variants.push_back(
          {"axis along x", {{0, 0.5, 0}, {1, 1, 1}, {{0, 0, 1, 1, 0, 0, 0, 1, 0}}}, true});
      variants.push_back(
          {"axis along y", {{0, 0.5, 0}, {1, 1, 1}, {{0, 1, 0, 0, 0, 1, 1, 0, 0}}}, true});
    }
    // Slow builds take one grid for each kind, all grids in turn.
    if (test_scale() < 0.05) variants = {variants[number % variants.size()]};
    ++number;
    for (const GridVariant& variant : variants)
      for (bool is_graded : {false, true})
        rows.push_back({kind.family + ", " + kind.name +
                            (variant.name.empty() ? "" : ", " + variant.name) +
                            (is_graded ? ", graded" : ""),
                        kind, variant, is_graded, 0, 0});
  }
  for (StructureRow& row : rows)
    for (const StructureRow& other : rows)
      if (other.kind.family == row.kind.family) {
        if (&other < &row) ++row.index;
        ++row.family_rows;
      }
  return rows;
}

std::vector<StructureRow> structures_by_point() {
  std::vector<StructureRow> rows;
  for (const StructureRow& row : structures())
    if (row.is_lattice() || row.kind.family == "foam DIRECT" || row.kind.family == "foam walls" ||
        row.kind.family == "foam stretched" || row.kind.family == "foam weighted" ||
        row.kind.family == "foam placed" || row.kind.family == "warped foam")
      rows.push_back(row);
  return rows;
}

bool may_differ(const StructureRow& row, Vec3 centre, Vec3 p) {
  if (!row.is_method_2() || row.kind.jitter >= 0.01) return false;
  const double near = 1e-9 * row.unit();
  return !row.make(centre, -near)->inside(p) && row.make(centre, near)->inside(p);
}

}  // namespace msq::test
