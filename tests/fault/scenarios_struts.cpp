// SPDX-License-Identifier: Apache-2.0
#include "scenarios.h"
#include "world.h"

namespace msq::test {

namespace {

bool has_struts(const Kind& kind) {
  for (const char* name : {"lattice", "foam", "mixed lattice", "beams", "graded foam"})
    if (kind.name == name) return true;
  return false;
}

msq_struts_def some_struts(const msq_shape* shape) {
  msq_struts_def def = make_def(msq_struts_def_init);
  for (int axis = 0; axis < 3; ++axis) def.max[axis] = 2;
  def.selection = shape ? MSQ_STRUTS_NEAR : MSQ_STRUTS_OWNED;
  def.shape = shape;
  return def;
}

int32_t count_struts(void* user, const msq_strut*, uint64_t count) {
  *static_cast<double*>(user) += static_cast<double>(count);
  return 0;
}

}  // namespace

std::vector<Scenario> strut_scenarios() {
  std::vector<Scenario> scenarios;
  for (const Kind& kind : kinds()) {
    if (!has_struts(kind)) continue;
    scenarios.push_back({"msq_structure_struts: " + kind.name, [&kind](Stage& stage) {
                           World world(stage);
                           const msq_structure* structure = kind.make(world);
                           const msq_struts_def def = some_struts(nullptr);
                           double count = 0;
                           stage.call(
                               [&] {
                                 count = 0;
                                 return msq_structure_struts(world.context, structure, &def,
                                                             count_struts, &count, nullptr);
                               },
                               [&] { require(count > 0, "there are no struts"); });
                         }});
    scenarios.push_back({"msq_structure_strut_graph: " + kind.name, [&kind](Stage& stage) {
                           World world(stage);
                           const msq_structure* structure = kind.make(world);
                           const msq_struts_def def = some_struts(world.box());
                           msq_strut_graph* graph;
                           std::vector<double> first(3);
                           stage.watch_handle(graph);
                           stage.watch_probe(first);
                           stage.call(
                               [&] {
                                 return msq_structure_strut_graph(world.context, structure, &def,
                                                                  &graph, nullptr);
                               },
                               [&] {
                                 msq_strut_graph_report report{};
                                 report.struct_size = sizeof report;
                                 require_ok(msq_strut_graph_info(graph, &report));
                                 require(report.strut_count > 0, "there are no struts");
                                 first.assign(report.nodes, report.nodes + 3);
                                 msq_strut_graph_retain(graph);
                                 msq_strut_graph_release(graph);
                                 msq_strut_graph_release(graph);
                               });
                         }});
  }
  return scenarios;
}

}  // namespace msq::test
