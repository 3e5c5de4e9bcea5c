// SPDX-License-Identifier: Apache-2.0
// msq calibrate: finds the parameter of a volume fraction.
#include "report.h"
#include "scene.h"
#include "watch.h"

namespace command {

namespace {

// What the parameter is that msq_structure_calibrate varies.
std::string_view parameter_of(const Arguments& arguments) {
  for (const char* option : {"function", "expression", "waves"}) {
    if (arguments.has(option)) return "level";
  }
  return arguments.has("thickness") ? "thickness" : "radius";
}

Scene open_file(const Arguments& arguments) {
  if (!is_model_file(arguments.operand(0))) {
    throw UsageError("msq calibrate takes a model file (.json) or options, and '" +
                     arguments.operand(0) + "' is none");
  }
  Scene scene = open_model_file(arguments);
  choose_structure(arguments, scene);
  return scene;
}

Scene make_scene(const Arguments& arguments) {
  for (const char* option : {"any-files", "region", "scale"}) {
    if (arguments.has(option)) arguments.refuse(option, "is for model files");
  }
  Scene scene;
  scene.context = make_context(arguments);
  scene.structure = make_structure(arguments, scene.context.get(), 0, 0, true);
  if (!scene.structure) {
    throw UsageError(
        "msq calibrate needs --foam, --lattice, --function, --expression, --waves or a model file");
  }
  return scene;
}

}  // namespace

void run_calibrate(const Arguments& arguments) {
  arguments.require("fraction");
  const double target = arguments.number("fraction", 0);
  const uint64_t pairs = arguments.count("curve", 0);
  if (pairs == 1 || pairs > (1 << 20)) {
    arguments.refuse("curve", arguments.text("curve") + " is not 0 or from 2 to 1048576");
  }
  for (const char* option : {"skin", "radius-top"}) {
    if (arguments.has(option)) arguments.refuse(option, "has no meaning here");
  }
  if (arguments.has("foam") && arguments.has("radius") && arguments.has("thickness")) {
    arguments.refuse("thickness",
                     "does not go with --radius here; a foam of struts and walls has two "
                     "parameters");
  }
  const bool has_file = !arguments.operand(0).empty();
  const Scene scene = has_file ? open_file(arguments) : make_scene(arguments);
  std::vector<double> parameters(pairs), fractions(pairs);
  msq_calibration_report found = {};
  found.struct_size = sizeof found;
  {
    Work work("calibrating");
    check(msq_structure_calibrate(scene.context.get(), scene.structure.get(), nullptr, target,
                                  pairs ? parameters.data() : nullptr,
                                  pairs ? fractions.data() : nullptr, pairs, &found, work.job()));
  }
  // A model file does not tell msq of which kind its structure is.
  const std::string_view name = has_file ? "parameter" : parameter_of(arguments);
  Report report;
  if (has_file) {
    report.add("file", arguments.operand(0));
  } else {
    report.add("structure", describe_structure(arguments, true));
  }
  report.add(name, found.parameter);
  report.add("volume_fraction", found.fraction.value);
  report.add("standard_error", found.fraction.standard_error);
  report.add("max_fraction", found.max_fraction);
  report.add("samples", found.samples);
  std::vector<Report> curve(pairs);
  for (size_t i = 0; i < pairs; ++i) {
    curve[i].add(name, parameters[i]);
    curve[i].add("volume_fraction", fractions[i]);
  }
  if (pairs > 0) report.add("curve", std::move(curve));
  report.print(arguments);
}

}  // namespace command
