/* SPDX-License-Identifier: Apache-2.0
 * msq_fill_lines: paths in the polygon and on the walls, types and far coordinates, refusals. */
#include "fills.h"

/* Paths are whole, as long as said, in the square and not in its hole, and on the gyroid. */
static void check_paths(const msq_fill_report* paths, double scale, double z, int is_gyroid,
                        double cell) {
  double sum = 0, travel = 0, last[2] = {0, 0};
  assert_int_equal(paths->path_starts[0], 0);
  assert_int_equal(paths->path_starts[paths->path_count], paths->point_count);
  for (uint64_t p = 0; p < paths->path_count; ++p) {
    const uint64_t begin = paths->path_starts[p], end = paths->path_starts[p + 1];
    assert_true(paths->closed[p] <= 1 && end >= begin + (paths->closed[p] ? 3 : 2));
    for (uint64_t i = begin; i < end; ++i) {
      const double x = coordinate_of(paths, 2 * i) * scale;
      const double y = coordinate_of(paths, 2 * i + 1) * scale;
      const uint64_t j = i + 1 < end ? i + 1 : begin;
      const double to_x = coordinate_of(paths, 2 * j) * scale,
                   to_y = coordinate_of(paths, 2 * j + 1) * scale;
      assert_true(x >= 0 && x <= 40 && y >= 0 && y <= 40);
      if (j > i || paths->closed[p]) {
        const double mx = 0.5 * (x + to_x), my = 0.5 * (y + to_y);
        sum += hypot(to_x - x, to_y - y);
        assert_false(mx > 15 + 2 * scale && mx < 25 - 2 * scale && my > 15 + 2 * scale &&
                     my < 25 - 2 * scale);
      }
      if (is_gyroid) {
        const double k = 6.283185307179586 / cell;
        const double g =
            sin(k * x) * cos(k * y) + sin(k * y) * cos(k * z) + sin(k * z) * cos(k * x);
        /* The slope is at most k * sqrt 3 for each unit of length. */
        assert_true(fabs(g) < 1.8 * k * (cell / 200 + scale));
      }
      if (i == begin && p > 0) travel += hypot(x - last[0], y - last[1]);
    }
    const uint64_t stop = paths->closed[p] ? begin : end - 1;
    last[0] = coordinate_of(paths, 2 * stop) * scale;
    last[1] = coordinate_of(paths, 2 * stop + 1) * scale;
  }
  assert_near(paths->length, sum, 1e-9 * sum);
  assert_near(paths->travel, travel, 1e-9 * sum);
}

static void fills_a_square_with_a_hole(void** state) {
  msq_context* context = make_context();
  msq_structure* structures[2] = {make_sheet(context, MSQ_FUNCTION_GYROID, 8),
                                  make_foam_of(context, 5)};
  (void)state;
  for (int s = 0; s < 2; ++s)
    for (double z = 0.15; z < 12; z += 2.7) {
      const msq_fill_def def = square_def(z);
      msq_fill* fill = make_fill(context, structures[s], &def);
      const msq_fill_report paths = paths_of(fill);
      assert_int_equal(paths.coordinate_type, MSQ_INT64);
      check_paths(&paths, 1e-6, z, s == 0, 8);
      print_message("%s at %.2f: %llu paths, length %.1f, travel %.1f\n", s ? "foam" : "gyroid", z,
                    (unsigned long long)paths.path_count, paths.length, paths.travel);
      assert_true(paths.length > 200 && paths.travel < (s ? 0.35 : 0.45) * paths.length);

      /* The same again, bit for bit, also by another context and after its structure is gone. */
      msq_context* other = make_context_of(1, 0, 0);
      msq_structure* again = s ? make_foam_of(other, 5) : make_sheet(other, MSQ_FUNCTION_GYROID, 8);
      msq_fill* second = make_fill(other, again, &def);
      msq_structure_release(again);
      msq_context_release(other);
      const msq_fill_report same = paths_of(second);
      assert_int_equal(same.point_count, paths.point_count);
      assert_int_equal(same.path_count, paths.path_count);
      assert_memory_equal(same.points, paths.points, 16 * paths.point_count);
      assert_memory_equal(same.path_starts, paths.path_starts, 8 * (paths.path_count + 1));
      assert_memory_equal(same.closed, paths.closed, paths.path_count);
      msq_fill_release(second);
      msq_fill_release(fill);
    }
  msq_structure_release(structures[0]);
  msq_structure_release(structures[1]);
  msq_context_release(context);
}

static int compare_points(const void* a, const void* b) {
  const int64_t *p = (const int64_t*)a, *q = (const int64_t*)b;
  return p[0] != q[0] ? (p[0] < q[0] ? -1 : 1) : (p[1] > q[1]) - (p[1] < q[1]);
}

/* A point where an odd number of lines meet is the end of a path in any case. Where no two paths
 * end at one point, no fewer paths would do. Neither would a closed one that another one touches.
 */
static void has_the_fewest_paths(void** state) {
  msq_context* context = make_context();
  msq_structure* structures[3] = {make_sheet(context, MSQ_FUNCTION_GYROID, 8),
                                  make_foam_of(context, 5),
                                  make_sheet(context, MSQ_FUNCTION_SCHWARZ_P, 6)};
  (void)state;
  for (int s = 0; s < 3; ++s) {
    const msq_fill_def def = square_def(2.9);
    msq_fill* fill = make_fill(context, structures[s], &def);
    const msq_fill_report paths = paths_of(fill);
    const int64_t* points = (const int64_t*)paths.points;
    int64_t* ends = (int64_t*)malloc(paths.path_count * 4 * sizeof *ends);
    uint64_t count = 0, closed = 0;
    assert_non_null(ends);
    for (uint64_t p = 0; p < paths.path_count; ++p) {
      closed += paths.closed[p];
      if (paths.closed[p]) continue;
      memcpy(ends + 2 * count++, points + 2 * paths.path_starts[p], 2 * sizeof *ends);
      memcpy(ends + 2 * count++, points + 2 * (paths.path_starts[p + 1] - 1), 2 * sizeof *ends);
    }
    qsort(ends, count, 2 * sizeof *ends, compare_points);
    for (uint64_t i = 1; i < count; ++i)
      assert_true(compare_points(ends + 2 * i - 2, ends + 2 * i) != 0);
    for (uint64_t p = 0; p < paths.path_count; ++p)
      for (uint64_t i = paths.path_starts[p]; paths.closed[p] && i < paths.path_starts[p + 1]; ++i)
        assert_null(bsearch(points + 2 * i, ends, count, 2 * sizeof *ends, compare_points));
    assert_true(count > 10);
    assert_int_equal(closed > 0, s == 2);
    free(ends);
    msq_fill_release(fill);
    msq_structure_release(structures[s]);
  }
  msq_context_release(context);
}

/* Seeds eight times as many at the right as at the left: lines twice as close, of the same width.
 */
static void follows_a_field_of_density(void** state) {
  const double from[3] = {0, 0, 0}, to[3] = {40, 0, 0};
  msq_context* context = make_context();
  msq_foam_def def;
  msq_structure* foam;
  msq_field* field;
  double lengths[4] = {0, 0, 0, 0};
  (void)state;
  assert_ok(msq_foam_def_init(&def, sizeof def));
  def.radius.value = 0.1;
  def.density.value = 0;
  set_cell(&def.grid, 2);
  assert_ok(msq_field_gradient(context, from, 1, to, 8, &field));
  def.density.field = field;
  assert_ok(msq_structure_foam(context, &def, &foam));
  msq_field_release(field);
  for (int quarter = 0; quarter < 4; ++quarter)
    for (double z = 0.3; z < 20; z += 1.7) {
      const int64_t x = 10000000 * quarter;
      const int64_t square[4][2] = {
          {x, 0}, {x + 10000000, 0}, {x + 10000000, 40000000}, {x, 40000000}};
      const msq_ring ring = {square, 4};
      msq_fill_def fill_def = square_def(z);
      fill_def.rings = &ring;
      fill_def.ring_count = 1;
      msq_fill* fill = make_fill(context, foam, &fill_def);
      lengths[quarter] += paths_of(fill).length;
      msq_fill_release(fill);
    }
  for (int quarter = 1; quarter < 4; ++quarter) {
    /* The density in the middle of each quarter. */
    const double wanted = cbrt((1 + 7 * (quarter + 0.5) / 4) / (1 + 7 * 0.5 / 4));
    print_message("quarter %d: %.3f times the first, of %.3f\n", quarter,
                  lengths[quarter] / lengths[0], wanted);
    assert_near(lengths[quarter] / lengths[0], wanted, 0.08 * wanted);
  }
  msq_structure_release(foam);
  msq_context_release(context);
}

/* int32 in steps of 0.01 mm; far from the origin; with a stride; holes that run the other way. */
static void takes_the_coordinates_of_the_host(void** state) {
  typedef struct point32 {
    int32_t x, y, unused;
  } point32;
  static const point32 square[4] = {{0, 0, 7}, {4000, 0, 7}, {4000, 4000, 7}, {0, 4000, 7}};
  static const point32 hole[4] = {
      {1500, 1500, 7}, {2500, 1500, 7}, {2500, 2500, 7}, {1500, 2500, 7}};
  const msq_ring rings[2] = {{hole, 4}, {square, 4}};
  msq_context* context = make_context();
  msq_structure* gyroid = make_sheet(context, MSQ_FUNCTION_GYROID, 8);
  msq_fill_def def = square_def(0.7);
  msq_fill* wide = make_fill(context, gyroid, &def);
  const msq_fill_report paths64 = paths_of(wide);
  (void)state;

  def.coordinate_type = MSQ_INT32;
  def.rings = rings;
  def.point_stride = sizeof(point32);
  def.scale = 0.01;
  msq_fill* small = make_fill(context, gyroid, &def);
  const msq_fill_report paths32 = paths_of(small);
  assert_int_equal(paths32.coordinate_type, MSQ_INT32);
  check_paths(&paths32, 0.01, 0.7, 1, 8);
  assert_near(paths32.length, paths64.length, 0.02 * paths64.length);

  /* The same places under other coordinates: moved by whole cells of 8 mm. */
  const int64_t far = (int64_t)8000000 * 1000000; /* 8e6 mm */
  int64_t moved[4][2];
  for (int i = 0; i < 4; ++i) {
    moved[i][0] = square_nm[i][0] + far;
    moved[i][1] = square_nm[i][1] - far;
  }
  const msq_ring moved_ring = {moved, 4}, near_ring = {square_nm, 4};
  def = square_def(0.7);
  def.rings = &near_ring;
  def.ring_count = 1;
  msq_fill* near_fill = make_fill(context, gyroid, &def);
  def.rings = &moved_ring;
  msq_fill* moved_fill = make_fill(context, gyroid, &def);
  def.origin[0] = -(double)far * 1e-6;
  def.origin[1] = (double)far * 1e-6;
  msq_fill* shifted_fill = make_fill(context, gyroid, &def);
  const msq_fill_report a = paths_of(near_fill), b = paths_of(moved_fill),
                        c = paths_of(shifted_fill);
  assert_near(b.length, a.length, 0.01 * a.length);
  assert_near(c.length, a.length, 0.001 * a.length);
  for (uint64_t i = 0; i < c.point_count; ++i)
    assert_true(coordinate_of(&c, 2 * i) >= (double)far &&
                coordinate_of(&c, 2 * i + 1) <= 40000000 - (double)far);
  msq_fill_release(near_fill);
  msq_fill_release(moved_fill);
  msq_fill_release(shifted_fill);
  msq_fill_release(small);
  msq_fill_release(wide);
  msq_structure_release(gyroid);
  msq_context_release(context);
}

static void drops_what_is_short(void** state) {
  msq_context* context = make_context();
  msq_structure* foam = make_foam_of(context, 3);
  msq_fill_def def = square_def(1.1);
  msq_fill* all = make_fill(context, foam, &def);
  def.min_length = 4;
  msq_fill* some = make_fill(context, foam, &def);
  const msq_fill_report whole = paths_of(all), part = paths_of(some);
  (void)state;
  assert_true(part.path_count > 0 && part.path_count < whole.path_count);
  for (uint64_t p = 0; p < part.path_count; ++p) {
    double sum = 0;
    const uint64_t begin = part.path_starts[p], end = part.path_starts[p + 1];
    for (uint64_t i = begin; i + !part.closed[p] < end; ++i) {
      const uint64_t j = i + 1 < end ? i + 1 : begin;
      sum += hypot(coordinate_of(&part, 2 * j) - coordinate_of(&part, 2 * i),
                   coordinate_of(&part, 2 * j + 1) - coordinate_of(&part, 2 * i + 1));
    }
    assert_true(sum * 1e-6 >= 4 - 1e-9);
  }
  def.min_length = 1e9;
  msq_fill* none = make_fill(context, foam, &def);
  const msq_fill_report nothing = paths_of(none);
  assert_int_equal(nothing.path_count, 0);
  assert_int_equal(nothing.point_count, 0);
  assert_int_equal(nothing.path_starts[0], 0);
  assert_true(nothing.length == 0 && nothing.travel == 0);
  msq_fill_release(none);
  msq_fill_release(some);
  msq_fill_release(all);
  msq_structure_release(foam);
  msq_context_release(context);
}

/* Fewer paths and less travel for somewhat more length, all of it within the polygon; sheets, whose
 * lines do not meet, stay as they are. */
static void prints_walls_as_pairs(void** state) {
  msq_context* context = make_context();
  msq_structure* structures[2] = {make_foam_of(context, 3),
                                  make_sheet(context, MSQ_FUNCTION_GYROID, 6)};
  (void)state;
  for (int s = 0; s < 2; ++s) {
    msq_fill_def def = square_def(1.1);
    def.min_length = 0.3;
    msq_fill* single = make_fill(context, structures[s], &def);
    def.pair_distance = 0.4;
    msq_fill* paired = make_fill(context, structures[s], &def);
    const msq_fill_report a = paths_of(single), b = paths_of(paired);
    if (s == 0) {
      assert_true(2 * b.path_count < a.path_count);
      assert_true(b.length > 1.05 * a.length && b.length < 1.3 * a.length);
      assert_true(b.length + b.travel < 1.03 * (a.length + a.travel));
    } else {
      assert_int_equal(b.path_count, a.path_count);
      assert_int_equal(b.point_count, a.point_count);
      assert_memory_equal(b.points, a.points, 16 * a.point_count);
    }
    for (uint64_t i = 0; i < b.point_count; ++i) {
      const double x = coordinate_of(&b, 2 * i), y = coordinate_of(&b, 2 * i + 1);
      assert_true(x >= 0 && y >= 0 && x <= 40e6 && y <= 40e6);
      assert_false(x > 15e6 && y > 15e6 && x < 25e6 && y < 25e6);
    }
    msq_fill_release(paired);
    msq_fill_release(single);
    msq_structure_release(structures[s]);
  }
  msq_context_release(context);
}

/* The longest distance from a point of the second paths to the lines of the first. */
static double departure(const msq_fill_report* lines, const msq_fill_report* points) {
  double most = 0;
  for (uint64_t k = 0; k < points->point_count; ++k) {
    const double x = coordinate_of(points, 2 * k), y = coordinate_of(points, 2 * k + 1);
    double least = HUGE_VAL;
    for (uint64_t p = 0; p < lines->path_count; ++p) {
      const uint64_t begin = lines->path_starts[p], end = lines->path_starts[p + 1];
      for (uint64_t i = begin; i + !lines->closed[p] < end; ++i) {
        const uint64_t j = i + 1 < end ? i + 1 : begin;
        const double ax = coordinate_of(lines, 2 * i), ay = coordinate_of(lines, 2 * i + 1);
        const double vx = coordinate_of(lines, 2 * j) - ax,
                     vy = coordinate_of(lines, 2 * j + 1) - ay;
        const double square = vx * vx + vy * vy;
        double t = square > 0 ? ((x - ax) * vx + (y - ay) * vy) / square : 0;
        t = t < 0 ? 0 : t > 1 ? 1 : t;
        const double distance = hypot(ax + t * vx - x, ay + t * vy - y);
        if (distance < least) least = distance;
      }
    }
    if (least > most) most = least;
  }
  return most;
}

/* The sharpest bend of all paths, in radians. Bends at lines shorter than `shortest` do not count:
 * there coordinates are too coarse to tell. */
static double sharpest_bend(const msq_fill_report* paths, double shortest) {
  double most = 0;
  for (uint64_t p = 0; p < paths->path_count; ++p)
    for (uint64_t i = paths->path_starts[p] + 1; i + 1 < paths->path_starts[p + 1]; ++i) {
      const double ux = coordinate_of(paths, 2 * i) - coordinate_of(paths, 2 * i - 2);
      const double uy = coordinate_of(paths, 2 * i + 1) - coordinate_of(paths, 2 * i - 1);
      const double vx = coordinate_of(paths, 2 * i + 2) - coordinate_of(paths, 2 * i);
      const double vy = coordinate_of(paths, 2 * i + 3) - coordinate_of(paths, 2 * i + 1);
      if (hypot(ux, uy) < shortest || hypot(vx, vy) < shortest) continue;
      const double bend = fabs(atan2(ux * vy - uy * vx, ux * vx + uy * vy));
      if (bend > most) most = bend;
    }
  return most;
}

/* Corners are cut off, the paths' ends stay, and nothing leaves the polygon. */
static void rounds_corners(void** state) {
  msq_context* context = make_context();
  msq_structure* foam = make_foam_of(context, 3);
  (void)state;
  msq_fill_def def = square_def(1.1);
  def.min_length = 0.3;
  msq_fill* sharp = make_fill(context, foam, &def);
  def.corner_distance = 0.4;
  msq_fill* rounded = make_fill(context, foam, &def);
  const msq_fill_report a = paths_of(sharp), b = paths_of(rounded);
  assert_int_equal(b.path_count, a.path_count);
  assert_true(b.length < 0.995 * a.length && b.length > 0.9 * a.length);
  assert_true(sharpest_bend(&a, 1e5) > 1);
  /* A corner of 120 degrees has five bends; those of sharp corners are larger. */
  assert_true(sharpest_bend(&b, 2e4) < 0.8 * sharpest_bend(&a, 1e5));
  const double moved = departure(&a, &b);
  assert_true(moved > 0.02e6 && moved <= 0.2e6 + 2);
  for (uint64_t i = 0; i < b.point_count; ++i) {
    const double x = coordinate_of(&b, 2 * i), y = coordinate_of(&b, 2 * i + 1);
    assert_true(x >= 0 && y >= 0 && x <= 40e6 && y <= 40e6);
    assert_false(x > 15e6 && y > 15e6 && x < 25e6 && y < 25e6);
  }
  msq_fill_release(rounded);
  msq_fill_release(sharp);
  msq_structure_release(foam);
  msq_context_release(context);
}

/* Two halves of the square have the lines of the whole. */
static void goes_on_in_the_next_polygon(void** state) {
  msq_context* context = make_context();
  msq_structure* structures[2] = {make_sheet(context, MSQ_FUNCTION_DIAMOND, 7),
                                  make_foam_of(context, 4)};
  (void)state;
  for (int s = 0; s < 2; ++s) {
    const int64_t whole[4][2] = {{0, 0}, {40000000, 0}, {40000000, 30000000}, {0, 30000000}};
    const int64_t left[4][2] = {{0, 0}, {17000000, 0}, {13000000, 30000000}, {0, 30000000}};
    const int64_t right[4][2] = {
        {17000000, 0}, {40000000, 0}, {40000000, 30000000}, {13000000, 30000000}};
    const msq_ring rings[3] = {{whole, 4}, {left, 4}, {right, 4}};
    double lengths[3];
    for (int i = 0; i < 3; ++i) {
      msq_fill_def def = square_def(2.3);
      def.rings = &rings[i];
      def.ring_count = 1;
      def.tolerance = 1e-4;
      msq_fill* fill = make_fill(context, structures[s], &def);
      lengths[i] = paths_of(fill).length;
      msq_fill_release(fill);
    }
    assert_near(lengths[1] + lengths[2], lengths[0], 2e-4 * lengths[0]);
  }
  msq_structure_release(structures[0]);
  msq_structure_release(structures[1]);
  msq_context_release(context);
}

static void stops_and_keeps_to_its_memory(void** state) {
  msq_context* context = make_context();
  msq_structure* structures[2] = {make_sheet(context, MSQ_FUNCTION_GYROID, 8),
                                  make_foam_of(context, 5)};
  const msq_fill_def def = square_def(1);
  msq_job* job;
  double progress = -1;
  (void)state;
  assert_ok(msq_job_create(&job));
  msq_fill* fill;
  assert_ok(msq_fill_lines(context, structures[1], &def, &fill, job));
  assert_ok(msq_job_progress(job, &progress));
  assert_true(progress == 1);
  const msq_memory_report memory = memory_of(context);
  assert_true(memory.bytes >= 16 * paths_of(fill).point_count);
  msq_fill_retain(fill);
  msq_fill_release(fill);
  assert_true(memory_of(context).bytes == memory.bytes);
  msq_fill_release(fill);
  assert_true(memory_of(context).bytes == 0);
  assert_ok(msq_job_cancel(job));
  for (int s = 0; s < 2; ++s)
    assert_makes_nothing(msq_fill, msq_fill_lines(context, structures[s], &def, &made, job),
                         MSQ_E_CANCELLED, "cancelled");
  msq_job_release(job);
  msq_structure_release(structures[0]);
  msq_structure_release(structures[1]);
  msq_context_release(context);

  context = make_context_of(1, 0, 20000);
  msq_structure* foam = make_foam_of(context, 5);
  assert_makes_nothing(msq_fill, msq_fill_lines(context, foam, &def, &made, NULL), MSQ_E_LIMIT,
                       "memory_limit");
  msq_structure_release(foam);
  msq_context_release(context);

  /* Also lines of walls of which none is kept. */
  context = make_context_of(1, 0, 5000);
  msq_structure* gyroid = make_sheet(context, MSQ_FUNCTION_GYROID, 2);
  msq_fill_def none = def;
  none.min_length = 1e9;
  assert_makes_nothing(msq_fill, msq_fill_lines(context, gyroid, &none, &made, NULL), MSQ_E_LIMIT,
                       "the lines of walls in a plane of");
  assert_true(memory_of(context).bytes == 0);
  msq_structure_release(gyroid);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(fills_a_square_with_a_hole),
      cmocka_unit_test(has_the_fewest_paths),
      cmocka_unit_test(follows_a_field_of_density),
      cmocka_unit_test(takes_the_coordinates_of_the_host),
      cmocka_unit_test(drops_what_is_short),
      cmocka_unit_test(prints_walls_as_pairs),
      cmocka_unit_test(rounds_corners),
      cmocka_unit_test(goes_on_in_the_next_polygon),
      cmocka_unit_test(stops_and_keeps_to_its_memory),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
