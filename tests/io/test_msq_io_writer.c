/* SPDX-License-Identifier: Apache-2.0
 * What writers of all formats do: order, failures, cancellation, several at once, reports. */
#define _DEFAULT_SOURCE
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

static msq_io_writer* begin(const msq_slicer* slicer, const char* path) {
  msq_io_writer* writer;
  assert_ok(msq_io_png_create(slicer, path, NULL, NULL, &writer));
  return writer;
}

static void cancelled(void** state) {
  (void)state;
  msq_slicer* slicer = make_slicer_of(model, MSQ_LAYER_BITS);
  msq_job* job;
  assert_ok(msq_job_create(&job));
  assert_ok(msq_job_cancel(job));
  msq_io_writer* writer = begin(slicer, in_folder("stack"));
  assert_int_equal(msq_slicer_run(slicer, 0, UINT64_MAX, msq_io_writer_layer, writer, job),
                   MSQ_E_CANCELLED);
  msq_io_writer_release(writer);
  assert_int_equal(count_files(folder), 0);
  msq_job_release(job);
  msq_slicer_release(slicer);
}

/* Some layers, then a failure, which stays. */
static void incomplete(void** state) {
  (void)state;
  msq_slicer* slicer = make_slicer_of(model, MSQ_LAYER_BITS);
  msq_io_writer* writer = begin(slicer, in_folder("stack"));
  assert_ok(msq_slicer_run(slicer, 0, 7, msq_io_writer_layer, writer, NULL));
  assert_refused(msq_io_writer_finish(writer), MSQ_E_ARGUMENT, "7 layers came; 12 from layer 0 on");
  assert_int_equal(count_files(folder), 0);
  assert_refused(msq_io_writer_finish(writer), MSQ_E_ARGUMENT, "7 layers came");
  msq_io_writer_report report = {.struct_size = sizeof report};
  assert_ok(msq_io_writer_info(writer, &report));
  assert_int_equal(report.layer_count, 7);
  msq_io_writer_release(writer);

  writer = begin(slicer, in_folder("stack"));
  assert_int_equal(msq_slicer_run(slicer, 3, 7, msq_io_writer_layer, writer, NULL), MSQ_E_HOST);
  assert_int_equal(msq_error_host_code(), MSQ_E_ARGUMENT);
  assert_message_has("layer 3 comes in place of layer 0");
  assert_refused(msq_io_writer_finish(writer), MSQ_E_ARGUMENT, "layer 3 comes");
  assert_int_equal(count_files(folder), 0);
  msq_io_writer_release(writer);

  writer = begin(slicer, in_folder("stack"));
  assert_ok(msq_slicer_run(slicer, 0, 12, msq_io_writer_layer, writer, NULL));
  assert_int_equal(msq_slicer_run(slicer, 0, 12, msq_io_writer_layer, writer, NULL), MSQ_E_HOST);
  assert_message_has("all 12 layers have come");
  msq_io_writer_release(writer);
  assert_int_equal(count_files(folder), 0);
  msq_slicer_release(slicer);
}

static void finished(void** state) {
  (void)state;
  msq_slicer* slicer = make_slicer_of(model, MSQ_LAYER_BITS);
  msq_io_writer* writer = begin(slicer, in_folder("stack"));
  assert_ok(msq_slicer_run(slicer, 0, 12, msq_io_writer_layer, writer, NULL));
  assert_ok(msq_io_writer_finish(writer));
  assert_int_equal(msq_slicer_run(slicer, 0, 1, msq_io_writer_layer, writer, NULL), MSQ_E_HOST);
  assert_message_has("after msq_io_writer_finish");
  assert_ok(msq_io_writer_finish(writer));
  msq_io_writer_release(writer);
  assert_int_equal(count_files(in_folder("stack")), 12);
  remove_folder(in_folder("stack"));
  msq_slicer_release(slicer);
}

/* Layers of another slicer, and outputs that the format has no use for. */
static void other_layers(void** state) {
  (void)state;
  msq_slicer* slicer = make_slicer_of(model, MSQ_LAYER_BITS);
  msq_slicer* distances = make_slicer_of(model, MSQ_LAYER_DISTANCE);
  msq_slicer_def def;
  msq_slicer* wide;
  assert_ok(msq_slicer_def_init(&def, sizeof def));
  def.resolution[0] = 54;
  def.resolution[1] = 41;
  def.layer_height = 0.25;
  assert_ok(msq_slicer_create(model, &def, &wide));

  msq_io_writer* writer = begin(slicer, in_folder("stack"));
  assert_int_equal(msq_slicer_run(wide, 0, 1, msq_io_writer_layer, writer, NULL), MSQ_E_HOST);
  assert_message_has("54 x 41 pixels; those of the slicer have 53 x 41");
  msq_io_writer_release(writer);

  writer = begin(distances, in_folder("stack"));
  assert_int_equal(msq_slicer_run(distances, 0, 1, msq_io_writer_layer, writer, NULL), MSQ_E_HOST);
  assert_message_has("output of the layers is 4");
  msq_io_writer_release(writer);

  assert_ok(msq_io_svg_create(slicer, in_folder("part.svg"), NULL, NULL, &writer));
  assert_int_equal(msq_slicer_run(slicer, 0, 1, msq_io_writer_layer, writer, NULL), MSQ_E_HOST);
  assert_message_has("output of the layers is 1");
  msq_io_writer_release(writer);

  msq_io_writer_def writer_def;
  assert_ok(msq_io_writer_def_init(&writer_def, sizeof writer_def));
  writer_def.output = 1;
  assert_ok(msq_io_png_create(slicer, in_folder("stack"), &writer_def, NULL, &writer));
  assert_int_equal(msq_slicer_run(slicer, 0, 1, msq_io_writer_layer, writer, NULL), MSQ_E_HOST);
  assert_message_has("output is 1; the layers have 1 outputs");
  msq_io_writer_release(writer);
  assert_int_equal(count_files(folder), 0);
  msq_slicer_release(wide);
  msq_slicer_release(distances);
  msq_slicer_release(slicer);
}

/* One run, three writers, each with its output. */
typedef struct several {
  msq_io_writer* writers[3];
} several;

static int32_t give_all(void* user, const msq_layer* layer) {
  several* all = (several*)user;
  for (int i = 0; i < 3 && all->writers[i]; ++i) {
    const int32_t code = msq_io_writer_layer(all->writers[i], layer);
    if (code != MSQ_OK) return code;
  }
  return 0;
}

static void several_writers(void** state) {
  (void)state;
  msq_contours_def rings;
  msq_output_def outputs[3];
  assert_ok(msq_contours_def_init(&rings, sizeof rings));
  rings.tolerance = 0.02;
  for (int i = 0; i < 3; ++i) assert_ok(msq_output_def_init(&outputs[i], sizeof outputs[i]));
  outputs[1].output = MSQ_LAYER_GREY;
  outputs[2].output = MSQ_LAYER_CONTOURS;
  outputs[2].contours = &rings;
  msq_slicer_def def;
  msq_slicer* slicer;
  assert_ok(msq_slicer_def_init(&def, sizeof def));
  def.resolution[0] = 53;
  def.resolution[1] = 41;
  def.layer_height = 0.25;
  def.layer_count = 12;
  def.outputs = outputs;
  def.output_count = 3;
  assert_ok(msq_slicer_create(model, &def, &slicer));
  several all;
  for (uint32_t i = 0; i < 3; ++i) {
    msq_io_writer_def writer_def;
    assert_ok(msq_io_writer_def_init(&writer_def, sizeof writer_def));
    writer_def.output = i;
    if (i < 2)
      assert_ok(msq_io_png_create(slicer, in_folder(i ? "grey" : "bits"), &writer_def, NULL,
                                  &all.writers[i]));
    else
      assert_ok(
          msq_io_svg_create(slicer, in_folder("part.svg"), &writer_def, NULL, &all.writers[i]));
  }
  assert_ok(msq_slicer_run(slicer, 0, UINT64_MAX, give_all, &all, NULL));
  for (int i = 0; i < 3; ++i) {
    assert_ok(msq_io_writer_finish(all.writers[i]));
    msq_io_writer_release(all.writers[i]);
  }
  msq_slicer* alone = make_slicer_of(model, MSQ_LAYER_GREY);
  write_all(alone, begin(alone, in_folder("alone")));
  assert_same_files(in_folder("grey/layer00007.png"), in_folder("alone/layer00007.png"));
  remove_folder(in_folder("bits"));
  remove_folder(in_folder("grey"));
  remove_folder(in_folder("alone"));
  remove(in_folder("part.svg"));
  msq_slicer_release(alone);
  msq_slicer_release(slicer);
}

/* Files of one name have the layers in order, by any number of threads and size of the queue. */
static void ordered(void** state) {
  (void)state;
  msq_contours_def rings;
  msq_output_def outputs[2];
  assert_ok(msq_contours_def_init(&rings, sizeof rings));
  rings.tolerance = 0.02;
  for (int i = 0; i < 2; ++i) assert_ok(msq_output_def_init(&outputs[i], sizeof outputs[i]));
  outputs[0].output = MSQ_LAYER_GREY;
  outputs[1].output = MSQ_LAYER_CONTOURS;
  outputs[1].contours = &rings;
  msq_io_panel_def panel;
  msq_slicer_def def;
  msq_slicer* slicer;
  assert_ok(msq_io_panel_def_init(&panel, sizeof panel));
  panel.pixels[0] = panel.pixels[1] = 90;
  panel.size[0] = panel.size[1] = 4.5;
  assert_ok(msq_slicer_def_init(&def, sizeof def));
  def.layer_height = 0.05;
  def.outputs = outputs;
  def.output_count = 2;
  assert_ok(msq_io_panel_plan(model, &panel, &def));
  assert_int_equal(def.layer_count, 80);
  assert_ok(msq_slicer_create(model, &def, &slicer));
  for (int k = 0; k < 2; ++k) {
    several all = {{NULL, NULL, NULL}};
    for (uint32_t i = 0; i < 2; ++i) {
      msq_io_writer_def writer_def;
      msq_io_sl1_def sl1;
      assert_ok(msq_io_writer_def_init(&writer_def, sizeof writer_def));
      assert_ok(msq_io_sl1_def_init(&sl1, sizeof sl1));
      sl1.panel = &panel;
      writer_def.output = i;
      writer_def.threads = k ? 6 : 1;
      if (k) writer_def.queue_bytes = 60000;
      if (i)
        assert_ok(msq_io_svg_create(slicer, in_folder(k ? "svg6" : "svg1"), &writer_def, NULL,
                                    &all.writers[i]));
      else
        assert_ok(msq_io_sl1_create(slicer, in_folder(k ? "sl6" : "sl1"), &writer_def, &sl1,
                                    &all.writers[i], NULL));
    }
    assert_ok(msq_slicer_run(slicer, 0, UINT64_MAX, give_all, &all, NULL));
    for (int i = 0; i < 2; ++i) {
      assert_ok(msq_io_writer_finish(all.writers[i]));
      msq_io_writer_release(all.writers[i]);
    }
  }
  assert_same_files(in_folder("svg1"), in_folder("svg6"));
  assert_same_files(in_folder("sl1"), in_folder("sl6"));
  const char* const names[] = {"svg1", "svg6", "sl1", "sl6"};
  for (int i = 0; i < 4; ++i) remove(in_folder(names[i]));
  msq_slicer_release(slicer);
}

static void meshes(void** state) {
  (void)state;
  msq_surface_def def;
  assert_ok(msq_surface_def_init(&def, sizeof def));
  def.pitch = 0.2;
  for (int32_t format = MSQ_SURFACE_STL; format <= MSQ_SURFACE_PLY; ++format) {
    const char *path = in_folder("mesh"), *other = in_folder("other");
    msq_io_file* file;
    assert_ok(msq_io_surface_save(model, &def, format, path, 0, NULL));
    assert_ok(msq_io_file_create(other, 0, &file));
    assert_ok(msq_surface_file(model, &def, format, msq_io_file_part, file, NULL));
    assert_ok(msq_io_file_finish(file));
    msq_io_file_release(file);
    assert_same_files(path, other);
    size_t size;
    uint8_t* bytes = read_file(path, &size);
    assert_in_range(size, 5000, 5000000);
    if (format == MSQ_SURFACE_STL) {
      uint32_t triangles;
      memcpy(&triangles, bytes + 80, 4); /* low byte first, as here */
      assert_int_equal(size, 84 + 50 * (size_t)triangles);
    } else {
      assert_memory_equal(bytes, "ply\n", 4);
    }
    free(bytes);
    remove(path);
    remove(other);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(cancelled),    cmocka_unit_test(incomplete),      cmocka_unit_test(finished),
      cmocka_unit_test(other_layers), cmocka_unit_test(several_writers), cmocka_unit_test(ordered),
      cmocka_unit_test(meshes)};
  return cmocka_run_group_tests(tests, begin_tests, end_tests);
}
