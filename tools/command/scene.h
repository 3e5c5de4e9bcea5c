// SPDX-License-Identifier: Apache-2.0
// The model that the command line describes.
#ifndef MSQ_COMMAND_SCENE_H
#define MSQ_COMMAND_SCENE_H

#include <string>

#include "arguments.h"
#include "failure.h"

namespace command {

struct Scene {
  Context context;
  Document document;    // of a model file; none otherwise
  Shape part;           // of a mesh file or a box; of a model file by choose_structure() alone
  Structure structure;  // of the options, or by choose_structure(); none: solid
  Model model;
  bool has_slicing = false, has_view = false;  // of the model file
};

// Makes a context by --threads, --memory and --quiet.
Context make_context(const Arguments& arguments);

// Reads operand 0: a model file, or a mesh file or a box, which the options fill.
// mesh_path: for msq model, the path by which a mesh file is opened, which its model then has.
Scene open_scene(const Arguments& arguments, const std::string* mesh_path = nullptr);

// Reads a model file alone. Options of a structure are refused.
Scene open_model_file(const Arguments& arguments);

// Sets part and structure of a model file: those of --region and --scale, or the only structure
// that there is.
void choose_structure(const Arguments& arguments, Scene& scene);

// Whether an operand names a model file, or describes a box.
bool is_model_file(const std::string& path);
bool is_box(const std::string& text);

// The structure of the options; none if there are none. bottom, top: where --radius and
// --radius-top hold. is_calibrated: radius, thickness and level may be left out.
Structure make_structure(const Arguments& arguments, msq_context* context, double bottom,
                         double top, bool is_calibrated);

// What the options describe, in a line: "foam 2, radius 0.3". "" if there is no structure.
// is_calibrated: without radius, thickness and level.
std::string describe_structure(const Arguments& arguments, bool is_calibrated = false);

// --length-scale.
msq_query_def make_query(const Arguments& arguments);

// Whether the model has bounds. One of all space has none.
bool has_bounds(const msq_model* model);

// --box, or the bounding box of the model. Throws UsageError if there is neither.
void take_box(const Arguments& arguments, const msq_model* model, double min[3], double max[3]);

}  // namespace command

#endif
