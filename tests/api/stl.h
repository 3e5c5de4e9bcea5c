/* SPDX-License-Identifier: Apache-2.0
 * A small binary STL file: the cube of make_cube_mesh(). */
#ifndef STL_H
#define STL_H

#include "fixtures.h"

enum { stl_bytes = 84 + 12 * 50 };

static inline void put_little_endian(uint8_t* at, uint32_t value) {
  for (int i = 0; i < 4; ++i) at[i] = (uint8_t)(value >> 8 * i);
}

static inline void put_float(uint8_t* at, double value) {
  const float single = (float)value;
  uint32_t bits;
  memcpy(&bits, &single, sizeof bits);
  put_little_endian(at, bits);
}

static inline void make_stl(uint8_t file[stl_bytes]) {
  double corners[8][3];
  cube_corners(0, 4, corners);
  memset(file, 0, stl_bytes);
  put_little_endian(file + 80, 12);
  for (int i = 0; i < 12; ++i)
    for (int v = 0; v < 3; ++v)
      for (int axis = 0; axis < 3; ++axis)
        put_float(file + 84 + 50 * i + 12 * (v + 1) + 4 * axis,
                  corners[cube_triangles()[i][v]][axis]);
}

/* The shape is the box of make_box(), `scale` times as large. */
static inline void assert_is_cube(msq_context* context, msq_shape* shape, double scale) {
  const msq_shape_report report = info_of(shape);
  assert_int_equal(report.is_mesh, 1);
  assert_int_equal(report.triangles, 12);
  assert_int_equal(report.vertices, 8);
  assert_int_equal(report.closed, 1);
  for (int axis = 0; axis < 3; ++axis) {
    assert_near(report.min[axis], 0, 0);
    assert_near(report.max[axis], 4 * scale, 1e-12 * scale);
  }
  msq_shape_retain(shape);
  msq_model* model = make_shape_model(context, shape);
  assert_int_equal(is_inside(model, scale, 2 * scale, 3 * scale), 1);
  assert_int_equal(is_inside(model, scale, 2 * scale, 4.1 * scale), 0);
  msq_model_release(model);
}

#endif
