/* SPDX-License-Identifier: Apache-2.0 */
#include "grains.h"

#include <math.h>
#include <stdlib.h>

typedef struct germ {
  double at[3], mark; /* from the corner of the cell asked for */
} germ;
typedef struct germs { /* those whose balls reach a cell: what msq keeps of it */
  uint64_t count;
  germ germs[];
} germs;

enum { max_in_cell = 64 };

/* Random numbers by counters: a cell's germs are the same whoever asks, and kept nowhere. Source:
 * Steele, Lea and Flood 2014 (SplitMix64). */
static uint64_t mix(uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}
double grains_uniform(uint64_t key, uint64_t n) {
  return (double)(mix(key + n * 0x9e3779b97f4a7c15u) >> 11) * 0x1p-53;
}

/* The germs of one cell, a Poisson number of them. */
static size_t strew(const grains* g, const int32_t cell[3], const int shift[3], germ* out) {
  uint64_t key = g->seed, n = 0;
  size_t count = 0;
  for (int axis = 0; axis < 3; ++axis) key = mix(key + (uint32_t)(cell[axis] + shift[axis]));
  for (double left = grains_uniform(key, n++), p = exp(-g->mean);
       left >= p && count < max_in_cell;) {
    left -= p;
    p *= g->mean / (double)++count;
  }
  for (size_t i = 0; i < count; ++i) {
    for (int axis = 0; axis < 3; ++axis) out[i].at[axis] = shift[axis] + grains_uniform(key, n++);
    out[i].mark = grains_uniform(key, n++);
  }
  return count;
}

static double squared(const double a[3], const double b[3]) {
  const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return x * x + y * y + z * z;
}

static int32_t build_cell(void* user, const int32_t cell[3], void** data, uint64_t* bytes) {
  const grains* g = user;
  germ around[27 * max_in_cell];
  size_t count = 0;
  for (int s = 0; s < 27; ++s) {
    const int shift[3] = {s % 3 - 1, s / 3 % 3 - 1, s / 9 - 1};
    count += strew(g, cell, shift, around + count);
  }
  germs* kept = malloc(sizeof *kept + count * sizeof(germ));
  if (!kept) return -1;
  kept->count = 0;
  for (size_t i = 0; i < count; ++i) {
    const double *p = around[i].at, reach = g->radius * (1 + 1e-9);
    int stays = 1;
    for (int axis = 0; axis < 3; ++axis) stays &= p[axis] >= -reach && p[axis] <= 1 + reach;
    for (size_t k = 0; g->are_apart && stays && k < count; ++k)
      stays =
          around[k].mark >= around[i].mark || squared(p, around[k].at) >= 4 * g->radius * g->radius;
    if (stays) kept->germs[kept->count++] = around[i];
  }
  *data = kept;
  *bytes = sizeof *kept + count * sizeof(germ);
  return 0;
}

static int32_t evaluate_cell(void* user, const void* data, const msq_host_points* points,
                             uint8_t* inside) {
  const grains* g = user;
  const germs* cell = data;
  for (uint64_t i = 0; i < points->count; ++i) /* all 0 before */
    for (uint64_t k = 0; k < cell->count && !inside[i]; ++k)
      inside[i] = squared(points->positions + 3 * i, cell->germs[k].at) <= g->radius * g->radius;
  return 0;
}

static void free_cell(void* user, void* data) {
  (void)user;
  free(data);
}

void grains_define(grains* g, msq_host_structure_def* def) {
  def->concurrent = 1; /* the callbacks change nothing that is shared */
  def->build_cell = build_cell;
  def->evaluate_cell = evaluate_cell;
  def->free_cell = free_cell;
  def->user = g;
}
