/* SPDX-License-Identifier: Apache-2.0
 *
 * Makes a part and its filling from a few words, for render and viewer. */
#ifndef MSQ_EXAMPLE_SCENE_H
#define MSQ_EXAMPLE_SCENE_H

#include <msq.h>

typedef struct scene {
  msq_context* context;
  msq_shape* part;
  msq_field* grey; /* of a voxel image; else NULL */
  double threshold;
  double min[3], max[3]; /* the part's box */
  char problem[640];     /* why the last call failed */
} scene;

/* Opens a part: a mesh file, an NRRD that is solid from the threshold on, or block:MM, a cube about
 * the origin. Returns 0, or -1 with s->problem set; scene_close is due in either case. */
int scene_open(scene* s, const char* part, double threshold);
void scene_close(scene* s);

typedef struct scene_def {
  const char* fill;    /* TERM[+TERM ...], each within the solid of the one before; or "solid".
                          TERM: NAME:CELL[:SIZE], NAME as render --help lists, SIZE the radius of
                          struts or the walls of surfaces (without: the space on one side of them);
                          LOW-HIGH: from the bottom of a part to its top, of voxels from the
                          threshold to 450 above it, and from 700 above it on solid */
  const char* density; /* of foams: MOST:EXPRESSION, seeds in a cell at x, y, z; NULL: one */
  const char* cut;     /* x:MM takes away what lies below that x, -x:MM what lies above; y and z
                          likewise; then scale 1 is the cut. NULL: none */
  double skin;         /* left solid under the part's surface */
} scene_def;

/* Makes a model of the part. Returns 0, or -1 with s->problem set. */
int scene_model(scene* s, const scene_def* def, msq_model** model);

#endif
