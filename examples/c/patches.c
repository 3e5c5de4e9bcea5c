/* SPDX-License-Identifier: Apache-2.0 */
#include "patches.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { side = block_side };
typedef struct corners {
  double from[8][3]; /* where in the block each corner of a cell looks, in voxels */
} corners;

static uint64_t mix(uint64_t x) { /* SplitMix64 */
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

/* Grey value between voxels, the block repeated. */
static double grey_at(const block* b, const double p[3]) {
  int at[3][2];
  double part[3], sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = floor(p[axis]);
    part[axis] = p[axis] - low;
    at[axis][0] = (int)(low - side * floor(low / side));
    at[axis][1] = (at[axis][0] + 1) % side;
  }
  for (int c = 0; c < 8; ++c) {
    const int x = c & 1, y = c >> 1 & 1, z = c >> 2;
    sum += (x ? part[0] : 1 - part[0]) * (y ? part[1] : 1 - part[1]) * (z ? part[2] : 1 - part[2]) *
           b->grey[at[0][x] + side * (at[1][y] + side * at[2][z])];
  }
  return sum;
}

/* Offsets depend on the corner alone, so cells that share one agree about it. */
static int32_t build_cell(void* user, const int32_t cell[3], void** data, uint64_t* bytes) {
  corners* made = malloc(sizeof *made);
  (void)user;
  if (!made) return -1;
  for (int c = 0; c < 8; ++c) {
    uint64_t key = 1;
    for (int axis = 0; axis < 3; ++axis) key = mix(key + (uint32_t)(cell[axis] + (c >> axis & 1)));
    for (int axis = 0; axis < 3; ++axis) made->from[c][axis] = (double)(mix(key + axis + 1) % side);
  }
  *data = made;
  *bytes = sizeof *made;
  return 0;
}

static int32_t evaluate_cell(void* user, const void* data, const msq_host_points* points,
                             uint8_t* inside) {
  const block* b = user;
  const corners* cell = data;
  for (uint64_t i = 0; i < points->count; ++i) {
    const double* u = points->positions + 3 * i; /* cells have size 1 */
    double sum = 0, squares = 0;
    for (int c = 0; c < 8; ++c) {
      double weight = 1, at[3];
      for (int axis = 0; axis < 3; ++axis) {
        weight *= c >> axis & 1 ? u[axis] : 1 - u[axis];
        at[axis] = cell->from[c][axis] + (u[axis] - (c >> axis & 1)) * side / 2;
      }
      sum += weight * (grey_at(b, at) - b->mean);
      squares += weight * weight;
    }
    inside[i] = b->mean + sum / sqrt(squares) >= block_solid;
  }
  return 0;
}

static void free_cell(void* user, void* data) {
  (void)user;
  free(data);
}

int block_read(const char* path, block* b) {
  FILE* file = path ? fopen(path, "rb") : NULL;
  const size_t read = file ? fread(b->grey, 1, block_voxels, file) : 0;
  if (file) fclose(file);
  if (path && read != block_voxels) return -1;
  for (int v = 0; !path && v < block_voxels; ++v) {
    const int at[3] = {v % side, v / side % side, v / side / side};
    double sum = 0;
    for (uint64_t n = 0, waves = 0; waves < 40; ++n) {
      double k[3], squared = 0, phase = (double)(mix(4 * n) % 6283) / 1000;
      for (uint64_t axis = 0; axis < 3; ++axis) {
        k[axis] = (double)(mix(4 * n + axis + 1) % 9) - 4;
        squared += k[axis] * k[axis];
        phase += k[axis] * at[axis] * 6.283185307179586 / side;
      }
      if (squared < 9 || squared > 14) continue;
      sum += cos(phase);
      ++waves;
    }
    b->grey[v] = (uint8_t)fmin(255, fmax(0, 118 + 12 * sum));
  }
  b->mean = 0;
  for (int v = 0; v < block_voxels; ++v) b->mean += (double)b->grey[v] / block_voxels;
  return 0;
}

void patches_define(block* b, msq_host_structure_def* def) {
  def->concurrent = 1; /* the callbacks change nothing that is shared */
  def->build_cell = build_cell;
  def->evaluate_cell = evaluate_cell;
  def->free_cell = free_cell;
  def->user = b;
}
