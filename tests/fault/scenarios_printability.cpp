// SPDX-License-Identifier: Apache-2.0
#include "scenarios.h"
#include "world.h"

namespace msq::test {

namespace {

int32_t count_findings(void* user, const msq_finding*, uint64_t count) {
  *static_cast<uint64_t*>(user) += count;
  return 0;
}

}  // namespace

std::vector<Scenario> printability_scenarios() {
  return {{"msq_printability", [](Stage& stage) {
             World world(stage);
             const msq_slicer* slicer =
                 world.slicer(world.model(world.mesh(), kinds()[0].make(world)));
             msq_printability_def def = make_def(msq_printability_def_init);
             def.kinds = MSQ_FINDING_ISLAND | MSQ_FINDING_LOOSE | MSQ_FINDING_VOID |
                         MSQ_FINDING_THIN | MSQ_FINDING_CUP | MSQ_FINDING_OVERHANG;
             def.overhang = plan_of(slicer).pitch[0];
             def.width = 2.5 * plan_of(slicer).pitch[1];
             msq_printability_report report{};
             report.struct_size = sizeof report;
             uint64_t count = 0;
             stage.call(
                 [&] {
                   count = 0;
                   return msq_printability(slicer, &def, count_findings, &count, &report, nullptr);
                 },
                 [&] {
                   require(report.island_count > 0, "there are no islands");
                   require(count >= report.island_count, "findings are missing");
                 });
           }}};
}

}  // namespace msq::test
