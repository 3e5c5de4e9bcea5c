/* SPDX-License-Identifier: Apache-2.0
 * msq_printability: known shapes, grids, threads, callbacks. Components of random layers:
 * tests/unit/test_components.cpp. */
#include "definitions.h"
#include "layers.h"

enum { max_findings = 4096 };

typedef struct finding_list {
  msq_finding findings[max_findings];
  uint64_t count, calls;
  pthread_t thread;
  int is_on_other_thread, has_failed;
  uint64_t stop_after; /* calls; 0: never */
} finding_list;

static finding_list list, other_list;

static int32_t take_findings(void* user, const msq_finding* findings, uint64_t count) {
  finding_list* to = (finding_list*)user;
  if (!pthread_equal(pthread_self(), to->thread)) to->is_on_other_thread = 1;
  if (count == 0 || count > 4096) to->has_failed = 1;
  for (uint64_t i = 0; i < count; ++i)
    if (to->count < max_findings) to->findings[to->count++] = findings[i];
  return ++to->calls == to->stop_after ? -11 : 0;
}

static msq_printability_def printability_def(uint32_t kinds, int32_t has_plate) {
  msq_printability_def def;
  assert_ok(msq_printability_def_init(&def, sizeof def));
  def.kinds = kinds;
  def.has_plate = has_plate;
  return def;
}

static msq_printability_report inspect(const msq_slicer* slicer, const msq_printability_def* def,
                                       finding_list* to) {
  msq_printability_report report;
  memset(&report, 0, sizeof report);
  report.struct_size = sizeof report;
  memset(to, 0, sizeof *to);
  to->thread = pthread_self();
  assert_ok(msq_printability(slicer, def, take_findings, to, &report, NULL));
  assert_false(to->is_on_other_thread);
  assert_false(to->has_failed);
  assert_int_equal(to->count, report.island_count + report.loose_count + report.void_count +
                                  report.thin_count + report.cup_count + report.overhang_count);
  return report;
}

static msq_shape* box_of(msq_context* context, double x0, double y0, double z0, double x1,
                         double y1, double z1) {
  const double min[3] = {x0, y0, z0}, max[3] = {x1, y1, z1};
  msq_shape* shape;
  assert_ok(msq_shape_from_box(context, min, max, &shape));
  return shape;
}

/* Takes over the shapes. */
static msq_shape* join(int32_t operation, msq_shape** shapes, uint64_t count) {
  msq_shape* joined;
  assert_ok(msq_shape_boolean(operation, (const msq_shape* const*)shapes, count, &joined));
  for (uint64_t i = 0; i < count; ++i) msq_shape_release(shapes[i]);
  return joined;
}

/* Layers of 0.25. Takes over the shape. */
static msq_slicer* slicer_with_pixels(msq_context* context, msq_shape* shape, double x, double y) {
  msq_model* model = make_shape_model(context, shape);
  msq_slicer_def def;
  msq_slicer* slicer;
  assert_ok(msq_slicer_def_init(&def, sizeof def));
  def.pitch[0] = x;
  def.pitch[1] = y;
  def.layer_height = 0.25;
  slicer = make_slicer(model, &def);
  msq_model_release(model);
  return slicer;
}

/* With pixels of 0.25. */
static msq_slicer* slicer_of(msq_context* context, msq_shape* shape) {
  return slicer_with_pixels(context, shape, 0.25, 0.25);
}

static void assert_box(const msq_finding* found, double x0, double y0, double z0, double x1,
                       double y1, double z1) {
  const double wanted[6] = {x0, y0, z0, x1, y1, z1};
  for (int i = 0; i < 6; ++i)
    assert_near(i < 3 ? found->min[i] : found->max[i - 3], wanted[i], 1e-9);
}

static void defaults_are_those_of_the_header(void** state) {
  msq_printability_def def;
  (void)state;
  assert_ok(msq_printability_def_init(&def, sizeof def));
  assert_int_equal(def.kinds, MSQ_FINDING_ISLAND + MSQ_FINDING_LOOSE + MSQ_FINDING_VOID);
  assert_int_equal(def.has_plate, 1);
  assert_true(def.width == 0 && def.min_volume == 0);
}

/* A block with a ball's hollow and a cavity that opens at the plate. */
static void voids_are_enclosed(void** state) {
  msq_context* context = make_context();
  const double center[3] = {4, 4, 5};
  msq_shape* parts[3] = {box_of(context, 0, 0, 0, 12, 8, 8), NULL,
                         box_of(context, 9, 3, 0, 11, 5, 2)};
  msq_printability_def def = printability_def(MSQ_FINDING_VOID, 1);
  msq_slicer* slicer;
  msq_printability_report report;
  (void)state;
  assert_ok(msq_shape_from_sphere(context, center, 2, &parts[1]));
  slicer = slicer_of(context, join(MSQ_BOOLEAN_DIFFERENCE, parts, 3));
  report = inspect(slicer, &def, &list);
  assert_int_equal(report.layer_count, 32);
  assert_int_equal(report.void_count, 2);
  assert_int_equal(report.island_count + report.loose_count + report.thin_count, 0);
  assert_near(report.void_volume, 4.0 / 3 * 3.14159265 * 8 + 8, 1);
  assert_near(report.solid_volume + report.void_volume, 12 * 8 * 8, 1e-9);
  assert_int_equal(report.solid_count, (uint64_t)(report.solid_volume * 64 + 0.5));
  assert_int_equal(list.findings[0].first_layer, 0);
  assert_int_equal(list.findings[0].last_layer, 7);
  assert_near(list.findings[0].volume, 8, 1e-9);
  assert_box(&list.findings[0], 9, 3, 0, 11, 5, 2);
  assert_near(list.findings[0].point[0], 9.125, 1e-9);
  assert_near(list.findings[0].point[1], 3.125, 1e-9);
  assert_near(list.findings[0].point[2], 0.125, 1e-9);
  assert_int_equal(list.findings[1].kind, MSQ_FINDING_VOID);
  assert_int_equal(list.findings[1].first_layer, 12);
  assert_int_equal(list.findings[1].last_layer, 27);
  assert_box(&list.findings[1], 2, 2, 3, 6, 6, 7);
  assert_int_equal(list.findings[1].sample_count, (uint64_t)(list.findings[1].volume * 64 + 0.5));

  def.has_plate = 0; /* the cavity is open */
  assert_int_equal(inspect(slicer, &def, &list).void_count, 1);
  def.min_volume = 40;
  assert_int_equal(inspect(slicer, &def, &list).void_count, 0);
  msq_slicer_release(slicer);
  msq_context_release(context);
}

/* A hollow with a channel to the side, to the top, or to a corner that only touches. */
static void channels_open_voids(void** state) {
  msq_context* context = make_context();
  const double channels[][6] = {
      {5, 3, 3, 8, 3.25, 3.25}, {3, 3, 5, 3.25, 3.25, 8}, {5, 5, 3, 5.25, 8, 3.25}};
  const uint64_t counts[] = {0, 0, 1}; /* the last one meets the hollow along an edge only */
  (void)state;
  for (int i = 0; i < 3; ++i) {
    const double* c = channels[i];
    msq_shape* parts[3] = {box_of(context, 0, 0, 0, 8, 8, 8), box_of(context, 2, 2, 2, 5, 5, 5),
                           box_of(context, c[0], c[1], c[2], c[3], c[4], c[5])};
    msq_slicer* slicer = slicer_of(context, join(MSQ_BOOLEAN_DIFFERENCE, parts, 3));
    msq_printability_report report = inspect(slicer, NULL, &list);
    assert_int_equal(report.void_count, counts[i]);
    assert_int_equal(report.island_count + report.loose_count, 0);
    msq_slicer_release(slicer);
  }
  msq_context_release(context);
}

/* A beam with a post at one end, four teeth that hang from it, and a bar that hangs in the air. */
static void hanging_parts_are_islands(void** state) {
  msq_context* context = make_context();
  msq_printability_def def =
      printability_def(MSQ_FINDING_ISLAND | MSQ_FINDING_LOOSE | MSQ_FINDING_VOID, 1);
  msq_shape* parts[7] = {box_of(context, 0, 0, 0, 1, 2, 8), box_of(context, 0, 0, 7, 12, 2, 8)};
  msq_printability_report report;
  msq_slicer* slicer;
  (void)state;
  for (int i = 0; i < 4; ++i)
    parts[2 + i] = box_of(context, 2 + 2 * i, 0, 6 - i, 3 + 2 * i, 2, 7.5);
  parts[6] = box_of(context, 10, 0, 2, 11, 2, 3);
  slicer = slicer_of(context, join(MSQ_BOOLEAN_UNION, parts, 7));
  report = inspect(slicer, &def, &list);
  assert_int_equal(report.island_count, 5);
  assert_int_equal(report.loose_count, 1);
  assert_int_equal(report.void_count, 0);
  assert_near(report.island_volume, 5 * 2 * 0.25, 1e-9);
  assert_near(report.loose_volume, 2, 1e-9);
  for (uint64_t i = 0, island = 0; i < list.count; ++i) {
    const msq_finding* found = &list.findings[i];
    if (found->kind == MSQ_FINDING_LOOSE) {
      assert_box(found, 10, 0, 2, 11, 2, 3);
      assert_int_equal(found->first_layer, 8);
      assert_int_equal(found->last_layer, 11);
    } else if (island == 0) {
      assert_box(found, 10, 0, 2, 11, 2, 2.25);
      ++island;
    } else {
      const double x = 10 - 2 * (double)island, z = 2 + (double)island;
      assert_box(found, x, 0, z, x + 1, 2, z + 0.25);
      assert_near(found->volume, 2 * 0.25, 1e-9);
      ++island;
    }
  }
  /* Without a plate too, the first layer has no islands; the bar is still the smaller part. */
  def.has_plate = 0;
  report = inspect(slicer, &def, &other_list);
  assert_int_equal(report.island_count, 5);
  assert_int_equal(report.loose_count, 1);
  assert_near(report.loose_volume, 2, 1e-9);
  msq_slicer_release(slicer);
  msq_context_release(context);
}

/* Two towers: both stand on the plate; in space the smaller one is loose. */
static void only_the_largest_part_counts_without_a_plate(void** state) {
  msq_context* context = make_context();
  for (int larger = 0; larger < 2; ++larger) {
    msq_shape* parts[2] = {box_of(context, 0, 0, 0, 2, 2, larger ? 3 : 6),
                           box_of(context, 4, 0, 0, 6, 2, larger ? 6 : 3)};
    msq_slicer* slicer = slicer_of(context, join(MSQ_BOOLEAN_UNION, parts, 2));
    msq_printability_def def = printability_def(MSQ_FINDING_LOOSE, 1);
    (void)state;
    assert_int_equal(inspect(slicer, &def, &list).loose_count, 0);
    def.has_plate = 0;
    assert_int_equal(inspect(slicer, &def, &list).loose_count, 1);
    assert_near(list.findings[0].volume, 12, 1e-9);
    assert_near(list.findings[0].min[0], larger ? 0 : 4, 1e-9);
    msq_slicer_release(slicer);
  }
  msq_context_release(context);
}

/* Two equal towers in space: the one that begins lower, then at the lower y, then x is kept. */
static void of_equal_parts_the_first_is_kept(void** state) {
  const double places[][6] = {{0, 0, 1, 4, 0, 0}, {4, 0, 0, 0, 0, 1}, {0, 4, 0, 4, 0, 0},
                              {4, 0, 0, 0, 4, 0}, {0, 0, 0, 4, 0, 0}, {4, 0, 0, 0, 0, 0},
                              {0, 0, 0, 0, 4, 1}, {0, 0, 0, 0, 0, 4}};
  const int second_is_kept[] = {1, 0, 1, 0, 0, 1, 0, 0};
  msq_context* context = make_context();
  (void)state;
  for (int i = 0; i < 8; ++i) {
    const double* p = places[i];
    msq_shape* parts[2] = {box_of(context, p[0], p[1], p[2], p[0] + 2, p[1] + 2, p[2] + 3),
                           box_of(context, p[3], p[4], p[5], p[3] + 2, p[4] + 2, p[5] + 3)};
    msq_slicer* slicer = slicer_of(context, join(MSQ_BOOLEAN_UNION, parts, 2));
    msq_printability_def def = printability_def(MSQ_FINDING_LOOSE, 0);
    const double* loose = second_is_kept[i] ? p : p + 3;
    assert_int_equal(inspect(slicer, &def, &list).loose_count, 1);
    assert_box(&list.findings[0], loose[0], loose[1], loose[2], loose[0] + 2, loose[1] + 2,
               loose[2] + 3);
    msq_slicer_release(slicer);
  }
  msq_context_release(context);
}

/* The disc has 6 x 2 of the 8 x 2 pixels across it. A bar of these holds it, though a pixel of the
 * 8 would lie before the grid. */
static void discs_begin_at_the_grids_sides(void** state) {
  msq_context* context = make_context();
  (void)state;
  for (int axis = 0; axis < 2; ++axis) {
    const double size[2] = {axis ? 2 : 1.5, axis ? 1.5 : 2};
    msq_slicer* slicer = slicer_with_pixels(context, box_of(context, 0, 0, 0, size[0], size[1], 1),
                                            axis ? 1 : 0.25, axis ? 0.25 : 1);
    msq_printability_def def = printability_def(MSQ_FINDING_THIN, 1);
    def.width = 2;
    assert_int_equal(inspect(slicer, &def, &list).thin_count, 0);
    msq_slicer_release(slicer);
  }
  msq_context_release(context);
}

/* A wall of 0.75 beside one of 2, both on a block. */
static void thin_walls_are_found(void** state) {
  msq_context* context = make_context();
  msq_shape* parts[3] = {box_of(context, 0, 0, 0, 8, 8, 1), box_of(context, 1, 0, 1, 1.75, 8, 4),
                         box_of(context, 4, 0, 1, 6, 8, 4)};
  msq_slicer* slicer = slicer_of(context, join(MSQ_BOOLEAN_UNION, parts, 3));
  msq_printability_def def = printability_def(MSQ_FINDING_THIN, 1);
  msq_printability_report report;
  (void)state;
  def.width = 1;
  report = inspect(slicer, &def, &list);
  assert_int_equal(report.thin_count, 1);
  assert_box(&list.findings[0], 1, 0, 1, 1.75, 8, 4);
  assert_near(report.thin_volume, 0.75 * 8 * 3, 1e-9);
  def.width = 0.75;
  assert_int_equal(inspect(slicer, &def, &list).thin_count, 0);
  def.width = 2.25;
  assert_int_equal(inspect(slicer, &def, &list).thin_count, 2);
  msq_slicer_release(slicer);
  msq_context_release(context);
}

/* A pot; a well that narrows to its mouth; a bell on the plate with a hole on top; a hollow. */
static void cups_close_while_they_print(void** state) {
  msq_context* context = make_context();
  msq_printability_def def = printability_def(MSQ_FINDING_CUP | MSQ_FINDING_VOID, 1);
  msq_printability_report report;
  msq_slicer* slicer;
  msq_shape* parts[6] = {box_of(context, 0, 0, 0, 16, 4, 8), /* filled with: */
                         box_of(context, 1, 1, 2, 3, 3, 9),     box_of(context, 5, 1, 3, 7, 3, 5),
                         box_of(context, 5.5, 1.5, 4, 6, 2, 9), box_of(context, 9, 1, -1, 11, 3, 4),
                         box_of(context, 13, 1, 2, 15, 3, 4)};
  (void)state;
  slicer = slicer_of(context, join(MSQ_BOOLEAN_DIFFERENCE, parts, 6));
  report = inspect(slicer, &def, &list);
  assert_int_equal(report.void_count, 2); /* the hollow, and the bell without a hole */
  assert_int_equal(report.cup_count, 2);  /* the pot and the well, open at the top */
  assert_near(report.cup_volume, 4 * 6 + 4 * 2 + 0.25 * 3, 1e-9);
  for (uint64_t i = 0; i < list.count; ++i)
    if (list.findings[i].kind == MSQ_FINDING_CUP) assert_int_equal(list.findings[i].last_layer, 31);
  def.has_plate = 0; /* the bell is open below */
  report = inspect(slicer, &def, &list);
  assert_int_equal(report.void_count, 1);
  assert_int_equal(report.cup_count, 2);
  msq_slicer_release(slicer);

  /* The same bell with a hole to the side, 2 above the plate: it is a cup up to there. */
  parts[0] = box_of(context, 0, 0, 0, 8, 8, 8);
  parts[1] = box_of(context, 2, 2, 0, 6, 6, 6);
  parts[2] = box_of(context, 3, 3, 2, 4, 9, 3);
  slicer = slicer_of(context, join(MSQ_BOOLEAN_DIFFERENCE, parts, 3));
  def.has_plate = 1;
  report = inspect(slicer, &def, &list);
  assert_int_equal(report.void_count, 0);
  assert_int_equal(report.cup_count, 1);
  assert_near(list.findings[0].volume, 4 * 4 * 2, 1e-9);
  assert_int_equal(list.findings[0].first_layer, 0);
  assert_int_equal(list.findings[0].last_layer, 7);
  assert_box(&list.findings[0], 2, 2, 0, 6, 6, 2);
  def.has_plate = 0;
  assert_int_equal(inspect(slicer, &def, &list).cup_count, 0);
  msq_slicer_release(slicer);
  msq_context_release(context);
}

/* A post with a plate on top, which is wider by 2, and steps of 0.25 per layer. */
static void overhangs_reach_beyond_the_layer_below(void** state) {
  msq_context* context = make_context();
  msq_printability_def def = printability_def(MSQ_FINDING_OVERHANG, 1);
  msq_printability_report report;
  msq_slicer* slicer;
  msq_shape* parts[6] = {box_of(context, 2, 0, 0, 4, 4, 6), box_of(context, 0, 0, 3, 6, 4, 6)};
  (void)state;
  for (int i = 0; i < 4; ++i)
    parts[2 + i] = box_of(context, 8, 0, 0.25 * i, 10 + 0.25 * i, 4, 0.25 * (i + 1));
  slicer = slicer_of(context, join(MSQ_BOOLEAN_UNION, parts, 6));
  def.overhang = 0.5;
  report = inspect(slicer, &def, &list);
  assert_int_equal(report.overhang_count, 2);
  const int left = list.findings[1].min[0] < 1;
  assert_box(&list.findings[left], 0, 0, 3, 1.5, 4, 3.25);
  assert_box(&list.findings[1 - left], 4.5, 0, 3, 6, 4, 3.25);
  assert_near(report.overhang_volume, 2 * 1.5 * 4 * 0.25, 1e-9);
  def.overhang = 0; /* the three steps too */
  report = inspect(slicer, &def, &list);
  assert_int_equal(report.overhang_count, 5);
  assert_near(report.overhang_volume, (2 * 2 + 3 * 0.25) * 4 * 0.25, 1e-9);
  def.overhang = 2;
  assert_int_equal(inspect(slicer, &def, &list).overhang_count, 0);
  msq_slicer_release(slicer);
  msq_context_release(context);
}

/* Runs and totals count, not only masks. */
static void memory_is_accounted(void** state) {
  uint64_t peaks[2];
  (void)state;
  for (int fine = 0; fine < 2; ++fine) {
    msq_context* context = make_context();
    msq_structure* lattice =
        make_lattice_of(context, MSQ_UNIT_CELL_CUBIC, fine ? 0.25 : 8, fine ? 0.06 : 0.1);
    msq_model* model = make_model(context, box_of(context, 0, 0, 0, 8, 8, 1), lattice, NULL);
    msq_slicer_def plan = slicer_def(MSQ_LAYER_BITS, 160, 160, 0.05);
    msq_printability_def def = printability_def(MSQ_FINDING_THIN, 1);
    msq_slicer* slicer;
    plan.slab_layers = 2;
    slicer = make_slicer(model, &plan);
    def.width = 0.2;
    inspect(slicer, &def, &list);
    peaks[fine] = memory_of(context).peak_bytes;
    msq_slicer_release(slicer);
    msq_model_release(model);
    msq_context_release(context);
  }
  /* 1000 struts cross a layer, each with a component and several runs. */
  assert_true(peaks[1] > peaks[0] + 1000 * 100);
}

/* Heights as they are listed. */
static void volumes_follow_listed_heights(void** state) {
  const double heights[] = {0.5, 1, 2, 4, 5};
  msq_context* context = make_context();
  msq_shape* parts[2] = {box_of(context, 0, 0, 0, 8, 8, 6), box_of(context, 2, 2, 0.75, 6, 6, 4.5)};
  msq_model* model = make_shape_model(context, join(MSQ_BOOLEAN_DIFFERENCE, parts, 2));
  msq_slicer_def plan = slicer_def(MSQ_LAYER_BITS, 16, 16, 0);
  msq_slicer* slicer;
  msq_printability_report report;
  (void)state;
  plan.layer_z = heights;
  plan.layer_z_count = 5;
  slicer = make_slicer(model, &plan);
  report = inspect(slicer, NULL, &list);
  assert_int_equal(report.void_count, 1);
  /* From 0.75 to 4.5: layers 1, 2, 3 with heights of 0.75, 1.5, 1.5. */
  assert_near(report.void_volume, 16 * 3.75, 1e-9);
  assert_box(&list.findings[0], 2, 2, 0.75, 6, 6, 4.5);
  assert_near(report.solid_volume, 64 * 5.25 - 16 * 3.75, 1e-9);
  msq_slicer_release(slicer);

  /* A window keeps the faces of the whole plan; its first layer lies on the plate. */
  plan.window.first[0] = plan.window.first[1] = 2;
  plan.window.count[0] = plan.window.count[1] = 12;
  plan.window.first[2] = 1;
  plan.window.count[2] = 3;
  slicer = make_slicer(model, &plan);
  assert_int_equal(inspect(slicer, NULL, &list).void_count, 0); /* open above */
  msq_slicer_release(slicer);
  plan.window.count[2] = 4;
  slicer = make_slicer(model, &plan);
  assert_int_equal(inspect(slicer, NULL, &list).void_count, 1);
  assert_int_equal(list.findings[0].first_layer, 0);
  assert_box(&list.findings[0], 2, 2, 0.75, 6, 6, 4.5);
  msq_slicer_release(slicer);
  plan.window.first[0] = 4; /* the side cuts the void open */
  slicer = make_slicer(model, &plan);
  assert_int_equal(inspect(slicer, NULL, &list).void_count, 0);
  msq_slicer_release(slicer);
  msq_model_release(model);
  msq_context_release(context);
}

static msq_structure* closed_foam(msq_context* context) {
  msq_foam_def def;
  msq_structure* foam;
  assert_ok(msq_foam_def_init(&def, sizeof def));
  def.wall_thickness.value = 0.12;
  assert_ok(msq_structure_foam(context, &def, &foam));
  return foam;
}

static void results_do_not_depend_on_threads_and_output(void** state) {
  const uint32_t threads[] = {1, 2, 4}, slabs[] = {0, 1, 7};
  msq_printability_def def = printability_def(63, 1);
  (void)state;
  def.width = 0.3;
  def.overhang = 0.05;
  for (int structure = 0; structure < 3; ++structure) {
    msq_printability_report first;
    for (int i = 0; i < 4; ++i) {
      msq_context* context = make_context_of(threads[i % 3], i == 3 ? 0 : 1 << 28, 0);
      msq_structure* filling = structure == 0 ? closed_foam(context)
                               : structure == 1
                                   ? make_lattice_of(context, MSQ_UNIT_CELL_BCC, 1, 0.1)
                                   : make_foam(context, MSQ_FOAM_AUTO);
      const double center[3] = {2, 2, 2};
      msq_shape* ball;
      msq_model* model;
      msq_slicer_def plan = slicer_def(i == 3 ? MSQ_LAYER_GREY : MSQ_LAYER_BITS, 70, 60, 0.07);
      msq_slicer* slicer;
      msq_printability_report report;
      assert_ok(msq_shape_from_sphere(context, center, 2, &ball));
      model = make_model(context, ball, filling, NULL);
      if (structure == 0) { /* large enough for workers to share a layer */
        plan.resolution[0] = 260;
        plan.resolution[1] = 300;
      }
      plan.slab_layers = slabs[i % 3];
      if (i == 3) plan.orientation = MSQ_LAYER_TRANSPOSE | MSQ_LAYER_MIRROR_X;
      slicer = make_slicer(model, &plan);
      report = inspect(slicer, &def, i ? &other_list : &list);
      if (i == 0) {
        first = report;
        assert_true(report.thin_count > 0);
        if (structure == 0) assert_true(report.void_count >= 8);
        if (structure == 1) assert_true(report.island_count >= 8 && report.loose_count > 0);
      }
      assert_memory_equal(&first, &report, sizeof report);
      if (i) assert_memory_equal(list.findings, other_list.findings, sizeof list.findings);
      msq_slicer_release(slicer);
      msq_model_release(model);
      msq_context_release(context);
    }
  }
}

/* Layers of 4096 x 4096 pixels, 2 MiB each: slabs of several layers; a limit that makes the slicer
 * fill layers one by one; and one thread, which fills them in bands that stay in its caches. */
static void limits_and_bands_change_nothing(void** state) {
  msq_printability_def def = printability_def(MSQ_FINDING_ISLAND + MSQ_FINDING_LOOSE, 1);
  msq_printability_report reports[3];
  uint64_t peaks[3];
  (void)state;
  for (int part = 0; part < 3; ++part) {
    const double center[3] = {2, 2, 2};
    const int limited = part == 1;
    msq_context* context = make_context_of(part == 2 ? 1 : 2, limited ? 1 << 20 : 1 << 28,
                                           limited ? (uint64_t)16 << 20 : 0);
    msq_shape* ball;
    msq_model* model;
    msq_slicer_def plan = slicer_def(MSQ_LAYER_BITS, 4096, 4096, 0.5);
    msq_slicer* slicer;
    assert_ok(msq_shape_from_sphere(context, center, 2, &ball));
    model = make_model(context, ball, make_lattice_of(context, MSQ_UNIT_CELL_BCC, 1, 0.1), NULL);
    slicer = make_slicer(model, &plan);
    reports[part] = inspect(slicer, &def, part ? &other_list : &list);
    peaks[part] = memory_of(context).peak_bytes;
    msq_slicer_release(slicer);
    msq_model_release(model);
    msq_context_release(context);
    assert_memory_equal(&reports[0], &reports[part], sizeof reports[0]);
    if (part) assert_memory_equal(list.findings, other_list.findings, sizeof list.findings);
  }
  assert_true(list.count > 8);
  assert_true(peaks[1] <= (uint64_t)16 << 20 && peaks[1] < peaks[0]);
}

static void callbacks_stop_the_call(void** state) {
  msq_context* context = make_context();
  msq_shape* parts[2] = {box_of(context, 0, 0, 0, 8, 8, 8), box_of(context, 2, 2, 2, 5, 5, 5)};
  msq_slicer* slicer = slicer_of(context, join(MSQ_BOOLEAN_DIFFERENCE, parts, 2));
  msq_printability_report report, before;
  msq_job* job;
  (void)state;
  memset(&report, 7, sizeof report);
  report.struct_size = sizeof report;
  before = report;
  memset(&list, 0, sizeof list);
  list.thread = pthread_self();
  list.stop_after = 1;
  assert_status(msq_printability(slicer, NULL, take_findings, &list, &report, NULL), MSQ_E_HOST);
  assert_int_equal(msq_error_host_code(), -11);
  assert_memory_equal(&report, &before, sizeof report);
  assert_ok(msq_job_create(&job));
  { /* what reaches the last layer is told after it */
    msq_shape* apart[2] = {box_of(context, 0, 0, 0, 8, 8, 8), box_of(context, 9, 0, 0, 12, 8, 8)};
    msq_slicer* of_two = slicer_of(context, join(MSQ_BOOLEAN_UNION, apart, 2));
    const msq_printability_def loose = printability_def(MSQ_FINDING_LOOSE, 0);
    list.calls = 0;
    assert_status(msq_printability(of_two, &loose, take_findings, &list, &report, job), MSQ_E_HOST);
    assert_true(progress_of(job) < 1);
    msq_slicer_release(of_two);
  }
  assert_ok(msq_printability(slicer, NULL, NULL, NULL, &report, job)); /* no list */
  assert_int_equal(report.void_count, 1);
  assert_true(progress_of(job) == 1);
  msq_job_release(job);
  msq_slicer_release(slicer);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(defaults_are_those_of_the_header),
      cmocka_unit_test(voids_are_enclosed),
      cmocka_unit_test(channels_open_voids),
      cmocka_unit_test(hanging_parts_are_islands),
      cmocka_unit_test(only_the_largest_part_counts_without_a_plate),
      cmocka_unit_test(of_equal_parts_the_first_is_kept),
      cmocka_unit_test(discs_begin_at_the_grids_sides),
      cmocka_unit_test(thin_walls_are_found),
      cmocka_unit_test(cups_close_while_they_print),
      cmocka_unit_test(overhangs_reach_beyond_the_layer_below),
      cmocka_unit_test(memory_is_accounted),
      cmocka_unit_test(volumes_follow_listed_heights),
      cmocka_unit_test(results_do_not_depend_on_threads_and_output),
      cmocka_unit_test(limits_and_bands_change_nothing),
      cmocka_unit_test(callbacks_stop_the_call),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
