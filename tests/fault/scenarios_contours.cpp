// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <initializer_list>

#include "scenarios.h"
#include "world.h"

namespace msq::test {

namespace {

void read_points(msq_contours* contours, std::vector<double>& first) {
  msq_contours_report report{};
  report.struct_size = sizeof report;
  require_ok(msq_contours_info(contours, &report));
  require(report.point_count >= 2, "there are no points");
  const auto* points = static_cast<const double*>(report.points);
  first.assign(points, points + 4);
  msq_contours_retain(contours);
  msq_contours_release(contours);
  msq_contours_release(contours);
}

msq_contours_def coarse() {
  msq_contours_def def = make_def(msq_contours_def_init);
  def.tolerance = def.pitch = 0.1;
  return def;
}

}  // namespace

std::vector<Scenario> contour_scenarios() {
  std::vector<Scenario> scenarios;
  for (const Kind& kind : kinds()) {
    const auto is_one_of = [&](std::initializer_list<const char*> names) {
      return std::find(names.begin(), names.end(), kind.name) != names.end();
    };
    if (!is_one_of({"foam", "gyroid", "mixed lattice", "foam of walls", "beams"})) continue;
    scenarios.push_back(
        {"msq_layer_contours: " + kind.name, [&kind](Stage& stage) {
           World world(stage);
           const msq_model* model = world.model(world.box(), kind.make(world));
           const msq_contours_def def = coarse();
           msq_contours* contours;
           std::vector<double> first(4);
           stage.watch_handle(contours);
           stage.watch_probe(first);
           stage.call([&] { return msq_layer_contours(model, 0.7, &def, &contours, nullptr); },
                      [&] { read_points(contours, first); });
         }});
  }
  scenarios.push_back(
      {"msq_slicer_contours", [](Stage& stage) {
         World world(stage);
         msq_model* model = world.model(world.box(), kinds()[0].make(world));
         const msq_slicer* slicer = world.slicer(model, false);
         const msq_contours_def def = coarse();
         msq_contours* contours;
         std::vector<double> first(4);
         stage.watch_handle(contours);
         stage.watch_probe(first);
         stage.call([&] { return msq_slicer_contours(slicer, 1, &def, &contours, nullptr); },
                    [&] { read_points(contours, first); });
       }});
  return scenarios;
}

}  // namespace msq::test
