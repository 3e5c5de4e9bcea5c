/* SPDX-License-Identifier: Apache-2.0
 *
 * The position of the viewer, and how dragging and the wheel change it. */
#ifndef MSQ_EXAMPLE_POSE_H
#define MSQ_EXAMPLE_POSE_H

#include <msq.h>

typedef struct pose {
  double azimuth, elevation; /* of the eye, as in orbit_direction */
  double target[3];          /* in the middle of the window */
  double height;   /* model units from the window's lower to its upper edge, at the target */
  double diagonal; /* of the part's box */
  int is_perspective;
  int window[2]; /* width and height, pixels */
} pose;

/* Shows the whole box from the front, right and above. */
void pose_reset(pose* p, const double min[3], const double max[3]);

msq_status pose_camera(const pose* p, msq_camera* camera);

/* dx, dy: pixels to the right and downwards that the part is to follow. */
void pose_turn(pose* p, double dx, double dy);
msq_status pose_pan(pose* p, double dx, double dy);

/* Zooms in by notches of a wheel, about a pixel of the window. */
msq_status pose_zoom(pose* p, double notches, int x, int y);

#endif
