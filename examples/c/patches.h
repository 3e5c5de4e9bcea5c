/* SPDX-License-Identifier: Apache-2.0
 *
 * A structure that the host computes from an example: a periodic block of voxels, continued without
 * end and without repetition. Each corner of a cell shows the block from a random place. Between
 * the corners the eight are blended by weights that keep the variance, so the solid is as dense as
 * the block. Source: Heitz and Neyret, "High-performance by-example noise using a
 * histogram-preserving blending operator", 2018. */
#ifndef MSQ_EXAMPLE_PATCHES_H
#define MSQ_EXAMPLE_PATCHES_H

#include <msq.h>

enum { block_side = 32, block_voxels = block_side * block_side * block_side, block_solid = 128 };

typedef struct block {
  uint8_t grey[block_voxels]; /* x first; solid from block_solid on */
  double mean;
} block;

/* Reads grey values from a file; path NULL: makes waves of about one length in random directions
 * (Cahn 1965). Returns 0, or -1 where the file is not there or too short. */
int block_read(const char* path, block* b);

/* Sets what a structure takes, cells of size 1 half as long as the block; the block must live as
 * long as it does. */
void patches_define(block* b, msq_host_structure_def* def);

#endif
