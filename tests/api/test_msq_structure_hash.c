/* SPDX-License-Identifier: Apache-2.0 */
#include "hashes.h"
#include "maps.h"
#include "wrong_values.h"

static msq_context* context;
static msq_field *ramp, *same_ramp, *steep_ramp, *dense_ramp, *thin_ramp;

static void hash_and_release(msq_structure* structure, uint8_t hash[hash_bytes]) {
  assert_ok(msq_structure_hash(structure, hash));
  msq_structure_release(structure);
}

static void equal_fields_are_one(const void* one, const void* other, hash_fn hash) {
  uint8_t of_one[hash_bytes], of_other[hash_bytes];
  hash(context, one, of_one);
  hash(context, other, of_other);
  assert_memory_equal(of_one, of_other, hash_bytes);
}

/* ---- lattices -------------------------------------------------------------------------------- */

static void hash_lattice(msq_context* in, const void* def, uint8_t hash[hash_bytes]) {
  msq_structure* structure;
  assert_ok(msq_structure_lattice(in, (const msq_lattice_def*)def, &structure));
  hash_and_release(structure, hash);
}

static double corners[3][3] = {{0, 0, 0}, {0.5, 0.5, 0.5}, {1, 0, 0.25}};
static uint32_t pairs[2][2] = {{0, 1}, {1, 2}};
static double factors[2] = {1, 1};

static double positions[3] = {0, 4, 8}, sizes[3] = {1, 2, 1.5};

static msq_period_def period_def(void) {
  msq_period_def def;
  assert_ok(msq_period_def_init(&def, sizeof def));
  def.positions = positions;
  def.cell_sizes = sizes;
  def.count = 3;
  return def;
}

static msq_warp_def warp_def(void) {
  msq_warp_def def;
  assert_ok(msq_warp_def_init(&def, sizeof def));
  def.kind = MSQ_WARP_SPHERICAL;
  def.count = 7;
  def.count_polar = 3;
  def.inner_radius = 1;
  def.outer_radius = 4;
  return def;
}

static void lattices_hash_cell_grid_and_radius(void** state) {
  const msq_period_def period = period_def();
  const msq_warp_def warp = warp_def();
  msq_lattice_def def, other;
  (void)state;
  assert_ok(msq_lattice_def_init(&def, sizeof def));
  def.radius.value = 0.125;
  HASHES(context, "msq_lattice_def", &def, sizeof def, hash_lattice) {
    NOT_HASHED(def.struct_size);
    for (int32_t cell = MSQ_UNIT_CELL_CUBIC; cell <= MSQ_UNIT_CELL_REENTRANT; ++cell)
      if (cell != MSQ_UNIT_CELL_BCC) CHANGES(def.unit_cell, def.unit_cell = cell);
    GRID_CHANGES(def.grid);
    CHANGES(def.radius.value, def.radius.value = 0.25);
    PARAM_CHANGES(def.radius, ramp, steep_ramp);
    KEEPS(def.clusters, def.clusters = 5);
    KEEPS(def.cell_choice, def.cell_choice.value = 1); /* without a library */
    CHANGES(def.nodes, def.unit_cell = MSQ_UNIT_CELL_CUSTOM; def.nodes = corners[0];
            def.node_count = 3; def.struts = pairs[0]; def.strut_count = 2);
    NOT_HASHED(def.node_count);
    NOT_HASHED(def.struts);
    NOT_HASHED(def.strut_count);
    NOT_HASHED(def.strut_factors);
    NOT_HASHED(def.cells);
    NOT_HASHED(def.cell_count);
    CHANGES(def.period, def.period = &period);
    CHANGES(def.warp, def.warp = &warp);
  }
  other = def;
  def.radius.field = ramp;
  other.radius.field = same_ramp;
  equal_fields_are_one(&def, &other, hash_lattice);
}

static void hash_warped_lattice(msq_context* in, const void* warp, uint8_t hash[hash_bytes]) {
  msq_lattice_def def;
  assert_ok(msq_lattice_def_init(&def, sizeof def));
  def.radius.value = 0.125;
  def.warp = (const msq_warp_def*)warp;
  hash_lattice(in, &def, hash);
}

static void lattices_hash_warps(void** state) {
  msq_warp_def def = warp_def();
  (void)state;
  HASHES(context, "msq_warp_def", &def, sizeof def, hash_warped_lattice) {
    NOT_HASHED(def.struct_size);
    CHANGES(def.kind, def.kind = MSQ_WARP_CYLINDRICAL; def.count_polar = 0);
    CHANGES(def.count, def.count = 13);
    CHANGES(def.count_polar, def.count_polar = 7);
    CHANGES(def.inner_radius, def.inner_radius = 2);
    CHANGES(def.outer_radius, def.outer_radius = 9);
    NOT_HASHED(def.u);
    NOT_HASHED(def.v);
    NOT_HASHED(def.w);
    NOT_HASHED(def.shear_outwards);
    NOT_HASHED(def.shear_along);
  }
}

static void lattices_hash_custom_cells(void** state) {
  static const double twos[2] = {2, 1};
  msq_lattice_def def;
  (void)state;
  assert_ok(msq_lattice_def_init(&def, sizeof def));
  def.radius.value = 0.125;
  def.unit_cell = MSQ_UNIT_CELL_CUSTOM;
  def.nodes = corners[0];
  def.node_count = 3;
  def.struts = pairs[0];
  def.strut_count = 2;
  HASHES(context, "a custom cell", &def, sizeof def, hash_lattice) {
    NOT_HASHED(def);
    KEEPS(def.strut_factors, def.strut_factors = factors);
    CHANGES(def.strut_factors, def.strut_factors = twos);
    CHANGES(def.strut_count, def.strut_count = 1);
    for (int i = 0; i < 3; ++i)
      for (int axis = 0; axis < 3; ++axis)
        CHANGES_BEHIND(double, corners[i][axis],
                       corners[i][axis] == 1 ? 0.875 : corners[i][axis] + 0.125);
    CHANGES_BEHIND(uint32_t, pairs[1][0], 0);
    CHANGES_BEHIND(uint32_t, pairs[0][1], 2);
  }
}

static void lattices_hash_libraries(void** state) {
  msq_unit_cell_def cells[3] = {named_cell(MSQ_UNIT_CELL_BCC), named_cell(MSQ_UNIT_CELL_CUBIC),
                                named_cell(MSQ_UNIT_CELL_OCTET)};
  msq_lattice_def def;
  (void)state;
  assert_ok(msq_lattice_def_init(&def, sizeof def));
  def.radius.value = 0.125;
  def.cells = cells;
  def.cell_count = 2;
  HASHES(context, "a library", &def, sizeof def, hash_lattice) {
    NOT_HASHED(def);
    CHANGES(def.cell_count, def.cell_count = 1);
    CHANGES(def.cell_count, def.cell_count = 3);
    CHANGES(def.cells, def.cells = cells + 1);
    KEEPS(def.unit_cell, def.unit_cell = MSQ_UNIT_CELL_OCTET);
    KEEPS(def.clusters, def.clusters = 5);
    CHANGES(def.cell_choice, def.cell_choice.value = 1);
    CHANGES(def.radius.value, def.radius.value = 0.25);
    PARAM_CHANGES(def.cell_choice, ramp, steep_ramp);
    CHANGES(def.radius.field, def.radius.field = ramp);
    GRID_CHANGES(def.grid);
  }
}

/* The fields of msq_unit_cell_def one by one. */
static void hash_cell(msq_context* in, const void* cell, uint8_t hash[hash_bytes]) {
  msq_lattice_def def;
  assert_ok(msq_lattice_def_init(&def, sizeof def));
  def.radius.value = 0.125;
  def.cells = (const msq_unit_cell_def*)cell;
  def.cell_count = 1;
  hash_lattice(in, &def, hash);
}

static void unit_cells_hash_nodes_and_struts(void** state) {
  static const double twos[2] = {2, 1}, moved[3][3] = {{0, 0, 0}, {0.5, 0.5, 0.75}, {1, 0, 0.25}};
  static const uint32_t others[2][2] = {{0, 1}, {0, 2}};
  msq_unit_cell_def cell = named_cell(MSQ_UNIT_CELL_CUSTOM);
  (void)state;
  cell.nodes = corners[0];
  cell.node_count = 3;
  cell.struts = pairs[0];
  cell.strut_count = 2;
  HASHES(context, "msq_unit_cell_def", &cell, sizeof cell, hash_cell) {
    NOT_HASHED(cell.struct_size);
    CHANGES(cell.unit_cell, cell.unit_cell = MSQ_UNIT_CELL_KELVIN);
    CHANGES(cell.nodes, cell.nodes = moved[0]);
    CHANGES(cell.node_count, cell.node_count = 2; cell.strut_count = 1);
    CHANGES(cell.strut_count, cell.strut_count = 1);
    CHANGES(cell.struts, cell.struts = others[0]);
    CHANGES(cell.strut_factors, cell.strut_factors = twos);
  }
}

/* ---- plate lattices ---------------------------------------------------------------------------
 */

static void hash_plates(msq_context* in, const void* def, uint8_t hash[hash_bytes]) {
  msq_structure* structure;
  assert_ok(msq_structure_plate_lattice(in, (const msq_plate_lattice_def*)def, &structure));
  hash_and_release(structure, hash);
}

static void plate_lattices_hash_what_they_are_made_of(void** state) {
  static const uint32_t faces[2][3] = {{0, 1, 2}, {2, 1, 0}}, turned[2][3] = {{1, 0, 2}, {2, 1, 0}},
                        others[2][2] = {{0, 1}, {0, 2}};
  static const double face_factors[6] = {1, 1, 1, 2, 1, 1}, ones[2] = {1, 1}, twos[2] = {2, 1},
                      moved[3][3] = {{0, 0, 0}, {0.5, 0.5, 0.75}, {1, 0, 0.25}};
  msq_plate_lattice_def def, other;
  (void)state;
  assert_ok(msq_plate_lattice_def_init(&def, sizeof def));
  def.thickness.value = 0.125;
  HASHES(context, "msq_plate_lattice_def", &def, sizeof def, hash_plates) {
    NOT_HASHED(def.struct_size);
    for (int32_t cell = MSQ_PLATE_CELL_BCC; cell <= MSQ_PLATE_CELL_KELVIN; ++cell)
      CHANGES(def.plate_cell, def.plate_cell = cell);
    GRID_CHANGES(def.grid);
    CHANGES(def.thickness.value, def.thickness.value = 0.25);
    PARAM_CHANGES(def.thickness, ramp, steep_ramp);
    CHANGES(def.nodes, def.plate_cell = MSQ_PLATE_CELL_CUSTOM; def.nodes = moved[0];
            def.node_count = 3; def.faces = faces[0]; def.face_count = 1);
    KEEPS(def.node_count, def.node_count = 3); /* of a named cell */
    KEEPS(def.faces, def.faces = faces[0]);
    KEEPS(def.face_count, def.face_count = 6);
    CHANGES(def.face_factors, def.face_factors = face_factors; def.face_count = 6);
    CHANGES(def.radius, def.radius.value = 0.125);
    KEEPS(def.unit_cell, def.unit_cell = MSQ_UNIT_CELL_BCC); /* without struts */
    NOT_HASHED(def.reserved);
    NOT_HASHED(def.struts);
    KEEPS(def.strut_count, def.strut_count = 3);
    NOT_HASHED(def.strut_factors);
  }
  other = def;
  def.thickness.field = ramp;
  other.thickness.field = same_ramp;
  equal_fields_are_one(&def, &other, hash_plates);

  assert_ok(msq_plate_lattice_def_init(&def, sizeof def));
  def.thickness.value = def.radius.value = 0.125;
  def.plate_cell = MSQ_PLATE_CELL_CUSTOM;
  def.unit_cell = MSQ_UNIT_CELL_CUSTOM;
  def.nodes = corners[0];
  def.node_count = 3;
  def.faces = faces[0];
  def.face_count = 2;
  def.struts = pairs[0];
  def.strut_count = 2;
  HASHES(context, "own plates and struts", &def, sizeof def, hash_plates) {
    NOT_HASHED(def);
    CHANGES(def.nodes, def.nodes = moved[0]);
    CHANGES(def.faces, def.faces = turned[0]);
    CHANGES(def.face_count, def.face_count = 1);
    KEEPS(def.face_factors, def.face_factors = ones);
    CHANGES(def.face_factors, def.face_factors = twos);
    CHANGES(def.radius.value, def.radius.value = 0.25);
    PARAM_CHANGES(def.radius, ramp, steep_ramp);
    CHANGES(def.unit_cell, def.unit_cell = MSQ_UNIT_CELL_BCC);
    CHANGES(def.struts, def.struts = others[0]);
    CHANGES(def.strut_count, def.strut_count = 1);
    KEEPS(def.strut_factors, def.strut_factors = ones);
    CHANGES(def.strut_factors, def.strut_factors = twos);
  }
}

/* ---- foams ----------------------------------------------------------------------------------- */

static void hash_foam(msq_context* in, const void* def, uint8_t hash[hash_bytes]) {
  msq_structure* structure;
  assert_ok(msq_structure_foam(in, (const msq_foam_def*)def, &structure));
  hash_and_release(structure, hash);
}

static msq_foam_def foam_def(double radius, double thickness) {
  msq_foam_def def;
  assert_ok(msq_foam_def_init(&def, sizeof def));
  def.radius.value = radius;
  def.wall_thickness.value = thickness;
  return def;
}

static msq_warp_def foam_warp_def(double outer_radius) {
  msq_warp_def def;
  assert_ok(msq_warp_def_init(&def, sizeof def));
  def.count = 16;
  def.inner_radius = 2;
  def.outer_radius = outer_radius;
  return def;
}

static void foams_hash_seeds_and_sizes(void** state) {
  const msq_period_def period = period_def();
  msq_period_def other_period = period;
  other_period.axis = 0;
  const msq_warp_def warp = foam_warp_def(3);
  const msq_warp_def other_warp = foam_warp_def(3.5);
  msq_foam_def def = foam_def(0.15, 0), other;
  uint8_t hash[hash_bytes], other_hash[hash_bytes];
  (void)state;
  hash_foam(context, &def, hash);
  assert_hash(hash, "b74b1652a7bfc9f4e825ec2c2f81e1b2");
  HASHES(context, "msq_foam_def", &def, sizeof def, hash_foam) {
    NOT_HASHED(def.struct_size);
    KEEPS(def.method, def.method = MSQ_FOAM_POINT);
    KEEPS(def.method, def.method = MSQ_FOAM_METHOD_1);
    KEEPS(def.method, def.method = MSQ_FOAM_DIRECT);
    GRID_CHANGES(def.grid);
    CHANGES(def.radius.value, def.radius.value = 0.25);
    PARAM_CHANGES(def.radius, ramp, steep_ramp);
    CHANGES(def.jitter, def.jitter = 0.5);
    CHANGES(def.seed, def.seed = 1);
    CHANGES(def.seed, def.seed = UINT64_MAX);
    KEEPS(def.density.value, def.density.value = 0.5); /* counts as 1 */
    CHANGES(def.density.value, def.density.value = 2);
    CHANGES(def.density.value, def.density.value = 3);
    CHANGES(def.density.field, def.density.field = dense_ramp);
    CHANGES(def.wall_thickness.value, def.wall_thickness.value = 0.125);
    CHANGES(def.wall_thickness, def.wall_thickness.value = 0.125; def.radius.value = 0);
    CHANGES(def.vent_radius, def.wall_thickness.value = 0.125; def.vent_radius.value = 0.25);
    CHANGES(def.stretch[0], def.stretch[0] = 2);
    CHANGES(def.stretch[1], def.stretch[1] = 2);
    CHANGES(def.stretch[2], def.stretch[2] = 2);
    CHANGES(def.stretch[2], def.stretch[2] = 0.5);
    KEEPS(def.stretch, def.stretch[0] = def.stretch[1] = def.stretch[2] = 3);
    CHANGES(def.weight, def.weight = 0.25);
    CHANGES(def.weight, def.weight = 0.5);
    CHANGES(def.period, def.period = &period);
    CHANGES(def.period, def.period = &other_period);
    CHANGES(def.warp, def.warp = &warp);
    CHANGES(def.warp, def.warp = &other_warp);
  }
  other = def;
  def.period = other.period = &period;
  other.grid.cell_size[2] = 3; /* not used */
  hash_foam(context, &def, hash);
  hash_foam(context, &other, other_hash);
  assert_memory_equal(hash, other_hash, hash_bytes);
  def.period = NULL;
  other = def;
  def.density.field = other.density.field = NULL;
  def.radius.field = ramp;
  other.radius.field = same_ramp;
  equal_fields_are_one(&def, &other, hash_foam);
}

static void walls_hash_seeds_and_sizes(void** state) {
  (void)state;
  for (int with_struts = 0; with_struts < 2; ++with_struts) {
    const msq_period_def period = period_def();
    msq_period_def other_period = period;
    other_period.axis = 0;
    const msq_warp_def warp = foam_warp_def(3), other_warp = foam_warp_def(3.5);
    msq_foam_def def = foam_def(with_struts ? 0.0625 : 0, 0.125);
    def.vent_radius.value = 0.25;
    HASHES(context, "msq_foam_def with walls", &def, sizeof def, hash_foam) {
      NOT_HASHED(def);
      KEEPS(def.method, def.method = MSQ_FOAM_DIRECT);
      GRID_CHANGES(def.grid);
      CHANGES(def.radius.value, def.radius.value = 0.03125);
      CHANGES(def.jitter, def.jitter = 0.5);
      CHANGES(def.seed, def.seed = 1);
      CHANGES(def.density.value, def.density.value = 2);
      CHANGES(def.density.field, def.density.field = dense_ramp);
      CHANGES(def.wall_thickness.value, def.wall_thickness.value = 0.25);
      PARAM_CHANGES(def.wall_thickness, ramp, steep_ramp);
      CHANGES(def.vent_radius.value, def.vent_radius.value = 0);
      CHANGES(def.vent_radius.value, def.vent_radius.value = 0.125);
      PARAM_CHANGES(def.vent_radius, ramp, steep_ramp);
    }
    def.vent_radius.value = 0;
    HASHES(context, "msq_foam_def with stretched walls", &def, sizeof def, hash_foam) {
      NOT_HASHED(def);
      CHANGES(def.stretch[0], def.stretch[0] = 2);
      CHANGES(def.stretch[1], def.stretch[1] = 2);
      CHANGES(def.stretch[2], def.stretch[2] = 2);
      KEEPS(def.stretch, def.stretch[0] = def.stretch[1] = def.stretch[2] = 3);
      CHANGES(def.weight, def.weight = 0.25);
      CHANGES(def.weight, def.weight = 0.5);
      CHANGES(def.period, def.period = &period);
      CHANGES(def.period, def.period = &other_period);
      CHANGES(def.warp, def.warp = &warp);
      CHANGES(def.warp, def.warp = &other_warp);
    }
  }
}

/* ---- waves ------------------------------------------------------------------------------------
 */

static void hash_waves(msq_context* in, const void* def, uint8_t hash[hash_bytes]) {
  msq_structure* structure;
  assert_ok(msq_structure_waves(in, (const msq_waves_def*)def, &structure));
  hash_and_release(structure, hash);
}

static void waves_hash_what_they_are_made_of(void** state) {
  msq_waves_def def;
  (void)state;
  assert_ok(msq_waves_def_init(&def, sizeof def));
  def.count = 20;
  def.level.value = 0.25;
  HASHES(context, "msq_waves_def", &def, sizeof def, hash_waves) {
    NOT_HASHED(def.struct_size);
    CHANGES(def.kind, def.kind = MSQ_FUNCTIONAL_SHEET);
    CHANGES(def.seed, def.seed = 1);
    CHANGES(def.count, def.count = 21);
    CHANGES(def.tile[0], def.tile[0] = 4);
    CHANGES(def.tile[1], def.tile[1] = 4);
    CHANGES(def.tile[2], def.tile[2] = 4);
    CHANGES(def.cone_angles[0], def.cone_angles[0] = 45);
    CHANGES(def.cone_angles[1], def.cone_angles[1] = 45);
    CHANGES(def.cone_angles[2], def.cone_angles[2] = 45);
    GRID_CHANGES(def.grid);
    CHANGES(def.level.value, def.level.value = 0.5);
    PARAM_CHANGES(def.level, ramp, steep_ramp);
    CHANGES(def.volume_fraction, def.level.value = 0; def.volume_fraction = 0.25);
  }
}

/* ---- functional structures ------------------------------------------------------------------- */

static void hash_functional(msq_context* in, const void* def, uint8_t hash[hash_bytes]) {
  msq_structure* structure;
  assert_ok(msq_structure_functional(in, (const msq_functional_def*)def, &structure));
  hash_and_release(structure, hash);
}

static void functional_structures_hash_their_function(void** state) {
  static const msq_named_value parameter[1] = {{"a", 2}};
  const msq_period_def period = period_def();
  const msq_warp_def warp = warp_def();
  msq_functional_def def;
  (void)state;
  assert_ok(msq_functional_def_init(&def, sizeof def));
  def.kind = MSQ_FUNCTIONAL_SHEET;
  def.level.value = 0.25;
  HASHES(context, "msq_functional_def", &def, sizeof def, hash_functional) {
    NOT_HASHED(def.struct_size);
    for (int32_t f = MSQ_FUNCTION_SCHWARZ_P; f <= MSQ_FUNCTION_RODS; ++f)
      CHANGES(def.function, def.function = f);
    CHANGES(def.kind, def.kind = MSQ_FUNCTIONAL_NETWORK);
    KEEPS(def.clusters, def.clusters = 4);
    GRID_CHANGES(def.grid);
    CHANGES(def.level.value, def.level.value = 0.5);
    PARAM_CHANGES(def.level, ramp, steep_ramp);
    CHANGES(def.expression, def.function = MSQ_FUNCTION_EXPRESSION;
            def.expression = "sin(x) + sin(y)");
    KEEPS(def.expression, def.function = MSQ_FUNCTION_EXPRESSION;
          def.expression = "sin(x)*cos(y) + sin(y)*cos(z) + sin(z)*cos(x)");
    CHANGES(def.parameters, def.function = MSQ_FUNCTION_EXPRESSION;
            def.expression = "a*sin(x)+sin(y)"; def.parameters = parameter;
            def.parameter_count = 1);
    NOT_HASHED(def.parameter_count);
    CHANGES(def.thickness.value, def.level.value = 0; def.thickness.value = 0.125);
    CHANGES(def.thickness.value, def.level.value = 0; def.thickness.value = 0.25);
    CHANGES(def.thickness.field, def.level.value = 0; def.thickness.field = thin_ramp);
    CHANGES(def.period, def.period = &period);
    CHANGES(def.warp, def.warp = &warp);
  }
}

static void hash_period(msq_context* in, const void* period, uint8_t hash[hash_bytes]) {
  msq_functional_def def;
  assert_ok(msq_functional_def_init(&def, sizeof def));
  def.period = (const msq_period_def*)period;
  hash_functional(in, &def, hash);
}

static void periods_hash_axis_and_sizes(void** state) {
  msq_period_def def = period_def();
  (void)state;
  HASHES(context, "msq_period_def", &def, sizeof def, hash_period) {
    NOT_HASHED(def.struct_size);
    NOT_HASHED(def.positions);
    NOT_HASHED(def.cell_sizes);
    CHANGES(def.axis, def.axis = 0);
    CHANGES(def.axis, def.axis = 1);
    CHANGES(def.count, def.count = 2);
    for (int i = 0; i < 3; ++i) {
      CHANGES_BEHIND(double, positions[i], positions[i] + 0.5);
      CHANGES_BEHIND(double, sizes[i], sizes[i] + 0.25);
    }
  }
}

static void hash_warp(msq_context* in, const void* warp, uint8_t hash[hash_bytes]) {
  msq_functional_def def;
  assert_ok(msq_functional_def_init(&def, sizeof def));
  def.warp = (const msq_warp_def*)warp;
  hash_functional(in, &def, hash);
}

static void warps_hash_kind_counts_and_radii(void** state) {
  msq_warp_def def = warp_def();
  (void)state;
  HASHES(context, "msq_warp_def", &def, sizeof def, hash_warp) {
    NOT_HASHED(def.struct_size);
    CHANGES(def.kind, def.kind = MSQ_WARP_CYLINDRICAL; def.count_polar = 0);
    CHANGES(def.count, def.count = 8);
    CHANGES(def.count_polar, def.count_polar = 4);
    CHANGES(def.inner_radius, def.inner_radius = 0);
    CHANGES(def.outer_radius, def.outer_radius = 0);
    NOT_HASHED(def.u);
    NOT_HASHED(def.v);
    NOT_HASHED(def.w);
    NOT_HASHED(def.shear_outwards);
    NOT_HASHED(def.shear_along);
  }
  /* Only around an axis. */
  def.kind = MSQ_WARP_CYLINDRICAL;
  def.count_polar = 0;
  HASHES(context, "msq_warp_def", &def, sizeof def, hash_warp) {
    NOT_HASHED(def.struct_size);
    NOT_HASHED(def.kind);
    CHANGES(def.count, def.count = 8);
    NOT_HASHED(def.count_polar);
    CHANGES(def.inner_radius, def.inner_radius = 0);
    CHANGES(def.outer_radius, def.outer_radius = 0);
    NOT_HASHED(def.u);
    NOT_HASHED(def.v);
    NOT_HASHED(def.w);
    CHANGES(def.shear_outwards, def.shear_outwards = 0.25);
    CHANGES(def.shear_along, def.shear_along = 0.25);
  }
}

static void maps_hash_their_samples(void** state) {
  static double mirrored[3][map_samples];
  msq_field *fields[3], *others[3];
  (void)state;
  sample_map();
  msq_warp_def def = sampled_warp(context, fields);
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < map_samples; ++i) mirrored[axis][i] = -map_values[axis][i];
    const msq_image image = map_image(mirrored[axis]);
    others[axis] = make_grid_field(context, &image);
  }
  for (int is_lattice = 0; is_lattice < 2; ++is_lattice)
    HASHES(context, "msq_warp_def", &def, sizeof def,
           is_lattice ? hash_warped_lattice : hash_warp) {
      NOT_HASHED(def.struct_size);
      NOT_HASHED(def.kind);
      NOT_HASHED(def.count);
      NOT_HASHED(def.count_polar);
      NOT_HASHED(def.inner_radius);
      NOT_HASHED(def.outer_radius);
      CHANGES(def.u, def.u = others[0]);
      CHANGES(def.v, def.v = others[1]);
      CHANGES(def.w, def.w = others[2]);
      NOT_HASHED(def.shear_outwards);
      NOT_HASHED(def.shear_along);
    }
  for (int axis = 0; axis < 3; ++axis) {
    msq_field_release(fields[axis]);
    msq_field_release(others[axis]);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(lattices_hash_cell_grid_and_radius),
      cmocka_unit_test(lattices_hash_warps),
      cmocka_unit_test(lattices_hash_custom_cells),
      cmocka_unit_test(lattices_hash_libraries),
      cmocka_unit_test(unit_cells_hash_nodes_and_struts),
      cmocka_unit_test(plate_lattices_hash_what_they_are_made_of),
      cmocka_unit_test(foams_hash_seeds_and_sizes),
      cmocka_unit_test(walls_hash_seeds_and_sizes),
      cmocka_unit_test(functional_structures_hash_their_function),
      cmocka_unit_test(waves_hash_what_they_are_made_of),
      cmocka_unit_test(periods_hash_axis_and_sizes),
      cmocka_unit_test(warps_hash_kind_counts_and_radii),
      cmocka_unit_test(maps_hash_their_samples),
  };
  if (!MSQ_WITH_XXHASH) return 0;
  context = make_context();
  ramp = ramp_of(context, 0, 0.5);
  same_ramp = ramp_of(context, 0, 0.5);
  steep_ramp = ramp_of(context, 0.125, 1);
  dense_ramp = ramp_of(context, 1, 4);
  thin_ramp = ramp_of(context, 0, 0.125);
  const int failed = cmocka_run_group_tests(tests, NULL, NULL);
  msq_field_release(thin_ramp);
  msq_field_release(dense_ramp);
  msq_field_release(steep_ramp);
  msq_field_release(same_ramp);
  msq_field_release(ramp);
  msq_context_release(context);
  return failed;
}
