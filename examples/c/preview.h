/* SPDX-License-Identifier: Apache-2.0
 *
 * Draws a shaded picture of the part from the layers as they arrive, seen obliquely from above, in
 * a glass hull that is the coarse shape. Nine layers are held at a time, for any height of the
 * stack. */
#ifndef MSQ_EXAMPLE_PREVIEW_H
#define MSQ_EXAMPLE_PREVIEW_H

#include <msq.h>

typedef struct preview preview;

/* A preview for all layers of a plan, layer_height apart. NULL if out of memory. */
preview* preview_create(const msq_slicer_report* plan, double layer_height);

/* Takes a layer of bits and the coarse shape's, which has the same rows. All layers of the plan
 * must come, in ascending order. */
void preview_take(preview* p, const msq_layer* layer, const uint8_t* coarse);

/* Shades what was taken and writes the PNG. Call it once. Returns 0 or a positive errno value. */
int preview_save(preview* p, const char* path);

void preview_free(preview* p);

#endif
