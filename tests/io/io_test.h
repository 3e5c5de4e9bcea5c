/* SPDX-License-Identifier: Apache-2.0
 * What the tests of msq_io share: a model, its slicers, a folder that is empty at the end. Messages
 * are those of msq_io. */
#ifndef IO_TEST_H
#define IO_TEST_H

#include <dirent.h>
#include <sys/stat.h>
#include <unistd.h>

#include "msq_io.h"
/* The checks of tests/api read the message of the library under test. */
#define msq_error_message msq_io_error_message
#include "wrong_values.h"

/* ---- files ------------------------------------------------------------------------------------
 */

static char folder[64]; /* of this test program, without anything in it between tests */

static inline const char* in_folder(const char* name) {
  static char paths[8][128];
  static int last;
  last = (last + 1) % 8;
  snprintf(paths[last], sizeof paths[last], "%s/%s", folder, name);
  return paths[last];
}

/* Number of files and folders, those with temporary names included. */
static inline int count_files(const char* path) {
  DIR* open = opendir(path);
  int count = 0;
  if (!open) return -1;
  for (struct dirent* entry; (entry = readdir(open)) != NULL;)
    count += strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0;
  closedir(open);
  return count;
}

/* The bytes of a file, to be freed. */
static inline uint8_t* read_file(const char* path, size_t* size) {
  FILE* file = fopen(path, "rb");
  if (!file) fail_msg("no file %s", path);
  fseek(file, 0, SEEK_END);
  const long length = ftell(file);
  rewind(file);
  uint8_t* bytes = (uint8_t*)malloc((size_t)length + 1);
  assert_int_equal(fread(bytes, 1, (size_t)length, file), length);
  fclose(file);
  *size = (size_t)length;
  return bytes;
}

static inline void assert_file_is(const char* path, const char* text) {
  size_t size;
  uint8_t* bytes = read_file(path, &size);
  if (size != strlen(text) || memcmp(bytes, text, size) != 0)
    fail_msg("%s holds %zu other bytes", path, size);
  free(bytes);
}

static inline void assert_same_files(const char* one, const char* other) {
  size_t sizes[2];
  uint8_t* bytes[2] = {read_file(one, &sizes[0]), read_file(other, &sizes[1])};
  if (sizes[0] != sizes[1] || memcmp(bytes[0], bytes[1], sizes[0]) != 0)
    fail_msg("%s and %s differ", one, other);
  free(bytes[0]);
  free(bytes[1]);
}

/* Removes a folder of files. */
static inline void remove_folder(const char* path) {
  DIR* open = opendir(path);
  if (!open) return;
  for (struct dirent* entry; (entry = readdir(open)) != NULL;) {
    char name[512];
    snprintf(name, sizeof name, "%s/%s", path, entry->d_name);
    if (strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0) remove(name);
  }
  closedir(open);
  rmdir(path);
}

static inline int make_folder(void** state) {
  (void)state;
  snprintf(folder, sizeof folder, "io_test.XXXXXX");
  return mkdtemp(folder) == NULL;
}

/* Fails where a test left something. */
static inline int end_folder(void** state) {
  (void)state;
  if (rmdir(folder) == 0) return 0;
  print_error("%d files are left in %s\n", count_files(folder), folder);
  return 1;
}

/* ---- slicers ----------------------------------------------------------------------------------
 */

/* Of 53 x 41 pixels, an odd number, and 12 layers, with one output. */
static inline msq_slicer* make_slicer_of(const msq_model* model, int32_t output) {
  msq_slicer_def def;
  msq_slicer* slicer;
  assert_ok(msq_slicer_def_init(&def, sizeof def));
  def.output = output;
  def.resolution[0] = 53;
  def.resolution[1] = 41;
  def.layer_height = 0.25;
  def.layer_count = 12;
  assert_ok(msq_slicer_create(model, &def, &slicer));
  return slicer;
}

/* Runs all layers into a writer and completes it. */
static inline void write_all(const msq_slicer* slicer, msq_io_writer* writer) {
  assert_ok(msq_slicer_run(slicer, 0, UINT64_MAX, msq_io_writer_layer, writer, NULL));
  assert_ok(msq_io_writer_finish(writer));
  msq_io_writer_release(writer);
}

#endif
