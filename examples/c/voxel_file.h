/* SPDX-License-Identifier: Apache-2.0
 *
 * Reads voxel images: NRRD (the format of teem, http://teem.sourceforge.net/nrrd/format.html),
 * attached or detached, in raw encoding; and raw files whose layout the caller knows. */
#ifndef MSQ_EXAMPLE_VOXEL_FILE_H
#define MSQ_EXAMPLE_VOXEL_FILE_H

#include <msq.h>
#include <stddef.h>

/* A three-dimensional image as msq takes it, with values of its own. */
typedef struct voxel_file {
  msq_image image;
  void* values;
  char problem[512]; /* why reading failed */
} voxel_file;

/* Reads an NRRD. file->image holds defaults. Returns 0, or -1 with file->problem set. */
int voxel_file_read_nrrd(voxel_file* file, const char* path);

/* Reads a raw file, little-endian, of the value_type, size and grid that file->image holds. Returns
 * 0, or -1 with file->problem set. */
int voxel_file_read_raw(voxel_file* file, const char* path);

/* Takes the layout of a raw file from text: TYPE,X,Y,Z,MM, with one of NRRD's names for the type,
 * the values along x, y and z, and their spacing. Returns 0 or -1. */
int voxel_file_layout(voxel_file* file, const char* text);

/* Frees the values. */
void voxel_file_free(voxel_file* file);

#endif
