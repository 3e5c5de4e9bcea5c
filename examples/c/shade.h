/* SPDX-License-Identifier: Apache-2.0
 *
 * Turns a depth buffer with normals into a picture of a part on a light ground. */
#ifndef MSQ_EXAMPLE_SHADE_H
#define MSQ_EXAMPLE_SHADE_H

#include "view.h"

enum { SHADE_SUPER = 2 }; /* pixels of the camera's view across a pixel of the picture */

/* Shades what the camera sees, in a hull of glass that is seen from the same place; what the light
 * sees casts the shadows. The ground is z = 0. grain: distance of the samples drawn. *pixels
 * becomes *width x *height RGB, cropped to what is on it, to be freed with free(). Returns 0, or -1
 * if out of memory. */
int shade(const view* camera, const view* hull, const view* light, double grain, uint8_t** pixels,
          int* width, int* height);

#endif
