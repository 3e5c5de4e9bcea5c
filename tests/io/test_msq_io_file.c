/* SPDX-License-Identifier: Apache-2.0
 * Files that appear whole or not at all, and what a full disk leaves. */
#define _DEFAULT_SOURCE
#include <signal.h>
#include <sys/resource.h>

#include "io_test.h"

static void appears_at_the_end(void** state) {
  (void)state;
  const char* path = in_folder("file");
  msq_io_file* file;
  assert_ok(msq_io_file_create(path, 0, &file));
  assert_ok(msq_io_file_write(file, "one ", 4));
  assert_ok(msq_io_file_write(file, NULL, 0));
  assert_int_equal(access(path, F_OK), -1);
  assert_ok(msq_io_file_write(file, "two", 3));
  assert_ok(msq_io_file_finish(file));
  assert_refused(msq_io_file_write(file, "x", 1), MSQ_E_ARGUMENT, "finished");
  msq_io_file_release(file);
  assert_file_is(path, "one two");

  file = (msq_io_file*)untouched();
  assert_refused(msq_io_file_create(path, 0, &file), MSQ_E_IO, "replace is 0");
  assert_ptr_equal(file, untouched());
  assert_ok(msq_io_file_create(path, 1, &file));
  assert_ok(msq_io_file_write(file, "three", 5));
  assert_file_is(path, "one two");
  msq_io_file_release(file); /* not finished */
  assert_file_is(path, "one two");
  assert_ok(msq_io_file_create(path, 1, &file));
  assert_ok(msq_io_file_write(file, "three", 5));
  assert_ok(msq_io_file_finish(file));
  msq_io_file_release(file);
  assert_file_is(path, "three");
  assert_int_equal(count_files(folder), 1);
  remove(path);
}

/* Where another process makes a file of the name meanwhile. */
static void name_is_taken(void** state) {
  (void)state;
  const char* path = in_folder("file");
  msq_io_file *one, *other;
  assert_ok(msq_io_file_create(path, 0, &one));
  assert_ok(msq_io_file_create(path, 0, &other));
  assert_ok(msq_io_file_write(one, "one", 3));
  assert_ok(msq_io_file_write(other, "other", 5));
  assert_ok(msq_io_file_finish(one));
  assert_refused(msq_io_file_finish(other), MSQ_E_IO, "name");
  assert_status(msq_io_file_finish(other), MSQ_E_IO);
  msq_io_file_release(other);
  msq_io_file_release(one);
  assert_file_is(path, "one");
  assert_int_equal(count_files(folder), 1);
  remove(path);
}

static void parts(void** state) {
  (void)state;
  const char* path = in_folder("file");
  msq_io_file* file;
  msq_file_part part = {.struct_size = sizeof part};
  assert_ok(msq_io_file_create(path, 0, &file));
  part.offset = 3;
  part.size = 3;
  part.bytes = (const uint8_t*)"two";
  assert_ok(msq_io_file_part(file, &part));
  part.offset = 0;
  part.bytes = (const uint8_t*)"one";
  assert_ok(msq_io_file_part(file, &part));
  assert_ok(msq_io_file_write(file, "!", 1)); /* behind all */
  assert_ok(msq_io_file_finish(file));
  msq_io_file_release(file);
  assert_file_is(path, "onetwo!");
  remove(path);
}

static void bad_places(void** state) {
  (void)state;
  msq_io_file* file;
  assert_refused(msq_io_file_create("/dev/full", 1, &file), MSQ_E_IO,
                 "not a plain file: /dev/full");
  assert_refused(msq_io_file_create(folder, 1, &file), MSQ_E_IO, "not a plain file");
  assert_refused(msq_io_file_create(in_folder("none/file"), 0, &file), MSQ_E_IO, "No such file");
  /* A symbolic link stays; what it leads to is replaced. */
  const char *path = in_folder("file"), *link = in_folder("link");
  assert_ok(msq_io_file_create(path, 0, &file));
  assert_ok(msq_io_file_finish(file));
  msq_io_file_release(file);
  assert_int_equal(symlink("file", link), 0);
  assert_ok(msq_io_file_create(link, 1, &file));
  assert_ok(msq_io_file_write(file, "linked", 6));
  assert_ok(msq_io_file_finish(file));
  msq_io_file_release(file);
  assert_file_is(path, "linked");
  struct stat status;
  assert_int_equal(lstat(link, &status), 0);
  assert_true(S_ISLNK(status.st_mode));
  /* Also where it leads to nothing yet. */
  remove(path);
  assert_ok(msq_io_file_create(link, 0, &file));
  assert_ok(msq_io_file_write(file, "made", 4));
  assert_ok(msq_io_file_finish(file));
  msq_io_file_release(file);
  assert_file_is(path, "made");
  assert_int_equal(lstat(link, &status), 0);
  assert_true(S_ISLNK(status.st_mode));
  remove(link);
  remove(path);
}

/* Names may be as long as the system lets them be, which is 255 bytes on most. */
static void long_names(void** state) {
  (void)state;
  static const struct {
    const char* text;
    int count;
  } of[] = {{"a", 240}, {"a", 241}, {"a", 255}, {"\xe9\xaa\xa8", 85}, {"\xf0\x9f\x98\x80", 63}};
  for (size_t i = 0; i < sizeof of / sizeof of[0]; ++i) {
#ifdef _WIN32
    if (of[i].count > 200) continue; /* a path has at most 260 characters there */
#endif
    char path[512];
    int length = snprintf(path, sizeof path, "%s/", folder);
    for (int k = 0; k < of[i].count; ++k)
      length += snprintf(path + length, sizeof path - (size_t)length, "%s", of[i].text);
    msq_io_file* file;
    assert_ok(msq_io_file_create(path, 0, &file));
    assert_ok(msq_io_file_write(file, "long", 4));
    assert_int_equal(count_files(folder), 1);
    assert_ok(msq_io_file_finish(file));
    msq_io_file_release(file);
    assert_file_is(path, "long");
    remove(path);
  }
}

static void a_replaced_file_keeps_its_mode(void** state) {
  (void)state;
  const char* path = in_folder("file");
  msq_io_file* file;
  struct stat status;
  for (int time = 0; time < 2; ++time) {
    assert_ok(msq_io_file_create(path, 1, &file));
    assert_ok(msq_io_file_finish(file));
    msq_io_file_release(file);
    if (time == 0) assert_int_equal(chmod(path, 0600), 0);
  }
  assert_int_equal(stat(path, &status), 0);
  assert_int_equal(status.st_mode & 0777, 0600);
  remove(path);
}

/* ---- a full disk ------------------------------------------------------------------------------
 */

/* From here on files may have so many bytes; a write beyond fails, as on a full disk. */
static void limit_files(rlim_t bytes) {
  struct rlimit limit;
  assert_int_equal(getrlimit(RLIMIT_FSIZE, &limit), 0);
  limit.rlim_cur = bytes;
  assert_int_equal(setrlimit(RLIMIT_FSIZE, &limit), 0);
}

enum { png, sl1, svg, svg_files, writer_kinds };

static void full_disk(void** state) {
  (void)state;
  msq_context* context = make_context();
  msq_model* model = make_lattice_model(context);
  msq_contours_def rings;
  assert_ok(msq_contours_def_init(&rings, sizeof rings));
  rings.tolerance = 0.01;
  signal(SIGXFSZ, SIG_IGN);
  for (int kind = 0; kind < writer_kinds; ++kind) {
    msq_io_panel_def panel;
    msq_io_sl1_def sl1_def;
    msq_io_svg_def svg_def;
    msq_slicer_def def;
    msq_output_def output;
    assert_ok(msq_io_panel_def_init(&panel, sizeof panel));
    assert_ok(msq_io_sl1_def_init(&sl1_def, sizeof sl1_def));
    assert_ok(msq_io_svg_def_init(&svg_def, sizeof svg_def));
    assert_ok(msq_slicer_def_init(&def, sizeof def));
    assert_ok(msq_output_def_init(&output, sizeof output));
    panel.pixels[0] = 200;
    panel.pixels[1] = 150;
    panel.size[0] = 6;
    panel.size[1] = 4.5;
    sl1_def.panel = &panel;
    def.layer_height = 0.1;
    assert_ok(msq_io_panel_plan(model, &panel, &def));
    svg_def.layout = kind == svg ? MSQ_IO_SVG_STACK : MSQ_IO_SVG_FILES;
    if (kind >= svg) {
      output.output = MSQ_LAYER_CONTOURS;
      output.contours = &rings;
      def.output = MSQ_LAYER_BITS;
      def.outputs = &output;
      def.output_count = 1;
    }
    msq_slicer* slicer;
    msq_io_writer* writer;
    const char* path = in_folder("made");
    assert_ok(msq_slicer_create(model, &def, &slicer));
    if (kind == png) assert_ok(msq_io_png_create(slicer, path, NULL, NULL, &writer));
    if (kind == sl1) assert_ok(msq_io_sl1_create(slicer, path, NULL, &sl1_def, &writer, NULL));
    if (kind >= svg) assert_ok(msq_io_svg_create(slicer, path, NULL, &svg_def, &writer));
    limit_files(600);
    const msq_status ran = msq_slicer_run(slicer, 0, UINT64_MAX, msq_io_writer_layer, writer, NULL);
    /* Short runs may end before the threads of the writer fail. */
    if (ran != MSQ_OK) {
      assert_int_equal(ran, MSQ_E_HOST);
      assert_int_equal(msq_error_host_code(), MSQ_E_IO);
    }
    const msq_status finished = msq_io_writer_finish(writer);
    limit_files(RLIM_INFINITY);
    assert_int_equal(finished, MSQ_E_IO);
    assert_message_has("cannot write the file");
    assert_message_has("made");
    assert_int_equal(count_files(folder), 0);
    assert_status(msq_io_writer_finish(writer), MSQ_E_IO);
    msq_io_writer_release(writer);
    msq_slicer_release(slicer);
  }
  /* A file of the host, and a mesh. */
  msq_io_file* file;
  char bytes[1000] = {0};
  assert_ok(msq_io_file_create(in_folder("made"), 0, &file));
  limit_files(600);
  msq_status status = msq_io_file_write(file, bytes, sizeof bytes);
  if (status == MSQ_OK) status = msq_io_file_finish(file);
  assert_status(msq_io_file_finish(file), MSQ_E_IO);
  msq_io_file_release(file);
  msq_surface_def mesh;
  assert_ok(msq_surface_def_init(&mesh, sizeof mesh));
  mesh.pitch = 0.1;
  const msq_status saved =
      msq_io_surface_save(model, &mesh, MSQ_SURFACE_PLY, in_folder("made"), 0, NULL);
  limit_files(RLIM_INFINITY);
  assert_int_equal(status, MSQ_E_IO);
  assert_int_equal(saved, MSQ_E_IO);
  assert_int_equal(count_files(folder), 0);
  msq_model_release(model);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(appears_at_the_end),
                                     cmocka_unit_test(name_is_taken),
                                     cmocka_unit_test(parts),
                                     cmocka_unit_test(bad_places),
                                     cmocka_unit_test(long_names),
                                     cmocka_unit_test(a_replaced_file_keeps_its_mode),
                                     cmocka_unit_test(full_disk)};
  return cmocka_run_group_tests(tests, make_folder, end_folder);
}
