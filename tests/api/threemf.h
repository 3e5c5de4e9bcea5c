/* SPDX-License-Identifier: Apache-2.0
 * 3MF files of beams, as archives whose one entry is not compressed. */
#ifndef THREEMF_H
#define THREEMF_H

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

typedef struct threemf_bytes {
  unsigned char* data; /* of malloc() */
  uint64_t size;
} threemf_bytes;

static inline void threemf_put(threemf_bytes* file, const void* data, size_t size) {
  file->data = (unsigned char*)realloc(file->data, file->size + size);
  memcpy(file->data + file->size, data, size);
  file->size += size;
}

static inline void threemf_number(threemf_bytes* file, uint32_t number, int bytes) {
  for (int i = 0; i < bytes; ++i) {
    const unsigned char byte = (unsigned char)(number >> (8 * i));
    threemf_put(file, &byte, 1);
  }
}

static inline void threemf_header(threemf_bytes* file, uint32_t crc, uint32_t size, uint32_t name) {
  threemf_number(file, 20, 2);
  threemf_number(file, 0, 4); /* flags, method */
  threemf_number(file, 0, 4); /* time, date */
  threemf_number(file, crc, 4);
  threemf_number(file, size, 4);
  threemf_number(file, size, 4);
  threemf_number(file, name, 2);
  threemf_number(file, 0, 2);
}

/* The archive whose part 3D/3dmodel.model is this text. */
static inline threemf_bytes threemf_of(const char* model) {
  const char name[] = "3D/3dmodel.model";
  const uint32_t size = (uint32_t)strlen(model), length = sizeof name - 1;
  threemf_bytes file = {NULL, 0};
  uint32_t crc = ~0u, directory;
  for (uint32_t i = 0; i < size; ++i) {
    crc ^= (unsigned char)model[i];
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0);
  }
  threemf_put(&file, "PK\3\4", 4);
  threemf_header(&file, ~crc, size, length);
  threemf_put(&file, name, length);
  threemf_put(&file, model, size);
  directory = (uint32_t)file.size;
  threemf_put(&file, "PK\1\2", 4);
  threemf_number(&file, 20, 2);
  threemf_header(&file, ~crc, size, length);
  threemf_number(&file, 0, 4);
  threemf_number(&file, 0, 2);
  threemf_number(&file, 0, 4);
  threemf_number(&file, 0, 4);
  threemf_put(&file, name, length);
  threemf_put(&file, "PK\5\6", 4);
  threemf_number(&file, 0, 4);
  threemf_number(&file, 1, 2);
  threemf_number(&file, 1, 2);
  threemf_number(&file, (uint32_t)file.size - 12 - directory, 4);
  threemf_number(&file, directory, 4);
  threemf_number(&file, 0, 2);
  return file;
}

#define THREEMF_HEAD                                                                \
  "<?xml version=\"1.0\"?><model unit=\"centimeter\" requiredextensions=\"b b2\" "  \
  "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\" "            \
  "xmlns:b=\"http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02\" "   \
  "xmlns:b2=\"http://schemas.microsoft.com/3dmanufacturing/beamlattice/balls/2020/" \
  "07\"><resources>"
/* A tetrahedron with corners at 0 and at 4 on each axis. */
#define THREEMF_TETRAHEDRON                                                       \
  "<vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"4\" y=\"0\" z=\"0\"/>"  \
  "<vertex x=\"0\" y=\"4\" z=\"0\"/><vertex x=\"0\" y=\"0\" z=\"4\"/></vertices>" \
  "<triangles><triangle v1=\"0\" v2=\"2\" v3=\"1\"/><triangle v1=\"0\" v2=\"1\" " \
  "v3=\"3\"/><triangle v1=\"1\" v2=\"2\" v3=\"3\"/><triangle v1=\"0\" v2=\"3\" "  \
  "v3=\"2\"/></triangles>"

/* In centimetres: a solid tetrahedron with three beams and a ball, which a second tetrahedron clips
 * to its inside; and beams that nothing clips, twice. */
#define THREEMF_BEAMS                                                             \
  THREEMF_HEAD                                                                    \
  "<object id=\"1\"><mesh>" THREEMF_TETRAHEDRON                                   \
  "</mesh></object>"                                                              \
  "<object id=\"2\"><mesh>" THREEMF_TETRAHEDRON                                   \
  "<b:beamlattice minlength=\"0.001\" radius=\"0.5\" cap=\"butt\" "               \
  "clippingmode=\"inside\" clippingmesh=\"1\" b2:ballmode=\"mixed\" "             \
  "b2:ballradius=\"0.75\"><b:beams>"                                              \
  "<b:beam v1=\"0\" v2=\"1\"/><b:beam v1=\"1\" v2=\"2\" r1=\"0.25\"/>"            \
  "<b:beam v1=\"2\" v2=\"3\" r1=\"0.25\" r2=\"0.125\" cap1=\"sphere\" "           \
  "cap2=\"hemisphere\"/></b:beams><b2:balls><b2:ball vindex=\"3\"/></b2:balls>"   \
  "</b:beamlattice></mesh></object>"                                              \
  "<object id=\"3\"><mesh><vertices><vertex x=\"9\" y=\"9\" z=\"9\"/>"            \
  "<vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"0\" z=\"0\"/></vertices>" \
  "<b:beamlattice minlength=\"0.001\" radius=\"0.25\"><b:beams>"                  \
  "<b:beam v1=\"1\" v2=\"2\"/></b:beams></b:beamlattice></mesh></object>"         \
  "</resources><build><item objectid=\"2\"/><item objectid=\"3\"/>"               \
  "<item objectid=\"3\" transform=\"0 2 0 -2 0 0 0 0 2 0 0 10\"/></build></model>"

#endif
