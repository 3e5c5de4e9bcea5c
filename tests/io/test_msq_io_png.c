/* SPDX-License-Identifier: Apache-2.0
 * Stacks of PNG files and single pictures, read back by programs of others. */
#define _DEFAULT_SOURCE
#include "decoders.h"
#include "io_test.h"

static msq_context* context;
static msq_model* model;

static int begin_tests(void** state) {
  context = make_context();
  model = make_lattice_model(context);
  return make_folder(state);
}
static int end_tests(void** state) {
  msq_model_release(model);
  msq_context_release(context);
  return end_folder(state);
}

static void check_layer(const char* path, const msq_layer* layer) {
  size_t size;
  uint8_t* bytes = read_file(path, &size);
  for (size_t k = 0; k < decoder_count; ++k) {
    decoded image = {0};
    if (decoders[k].decode(bytes, size, &image) != 0)
      fail_msg("%s does not read %s", decoders[k].name, path);
    assert_int_equal(image.width, layer->width);
    assert_int_equal(image.height, layer->height);
    assert_int_equal(image.channels, 1);
    assert_int_equal(image.depth, layer->output == MSQ_LAYER_BITS ? 1 : 8);
    for (uint32_t y = 0; y < layer->height; ++y)
      for (uint32_t x = 0; x < layer->width; ++x) {
        const uint8_t* row = layer->data + y * layer->stride;
        const int wanted =
            layer->output == MSQ_LAYER_BITS ? (row[x / 8] >> (7 - x % 8) & 1) * 255 : row[x];
        const int got = image.pixels[(size_t)y * layer->width + x];
        if (got != wanted)
          fail_msg("%s: pixel %u, %u of %s is %d, not %d", decoders[k].name, x, y, path, got,
                   wanted);
      }
    free(image.pixels);
  }
  free(bytes);
}

typedef struct comparison {
  const char* folder;
  uint64_t inside;
} comparison;

static int32_t compare(void* user, const msq_layer* layer) {
  comparison* with = (comparison*)user;
  char path[256];
  snprintf(path, sizeof path, "%s/layer%05d.png", with->folder, (int)layer->index);
  check_layer(path, layer);
  with->inside += layer->inside_count;
  return 0;
}

static msq_io_writer* begin(const msq_slicer* slicer, const char* path, int32_t level,
                            uint32_t threads) {
  msq_io_writer_def writer_def;
  msq_io_png_def def;
  msq_io_writer* writer;
  assert_ok(msq_io_writer_def_init(&writer_def, sizeof writer_def));
  writer_def.threads = threads;
  writer_def.queue_bytes = 4000; /* one layer or a few */
  assert_ok(msq_io_png_def_init(&def, sizeof def));
  def.level = level;
  assert_ok(msq_io_png_create(slicer, path, &writer_def, &def, &writer));
  return writer;
}

static void reads_back(void** state) {
  (void)state;
  const int32_t levels[] = {0, 1, 6};
  for (int32_t output = MSQ_LAYER_BITS; output <= MSQ_LAYER_GREY; ++output)
    for (int i = 0; i < 3; ++i) {
      msq_slicer* slicer = make_slicer_of(model, output);
      comparison with = {in_folder("stack"), 0};
      msq_io_writer* writer = begin(slicer, with.folder, levels[i], 2);
      msq_io_writer_report report = {.struct_size = sizeof report};
      assert_int_equal(count_files(folder), 1); /* under a temporary name */
      assert_int_equal(count_files(with.folder), -1);
      assert_ok(msq_slicer_run(slicer, 0, UINT64_MAX, msq_io_writer_layer, writer, NULL));
      assert_ok(msq_io_writer_finish(writer));
      assert_ok(msq_io_writer_finish(writer));
      assert_ok(msq_io_writer_info(writer, &report));
      assert_int_equal(report.layer_count, 12);
      assert_int_equal(report.written_count, 12);
      assert_in_range(report.bytes, 12 * 60, 12 * 4000);
      assert_in_range(report.peak_queue_bytes, 1, 5000);
      msq_io_writer_release(writer);
      assert_int_equal(count_files(folder), 1);
      assert_int_equal(count_files(with.folder), 12);
      assert_ok(msq_slicer_run(slicer, 0, UINT64_MAX, compare, &with, NULL));
      assert_in_range(with.inside, 1000, 1000000);
      msq_slicer_release(slicer);
      remove_folder(with.folder);
    }
}

/* The same files by any number of threads. */
static void threads(void** state) {
  (void)state;
  msq_slicer* slicer = make_slicer_of(model, MSQ_LAYER_GREY);
  const char *one = in_folder("one"), *other = in_folder("other");
  write_all(slicer, begin(slicer, one, 0, 1));
  write_all(slicer, begin(slicer, other, 0, 5));
  for (int i = 0; i < 12; ++i) {
    char paths[2][256];
    snprintf(paths[0], sizeof paths[0], "%s/layer%05d.png", one, i);
    snprintf(paths[1], sizeof paths[1], "%s/layer%05d.png", other, i);
    assert_same_files(paths[0], paths[1]);
  }
  remove_folder(one);
  remove_folder(other);
  msq_slicer_release(slicer);
}

/* Parts of a stack by different writers, into one folder that exists. */
static void parts(void** state) {
  (void)state;
  msq_slicer* slicer = make_slicer_of(model, MSQ_LAYER_BITS);
  const char *whole = in_folder("whole"), *joined = in_folder("joined");
  write_all(slicer, begin(slicer, whole, 1, 2));
  msq_io_png_def def;
  assert_ok(msq_io_png_def_init(&def, sizeof def));
  def.level = 1;
  for (uint64_t first = 0; first < 12; first += 5) {
    msq_io_writer_def writer_def;
    msq_io_writer* writer;
    assert_ok(msq_io_writer_def_init(&writer_def, sizeof writer_def));
    writer_def.first_layer = first;
    writer_def.layer_count = first + 5 < 12 ? 5 : UINT64_MAX;
    assert_ok(msq_io_png_create(slicer, joined, &writer_def, &def, &writer));
    assert_ok(
        msq_slicer_run(slicer, first, writer_def.layer_count, msq_io_writer_layer, writer, NULL));
    assert_ok(msq_io_writer_finish(writer));
    msq_io_writer_release(writer);
  }
  assert_int_equal(count_files(joined), 12);
  assert_same_files(in_folder("whole/layer00011.png"), in_folder("joined/layer00011.png"));
  assert_same_files(in_folder("whole/layer00004.png"), in_folder("joined/layer00004.png"));

  /* Files that exist are refused, or replaced. */
  msq_io_writer_def writer_def;
  msq_io_writer* writer = NULL;
  assert_ok(msq_io_writer_def_init(&writer_def, sizeof writer_def));
  assert_refused(msq_io_png_create(slicer, joined, &writer_def, NULL, &writer), MSQ_E_IO,
                 "layer00000.png");
  assert_message_has("replace is 0");
  assert_null(writer);
  writer_def.replace = 1;
  assert_ok(msq_io_png_create(slicer, joined, &writer_def, NULL, &writer));
  write_all(slicer, writer);
  assert_int_equal(count_files(joined), 12);

  /* Other names. */
  def.digits = 2;
  def.prefix = "page-";
  assert_ok(msq_io_png_create(slicer, joined, &writer_def, &def, &writer));
  write_all(slicer, writer);
  assert_int_equal(count_files(joined), 24);
  assert_same_files(in_folder("whole/layer00011.png"), in_folder("joined/page-11.png"));
  remove_folder(whole);
  remove_folder(joined);
  msq_slicer_release(slicer);
}

static void pictures(void** state) {
  (void)state;
  uint8_t pixels[5 * 20];
  for (size_t i = 0; i < sizeof pixels; ++i) pixels[i] = (uint8_t)(i * 37);
  for (uint32_t channels = 1; channels <= 4; ++channels) {
    const char* path = in_folder("picture.png");
    if (channels == 2) continue;
    assert_ok(msq_io_picture_save(path, 4, 5, channels, pixels, 20, 0));
    size_t size;
    uint8_t* bytes = read_file(path, &size);
    for (size_t k = 0; k < decoder_count; ++k) {
      decoded image = {0};
      assert_int_equal(decoders[k].decode(bytes, size, &image), 0);
      assert_int_equal(image.channels, channels);
      assert_int_equal(image.width, 4);
      assert_int_equal(image.height, 5);
      for (size_t y = 0; y < 5; ++y)
        assert_memory_equal(image.pixels + y * 4 * channels, pixels + y * 20, 4 * channels);
      free(image.pixels);
    }
    free(bytes);
    assert_refused(msq_io_picture_save(path, 4, 5, channels, pixels, 20, 0), MSQ_E_IO, "exists");
    remove(path);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(reads_back), cmocka_unit_test(threads),
                                     cmocka_unit_test(parts), cmocka_unit_test(pictures)};
  return cmocka_run_group_tests(tests, begin_tests, end_tests);
}
