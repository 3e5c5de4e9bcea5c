// SPDX-License-Identifier: Apache-2.0
// Struts as a graph.
#include "query/struts.h"

#include <cstddef>

#include "api/guard.h"
#include "api/host.h"
#include "query/strut_graph.h"

using namespace msq;
using namespace msq::api;

namespace msq::api {

template <>
struct ObjectOf<msq_strut_graph> {
  using type = StrutGraph;
};

}  // namespace msq::api

namespace {

// Struts are passed to the host without conversion.
static_assert(sizeof(Strut) == sizeof(msq_strut) && sizeof(msq_strut) == 128);
static_assert(offsetof(Strut, id) == offsetof(msq_strut, id));
static_assert(offsetof(Strut, nodes) == offsetof(msq_strut, node_a));
static_assert(offsetof(msq_strut, node_b) == offsetof(msq_strut, node_a) + sizeof(Id));
static_assert(offsetof(Strut, a) == offsetof(msq_strut, a));
static_assert(offsetof(Strut, b) == offsetof(msq_strut, b));
static_assert(offsetof(Strut, radii) == offsetof(msq_strut, radii));
static_assert(offsetof(Strut, cell) == offsetof(msq_strut, cell));
static_assert(offsetof(Strut, caps) == offsetof(msq_strut, caps));
static_assert(offsetof(Strut, cut) == offsetof(msq_strut, cut));

msq_struts_def struts_defaults() {
  msq_struts_def def{};
  def.selection = MSQ_STRUTS_OWNED;
  return def;
}

StrutQuery read_query(const msq_struts_def& def, const Structure& structure) {
  const int32_t selection =
      require_range(def.selection, MSQ_STRUTS_OWNED, MSQ_STRUTS_NEAR, "selection");
  const Box3 box{require_vector(def.min, "min"), require_vector(def.max, "max")};
  for (int axis = 0; axis < 3; ++axis)
    if (!(box.min[axis] <= box.max[axis]))
      fail(Status::argument, "min is %g and max is %g along axis %d; min must not be more",
           box.min[axis], box.max[axis], axis);
  return {structure,
          {box, selection == MSQ_STRUTS_OWNED},
          def.shape ? &object(def.shape, "shape") : nullptr};
}

/// A call, and what it keeps alive: callbacks may release the host's last references.
class Call {
 public:
  Call(msq_context* context, const msq_structure* structure, const msq_struts_def* def,
       msq_job* job)
      : context_(&object(context, "context")),
        structure_(&object(structure, "structure")),
        query_(read_query(read_def(def, struts_defaults(), "def"), *structure_)),
        shape_(query_.shape),
        job_(job ? &object(job, "job") : nullptr) {}

  const Context& context() const { return *context_; }
  const StrutQuery& query() const { return query_; }
  Job* job() const { return job_; }

 private:
  const Ref<Context> context_;
  const Ref<const Structure> structure_;
  const StrutQuery query_;
  const Ref<const Shape> shape_;
  Job* const job_;
};

}  // namespace

msq_status msq_struts_def_init(msq_struts_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, struts_defaults(), "msq_struts_def"); });
}

msq_status msq_structure_struts(msq_context* context, const msq_structure* structure,
                                const msq_struts_def* def, msq_struts_fn callback, void* user,
                                msq_job* job) {
  return guard([&] {
    const Call call(context, structure, def, job);
    if (!callback) fail(Status::argument, "callback is NULL");
    JobScope scope(call.job());
    for_each_strut(
        call.context(), call.query(), call.job(), [&](const Strut* struts, size_t count) {
          check_code(call_host(callback, user, reinterpret_cast<const msq_strut*>(struts),
                               uint64_t{count}),
                     "of struts");
        });
    scope.done();
  });
}

msq_status msq_structure_strut_graph(msq_context* context, const msq_structure* structure,
                                     const msq_struts_def* def, msq_strut_graph** graph,
                                     msq_job* job) {
  return guard([&] {
    const Call call(context, structure, def, job);
    require(graph, "graph");
    JobScope scope(call.job());
    Ref<StrutGraph> made = make_ref<StrutGraph>(call.context(), call.query(), call.job());
    scope.done();
    *graph = new_handle<msq_strut_graph>(std::move(made));
  });
}

void msq_strut_graph_retain(msq_strut_graph* graph) {
  retain(graph);
}
void msq_strut_graph_release(msq_strut_graph* graph) {
  release(graph);
}

msq_status msq_strut_graph_info(const msq_strut_graph* graph, msq_strut_graph_report* report) {
  return guard([&] {
    const StrutGraph& known = object(graph, "graph");
    msq_strut_graph_report found{};
    found.node_count = known.nodes().size();
    found.strut_count = known.ids().size();
    found.nodes = reinterpret_cast<const double*>(known.nodes().data());
    found.node_ids = reinterpret_cast<const uint64_t*>(known.node_ids().data());
    found.struts = reinterpret_cast<const uint32_t*>(known.ends().data());
    found.radii = reinterpret_cast<const double*>(known.radii().data());
    found.strut_ids = reinterpret_cast<const uint64_t*>(known.ids().data());
    found.cells = reinterpret_cast<const int32_t*>(known.cells().data());
    found.caps = reinterpret_cast<const uint8_t*>(known.caps().data());
    found.cuts = reinterpret_cast<const uint8_t*>(known.cuts().data());
    write_report(report, found, "report");
  });
}
