/* SPDX-License-Identifier: Apache-2.0
 * Fill lines at the border of their polygon: they go on in the polygon beside at the same points,
 * and both lines of a pair stay within. */
#include <stdlib.h>

#include "fills.h"

static msq_structure* make_seeded_foam(msq_context* context, double cell, double jitter,
                                       uint64_t seed) {
  msq_foam_def def;
  msq_structure* structure;
  assert_ok(msq_foam_def_init(&def, sizeof def));
  def.wall_thickness.value = 0.1 * cell;
  def.jitter = jitter;
  def.seed = seed;
  set_cell(&def.grid, cell);
  assert_ok(msq_structure_foam(context, &def, &structure));
  return structure;
}

static msq_fill* fill_of(msq_context* context, const msq_structure* structure,
                         const int64_t (*points)[2], uint64_t count, const double place[3],
                         double pair) {
  const msq_ring ring = {points, count};
  msq_fill_def def;
  assert_ok(msq_fill_def_init(&def, sizeof def));
  def.rings = &ring;
  def.ring_count = 1;
  def.scale = 1e-6;
  def.origin[0] = place[0];
  def.origin[1] = place[1];
  def.z = place[2];
  def.pair_distance = pair;
  return make_fill(context, structure, &def);
}

static int compare(const void* a, const void* b) {
  const double x = *(const double*)a, y = *(const double*)b;
  return (x > y) - (x < y);
}

enum { most_points = 4096 };

/* The y of the points of a fill at x = cut, sorted, without those at y = 0 and y = high. */
static uint64_t points_at(const msq_fill* fill, double cut, double high, double* y) {
  const msq_fill_report lines = paths_of(fill);
  uint64_t count = 0;
  for (uint64_t i = 0; i < lines.point_count; ++i) {
    const double at = coordinate_of(&lines, 2 * i + 1);
    if (coordinate_of(&lines, 2 * i) != cut || at <= 0 || at >= high) continue;
    assert_true(count < most_points);
    y[count++] = at;
  }
  qsort(y, (size_t)count, sizeof *y, compare);
  return count;
}

/* Rectangles on both sides of x = 0; `place`: of the coordinate 0, and z. */
static void check_cut(msq_context* context, double cell, double jitter, uint64_t seed,
                      const double place[3]) {
  enum { high = 2500000 };
  static const int64_t left[4][2] = {{-2000000, 0}, {0, 0}, {0, high}, {-2000000, high}};
  static const int64_t right[4][2] = {{0, 0}, {3000000, 0}, {3000000, high}, {0, high}};
  msq_structure* foam = make_seeded_foam(context, cell, jitter, seed);
  msq_fill* fills[2] = {fill_of(context, foam, left, 4, place, 0),
                        fill_of(context, foam, right, 4, place, 0)};
  static double y[2][most_points];
  uint64_t counts[2];
  for (int i = 0; i < 2; ++i) counts[i] = points_at(fills[i], 0, high, y[i]);
  assert_int_equal(counts[0], counts[1]);
  for (uint64_t i = 0; i < counts[0]; ++i)
    if (y[0][i] != y[1][i])
      fail_msg("cell %.17g, jitter %g, seed %llu: %g on one side, %g on the other", cell, jitter,
               (unsigned long long)seed, y[0][i], y[1][i]);
  msq_fill_release(fills[0]);
  msq_fill_release(fills[1]);
  msq_structure_release(foam);
}

/* In a linear congruence; in [0, 1). */
static double random_unit(uint64_t* state) {
  *state = *state * 6364136223846793005u + 1442695040888963407u;
  return (double)(*state >> 11) * 0x1p-53;
}

static void goes_on_at_the_same_points(void** unused) {
  msq_context* context = make_context();
  uint64_t state = 5;
  (void)unused;
  const double known[3] = {-1.4335317335998718, 0.7064141079921669, 2.4692379214080975};
  check_cut(context, 1.3663857968179207, 0.3, 150793, known);
  for (size_t n = 0; n < test_count(400); ++n) {
    const double cell = 0.4 + random_unit(&state), jitter = random_unit(&state);
    double place[3];
    for (int i = 0; i < 3; ++i) place[i] = 4 * random_unit(&state);
    check_cut(context, cell, jitter, n, place);
  }
  msq_context_release(context);
}

enum { corners = 10 };

/* How far a point is outside a polygon. */
static double outside_by(const int64_t (*polygon)[2], double x, double y) {
  double least = 1e300;
  int is_inside = 0;
  for (int i = 0, j = corners - 1; i < corners; j = i++) {
    const double ax = (double)polygon[j][0], ay = (double)polygon[j][1];
    const double vx = (double)polygon[i][0] - ax, vy = (double)polygon[i][1] - ay;
    if ((ay > y) != (ay + vy > y) && x < ax + (y - ay) / vy * vx) is_inside = !is_inside;
    double t = ((x - ax) * vx + (y - ay) * vy) / (vx * vx + vy * vy);
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    least = fmin(least, hypot(ax + t * vx - x, ay + t * vy - y));
  }
  return is_inside ? 0 : least;
}

static void check_pairs(msq_context* context, double cell, uint64_t seed,
                        const int64_t (*polygon)[2]) {
  msq_structure* foam = make_seeded_foam(context, cell, 1, seed);
  const double place[3] = {0, 0, 0.3};
  msq_fill* fill = fill_of(context, foam, polygon, corners, place, 0.1);
  const msq_fill_report lines = paths_of(fill);
  for (uint64_t p = 0; p < lines.path_count; ++p)
    for (uint64_t i = lines.path_starts[p]; i + 1 < lines.path_starts[p + 1]; ++i) {
      const double x = coordinate_of(&lines, 2 * i), y = coordinate_of(&lines, 2 * i + 1);
      const double vx = coordinate_of(&lines, 2 * i + 2) - x,
                   vy = coordinate_of(&lines, 2 * i + 3) - y;
      for (int k = 0; k <= 100; ++k) {
        const double off = outside_by(polygon, x + 0.01 * k * vx, y + 0.01 * k * vy);
        if (off > 2)
          fail_msg("cell %.17g, seed %llu: a line is %g units outside", cell,
                   (unsigned long long)seed, off);
      }
    }
  msq_fill_release(fill);
  msq_structure_release(foam);
}

static void keeps_pairs_within(void** unused) {
  static const int64_t known[corners][2] = {
      {2655475, 2036499}, {2049642, 2193053}, {112672, 2126526}, {238010, 1529937},
      {126295, 1425882},  {890068, 1015702},  {613009, 567717},  {1320711, 915037},
      {1843106, 966851},  {2520227, 1439851}};
  msq_context* context = make_context();
  uint64_t state = 6;
  (void)unused;
  check_pairs(context, 0.5054091325846338, 509110, known);
  for (size_t n = 0; n < test_count(200); ++n) {
    int64_t star[corners][2];
    for (int i = 0; i < corners; ++i) {
      const double angle = 6.283185307179586 * (i + 0.8 * random_unit(&state)) / corners;
      const double radius = 1.5e6 * (0.3 + 0.7 * random_unit(&state));
      star[i][0] = (int64_t)(1.5e6 + radius * cos(angle));
      star[i][1] = (int64_t)(1.5e6 + radius * sin(angle));
    }
    check_pairs(context, 0.5 + random_unit(&state), n, (const int64_t(*)[2])star);
  }
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(goes_on_at_the_same_points),
      cmocka_unit_test(keeps_pairs_within),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
