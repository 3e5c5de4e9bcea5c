// SPDX-License-Identifier: Apache-2.0
// Functional structures.
#include "structure/functional/functional.h"

#include "api/definitions.h"
#include "api/expression.h"
#include "api/guard.h"
#include "api/level.h"
#include "api/neighbourhood.h"
#include "api/period.h"
#include "api/warp.h"
#include "expression/parser.h"
#include "field/map.h"
#include "structure/functional/graded_walls.h"
#include "structure/functional/presets.h"
#include "structure/functional/wall_thickness.h"

using namespace msq;
using namespace msq::api;

namespace {

msq_functional_def functional_defaults() {
  msq_functional_def def{};
  def.function = MSQ_FUNCTION_GYROID;
  def.kind = MSQ_FUNCTIONAL_NETWORK;
  def.grid = neighbourhood_defaults();
  return def;
}

static_assert(preset_count == MSQ_FUNCTION_RODS);

Tape read_function(const msq_functional_def& def) {
  const int32_t preset =
      require_range(def.function, MSQ_FUNCTION_EXPRESSION, MSQ_FUNCTION_RODS, "function");
  if (preset != MSQ_FUNCTION_EXPRESSION) {
    if (def.expression) fail(Status::argument, "expression is given, but function is %d", preset);
    if (def.parameter_count)
      fail(Status::argument, "parameters are given, but function is %d", preset);
    return parse_expression(preset_expressions[preset - 1], {});
  }
  return read_expression(def.expression, def.parameters, def.parameter_count);
}

bool is_given(const msq_param& parameter) {
  return parameter.field || parameter.value != 0;
}

/// The level of walls as thick as that.
Parameter read_thickness(const msq_functional_def& def, FunctionalKind kind, const Tape& function,
                         const Neighbourhood& grid, const CellShape& cells) {
  if (kind != FunctionalKind::sheet)
    fail(Status::argument, "thickness is given, but kind is %d: only sheets have walls", def.kind);
  if (is_given(def.level))
    fail(Status::argument, "both level and thickness are given; a sheet takes one of them");
  const Parameter thickness = read_parameter(def.thickness, "thickness");
  const Interval range = thickness.range();
  if (!(range.low >= 0 && range.high > 0))
    fail(Status::argument,
         "thickness runs from %g to %g; it must not be negative, nor 0 everywhere", range.low,
         range.high);
  if (cells.warp || cells.sampled)
    fail(Status::unsupported,
         "thickness is given, but the cells are warped: their widths differ everywhere. Give a "
         "level, which may be a field");
  if (cells.period) {
    if (!thickness.is_constant())
      fail(Status::unsupported,
           "thickness is a field; with a period it must be a number. A level may be a field");
    return graded_wall_level(function, grid, *cells.period, range.high);
  }
  const WallThickness walls(function, grid.cell_size);
  if (range.high > walls.most())
    fail(Status::argument, "thickness runs to %g; walls of %g fill all of the cell", range.high,
         walls.most());
  if (thickness.is_constant()) return Parameter(walls.levels()(range.high));
  return Parameter(Ref<const Field>(make_ref<MapField>(
      Ref<const Field>(&object(def.thickness.field, "thickness")), walls.levels())));
}

}  // namespace

msq_status msq_functional_def_init(msq_functional_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, functional_defaults(), "msq_functional_def"); });
}

msq_status msq_structure_functional(msq_context* context, const msq_functional_def* def,
                                    msq_structure** structure) {
  return guard([&] {
    object(context, "context");
    require(structure, "structure");
    msq_functional_def known = read_def(def, functional_defaults(), "def");
    const Neighbourhood grid = read_neighbourhood(known.grid);
    const FunctionalKind kind = static_cast<FunctionalKind>(
        require_range(known.kind, MSQ_FUNCTIONAL_NETWORK, MSQ_FUNCTIONAL_SHEET, "kind"));
    if (known.clusters > uint32_t{max_clusters})
      fail(Status::argument, "clusters is %u; it must be from 0 to %d", known.clusters,
           max_clusters);
    const Tape function = read_function(known);
    msq_period_def known_period;
    msq_warp_def known_warp;
    CellShape cells;
    cells.period = read_period(known.period, known_period);
    const CellMap map = read_warp(known.warp, known_warp, grid);
    cells.warp = map.round;
    cells.sampled = map.sampled;
    if (cells.period && map)
      fail(Status::unsupported, "both period and warp are given; a structure takes one of them");
    Parameter level = is_given(known.thickness) ? read_thickness(known, kind, function, grid, cells)
                                                : read_level(known.level, known.kind);
    const Ref<Structure> made = make_ref<Functional>(
        grid, function, kind, std::move(level), static_cast<int>(known.clusters), std::move(cells));
    keep(*made, known);
    *structure = new_handle<msq_structure>(made);
  });
}
