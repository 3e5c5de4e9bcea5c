/* SPDX-License-Identifier: Apache-2.0
 * msq_fill_info: sizes of the report; the same arrays each time. (msq_fill_lines tests what they
 * hold.) */
#include "fills.h"

static msq_status info_of_fill(void* fill, void* report) {
  return msq_fill_info((const msq_fill*)fill, (msq_fill_report*)report);
}

static void reports_the_paths(void** state) {
  msq_context* context = make_context();
  msq_structure* foam = make_foam_of(context, 5);
  const msq_fill_def def = square_def(1);
  msq_fill* fill = make_fill(context, foam, &def);
  (void)state;
  msq_structure_release(foam);
  msq_context_release(context); /* the paths belong to the fill */
  const msq_fill_report first = paths_of(fill), second = paths_of(fill);
  assert_true(first.path_count > 3 && first.length > 0);
  assert_memory_equal(&first, &second, sizeof first);
  check_report_sizes(sizeof(msq_fill_report), info_of_fill, fill);
  msq_fill_report report = first;
  assert_refused(msq_fill_info(NULL, &report), MSQ_E_ARGUMENT, "fill is NULL");
  msq_fill_release(fill);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(reports_the_paths)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
