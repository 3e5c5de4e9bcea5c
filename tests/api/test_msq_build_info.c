/* SPDX-License-Identifier: Apache-2.0 */
#include "definitions.h"

static void report_tells_how_the_library_was_built(void** state) {
  msq_build_report report = {0};
  (void)state;
  report.struct_size = sizeof report;
  assert_ok(msq_build_info(&report));
  assert_int_equal(report.version, msq_version());
  assert_int_equal(report.with_assimp, MSQ_WITH_ASSIMP);
  assert_int_equal(report.with_cgal, MSQ_WITH_CGAL);
  assert_int_equal(report.with_xxhash, MSQ_WITH_XXHASH);
  assert_int_equal(report.with_json, MSQ_WITH_JSON);
  assert_int_equal(report.with_tiff, MSQ_WITH_TIFF);
  assert_int_equal(report.reserved, 0);
  assert_string_equal(report.licence, MSQ_WITH_CGAL ? "GPL-3.0-or-later" : "Apache-2.0");
  assert_non_null(report.simd);
  assert_true(strlen(report.simd) > 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(report_tells_how_the_library_was_built),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
