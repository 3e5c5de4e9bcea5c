/* SPDX-License-Identifier: Apache-2.0
 * Structures and polygons for the tests of fill lines. */
#ifndef FILLS_H
#define FILLS_H

#include "fixtures.h"

static inline msq_structure* make_sheet(msq_context* context, int32_t function, double cell) {
  msq_functional_def def;
  msq_structure* structure;
  assert_ok(msq_functional_def_init(&def, sizeof def));
  def.function = function;
  def.kind = MSQ_FUNCTIONAL_SHEET;
  def.level.value = 0.3;
  set_cell(&def.grid, cell);
  assert_ok(msq_structure_functional(context, &def, &structure));
  return structure;
}

static inline msq_structure* make_foam_of(msq_context* context, double cell) {
  msq_foam_def def;
  msq_structure* structure;
  assert_ok(msq_foam_def_init(&def, sizeof def));
  def.radius.value = 0.1 * cell;
  set_cell(&def.grid, cell);
  assert_ok(msq_structure_foam(context, &def, &structure));
  return structure;
}

/* A square of 40 mm with a square hole of 10 mm in its middle, in nanometres. */
static const int64_t square_nm[4][2] = {{0, 0}, {40000000, 0}, {40000000, 40000000}, {0, 40000000}};
static const int64_t hole_nm[4][2] = {
    {15000000, 15000000}, {15000000, 25000000}, {25000000, 25000000}, {25000000, 15000000}};
static const msq_ring square_rings[2] = {{square_nm, 4}, {hole_nm, 4}};

static inline msq_fill_def square_def(double z) {
  msq_fill_def def;
  assert_ok(msq_fill_def_init(&def, sizeof def));
  def.rings = square_rings;
  def.ring_count = 2;
  def.scale = 1e-6;
  def.z = z;
  return def;
}

static inline msq_fill* make_fill(msq_context* context, const msq_structure* structure,
                                  const msq_fill_def* def) {
  msq_fill* fill;
  assert_ok(msq_fill_lines(context, structure, def, &fill, NULL));
  return fill;
}

static inline msq_fill_report paths_of(const msq_fill* fill) {
  msq_fill_report report = {0};
  report.struct_size = sizeof report;
  assert_ok(msq_fill_info(fill, &report));
  return report;
}

/* Coordinate c of the points, whatever their type. */
static inline double coordinate_of(const msq_fill_report* report, uint64_t c) {
  return report->coordinate_type == MSQ_INT32 ? (double)((const int32_t*)report->points)[c]
                                              : (double)((const int64_t*)report->points)[c];
}

#endif
