/* SPDX-License-Identifier: Apache-2.0
 *
 * Draws what surrounds a part in a picture: a light ground with its shadow, haze that grows with
 * the distance, and the outline of the coarse part as glass. */
#ifndef MSQ_COMMAND_STAGE_H
#define MSQ_COMMAND_STAGE_H

#include <msq.h>

typedef struct stage {
  const msq_model* model;
  const msq_camera* camera;
  uint32_t width, height; /* pixels */
  double light[3];        /* towards the light, in the camera's frame, as in msq_render_def */
  int glass;              /* 1: show the coarse part */
  double ground;          /* z of the ground where has_ground is 1 */
  int has_ground;
  const float* depth; /* one per pixel, infinity where nothing is hit, as in msq_frame */
} stage;

/* Lays the picture of the model, straight alpha, over the stage: rgb becomes width * height
 * triples. Returns a status of msq; MSQ_E_MEMORY also where its own memory fails. */
msq_status stage_compose(const stage* s, const uint8_t* rgba, uint8_t* rgb);

#endif
