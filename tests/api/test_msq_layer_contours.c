/* SPDX-License-Identifier: Apache-2.0
 * msq_layer_contours, msq_slicer_contours and msq_contours_info. What contours must be like:
 * tests/unit/test_contours.cpp. */
#include "definitions.h"
#include "fixtures.h"
#include "layers.h"

static msq_contours_def contours_def(int32_t type, double tolerance) {
  msq_contours_def def;
  assert_ok(msq_contours_def_init(&def, sizeof def));
  def.type = type;
  def.tolerance = tolerance;
  if (type != MSQ_FLOAT64) def.units = 1e5;
  return def;
}

static msq_contours_report contents_of(const msq_contours* contours) {
  msq_contours_report report;
  memset(&report, 0, sizeof report);
  report.struct_size = sizeof report;
  assert_ok(msq_contours_info(contours, &report));
  return report;
}

static double coordinate(const msq_contours_report* report, uint64_t n) {
  return report->type == MSQ_INT32   ? (double)((const int32_t*)report->points)[n]
         : report->type == MSQ_INT64 ? (double)((const int64_t*)report->points)[n]
                                     : ((const double*)report->points)[n];
}

static double area_of(const msq_contours_report* report) {
  double sum = 0;
  for (uint64_t r = 0; r < report->ring_count; ++r) {
    const uint64_t first = report->starts[r], end = report->starts[r + 1];
    for (uint64_t i = first; i < end; ++i) {
      const uint64_t k = i + 1 < end ? i + 1 : first;
      sum += 0.5 * (coordinate(report, 2 * i) * coordinate(report, 2 * k + 1) -
                    coordinate(report, 2 * k) * coordinate(report, 2 * i + 1));
    }
  }
  return sum;
}

static void types_have_the_same_rings(void** state) {
  const int32_t types[] = {MSQ_FLOAT64, MSQ_INT64, MSQ_INT32};
  msq_context* context = make_context();
  msq_model* model = make_lattice_model(context);
  double low[3], high[3], area = 0;
  uint64_t points = 0;
  (void)state;
  assert_ok(msq_model_bounds(model, low, high));
  for (int i = 0; i < 3; ++i) {
    const msq_contours_def def = contours_def(types[i], 0.02);
    msq_contours* contours;
    msq_contours_report report;
    assert_ok(msq_layer_contours(model, 0.5 * (low[2] + high[2]) + 0.1, &def, &contours, NULL));
    msq_contours_retain(contours);
    msq_contours_release(contours);
    report = contents_of(contours);
    assert_int_equal(report.type, types[i]);
    assert_true(report.ring_count > 0);
    assert_int_equal(report.starts[0], 0);
    assert_int_equal(report.starts[report.ring_count], report.point_count);
    assert_int_equal(report.parents[0], -1);
    assert_int_equal(report.holes[0], 0);
    assert_near(report.pitch, 0.02, 0.005);
    for (uint64_t n = 0; n < 2 * report.point_count; ++n) {
      assert_true(coordinate(&report, n) >= (low[n % 2] - 1e-4) * def.units);
      assert_true(coordinate(&report, n) <= (high[n % 2] + 1e-4) * def.units);
    }
    if (i == 0) {
      area = area_of(&report);
      assert_true(area > 0);
    } else {
      assert_near(area_of(&report) / (def.units * def.units), area, 1e-3 * area);
    }
    if (i == 1) points = report.point_count;
    if (i == 2) assert_int_equal(report.point_count, points);
    msq_contours_release(contours);
  }
  msq_model_release(model);
  msq_context_release(context);
}

/* A comparison with a mask changes no ring. It counts what is thinner than the pitch. */
static void topology_is_counted_on_demand(void** state) {
  msq_context* context = make_context();
  msq_model* model = make_lattice_model(context);
  msq_contours_def def = contours_def(MSQ_FLOAT64, 0.02);
  double low[3], high[3];
  (void)state;
  assert_ok(msq_model_bounds(model, low, high));
  for (int i = 0; i < 2; ++i) {
    const double height = low[2] + 0.3 * (high[2] - low[2]);
    msq_contours *plain, *compared;
    msq_contours_report a, b;
    def.pitch = i == 0 ? 0.02 : 0.5;
    def.topology_samples = 0;
    assert_ok(msq_layer_contours(model, height, &def, &plain, NULL));
    def.topology_samples = 8;
    assert_ok(msq_layer_contours(model, height, &def, &compared, NULL));
    a = contents_of(plain);
    b = contents_of(compared);
    assert_int_equal(a.topology_samples, 0);
    assert_int_equal(a.topology_count, 0);
    assert_int_equal(b.topology_samples, 8);
    if (i == 0)
      assert_int_equal(b.topology_count, 0);
    else
      assert_true(b.topology_count > 0);
    assert_int_equal(a.point_count, b.point_count);
    assert_memory_equal(a.points, b.points, a.point_count * 2 * sizeof(double));
    msq_contours_release(plain);
    msq_contours_release(compared);
  }
  msq_model_release(model);
  msq_context_release(context);
}

static void layers_of_slicers_are_those_of_models(void** state) {
  msq_context* context = make_context();
  msq_model* model = make_lattice_model(context);
  const msq_slicer_def plan = slicer_def(MSQ_LAYER_BITS, 70, 45, 0.25);
  msq_slicer* slicer = make_slicer(model, &plan);
  const msq_slicer_report pixels = plan_of(slicer);
  msq_contours_def def = contours_def(MSQ_INT64, 0.03);
  msq_contours *of_slicer, *of_model;
  msq_contours_report a, b;
  double z;
  (void)state;
  assert_ok(msq_slicer_contours(slicer, 2, &def, &of_slicer, NULL));
  assert_ok(msq_slicer_layer_z(slicer, 2, &z));
  def.has_window = 1;
  for (int i = 0; i < 2; ++i) {
    def.window_min[i] = pixels.origin[i] - 0.5 * pixels.pitch[i];
    def.window_max[i] =
        pixels.origin[i] + ((i == 0 ? pixels.width : pixels.height) - 0.5) * pixels.pitch[i];
  }
  assert_ok(msq_layer_contours(model, z, &def, &of_model, NULL));
  a = contents_of(of_slicer);
  b = contents_of(of_model);
  assert_true(a.ring_count > 0);
  assert_int_equal(a.ring_count, b.ring_count);
  assert_int_equal(a.point_count, b.point_count);
  assert_memory_equal(a.points, b.points, a.point_count * 2 * sizeof(int64_t));
  assert_memory_equal(a.starts, b.starts, (a.ring_count + 1) * sizeof(uint64_t));
  msq_contours_release(of_slicer);
  msq_contours_release(of_model);
  msq_slicer_release(slicer);
  msq_model_release(model);
  msq_context_release(context);
}

static void layers_beside_the_model_are_empty(void** state) {
  msq_context* context = make_context();
  msq_model* model = make_lattice_model(context);
  msq_contours_def def = contours_def(MSQ_FLOAT64, 0.05);
  double low[3], high[3];
  (void)state;
  assert_ok(msq_model_bounds(model, low, high));
  for (int beside = 0; beside < 2; ++beside) {
    msq_contours* contours;
    msq_contours_report report;
    if (beside) {
      def.has_window = 1;
      for (int i = 0; i < 2; ++i) {
        def.window_min[i] = high[i] + 10;
        def.window_max[i] = high[i] + 20;
      }
    }
    assert_ok(msq_layer_contours(model, beside ? low[2] : high[2] + 1, &def, &contours, NULL));
    report = contents_of(contours);
    assert_int_equal(report.ring_count, 0);
    assert_int_equal(report.point_count, 0);
    assert_int_equal(report.starts[0], 0);
    assert_int_equal(report.unresolved_count, 0);
    msq_contours_release(contours);
  }
  msq_model_release(model);
  msq_context_release(context);
}

static double area_of_model(const msq_model* model) {
  const msq_contours_def def = contours_def(MSQ_FLOAT64, 0.02);
  msq_contours* contours;
  assert_ok(msq_layer_contours(model, 1.1, &def, &contours, NULL));
  const msq_contours_report report = contents_of(contours);
  const double area = area_of(&report);
  msq_contours_release(contours);
  return area;
}

/* Regions with one scale of struts among them: the area of the model is that of its regions. */
static void regions_have_struts_of_their_own(void** state) {
  msq_context* context = make_context();
  (void)state;
  for (int is_foam = 0; is_foam < 2; ++is_foam) {
    msq_structure* struts = is_foam ? make_foam(context, MSQ_FOAM_AUTO) : make_lattice(context);
    msq_model* of_struts = make_model(context, make_box(context), struts, NULL);
    msq_model* solid = make_shape_model(context, make_box_of(context, 0.5, 6));
    double low[3] = {6.5, 0, 0}, high[3] = {8, 3, 4};
    msq_shape* apart;
    assert_ok(msq_shape_from_box(context, low, high, &apart));
    msq_model* block = make_shape_model(context, apart);
    const msq_model* const regions[2][2] = {{of_struts, block}, {solid, of_struts}};
    msq_model* model;
    assert_ok(msq_model_regions(context, regions[0], 2, &model));
    assert_near(area_of_model(model), area_of_model(of_struts) + 4.5, 0.02);
    msq_model_release(model);
    /* Where the first region is solid, struts count for nothing. */
    assert_ok(msq_model_regions(context, regions[1], 2, &model));
    assert_true(area_of_model(model) > 5.5 * 5.5 - 0.01);
    assert_true(area_of_model(model) < 5.5 * 5.5 + 0.5 * 8);
    msq_model_release(model);
    msq_model_release(of_struts);
    msq_model_release(solid);
    msq_model_release(block);
  }
  msq_context_release(context);
}

/* Crossings keep a part of the pitch away from nodes, which must be less than the window. */
static void rings_stay_in_windows_below_the_pitch(void** state) {
  msq_context* context = make_context();
  msq_shape* ball;
  const double center[3] = {0, 0, 0};
  msq_contours* contours = NULL;
  (void)state;
  assert_ok(msq_shape_from_sphere(context, center, 2, &ball));
  msq_model* model = make_shape_model(context, ball);
  msq_contours_def def = contours_def(MSQ_FLOAT64, 0.05);
  def.has_window = 1;
  for (int i = 0; i < 2; ++i) {
    def.window_min[i] = 0.25;
    def.window_max[i] = 2.25;
  }
  for (double pitch = 1; pitch <= 0x1p18; pitch *= 8) {
    def.pitch = pitch;
    assert_ok(msq_layer_contours(model, 0.5, &def, &contours, NULL));
    const msq_contours_report report = contents_of(contours);
    assert_true(report.ring_count == 1);
    for (uint64_t n = 0; n < 2 * report.point_count; ++n) {
      assert_true(coordinate(&report, n) >= 0.25);
      assert_true(coordinate(&report, n) <= 2.25);
    }
    msq_contours_release(contours);
  }
  def.pitch = 0x1p20;
  assert_int_equal(msq_layer_contours(model, 0.5, &def, &contours, NULL), MSQ_E_ARGUMENT);
  assert_message_has("side of the window is 2");
  msq_model_release(model);
  msq_context_release(context);
}

static void memory_is_limited(void** state) {
  msq_context* context = make_context_of(1, 1 << 20, 8 << 20);
  msq_model* model = make_lattice_model(context);
  const msq_contours_def def = contours_def(MSQ_FLOAT64, 1e-4);
  (void)state;
  assert_makes_nothing(msq_contours, msq_layer_contours(model, 1, &def, &made, NULL), MSQ_E_LIMIT,
                       "the nodes of a layer");
  msq_model_release(model);
  msq_context_release(context);
}

/* Planes normal to x and y hold bands of rows of which a word has one node, or which are layers. */
static void memory_of_planes_is_counted(void** state) {
  const uint64_t limits[] = {0, 6 << 20};
  (void)state;
  for (int axis = 0; axis < 3; ++axis) {
    uint64_t points = 0;
    for (int i = 0; i < 2; ++i) {
      msq_context* context = make_context_of(1, 1 << 20, limits[i]);
      msq_model* model = make_lattice_model(context);
      msq_contours_def def = contours_def(MSQ_FLOAT64, 0.002);
      msq_contours* contours;
      double low[3], high[3];
      assert_ok(msq_model_bounds(model, low, high));
      def.axis = axis;
      def.pitch = (high[0] - low[0]) / 1000;
      def.tolerance = def.pitch;
      assert_ok(
          msq_layer_contours(model, 0.4 * low[axis] + 0.6 * high[axis], &def, &contours, NULL));
      if (i == 0) {
        points = contents_of(contours).point_count;
        assert_true(points > 1000);
        if (axis == 0) assert_true(memory_of(context).peak_bytes > 1000 * 1000 * sizeof(uint64_t));
      } else {
        assert_int_equal(contents_of(contours).point_count, points);
      }
      msq_contours_release(contours);
      msq_model_release(model);
      msq_context_release(context);
    }
  }
}

/* The nodes and crossings are the same with both tolerances. */
static void memory_of_details_is_counted(void** state) {
  uint64_t points[2], peaks[2];
  (void)state;
  for (int i = 0; i < 2; ++i) {
    msq_context* context = make_context_of(1, 1 << 20, 0);
    msq_model* model = make_lattice_model(context);
    msq_contours_def def = contours_def(MSQ_FLOAT64, i == 0 ? 0.02 : 0.0002);
    msq_contours* contours;
    def.pitch = 0.02;
    assert_ok(msq_layer_contours(model, 1.1, &def, &contours, NULL));
    points[i] = contents_of(contours).point_count;
    peaks[i] = memory_of(context).peak_bytes;
    msq_contours_release(contours);
    msq_model_release(model);
    msq_context_release(context);
  }
  assert_true(points[1] > points[0] + 1000);
  assert_true(peaks[1] > peaks[0] + 64 * (points[1] - points[0]));
}

#define MAX_CORNERS 24

/* A prism over a polygon of count corners, counter-clockwise, all of which the first one sees. */
static msq_model* make_prism(msq_context* context, double (*corners)[2], uint32_t count) {
  double vertices[2 * MAX_CORNERS][3];
  uint32_t triangles[4 * MAX_CORNERS - 4][3], made = 0;
  for (uint32_t i = 0; i < 2 * count; ++i) {
    vertices[i][0] = corners[i % count][0];
    vertices[i][1] = corners[i % count][1];
    vertices[i][2] = i < count ? -5 : 5;
  }
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t next = (i + 1) % count;
    const uint32_t of_side[2][3] = {{i, next, next + count}, {i, next + count, i + count}};
    memcpy(triangles[made], of_side, sizeof of_side);
    made += 2;
    if (i == 0 || next == 0) continue;
    const uint32_t of_ends[2][3] = {{0, next, i}, {count, i + count, next + count}};
    memcpy(triangles[made], of_ends, sizeof of_ends);
    made += 2;
  }
  msq_mesh_def def;
  assert_ok(msq_mesh_def_init(&def, sizeof def));
  def.vertices = vertices;
  def.vertex_count = 2 * count;
  def.triangles = triangles[0];
  def.triangle_count = made;
  msq_shape* prism;
  assert_ok(msq_shape_from_mesh(context, &def, &prism));
  return make_shape_model(context, prism);
}

static double distance_to_segment(const double p[2], const double a[2], const double b[2]) {
  const double way[2] = {b[0] - a[0], b[1] - a[1]}, from[2] = {p[0] - a[0], p[1] - a[1]};
  const double along = (from[0] * way[0] + from[1] * way[1]) / (way[0] * way[0] + way[1] * way[1]);
  const double t = along < 0 ? 0 : along > 1 ? 1 : along;
  return hypot(from[0] - t * way[0], from[1] - t * way[1]);
}

/* Corners of a polygon, made so that it turns and moves within a cell at random. */
static void place_corners(uint64_t* random, double (*corners)[2], uint32_t count) {
  const double turn = random_between(random, 0, 7);
  const double middle[2] = {random_between(random, 0, 1), random_between(random, 0, 1)};
  for (uint32_t k = 0; k < count; ++k) {
    const double u = corners[k][0], v = corners[k][1];
    corners[k][0] = middle[0] + u * cos(turn) - v * sin(turn);
    corners[k][1] = middle[1] + u * sin(turn) + v * cos(turn);
  }
}

/* Corners are within the tolerance of the ring, at a pitch of 1, unless places are counted where
 * they may not be. */
static void assert_ring_has_corners(msq_context* context, int polygon, double (*corners)[2],
                                    uint32_t count, double tolerance) {
  msq_model* model = make_prism(context, corners, count);
  msq_contours_def def = contours_def(MSQ_FLOAT64, tolerance);
  def.pitch = 1;
  msq_contours* contours;
  assert_ok(msq_layer_contours(model, 0.3, &def, &contours, NULL));
  const msq_contours_report report = contents_of(contours);
  assert_int_equal(report.ring_count, 1);
  const double* points = report.points;
  for (uint32_t k = 0; k < count && report.unresolved_count == 0; ++k) {
    double distance = 1e9;
    for (uint64_t n = 0; n < report.point_count; ++n)
      distance = fmin(distance, distance_to_segment(corners[k], points + 2 * n,
                                                    points + 2 * ((n + 1) % report.point_count)));
    if (distance > 1.02 * tolerance)
      fail_msg("polygon %d: corner (%g, %g) is %g from the ring; the tolerance is %g", polygon,
               corners[k][0], corners[k][1], distance, tolerance);
  }
  msq_contours_release(contours);
  msq_model_release(model);
}

/* Corners of polygons, which may be two or three crossings apart, are within the tolerance. */
static void corners_are_points_of_rings(void** state) {
  (void)state;
  static const double tolerances[] = {0.5, 0.25, 0.125, 0.1, 0.05, 0.02};
  msq_context* context = make_context();
  uint64_t random = 1;
  for (int i = 0; i < 1500; ++i) {
    const uint32_t count = 4 + (uint32_t)(i % 4);
    const double size = random_between(&random, 2, 8);
    const double flat = random_between(&random, 0.5, 1), tolerance = tolerances[i % 6];
    double corners[MAX_CORNERS][2], least = 1e9;
    for (uint32_t k = 0; k < count; ++k) {
      const double angle = (k + random_between(&random, 0, 0.6)) * 2 * acos(-1) / count;
      corners[k][0] = size * cos(angle);
      corners[k][1] = size * flat * sin(angle);
    }
    place_corners(&random, corners, count);
    for (uint32_t k = 0; k < count; ++k) {
      const double* next = corners[(k + 1) % count];
      least = fmin(least, hypot(next[0] - corners[k][0], next[1] - corners[k][1]));
    }
    if (least >= 1.5) assert_ring_has_corners(context, i, corners, count, tolerance);
  }
  msq_context_release(context);
}

/* Crossings of a regular polygon with many corners are as on a circle. */
static void corners_of_regular_polygons_are_points_of_rings(void** state) {
  (void)state;
  msq_context* context = make_context();
  uint64_t random = 2;
  for (int i = 0; i < 1500; ++i) {
    const uint32_t count = 8 + (uint32_t)(i % 17);
    const double size = random_between(&random, 1.45, 1.9) * count / (2 * acos(-1));
    const double tolerance = random_between(&random, 0.015, 0.1);
    double corners[MAX_CORNERS][2];
    for (uint32_t k = 0; k < count; ++k) {
      const double angle = k * 2 * acos(-1) / count;
      corners[k][0] = size * cos(angle);
      corners[k][1] = size * sin(angle);
    }
    place_corners(&random, corners, count);
    assert_ring_has_corners(context, i, corners, count, tolerance);
  }
  msq_context_release(context);
}

/* A step between two straight edges turns one way and then the other. */
static void corners_of_steps_are_points_of_rings(void** state) {
  (void)state;
  msq_context* context = make_context();
  uint64_t random = 3;
  for (int i = 0; i < 3000; ++i) {
    const double height = random_between(&random, 1.2, 3);
    const double slope = random_between(&random, 0.1, 1.2);
    double corners[MAX_CORNERS][2] = {{-6, -6},    {6, -6},     {6, 0}, {slope * height, 0},
                                      {0, height}, {-6, height}};
    place_corners(&random, corners, 6);
    assert_ring_has_corners(context, i, corners, 6, random_between(&random, 0.02, 0.2));
  }
  msq_context_release(context);
}

/* Crossings are found to the spacing of numbers, if the tolerance asks for more. */
static void tolerances_below_the_spacing_of_numbers_end(void** state) {
  (void)state;
  static const double cases[][4] = {/* radius, x of the centre, pitch, tolerance */
                                    {10, 0, 0.5, 1e-12},
                                    {0.05, 1e6, 1e-3, 1e-8},
                                    {50, 1e11, 1, 0.01},
                                    {50, 1e12, 1, 0.1}};
  msq_context* context = make_context();
  for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
    const double centre[3] = {cases[i][1], 0, 0}, radius = cases[i][0];
    msq_shape* ball;
    assert_ok(msq_shape_from_sphere(context, centre, radius, &ball));
    msq_model* model = make_shape_model(context, ball);
    msq_contours_def def = contours_def(MSQ_FLOAT64, cases[i][3]);
    def.pitch = cases[i][2];
    msq_contours* contours;
    assert_ok(msq_layer_contours(model, 0, &def, &contours, NULL));
    const msq_contours_report report = contents_of(contours);
    assert_int_equal(report.ring_count, 1);
    const double area = acos(-1) * radius * radius;
    assert_true(fabs(area_of(&report) - area) <= 0.01 * area);
    msq_contours_release(contours);
    msq_model_release(model);
  }
  msq_context_release(context);
}

static void release_of_null_does_nothing(void** state) {
  (void)state;
  msq_contours_retain(NULL);
  msq_contours_release(NULL);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(types_have_the_same_rings),
      cmocka_unit_test(topology_is_counted_on_demand),
      cmocka_unit_test(layers_of_slicers_are_those_of_models),
      cmocka_unit_test(layers_beside_the_model_are_empty),
      cmocka_unit_test(regions_have_struts_of_their_own),
      cmocka_unit_test(rings_stay_in_windows_below_the_pitch),
      cmocka_unit_test(memory_is_limited),
      cmocka_unit_test(memory_of_planes_is_counted),
      cmocka_unit_test(memory_of_details_is_counted),
      cmocka_unit_test(corners_are_points_of_rings),
      cmocka_unit_test(corners_of_regular_polygons_are_points_of_rings),
      cmocka_unit_test(corners_of_steps_are_points_of_rings),
      cmocka_unit_test(tolerances_below_the_spacing_of_numbers_end),
      cmocka_unit_test(release_of_null_does_nothing),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
