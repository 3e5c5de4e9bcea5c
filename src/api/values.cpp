// SPDX-License-Identifier: Apache-2.0
// Sets of values of structures and of fields by themselves.
#include "query/values.h"

#include "api/points.h"

using namespace msq;
using namespace msq::api;

msq_status msq_set_onset(msq_context* context, const msq_structure* structure,
                         const msq_points_def* points, int32_t value, double* onsets,
                         uint64_t onset_count, double* gradients, uint64_t gradient_count,
                         msq_job* job) {
  return guard([&] {
    Context& owner = object(context, "context");
    const Structure& known = object(structure, "structure");
    // Callbacks may release the host's last references.
    const Ref<const Structure> keep(&known);
    const Ref<const Context> keep_owner(&owner);
    if (!known.has_onset())
      fail(Status::unsupported,
           "the structure's kind has no onset; of structures made of others, unions have one whose "
           "members all have struts and an onset");
    const std::unique_ptr<PointSet> set = read_points(points);
    OnsetPlan plan;
    plan.is_signed =
        require_range(value, MSQ_ONSET_PLAIN, MSQ_ONSET_SIGNED, "value") == MSQ_ONSET_SIGNED;
    require_count(onset_count, "onset_count", set->count());
    if (onset_count > 0) plan.onsets = &require(onsets, "onsets");
    if (gradient_count != (gradients ? checked_product(3, onset_count, "gradients") : 0))
      fail(Status::argument, "gradient_count is %llu; with gradients it is 3 times %llu, without 0",
           static_cast<unsigned long long>(gradient_count),
           static_cast<unsigned long long>(onset_count));
    plan.gradients = gradients;
    require_apart(points, onsets, onset_count * sizeof *onsets, "onsets");
    require_apart(points, gradients, gradient_count * sizeof *gradients, "gradients");
    require_finite_points(*set, owner.executor);
    require_reach(known, owner.executor, *set, gradients ? gradient_step(known) : 0);
    Job* work = job ? &object(job, "job") : nullptr;
    JobScope scope(work);
    set_onset(known, *set, plan, owner.executor_for(known.is_concurrent()), work);
    scope.done();
  });
}

msq_status msq_field_evaluate(msq_context* context, const msq_field* field,
                              const msq_points_def* points, double* values, uint64_t value_count,
                              msq_job* job) {
  return guard([&] {
    Context& owner = object(context, "context");
    const Field& known = object(field, "field");
    const Ref<const Field> keep(&known);
    const Ref<const Context> keep_owner(&owner);
    const std::unique_ptr<PointSet> set = read_points(points);
    require_count(value_count, "value_count", set->count());
    if (value_count > 0) require(values, "values");
    require_apart(points, values, value_count * sizeof *values, "values");
    require_finite_points(*set, owner.executor);
    Job* work = job ? &object(job, "job") : nullptr;
    JobScope scope(work);
    set_field(known, *set, values, owner.executor_for(known.is_concurrent()), work);
    scope.done();
  });
}
