// SPDX-License-Identifier: Apache-2.0
// Structures of all kinds.
#include <cmath>
#include <iterator>

#include "objects.h"

namespace msq::fuzz {

namespace {

constexpr const char* expressions[] = {"x",
                                       "sin(x)*cos(y)+z",
                                       "x*x+y*y-z",
                                       "abs(x-pi)+abs(y-pi)-1",
                                       "min(x,max(y,z))-3",
                                       "1/(x-3)",
                                       "log(x-1)",
                                       "floor(x)+mod(y,2)-z",
                                       "select(x<y,z,1-x)",
                                       "atan2(y-3,x-3)",
                                       "sqrt(x-2)",
                                       "hypot(x-3,y-3)-2",
                                       "tanh(z-3)*a",
                                       "exp(-x)*y^3-a",
                                       "(x>y)-0.5",
                                       "0",
                                       "x^0.5-y^-2",
                                       "round(x/2)-1",
                                       "ceil(z)-cos(3*x)",
                                       "sin(x)^2+cos(x)^2-1"};

int32_t cosine_values(void*, const double* angles, uint64_t count, double* values) {
  for (uint64_t i = 0; i < count; ++i, angles += 3)
    values[i] = std::cos(angles[0]) + std::cos(angles[1]) - std::sin(angles[2]);
  return 0;
}
int32_t slab_inside(void*, const msq_host_points* points, uint8_t* inside) {
  for (uint64_t i = 0; i < points->count; ++i) {
    const double* p = points->positions + 3 * i;
    inside[i] = p[0] <= p[1] || (points->cells[3 * i + 2] & 1) != 0;
  }
  return 0;
}

}  // namespace

const char* Maker::formula() {
  return expressions[input_.below(std::size(expressions))];
}

const msq_period_def* Maker::grade(Period& period) {
  msq_period_def& def = period.def = make_def(msq_period_def_init);
  def.axis = static_cast<int32_t>(input_.below(3));
  def.count = 1 + input_.below(5);
  double at = sight_.unit * input_.number(-2, 0);
  for (uint64_t i = 0; i < def.count; ++i) {
    period.positions[i] = at;
    period.sizes[i] = sight_.unit * input_.number(0.4, 2);
    at += sight_.unit * input_.number(0.1, 1.5);
  }
  def.positions = period.positions;
  def.cell_sizes = period.sizes;
  return &def;
}

Owner<msq_structure> Maker::lattice() {
  msq_lattice_def def = make_def(msq_lattice_def_init);
  def.grid = grid();
  def.unit_cell = static_cast<int32_t>(input_.below(9));
  def.radius = param(0.02 * sight_.unit, 0.35 * sight_.unit);
  if (input_.chance(80)) def.clusters = input_.below(66);
  std::vector<double> nodes, factors;
  std::vector<uint32_t> struts;
  std::vector<msq_unit_cell_def> cells;
  const auto fill = [&](auto* cell) {
    const uint32_t count = 2 + input_.below(6);
    const size_t first = nodes.size();
    for (uint32_t i = 0; i < 3 * count; ++i)
      nodes.push_back(input_.chance(100) ? 0.5 * input_.below(3) : input_.number(0, 1));
    const size_t first_strut = struts.size();
    for (uint32_t i = 1 + input_.below(8); i > 0; --i) {
      const uint32_t a = input_.below(count);
      struts.push_back(a);
      struts.push_back(input_.chance(2) ? input_.below(count)
                                        : (a + 1 + input_.below(count - 1)) % count);
    }
    cell->unit_cell = MSQ_UNIT_CELL_CUSTOM;
    cell->node_count = count;
    cell->strut_count = (struts.size() - first_strut) / 2;
    if (input_.chance(60)) {
      for (uint64_t i = 0; i < cell->strut_count; ++i) factors.push_back(input_.number(0.3, 2));
      cell->strut_factors = factors.data() + (factors.size() - cell->strut_count);
    }
    cell->nodes = nodes.data() + first;
    cell->struts = struts.data() + first_strut;
  };
  // No array may move.
  nodes.reserve(256);
  factors.reserve(256);
  struts.reserve(256);
  if (def.unit_cell == MSQ_UNIT_CELL_CUSTOM) fill(&def);
  Period period;
  msq_warp_def warp = make_def(msq_warp_def_init);
  if (input_.chance(80)) def.period = grade(period);
  if (input_.chance(80)) {
    warp.count = 2 + input_.below(30);
    if (input_.chance(100)) {
      warp.kind = MSQ_WARP_SPHERICAL;
      warp.count_polar = 1 + input_.below(16);
    }
    warp.inner_radius = input_.number(0, 3) * sight_.unit;
    if (input_.chance(100))
      warp.outer_radius = warp.inner_radius + input_.number(0, 6) * sight_.unit;
    if (warp.kind == MSQ_WARP_CYLINDRICAL && input_.chance(100)) {
      warp.shear_outwards = input_.number(-2, 2);
      warp.shear_along = input_.number(-2, 2);
    }
    if (input_.chance(80)) sample(warp);
    def.warp = &warp;
  }
  if (input_.chance(50)) {
    for (uint32_t count = 1 + input_.below(4); count > 0; --count) {
      cells.push_back(make_def(msq_unit_cell_def_init));
      cells.back().unit_cell = static_cast<int32_t>(input_.below(9));
      if (cells.back().unit_cell == MSQ_UNIT_CELL_CUSTOM) fill(&cells.back());
    }
    def.cells = cells.data();
    def.cell_count = static_cast<uint32_t>(cells.size());
    def.cell_choice = param(-0.5, static_cast<double>(cells.size()));
  }
  return make<msq_structure>("msq_structure_lattice", [&](msq_structure** s) {
    return msq_structure_lattice(context_, &def, s);
  });
}

Owner<msq_structure> Maker::foam() {
  msq_foam_def def = make_def(msq_foam_def_init);
  def.grid = grid();
  def.method = input_.chance(100) ? static_cast<int32_t>(input_.below(6)) : MSQ_FOAM_AUTO;
  def.jitter = input_.chance(64) ? input_.number(0, 1) : 1;
  // METHOD_2 may differ from the point query there, by its definition.
  if (def.method == MSQ_FOAM_METHOD_2 && def.jitter < 0.01) def.jitter = 0.01;
  def.seed = input_.word(2);
  if (input_.chance(80)) def.wall_thickness = param(0.02 * sight_.unit, 0.3 * sight_.unit);
  if (input_.chance(40)) def.vent_radius = param(0.05 * sight_.unit, 0.3 * sight_.unit);
  if (input_.chance(200)) def.radius = param(0.02 * sight_.unit, 0.3 * sight_.unit);
  if (input_.chance(40)) {
    def.density = param(0.5, 9);
    // More is dear, not different.
    if (!def.density.field && def.density.value > 60) def.density.value = 60;
  }
  if (input_.chance(30))
    for (double& factor : def.stretch) factor = input_.number(0.3, 4);
  if (input_.chance(30)) def.weight = input_.number(0, 1.5);
  Period period;
  if (input_.chance(40)) def.period = grade(period);
  msq_warp_def warp = make_def(msq_warp_def_init);
  if (input_.chance(50)) {
    warp.count = 2 + input_.below(40);
    warp.inner_radius = input_.number(0.3, 4) * sight_.unit;
    warp.outer_radius = warp.inner_radius + input_.number(0, 4) * sight_.unit;
    if (input_.chance(60)) {
      warp.kind = MSQ_WARP_SPHERICAL;
      warp.count_polar = 2 + input_.below(20);
    } else if (input_.chance(60)) {
      warp.shear_outwards = input_.number(-2, 2);
      warp.shear_along = input_.number(-2, 2);
    }
    if (input_.chance(80)) sample(warp);
    def.warp = &warp;
  }
  return make<msq_structure>("msq_structure_foam", [&](msq_structure** s) {
    return msq_structure_foam(context_, &def, s);
  });
}

Owner<msq_structure> Maker::functional() {
  is_rough();
  msq_functional_def def = make_def(msq_functional_def_init);
  def.grid = grid();
  def.kind = 1 + static_cast<int32_t>(input_.below(2));
  def.function = static_cast<int32_t>(input_.below(20));
  if (input_.chance(80)) def.clusters = input_.below(66);
  const msq_named_value parameter = {"a", input_.number(-2, 2)};
  if (def.function == MSQ_FUNCTION_EXPRESSION || def.function > 18) {
    def.function = MSQ_FUNCTION_EXPRESSION;
    def.expression = formula();
    def.parameters = &parameter;
    def.parameter_count = 1;
  }
  if (def.kind == MSQ_FUNCTIONAL_SHEET && input_.chance(100))
    def.thickness = param(0.02 * sight_.unit, 0.4 * sight_.unit);
  else
    def.level = param(def.kind == MSQ_FUNCTIONAL_SHEET ? 0.01 : -1, 1);
  Period period;
  if (input_.chance(60)) def.period = grade(period);
  msq_warp_def warp = make_def(msq_warp_def_init);
  if (input_.chance(60)) {
    warp.kind = 1 + static_cast<int32_t>(input_.below(2));
    warp.count = 1 + static_cast<uint32_t>(input_.below(40));
    warp.count_polar = warp.kind == MSQ_WARP_SPHERICAL ? warp.count : 0;
    warp.inner_radius = input_.chance(128) ? sight_.unit * input_.number(0, 2) : 0;
    warp.outer_radius = input_.chance(128) ? sight_.unit * input_.number(2, 5) : 0;
    if (warp.kind == MSQ_WARP_CYLINDRICAL && input_.chance(100)) {
      warp.shear_outwards = input_.number(-2, 2);
      warp.shear_along = input_.number(-2, 2);
    }
    if (input_.chance(80)) sample(warp);
    def.warp = &warp;
  }
  return make<msq_structure>("msq_structure_functional", [&](msq_structure** s) {
    return msq_structure_functional(context_, &def, s);
  });
}

void Maker::sample(msq_warp_def& warp) {
  is_rough();
  warp = make_def(msq_warp_def_init);
  warp.kind = MSQ_WARP_SAMPLED;
  msq_grid_field_def def = make_def(msq_grid_field_def_init);
  uint64_t count = 1;
  double spacing[3];
  for (int axis = 0; axis < 3; ++axis) {
    def.image.size[axis] = 2 + input_.below(4);
    count *= def.image.size[axis];
    spacing[axis] = input_.number(0.3, 2);
    def.image.grid.cell_size[axis] = spacing[axis] * sight_.unit;
    def.image.grid.origin[axis] = coordinate(axis, 3);
  }
  def.image.value_type = MSQ_FLOAT64;
  // Sheared cells whose corners are displaced; large displacements fold.
  const double shear = input_.number(-0.5, 0.5), most = input_.chance(30) ? 0.6 : 0.1;
  const double shift = input_.number(-3, 3);
  const msq_field** const fields[3] = {&warp.u, &warp.v, &warp.w};
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (uint64_t i = 0; i < count; ++i) {
      const uint64_t at[3] = {i % def.image.size[0], i / def.image.size[0] % def.image.size[1],
                              i / def.image.size[0] / def.image.size[1]};
      const int other = (axis + 1) % 3;
      values.push_back(shift + static_cast<double>(at[axis]) * spacing[axis] +
                       shear * static_cast<double>(at[other]) * spacing[other] +
                       input_.number(-most, most));
    }
    def.image.values = values.data();
    Owner<msq_field> made = make<msq_field>(
        "msq_field_grid", [&](msq_field** f) { return msq_field_grid(context_, &def, f); });
    if (!made) return;  // the warp lacks a field and is refused
    *fields[axis] = made.get();
    fields_.push_back(std::move(made));
  }
}

Owner<msq_structure> Maker::beams() {
  is_rough();
  msq_beams_def def = make_def(msq_beams_def_init);
  std::vector<double> nodes, radii, ball_radii;
  std::vector<uint32_t> ends, balls;
  std::vector<uint8_t> caps;
  const uint32_t count = 2 + input_.below(8);
  for (uint32_t i = 0; i < 3 * count; ++i) nodes.push_back(coordinate(static_cast<int>(i % 3), 2));
  const uint32_t out = input_.chance(2) ? 1 : 0;
  for (uint32_t i = input_.below(9); i > 0; --i) {
    for (int end = 0; end < 2; ++end) {
      ends.push_back(input_.below(count + out));
      radii.push_back(sight_.unit * (input_.chance(20) ? 0 : input_.number(0.02, 0.5)));
      caps.push_back(static_cast<uint8_t>(input_.below(3 + out)));
    }
  }
  for (uint32_t i = input_.below(4); i > 0; --i) {
    balls.push_back(input_.below(count));
    ball_radii.push_back(sight_.unit * input_.number(0.05, 0.6));
  }
  def.nodes = nodes.data();
  def.node_count = count;
  def.beams = ends.data();
  def.beam_count = ends.size() / 2;
  def.balls = balls.data();
  def.ball_count = balls.size();
  def.radius = sight_.unit * input_.number(0.05, 0.4);
  def.ball_radius = sight_.unit * input_.number(0.05, 0.4);
  def.cap = static_cast<int32_t>(input_.below(3));
  if (input_.chance(128)) def.radii = radii.data();
  if (input_.chance(128)) def.caps = caps.data();
  if (input_.chance(128)) def.ball_radii = ball_radii.data();
  if (input_.chance(40)) def.min_length = sight_.unit * input_.number(0, 1);
  if (input_.chance(40)) def.length_scale = sight_.unit * input_.number(0.1, 2);
  return make<msq_structure>("msq_structure_beams", [&](msq_structure** s) {
    return msq_structure_beams(context_, &def, s, job_);
  });
}

Owner<msq_structure> Maker::host_structure() {
  is_rough();
  msq_host_structure_def def = make_def(msq_host_structure_def_init);
  def.grid = grid();
  def.inside = slab_inside;
  def.concurrent = static_cast<int32_t>(input_.below(2));
  def.hash_key[0] = 3;
  return make<msq_structure>("msq_structure_host", [&](msq_structure** s) {
    return msq_structure_host(context_, &def, s);
  });
}

Owner<msq_structure> Maker::host_function() {
  is_rough();
  msq_host_function_def def = make_def(msq_host_function_def_init);
  def.grid = grid();
  def.evaluate = cosine_values;
  def.kind = 1 + static_cast<int32_t>(input_.below(2));
  def.level = param(0.05, 1);
  def.clusters = 1 + input_.below(20);
  if (input_.chance(128)) def.lipschitz = 1.74;
  def.concurrent = static_cast<int32_t>(input_.below(2));
  return make<msq_structure>("msq_structure_host_function", [&](msq_structure** s) {
    return msq_structure_host_function(context_, &def, s);
  });
}

Owner<msq_structure> Maker::waves() {
  is_rough();
  msq_waves_def def = make_def(msq_waves_def_init);
  def.grid = grid();
  def.kind = 1 + static_cast<int32_t>(input_.below(2));
  def.seed = input_.word(2);
  def.count = 1 + input_.below(40);
  if (input_.chance(60))
    for (uint32_t& tile : def.tile) tile = input_.below(5);
  if (input_.chance(80))
    for (double& angle : def.cone_angles) angle = input_.chance(128) ? input_.number(0.1, 90) : 0;
  if (input_.chance(100))
    def.volume_fraction = input_.number(0.02, 0.98);
  else
    def.level = param(def.kind == MSQ_FUNCTIONAL_SHEET ? 0.05 : -1, 1);
  return make<msq_structure>("msq_structure_waves", [&](msq_structure** s) {
    return msq_structure_waves(context_, &def, s);
  });
}

Owner<msq_structure> Maker::plates() {
  msq_plate_lattice_def def = make_def(msq_plate_lattice_def_init);
  def.grid = grid();
  def.plate_cell = static_cast<int32_t>(input_.below(6));
  def.thickness = param(0.02 * sight_.unit, 0.4 * sight_.unit);
  std::vector<double> nodes, face_factors, strut_factors;
  std::vector<uint32_t> faces, struts;
  const auto corners_of = [&](std::vector<uint32_t>& corners, uint32_t of) {
    const uint32_t count = static_cast<uint32_t>(nodes.size() / 3), first = input_.below(count);
    for (uint32_t i = 0; i < of; ++i)
      corners.push_back(input_.chance(4) ? input_.below(count) : (first + i) % count);
  };
  if (def.plate_cell == MSQ_PLATE_CELL_CUSTOM) {
    for (uint32_t i = 3 * (3 + input_.below(4)); i > 0; --i)
      nodes.push_back(input_.chance(128) ? 0.5 * input_.below(3) : input_.number(0, 1));
    for (uint32_t i = 1 + input_.below(5); i > 0; --i) corners_of(faces, 3);
    def.nodes = nodes.data();
    def.node_count = nodes.size() / 3;
    def.faces = faces.data();
    def.face_count = faces.size() / 3;
    if (input_.chance(60)) {
      for (uint64_t i = 0; i < def.face_count; ++i) face_factors.push_back(input_.number(0.3, 2));
      def.face_factors = face_factors.data();
    }
  }
  if (input_.chance(80)) {
    def.radius = param(0.02 * sight_.unit, 0.3 * sight_.unit);
    def.unit_cell = static_cast<int32_t>(input_.below(9));
    if (def.unit_cell == MSQ_UNIT_CELL_CUSTOM && def.plate_cell == MSQ_PLATE_CELL_CUSTOM) {
      for (uint32_t i = 1 + input_.below(4); i > 0; --i) corners_of(struts, 2);
      def.struts = struts.data();
      def.strut_count = struts.size() / 2;
      if (input_.chance(60)) {
        for (uint64_t i = 0; i < def.strut_count; ++i)
          strut_factors.push_back(input_.number(0.3, 2));
        def.strut_factors = strut_factors.data();
      }
    }
  }
  return make<msq_structure>("msq_structure_plate_lattice", [&](msq_structure** s) {
    return msq_structure_plate_lattice(context_, &def, s);
  });
}

Owner<msq_structure> Maker::combined(int depth) {
  is_rough();
  const uint32_t kind = input_.below(3);
  const int32_t operation = 1 + static_cast<int32_t>(input_.below(3));
  std::vector<Owner<msq_structure>> members;
  std::vector<const msq_structure*> handles;
  for (uint32_t count = kind == 0 ? 1 + input_.below(3) : 2; count > 0; --count) {
    members.push_back(structure(depth + 1));
    handles.push_back(members.back().get());
    if (!members.back()) return nullptr;
  }
  if (kind == 0)
    return make<msq_structure>("msq_structure_boolean", [&](msq_structure** s) {
      return msq_structure_boolean(operation, handles.data(), handles.size(), s);
    });
  if (kind == 1) {
    const msq_param fraction = param(0, 1);
    return make<msq_structure>("msq_structure_blend", [&](msq_structure** s) {
      return msq_structure_blend(handles[0], handles[1], &fraction, s);
    });
  }
  const msq_param radius = param(0.02 * sight_.unit, 0.5 * sight_.unit);
  return make<msq_structure>("msq_structure_smooth_boolean", [&](msq_structure** s) {
    return msq_structure_smooth_boolean(operation, handles[0], handles[1], &radius, s);
  });
}

Owner<msq_structure> Maker::structure(int depth) {
  // The committed inputs mean what they meant before the kinds of the first switch were known.
  const uint32_t kind = input_.byte();
  if (kind >= 170) {
    switch (kind % 4) {
      case 0:
        return waves();
      case 1:
        return plates();
      default:
        return depth < 2 ? combined(depth) : plates();
    }
  }
  switch (kind % 10) {
    case 0:
    case 1:
    case 2:
      return lattice();
    case 3:
    case 4:
    case 5:
      return foam();
    case 6:
    case 7:
      return functional();
    case 8:
      return beams();
    default:
      return input_.chance(128) ? host_structure() : host_function();
  }
}

}  // namespace msq::fuzz
