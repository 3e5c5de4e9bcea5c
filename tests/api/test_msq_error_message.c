/* SPDX-License-Identifier: Apache-2.0 */
#include <pthread.h>

#include "fixtures.h"

static void fail_with_radius(msq_context* context, double radius) {
  const double center[3] = {0, 0, 0};
  assert_makes_nothing(msq_shape, msq_shape_from_sphere(context, center, radius, &made),
                       MSQ_E_ARGUMENT, "radius");
}

/* Runs first: nothing has failed on this thread yet. */
static void message_is_empty_before_the_first_failure(void** state) {
  (void)state;
  assert_string_equal(msq_error_message(), "");
  msq_context* context = make_context();
  assert_string_equal(msq_error_message(), "");
  msq_context_release(context);
}

static void message_names_value_and_limit(void** state) {
  msq_context* context = make_context();
  (void)state;
  fail_with_radius(context, -7.25);
  assert_message_has("-7.25");
  assert_message_has("positive");
  msq_context_release(context);
}

static void message_is_that_of_the_last_failure(void** state) {
  msq_context* context = make_context();
  (void)state;
  fail_with_radius(context, -1.5);
  fail_with_radius(context, -2.5);
  assert_message_has("-2.5");
  assert_null(strstr(msq_error_message(), "-1.5"));
  msq_context_release(context);
}

/* Characters of a path stay whole; bytes that are none become question marks. */
static void message_is_utf8(void** state) {
  const struct {
    const char *path, *shown;
  } paths[] = {
      {"/\xc3\xa4.stl", "/\xc3\xa4.stl"},
      {"/\xe2\x82\xac.stl", "/\xe2\x82\xac.stl"},
      {"/\xf0\x9f\x98\x80.stl", "/\xf0\x9f\x98\x80.stl"},
      {"/\xff\x80.stl", "/??.stl"},           /* no first bytes */
      {"/\xe2\x82.stl", "/??.stl"},           /* the third is missing */
      {"/\xe0\x80\xaf.stl", "/???.stl"},      /* overlong */
      {"/\xf0\x80\x80\xaf.stl", "/????.stl"}, /* the same of four */
      {"/\xed\xa0\x80.stl", "/???.stl"},      /* a surrogate */
      {"/\xf4\x90\x80\x80.stl", "/????.stl"}, /* beyond Unicode */
  };
  msq_context* context = make_context();
  (void)state;
  for (size_t i = 0; i < sizeof paths / sizeof *paths; ++i) {
    assert_makes_nothing(msq_shape, msq_shape_from_file(context, paths[i].path, NULL, &made, NULL),
                         MSQ_E_IO, paths[i].shown);
  }
  msq_context_release(context);
}

static void success_leaves_the_message(void** state) {
  msq_context* context = make_context();
  char kept[512];
  (void)state;
  fail_with_radius(context, -3.5);
  snprintf(kept, sizeof kept, "%s", msq_error_message());
  msq_model* model = make_lattice_model(context);
  is_inside(model, 1, 1, 1);
  memory_of(context);
  msq_status_name(MSQ_E_HOST);
  msq_version();
  msq_model_release(model);
  msq_context_release(context);
  assert_string_equal(msq_error_message(), kept);
}

/* Names in files may have any bytes. */
static void message_has_no_control_characters(void** state) {
  msq_context* context = make_context();
  (void)state;
  assert_makes_nothing(
      msq_shape,
      msq_shape_from_file(context, "no\n\r\033[31mfile\177\xc3\xa9\xff.stl", NULL, &made, NULL),
      MSQ_E_IO, "no???[31mfile?\xc3\xa9?.stl");
  msq_context_release(context);
}

typedef struct other_thread {
  msq_context* context;
  char first[64], last[512];
  msq_status status;
} other_thread;

static void* fail_elsewhere(void* argument) {
  other_thread* other = (other_thread*)argument;
  const double center[3] = {0, 0, 0};
  msq_shape* shape;
  snprintf(other->first, sizeof other->first, "%s", msq_error_message());
  other->status = msq_shape_from_sphere(other->context, center, -8.5, &shape);
  snprintf(other->last, sizeof other->last, "%s", msq_error_message());
  return NULL;
}

static void message_is_per_thread(void** state) {
  other_thread other;
  pthread_t thread;
  (void)state;
  other.context = make_context();
  fail_with_radius(other.context, -4.5);
  assert_int_equal(pthread_create(&thread, NULL, fail_elsewhere, &other), 0);
  assert_int_equal(pthread_join(thread, NULL), 0);
  assert_string_equal(other.first, "");
  assert_int_equal(other.status, MSQ_E_ARGUMENT);
  assert_non_null(strstr(other.last, "-8.5"));
  assert_message_has("-4.5");
  msq_context_release(other.context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(message_is_empty_before_the_first_failure),
      cmocka_unit_test(message_names_value_and_limit),
      cmocka_unit_test(message_is_that_of_the_last_failure),
      cmocka_unit_test(message_is_utf8),
      cmocka_unit_test(success_leaves_the_message),
      cmocka_unit_test(message_has_no_control_characters),
      cmocka_unit_test(message_is_per_thread),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
