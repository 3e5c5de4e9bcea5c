/* SPDX-License-Identifier: Apache-2.0
 * What lib3mf, a library of others, reads and writes of 3MF files. */
#ifndef LIB3MF_FILES_H
#define LIB3MF_FILES_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The one object with beams. Arrays of malloc(). */
typedef struct lib3mf_lattice {
  uint64_t node_count, beam_count;
  double *nodes, *radii; /* triples, pairs */
  uint32_t* beams;
  uint8_t* caps;
  int32_t clipping; /* as in msq_clipping */
  uint64_t clipping_triangles;
  uint64_t warnings;
} lib3mf_lattice;

/* Stacks of slices. */
typedef struct lib3mf_stack {
  uint64_t slice_count, polygon_count, vertex_count;
  double bottom, top;
  double area; /* of all slices together; holes are negative */
  uint64_t warnings;
} lib3mf_stack;

/* Returns 0, or the line of the call that failed. */
int lib3mf_read_lattice(const char* path, lib3mf_lattice* lattice);
/* Clipped, if clipping is not 0, by a tetrahedron. */
int lib3mf_write_lattice(const char* path, const lib3mf_lattice* lattice);
int lib3mf_read_stack(const char* path, lib3mf_stack* stack);

#ifdef __cplusplus
}
#endif

#endif
