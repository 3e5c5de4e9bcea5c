/* SPDX-License-Identifier: Apache-2.0
 * msq_file_def_init, msq_shape_from_file. The formats themselves: tests/unit/test_mesh_file.cpp. */
#define _POSIX_C_SOURCE 200809L
#include "definitions.h"
#include "folder.h"
#include "stl.h"

static int set_up(void** state) {
  (void)state;
  return make_folder();
}

static int tear_down(void** state) {
  (void)state;
  return rmdir(folder);
}

static const char* write_stl(const char* name) {
  uint8_t file[stl_bytes];
  make_stl(file);
  return write_file(name, file, sizeof file);
}

static msq_file_def file_def(void) {
  msq_file_def def;
  assert_ok(msq_file_def_init(&def, sizeof def));
  return def;
}

typedef struct request {
  msq_context* context;
  const char* path;
} request;

static msq_status read_file(void* env, void* def) {
  const request* r = (const request*)env;
  msq_shape* shape = (msq_shape*)untouched();
  const msq_status status =
      msq_shape_from_file(r->context, r->path, (const msq_file_def*)def, &shape, NULL);
  if (status == MSQ_OK)
    msq_shape_release(shape);
  else
    assert_ptr_equal(shape, untouched());
  return status;
}

static void defaults_are_those_of_the_header(void** state) {
  const msq_file_def def = file_def();
  (void)state;
  assert_int_equal(def.format, MSQ_FORMAT_AUTO);
  assert_int_equal(def.winding_rule, MSQ_WINDING_AUTO);
  assert_int_equal(def.reserved, 0);
  assert_true(def.unit_mm == 1);
  assert_int_equal(def.max_bytes, (uint64_t)4 << 30);
  assert_int_equal(def.max_triangles, 200000000);
}

/* Numbers that no float has. */
static const char obj[] =
    "v 300.123456789 0 0\nv 0 -1e-20 0\nv 0 0 0.1\nv 0.10000000000000001 12345678.123456789 1e10\n"
    "f 1 2 3 4\n";

static void text_keeps_every_digit(void** state) {
  msq_context* context = make_context();
  const char* path = write_file("part.obj", obj, sizeof obj - 1);
  msq_shape* shape;
  (void)state;
  assert_ok(msq_shape_from_file(context, path, NULL, &shape, NULL));
  unlink(path);
  const msq_shape_report report = info_of(shape);
  assert_true(report.max[0] == 300.123456789);
  assert_true(report.min[1] == -1e-20);
  assert_true(report.max[1] == 12345678.123456789);
  assert_true(report.max[2] == 1e10);
  msq_shape_release(shape);
  msq_context_release(context);
}

static void error_names_path_and_line(void** state) {
  request r = {make_context(), write_file("bad.obj", "v 1 2 3\nv 1 2 x\n", 16)};
  (void)state;
  assert_refused(read_file(&r, NULL), MSQ_E_IO, "bad.obj: OBJ: line 2");
  assert_message_has("\"x\" is not a number");
  unlink(r.path);
  msq_context_release(r.context);
}

static void job_cancels_and_tells_the_progress(void** state) {
  msq_context* context = make_context();
  const char* path = write_file("part.obj", obj, sizeof obj - 1);
  msq_shape* shape;
  msq_job* job;
  double progress = 0;
  (void)state;
  assert_ok(msq_job_create(&job));
  assert_ok(msq_shape_from_file(context, path, NULL, &shape, job));
  assert_ok(msq_job_progress(job, &progress));
  assert_true(progress == 1);
  msq_shape_release(shape);
  assert_ok(msq_job_cancel(job));
  assert_makes_nothing(msq_shape, msq_shape_from_file(context, path, NULL, &made, job),
                       MSQ_E_CANCELLED, "cancelled");
  msq_job_release(job);
  unlink(path);
  assert_int_equal(memory_of(context).bytes, 0);
  msq_context_release(context);
}

#if MSQ_WITH_ASSIMP

static void stl_is_read_by_its_extension(void** state) {
  const char* names[] = {"cube.stl", "CUBE.STL", "with.dots.Stl"};
  msq_context* context = make_context();
  (void)state;
  for (int i = 0; i < 3; ++i) {
    const char* path = write_stl(names[i]);
    msq_shape* shape;
    assert_ok(msq_shape_from_file(context, path, NULL, &shape, NULL));
    unlink(path); /* it was read at once */
    assert_is_cube(context, shape, 1);
    msq_shape_release(shape);
  }
  assert_int_equal(memory_of(context).bytes, 0);
  msq_context_release(context);
}

static void named_format_goes_before_the_extension(void** state) {
  msq_context* context = make_context();
  const char* path = write_stl("cube.bin");
  msq_file_def def = file_def();
  msq_shape* shape;
  (void)state;
  def.format = MSQ_FORMAT_STL;
  assert_ok(msq_shape_from_file(context, path, &def, &shape, NULL));
  assert_is_cube(context, shape, 1);
  msq_shape_release(shape);
  unlink(path);
  msq_context_release(context);
}

static void unit_scales_the_shape(void** state) {
  msq_context* context = make_context();
  const char* path = write_stl("inches.stl");
  msq_file_def def = file_def();
  msq_shape* shape;
  (void)state;
  def.unit_mm = 25.4;
  assert_ok(msq_shape_from_file(context, path, &def, &shape, NULL));
  assert_is_cube(context, shape, 25.4);
  msq_shape_release(shape);
  unlink(path);
  msq_context_release(context);
}

static void unknown_extension_is_unsupported(void** state) {
  const char* names[] = {"cube.step", "cube", "cube.stl.gz", ".hidden"};
  (void)state;
  for (int i = 0; i < 4; ++i) {
    request r = {make_context(), write_stl(names[i])};
    assert_refused(read_file(&r, NULL), MSQ_E_UNSUPPORTED, names[i]);
    assert_message_has("stl, obj, ply, off, 3mf, amf");
    unlink(r.path);
    msq_context_release(r.context);
  }
}

static void missing_file_is_an_io_error(void** state) {
  request r = {make_context(), path_of("none.stl")};
  (void)state;
  assert_refused(read_file(&r, NULL), MSQ_E_IO, "none.stl");
  assert_message_has("No such file");
  msq_context_release(r.context);
}

static void folder_is_an_io_error(void** state) {
  request r = {make_context(), folder};
  msq_file_def def = file_def();
  (void)state;
  def.format = MSQ_FORMAT_STL;
  assert_refused(read_file(&r, &def), MSQ_E_IO, folder);
  msq_context_release(r.context);
}

/* Longer than the message has room for. */
static void reason_is_told_of_a_long_path(void** state) {
  char path[1000];
  request r = {make_context(), path};
  (void)state;
  memset(path, 'x', sizeof path);
  for (size_t i = 0; i < sizeof path; i += 100) path[i] = '/';
  snprintf(path + sizeof path - 10, 10, "none.stl");
  assert_refused(read_file(&r, NULL), MSQ_E_IO, "No such file");
  msq_context_release(r.context);
}

static void truncated_file_is_an_io_error(void** state) {
  uint8_t file[stl_bytes];
  const size_t lengths[] = {0, 83, 84, stl_bytes - 1};
  (void)state;
  make_stl(file);
  for (int i = 0; i < 4; ++i) {
    request r = {make_context(), write_file("cut.stl", file, lengths[i])};
    assert_refused(read_file(&r, NULL), MSQ_E_IO, "cut.stl");
    assert_message_has_number(lengths[i]);
    assert_message_has_number(lengths[i] < 84 ? 84 : stl_bytes);
    assert_int_equal(memory_of(r.context).bytes, 0);
    unlink(r.path);
    msq_context_release(r.context);
  }
}

static void memory_limit_is_kept(void** state) {
  request r = {make_context_of(1, 0, 100), write_stl("cube.stl")};
  (void)state;
  assert_refused(read_file(&r, NULL), MSQ_E_LIMIT, "memory_limit of 100");
  assert_int_equal(memory_of(r.context).bytes, 0);
  unlink(r.path);
  msq_context_release(r.context);
}

#else

static void build_without_assimp_says_so(void** state) {
  request r = {make_context(), write_stl("cube.stl")};
  (void)state;
  assert_refused(read_file(&r, NULL), MSQ_E_UNSUPPORTED, "MSQ_WITH_ASSIMP");
  unlink(r.path);
  msq_context_release(r.context);
}

#endif

int main(void) {
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(defaults_are_those_of_the_header),
    cmocka_unit_test(text_keeps_every_digit),
    cmocka_unit_test(error_names_path_and_line),
    cmocka_unit_test(job_cancels_and_tells_the_progress),
#if MSQ_WITH_ASSIMP
    cmocka_unit_test(stl_is_read_by_its_extension),
    cmocka_unit_test(named_format_goes_before_the_extension),
    cmocka_unit_test(unit_scales_the_shape),
    cmocka_unit_test(unknown_extension_is_unsupported),
    cmocka_unit_test(missing_file_is_an_io_error),
    cmocka_unit_test(folder_is_an_io_error),
    cmocka_unit_test(reason_is_told_of_a_long_path),
    cmocka_unit_test(truncated_file_is_an_io_error),
    cmocka_unit_test(memory_limit_is_kept),
#else
    cmocka_unit_test(build_without_assimp_says_so),
#endif
  };
  return cmocka_run_group_tests(tests, set_up, tear_down);
}
