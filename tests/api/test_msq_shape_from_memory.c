/* SPDX-License-Identifier: Apache-2.0 */
#include "definitions.h"
#include "stl.h"

static uint8_t stl[stl_bytes];

static int set_stl(void** state) {
  (void)state;
  make_stl(stl);
  return 0;
}

static msq_file_def stl_def(void) {
  msq_file_def def;
  assert_ok(msq_file_def_init(&def, sizeof def));
  def.format = MSQ_FORMAT_STL;
  return def;
}

typedef struct request {
  msq_context* context;
  const void* data;
  uint64_t bytes;
} request;

static msq_status read_memory(void* env, void* def) {
  const request* r = (const request*)env;
  msq_shape* shape = (msq_shape*)untouched();
  const msq_status status =
      msq_shape_from_memory(r->context, r->data, r->bytes, (const msq_file_def*)def, &shape);
  if (status == MSQ_OK)
    msq_shape_release(shape);
  else
    assert_ptr_equal(shape, untouched());
  return status;
}

static void wrong_arguments_are_refused(void** state) {
  request r = {make_context(), stl, stl_bytes};
  msq_file_def def = stl_def();
  (void)state;
  assert_refused(msq_shape_from_memory(r.context, stl, stl_bytes, &def, NULL), MSQ_E_ARGUMENT,
                 "shape is NULL");
  assert_makes_nothing(msq_shape, msq_shape_from_memory(NULL, stl, stl_bytes, &def, &made),
                       MSQ_E_ARGUMENT, "context is NULL");
  r.data = NULL;
  assert_refused(read_memory(&r, &def), MSQ_E_ARGUMENT, "data is NULL");
  r.data = stl;
  def.format = 7;
  assert_refused(read_memory(&r, &def), MSQ_E_ARGUMENT, "format is 7");
  def = stl_def();
  def.winding_rule = -1;
  assert_refused(read_memory(&r, &def), MSQ_E_ARGUMENT, "winding_rule is -1");
  def = stl_def();
  def.unit_mm = NAN;
  assert_refused(read_memory(&r, &def), MSQ_E_ARGUMENT, "unit_mm is ");
  def = stl_def();
  def.reserved = 1;
  assert_refused(read_memory(&r, &def), MSQ_E_ARGUMENT, "reserved is 1");
  msq_context_release(r.context);
}

#if MSQ_WITH_ASSIMP

static void create_honours_every_struct_size(void** state) {
  request r = {make_context(), stl, stl_bytes};
  const msq_file_def def = stl_def();
  (void)state;
  check_def_sizes(&def, sizeof def, read_memory, &r);
  msq_context_release(r.context);
}

static void stl_is_read_from_memory(void** state) {
  msq_context* context = make_context();
  uint8_t own[stl_bytes];
  msq_file_def def = stl_def();
  msq_shape* shape;
  (void)state;
  memcpy(own, stl, sizeof own);
  assert_ok(msq_shape_from_memory(context, own, sizeof own, &def, &shape));
  memset(own, 0xff, sizeof own);
  assert_is_cube(context, shape, 1);
  msq_shape_release(shape);
  def.unit_mm = 10;
  assert_ok(msq_shape_from_memory(context, stl, stl_bytes, &def, &shape));
  assert_is_cube(context, shape, 10);
  msq_shape_release(shape);
  assert_int_equal(memory_of(context).bytes, 0);
  msq_context_release(context);
}

static void format_must_be_named(void** state) {
  request r = {make_context(), stl, stl_bytes};
  msq_file_def def = stl_def();
  (void)state;
  assert_refused(read_memory(&r, NULL), MSQ_E_ARGUMENT, "format");
  def.format = MSQ_FORMAT_AUTO;
  assert_refused(read_memory(&r, &def), MSQ_E_ARGUMENT, "format");
  msq_context_release(r.context);
}

static void truncated_file_is_an_io_error(void** state) {
  msq_file_def def = stl_def();
  (void)state;
  for (uint64_t bytes = 0; bytes < stl_bytes; bytes += 83) {
    request r = {make_context(), stl, bytes};
    assert_refused(read_memory(&r, &def), MSQ_E_IO, "STL");
    assert_message_has_number(bytes);
    msq_context_release(r.context);
  }
}

static void file_of_another_format_is_an_io_error(void** state) {
  request r = {make_context(), stl, stl_bytes};
  msq_file_def def = stl_def();
  const int32_t others[] = {MSQ_FORMAT_PLY, MSQ_FORMAT_OFF, MSQ_FORMAT_3MF, MSQ_FORMAT_AMF};
  (void)state;
  for (int i = 0; i < 4; ++i) {
    def.format = others[i];
    assert_status(read_memory(&r, &def), MSQ_E_IO);
  }
  msq_context_release(r.context);
}

static void limits_are_kept_to_the_byte(void** state) {
  request r = {make_context(), stl, stl_bytes};
  msq_file_def def = stl_def();
  (void)state;
  def.max_bytes = stl_bytes;
  def.max_triangles = 12;
  assert_ok(read_memory(&r, &def));
  def.max_bytes = stl_bytes - 1;
  assert_refused(read_memory(&r, &def), MSQ_E_LIMIT, "max_bytes");
  assert_message_has_number(stl_bytes);
  assert_message_has_number(stl_bytes - 1);
  def = stl_def();
  def.max_triangles = 11;
  assert_refused(read_memory(&r, &def), MSQ_E_LIMIT, "max_triangles is 11");
  assert_message_has("12");
  msq_context_release(r.context);
}

#else

static void build_without_reader_says_so(void** state) {
  request r = {make_context(), stl, stl_bytes};
  msq_file_def def = stl_def();
  (void)state;
  assert_refused(read_memory(&r, &def), MSQ_E_UNSUPPORTED, "MSQ_WITH_ASSIMP");
  msq_context_release(r.context);
}

#endif

int main(void) {
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(wrong_arguments_are_refused),
#if MSQ_WITH_ASSIMP
    cmocka_unit_test(create_honours_every_struct_size),
    cmocka_unit_test(stl_is_read_from_memory),
    cmocka_unit_test(format_must_be_named),
    cmocka_unit_test(truncated_file_is_an_io_error),
    cmocka_unit_test(file_of_another_format_is_an_io_error),
    cmocka_unit_test(limits_are_kept_to_the_byte),
#else
    cmocka_unit_test(build_without_reader_says_so),
#endif
  };
  return cmocka_run_group_tests(tests, set_stl, NULL);
}
