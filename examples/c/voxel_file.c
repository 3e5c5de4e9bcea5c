/* SPDX-License-Identifier: Apache-2.0 */
#include "voxel_file.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int refuse(voxel_file* file, const char* path, const char* format, ...) {
  const int used = snprintf(file->problem, sizeof file->problem, "%.300s: ", path);
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(file->problem + used, sizeof file->problem - (size_t)used, format, arguments);
  va_end(arguments);
  return -1;
}

/* 0 for types that are not read. */
static int32_t voxel_type(const char* name) {
  static const struct {
    const char* name;
    int32_t type;
  } types[] = {{"uchar", MSQ_UINT8},           {"unsigned char", MSQ_UINT8},
               {"uint8", MSQ_UINT8},           {"uint8_t", MSQ_UINT8},
               {"short", MSQ_INT16},           {"short int", MSQ_INT16},
               {"signed short", MSQ_INT16},    {"int16", MSQ_INT16},
               {"int16_t", MSQ_INT16},         {"ushort", MSQ_UINT16},
               {"unsigned short", MSQ_UINT16}, {"unsigned short int", MSQ_UINT16},
               {"uint16", MSQ_UINT16},         {"uint16_t", MSQ_UINT16},
               {"float", MSQ_FLOAT32},         {"double", MSQ_FLOAT64}};
  for (size_t i = 0; i < sizeof types / sizeof types[0]; ++i)
    if (strcmp(types[i].name, name) == 0) return types[i].type;
  return 0;
}

static size_t bytes_of(int32_t type) {
  return type == MSQ_UINT8 ? 1 : type == MSQ_FLOAT32 ? 4 : type == MSQ_FLOAT64 ? 8 : 2;
}

/* Reads the values from where the stream is, to its end. */
static int read_values(voxel_file* file, const char* path, FILE* stream, int is_big_endian) {
  const msq_image* image = &file->image;
  const size_t width = bytes_of(image->value_type);
  uint64_t count = 1;
  for (int axis = 0; axis < 3; ++axis) {
    if (image->size[axis] < 1 || image->size[axis] > UINT64_MAX / width / count)
      return refuse(file, path, "has %llu values along axis %d",
                    (unsigned long long)image->size[axis], axis);
    count *= image->size[axis];
  }
  if (count > SIZE_MAX / width || !(file->values = malloc((size_t)count * width)))
    return refuse(file, path, "has %llu values, too many for the memory",
                  (unsigned long long)count);
  const size_t got = fread(file->values, width, (size_t)count, stream);
  if (got != count)
    return refuse(file, path, "ends after %llu of %llu values", (unsigned long long)got,
                  (unsigned long long)count);
  if (fgetc(stream) != EOF)
    return refuse(file, path, "has more bytes than its %llu values", (unsigned long long)count);
  const union {
    uint16_t number;
    unsigned char first;
  } machine = {0x100};
  if (machine.first != is_big_endian) {
    unsigned char* at = file->values;
    for (uint64_t i = 0; i < count; ++i, at += width)
      for (size_t a = 0, b = width - 1; a < b; ++a, --b) {
        const unsigned char byte = at[a];
        at[a] = at[b];
        at[b] = byte;
      }
  }
  file->image.values = file->values;
  return 0;
}

int voxel_file_layout(voxel_file* file, const char* text) {
  char type[32], rest;
  unsigned long size[3];
  double mm;
  if (sscanf(text, "%31[^,],%lu,%lu,%lu,%lf%c", type, &size[0], &size[1], &size[2], &mm, &rest) !=
      5)
    return -1;
  file->image.value_type = voxel_type(type);
  for (int axis = 0; axis < 3; ++axis) {
    file->image.size[axis] = size[axis];
    file->image.grid.cell_size[axis] = mm;
  }
  return file->image.value_type ? 0 : -1;
}

int voxel_file_read_raw(voxel_file* file, const char* path) {
  FILE* stream = fopen(path, "rb");
  if (!stream) return refuse(file, path, "%s", strerror(errno));
  const int result = read_values(file, path, stream, 0);
  fclose(stream);
  return result;
}

/* What a header says, beside what goes into the image. */
typedef struct header {
  int dimension, is_big_endian, is_raw;
  long skip;
  char data[512]; /* the file that has the values; empty: this one */
} header;

/* Reads `count` numbers, with brackets and commas between them. Returns whether there are as many.
 */
static int read_numbers(const char* text, double* numbers, int count) {
  for (int i = 0; i < count; ++i) {
    char* end;
    while (*text && strchr(" (,)\t", *text)) ++text;
    numbers[i] = strtod(text, &end);
    if (end == text || !isfinite(numbers[i])) return 0;
    text = end;
  }
  while (*text && strchr(" )\t", *text)) ++text;
  return *text == '\0';
}

/* Takes a field of the header. Returns 0 or -1. */
static int take(voxel_file* file, const char* path, header* h, const char* name,
                const char* value) {
  msq_neighbourhood* grid = &file->image.grid;
  double numbers[9];
  if (strcmp(name, "dimension") == 0) {
    h->dimension = atoi(value);
    if (h->dimension != 3) return refuse(file, path, "dimension is %s; it must be 3", value);
  } else if (strcmp(name, "type") == 0) {
    file->image.value_type = voxel_type(value);
    if (!file->image.value_type)
      return refuse(file, path, "type is %s; uchar, short, ushort, float and double are read",
                    value);
  } else if (strcmp(name, "encoding") == 0) {
    h->is_raw = strcmp(value, "raw") == 0;
    if (!h->is_raw)
      return refuse(file, path, "encoding is %s; only raw is read (unu save -f nrrd -e raw)",
                    value);
  } else if (strcmp(name, "endian") == 0) {
    h->is_big_endian = strcmp(value, "big") == 0;
    if (!h->is_big_endian && strcmp(value, "little") != 0)
      return refuse(file, path, "endian is %s; it must be little or big", value);
  } else if (strcmp(name, "sizes") == 0) {
    if (!read_numbers(value, numbers, 3)) return refuse(file, path, "sizes are %s", value);
    for (int axis = 0; axis < 3; ++axis) {
      if (!(numbers[axis] >= 1 && numbers[axis] <= 1 << 20 &&
            numbers[axis] == floor(numbers[axis])))
        return refuse(file, path, "sizes are %s; each must be 1 to %d", value, 1 << 20);
      file->image.size[axis] = (uint64_t)numbers[axis];
    }
  } else if (strcmp(name, "spacings") == 0) {
    if (!read_numbers(value, grid->cell_size, 3))
      return refuse(file, path, "spacings are %s", value);
  } else if (strcmp(name, "space origin") == 0) {
    if (!read_numbers(value, grid->origin, 3))
      return refuse(file, path, "space origin is %s", value);
  } else if (strcmp(name, "space directions") == 0) {
    if (!read_numbers(value, numbers, 9))
      return refuse(file, path, "space directions are %s", value);
    for (int axis = 0; axis < 3; ++axis) {
      const double* v = numbers + 3 * axis;
      const double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
      grid->cell_size[axis] = length;
      for (int i = 0; i < 3; ++i) grid->rotation[3 * i + axis] = length > 0 ? v[i] / length : 0;
    }
  } else if (strcmp(name, "data file") == 0 || strcmp(name, "datafile") == 0) {
    if (strncmp(value, "LIST", 4) == 0 || strchr(value, '%'))
      return refuse(file, path, "data file is %s; values in one file are read", value);
    snprintf(h->data, sizeof h->data, "%s", value);
  } else if (strcmp(name, "byte skip") == 0 || strcmp(name, "byteskip") == 0) {
    h->skip = atol(value);
    if (h->skip < 0) return refuse(file, path, "byte skip is %s; it must be 0 or more", value);
  } else if ((strcmp(name, "line skip") == 0 || strcmp(name, "lineskip") == 0) &&
             atol(value) != 0) {
    return refuse(file, path, "line skip is %s; it must be 0", value);
  }
  return 0; /* others, such as content and kinds, say nothing about the values */
}

/* A line without its end. Returns 0 at the end of the file and for lines that are too long. */
static int read_line(FILE* stream, char* line, size_t room) {
  if (!fgets(line, (int)room, stream)) return 0;
  size_t length = strlen(line);
  if (length + 1 == room && line[length - 1] != '\n') return 0;
  while (length > 0 && strchr("\r\n \t", line[length - 1])) line[--length] = '\0';
  return 1;
}

static int read_header(voxel_file* file, const char* path, FILE* stream, header* h) {
  char line[1024];
  if (!read_line(stream, line, sizeof line) || strncmp(line, "NRRD000", 7) != 0)
    return refuse(file, path, "is no NRRD: it does not begin with NRRD000");
  int has_more; /* an attached header ends with an empty line, a detached one with the file */
  while ((has_more = read_line(stream, line, sizeof line)) && *line) {
    char* colon = strchr(line, ':');
    if (*line == '#') continue;
    if (!colon) return refuse(file, path, "has a line that is no field: %.80s", line);
    if (colon[1] == '=') continue; /* a key and its value */
    *colon = '\0';
    for (++colon; *colon == ' ';) ++colon;
    if (take(file, path, h, line, colon) != 0) return -1;
  }
  if (!has_more && !feof(stream)) return refuse(file, path, "has a line that is too long");
  const char* missing = !h->dimension             ? "dimension"
                        : !file->image.value_type ? "type"
                        : !file->image.size[0]    ? "sizes"
                        : !h->is_raw              ? "encoding"
                                                  : NULL;
  return missing ? refuse(file, path, "names no %s", missing) : 0;
}

int voxel_file_read_nrrd(voxel_file* file, const char* path) {
  header h = {0};
  FILE* stream = fopen(path, "rb");
  if (!stream) return refuse(file, path, "%s", strerror(errno));
  int result = read_header(file, path, stream, &h);
  if (result == 0 && *h.data) { /* beside the header, unless its path begins at the root */
    const char* slash = *h.data == '/' ? NULL : strrchr(path, '/');
    char data[4096];
    snprintf(data, sizeof data, "%.*s%s", slash ? (int)(slash - path) + 1 : 0, path, h.data);
    fclose(stream);
    stream = fopen(data, "rb");
    if (!stream) return refuse(file, data, "%s", strerror(errno));
    path = h.data;
  }
  if (result == 0 && fseek(stream, h.skip, SEEK_CUR) != 0)
    result = refuse(file, path, "cannot skip %ld bytes", h.skip);
  if (result == 0) result = read_values(file, path, stream, h.is_big_endian);
  fclose(stream);
  return result;
}

void voxel_file_free(voxel_file* file) {
  free(file->values);
  file->values = NULL;
}
