/* SPDX-License-Identifier: Apache-2.0 */
/* Runs the vectors through msq.h: see protocol.py. usage: vectors MODEL POINTS ... */
#include <inttypes.h>
#include <msq.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void must(msq_status status) {
  if (status == MSQ_OK) return;
  fprintf(stderr, "%s: %s\n", msq_status_name(status), msq_error_message());
  exit(1);
}

/* The bytes of a file, for the caller to free. */
static char* read_file(const char* path, size_t* size) {
  FILE* const file = fopen(path, "rb");
  char* bytes = NULL;
  size_t room = 0;
  *size = 0;
  if (file == NULL) exit(2);
  do {
    room = 2 * room + 4096;
    bytes = realloc(bytes, room);
    if (bytes == NULL) exit(2);
    *size += fread(bytes + *size, 1, room - *size, file);
  } while (*size == room);
  if (ferror(file) || fclose(file) != 0) exit(2);
  return bytes;
}

static void print_bits(double value) {
  uint64_t bits;
  memcpy(&bits, &value, sizeof bits);
  printf(" %016" PRIx64, bits);
}

static void print_bytes(const uint8_t* bytes, uint64_t count) {
  putchar(' ');
  for (uint64_t i = 0; i < count; ++i) printf("%02x", bytes[i]);
}

static int32_t print_layer(void* user, const msq_layer* layer) {
  (void)user;
  printf("layer %" PRIu64, layer->index);
  print_bits(layer->z);
  print_bytes(layer->data, layer->stride * layer->height);
  putchar('\n');
  return 0;
}

static void print_points(const msq_model* model, const char* path) {
  size_t size;
  char* const coordinates = read_file(path, &size);
  const uint64_t count = size / (3 * sizeof(double));
  uint8_t* const inside = malloc(count);
  double* const distances = malloc(count * sizeof(double));
  if (inside == NULL || distances == NULL) exit(2);
  msq_points_def def;
  must(msq_points_def_init(&def, sizeof def));
  def.kind = MSQ_POINTS_ARRAY;
  def.coordinates = coordinates;
  def.count = count;
  must(msq_set_membership(model, &def, NULL, inside, count, NULL));
  must(msq_set_distance(model, &def, NULL, distances, count, NULL));
  printf("inside ");
  for (uint64_t i = 0; i < count; ++i) putchar(inside[i] ? '1' : '0');
  printf("\ndistance");
  for (uint64_t i = 0; i < count; ++i) print_bits(distances[i]);
  putchar('\n');
  free(distances);
  free(inside);
  free(coordinates);
}

static void print_model(const msq_document* document, const char* points) {
  msq_document_report about = {0};
  about.struct_size = sizeof about;
  must(msq_document_info(document, &about));
  printf("title %s\n", about.title);
  msq_model* model;
  must(msq_document_model(document, &model));
  uint8_t hash[16];
  const msq_status hashed = msq_model_hash(model, hash);
  printf("hash");
  if (hashed == MSQ_E_UNSUPPORTED) {
    printf(" -");
  } else {
    must(hashed);
    print_bytes(hash, sizeof hash);
  }
  putchar('\n');
  print_points(model, points);

  msq_slicer_def def;
  must(msq_slicer_def_init(&def, sizeof def));
  must(msq_document_slicing(document, &def));
  msq_slicer* slicer;
  must(msq_slicer_create(model, &def, &slicer));
  msq_slicer_report plan = {0};
  plan.struct_size = sizeof plan;
  must(msq_slicer_info(slicer, &plan));
  printf("plan %" PRIu32 " %" PRIu32 " %" PRIu64 "\n", plan.width, plan.height, plan.layer_count);
  must(msq_slicer_run(slicer, 0, plan.layer_count, print_layer, NULL, NULL));
  msq_slicer_release(slicer);
  msq_model_release(model);
}

int main(int count, char** arguments) {
  msq_context* context;
  must(msq_context_create(NULL, &context));
  for (int i = 1; i + 1 < count; i += 2) {
    size_t size;
    char* const text = read_file(arguments[i], &size);
    msq_document* document;
    puts("case");
    const msq_status status = msq_document_from_json(context, text, size, NULL, &document, NULL);
    if (status == MSQ_OK) {
      print_model(document, arguments[i + 1]);
      msq_document_release(document);
    } else {
      printf("refused %s: %s\n", msq_status_name(status), msq_error_message());
    }
    free(text);
  }
  msq_context_release(context);
  return 0;
}
