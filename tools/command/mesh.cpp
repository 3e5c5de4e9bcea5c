// SPDX-License-Identifier: Apache-2.0
// msq mesh: writes a preview mesh.
#include "output_file.h"
#include "scene.h"
#include "text.h"
#include "watch.h"

namespace command {

void run_mesh(const Arguments& arguments) {
  arguments.require("output");
  arguments.require("pitch");
  const std::string path = arguments.text("output");
  int32_t format = 0;
  if (ending(path) == ".stl") format = MSQ_SURFACE_STL;
  if (ending(path) == ".ply") format = MSQ_SURFACE_PLY;
  if (format == 0) arguments.refuse("output", "'" + path + "' ends neither in .stl nor in .ply");
  auto def = defaults(msq_surface_def_init);
  def.pitch = arguments.number("pitch", 0);
  def.length_scale = arguments.number("length-scale", 0);

  const Scene scene = open_scene(arguments);
  if (arguments.has("box") || !has_bounds(scene.model.get())) {
    def.has_box = 1;
    take_box(arguments, scene.model.get(), def.min, def.max);
  }
  Work work("meshing");
  check_io(msq_io_surface_save(scene.model.get(), &def, format, path.c_str(), 1, work.job()));
}

}  // namespace command
