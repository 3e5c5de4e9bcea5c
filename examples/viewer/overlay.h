/* SPDX-License-Identifier: Apache-2.0
 *
 * Draws text over the picture, in a font of its own. */
#ifndef MSQ_EXAMPLE_OVERLAY_H
#define MSQ_EXAMPLE_OVERLAY_H

#include <SDL.h>

/* Writes lines of text (capitals, digits, + - . / : [ ]; others are spaces) from a corner of the
 * window on, on a dark ground. size: pixels a dot; fewer where the window is narrower than the
 * text. */
void overlay_write(SDL_Renderer* renderer, int left, int top, int size, const char* text);

#endif
