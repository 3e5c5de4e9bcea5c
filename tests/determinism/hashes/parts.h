/* SPDX-License-Identifier: Apache-2.0 */
/* What the models are made of. */
#ifndef MSQ_TEST_HASHES_PARTS_H
#define MSQ_TEST_HASHES_PARTS_H

#include <msq.h>

/* Ends the program with the message of msq if a call fails. */
void must(msq_status status);

/* Keeps the parts of a model until it is made. */
typedef struct Kit {
  msq_context* context;
  msq_field* fields[4];
  msq_structure* structures[4];
  msq_shape* shapes[4];
  msq_model* models[4];
  int field_count, structure_count, shape_count, model_count;
} Kit;

/* Releases the parts. */
void throw_away(Kit* kit);

/* ---- Shapes ---- */

msq_shape* box(Kit* kit);
msq_shape* sphere(Kit* kit, double radius);
msq_shape* cylinder(Kit* kit);
/* A skew octahedron. is_open: without one face. */
msq_shape* mesh(Kit* kit, int is_open);
/* A ball with ripples, from an image. */
msq_shape* voxels(Kit* kit);
/* Turned about z and moved. */
msq_shape* placed(Kit* kit, const msq_shape* original);
msq_shape* difference(Kit* kit, const msq_shape* a, const msq_shape* b);

/* ---- Parameters ---- */

msq_param number(double value);
msq_param gradient(Kit* kit, double from, double to);
msq_param radial(Kit* kit, double from, double to);
msq_param expression(Kit* kit, const char* text, double low, double high);
/* The values of the image of voxels(), mapped to a range. */
msq_param sampled(Kit* kit, double low, double high);
/* By the distance to a shape. */
msq_param depth(Kit* kit, const msq_shape* shape, double outside, double deep);

/* ---- Structures ---- */

/* Sides of the cells. */
void set_cells(msq_neighbourhood* grid, double x, double y, double z);
/* By a matrix that is orthonormal up to rounding. */
void turn(msq_neighbourhood* grid);
msq_lattice_def lattice_def(int32_t unit_cell, double cell, msq_param radius);
const msq_structure* lattice(Kit* kit, const msq_lattice_def* def);
msq_foam_def foam_def(double cell, msq_param radius);
const msq_structure* foam(Kit* kit, const msq_foam_def* def);
msq_functional_def functional_def(int32_t function, int32_t kind, double cell);
const msq_structure* functional(Kit* kit, const msq_functional_def* def);
const msq_structure* beams(Kit* kit);
const msq_structure* waves(Kit* kit);
const msq_structure* plate_lattice(Kit* kit);
/* operation: an msq_boolean_operation. */
const msq_structure* joined(Kit* kit, int32_t operation, const msq_structure* a,
                            const msq_structure* b);
const msq_structure* filleted(Kit* kit, int32_t operation, const msq_structure* a,
                              const msq_structure* b, msq_param radius);
const msq_structure* blended(Kit* kit, const msq_structure* a, const msq_structure* b,
                             msq_param fraction);

#endif
