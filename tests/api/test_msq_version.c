/* SPDX-License-Identifier: Apache-2.0 */
#include "msq_test.h"

static void library_and_header_are_of_one_version(void** state) {
  (void)state;
  assert_int_equal(msq_version(), MSQ_VERSION);
}

static void version_is_composed_of_its_parts(void** state) {
  (void)state;
  assert_int_equal(MSQ_VERSION,
                   MSQ_VERSION_MAJOR * 10000 + MSQ_VERSION_MINOR * 100 + MSQ_VERSION_PATCH);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(library_and_header_are_of_one_version),
      cmocka_unit_test(version_is_composed_of_its_parts),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
