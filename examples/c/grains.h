/* SPDX-License-Identifier: Apache-2.0
 *
 * A structure that the host computes: balls around random germs, without end. If they may overlap
 * it is the Boolean model. If not, it is Matern's second hard-core process: a germ stays if no germ
 * within two radii has a lower mark. Sources: Torquato, "Random Heterogeneous Materials", 2002,
 * chapter 5; Matern, "Spatial Variation", 1960. */
#ifndef MSQ_EXAMPLE_GRAINS_H
#define MSQ_EXAMPLE_GRAINS_H

#include <msq.h>

typedef struct grains {
  double radius, mean; /* of balls, at most 1/3; of germs in a cell of size 1, before some go */
  int are_apart;
  uint64_t seed; /* any number strews others */
} grains;

/* Number n of stream `key`, in [0, 1), a pure function of both. */
double grains_uniform(uint64_t key, uint64_t n);

/* Sets what a structure of these grains takes; they must live as long as it does. */
void grains_define(grains* g, msq_host_structure_def* def);

#endif
