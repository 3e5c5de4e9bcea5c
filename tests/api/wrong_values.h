/* SPDX-License-Identifier: Apache-2.0
 * Rows that the tables of several functions share. */
#ifndef WRONG_VALUES_H
#define WRONG_VALUES_H

#include "refusals.h"

#define COUNT_OF(array) (sizeof(array) / sizeof(array)[0])

static inline msq_job* cancelled_job(void) {
  static msq_job* job;
  if (!job) {
    assert_ok(msq_job_create(&job));
    assert_ok(msq_job_cancel(job));
  }
  return job;
}

/* The status of a call on a context with 300 bytes of memory. */
static inline msq_context* small_context(void) {
  static msq_context* context;
  if (!context) context = make_context_of(1, 0, 300);
  return context;
}

/* Gradient along x, from low at 0 to high at 1. */
static inline msq_field* ramp_of(msq_context* context, double low, double high) {
  const double from[3] = {0, 0, 0}, to[3] = {1, 0, 0};
  msq_field* field;
  assert_ok(msq_field_gradient(context, from, low, to, high, &field));
  return field;
}

/* Bytes of a newer library. The definition is in a room of definition(). */
static inline void wrong_tail(refusals* table, void* def, size_t known) {
  unsigned char* tail = (unsigned char*)def + known;
  uint32_t* size = (uint32_t*)def;
  RIGHT(*size = (uint32_t)known + struct_tail; memset(tail, 0, struct_tail));
  for (int i = 0; i < struct_tail; i += struct_tail - 1)
    WRONG(ARGUMENT, words_of("byte|%d", (int)known + i), *size = (uint32_t)known + struct_tail;
          memset(tail, 0, struct_tail); tail[i] = 1);
}

/* A struct_size that no library knows, and bytes of a newer one that are not zero. The definition
 * is valid by its first fields alone. */
static inline void wrong_sizes(refusals* table, void* def, size_t first, size_t known) {
  const uint32_t sizes[] = {0, 4, sizeof(void*), (uint32_t)first - 1, 4097, UINT32_MAX};
  uint32_t* size = (uint32_t*)def;
  for (size_t i = 0; i < COUNT_OF(sizes); ++i)
    WRONG(ARGUMENT, words_of("struct_size|%" PRIu32, sizes[i]), *size = sizes[i]);
  RIGHT(*size = (uint32_t)first);
  wrong_tail(table, def, known);
}

static inline void wrong_number(refusals* table, double* number, const char* words) {
  for (int which = 0; which < 3; ++which)
    WRONG(ARGUMENT, words_of("%s|%s", words, which ? "inf" : "nan"), *number = not_finite(which));
}

static inline void wrong_vector(refusals* table, double* vector, const char* words) {
  for (int axis = 0; axis < 3; ++axis) wrong_number(table, vector + axis, words);
}

/* Numbers outside of [low, high], which are accepted. */
static inline void wrong_enum(refusals* table, int32_t* number, const char* name, int32_t low,
                              int32_t high) {
  const int32_t wrong[] = {low - 1, high + 1, INT32_MIN, INT32_MAX};
  for (int i = 0; i < 4; ++i)
    WRONG(ARGUMENT,
          words_of("%s is %" PRId32 ";|from %" PRId32 " to %" PRId32, name, wrong[i], low, high),
          *number = wrong[i]);
}

static inline void wrong_query(refusals* table, msq_query_def* query) {
  wrong_sizes(table, query, offsetof(msq_query_def, critical_count), sizeof *query);
  WRONG(ARGUMENT, "struct_size of query is 4", query->struct_size = 4);
  WRONG(ARGUMENT, "length_scale|-0.5", query->length_scale = -0.5);
  WRONG(ARGUMENT, "length_scale is nan; it must be 0 or more", query->length_scale = NAN);
  WRONG(ARGUMENT, "length_scale|-inf", query->length_scale = -INFINITY);
  wrong_enum(table, &query->method, "method", 0, 2);
  WRONG(ARGUMENT, "group_parts is 65", query->group_parts = 65);
  WRONG(ARGUMENT, "reserved is 2", query->reserved = 2);
}

static inline msq_query_def* any_query(int number) {
  msq_query_def* query = (msq_query_def*)definition(number);
  assert_ok(msq_query_def_init(query, sizeof *query));
  return query;
}

static inline void wrong_point(refusals* table, double* point) {
  for (int axis = 0; axis < 3; ++axis)
    for (int which = 0; which < 3; ++which)
      WRONG(ARGUMENT, words_of("point|%s", which ? "inf" : "nan"), point[axis] = not_finite(which));
}

enum { some_count = 8 };

/* An array of 8 points within a box from 0 to 4. */
static inline msq_points_def* some_points(int number) {
  static double points[some_count][3];
  msq_points_def* def = (msq_points_def*)definition(number);
  for (int i = 0; i < some_count; ++i)
    for (int axis = 0; axis < 3; ++axis) points[i][axis] = 0.25 + 0.375 * i + 0.125 * axis;
  assert_ok(msq_points_def_init(def, sizeof *def));
  def->coordinates = points;
  def->count = some_count;
  return def;
}

/* Their coordinates, as an output. */
static inline void* of_some_points(const msq_points_def* def, size_t byte) {
  return (unsigned char*)(uintptr_t)def->coordinates + byte;
}

/* As many, in a grid. */
static inline void set_grid(msq_points_def* def) {
  *def = grid_points(0, 1, 2);
}

/* Of some_points(). */
static inline void wrong_points(refusals* table, msq_points_def* def) {
  const double spacings[] = {0, -1, NAN, INFINITY};
  const uint64_t counts[] = {0, (uint64_t)1 << 31, UINT64_MAX};
  static double odd[some_count][3];
  wrong_sizes(table, def, offsetof(msq_points_def, seed), sizeof *def);
  wrong_enum(table, &def->kind, "kind", 1, 3);
  WRONG(ARGUMENT, "coordinate_type is 0;|from 1 to 2", def->coordinate_type = 0);
  WRONG(ARGUMENT, "coordinate_type is 4;|from 1 to 2", def->coordinate_type = 4);
  WRONG(ARGUMENT, "reserved is 8", def->reserved = 8);
  WRONG(ARGUMENT, "coordinates is NULL", def->coordinates = NULL);
  WRONG(ARGUMENT, "23|24", def->stride = 23);
  WRONG(ARGUMENT, "11|12", def->coordinate_type = MSQ_FLOAT32; def->stride = 11);
  WRONG(LIMIT, "2^63", def->stride = UINT64_MAX / 2);
  for (int which = 0; which < 3; ++which)
    WRONG(ARGUMENT, "point 3", memcpy(odd, def->coordinates, sizeof odd);
          odd[3][which] = not_finite(which); def->coordinates = odd);
  RIGHT(set_grid(def));
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < 3; ++i) {
      WRONG(ARGUMENT, "origin", set_grid(def); def->origin[axis] = not_finite(i));
      WRONG(ARGUMENT, words_of("counts[%d]|%" PRIu64 "|2147483647", axis, counts[i]), set_grid(def);
            def->counts[axis] = counts[i]);
    }
    for (int i = 0; i < 4; ++i)
      WRONG(ARGUMENT, "spacing", set_grid(def); def->spacing[axis] = spacings[i]);
    WRONG(ARGUMENT, "last point", set_grid(def); def->spacing[axis] = 1e308; def->counts[axis] = 3);
    WRONG(ARGUMENT, "would coincide|1e-11", set_grid(def); def->origin[axis] = 1e6;
          def->spacing[axis] = 1e-11);
  }
  WRONG(
      LIMIT, "2147483647|2^63", set_grid(def); for (int axis = 0; axis < 3; ++axis) {
        def->spacing[axis] = 1e-9;
        def->counts[axis] = INT32_MAX;
      });
}

/* A sample of a box from 0 to 4 for statistics. */
static inline void wrong_sample(refusals* table, msq_points_def* sample) {
  WRONG(ARGUMENT, "struct_size", sample->struct_size = 1);
  wrong_tail(table, sample, sizeof *sample);
  WRONG(ARGUMENT, "per_cell is 1", sample->per_cell = 1);
  WRONG(ARGUMENT, "per_cell is 4097", sample->per_cell = 4097);
  WRONG(ARGUMENT, "kind is 2", sample->kind = MSQ_POINTS_GRID);
  WRONG(ARGUMENT, "counts[2] is 0", sample->counts[2] = 0);
  WRONG(ARGUMENT, "reserved is 4", sample->reserved = 4);
  wrong_vector(table, sample->origin, "origin");
  wrong_vector(table, sample->spacing, "spacing");
}

static inline void wrong_grid(refusals* table, msq_neighbourhood* grid) {
  wrong_vector(table, grid->origin, "grid.origin");
  wrong_vector(table, grid->cell_size, "grid.cell_size");
  for (int axis = 0; axis < 3; ++axis) {
    WRONG(ARGUMENT, "grid.cell_size is 0;", grid->cell_size[axis] = 0);
    WRONG(ARGUMENT, "grid.cell_size is -2;", grid->cell_size[axis] = -2);
    WRONG(ARGUMENT, "is 9.5e-76; it must be from 1e-75 to 1e75", grid->cell_size[axis] = 9.5e-76);
    WRONG(ARGUMENT, "is 1.5e+75; it must be from 1e-75 to 1e75", grid->cell_size[axis] = 1.5e75);
    WRONG(ARGUMENT, "determinant", grid->rotation[4 * axis] = -1);
  }
  for (int i = 0; i < 9; ++i) { /* orthonormal within 1e-9 */
    wrong_number(table, grid->rotation + i, "grid.rotation");
    WRONG(ARGUMENT, "grid.rotation|1e-9", grid->rotation[i] += 1e-7);
    RIGHT(grid->rotation[i] += 1e-10);
  }
  WRONG(ARGUMENT, "grid.rotation", memset(grid->rotation, 0, sizeof grid->rotation));
}

/* For wrong_radius(), with the limit max: negative somewhere, 0 everywhere, beyond the limit. */
static inline void make_fields(msq_context* context, msq_field* fields[3], double max) {
  fields[0] = ramp_of(context, -0.25, 0.25);
  fields[1] = ramp_of(context, 0, 0);
  fields[2] = ramp_of(context, 0, 2 * max);
}

static inline void release_fields(msq_field* fields[3]) {
  for (int i = 0; i < 3; ++i) msq_field_release(fields[i]);
}

/* A radius, 0 of which is none; max: the limit for the grid. Fields are released with the table's.
 */
static inline void wrong_radius(refusals* table, msq_param* radius, double max,
                                msq_field* const fields[3]) {
  const double refused[] = {0, -0.5, NAN, INFINITY, -INFINITY};
  for (size_t i = 0; i < COUNT_OF(refused); ++i)
    WRONG(ARGUMENT, "radius is ", radius->value = refused[i]);
  RIGHT(radius->value = max);
  WRONG(LIMIT, words_of("radius|%g|the limit is %g", max * 1.0009765625, max),
        radius->value = max * 1.0009765625);
  WRONG(ARGUMENT, "radius|-0.25", radius->field = fields[0]);
  WRONG(ARGUMENT, "radius|0 everywhere", radius->field = fields[1]);
  WRONG(LIMIT, "radius|limit", radius->field = fields[2]);
}

/* An image of small_image(), for a function that takes min_size values and more along an axis. */
static inline void wrong_image(refusals* table, msq_image* image, uint64_t min_size) {
  static float values[27];
  static double wide[27];
  memset(values, 0, sizeof values);
  memset(wide, 0, sizeof wide);
  WRONG(ARGUMENT, "image.values is NULL", image->values = NULL);
  WRONG(ARGUMENT, "value_type is -1", image->value_type = -1);
  WRONG(ARGUMENT, "value_type is 0", image->value_type = 0); /* the default */
  WRONG(ARGUMENT, "value_type is 6", image->value_type = 6);
  WRONG(ARGUMENT, "reserved", image->reserved = 1);
  for (int axis = 0; axis < 3; ++axis) {
    WRONG(ARGUMENT, "image.size", image->size[axis] = min_size - 1);
    WRONG(ARGUMENT, "1048577", image->size[axis] = ((uint64_t)1 << 20) + 1);
    WRONG(ARGUMENT, "cell_size", image->grid.cell_size[axis] = 0);
    WRONG(ARGUMENT, "cell_size", image->grid.cell_size[axis] = NAN);
    WRONG(ARGUMENT, "is 9.5e-76; it must be from 1e-75 to 1e75",
          image->grid.cell_size[axis] = 9.5e-76);
    WRONG(ARGUMENT, "is 1.5e+75; it must be from 1e-75 to 1e75",
          image->grid.cell_size[axis] = 1.5e75);
    WRONG(ARGUMENT, "origin", image->grid.origin[axis] = INFINITY);
  }
  WRONG(ARGUMENT, "rotation", image->grid.rotation[1] = 0.5);
  WRONG(ARGUMENT, "image.row_stride is 2", image->row_stride = 2);
  WRONG(ARGUMENT, "image.layer_stride is 8", image->layer_stride = 8);
  WRONG(LIMIT, "", image->layer_stride = UINT64_MAX / 2);
  RIGHT(image->value_type = MSQ_FLOAT32; image->values = values; values[26] = 300);
  WRONG(ARGUMENT, "value (2, 1, 1) of the image", image->value_type = MSQ_FLOAT32;
        image->values = values; values[14] = NAN);
  WRONG(ARGUMENT, "1e+100", image->value_type = MSQ_FLOAT64; image->values = wide; wide[1] = 2e100);
}

#endif
