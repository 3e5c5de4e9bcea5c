// SPDX-License-Identifier: Apache-2.0
// The points and the options of set queries, read from the host's definitions.
#pragma once

#include <memory>
#include <vector>

#include "api/guard.h"
#include "api/warnings.h"
#include "query/ask_group.h"
#include "query/reach.h"
#include "query/stratified_points.h"

namespace msq::api {

msq_points_def points_defaults();
msq_query_def query_defaults();

/// The points that a definition describes. Arrays are not copied; their coordinates are not looked
/// at.
std::unique_ptr<PointSet> read_points(const msq_points_def* points);
/// Of a definition that must be of kind MSQ_POINTS_STRATIFIED.
Strata read_strata(const msq_points_def& known);

/// Throws Error(argument) if an output overlaps the array that the definition names.
void require_apart(const msq_points_def* points, const void* output, uint64_t bytes,
                   const char* name);

/// Throws Error(argument), which names the first point that is not finite. Generated points are.
void require_finite_points(const PointSet& points, const Executor& executor);

struct Query {
  double length_scale = 0;
  QueryPlan plan;
};
/// query NULL: defaults.
Query read_query(const msq_query_def* query);

/// The scales that a query resolves: the model's own, or `some` of them.
inline const Scales& resolve(const Model& model, const msq_query_def* query, Scales& some) {
  const double length_scale = query ? read_query(query).length_scale : 0;
  if (length_scale == 0) return model.all_scales();
  return some = model.resolved(length_scale);
}

/// Throws Error(limit) where a model of all space cannot be queried at the point.
inline void require_point(const Model& model, const Scales& resolved, Vec3 p) {
  require_reach(model, resolved, Box3{p, p}, "the point");
}

/// Throws Error(argument) unless an array that is called `name` has the wanted length.
void require_count(uint64_t count, const char* name, uint64_t wanted);

/// Checks the arguments of a set query and calls ask(model, resolved, points, plan, values, job).
template <class Answer, class Ask>
void ask_set(const msq_model* model, const msq_points_def* points, const msq_query_def* query,
             Answer* values, const char* name, uint64_t count, const char* count_name, msq_job* job,
             Ask&& ask) {
  const Model& known = object(model, "model");
  const Ref<const Model> keep(&known);  // callbacks may release the host's last reference
  const std::unique_ptr<PointSet> set = read_points(points);
  const Query options = read_query(query);
  const auto resolved = known.resolved(options.length_scale);
  Job* work = job ? &object(job, "job") : nullptr;
  require_count(count, count_name, set->count());
  if (set->count() > 0) require(values, name);
  require_apart(points, values, count * sizeof(Answer), name);
  require_finite_points(*set, known.context().executor);
  require_reach(known, resolved, *set);
  JobScope scope(work);
  ask(known, resolved, *set, options.plan, values, work);
  scope.done();
  warn_of_cache(known.context());
}

}  // namespace msq::api
