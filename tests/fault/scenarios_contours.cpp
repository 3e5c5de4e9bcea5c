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
           msq_contours_def def = coarse();
           if (kind.name == std::string("foam"))
             def.tolerance = def.pitch / 16;  // gaps are followed
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
         msq_contours_def def = coarse();
         def.topology_samples = 2;
         def.tolerance = def.pitch / 16;  // gaps are followed
         msq_contours* contours;
         std::vector<double> first(4);
         stage.watch_handle(contours);
         stage.watch_probe(first);
         stage.call([&] { return msq_slicer_contours(slicer, 1, &def, &contours, nullptr); },
                    [&] { read_points(contours, first); });
       }});
  // Layers normal to x of bits, contours and distances.
  const auto several = [](const msq_model* model, msq_slicer** slicer) {
    const msq_contours_def rings = coarse();
    msq_output_def outputs[3];
    for (msq_output_def& output : outputs) output = make_def(msq_output_def_init);
    outputs[1].output = MSQ_LAYER_CONTOURS;
    outputs[1].contours = &rings;
    outputs[2].output = MSQ_LAYER_DISTANCE;
    msq_slicer_def def = make_def(msq_slicer_def_init);
    def.resolution[0] = def.resolution[1] = 20;
    def.layer_height = 0.9;
    def.slab_layers = 2;
    def.outputs = outputs;
    def.output_count = 3;
    def.frame_axes[1] = def.frame_axes[5] = def.frame_axes[6] = 1;
    return msq_slicer_create(model, &def, slicer);
  };
  scenarios.push_back({"msq_slicer_create with several outputs", [=](Stage& stage) {
                         World world(stage);
                         msq_model* model = world.model(world.box(), kinds()[0].make(world));
                         msq_slicer* slicer;
                         stage.watch_handle(slicer);
                         stage.call([&] { return several(model, &slicer); },
                                    [&] { msq_slicer_release(slicer); });
                       }});
  scenarios.push_back({"msq_slicer_run of several outputs", [=](Stage& stage) {
                         World world(stage);
                         msq_model* model = world.model(world.box(), kinds()[0].make(world));
                         msq_slicer* slicer;
                         require_ok(several(model, &slicer));
                         world.keep(slicer);
                         std::vector<uint64_t> points(plan_of(slicer).layer_count);
                         stage.watch_part(points);
                         stage.call([&] {
                           return msq_slicer_run(
                               slicer, 0, UINT64_MAX,
                               [](void* user, const msq_layer* layer) -> int32_t {
                                 msq_contours_report report{};
                                 report.struct_size = sizeof report;
                                 if (msq_contours_info(layer->outputs[1]->contours, &report) !=
                                     MSQ_OK)
                                   return -1;
                                 static_cast<uint64_t*>(user)[layer->index] = report.point_count;
                                 return 0;
                               },
                               points.data(), nullptr);
                         });
                       }});
  return scenarios;
}

}  // namespace msq::test
