/* SPDX-License-Identifier: Apache-2.0
 *
 * Makes a part and its filling from a few words. */
#ifndef MSQ_EXAMPLE_SCENE_H
#define MSQ_EXAMPLE_SCENE_H

#include <msq.h>

typedef struct scene {
  msq_context* context;
  msq_shape* part;
  msq_model* model;      /* of a model file; else NULL */
  double min[3], max[3]; /* the part's box */
  char problem[640];     /* why the last call failed */
} scene;

/* The fill that a model file has itself. */
#define SCENE_OWN "own"

/* Opens a part: a mesh file, a model file (.json) with the coarse shape of its first region, or
 * block:MM, a cube about the origin. Returns 0, or -1 with s->problem set; scene_close is due in
 * either case. */
int scene_open(scene* s, const char* part);
void scene_close(scene* s);

typedef struct scene_def {
  const char* fill; /* TERM[+TERM ...], each within the solid of the one before; "solid"; or
                       SCENE_OWN. TERM: NAME:CELL[:SIZE], NAME foam or a name in scene.c, SIZE the
                       radius of struts or the walls of surfaces (without: the space on one side of
                       them); LOW-HIGH: from the bottom of a part to its top */
  double skin;      /* left solid under the part's surface */
} scene_def;

/* Makes a model of the part. Returns 0, or -1 with s->problem set. */
int scene_model(scene* s, const scene_def* def, msq_model** model);

#endif
