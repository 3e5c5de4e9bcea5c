/* SPDX-License-Identifier: Apache-2.0
 * Documents whose images are TIFF files: one file of several pages, several files, both byte
 * orders, what is refused by name, limits, damaged files. tests/command/test_tiff.py reads files of
 * other programs. */
#define _POSIX_C_SOURCE 200809L
#include "documents.h"
#include "folder.h"

static msq_context* context;

enum { WIDTH = 5, HEIGHT = 4, PAGES = 3, VALUES = WIDTH * HEIGHT * PAGES, MOST_BYTES = 4096 };

#define IMAGE(image)                                                             \
  "{\"msq_model\": 1, \"scales\": [{\"shape\": {\"voxels\": {\"image\": {" image \
  "}, \"threshold\": 9}}}]}"
#define ONE IMAGE("\"file\": \"a.tif\"")

/* A page as a test changes it. */
typedef struct page {
  unsigned width, height, bits, samples, compression, photometric, orientation, format;
  unsigned rows_per_strip; /* one strip, so the height or more */
} page;

static const page plain = {WIDTH, HEIGHT, 16, 1, 1, 1, 1, 1, HEIGHT};

typedef struct tiff {
  uint8_t bytes[MOST_BYTES];
  size_t size;
  int is_big;
  size_t link; /* where the place of the next page goes */
} tiff;

static void put(tiff* t, size_t at, unsigned value, int width) {
  assert_true(at + (size_t)width <= MOST_BYTES);
  for (int i = 0; i < width; ++i)
    t->bytes[at + (size_t)i] = (uint8_t)(value >> 8 * (t->is_big ? width - 1 - i : i));
  if (t->size < at + (size_t)width) t->size = at + (size_t)width;
}

static void begin(tiff* t, int is_big) {
  memset(t, 0, sizeof *t);
  t->is_big = is_big;
  memcpy(t->bytes, is_big ? "MM" : "II", 2);
  put(t, 2, 42, 2);
  put(t, 4, 0, 4);
  t->link = 4;
}

/* values: grey values, of which the low bits are written. */
static void add_page(tiff* t, const page* p, const uint16_t* values) {
  const size_t data = t->size, width = p->bits / 8 ? p->bits / 8 : 1;
  for (size_t i = 0; i < (size_t)p->width * p->height && p->width <= WIDTH; ++i)
    put(t, data + width * i, values[i], (int)width);
  t->size += t->size & 1;
  const size_t at = t->size;
  const struct {
    unsigned tag, type, value;
  } entries[] = {{256, 4, p->width},          {257, 4, p->height},
                 {258, 3, p->bits},           {259, 3, p->compression},
                 {262, 3, p->photometric},    {273, 4, (unsigned)data},
                 {274, 3, p->orientation},    {277, 3, p->samples},
                 {278, 4, p->rows_per_strip}, {279, 4, (unsigned)(at - data)},
                 {339, 3, p->format}};
  const unsigned count = sizeof entries / sizeof entries[0];
  put(t, t->link, (unsigned)at, 4);
  put(t, at, count, 2);
  for (unsigned i = 0; i < count; ++i) {
    const size_t entry = at + 2 + 12 * i;
    put(t, entry, entries[i].tag, 2);
    put(t, entry + 2, entries[i].type, 2);
    put(t, entry + 4, 1, 4);
    put(t, entry + 8, 0, 4);
    put(t, entry + 8, entries[i].value, entries[i].type == 3 ? 2 : 4);
  }
  t->link = at + 2 + 12 * count;
  put(t, t->link, 0, 4);
}

static void values_of(uint16_t* values) {
  for (int i = 0; i < VALUES; ++i) values[i] = (uint16_t)(i * 7 % 23);
}

static void write_stack(const char* name, const page* p, int is_big, int first, int pages) {
  uint16_t values[VALUES];
  tiff t;
  values_of(values);
  begin(&t, is_big);
  for (int k = first; k < first + pages; ++k) add_page(&t, p, values + WIDTH * HEIGHT * k);
  write_file(name, t.bytes, t.size);
}

/* The model that all of the files below hold. */
static msq_model* wanted_model(int32_t type) {
  uint16_t values[VALUES];
  uint8_t bytes[VALUES];
  msq_voxels_def def;
  msq_shape* shape;
  values_of(values);
  for (int i = 0; i < VALUES; ++i) bytes[i] = (uint8_t)values[i];
  assert_ok(msq_voxels_def_init(&def, sizeof def));
  def.image.values = type == MSQ_UINT8 ? (const void*)bytes : values;
  def.image.value_type = type;
  def.image.size[0] = WIDTH;
  def.image.size[1] = HEIGHT;
  def.image.size[2] = PAGES;
  def.threshold = 9;
  assert_ok(msq_shape_from_voxels(context, &def, &shape));
  return make_shape_model(context, shape);
}

static void assert_reads(const char* text, int32_t type) {
  msq_model* wanted = wanted_model(type);
  msq_model* model = model_of(read_document_in(context, text, folder));
  assert_same_model(model, wanted, text);
  assert_round_trip(context, model, folder);
  msq_model_release(model);
  msq_model_release(wanted);
}

static void pages_of_a_file(void** state) {
  (void)state;
  page p = plain;
  for (int is_big = 0; is_big < 2; ++is_big) {
    p.bits = 16, p.format = 1;
    write_stack("a.tif", &p, is_big, 0, PAGES);
    assert_reads(ONE, MSQ_UINT16);
    p.format = 2;
    write_stack("a.tif", &p, is_big, 0, PAGES);
    assert_reads(ONE, MSQ_INT16);
    p.bits = 8, p.format = 1;
    write_stack("a.tif", &p, is_big, 0, PAGES);
    assert_reads(ONE, MSQ_UINT8);
  }
  p.rows_per_strip = 0xffffffff; /* as many as there are */
  write_stack("a.tif", &p, 0, 0, PAGES);
  assert_reads(ONE, MSQ_UINT8);
}

static void files_are_one_above_the_other(void** state) {
  (void)state;
  write_stack("a.tif", &plain, 0, 0, 1);
  write_stack("b.TIFF", &plain, 1, 1, 2);
  assert_reads(IMAGE("\"files\": [\"a.tif\", \"b.TIFF\"]"), MSQ_UINT16);
  write_stack("a.tif", &plain, 0, 0, 2);
  write_stack("b.TIFF", &plain, 0, 2, 1);
  const char* text = IMAGE("\"files\": [\"a.tif\", \"b.TIFF\"]");
  assert_reads(text, MSQ_UINT16);
  msq_document* document = read_document_in(context, text, folder);
  msq_document_report report = {0};
  report.struct_size = sizeof report;
  assert_ok(msq_document_info(document, &report));
  assert_int_equal(report.files, 2);
  msq_json_def def;
  assert_ok(msq_json_def_init(&def, sizeof def));
  def.base_directory = folder;
  msq_model* model = model_of(document);
  char* json = json_of(model, &def);
  assert_non_null(strstr(json, "\"a.tif\""));
  assert_non_null(strstr(json, "\"b.TIFF\""));
  assert_null(strstr(json, "uint16"));
  free(json);
  msq_model_release(model);
}

static void assert_not_read(const char* text, uint64_t max_file_bytes, msq_status status,
                            const char* words) {
  msq_document_def def;
  msq_document* document = (msq_document*)untouched();
  assert_ok(msq_document_def_init(&def, sizeof def));
  def.base_directory = folder;
  if (max_file_bytes) def.max_file_bytes = max_file_bytes;
  assert_refused(msq_document_from_json(context, text, strlen(text), &def, &document, NULL), status,
                 words);
  assert_ptr_equal(document, untouched());
}

static void pages_are_refused_by_name(void** state) {
  (void)state;
  static const struct {
    page page;
    msq_status status;
    const char* words;
  } rows[] = {
      {{WIDTH, HEIGHT, 1, 1, 1, 1, 1, 1, HEIGHT}, MSQ_E_UNSUPPORTED, "page 1 has 1 bits"},
      {{WIDTH, HEIGHT, 12, 1, 1, 1, 1, 1, HEIGHT}, MSQ_E_UNSUPPORTED, "page 1 has 12 bits"},
      {{WIDTH, HEIGHT, 32, 1, 1, 1, 1, 3, HEIGHT}, MSQ_E_UNSUPPORTED, "page 1 has 32 bits"},
      {{WIDTH, HEIGHT, 8, 1, 1, 1, 1, 2, HEIGHT}, MSQ_E_UNSUPPORTED, "sample format 2 with 8"},
      {{WIDTH, HEIGHT, 8, 3, 1, 2, 1, 1, HEIGHT}, MSQ_E_UNSUPPORTED, "3 samples per pixel"},
      {{WIDTH, HEIGHT, 8, 1, 7, 1, 1, 1, HEIGHT}, MSQ_E_UNSUPPORTED, "compression 7"},
      {{WIDTH, HEIGHT, 8, 1, 1, 0, 1, 1, HEIGHT}, MSQ_E_UNSUPPORTED, "interpretation 0"},
      {{WIDTH, HEIGHT, 8, 1, 1, 1, 3, 1, HEIGHT}, MSQ_E_UNSUPPORTED, "orientation 3"},
      {{1 << 21, 2, 8, 1, 1, 1, 1, 1, 2}, MSQ_E_LIMIT, "2097152 x 2 pixels"},
      {{WIDTH, HEIGHT + 1, 8, 1, 1, 1, 1, 1, HEIGHT},
       MSQ_E_IO,
       "page 1 is damaged: strip 2 has no"},
  };
  uint16_t values[VALUES];
  tiff t;
  values_of(values);
  for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
    begin(&t, 0);
    add_page(&t, &rows[i].page, values);
    write_file("a.tif", t.bytes, t.size);
    assert_not_read(ONE, 0, rows[i].status, rows[i].words);
    assert_message_has("a.tif: page");
  }
  page smaller = plain;
  smaller.height = HEIGHT - 1;
  begin(&t, 0);
  add_page(&t, &plain, values);
  add_page(&t, &smaller, values);
  write_file("a.tif", t.bytes, t.size);
  assert_not_read(ONE, 0, MSQ_E_IO, "page 2 has 5 x 3 pixels of 2 bytes; the first has 5 x 4 of 2");
  smaller = plain;
  smaller.bits = 8;
  begin(&t, 0);
  add_page(&t, &smaller, values);
  write_file("b.tif", t.bytes, t.size);
  write_stack("a.tif", &plain, 0, 0, 2);
  assert_not_read(IMAGE("\"files\": [\"a.tif\", \"b.tif\"]"), 0, MSQ_E_IO,
                  "b.tif: page 1 has 5 x 4");
  /* The values go beyond the end of the file. */
  enum { ENTRIES = 11, STRIP_OFFSETS = 5 };
  begin(&t, 0);
  add_page(&t, &plain, values);
  put(&t, t.link - 12 * (ENTRIES - STRIP_OFFSETS) + 8, (unsigned)t.size - 39, 4);
  write_file("a.tif", t.bytes, t.size);
  assert_not_read(ONE, 0, MSQ_E_IO, "page 1 is damaged");
  /* The last page is followed by the first. */
  begin(&t, 0);
  add_page(&t, &plain, values);
  const size_t first = (size_t)t.bytes[4] | (size_t)t.bytes[5] << 8;
  add_page(&t, &plain, values);
  put(&t, t.link, (unsigned)first, 4);
  write_file("a.tif", t.bytes, t.size);
  assert_not_read(ONE, 0, MSQ_E_IO, "is damaged");
}

/* Of the last page: its entry for a tag becomes one for another, with a value. */
static void change_entry(tiff* t, unsigned tag, unsigned to, unsigned value) {
  for (size_t entry = t->link - 12; entry > 12; entry -= 12)
    if ((t->bytes[entry] | t->bytes[entry + 1] << 8) == (int)tag) {
      put(t, entry, to, 2);
      put(t, entry + 8, value, t->bytes[entry + 2] == 3 ? 2 : 4);
      return;
    }
  fail_msg("there is no entry %u", tag);
}

static void entries_are_needed(void** state) {
  (void)state;
  enum {
    PHOTOMETRIC = 262,
    THRESHOLDING,
    OFFSETS = 273,
    SAMPLES = 277,
    ROWS,
    COUNTS,
    PRIVATE = 65000
  };
  enum { TILE_WIDTH = 322, TILE_LENGTH, TILE_OFFSETS, TILE_COUNTS };
  uint16_t values[VALUES];
  tiff t;
  values_of(values);
  begin(&t, 0);
  add_page(&t, &plain, values);
  change_entry(&t, PHOTOMETRIC, THRESHOLDING, 1);
  write_file("a.tif", t.bytes, t.size);
  assert_not_read(ONE, 0, MSQ_E_IO, "page 1 has no photometric interpretation");
  begin(&t, 0);
  add_page(&t, &plain, values);
  change_entry(&t, 256, PRIVATE, WIDTH);
  write_file("a.tif", t.bytes, t.size);
  assert_not_read(ONE, 0, MSQ_E_IO, "a.tif: ");
  begin(&t, 0);
  add_page(&t, &plain, values);
  change_entry(&t, ROWS, ROWS, 0);
  write_file("a.tif", t.bytes, t.size);
  assert_not_read(ONE, 0, MSQ_E_IO, "a.tif: the file is no TIFF: Bad value 0 for \"RowsPerStrip\"");
  begin(&t, 0);
  add_page(&t, &plain, values);
  change_entry(&t, OFFSETS, TILE_OFFSETS, 8);
  change_entry(&t, SAMPLES, TILE_WIDTH, 16);
  change_entry(&t, ROWS, TILE_LENGTH, 16);
  change_entry(&t, COUNTS, TILE_COUNTS, 40);
  write_file("a.tif", t.bytes, t.size);
  assert_not_read(ONE, 0, MSQ_E_UNSUPPORTED, "page 1 is stored in tiles; strips are read");
}

static void keys_files_and_limits(void** state) {
  (void)state;
  write_stack("a.tif", &plain, 0, 0, PAGES);
  const char* both = IMAGE("\"files\": [\"a.tif\", \"a.tif\"]");
  assert_not_read(IMAGE("\"files\": []"), 0, MSQ_E_ARGUMENT, "image.files: is an empty list");
  assert_not_read(IMAGE("\"files\": [\"a.raw\"]"), 0, MSQ_E_ARGUMENT, "is no TIFF file");
  assert_not_read(IMAGE("\"files\": [\"../a.tif\"]"), 0, MSQ_E_ARGUMENT, "\"..\"");
  assert_not_read(IMAGE("\"files\": \"a.tif\", \"values\": [1]"), 0, MSQ_E_ARGUMENT,
                  "both files and values");
  assert_not_read(IMAGE("\"files\": [\"a.tif\"], \"file\": \"a.tif\""), 0, MSQ_E_ARGUMENT,
                  "both files and file");
  assert_not_read(IMAGE("\"file\": \"a.tif\", \"size\": [5, 4, 3]"), 0, MSQ_E_ARGUMENT,
                  "which the file says itself");
  assert_not_read(IMAGE("\"file\": \"none.tif\""), 0, MSQ_E_IO, "none.tif: ");
  /* Three pages of 40 bytes in a file, and their values, count. */
  msq_document_def def;
  msq_document* document;
  uint64_t size;
  FILE* file = fopen(path_of("a.tif"), "rb");
  assert_non_null(file);
  assert_int_equal(fseek(file, 0, SEEK_END), 0);
  size = (uint64_t)ftell(file);
  fclose(file);
  assert_not_read(ONE, size - 1, MSQ_E_LIMIT, "the limit is");
  assert_not_read(ONE, size + 119, MSQ_E_LIMIT,
                  "page 3 ends 120 bytes of values; the limit is 119");
  assert_not_read(both, 2 * size + 239, MSQ_E_LIMIT, "ends 240 bytes of values; the limit is 239");
  assert_ok(msq_document_def_init(&def, sizeof def));
  def.base_directory = folder;
  def.max_file_bytes = 2 * size + 240;
  assert_ok(msq_document_from_json(context, both, strlen(both), &def, &document, NULL));
  msq_document_release(document);
  msq_job* job;
  assert_ok(msq_job_create(&job));
  assert_ok(msq_job_cancel(job));
  document = (msq_document*)untouched();
  assert_refused(msq_document_from_json(context, both, strlen(both), &def, &document, job),
                 MSQ_E_CANCELLED, "cancelled");
  msq_job_release(job);
}

/* A file with bytes changed or cut off is read or refused, whatever it has become. */
static void damaged_files_do_no_harm(void** state) {
  (void)state;
  uint16_t values[VALUES];
  tiff t;
  uint64_t seed = 5;
  int read = 0, refused = 0;
  const int rounds = 40 + (int)(1500 * test_scale());
  values_of(values);
  begin(&t, 0);
  for (int k = 0; k < PAGES; ++k) add_page(&t, &plain, values + WIDTH * HEIGHT * k);
  msq_document_def def;
  assert_ok(msq_document_def_init(&def, sizeof def));
  def.base_directory = folder;
  def.max_file_bytes = 1 << 20;
  for (int round = 0; round < rounds; ++round) {
    tiff changed = t;
    for (int change = 0; change <= round % 3; ++change)
      changed.bytes[(size_t)random_between(&seed, 0, (double)t.size)] =
          (uint8_t)random_between(&seed, 0, 256);
    if (round % 4 == 0) changed.size = (size_t)random_between(&seed, 0, (double)t.size);
    write_file("a.tif", changed.bytes, changed.size);
    msq_document* document = (msq_document*)untouched();
    const msq_status status =
        msq_document_from_json(context, ONE, strlen(ONE), &def, &document, NULL);
    if (status == MSQ_OK) {
      ++read;
      msq_document_release(document);
      continue;
    }
    ++refused;
    assert_true(status == MSQ_E_IO || status == MSQ_E_LIMIT || status == MSQ_E_UNSUPPORTED ||
                status == MSQ_E_ARGUMENT);
    assert_ptr_equal(document, untouched());
  }
  assert_true(read > 0 && refused > 0);
}

static void builds_without_libtiff_say_so(void** state) {
  (void)state;
  write_stack("a.tif", &plain, 0, 0, PAGES);
  assert_not_read(ONE, 0, MSQ_E_UNSUPPORTED, "does not read TIFF (MSQ_WITH_TIFF is off)");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(pages_of_a_file),           cmocka_unit_test(files_are_one_above_the_other),
      cmocka_unit_test(pages_are_refused_by_name), cmocka_unit_test(entries_are_needed),
      cmocka_unit_test(keys_files_and_limits),     cmocka_unit_test(damaged_files_do_no_harm),
  };
  const struct CMUnitTest without[] = {cmocka_unit_test(builds_without_libtiff_say_so)};
  if (!MSQ_WITH_JSON) return 0; /* test_refusals_documents.c */
  if (make_folder() != 0) return 1;
  context = make_context();
  const int failed = MSQ_WITH_TIFF ? cmocka_run_group_tests(tests, NULL, NULL)
                                   : cmocka_run_group_tests(without, NULL, NULL);
  static const char* const names[] = {"a.tif", "b.tif", "b.TIFF"};
  for (size_t i = 0; i < sizeof names / sizeof names[0]; ++i) remove(path_of(names[i]));
  rmdir(folder);
  msq_context_release(context);
  return failed;
}
