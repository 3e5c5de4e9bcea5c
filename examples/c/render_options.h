/* SPDX-License-Identifier: Apache-2.0
 *
 * The command line of render. */
#ifndef MSQ_EXAMPLE_RENDER_OPTIONS_H
#define MSQ_EXAMPLE_RENDER_OPTIONS_H

#include "scene.h"

typedef struct render_options {
  const char *part, *out;
  scene_def scene;
  double threshold, azimuth, elevation, zoom, at[3], perspective;
  unsigned width, height, samples;
  int has_at, glass, plain;
} render_options;

/* Sets the defaults and reads the command line. Returns 0 to go on, 1 where help was asked for
 * and given, -1 where it is wrong, which it has said on stderr. */
int render_options_read(render_options* o, int argc, char** argv);

#endif
