/* SPDX-License-Identifier: Apache-2.0
 * msq_fill_info: the same arrays each time. (msq_fill_lines tests what they hold.) */
#include "fills.h"

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
  msq_fill_release(fill);
}

static void release_of_null_does_nothing(void** state) {
  (void)state;
  msq_fill_retain(NULL);
  msq_fill_release(NULL);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(reports_the_paths),
      cmocka_unit_test(release_of_null_does_nothing),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
