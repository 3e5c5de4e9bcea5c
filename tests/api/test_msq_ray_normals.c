/* SPDX-License-Identifier: Apache-2.0
 * The normal of a hit leads out of the model: a short way along it is outside, and a short way
 * against it inside. This holds where a ray leaves a structure that is taken away, and where a
 * function jumps. */
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
};

/* Whether the point a way along the normal of a hit is inside. */
static int is_inside_at(const msq_model* model, const row* r, const msq_ray_hit* hit, double way) {
  double p[3];
  for (int i = 0; i < 3; ++i) p[i] = r->origin[i] + hit->t * r->direction[i] + way * hit->normal[i];
  return is_inside(model, p[0], p[1], p[2]);
}

static void normals_lead_out(void** state) {
  msq_context* context;
  (void)state;
  assert_ok(msq_context_create(NULL, &context));
  for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i) {
    const row* r = &rows[i];
    char text[1024];
    snprintf(text, sizeof text,
             "{\"msq_model\": 1, \"scales\": [{\"shape\": {\"all_space\": {}}}, "
             "{\"structure\": %s}]}",
             r->structure);
    msq_model* model = model_of(read_document(context, text));
    const double end = 10;
    msq_ray_hit hit;
    msq_rays_def def;
    assert_ok(msq_rays_def_init(&def, sizeof def));
    def.count = 1;
    def.origins = r->origin;
    def.directions = r->direction;
    def.t_max = &end;
    assert_ok(msq_ray_cast(model, &def, NULL, &hit, 1, NULL));
    if (fabs(hit.t - r->t) > 1e-8) fail_msg("%s: t is %.17g", r->name, hit.t);
    if (is_inside_at(model, r, &hit, 1e-6)) fail_msg("%s: it is inside along the normal", r->name);
    if (!is_inside_at(model, r, &hit, -1e-6)) fail_msg("%s: it is outside against it", r->name);
    msq_model_release(model);
  }
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(normals_lead_out)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
