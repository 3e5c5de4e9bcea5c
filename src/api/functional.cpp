// SPDX-License-Identifier: Apache-2.0
// Functional structures.
#include "structure/functional/functional.h"

#include "api/guard.h"
#include "api/neighbourhood.h"
#include "expression/parser.h"
#include "structure/functional/presets.h"

using namespace msq;
using namespace msq::api;

namespace {

constexpr uint64_t most_parameters = 1024;

msq_functional_def functional_defaults() {
  msq_functional_def def{};
  def.function = MSQ_FUNCTION_GYROID;
  def.kind = MSQ_FUNCTIONAL_NETWORK;
  def.grid = neighbourhood_defaults();
  return def;
}

Tape read_function(const msq_functional_def& def) {
  const int32_t preset =
      require_range(def.function, MSQ_FUNCTION_EXPRESSION, MSQ_FUNCTION_SPLIT_P, "function");
  if (preset != MSQ_FUNCTION_EXPRESSION) {
    if (def.expression) fail(Status::argument, "expression is given, but function is %d", preset);
    if (def.parameter_count)
      fail(Status::argument, "parameters are given, but function is %d", preset);
    return parse_expression(preset_expressions[preset - 1], {});
  }
  require(def.expression, "expression");
  if (def.parameter_count > most_parameters)
    fail(Status::argument, "parameter_count is %llu; the limit is %llu",
         static_cast<unsigned long long>(def.parameter_count),
         static_cast<unsigned long long>(most_parameters));
  if (def.parameter_count) require(def.parameters, "parameters");
  std::vector<NamedValue> parameters;
  for (uint64_t i = 0; i < def.parameter_count; ++i) {
    const char* name = def.parameters[i].name;
    if (!name)
      fail(Status::argument, "the name of parameter %llu is NULL",
           static_cast<unsigned long long>(i));
    // No more of a name is looked at than could stand in an expression.
    parameters.push_back({std::string(name, strnlen(name, most_expression_bytes)),
                          require_finite(def.parameters[i].value, "the value of a parameter")});
  }
  const std::string_view text(def.expression, strnlen(def.expression, most_expression_bytes + 1));
  return parse_expression(text, parameters);
}

Parameter read_level(const msq_param& level, FunctionalKind kind) {
  Parameter read;
  if (level.field)
    read = Parameter(Ref<const Field>(&object(level.field, "level.field")));
  else
    read = Parameter(require_finite(level.value, "level"));
  const Interval range = read.range();
  if (kind == FunctionalKind::sheet && !(range.low >= 0 && range.high > 0))
    fail(Status::argument,
         "level runs from %g to %g; that of a sheet must not be negative, nor 0 everywhere",
         range.low, range.high);
  return read;
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
    const msq_functional_def known = read_def(def, functional_defaults(), "def");
    const Neighbourhood grid = read_neighbourhood(known.grid);
    const FunctionalKind kind = static_cast<FunctionalKind>(
        require_range(known.kind, MSQ_FUNCTIONAL_NETWORK, MSQ_FUNCTIONAL_SHEET, "kind"));
    if (known.clusters > uint32_t{most_clusters})
      fail(Status::argument, "clusters is %u; it must be from 0 to %d", known.clusters,
           most_clusters);
    const Tape function = read_function(known);
    *structure = new_handle<msq_structure>(Ref<Structure>(make_ref<Functional>(
        grid, function, kind, read_level(known.level, kind), static_cast<int>(known.clusters))));
  });
}
