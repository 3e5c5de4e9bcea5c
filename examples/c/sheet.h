/* SPDX-License-Identifier: Apache-2.0
 *
 * Draws a contact sheet: some layers of a stack, evenly spaced, each with its height below it. */
#ifndef MSQ_EXAMPLE_SHEET_H
#define MSQ_EXAMPLE_SHEET_H

#include <msq.h>

typedef struct sheet sheet;

/* A sheet for the layers of a plan. NULL if out of memory. */
sheet* sheet_create(const msq_slicer_report* plan);

/* Takes a layer of bits and the coarse shape's, which has the same rows and is drawn in a light
 * grey behind it. Layers that are not on the sheet are passed over. */
void sheet_take(sheet* s, const msq_layer* layer, const uint8_t* coarse);

/* Writes the PNG. Returns 0 or a positive errno value. */
int sheet_save(const sheet* s, const char* path);

void sheet_free(sheet* s);

#endif
