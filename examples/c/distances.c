/* SPDX-License-Identifier: Apache-2.0
 * Sphere tracing by signed distances: a step as long as the distance crosses no surface.
 * msq_ray_cast finds the same points, faster and exactly; the last column compares the two. */
#include <math.h>
#include <msq.h>
#include <stdio.h>
#include <stdlib.h>

static void check(msq_status status) {
  if (status == MSQ_OK) return;
  fprintf(stderr, "distances: %s: %s\n", msq_status_name(status), msq_error_message());
  exit(1);
}

/* Walks along +x from x = -20 into the solid. Returns x, or infinity. The distance of a point
 * outside the ball is that to the ball. It shrinks to 0 where the ball begins, also where the
 * lattice is empty; a least step of 1e-7 passes such places. */
static double trace(const msq_model* model, double y, double z, int* steps) {
  double point[3] = {-20, y, z};
  for (*steps = 0; point[0] < 20; ++*steps) {
    double distance; /* at most 0 inside, positive outside, never more than the true one */
    check(msq_point_distance(model, point, NULL, &distance));
    if (distance <= 0) return point[0];
    point[0] += distance > 1e-7 ? distance : 1e-7;
  }
  return INFINITY;
}

int main(void) {
  msq_context* context;
  check(msq_context_create(NULL, &context));
  const double center[3] = {0, 0, 0};
  msq_shape* ball;
  check(msq_shape_from_sphere(context, center, 15, &ball));
  msq_lattice_def lattice_def;
  check(msq_lattice_def_init(&lattice_def, sizeof lattice_def));
  lattice_def.unit_cell = MSQ_UNIT_CELL_BCC;
  for (int axis = 0; axis < 3; ++axis) lattice_def.grid.cell_size[axis] = 6;
  lattice_def.radius.value = 0.8;
  msq_structure* lattice;
  check(msq_structure_lattice(context, &lattice_def, &lattice));
  const msq_scale_def scales[2] = {{.shape = ball}, {.structure = lattice}};
  msq_model_def model_def;
  check(msq_model_def_init(&model_def, sizeof model_def));
  model_def.scales = scales;
  model_def.scale_count = 2;
  model_def.scale_size = sizeof scales[0];
  msq_model* model;
  check(msq_model_create(context, &model_def, &model));

  enum { ray_count = 12 };
  double origins[ray_count][3], directions[ray_count][3];
  for (int i = 0; i < ray_count; ++i) {
    const double origin[3] = {-20, -9.3 + 1.7 * i, 0.37}, direction[3] = {1, 0, 0};
    for (int a = 0; a < 3; ++a) origins[i][a] = origin[a], directions[i][a] = direction[a];
  }
  msq_rays_def rays;
  check(msq_rays_def_init(&rays, sizeof rays));
  rays.origins = origins;
  rays.directions = directions;
  rays.count = ray_count;
  msq_ray_hit hits[ray_count];
  check(msq_ray_cast(model, &rays, NULL, hits, ray_count, NULL));

  int wrong = 0, found = 0;
  printf("     y      traced  steps         ray  difference\n");
  for (int i = 0; i < ray_count; ++i) {
    int steps;
    const double traced = trace(model, origins[i][1], origins[i][2], &steps);
    const double cast = origins[i][0] + hits[i].t; /* t is infinite where nothing is hit */
    const double difference = isinf(traced) && isinf(cast) ? 0 : traced - cast;
    printf("%6.2f %11.6f %6d %11.6f %11.1e\n", origins[i][1], traced, steps, cast, difference);
    found += !isinf(cast);
    wrong += !(fabs(difference) < 1e-6);
  }

  msq_model_release(model);
  msq_structure_release(lattice);
  msq_shape_release(ball);
  msq_context_release(context);
  return wrong != 0 || found == 0;
}
