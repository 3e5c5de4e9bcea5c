/* SPDX-License-Identifier: Apache-2.0
 * What functions of contexts, jobs and grids refuse. */
#include "wrong_values.h"

static msq_context* context;

static int32_t run_no_loop(void* user, uint64_t count, msq_task_fn body, void* task) {
  (void)user, (void)count, (void)body, (void)task;
  return 0;
}

static void release_nothing(void* user) {
  (void)user;
}

static void contexts(void** state) {
  (void)state;
  REFUSALS("msq_context_create") {
    msq_context_def* def = (msq_context_def*)definition(0);
    msq_context** made = (msq_context**)output(0);
    assert_ok(msq_context_def_init(def, sizeof *def));
    wrong_sizes(table, def, offsetof(msq_context_def, cache_policy), sizeof *def);
    wrong_enum(table, &def->cache_policy, "cache_policy", 0, 1);
    WRONG(ARGUMENT, "beyond_cores is 7|0 or 1", def->beyond_cores = 7);
    RIGHT(def->beyond_cores = 1; def->threads = 3);
    WRONG(ARGUMENT, "parallel_for is NULL|parallel_for_user", def->parallel_for_user = table);
    WRONG(ARGUMENT, "parallel_for is NULL|parallel_for_release",
          def->parallel_for_release = release_nothing);
    WRONG(ARGUMENT, "warning is NULL|warning_release", def->warning_release = release_nothing);
    WRONG(ARGUMENT, "context is NULL", made = NULL);
    RIGHT(def->parallel_for = run_no_loop);
    RIGHT(def->cache_policy = MSQ_CACHE_SEGMENTED);
    RIGHT(def = NULL);
    if (TRY(msq_context_create(def, made))) msq_context_release(*made);
  }
  REFUSALS("msq_context_memory") {
    msq_context* of = context;
    msq_memory_report* report = (msq_memory_report*)output(0);
    report->struct_size = sizeof *report;
    WRONG(ARGUMENT, "context is NULL", of = NULL);
    WRONG(ARGUMENT, "report is NULL", report = NULL);
    TRY(msq_context_memory(of, report));
  }
  REFUSALS("msq_cache_stats") {
    msq_context* of = context;
    msq_cache_report* report = (msq_cache_report*)output(0);
    report->struct_size = sizeof *report;
    WRONG(ARGUMENT, "context is NULL", of = NULL);
    WRONG(ARGUMENT, "report is NULL", report = NULL);
    TRY(msq_cache_stats(of, report));
  }
  REFUSALS("msq_cache_clear") {
    msq_context* of = context;
    WRONG(ARGUMENT, "context is NULL", of = NULL);
    TRY(msq_cache_clear(of));
  }
  REFUSALS("msq_build_info") {
    msq_build_report* report = (msq_build_report*)output(0);
    report->struct_size = sizeof *report;
    WRONG(ARGUMENT, "report is NULL", report = NULL);
    TRY(msq_build_info(report));
  }
}

static void jobs(void** state) {
  msq_job* known;
  (void)state;
  assert_ok(msq_job_create(&known));
  REFUSALS("msq_job_create") {
    msq_job** job = (msq_job**)output(0);
    WRONG(ARGUMENT, "job is NULL", job = NULL);
    if (TRY(msq_job_create(job))) msq_job_release(*job);
  }
  REFUSALS("msq_job_cancel") {
    msq_job* job = cancelled_job();
    WRONG(ARGUMENT, "job is NULL", job = NULL);
    TRY(msq_job_cancel(job));
  }
  REFUSALS("msq_job_progress") {
    msq_job* job = known;
    double* fraction = (double*)output(0);
    WRONG(ARGUMENT, "job is NULL", job = NULL);
    WRONG(ARGUMENT, "fraction is NULL", fraction = NULL);
    TRY(msq_job_progress(job, fraction));
  }
  REFUSALS("msq_job_info") {
    msq_job* job = known;
    msq_job_report* report = (msq_job_report*)output(0);
    report->struct_size = sizeof *report;
    WRONG(ARGUMENT, "job is NULL", job = NULL);
    WRONG(ARGUMENT, "report is NULL", report = NULL);
    TRY(msq_job_info(job, report));
  }
  msq_job_release(known);
}

static void grids(void** state) {
  (void)state;
  REFUSALS("msq_neighbourhood_placed") {
    msq_neighbourhood of = {{0}, {1, 1, 1}, {1, 0, 0, 0, 1, 0, 0, 0, 1}}, *grid = &of;
    double numbers[12] = {0, -2, 0, 5, 2, 0, 0, 6, 0, 0, 2, 7}, *matrix = numbers;
    msq_neighbourhood* placed = (msq_neighbourhood*)output(0);
    WRONG(ARGUMENT, "matrix is NULL", matrix = NULL);
    WRONG(ARGUMENT, "placed is NULL", placed = NULL);
    for (int i = 0; i < 12; ++i)
      for (int which = 0; which < 3; ++which)
        WRONG(ARGUMENT, "must be finite", numbers[i] = not_finite(which));
    WRONG(ARGUMENT, "mirrors", numbers[10] = -2);
    WRONG(ARGUMENT, "1e-09", numbers[10] = 2.001);
    WRONG(ARGUMENT, "singular", numbers[10] = 0);
    WRONG(ARGUMENT, "cell_size", of.cell_size[1] = -1);
    wrong_grid(table, grid);
    WRONG(ARGUMENT, "grid is NULL", grid = NULL);
    TRY(msq_neighbourhood_placed(grid, matrix, placed));
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(contexts),
      cmocka_unit_test(jobs),
      cmocka_unit_test(grids),
  };
  context = make_context();
  const int failed = cmocka_run_group_tests(tests, NULL, NULL);
  msq_job_release(cancelled_job());
  msq_context_release(context);
  return failed;
}
