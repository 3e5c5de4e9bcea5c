/* SPDX-License-Identifier: Apache-2.0
 *
 * The command line of slice_stl. */
#ifndef MSQ_EXAMPLE_SLICE_OPTIONS_H
#define MSQ_EXAMPLE_SLICE_OPTIONS_H

#include <stdint.h>

typedef struct slice_options {
  const char *file, *out;
  double block;              /* side of a cube instead of a file; 0: a file */
  double foam, cell;         /* cell sizes of the foam and of the lattice */
  double radius, radius_top; /* of the struts */
  double skin;               /* thickness of the solid skin; 0: none */
  double density;            /* of the foam's seeds at the greatest x, from 1 at the least */
  double layer, pitch, unit;
  int32_t unit_cells[8];    /* of the lattice, MSQ_UNIT_CELL_*, from the least x to the greatest */
  uint32_t unit_cell_count; /* 0: a foam */
  int32_t tpms;             /* MSQ_FUNCTION_*, 0: none */
  double wall;              /* thickness of its sheets, or of the foam's walls; 0: none */
  int solid;                /* 1: the part alone */
  int graded;               /* 1: radius_top counts */
  uint64_t seed, every, threads;
} slice_options;

/* Sets the defaults and reads the command line. Returns 0 to go on, 1 where help was asked for and
 * given, -1 where the command line is wrong, which it has said on stderr. */
int slice_options_read(slice_options* o, int argc, char** argv);

#endif
