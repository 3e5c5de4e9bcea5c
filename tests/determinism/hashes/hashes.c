/* SPDX-License-Identifier: Apache-2.0 */
/* Prints, for each model, hashes of its layers, of membership and distance at points, of the hits
 * and the normals of rays, and of its definition (msq_model_hash). They are equal on every machine.
 * With a file, compares with its lines instead. usage: hashes [FILE] Where results are meant to
 * change, the output without a file becomes hashes.txt. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "models.h"
#include "parts.h"

enum { point_count = 3000, ray_count = 800, columns = 6 };
static const char* const column_names[columns] = {"layers", "membership", "distance",
                                                  "hits",   "normals",    "definition"};

/* FNV-1a: Fowler, Noll and Vo, 1991. */
static const uint64_t hash_start = 0xcbf29ce484222325;
static uint64_t hash(uint64_t so_far, const void* bytes, size_t count) {
  const unsigned char* b = bytes;
  for (size_t i = 0; i < count; ++i) so_far = (so_far ^ b[i]) * 0x100000001b3;
  return so_far;
}

static int32_t add_layer(void* user, const msq_layer* layer) {
  uint64_t* const so_far = user;
  for (uint32_t row = 0; row < layer->height; ++row)
    *so_far = hash(*so_far, layer->data + row * layer->stride, (layer->width + 7) / 8);
  return 0;
}

static uint64_t hash_of_layers(const msq_model* model) {
  msq_slicer_def def;
  must(msq_slicer_def_init(&def, sizeof def));
  def.output = MSQ_LAYER_BITS;
  def.resolution[0] = def.resolution[1] = 90;
  def.layer_count = 40;
  def.layer_height = 0.5;
  def.has_region = 1;
  for (int axis = 0; axis < 3; ++axis) def.region_max[axis] = 20;
  msq_slicer* slicer;
  must(msq_slicer_create(model, &def, &slicer));
  uint64_t so_far = hash_start;
  must(msq_slicer_run(slicer, 0, UINT64_MAX, add_layer, &so_far, NULL));
  msq_slicer_release(slicer);
  return so_far;
}

/* Multiples of 2^-32, so that every machine rounds them alike. Marsaglia, "Xorshift RNGs", 2003. */
static double next_random(uint64_t* state) {
  *state ^= *state << 13;
  *state ^= *state >> 7;
  *state ^= *state << 17;
  return (double)(*state >> 32) / 4294967296.0;
}

static void hash_points(const msq_model* model, uint64_t* membership, uint64_t* distance) {
  static double points[point_count][3], distances[point_count];
  static uint8_t inside[point_count];
  uint64_t random = 88172645463325252u;
  for (int i = 0; i < point_count; ++i)
    for (int axis = 0; axis < 3; ++axis) points[i][axis] = 22 * next_random(&random) - 1;
  msq_points_def def;
  must(msq_points_def_init(&def, sizeof def));
  def.kind = MSQ_POINTS_ARRAY;
  def.coordinates = points;
  def.count = point_count;
  must(msq_set_membership(model, &def, NULL, inside, point_count, NULL));
  *membership = hash(hash_start, inside, sizeof inside);
  must(msq_set_distance(model, &def, NULL, distances, point_count, NULL));
  *distance = hash(hash_start, distances, sizeof distances);
}

static void hash_rays(const msq_model* model, uint64_t* places, uint64_t* normals) {
  static double from[ray_count][3], along[ray_count][3];
  static msq_ray_hit hits[ray_count];
  uint64_t random = 2463534242u;
  for (int i = 0; i < ray_count; ++i)
    for (int axis = 0; axis < 3; ++axis) {
      from[i][axis] = 60 * next_random(&random) - 20;
      along[i][axis] = 20 * next_random(&random) - from[i][axis];
    }
  msq_rays_def def;
  must(msq_rays_def_init(&def, sizeof def));
  def.count = ray_count;
  def.origins = from;
  def.directions = along;
  must(msq_ray_cast(model, &def, NULL, hits, ray_count, NULL));
  *places = *normals = hash_start;
  for (int i = 0; i < ray_count; ++i) {
    *places = hash(*places, &hits[i].t, sizeof hits[i].t);
    *places = hash(*places, &hits[i].scale, sizeof hits[i].scale);
    *places = hash(*places, hits[i].cell, sizeof hits[i].cell);
    *normals = hash(*normals, hits[i].normal, sizeof hits[i].normal);
  }
}

/* The first half. A build without xxHash has none: 0. */
static uint64_t hash_of_definition(const msq_model* model) {
  uint8_t bytes[16];
  uint64_t first = 0;
  const msq_status status = msq_model_hash(model, bytes);
  if (status == MSQ_E_UNSUPPORTED) return 0;
  must(status);
  for (int i = 0; i < 8; ++i) first = first << 8 | bytes[i];
  return first;
}

static void hash_model(const msq_model* model, uint64_t values[columns]) {
  values[0] = hash_of_layers(model);
  hash_points(model, &values[1], &values[2]);
  hash_rays(model, &values[3], &values[4]);
  values[5] = hash_of_definition(model);
}

/* Returns the number of values that differ from the next line of the file. */
static int compare(FILE* file, const char* name, const uint64_t values[columns]) {
  char line[200] = "", word[100] = "";
  int used = 0, different = 0;
  do {
    if (!fgets(line, sizeof line, file)) line[0] = '\0';
  } while (line[0] == '#');
  if (sscanf(line, "%99s%n", word, &used) != 1 || strcmp(word, name) != 0) {
    fprintf(stderr, "%s: the line of the file is \"%s\"\n", name, word);
    return 1;
  }
  char* rest = line + used;
  for (int c = 0; c < columns; ++c) {
    const unsigned long long expected = strtoull(rest, &rest, 16);
    if (expected == values[c] || (c == 5 && values[c] == 0)) continue;
    fprintf(stderr, "%s: the hash of %s is %016llx; the file says %016llx\n", name, column_names[c],
            (unsigned long long)values[c], expected);
    ++different;
  }
  return different;
}

int main(int argc, char** argv) {
  FILE* const file = argc > 1 ? fopen(argv[1], "r") : NULL;
  if (argc > 1 && !file) return perror(argv[1]), 2;
  if (!file)
    printf("# model %s %s %s %s %s %s\n", column_names[0], column_names[1], column_names[2],
           column_names[3], column_names[4], column_names[5]);
  msq_context* context;
  must(msq_context_create(NULL, &context));
  int different = 0;
  for (int i = 0; i < model_count; ++i) {
    msq_model* const model = make_model(context, i);
    uint64_t values[columns];
    hash_model(model, values);
    msq_model_release(model);
    if (file) {
      different += compare(file, model_name(i), values);
      continue;
    }
    printf("%s", model_name(i));
    for (int c = 0; c < columns; ++c) printf(" %016llx", (unsigned long long)values[c]);
    putchar('\n');
  }
  msq_context_release(context);
  if (file) {
    fclose(file);
    printf("%d of %d hashes differ\n", different, model_count * columns);
  }
  return different > 0;
}
