/* SPDX-License-Identifier: Apache-2.0
 * Arrays of points for the tests of set queries. */
#ifndef ARRAYS_H
#define ARRAYS_H

#include "definitions.h"

enum { few = 5 };

static inline msq_points_def array_of(const void* coordinates, uint64_t count) {
  msq_points_def def;
  assert_ok(msq_points_def_init(&def, sizeof def));
  def.coordinates = coordinates;
  def.count = count;
  return def;
}

static inline const double (*few_points(void))[3] {
  static const double points[few][3] = {
      {0.5, 0.5, 0.5}, {0.5, 0, 0.5}, {9, 9, 9}, {4, 4, 4}, {0.75, 0.25, 0.25}};
  return points;
}

/* Compares a set query with point queries; `coordinates` as msq sees them. */
typedef void (*compare_fn)(const msq_model* model, const msq_points_def* def,
                           const double (*coordinates)[3], uint64_t count);

/* Random points, of a type and `stride` bytes apart, at an odd address. */
static inline void check_array(const msq_model* model, uint64_t count, int32_t type,
                               uint64_t stride, compare_fn compare) {
  const uint64_t size = type == MSQ_FLOAT32 ? 12 : 24, step = stride ? stride : size;
  unsigned char* bytes = (unsigned char*)malloc(count * step + 1);
  double(*seen)[3] = (double(*)[3])malloc(count * sizeof *seen);
  uint64_t random = stride + 1;
  assert_non_null(bytes);
  assert_non_null(seen);
  memset(bytes, 0xff, count * step + 1); /* NaN between the points */
  for (uint64_t i = 0; i < count; ++i) {
    float single[3];
    for (int axis = 0; axis < 3; ++axis) {
      seen[i][axis] = random_between(&random, -0.3, 4.3);
      if (type == MSQ_FLOAT32) seen[i][axis] = single[axis] = (float)seen[i][axis];
    }
    memcpy(bytes + 1 + i * step, type == MSQ_FLOAT32 ? (const void*)single : seen[i], size);
  }
  msq_points_def def = array_of(bytes + 1, count);
  def.coordinate_type = type;
  def.stride = stride;
  compare(model, &def, (const double(*)[3])seen, count);
  free(bytes);
  free(seen);
}

#endif
