// SPDX-License-Identifier: Apache-2.0
// Slices an STL file to G-code with libslic3r, and prints as JSON how its sparse infill came out:
//
//   slice_gcode part.stl part.gcode [option=value ...]
#include "libslic3r/Format/STL.hpp"
#include "libslic3r/Model.hpp"
#include "libslic3r/Print.hpp"
#include "libslic3r/Utils.hpp"

#include <chrono>
#include <cstdio>
#include <cstring>

using namespace Slic3r;

namespace {

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Lines of sparse infill and the area that they are to fill.
void print_fills(const Print& print) {
  size_t paths = 0, layers = 0;
  double length = 0, area = 0;
  for (const PrintObject* object : print.objects())
    for (const Layer* layer : object->layers()) {
      ++layers;
      for (const LayerRegion* region : layer->regions()) {
        for (const Surface& surface : region->fill_surfaces.surfaces)
          if (surface.surface_type == stInternal)
            area += surface.area() * SCALING_FACTOR * SCALING_FACTOR;
        for (const ExtrusionEntity* fill : region->fills.entities)
          for (const ExtrusionEntity* path :
               static_cast<const ExtrusionEntityCollection*>(fill)->flatten().entities)
            if (path->role() == erInternalInfill) {
              ++paths;
              length += unscale<double>(path->length());
            }
      }
    }
  printf("{\"layers\": %zu, \"paths\": %zu, \"length_mm\": %.1f, \"area_mm2\": %.1f, ", layers,
         paths, length, area);
}

// The fills of all layers once more, on one thread: what they cost when the pattern is there.
double fill_again(Print& print) {
  const double start = seconds();
  for (PrintObject* object : print.objects())
    for (Layer* layer : object->layers()) layer->make_fills(nullptr, nullptr, nullptr);
  return seconds() - start;
}

void slice(const char* stl, const std::string& gcode, char** options, int option_count) {
  TriangleMesh mesh;
  if (!mesh.ReadSTLFile(stl) || mesh.facets_count() == 0)
    throw RuntimeError(std::string("cannot read ") + stl);
  Model model;
  ModelObject* object = model.add_object("part", "", mesh);
  object->add_instance();
  object->ensure_on_bed();
  object->instances.front()->set_offset(
      Vec3d(100, 100, object->instances.front()->get_offset().z()));

  DynamicPrintConfig config = DynamicPrintConfig::full_print_config();
  for (int i = 0; i < option_count; ++i) {
    const char* is = strchr(options[i], '=');
    if (is == nullptr) throw RuntimeError(std::string(options[i]) + " is not option=value");
    config.set_deserialize_strict(std::string(options[i], size_t(is - options[i])), is + 1);
  }
  Print print;
  print.set_status_silent();
  print.apply(model, config);
  if (const std::string error = print.validate(); !error.empty()) throw RuntimeError(error);
  const double start = seconds();
  print.process();
  const double process = seconds() - start;
  print_fills(print);
  printf("\"process_s\": %.3f, \"fill_s\": %.4f, ", process, fill_again(print));
  GCodeProcessorResult result;
  print.export_gcode(gcode, &result, nullptr);
  const auto& normal = result.print_statistics.modes.front();
  printf("\"print_s\": %.1f, \"roles_s\": {", double(normal.time));
  const char* comma = "";
  for (const auto& [role, time] : normal.roles_times) {
    printf("%s\"%s\": %.1f", comma, ExtrusionEntity::role_to_string(role).c_str(), double(time));
    comma = ", ";
  }
  puts("}}");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    fputs("slice_gcode part.stl part.gcode [option=value ...]\n", stderr);
    return 2;
  }
  try {
    set_resources_dir(".");
    set_data_dir(".");
    slice(argv[1], argv[2], argv + 3, argc - 3);
  } catch (const std::exception& error) {
    fprintf(stderr, "slice_gcode: %s\n", error.what());
    return 1;
  }
  return 0;
}
