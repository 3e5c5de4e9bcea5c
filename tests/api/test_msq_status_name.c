/* SPDX-License-Identifier: Apache-2.0 */
#include "msq_test.h"

static void every_status_has_its_constant_for_name(void** state) {
  (void)state;
  assert_string_equal(msq_status_name(MSQ_OK), "MSQ_OK");
  assert_string_equal(msq_status_name(MSQ_E_ARGUMENT), "MSQ_E_ARGUMENT");
  assert_string_equal(msq_status_name(MSQ_E_MEMORY), "MSQ_E_MEMORY");
  assert_string_equal(msq_status_name(MSQ_E_CANCELLED), "MSQ_E_CANCELLED");
  assert_string_equal(msq_status_name(MSQ_E_HOST), "MSQ_E_HOST");
  assert_string_equal(msq_status_name(MSQ_E_IO), "MSQ_E_IO");
  assert_string_equal(msq_status_name(MSQ_E_UNSUPPORTED), "MSQ_E_UNSUPPORTED");
  assert_string_equal(msq_status_name(MSQ_E_MESH), "MSQ_E_MESH");
  assert_string_equal(msq_status_name(MSQ_E_LIMIT), "MSQ_E_LIMIT");
  assert_string_equal(msq_status_name(MSQ_E_INTERNAL), "MSQ_E_INTERNAL");
}

static void other_numbers_are_unknown(void** state) {
  const msq_status others[] = {1, -10, 100, INT32_MIN, INT32_MAX};
  (void)state;
  for (size_t i = 0; i < sizeof others / sizeof others[0]; ++i)
    assert_string_equal(msq_status_name(others[i]), "MSQ_E_UNKNOWN");
}

static void name_is_static_storage(void** state) {
  (void)state;
  assert_ptr_equal(msq_status_name(MSQ_E_LIMIT), msq_status_name(MSQ_E_LIMIT));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_status_has_its_constant_for_name),
      cmocka_unit_test(other_numbers_are_unknown),
      cmocka_unit_test(name_is_static_storage),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
