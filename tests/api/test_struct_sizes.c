/* SPDX-License-Identifier: Apache-2.0
 * What msq.h promises of struct_size: each definition is initialised, and each report is filled, as
 * far as the caller's struct reaches. Functions that take definitions: wrong_sizes(). */
#include "definitions.h"
#include "fills.h"
#include "struts.h"
#include "threemf.h"

#define FOR_EACH_DEFINITION(DO)                                      \
  DO(context_def, offsetof(msq_context_def, cache_policy))           \
  DO(file_def, sizeof(msq_file_def))                                 \
  DO(mesh_def, sizeof(msq_mesh_def))                                 \
  DO(host_shape_def, offsetof(msq_host_shape_def, hash_key))         \
  DO(voxels_def, sizeof(msq_voxels_def))                             \
  DO(radial_field_def, sizeof(msq_radial_field_def))                 \
  DO(host_field_def, offsetof(msq_host_field_def, hash_key))         \
  DO(grid_field_def, sizeof(msq_grid_field_def))                     \
  DO(expression_field_def, sizeof(msq_expression_field_def))         \
  DO(shape_distance_field_def, sizeof(msq_shape_distance_field_def)) \
  DO(unit_cell_def, sizeof(msq_unit_cell_def))                       \
  DO(lattice_def, offsetof(msq_lattice_def, strut_factors))          \
  DO(plate_lattice_def, sizeof(msq_plate_lattice_def))               \
  DO(foam_def, offsetof(msq_foam_def, density))                      \
  DO(functional_def, offsetof(msq_functional_def, period))           \
  DO(period_def, sizeof(msq_period_def))                             \
  DO(warp_def, offsetof(msq_warp_def, u))                            \
  DO(waves_def, sizeof(msq_waves_def))                               \
  DO(beams_def, sizeof(msq_beams_def))                               \
  DO(struts_def, sizeof(msq_struts_def))                             \
  DO(host_structure_def, offsetof(msq_host_structure_def, hash_key)) \
  DO(host_function_def, offsetof(msq_host_function_def, hash_key))   \
  DO(material_def, sizeof(msq_material_def))                         \
  DO(model_def, sizeof(msq_model_def))                               \
  DO(query_def, offsetof(msq_query_def, critical_count))             \
  DO(points_def, offsetof(msq_points_def, seed))                     \
  DO(segments_def, sizeof(msq_segments_def))                         \
  DO(slicer_def, offsetof(msq_slicer_def, window))                   \
  DO(output_def, offsetof(msq_output_def, channel))                  \
  DO(contours_def, offsetof(msq_contours_def, topology_samples))     \
  DO(printability_def, offsetof(msq_printability_def, overhang))     \
  DO(fill_def, offsetof(msq_fill_def, corner_distance))              \
  DO(surface_def, sizeof(msq_surface_def))                           \
  DO(rays_def, sizeof(msq_rays_def))                                 \
  DO(camera, sizeof(msq_camera))                                     \
  DO(render_def, sizeof(msq_render_def))                             \
  DO(frame, sizeof(msq_frame))                                       \
  DO(document_def, sizeof(msq_document_def))                         \
  DO(json_def, sizeof(msq_json_def))

#define DEFINE_ONE(name, first)                           \
  static msq_status init_##name(void* def, size_t size) { \
    return msq_##name##_init((msq_##name*)def, size);     \
  }
FOR_EACH_DEFINITION(DEFINE_ONE)

/* `first`: the size when it was published. */
#define ROW_OF(name, first) {"msq_" #name "_init", init_##name, first, sizeof(msq_##name)},
static const struct {
  const char* function;
  init_fn init;
  size_t first, known;
} definitions[] = {FOR_EACH_DEFINITION(ROW_OF)};

/* def_init of a struct that has `known` bytes, and had `first` when it was published. */
static void check_def_init(init_fn init, size_t first, size_t known) {
  const size_t refused[] = {0, 1, sizeof(void*), first - 1, 4097};
  struct_bytes all, def;
  assert_true(known + struct_tail <= struct_room);
  assert_refused(init(NULL, known), MSQ_E_ARGUMENT, "NULL");

  memset(&def, struct_pattern, sizeof def);
  for (size_t i = 0; i < sizeof refused / sizeof refused[0]; ++i) {
    assert_status(init(&def, refused[i]), MSQ_E_ARGUMENT);
    assert_message_has_number(refused[i]);
    assert_filled(&def, sizeof def, struct_pattern);
  }
#if SIZE_MAX > UINT32_MAX
  assert_refused(init(&def, (size_t)UINT32_MAX + 1), MSQ_E_ARGUMENT, "4294967296");
  assert_filled(&def, sizeof def, struct_pattern);
#endif

  assert_ok(init(&all, known));
  assert_int_equal(all.struct_size, known);
  for (size_t size = first; size <= known + struct_tail; ++size) {
    const size_t shared = size < known ? size : known;
    memset(&def, struct_pattern, sizeof def);
    assert_ok(init(&def, size));
    assert_int_equal(def.struct_size, size);
    assert_memory_equal(def.bytes + 4, all.bytes + 4, shared - 4);
    assert_filled(def.bytes + shared, size - shared, 0);
    assert_filled(def.bytes + size, sizeof def - size, struct_pattern);
  }
}

static void definitions_are_initialised(void** state) {
  (void)state;
  for (size_t i = 0; i < sizeof definitions / sizeof definitions[0]; ++i) {
    print_message("%s\n", definitions[i].function);
    check_def_init(definitions[i].init, definitions[i].first, definitions[i].known);
  }
}

static struct {
  msq_context* context;
  msq_structure *lattice, *foam;
  msq_unit_cell_def cell;
  msq_model* model;
  msq_shape* shape;
  msq_slicer* slicer;
  msq_contours* contours;
  msq_fill* fill;
  msq_strut_graph* graph;
  msq_beam_file* beams;
  msq_job* job;
} of;

/* A report that has `known` bytes, and had `first` when it was published, asked for with every
 * struct_size. */
static void check_report_sizes(size_t first, size_t known, use_fn read, void* env) {
  const uint32_t refused[] = {0, 4, sizeof(void*), (uint32_t)first - 1, 4097, UINT32_MAX};
  struct_bytes all, report;
  assert_true(known + struct_tail <= struct_room);
  assert_refused(read(env, NULL), MSQ_E_ARGUMENT, "report is NULL");

  memset(&report, struct_pattern, sizeof report);
  for (size_t i = 0; i < sizeof refused / sizeof refused[0]; ++i) {
    report.struct_size = refused[i];
    assert_refused(read(env, &report), MSQ_E_ARGUMENT, "struct_size");
    assert_message_has_number(refused[i]);
    assert_filled(report.bytes + 4, sizeof report - 4, struct_pattern);
  }

  all.struct_size = (uint32_t)known;
  assert_ok(read(env, &all));
  for (size_t size = first; size <= known + struct_tail; ++size) {
    const size_t shared = size < known ? size : known;
    memset(&report, struct_pattern, sizeof report);
    report.struct_size = (uint32_t)size;
    assert_ok(read(env, &report));
    assert_int_equal(report.struct_size, size);
    assert_memory_equal(report.bytes + 4, all.bytes + 4, shared - 4);
    assert_filled(report.bytes + shared, size - shared, 0);
    assert_filled(report.bytes + size, sizeof report - size, struct_pattern);
  }
}

#define DEFINE_READ(type, ...)                                        \
  static msq_status read_##type(void* unused, void* report_of_type) { \
    msq_##type* report = (msq_##type*)report_of_type;                 \
    (void)unused;                                                     \
    return __VA_ARGS__;                                               \
  }
static const double low[3] = {0, 0, 0}, high[3] = {2, 2, 2};
DEFINE_READ(build_report, msq_build_info(report))
DEFINE_READ(memory_report, msq_context_memory(of.context, report))
DEFINE_READ(cache_report, msq_cache_stats(of.context, report))
DEFINE_READ(job_report, msq_job_info(of.job, report))
DEFINE_READ(shape_report, msq_shape_info(of.shape, report))
DEFINE_READ(unit_cell_report, msq_unit_cell_info(&of.cell, report, NULL, 0))
DEFINE_READ(lattice_faces_report, msq_lattice_faces(of.lattice, low, high, report, NULL))
DEFINE_READ(slicer_report, msq_slicer_info(of.slicer, report))
DEFINE_READ(contours_report, msq_contours_info(of.contours, report))
DEFINE_READ(printability_report, msq_printability(of.slicer, NULL, NULL, NULL, report, NULL))
DEFINE_READ(fill_report, msq_fill_info(of.fill, report))
DEFINE_READ(strut_graph_report, msq_strut_graph_info(of.graph, report))
#if MSQ_WITH_ASSIMP
DEFINE_READ(beam_file_report, msq_beam_file_info(of.beams, 0, report))
#endif

#define REPORT(type, first) \
  { #type, read_##type, first, sizeof(msq_##type) }
static void reports_are_filled(void** state) {
  const struct {
    const char* name;
    use_fn read;
    size_t first, known;
  } reports[] = {
    REPORT(build_report, offsetof(msq_build_report, with_xxhash)),
    REPORT(memory_report, sizeof(msq_memory_report)),
    REPORT(cache_report, offsetof(msq_cache_report, building_bytes)),
    REPORT(job_report, sizeof(msq_job_report)),
    REPORT(shape_report, sizeof(msq_shape_report)),
    REPORT(unit_cell_report, sizeof(msq_unit_cell_report)),
    REPORT(lattice_faces_report, sizeof(msq_lattice_faces_report)),
    REPORT(slicer_report, offsetof(msq_slicer_report, window)),
    REPORT(contours_report, offsetof(msq_contours_report, topology_count)),
    REPORT(printability_report, offsetof(msq_printability_report, cup_count)),
    REPORT(fill_report, sizeof(msq_fill_report)),
    REPORT(strut_graph_report, sizeof(msq_strut_graph_report)),
#if MSQ_WITH_ASSIMP
    REPORT(beam_file_report, sizeof(msq_beam_file_report)),
#endif
  };
  (void)state;
  for (size_t i = 0; i < sizeof reports / sizeof reports[0]; ++i) {
    print_message("%s\n", reports[i].name);
    check_report_sizes(reports[i].first, reports[i].known, reports[i].read, NULL);
  }
}

/* The report of a calibration may be NULL. */
static void reports_of_calibrations_are_filled(void** state) {
  msq_points_def sample;
  struct_bytes report;
  const size_t known = sizeof(msq_calibration_report);
  (void)state;
  assert_ok(msq_points_def_init(&sample, sizeof sample));
  sample.kind = MSQ_POINTS_STRATIFIED;
  sample.per_cell = 2;
  for (int axis = 0; axis < 3; ++axis) {
    sample.counts[axis] = 4;
    sample.spacing[axis] = 0.25;
  }
  for (size_t size = known; size <= known + struct_tail; ++size) {
    memset(&report, struct_pattern, sizeof report);
    report.struct_size = (uint32_t)size;
    assert_ok(msq_structure_calibrate(of.context, of.lattice, &sample, 0.25, NULL, NULL, 0,
                                      (msq_calibration_report*)&report, NULL));
    assert_filled(report.bytes + known, size - known, 0);
    assert_filled(report.bytes + size, sizeof report - size, struct_pattern);
  }
}

static int make_all(void** state) {
  const msq_slicer_def plan = slicer_def(MSQ_LAYER_BITS, 8, 8, 0.5);
  const msq_fill_def square = square_def(1);
  const msq_struts_def box = struts_def(0, 2);
  msq_contours_def contours;
  (void)state;
  of.context = make_context();
  of.lattice = make_lattice(of.context);
  of.foam = make_foam_of(of.context, 5);
  of.cell = named_cell(MSQ_UNIT_CELL_KELVIN);
  of.model = make_lattice_model(of.context);
  of.shape = make_cube_mesh(of.context);
  of.slicer = make_slicer(of.model, &plan);
  assert_ok(msq_contours_def_init(&contours, sizeof contours));
  contours.tolerance = 0.1;
  assert_ok(msq_layer_contours(of.model, 1, &contours, &of.contours, NULL));
  of.fill = make_fill(of.context, of.foam, &square);
  assert_ok(msq_structure_strut_graph(of.context, of.lattice, &box, &of.graph, NULL));
#if MSQ_WITH_ASSIMP
  {
    const threemf_bytes bytes = threemf_of(THREEMF_BEAMS);
    msq_file_def def;
    assert_ok(msq_file_def_init(&def, sizeof def));
    def.format = MSQ_FORMAT_3MF;
    assert_ok(msq_beam_file_open_memory(of.context, bytes.data, bytes.size, &def, &of.beams, NULL));
    free(bytes.data);
  }
#endif
  assert_ok(msq_job_create(&of.job));
  return 0;
}

static int release_all(void** state) {
  (void)state;
  msq_job_release(of.job);
  msq_beam_file_release(of.beams);
  msq_strut_graph_release(of.graph);
  msq_fill_release(of.fill);
  msq_contours_release(of.contours);
  msq_slicer_release(of.slicer);
  msq_shape_release(of.shape);
  msq_model_release(of.model);
  msq_structure_release(of.foam);
  msq_structure_release(of.lattice);
  msq_context_release(of.context);
  return 0;
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(definitions_are_initialised),
      cmocka_unit_test(reports_are_filled),
      cmocka_unit_test(reports_of_calibrations_are_filled),
  };
  return cmocka_run_group_tests(tests, make_all, release_all);
}
