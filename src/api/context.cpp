// SPDX-License-Identifier: Apache-2.0
#include "api/guard.h"

using namespace msq;
using namespace msq::api;

namespace {

static_assert(static_cast<int>(CachePolicy::fifo) == MSQ_CACHE_FIFO);
static_assert(static_cast<int>(CachePolicy::segmented) == MSQ_CACHE_SEGMENTED);

msq_context_def context_defaults() {
  msq_context_def def{};
  def.cache_bytes = uint64_t{1} << 30;
  return def;
}

}  // namespace

msq_status msq_context_def_init(msq_context_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, context_defaults(), "msq_context_def"); });
}

msq_status msq_context_create(const msq_context_def* def, msq_context** context) {
  return guard([&] {
    require(context, "context");
    const msq_context_def known =
        def ? read_def(def, context_defaults(), "def") : context_defaults();
    const int32_t policy =
        require_range(known.cache_policy, MSQ_CACHE_FIFO, MSQ_CACHE_SEGMENTED, "cache_policy");
    if (known.beyond_cores > 1)
      fail(Status::argument, "beyond_cores is %u; it must be 0 or 1", known.beyond_cores);
    if (!known.parallel_for && (known.parallel_for_user || known.parallel_for_release))
      fail(Status::argument, "parallel_for is NULL, and %s is not",
           known.parallel_for_user ? "parallel_for_user" : "parallel_for_release");
    if (!known.warning && known.warning_release)
      fail(Status::argument, "warning is NULL, and warning_release is not");
    Ref<Context> made = make_ref<Context>(known.threads, known.cache_bytes, known.memory_limit,
                                          known.beyond_cores != 0, static_cast<CachePolicy>(policy),
                                          HostLoop{known.parallel_for, known.parallel_for_user});
    made->loop_user.own(known.parallel_for_user, known.parallel_for_release);
    made->warning_user.own(known.warning_user, known.warning_release);
    made->warnings.fn = known.warning;
    made->warnings.user = known.warning_user;
    *context = new_handle<msq_context>(std::move(made));
  });
}

void msq_context_retain(msq_context* context) {
  retain(context);
}
void msq_context_release(msq_context* context) {
  release(context);
}

msq_status msq_context_memory(const msq_context* context, msq_memory_report* report) {
  return guard([&] {
    const MemoryBudget& budget = *object(context, "context").budget;
    msq_memory_report known{};
    known.bytes = budget.held();
    known.peak_bytes = budget.peak();
    known.limit_bytes = budget.limit();
    write_report(report, known, "report");
  });
}

msq_status msq_cache_stats(const msq_context* context, msq_cache_report* report) {
  return guard([&] {
    const CellCache& cache = object(context, "context").cache;
    const CellCache::Counters counters = cache.counters();
    msq_cache_report known{};
    known.hits = counters.hits;
    known.misses = counters.misses;
    known.evictions = counters.evictions;
    known.bytes = counters.bytes;
    known.peak_bytes = counters.peak_bytes;
    known.limit_bytes = cache.limit();
    known.building_bytes = counters.building_bytes;
    known.cells = counters.cells;
    known.duplicates = counters.duplicates;
    known.unkept = counters.unkept;
    write_report(report, known, "report");
  });
}

msq_status msq_cache_clear(msq_context* context) {
  return guard([&] { object(context, "context").cache.clear(); });
}

msq_status msq_job_create(msq_job** job) {
  return guard([&] {
    require(job, "job");
    *job = new_handle<msq_job>(make_ref<Job>());
  });
}

void msq_job_retain(msq_job* job) {
  retain(job);
}
void msq_job_release(msq_job* job) {
  release(job);
}

msq_status msq_job_cancel(msq_job* job) {
  return guard([&] { object(job, "job").cancel(); });
}

msq_status msq_job_info(const msq_job* job, msq_job_report* report) {
  return guard([&] {
    const QueryCounts& counts = object(job, "job").counts();
    msq_job_report known{};
    known.points = counts.points;
    known.by_shape = counts.by_shape;
    known.by_point = counts.by_point;
    known.by_set = counts.by_set;
    known.groups = counts.groups;
    write_report(report, known, "report");
  });
}

msq_status msq_job_progress(const msq_job* job, double* fraction) {
  return guard([&] {
    const double now = object(job, "job").progress();
    require(fraction, "fraction") = now;
  });
}
