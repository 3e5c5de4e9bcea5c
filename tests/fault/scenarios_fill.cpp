// SPDX-License-Identifier: Apache-2.0
#include "scenarios.h"
#include "world.h"

namespace msq::test {

namespace {

const int64_t corners[4][2] = {{0, 0}, {4000, 100}, {3900, 3000}, {100, 2900}};
const int64_t hole[3][2] = {{1500, 1000}, {2500, 1200}, {1700, 2000}};
const msq_ring rings[2] = {{corners, 4}, {hole, 3}};

void fill(Stage& stage, World& world, const msq_structure* structure) {
  msq_fill_def def = make_def(msq_fill_def_init);
  def.rings = rings;
  def.ring_count = 2;
  def.scale = 1e-3;
  def.z = 0.7;
  def.pair_distance = 0.05;
  def.corner_distance = 0.05;
  msq_fill* made;
  std::vector<int64_t> first(4);
  stage.watch_handle(made);
  stage.watch_probe(first);
  stage.call([&] { return msq_fill_lines(world.context, structure, &def, &made, nullptr); },
             [&] {
               msq_fill_report report{};
               report.struct_size = sizeof report;
               require_ok(msq_fill_info(made, &report));
               require(report.point_count >= 2, "there are no points");
               const auto* points = static_cast<const int64_t*>(report.points);
               first.assign(points, points + 4);
               msq_fill_retain(made);
               msq_fill_release(made);
               msq_fill_release(made);
             });
}

}  // namespace

std::vector<Scenario> fill_scenarios() {
  std::vector<Scenario> scenarios;
  for (const Kind& kind : kinds()) {
    const std::string& name = kind.name;
    if (name.find("foam") == std::string::npos && name != "gyroid" &&
        name != "turned sheet of a thickness" && name != "waves" && name != "plate lattice" &&
        name != "plates and struts" && name != "host function" && name != "stretched walls" &&
        name != "warped gyroid")
      continue;
    scenarios.push_back({"msq_fill_lines: " + kind.name, [&kind](Stage& stage) {
                           World world(stage);
                           fill(stage, world, kind.make(world));
                         }});
  }
  scenarios.push_back({"msq_fill_lines: foam without a lattice", [](Stage& stage) {
                         World world(stage);
                         const msq_structure* members[2] = {};
                         for (const Kind& kind : kinds()) {
                           if (kind.name == "foam") members[0] = kind.make(world);
                           if (kind.name == "lattice") members[1] = kind.make(world);
                         }
                         msq_structure* made;
                         require_ok(
                             msq_structure_boolean(MSQ_BOOLEAN_DIFFERENCE, members, 2, &made));
                         fill(stage, world, world.keep(made));
                       }});
  scenarios.push_back({"msq_fill_calibrate", [](Stage& stage) {
                         World world(stage);
                         for (const Kind& kind : kinds()) {
                           if (kind.name != "gyroid") continue;
                           const msq_structure* structure = kind.make(world);
                           std::vector<double> cell(3);
                           stage.watch(cell);
                           stage.call([&] {
                             return msq_fill_calibrate(world.context, structure, 0.4, 0.2,
                                                       cell.data(), nullptr);
                           });
                         }
                       }});
  return scenarios;
}

}  // namespace msq::test
