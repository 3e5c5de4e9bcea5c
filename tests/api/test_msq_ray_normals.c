/* SPDX-License-Identifier: Apache-2.0
 * The normal of a hit leads out of the model: a short way along it is outside, and a short way
 * against it inside. Where the boundary is flat, it is the mean direction of the points outside.
 * This holds where a ray leaves a structure that is taken away, where a function jumps, at the
 * border of a cell, and at the shell that warped cells fill. */
#include "documents.h"

typedef struct row {
  const char *name, *structure;
  double origin[3], direction[3], t;
} row;

#define BALL_WITHOUT(structure)                                                             \
  "{\"boolean\": {\"operation\": \"difference\", \"structures\": [{\"beams\": {\"nodes\": " \
  "[[0, 0, 0]], \"balls\": [0], \"ball_radius\": 50}}, " structure "]}}"
#define EXPRESSION(text, level)                                             \
  "{\"functional\": {\"function\": \"expression\", \"expression\": \"" text \
  "\", \"level\": " level "}}"
#define ROUND "\"warp\": {\"count\": 12, \"inner_radius\": 1, \"outer_radius\": 3}"

/* The first four rays begin in a wall z = 0 that is taken away, and leave it at z = 0.1. */
static const row rows[] = {
    {"plates taken away",
     BALL_WITHOUT("{\"plate_lattice\": {\"thickness\": 0.2}}"),
     {0.3, 0.2, 0.01},
     {0.1, 0.05, 1},
     0.09},
    {"plates and struts taken away",
     BALL_WITHOUT("{\"plate_lattice\": {\"thickness\": 0.2, \"radius\": 0.11}}"),
     {0.3, 0.2, 0.01},
     {0.1, 0.05, 1},
     0.09},
    {"walls of a foam taken away",
     BALL_WITHOUT("{\"foam\": {\"jitter\": 0, \"radius\": 0, \"wall_thickness\": 0.2}}"),
     {0.3, 0.2, 0.01},
     {0.1, 0.05, 1},
     0.09},
    {"walls and struts of a foam taken away",
     BALL_WITHOUT("{\"foam\": {\"jitter\": 0, \"radius\": 0.11, \"wall_thickness\": 0.2}}"),
     {0.3, 0.2, 0.01},
     {0.1, 0.05, 1},
     0.09},
    {"a function about an axis taken away, at its outer radius",
     BALL_WITHOUT("{\"functional\": {\"level\": 9, \"warp\": {\"count\": 12, \"inner_radius\": 1, "
                  "\"outer_radius\": 3}}}"),
     {2, 0.1, 0.2},
     {1, 0.02, 0.01},
     0.99760096},
    {"a function at the end of its domain",
     EXPRESSION("log(x-1)", "-0.6"),
     {-0.3, 0.25, 0.3},
     {1, 0.05, 0.02},
     0.459154943},
    {"a function at a jump",
     EXPRESSION("select(x<3,9,x-20)", "0"),
     {0.1, 0.25, 0.3},
     {1, 0.05, 0.02},
     0.377464829},
    {"a function at a jump, whose slope lies along it",
     EXPRESSION("select(x<3,9,y-20)", "0"),
     {0.1, 0.25, 0.3},
     {1, 0.05, 0.02},
     0.377464829},
    {"the same, with a ray down the slope",
     EXPRESSION("select(x<3,9,y-20)", "0"),
     {0.1, 0.25, 0.3},
     {1, -0.05, 0.02},
     0.377464829},
    {"a function at a jump, whose slope leads out at an angle",
     EXPRESSION("select(x<3,9,y-0.1*x-20)", "0"),
     {0.1, 0.25, 0.3},
     {1, 0.05, 0.02},
     0.377464829},
    {"the same, with a ray down the slope",
     EXPRESSION("select(x<3,9,y-0.1*x-20)", "0"),
     {0.1, 0.25, 0.3},
     {1, -0.05, -0.02},
     0.377464829},
    {"a function without a slope, at a jump",
     EXPRESSION("select(x<3,9,-1)", "0"),
     {0.1, 0.25, 0.3},
     {1, -0.8, 0.02},
     0.377464829},
    {"a function at a jump, with a ray that grazes it",
     EXPRESSION("select(x<3,9,y-20)", "0"),
     {0.47, 0.25, 0.3},
     {0.02, 0.9, -0.4},
     0.373241464},
    {"a function at a jump, taken away",
     BALL_WITHOUT(EXPRESSION("select(x<3,9,y-20)", "0")),
     {0.9, 0.25, 0.3},
     {-1, -0.05, 0.02},
     0.422535171},
    {"the border of a cell",
     EXPRESSION("3-(x-5)^2+9*(y-1.6)", "0"),
     {-0.1, 0.25, 0.3},
     {1, -0.05, 0.02},
     0.1},
    {"the border of a cell, taken away",
     BALL_WITHOUT(EXPRESSION("3-(x-5)^2+9*(y-1.6)", "0")),
     {0.1, 0.25, 0.3},
     {-1, 0.05, 0.02},
     0.1},
    {"the same, with a ray the other way along the border",
     BALL_WITHOUT(EXPRESSION("3-(x-5)^2+9*(y-1.6)", "0")),
     {0.1, 0.25, 0.3},
     {-1, -0.05, -0.02},
     0.1},
};

/* Structures that random rays meet. */
typedef struct scene {
  const char *name, *structure;
} scene;

static const scene scenes[] = {
    {"plates and struts taken away",
     BALL_WITHOUT("{\"plate_lattice\": {\"thickness\": 0.05, \"radius\": 0.2}}")},
    {"walls and struts of a foam", "{\"foam\": {\"radius\": 0.15, \"wall_thickness\": 0.05}}"},
    {"walls and struts of a foam taken away",
     BALL_WITHOUT("{\"foam\": {\"radius\": 0.15, \"wall_thickness\": 0.05}}")},
    {"a function about an axis", "{\"functional\": {\"level\": 0.3, " ROUND "}}"},
    {"a function about an axis taken away",
     BALL_WITHOUT("{\"functional\": {\"level\": 0.3, " ROUND "}}")},
    {"struts about an axis taken away",
     BALL_WITHOUT("{\"lattice\": {\"radius\": 0.15, " ROUND "}}")},
    {"a function at jumps and borders of cells", EXPRESSION("select(x<3,9,y-3)", "0")},
    {"the same, taken away", BALL_WITHOUT(EXPRESSION("select(x<3,9,y-3)", "0"))},
};

enum { around = 300 };

/* Directions all around, evenly spread on a spiral. */
static void directions_around(double directions[around][3]) {
  for (int k = 0; k < around; ++k) {
    const double z = 1 - (2.0 * k + 1) / around, turn = 2.39996322972865332 * k;
    directions[k][0] = sqrt(1 - z * z) * cos(turn);
    directions[k][1] = sqrt(1 - z * z) * sin(turn);
    directions[k][2] = z;
  }
}

static int is_inside_beside(const msq_model* model, const double p[3], const double way[3],
                            double distance) {
  return is_inside(model, p[0] + distance * way[0], p[1] + distance * way[1],
                   p[2] + distance * way[2]);
}

/* The mean direction of the points outside around p. Returns 0 where the boundary is not flat. */
static int mean_outside(const msq_model* model, const double p[3], double mean[3]) {
  double directions[around][3], sum[3] = {0, 0, 0};
  int outside = 0;
  directions_around(directions);
  for (int k = 0; k < around; ++k) {
    if (is_inside_beside(model, p, directions[k], 1e-5)) continue;
    ++outside;
    for (int i = 0; i < 3; ++i) sum[i] += directions[k][i];
  }
  const double length = sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
  for (int i = 0; i < 3; ++i) mean[i] = sum[i] / length;
  /* Half of the directions lead out of a plane, and their mean is half as long. */
  return abs(2 * outside - around) < around / 10 && length > 0.47 * outside;
}

static msq_ray_hit cast(const msq_model* model, const double origin[3], const double direction[3]) {
  const double end = 10;
  msq_ray_hit hit;
  msq_rays_def def;
  assert_ok(msq_rays_def_init(&def, sizeof def));
  def.count = 1;
  def.origins = origin;
  def.directions = direction;
  def.t_max = &end;
  assert_ok(msq_ray_cast(model, &def, NULL, &hit, 1, NULL));
  return hit;
}

/* Returns 0 where nothing is checked, because the boundary is not flat. */
static int check_normal(const char* name, const msq_model* model, const double origin[3],
                        const double direction[3], const msq_ray_hit* hit) {
  double p[3], mean[3], along = 0;
  for (int i = 0; i < 3; ++i) p[i] = origin[i] + hit->t * direction[i];
  if (!mean_outside(model, p, mean)) return 0;
  for (int i = 0; i < 3; ++i) along += mean[i] * hit->normal[i];
  const int is_in = is_inside_beside(model, p, hit->normal, 1e-6),
            is_out = !is_inside_beside(model, p, hit->normal, -1e-6);
  if (is_in || is_out || along < 0.95)
    fail_msg(
        "%s: from %.17g %.17g %.17g along %.17g %.17g %.17g: normal %g %g %g, mean %g %g %g; "
        "%s along the normal, %s against it",
        name, origin[0], origin[1], origin[2], direction[0], direction[1], direction[2],
        hit->normal[0], hit->normal[1], hit->normal[2], mean[0], mean[1], mean[2],
        is_in ? "inside" : "outside", is_out ? "outside" : "inside");
  return 1;
}

static msq_model* model_with(msq_context* context, const char* structure) {
  char text[1024];
  snprintf(text, sizeof text,
           "{\"msq_model\": 1, \"scales\": [{\"shape\": {\"all_space\": {}}}, "
           "{\"structure\": %s}]}",
           structure);
  return model_of(read_document(context, text));
}

static void normals_lead_out(void** state) {
  msq_context* context = make_context();
  (void)state;
  for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i) {
    const row* r = &rows[i];
    msq_model* model = model_with(context, r->structure);
    const msq_ray_hit hit = cast(model, r->origin, r->direction);
    if (fabs(hit.t - r->t) > 1e-8) fail_msg("%s: t is %.17g", r->name, hit.t);
    if (!check_normal(r->name, model, r->origin, r->direction, &hit))
      fail_msg("%s: the boundary is not flat", r->name);
    msq_model_release(model);
  }
  msq_context_release(context);
}

/* Rays from outside, with components of both signs. */
static void normals_of_random_rays_lead_out(void** state) {
  const size_t count = test_count(300), wanted = count < 20 ? 20 : count;
  msq_context* context = make_context();
  (void)state;
  for (size_t i = 0; i < sizeof scenes / sizeof *scenes; ++i) {
    msq_model* model = model_with(context, scenes[i].structure);
    uint64_t random = 3;
    size_t checked = 0;
    for (size_t n = 0; n < wanted; ++n) {
      double origin[3], direction[3];
      for (int k = 0; k < 3; ++k) origin[k] = random_between(&random, -2.5, 2.5);
      for (int k = 0; k < 3; ++k) direction[k] = random_between(&random, -1, 1);
      const msq_ray_hit hit = cast(model, origin, direction);
      if (hit.scale < 0 || hit.starts_inside) continue;
      checked += (size_t)check_normal(scenes[i].name, model, origin, direction, &hit);
    }
    if (10 * checked < wanted) fail_msg("%s: %zu rays are checked", scenes[i].name, checked);
    msq_model_release(model);
  }
  msq_context_release(context);
}

int main(void) {
  if (!MSQ_WITH_JSON) return 0; /* models are documents */
  const struct CMUnitTest tests[] = {cmocka_unit_test(normals_lead_out),
                                     cmocka_unit_test(normals_of_random_rays_lead_out)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
