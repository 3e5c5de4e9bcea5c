// SPDX-License-Identifier: Apache-2.0
// The kinds of structures that scenarios go through.
#include <algorithm>
#include <cmath>
#include <optional>

#include "world.h"

namespace msq::test {

namespace {

MakeStructure lattice(World& world, int32_t unit_cell, msq_param radius) {
  msq_lattice_def def = make_def(msq_lattice_def_init);
  def.unit_cell = unit_cell;
  def.radius = radius;
  def.clusters = 3;
  return [&world, def](msq_structure** made) {
    return msq_structure_lattice(world.context, &def, made);
  };
}

MakeStructure mixed_lattice(World& world) {
  static const double factors[12] = {1, 0.5, 1.5, 1, 0.5, 1.5, 1, 0.5, 1.5, 1, 0.5, 1.5};
  static msq_unit_cell_def cells[2];
  for (msq_unit_cell_def& cell : cells) cell = make_def(msq_unit_cell_def_init);
  cells[1].unit_cell = MSQ_UNIT_CELL_CUBIC;
  cells[1].strut_factors = factors;
  cells[1].strut_count = 12;
  msq_lattice_def def = make_def(msq_lattice_def_init);
  def.cells = cells;
  def.cell_count = 2;
  def.cell_choice.field = world.gradient();
  def.radius.value = 0.12;
  return [&world, def](msq_structure** made) {
    return msq_structure_lattice(world.context, &def, made);
  };
}

MakeStructure beams(World& world) {
  static const double nodes[12] = {0.1, 0.2, 0.3, 0.9, 0.8, 0.4, 0.3, 0.9, 0.8, 0.7, 0.1, 0.9};
  static const uint32_t pairs[8] = {0, 1, 1, 2, 2, 3, 3, 0};
  static const double radii[8] = {0.1, 0.05, 0.05, 0.12, 0.12, 0.1, 0.1, 0.1};
  msq_beams_def def = make_def(msq_beams_def_init);
  def.nodes = nodes;
  def.node_count = 4;
  def.beams = pairs;
  def.beam_count = 4;
  def.radii = radii;
  return [&world, def](msq_structure** made) {
    return msq_structure_beams(world.context, &def, made, nullptr);
  };
}

MakeStructure waves(World& world) {
  msq_waves_def def = make_def(msq_waves_def_init);
  def.count = 20;
  def.level.field = world.gradient();
  return [&world, def](msq_structure** made) {
    return msq_structure_waves(world.context, &def, made);
  };
}

MakeStructure plate_lattice(World& world, double radius_of_struts) {
  msq_plate_lattice_def def = make_def(msq_plate_lattice_def_init);
  def.plate_cell = MSQ_PLATE_CELL_FCC;
  def.thickness.field = world.gradient();
  def.radius.value = radius_of_struts;
  return [&world, def](msq_structure** made) {
    return msq_structure_plate_lattice(world.context, &def, made);
  };
}

MakeStructure foam(World& world, int32_t method, msq_param radius, msq_param density = {1, nullptr},
                   double cell_height = 1);

/// Of a lattice to a foam.
MakeStructure blend(World& world) {
  msq_structure *a, *b;
  require_ok(lattice(world, MSQ_UNIT_CELL_BCC, {0.2, nullptr})(&a));
  world.keep(a);
  require_ok(foam(world, MSQ_FOAM_AUTO, {0.2, nullptr})(&b));
  world.keep(b);
  const msq_field* fraction = world.gradient();
  return [a, b, fraction](msq_structure** made) {
    const msq_param part = {0, fraction};
    return msq_structure_blend(a, b, &part, made);
  };
}

/// Of a lattice and beams.
MakeStructure smooth(World& world, int32_t operation) {
  msq_structure *a, *b;
  require_ok(lattice(world, MSQ_UNIT_CELL_BCC, {0.2, nullptr})(&a));
  world.keep(a);
  require_ok(beams(world)(&b));
  world.keep(b);
  return [a, b, operation](msq_structure** made) {
    const msq_param radius = {0.2, nullptr};
    return msq_structure_smooth_boolean(operation, a, b, &radius, made);
  };
}

/// A lattice, a foam and beams.
MakeStructure boolean(World& world, int32_t operation) {
  std::vector<msq_structure*> members(3);
  require_ok(lattice(world, MSQ_UNIT_CELL_BCC, {0.2, nullptr})(&members[0]));
  world.keep(members[0]);
  require_ok(foam(world, MSQ_FOAM_AUTO, {0.15, nullptr})(&members[1]));
  world.keep(members[1]);
  require_ok(beams(world)(&members[2]));
  world.keep(members[2]);
  return [members, operation](msq_structure** made) {
    return msq_structure_boolean(operation, members.data(), members.size(), made);
  };
}

MakeStructure foam(World& world, int32_t method, msq_param radius, msq_param density,
                   double cell_height) {
  msq_foam_def def = make_def(msq_foam_def_init);
  def.method = method;
  def.radius = radius;
  def.density = density;
  def.seed = 5;
  def.grid.cell_size[2] = cell_height;
  return
      [&world, def](msq_structure** made) { return msq_structure_foam(world.context, &def, made); };
}

MakeStructure closed_foam(World& world, double radius, double thickness, double vent_radius = 0) {
  msq_foam_def def = make_def(msq_foam_def_init);
  def.radius.value = radius;
  def.wall_thickness.value = thickness;
  def.vent_radius.value = vent_radius;
  return
      [&world, def](msq_structure** made) { return msq_structure_foam(world.context, &def, made); };
}

MakeStructure graded_foam(World& world, msq_param radius) {
  const double from[3] = {0, 0, 0}, to[3] = {4, 1, 0};
  msq_field* density;
  require_ok(msq_field_gradient(world.context, from, 1, to, 12, &density));
  return foam(world, MSQ_FOAM_AUTO, radius, {1, world.keep(density)});
}

MakeStructure functional(World& world, int32_t function, int32_t kind, msq_param level,
                         double thickness, bool is_turned) {
  static const msq_named_value parameter = {"a", 0.75};
  msq_functional_def def = make_def(msq_functional_def_init);
  def.function = function;
  def.kind = kind;
  def.clusters = 4;
  def.level = level;
  def.thickness.value = thickness;
  if (function == MSQ_FUNCTION_EXPRESSION) {
    def.expression = "sin(x) * cos(y) + a * max(sin(y) * cos(z), sin(z) * cos(x))^2";
    def.parameters = &parameter;
    def.parameter_count = 1;
  }
  if (is_turned) {
    const double turned[9] = {0.8, -0.6, 0, 0.6, 0.8, 0, 0, 0, 1};
    std::copy_n(turned, 9, def.grid.rotation);
  }
  return [&world, def](msq_structure** made) {
    return msq_structure_functional(world.context, &def, made);
  };
}

MakeStructure stretched_foam(World& world, double radius, double thickness) {
  msq_foam_def def = make_def(msq_foam_def_init);
  def.radius.value = radius;
  def.wall_thickness.value = thickness;
  def.stretch[1] = 2;
  return
      [&world, def](msq_structure** made) { return msq_structure_foam(world.context, &def, made); };
}

/// Cells from 1 to 0.7 along z.
msq_period_def graded_period() {
  static const double positions[2] = {0, 4}, sizes[2] = {1, 0.7};
  msq_period_def def = make_def(msq_period_def_init);
  def.positions = positions;
  def.cell_sizes = sizes;
  def.count = 2;
  return def;
}

/// Cells around the z axis.
msq_warp_def cylinder() {
  msq_warp_def def = make_def(msq_warp_def_init);
  def.count = 12;
  def.inner_radius = 0.5;
  def.outer_radius = 5.5;
  def.shear_along = 0.25;
  return def;
}

msq_warp_def foam_shell() {
  msq_warp_def def = cylinder();
  def.outer_radius = def.inner_radius + 1;
  def.shear_along = 0;
  return def;
}

/// A period, a warp, or none of them.
struct Places {
  std::optional<msq_period_def> period;
  std::optional<msq_warp_def> warp;

  template <class Def>
  Def placed(Def def) const {
    if (period) def.period = &*period;
    if (warp) def.warp = &*warp;
    return def;
  }
};

MakeStructure placed_lattice(World& world, Places places) {
  return [&world, places](msq_structure** made) {
    auto def = places.placed(make_def(msq_lattice_def_init));
    def.radius.value = 0.12;
    return msq_structure_lattice(world.context, &def, made);
  };
}

MakeStructure placed_foam(World& world, Places places, double radius, double thickness) {
  return [=, &world](msq_structure** made) {
    auto def = places.placed(make_def(msq_foam_def_init));
    def.radius.value = radius;
    def.wall_thickness.value = thickness;
    return msq_structure_foam(world.context, &def, made);
  };
}

/// Of cells by a map.
MakeStructure sampled_foam(World& world, double radius, double thickness) {
  return [=, &world](msq_structure** made) {
    constexpr uint64_t side = 4;
    msq_field* fields[3] = {};
    msq_status status = MSQ_OK;
    for (int axis = 0; axis < 3 && status == MSQ_OK; ++axis) {
      double values[side * side * side];
      for (uint64_t i = 0; i < side * side * side; ++i) {
        const uint64_t at[3] = {i % side, i / side % side, i / side / side};
        values[i] = static_cast<double>(at[axis]) * 1.25;
      }
      msq_grid_field_def def = make_def(msq_grid_field_def_init);
      def.image.values = values;
      def.image.value_type = MSQ_FLOAT64;
      for (uint64_t& size : def.image.size) size = side;
      status = msq_field_grid(world.context, &def, &fields[axis]);
    }
    msq_warp_def warp = make_def(msq_warp_def_init);
    warp.kind = MSQ_WARP_SAMPLED;
    warp.u = fields[0];
    warp.v = fields[1];
    warp.w = fields[2];
    if (status == MSQ_OK) {
      msq_foam_def def = make_def(msq_foam_def_init);
      def.radius.value = radius;
      def.wall_thickness.value = thickness;
      def.warp = &warp;
      status = msq_structure_foam(world.context, &def, made);
    }
    for (msq_field* field : fields) msq_field_release(field);
    return status;
  };
}

MakeStructure placed_gyroid(World& world, Places places) {
  return [&world, places](msq_structure** made) {
    auto def = places.placed(make_def(msq_functional_def_init));
    def.clusters = 4;
    def.level.value = 0.1;
    return msq_structure_functional(world.context, &def, made);
  };
}

bool host_has(const double* position) {
  double squared = 0;
  for (int axis = 0; axis < 3; ++axis) squared += (position[axis] - 0.5) * (position[axis] - 0.5);
  return squared >= 0.16;
}

int32_t structure_inside(void*, const msq_host_points* points, uint8_t* inside) {
  for (uint64_t i = 0; i < points->count; ++i) inside[i] = host_has(points->positions + 3 * i);
  return 0;
}

int32_t structure_distance(void*, const msq_host_points* points, double* distances) {
  for (uint64_t i = 0; i < points->count; ++i) {
    double squared = 0;
    for (int axis = 0; axis < 3; ++axis)
      squared += std::pow(points->positions[3 * i + static_cast<uint64_t>(axis)] - 0.5, 2);
    distances[i] = std::abs(std::sqrt(squared) - 0.4);
  }
  return 0;
}

int32_t build_cell(void*, const int32_t cell[3], void** data, uint64_t* bytes) {
  static int32_t something;
  something = cell[0];
  *data = &something;
  *bytes = 64;
  return 0;
}

int32_t evaluate_cell(void*, const void*, const msq_host_points* points, uint8_t* inside) {
  return structure_inside(nullptr, points, inside);
}

MakeStructure host_structure(World& world, bool has_cells) {
  msq_host_structure_def def = make_def(msq_host_structure_def_init);
  if (has_cells) {
    def.build_cell = build_cell;
    def.evaluate_cell = evaluate_cell;
  } else {
    def.inside = structure_inside;
    def.distance = structure_distance;
  }
  return
      [&world, def](msq_structure** made) { return msq_structure_host(world.context, &def, made); };
}

int32_t host_function(void*, const double* angles, uint64_t count, double* values) {
  for (uint64_t i = 0; i < count; ++i)
    values[i] = std::cos(angles[3 * i]) + std::cos(angles[3 * i + 1]) + std::cos(angles[3 * i + 2]);
  return 0;
}

MakeStructure host_functional(World& world) {
  msq_host_function_def def = make_def(msq_host_function_def_init);
  def.clusters = 4;
  def.level.value = 0.2;
  def.evaluate = host_function;
  def.lipschitz = 1.8;
  return [&world, def](msq_structure** made) {
    return msq_structure_host_function(world.context, &def, made);
  };
}

}  // namespace

msq_structure* Kind::make(World& world) const {
  msq_structure* structure;
  require_ok(prepare(world)(&structure));
  return world.keep(structure);
}

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> kinds = [] {
    const msq_param constant = {0.15, nullptr};
    std::vector<Kind> all = {
        {"lattice", [=](World& w) { return lattice(w, MSQ_UNIT_CELL_BCC, constant); }},
        {"lattice of graded radius",
         [](World& w) {
           return lattice(w, MSQ_UNIT_CELL_CUBIC, {0, w.gradient()});
         }},
        {"lattice of the host's radius",
         [](World& w) {
           return lattice(w, MSQ_UNIT_CELL_CUBIC, {0, w.host_field()});
         }},
        {"mixed lattice", mixed_lattice, false},
        {"foam", [=](World& w) { return foam(w, MSQ_FOAM_AUTO, constant); }},
        {"foam of walls", [=](World& w) { return closed_foam(w, 0, 0.1); }},
        {"foam of walls with holes", [=](World& w) { return closed_foam(w, 0, 0.1, 0.2); }},
        {"foam of struts and walls", [=](World& w) { return closed_foam(w, 0.2, 0.1); }, false},
        {"foam of flat cells",
         [=](World& w) {
           return foam(w, MSQ_FOAM_AUTO, constant, {1, nullptr}, 0.5);
         }},
        {"foam of graded radius",
         [](World& w) {
           return foam(w, MSQ_FOAM_AUTO, {0, w.gradient()});
         }},
        {"foam of an expression's radius",
         [](World& w) {
           return foam(w, MSQ_FOAM_AUTO, {0, w.expression()});
         }},
        {"graded foam",
         [=](World& w) {
           return graded_foam(w, {0.06, nullptr});
         }},
        {"graded foam of graded radius",
         [](World& w) {
           return graded_foam(w, {0, w.gradient()});
         }},
        {"foam by points", [=](World& w) { return foam(w, MSQ_FOAM_POINT, constant); }, true, false,
         true},
        {"foam by method 1", [=](World& w) { return foam(w, MSQ_FOAM_METHOD_1, constant); }},
        {"gyroid",
         [](World& w) {
           return functional(w, MSQ_FUNCTION_GYROID, MSQ_FUNCTIONAL_NETWORK, {0.1, nullptr}, 0,
                             false);
         }},
        {"gyroid of graded level",
         [](World& w) {
           return functional(w, MSQ_FUNCTION_GYROID, MSQ_FUNCTIONAL_SHEET, {0, w.gradient()}, 0,
                             false);
         }},
        {"turned sheet of a thickness",
         [](World& w) {
           return functional(w, MSQ_FUNCTION_SCHWARZ_P, MSQ_FUNCTIONAL_SHEET, {0, nullptr}, 0.2,
                             true);
         }},
        {"expression",
         [](World& w) {
           return functional(w, MSQ_FUNCTION_EXPRESSION, MSQ_FUNCTIONAL_NETWORK,
                             {0, w.expression()}, 0, false);
         }},
        {"turned expression",
         [](World& w) {
           return functional(w, MSQ_FUNCTION_EXPRESSION, MSQ_FUNCTIONAL_NETWORK, {0.1, nullptr}, 0,
                             true);
         }},
        {"host structure", [](World& w) { return host_structure(w, false); }, false},
        {"host structure with cells", [](World& w) { return host_structure(w, true); }, false},
        {"waves", waves},
        {"plate lattice", [](World& w) { return plate_lattice(w, 0); }},
        {"plates and struts", [](World& w) { return plate_lattice(w, 0.1); }, false},
        {"beams", beams, false},
        {"host function", host_functional, false},
        {"union", [](World& w) { return boolean(w, MSQ_BOOLEAN_UNION); }, false},
        {"difference", [](World& w) { return boolean(w, MSQ_BOOLEAN_DIFFERENCE); }, false},
        {"blend", blend, false},
        {"smooth union", [](World& w) { return smooth(w, MSQ_BOOLEAN_UNION); }, false},
        {"smooth difference", [](World& w) { return smooth(w, MSQ_BOOLEAN_DIFFERENCE); }, false},
        {"stretched foam", [](World& w) { return stretched_foam(w, 0.15, 0); }},
        {"stretched walls", [](World& w) { return stretched_foam(w, 0, 0.1); }},
        {"lattice of graded period",
         [](World& w) {
           return placed_lattice(w, {graded_period(), {}});
         }},
        {"foam of graded period",
         [](World& w) {
           return placed_foam(w, {graded_period(), {}}, 0.15, 0);
         }},
        {"walls of graded period",
         [](World& w) {
           return placed_foam(w, {graded_period(), {}}, 0, 0.1);
         }},
        {"gyroid of graded period",
         [](World& w) {
           return placed_gyroid(w, {graded_period(), {}});
         }},
        {"warped foam",
         [](World& w) {
           return placed_foam(w, {{}, foam_shell()}, 0.15, 0);
         }},
        {"warped walls",
         [](World& w) {
           return placed_foam(w, {{}, foam_shell()}, 0, 0.1);
         }},
        {"sampled foam", [](World& w) { return sampled_foam(w, 0.15, 0); }},
        {"sampled walls", [](World& w) { return sampled_foam(w, 0, 0.1); }},
        {"warped lattice",
         [](World& w) {
           return placed_lattice(w, {{}, cylinder()});
         }},
        {"warped gyroid",
         [](World& w) {
           return placed_gyroid(w, {{}, cylinder()});
         }},
    };
#if MSQ_WITH_CGAL
    all.push_back(
        {"foam by method 2", [=](World& w) { return foam(w, MSQ_FOAM_METHOD_2, constant); }});
    all.back().is_cgal = true;
#endif
    return all;
  }();
  return kinds;
}

}  // namespace msq::test
