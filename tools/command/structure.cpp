// SPDX-License-Identifier: Apache-2.0
// The structure that the options describe.
#include <algorithm>
#include <span>

#include "scene.h"
#include "text.h"

namespace command {

namespace {

// What --radius is while a structure is calibrated, where it does not count: a share of the cell.
constexpr double ANY_RADIUS = 0.1;

// Each kind of structure, with the option that selects it and those that it takes.
struct Kind {
  std::string_view option;
  std::span<const std::string_view> takes;
};
constexpr std::string_view FOAM_TAKES[] = {"radius", "radius-top", "thickness", "density", "jitter",
                                           "seed",   "vent",       "stretch",   "weight",  "skin"};
constexpr std::string_view LATTICE_TAKES[] = {"cell", "radius", "radius-top", "skin"};
constexpr std::string_view FUNCTION_TAKES[] = {"cell", "thickness", "level", "sheet", "skin"};
constexpr std::string_view WAVES_TAKES[] = {"level", "sheet", "volume-fraction", "count", "cones",
                                            "seed",  "skin"};
constexpr Kind KINDS[] = {{"foam", FOAM_TAKES},
                          {"lattice", LATTICE_TAKES},
                          {"function", FUNCTION_TAKES},
                          {"expression", FUNCTION_TAKES},
                          {"waves", WAVES_TAKES}};

bool takes(const Kind& kind, std::string_view option) {
  for (const std::string_view one : kind.takes) {
    if (one == option) return true;
  }
  return option == kind.option;
}

std::string dashed(std::string_view option) {
  return "--" + std::string(option);
}

// The kind that the options select; NULL if there is none. Refuses options of another kind.
const Kind* find_kind(const Arguments& arguments) {
  const Kind* found = nullptr;
  for (const Kind& kind : KINDS) {
    if (!arguments.has(kind.option)) continue;
    if (found) arguments.refuse(kind.option, "does not go with " + dashed(found->option));
    found = &kind;
  }
  for (const Kind& kind : KINDS) {
    for (const std::string_view option : kind.takes) {
      if (!arguments.has(option)) continue;
      if (!found) {
        arguments.refuse(
            option, "needs a structure: --foam, --lattice, --function, --expression or --waves");
      }
      if (!takes(*found, option)) {
        arguments.refuse(option, "does not go with " + dashed(found->option));
      }
    }
  }
  return found;
}

void require_one(const Arguments& arguments, std::string_view kind, std::string_view option) {
  if (!arguments.has(option)) arguments.refuse(kind, "needs " + dashed(option));
}

// --radius and --radius-top. The field must live until the structure is made.
msq_param make_radius(const Arguments& arguments, msq_context* context, double bottom, double top,
                      double otherwise, Field& field) {
  const msq_param radius = {arguments.number("radius", otherwise), nullptr};
  if (!arguments.has("radius-top")) return radius;
  require_one(arguments, "radius-top", "radius");
  const double from[3] = {0, 0, bottom}, to[3] = {0, 0, top};
  check(msq_field_gradient(context, from, radius.value, to, arguments.number("radius-top", 0),
                           field.out()),
        "--radius-top");
  return {0, field.get()};
}

// Options whose values a calibration replaces.
bool is_parameter(std::string_view option) {
  return option == "radius" || option == "thickness" || option == "level" ||
         option == "volume-fraction";
}

struct Place {
  msq_context* context;
  double bottom, top;
  bool is_calibrated;
};

Structure make_foam(const Arguments& arguments, const Place& place) {
  const bool has_walls = arguments.has("thickness");
  if (!has_walls && !place.is_calibrated) require_one(arguments, "foam", "radius");
  auto def = defaults(msq_foam_def_init);
  arguments.sizes("foam", def.grid.cell_size);
  Field field;
  def.radius = make_radius(arguments, place.context, place.bottom, place.top,
                           has_walls ? 0 : ANY_RADIUS * def.grid.cell_size[0], field);
  def.wall_thickness.value = arguments.number("thickness", 0);
  def.density.value = arguments.number("density", 1);
  if (!(def.density.value >= 1)) {
    arguments.refuse("density", arguments.text("density") + " is below 1 seed in a cell");
  }
  def.jitter = arguments.number("jitter", 1);
  def.seed = arguments.count("seed", 0);
  def.vent_radius.value = arguments.number("vent", 0);
  if (arguments.has("stretch")) arguments.sizes("stretch", def.stretch);
  def.weight = arguments.number("weight", 0);
  Structure structure;
  check(msq_structure_foam(place.context, &def, structure.out()), "--foam");
  return structure;
}

Structure make_lattice(const Arguments& arguments, const Place& place) {
  require_one(arguments, "lattice", "cell");
  if (!place.is_calibrated) require_one(arguments, "lattice", "radius");
  auto def = defaults(msq_lattice_def_init);
  def.unit_cell = MSQ_UNIT_CELL_CUBIC + static_cast<int32_t>(arguments.word("lattice"));
  arguments.sizes("cell", def.grid.cell_size);
  Field field;
  def.radius = make_radius(arguments, place.context, place.bottom, place.top,
                           ANY_RADIUS * def.grid.cell_size[0], field);
  Structure structure;
  check(msq_structure_lattice(place.context, &def, structure.out()), "--lattice");
  return structure;
}

Structure make_surface(const Arguments& arguments, const Place& place, std::string_view option) {
  require_one(arguments, option, "cell");
  const bool is_sheet = arguments.has("sheet") || arguments.has("thickness");
  if (arguments.has("level") && arguments.has("thickness")) {
    arguments.refuse("thickness", "does not go with --level");
  }
  if (arguments.has("sheet") && !arguments.has("level") && !arguments.has("thickness") &&
      !place.is_calibrated) {
    arguments.refuse("sheet", "needs --level or --thickness");
  }
  auto def = defaults(msq_functional_def_init);
  if (option == "expression") {
    def.function = MSQ_FUNCTION_EXPRESSION;
    def.expression = arguments.text("expression").c_str();
  } else {
    def.function = MSQ_FUNCTION_GYROID + static_cast<int32_t>(arguments.word("function"));
  }
  arguments.sizes("cell", def.grid.cell_size);
  if (is_sheet) def.kind = MSQ_FUNCTIONAL_SHEET;
  def.thickness.value = arguments.number("thickness", 0);
  const bool needs_level = is_sheet && !arguments.has("thickness");
  def.level.value = arguments.number("level", needs_level ? ANY_RADIUS : 0);
  Structure structure;
  check(msq_structure_functional(place.context, &def, structure.out()), dashed(option));
  return structure;
}

Structure make_waves(const Arguments& arguments, const Place& place) {
  if (arguments.has("level") && arguments.has("volume-fraction")) {
    arguments.refuse("volume-fraction", "does not go with --level");
  }
  const bool has_level = arguments.has("level") || arguments.has("volume-fraction");
  if (arguments.has("sheet") && !has_level && !place.is_calibrated) {
    arguments.refuse("sheet", "needs --level or --volume-fraction");
  }
  auto def = defaults(msq_waves_def_init);
  arguments.sizes("waves", def.grid.cell_size);
  if (arguments.has("sheet")) def.kind = MSQ_FUNCTIONAL_SHEET;
  def.level.value =
      arguments.number("level", arguments.has("sheet") && !has_level ? ANY_RADIUS : 0);
  def.volume_fraction = arguments.number("volume-fraction", 0);
  if (arguments.has("volume-fraction") && def.volume_fraction == 0) {
    arguments.refuse("volume-fraction", "0 is not above 0");
  }
  def.seed = arguments.count("seed", 0);
  def.count = static_cast<uint32_t>(arguments.count("count", def.count, UINT32_MAX));
  if (arguments.has("cones")) {
    const std::vector<double> angles = arguments.numbers("cones", {3});
    std::copy(angles.begin(), angles.end(), def.cone_angles);
  }
  Structure structure;
  check(msq_structure_waves(place.context, &def, structure.out()), "--waves");
  return structure;
}

}  // namespace

Structure make_structure(const Arguments& arguments, msq_context* context, double bottom,
                         double top, bool is_calibrated) {
  const Kind* kind = find_kind(arguments);
  const Place place = {context, bottom, top, is_calibrated};
  if (!kind) return {};
  if (kind->option == "foam") return make_foam(arguments, place);
  if (kind->option == "lattice") return make_lattice(arguments, place);
  if (kind->option == "waves") return make_waves(arguments, place);
  return make_surface(arguments, place, kind->option);
}

std::string describe_structure(const Arguments& arguments, bool is_calibrated) {
  const Kind* kind = find_kind(arguments);
  if (!kind) return "";
  std::string text(kind->option);
  text += " " + arguments.text(kind->option);
  const bool is_foam = kind->option == "foam";
  for (const std::string_view option : kind->takes) {
    if (!arguments.has(option)) continue;
    if (is_calibrated && is_parameter(option)) {
      // Its value does not count. That it is there tells sheets from networks.
      if (option == "thickness" && !is_foam && !arguments.has("sheet")) text += ", sheet";
      continue;
    }
    text += ", " + std::string(option);
    if (!arguments.text(option).empty()) text += " " + arguments.text(option);
  }
  return text;
}

}  // namespace command
