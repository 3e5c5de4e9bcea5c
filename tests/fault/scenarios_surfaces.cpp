// SPDX-License-Identifier: Apache-2.0
#include "scenarios.h"
#include "world.h"

namespace msq::test {

namespace {

bool is_meshed(const Kind& kind) {
  for (const char* name : {"lattice", "foam", "gyroid", "foam of walls", "beams"})
    if (kind.name == name) return true;
  return false;
}

msq_surface_def coarse() {
  msq_surface_def def = make_def(msq_surface_def_init);
  def.pitch = 0.3;
  return def;
}

int32_t count_triangles(void* user, const msq_surface_slab* slab) {
  *static_cast<uint64_t*>(user) += slab->triangle_count;
  return 0;
}

int32_t count_bytes(void* user, const msq_file_part* part) {
  *static_cast<uint64_t*>(user) += part->size;
  return 0;
}

}  // namespace

std::vector<Scenario> surface_scenarios() {
  std::vector<Scenario> scenarios;
  for (const Kind& kind : kinds()) {
    if (!is_meshed(kind)) continue;
    scenarios.push_back({"msq_surface_mesh: " + kind.name, [&kind](Stage& stage) {
                           World world(stage);
                           const msq_model* model = world.model(world.box(), kind.make(world));
                           const msq_surface_def def = coarse();
                           uint64_t count = 0;
                           stage.call(
                               [&] {
                                 count = 0;
                                 return msq_surface_mesh(model, &def, count_triangles, &count,
                                                         nullptr);
                               },
                               [&] { require(count > 0, "there are no triangles"); });
                         }});
  }
  scenarios.push_back({"msq_surface_file", [](Stage& stage) {
                         World world(stage);
                         const msq_model* model = world.model(world.box(), kinds()[0].make(world));
                         const msq_surface_def def = coarse();
                         uint64_t bytes = 0;
                         stage.call(
                             [&] {
                               bytes = 0;
                               return msq_surface_file(model, &def, MSQ_SURFACE_PLY, count_bytes,
                                                       &bytes, nullptr);
                             },
                             [&] { require(bytes > 1000, "there are no bytes"); });
                       }});
  return scenarios;
}

}  // namespace msq::test
