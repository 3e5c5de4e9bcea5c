/* SPDX-License-Identifier: Apache-2.0
 *
 * What C answers, for the tests of the Python package to compare with: the memberships (a byte
 * each) and distances (8 bytes each) of the points that it reads from standard input as doubles, in
 * the model of tests/support.py. Usage: python_reference COUNT < points > answers */
#include <msq.h>
#include <stdio.h>
#include <stdlib.h>

#define TRY(call)                                   \
  do {                                              \
    if ((call) != MSQ_OK) {                         \
      fprintf(stderr, "%s\n", msq_error_message()); \
      exit(1);                                      \
    }                                               \
  } while (0)

int main(int argc, char** argv) {
  const size_t count = argc > 1 ? strtoul(argv[1], NULL, 10) : 0;
  double* coordinates = malloc((3 * count + 1) * sizeof(double));
  uint8_t* inside = malloc(count + 1);
  double* distances = malloc((count + 1) * sizeof(double));
  if (!coordinates || !inside || !distances) return 1;
  if (fread(coordinates, sizeof(double), 3 * count, stdin) != 3 * count) return 1;

  msq_context* context;
  TRY(msq_context_create(NULL, &context));
  msq_shape* shape;
  const double from[3] = {1, 2, 0}, to[3] = {1, 2, 9};
  TRY(msq_shape_from_cylinder(context, from, to, 7.5, &shape));
  msq_field* radius;
  const double low[3] = {0, 0, 0}, high[3] = {0, 0, 9};
  TRY(msq_field_gradient(context, low, 0.15, high, 0.6, &radius));
  msq_foam_def def;
  TRY(msq_foam_def_init(&def, sizeof def));
  for (int a = 0; a < 3; ++a) def.grid.cell_size[a] = 2 + 0.25 * a;
  def.grid.origin[1] = -0.7;
  def.radius.field = radius;
  def.seed = 12345678901234567890u;
  def.jitter = 0.875;
  msq_structure* foam;
  TRY(msq_structure_foam(context, &def, &foam));

  const msq_scale_def scales[2] = {{.shape = shape}, {.structure = foam}};
  msq_model_def model_def;
  TRY(msq_model_def_init(&model_def, sizeof model_def));
  model_def.scales = scales;
  model_def.scale_count = 2;
  model_def.scale_size = sizeof scales[0];
  msq_model* model;
  TRY(msq_model_create(context, &model_def, &model));

  msq_points_def points;
  TRY(msq_points_def_init(&points, sizeof points));
  points.kind = MSQ_POINTS_ARRAY;
  points.coordinates = coordinates;
  points.count = count;
  TRY(msq_set_membership(model, &points, NULL, inside, count, NULL));
  TRY(msq_set_distance(model, &points, NULL, distances, count, NULL));
  if (fwrite(inside, 1, count, stdout) != count) return 1;
  if (fwrite(distances, sizeof(double), count, stdout) != count) return 1;

  msq_model_release(model);
  msq_structure_release(foam);
  msq_field_release(radius);
  msq_shape_release(shape);
  msq_context_release(context);
  free(coordinates);
  free(inside);
  free(distances);
  return 0;
}
