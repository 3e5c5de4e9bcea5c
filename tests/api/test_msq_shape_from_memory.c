/* SPDX-License-Identifier: Apache-2.0 */
#define _POSIX_C_SOURCE 200809L
#include <pthread.h>

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
      msq_shape_from_memory(r->context, r->data, r->bytes, (const msq_file_def*)def, &shape, NULL);
  if (status == MSQ_OK)
    msq_shape_release(shape);
  else
    assert_ptr_equal(shape, untouched());
  return status;
}

/* A sheet of 2 n n triangles as OBJ. */
static char* make_sheet(int n, size_t* bytes) {
  const size_t room = (size_t)(n + 1) * (size_t)(n + 1) * 40 + (size_t)n * (size_t)n * 60;
  char* text = (char*)malloc(room);
  size_t used = 0;
  assert_non_null(text);
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j)
      used += (size_t)snprintf(text + used, room - used, "v %d %d %d.5\n", i, j, i * j % 7);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const int a = i * (n + 1) + j + 1;
      used += (size_t)snprintf(text + used, room - used, "f %d %d %d %d\n", a, a + n + 1, a + n + 2,
                               a + 1);
    }
  assert_true(used < room);
  *bytes = used;
  return text;
}

typedef struct watch {
  msq_job* job;
  double cancel_at; /* progress */
} watch;

static void* cancel_at_progress(void* user) {
  const watch* w = (const watch*)user;
  double progress = 0;
  while (progress < w->cancel_at && msq_job_progress(w->job, &progress) == MSQ_OK) {
  }
  msq_job_cancel(w->job);
  return NULL;
}

/* From another thread, while text is read and while the mesh is built. */
static void job_cancels_what_is_under_way(void** state) {
  static const double parts[] = {0.05, 0.2, 0.42, 0.6, 0.8};
  msq_context* context = make_context();
  msq_file_def def = stl_def();
  size_t bytes;
  char* text = make_sheet(150, &bytes);
  (void)state;
  def.format = MSQ_FORMAT_OBJ;
  for (size_t i = 0; i < sizeof parts / sizeof parts[0]; ++i) {
    int cancelled = 0;
    /* A thread that the machine keeps waiting may come too late. */
    for (int tries = 0; tries < 50 && !cancelled; ++tries) {
      watch w = {NULL, parts[i]};
      msq_shape* shape = (msq_shape*)untouched();
      pthread_t thread;
      assert_ok(msq_job_create(&w.job));
      assert_int_equal(pthread_create(&thread, NULL, cancel_at_progress, &w), 0);
      const msq_status status = msq_shape_from_memory(context, text, bytes, &def, &shape, w.job);
      assert_int_equal(pthread_join(thread, NULL), 0);
      if (status == MSQ_OK) {
        msq_shape_release(shape);
      } else {
        assert_status(status, MSQ_E_CANCELLED);
        assert_ptr_equal(shape, untouched());
        cancelled = 1;
      }
      msq_job_release(w.job);
    }
    assert_true(cancelled);
    assert_int_equal(memory_of(context).bytes, 0);
  }
  free(text);
  msq_context_release(context);
}

static void job_tells_the_progress(void** state) {
  static const char obj[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  msq_context* context = make_context();
  msq_file_def def = stl_def();
  msq_shape* shape;
  msq_job* job;
  double progress = 0;
  (void)state;
  def.format = MSQ_FORMAT_OBJ;
  assert_ok(msq_job_create(&job));
  assert_ok(msq_shape_from_memory(context, obj, sizeof obj - 1, &def, &shape, job));
  assert_ok(msq_job_progress(job, &progress));
  assert_true(progress == 1);
  msq_shape_release(shape);
  assert_ok(msq_job_cancel(job));
  assert_makes_nothing(msq_shape,
                       msq_shape_from_memory(context, obj, sizeof obj - 1, &def, &made, job),
                       MSQ_E_CANCELLED, "cancelled");
  msq_job_release(job);
  msq_context_release(context);
}

#if MSQ_WITH_ASSIMP

static void stl_is_read_from_memory(void** state) {
  msq_context* context = make_context();
  uint8_t own[stl_bytes];
  msq_file_def def = stl_def();
  msq_shape* shape;
  (void)state;
  memcpy(own, stl, sizeof own);
  assert_ok(msq_shape_from_memory(context, own, sizeof own, &def, &shape, NULL));
  memset(own, 0xff, sizeof own);
  assert_is_cube(context, shape, 1);
  msq_shape_release(shape);
  def.unit_mm = 10;
  assert_ok(msq_shape_from_memory(context, stl, stl_bytes, &def, &shape, NULL));
  assert_is_cube(context, shape, 10);
  msq_shape_release(shape);
  assert_int_equal(memory_of(context).bytes, 0);
  msq_context_release(context);
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

#else

static void build_without_assimp_says_so(void** state) {
  request r = {make_context(), stl, stl_bytes};
  msq_file_def def = stl_def();
  (void)state;
  assert_refused(read_memory(&r, &def), MSQ_E_UNSUPPORTED, "MSQ_WITH_ASSIMP");
  msq_context_release(r.context);
}

#endif

int main(void) {
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(job_cancels_what_is_under_way),
    cmocka_unit_test(job_tells_the_progress),
#if MSQ_WITH_ASSIMP
    cmocka_unit_test(stl_is_read_from_memory),
    cmocka_unit_test(truncated_file_is_an_io_error),
    cmocka_unit_test(file_of_another_format_is_an_io_error),
#else
    cmocka_unit_test(build_without_assimp_says_so),
#endif
  };
  return cmocka_run_group_tests(tests, set_stl, NULL);
}
