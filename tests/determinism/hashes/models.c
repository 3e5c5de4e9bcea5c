/* SPDX-License-Identifier: Apache-2.0 */
#include "models.h"

#include "parts.h"

static msq_model* with_skin(Kit* kit, const msq_shape* shape, const msq_structure* coarse,
                            const msq_structure* fine, msq_param skin) {
  const msq_scale_def scales[3] = {
      {.shape = shape}, {.structure = coarse, .skin = skin}, {.structure = fine}};
  msq_model_def def;
  must(msq_model_def_init(&def, sizeof def));
  def.scales = scales;
  def.scale_count = fine ? 3 : 2;
  def.scale_size = sizeof scales[0];
  msq_model* model;
  must(msq_model_create(kit->context, &def, &model));
  return model;
}

static msq_model* filled(Kit* kit, const msq_shape* shape, const msq_structure* structure) {
  return with_skin(kit, shape, structure, NULL, number(0));
}

static msq_model* cubic(Kit* kit) {
  const msq_lattice_def def = lattice_def(MSQ_UNIT_CELL_CUBIC, 4, number(0.6));
  return filled(kit, box(kit), lattice(kit, &def));
}

static msq_model* bcc_turned(Kit* kit) {
  msq_lattice_def def = lattice_def(MSQ_UNIT_CELL_BCC, 5, gradient(kit, 0.3, 0.9));
  turn(&def.grid);
  return filled(kit, sphere(kit, 9.7), lattice(kit, &def));
}

static msq_model* octet_flat(Kit* kit) {
  msq_lattice_def def = lattice_def(MSQ_UNIT_CELL_OCTET, 5, number(0.35));
  set_cells(&def.grid, 5, 4, 7);
  return filled(kit, mesh(kit, 0), lattice(kit, &def));
}

static msq_model* kelvin_skin(Kit* kit) {
  const msq_lattice_def def = lattice_def(MSQ_UNIT_CELL_KELVIN, 6, number(0.5));
  return with_skin(kit, mesh(kit, 0), lattice(kit, &def), NULL, gradient(kit, 0.2, 1.1));
}

static msq_model* diamond_sampled(Kit* kit) {
  const msq_lattice_def def = lattice_def(MSQ_UNIT_CELL_DIAMOND, 7, sampled(kit, 0.2, 1.2));
  return filled(kit, voxels(kit), lattice(kit, &def));
}

static msq_model* reentrant_waves(Kit* kit) {
  const msq_param radius = expression(kit, "0.5 + 0.2 * sin(x) * cos(y / 2)", 0.2, 0.8);
  const msq_lattice_def def = lattice_def(MSQ_UNIT_CELL_REENTRANT, 6, radius);
  return filled(kit, cylinder(kit), lattice(kit, &def));
}

static msq_model* mixed(Kit* kit) {
  msq_unit_cell_def cells[3];
  const int32_t names[3] = {MSQ_UNIT_CELL_FCC, MSQ_UNIT_CELL_OCTET,
                            MSQ_UNIT_CELL_RHOMBIC_DODECAHEDRON};
  for (int i = 0; i < 3; ++i) {
    must(msq_unit_cell_def_init(&cells[i], sizeof cells[i]));
    cells[i].unit_cell = names[i];
  }
  msq_lattice_def def = lattice_def(MSQ_UNIT_CELL_BCC, 4, number(0.4));
  def.cells = cells;
  def.cell_count = 3;
  def.cell_choice = gradient(kit, -0.5, 2.5);
  return filled(kit, box(kit), lattice(kit, &def));
}

static msq_model* custom(Kit* kit) {
  static const double nodes[5][3] = {
      {0, 0.25, 0.75}, {1, 0.5, 0.125}, {0.3, 0, 1}, {0.7, 1, 0}, {0.6, 0.45, 0.55}};
  static const uint32_t struts[4][2] = {{0, 1}, {2, 3}, {4, 0}, {4, 3}};
  static const double factors[4] = {1, 0.5, 1.75, 1.2};
  msq_lattice_def def = lattice_def(MSQ_UNIT_CELL_CUSTOM, 5, radial(kit, 0.4, 0.8));
  def.nodes = &nodes[0][0];
  def.node_count = 5;
  def.struts = &struts[0][0];
  def.strut_count = 4;
  def.strut_factors = factors;
  return filled(kit, box(kit), lattice(kit, &def));
}

static msq_model* foam_plain(Kit* kit) {
  const msq_foam_def def = foam_def(4, number(0.4));
  return filled(kit, box(kit), foam(kit, &def));
}

static msq_model* foam_turned(Kit* kit) {
  msq_foam_def def = foam_def(4, radial(kit, 0.3, 0.9));
  set_cells(&def.grid, 4, 5, 3.5);
  turn(&def.grid);
  def.jitter = 0.3;
  return filled(kit, mesh(kit, 0), foam(kit, &def));
}

static msq_model* foam_graded(Kit* kit) {
  msq_foam_def def = foam_def(6, number(0.25));
  def.density = gradient(kit, 1, 30);
  return filled(kit, box(kit), foam(kit, &def));
}

static msq_model* foam_regular(Kit* kit) {
  msq_foam_def def = foam_def(5, depth(kit, mesh(kit, 0), 0.8, 0.3));
  def.jitter = 0;
  return filled(kit, kit->shapes[0], foam(kit, &def));
}

static msq_model* foam_stretched(Kit* kit) {
  msq_foam_def def = foam_def(4, number(0.3));
  set_cells(&def.grid, 4, 5, 3.5);
  turn(&def.grid);
  def.stretch[2] = 3;
  return filled(kit, mesh(kit, 0), foam(kit, &def));
}

static msq_model* walls(Kit* kit) {
  msq_foam_def def = foam_def(5, number(0));
  def.wall_thickness = gradient(kit, 0.2, 0.6);
  return filled(kit, sphere(kit, 9.5), foam(kit, &def));
}

static msq_model* walls_stretched(Kit* kit) {
  msq_foam_def def = foam_def(5, radial(kit, 0.2, 0.4));
  def.wall_thickness = number(0.3);
  def.stretch[0] = 0.5;
  return filled(kit, sphere(kit, 9.5), foam(kit, &def));
}

static msq_model* foam_weighted(Kit* kit) {
  msq_foam_def def = foam_def(4, number(0.3));
  set_cells(&def.grid, 4, 5, 3.5);
  turn(&def.grid);
  def.weight = 3;
  return filled(kit, mesh(kit, 0), foam(kit, &def));
}

static msq_model* walls_weighted(Kit* kit) {
  msq_foam_def def = foam_def(5, number(0));
  def.wall_thickness = number(0.3);
  def.weight = 5;
  return filled(kit, sphere(kit, 9.5), foam(kit, &def));
}

static msq_model* walled(Kit* kit) {
  msq_foam_def def = foam_def(5, number(0.5));
  def.wall_thickness = number(0.3);
  return filled(kit, box(kit), foam(kit, &def));
}

static msq_model* gyroid(Kit* kit) {
  msq_functional_def def = functional_def(MSQ_FUNCTION_GYROID, MSQ_FUNCTIONAL_NETWORK, 6);
  turn(&def.grid);
  return filled(kit, mesh(kit, 1), functional(kit, &def));
}

static msq_model* sheet(Kit* kit) {
  msq_functional_def def = functional_def(MSQ_FUNCTION_SCHWARZ_P, MSQ_FUNCTIONAL_SHEET, 5);
  def.thickness = number(0.7);
  return filled(kit, cylinder(kit), functional(kit, &def));
}

static msq_model* lidinoid(Kit* kit) {
  msq_functional_def def = functional_def(MSQ_FUNCTION_LIDINOID, MSQ_FUNCTIONAL_SHEET, 8);
  def.level = gradient(kit, 0.1, 0.5);
  return filled(kit, box(kit), functional(kit, &def));
}

static msq_model* formula(Kit* kit) {
  const msq_named_value k = {"k", 1.3};
  msq_functional_def def = functional_def(MSQ_FUNCTION_EXPRESSION, MSQ_FUNCTIONAL_NETWORK, 7);
  def.expression =
      "k * cos(x) + sin(y) ^ 3 - exp(-abs(sin(z))) + sqrt(2 + cos(x)) * log(1.5 + cos(y) / 2) "
      "+ pow(1.2 + sin(z), 0.7) / 3";
  def.parameters = &k;
  def.parameter_count = 1;
  def.level = number(0.2);
  return filled(kit, box(kit), functional(kit, &def));
}

static msq_model* spinodal(Kit* kit) {
  return filled(kit, box(kit), waves(kit));
}

static msq_model* plates_and_struts(Kit* kit) {
  return filled(kit, box(kit), plate_lattice(kit));
}

static msq_model* beam_list(Kit* kit) {
  return filled(kit, box(kit), beams(kit));
}

static msq_model* lattice_or_gyroid(Kit* kit) {
  msq_lattice_def def = lattice_def(MSQ_UNIT_CELL_BCC, 5, gradient(kit, 0.2, 0.6));
  turn(&def.grid);
  msq_functional_def sheet_def = functional_def(MSQ_FUNCTION_GYROID, MSQ_FUNCTIONAL_SHEET, 6);
  sheet_def.level = number(0.3);
  const msq_structure* const of_struts = lattice(kit, &def);
  return filled(kit, box(kit),
                joined(kit, MSQ_BOOLEAN_UNION, of_struts, functional(kit, &sheet_def)));
}

static msq_model* foam_without_beams(Kit* kit) {
  const msq_foam_def def = foam_def(4, number(0.7));
  const msq_structure* const struts = foam(kit, &def);
  return filled(kit, mesh(kit, 0), joined(kit, MSQ_BOOLEAN_DIFFERENCE, struts, beams(kit)));
}

static msq_model* foam_to_gyroid(Kit* kit) {
  const msq_foam_def def = foam_def(4, number(0.5));
  const msq_functional_def gyroid_def =
      functional_def(MSQ_FUNCTION_GYROID, MSQ_FUNCTIONAL_NETWORK, 5);
  const msq_structure* const struts = foam(kit, &def);
  const msq_structure* const surface = functional(kit, &gyroid_def);
  return filled(kit, box(kit), blended(kit, struts, surface, gradient(kit, 0, 1)));
}

static msq_model* smooth(Kit* kit) {
  const msq_foam_def foam_of = foam_def(4, number(0.5));
  const msq_lattice_def lattice_of = lattice_def(MSQ_UNIT_CELL_BCC, 5, number(0.6));
  const msq_structure* const struts = foam(kit, &foam_of);
  return filled(
      kit, box(kit),
      filleted(kit, MSQ_BOOLEAN_UNION, struts, lattice(kit, &lattice_of), gradient(kit, 0, 2)));
}

static msq_model* nested(Kit* kit) {
  const msq_lattice_def coarse = lattice_def(MSQ_UNIT_CELL_OCTET, 9, number(1.4));
  const msq_foam_def fine = foam_def(1.5, number(0.25));
  return with_skin(kit, sphere(kit, 9.9), lattice(kit, &coarse), foam(kit, &fine), number(0.3));
}

static msq_model* cut(Kit* kit) {
  const msq_lattice_def def = lattice_def(MSQ_UNIT_CELL_CUBIC, 3, number(0.5));
  const msq_shape* part = placed(kit, mesh(kit, 0));
  return filled(kit, difference(kit, part, sphere(kit, 5)), lattice(kit, &def));
}

static msq_model* regions(Kit* kit) {
  const msq_foam_def inner = foam_def(3, number(0.3));
  const msq_lattice_def outer = lattice_def(MSQ_UNIT_CELL_BCC, 4, number(0.4));
  kit->models[kit->model_count++] = filled(kit, sphere(kit, 6), foam(kit, &inner));
  kit->models[kit->model_count++] = filled(kit, box(kit), lattice(kit, &outer));
  const msq_model* both[2] = {kit->models[0], kit->models[1]};
  msq_model* model;
  must(msq_model_regions(kit->context, both, 2, &model));
  return model;
}

static msq_model* graded_lattice(Kit* kit) {
  static const double positions[3] = {-6, 0, 7}, sizes[3] = {6, 3, 4};
  msq_period_def period;
  must(msq_period_def_init(&period, sizeof period));
  period.positions = positions;
  period.cell_sizes = sizes;
  period.count = 3;
  msq_lattice_def def = lattice_def(MSQ_UNIT_CELL_OCTET, 4, gradient(kit, 0.3, 0.6));
  def.period = &period;
  return filled(kit, box(kit), lattice(kit, &def));
}

static msq_model* foam_period(Kit* kit) {
  static const double positions[3] = {-6, 0, 7}, sizes[3] = {6, 2, 4};
  msq_period_def period;
  must(msq_period_def_init(&period, sizeof period));
  period.positions = positions;
  period.cell_sizes = sizes;
  period.count = 3;
  msq_foam_def def = foam_def(4, number(0.4));
  turn(&def.grid);
  def.period = &period;
  return filled(kit, mesh(kit, 0), foam(kit, &def));
}

static msq_model* walls_period(Kit* kit) {
  static const double positions[2] = {-5, 5}, sizes[2] = {2, 5};
  msq_period_def period;
  must(msq_period_def_init(&period, sizeof period));
  period.axis = 0;
  period.positions = positions;
  period.cell_sizes = sizes;
  period.count = 2;
  msq_foam_def def = foam_def(5, number(0));
  def.wall_thickness = number(0.3);
  def.period = &period;
  return filled(kit, sphere(kit, 9.5), foam(kit, &def));
}

static msq_warp_def shell(uint32_t count, double inner, double outer) {
  msq_warp_def warp;
  must(msq_warp_def_init(&warp, sizeof warp));
  warp.count = count;
  warp.inner_radius = inner;
  warp.outer_radius = outer;
  return warp;
}

static msq_model* foam_warp(Kit* kit) {
  const msq_warp_def warp = shell(15, 3, 9);
  msq_foam_def def = foam_def(2.5, number(0.3));
  turn(&def.grid);
  def.warp = &warp;
  return filled(kit, mesh(kit, 0), foam(kit, &def));
}

static msq_model* walls_warp(Kit* kit) {
  const msq_warp_def warp = shell(12, 4, 8.5);
  msq_foam_def def = foam_def(3, number(0));
  def.wall_thickness = number(0.3);
  def.warp = &warp;
  return filled(kit, sphere(kit, 9.5), foam(kit, &def));
}

static msq_model* foam_sampled(Kit* kit) {
  enum { nx = 12, ny = 11, nz = 10 };
  static double values[3][nx * ny * nz];
  msq_field* fields[3];
  msq_warp_def warp;
  must(msq_warp_def_init(&warp, sizeof warp));
  for (int i = 0; i < nx * ny * nz; ++i) {
    const double x = i % nx, y = i / nx % ny, z = i / nx / ny;
    values[0][i] = 0.625 * x + 0.25 * y;
    values[1][i] = 0.5 * y + 0.015625 * x * z;
    values[2][i] = 0.5 * z + 0.03125 * y * y;
  }
  for (int axis = 0; axis < 3; ++axis) {
    msq_grid_field_def def;
    must(msq_grid_field_def_init(&def, sizeof def));
    def.image.values = values[axis];
    def.image.value_type = MSQ_FLOAT64;
    def.image.size[0] = nx;
    def.image.size[1] = ny;
    def.image.size[2] = nz;
    for (int i = 0; i < 3; ++i) def.image.grid.cell_size[i] = 1.75;
    turn(&def.image.grid);
    must(msq_field_grid(kit->context, &def, &fields[axis]));
  }
  warp.kind = MSQ_WARP_SAMPLED;
  warp.u = fields[0];
  warp.v = fields[1];
  warp.w = fields[2];
  msq_foam_def def = foam_def(1, number(0.3));
  def.wall_thickness = number(0.15);
  def.warp = &warp;
  msq_model* model = filled(kit, mesh(kit, 0), foam(kit, &def));
  for (int axis = 0; axis < 3; ++axis) msq_field_release(fields[axis]);
  return model;
}

static msq_model* warped_lattice(Kit* kit) {
  msq_warp_def warp;
  must(msq_warp_def_init(&warp, sizeof warp));
  warp.count = 13;
  warp.inner_radius = 2;
  msq_lattice_def def = lattice_def(MSQ_UNIT_CELL_BCC, 3, number(0.4));
  def.warp = &warp;
  return filled(kit, mesh(kit, 0), lattice(kit, &def));
}

static msq_model* lattice_shells(Kit* kit) {
  msq_warp_def warp;
  must(msq_warp_def_init(&warp, sizeof warp));
  warp.kind = MSQ_WARP_SPHERICAL;
  warp.count = 14;
  warp.count_polar = 7;
  msq_lattice_def def = lattice_def(MSQ_UNIT_CELL_CUBIC, 2.5, number(0.3));
  def.warp = &warp;
  return filled(kit, sphere(kit, 9.7), lattice(kit, &def));
}

static msq_model* twisted_lattice(Kit* kit) {
  msq_warp_def warp;
  must(msq_warp_def_init(&warp, sizeof warp));
  warp.count = 13;
  warp.inner_radius = 2;
  warp.shear_outwards = -0.25;
  warp.shear_along = 0.7;
  msq_lattice_def def = lattice_def(MSQ_UNIT_CELL_BCC, 3, number(0.4));
  def.warp = &warp;
  return filled(kit, mesh(kit, 0), lattice(kit, &def));
}

static msq_model* twisted_gyroid(Kit* kit) {
  msq_warp_def warp;
  must(msq_warp_def_init(&warp, sizeof warp));
  warp.count = 11;
  warp.inner_radius = 1;
  warp.shear_along = 0.6;
  msq_functional_def def;
  must(msq_functional_def_init(&def, sizeof def));
  for (int i = 0; i < 3; ++i) def.grid.cell_size[i] = 3;
  def.level.value = 0.2;
  def.warp = &warp;
  return filled(kit, box(kit), functional(kit, &def));
}

static const struct {
  const char* name;
  msq_model* (*make)(Kit* kit);
} models[model_count] = {
    {"cubic", cubic},
    {"bcc-turned", bcc_turned},
    {"octet-flat", octet_flat},
    {"kelvin-skin", kelvin_skin},
    {"diamond-sampled", diamond_sampled},
    {"reentrant-waves", reentrant_waves},
    {"mixed", mixed},
    {"custom", custom},
    {"graded-lattice", graded_lattice},
    {"warped-lattice", warped_lattice},
    {"lattice-shells", lattice_shells},
    {"twisted-lattice", twisted_lattice},
    {"twisted-gyroid", twisted_gyroid},
    {"foam", foam_plain},
    {"foam-turned", foam_turned},
    {"foam-graded", foam_graded},
    {"foam-regular", foam_regular},
    {"foam-stretched", foam_stretched},
    {"foam-weighted", foam_weighted},
    {"foam-period", foam_period},
    {"foam-warp", foam_warp},
    {"foam-sampled", foam_sampled},
    {"walls", walls},
    {"walls-stretched", walls_stretched},
    {"walls-weighted", walls_weighted},
    {"walls-period", walls_period},
    {"walls-warp", walls_warp},
    {"walled", walled},
    {"gyroid-open-mesh", gyroid},
    {"p-sheet", sheet},
    {"lidinoid", lidinoid},
    {"formula", formula},
    {"beams", beam_list},
    {"nested", nested},
    {"lattice-or-gyroid", lattice_or_gyroid},
    {"foam-without-beams", foam_without_beams},
    {"foam-to-gyroid", foam_to_gyroid},
    {"cut", cut},
    {"regions", regions},
    {"waves", spinodal},
    {"foam-and-lattice-smooth", smooth},
    {"plates-and-struts", plates_and_struts},
};

const char* model_name(int i) {
  return models[i].name;
}

msq_model* make_model(msq_context* context, int i) {
  Kit kit = {.context = context};
  msq_model* const model = models[i].make(&kit);
  throw_away(&kit);
  return model;
}
