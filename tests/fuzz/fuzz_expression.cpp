// SPDX-License-Identifier: Apache-2.0
// Expressions: msq takes the texts that a second reader of the grammar takes, has the values that
// it has, and answers alike by points, layers and rays.
#include <cmath>
#include <cstring>

#include "agree.h"
#include "reference_expression.h"

namespace msq::fuzz {

namespace {

constexpr double far = 1e300;

void check_values(msq_context* context, const msq_field* field,
                  const ReferenceExpression& reference, Random& random, const Job& job) {
  constexpr size_t count = 37;
  double points[3 * count], values[count], alone;
  for (size_t i = 0; i < 3 * count; ++i) {
    const double x = random.between(-8, 8);
    points[i] = i % 7 == 0 ? std::round(x) : i % 11 == 0 ? 0.5 * std::round(2 * x) : x;
  }
  points[3] = -1e6;
  points[4] = 1e-9;
  msq_points_def array = make_def(msq_points_def_init);
  array.kind = MSQ_POINTS_ARRAY;
  array.coordinates = points;
  array.count = count;
  if (!MSQ_FUZZ(msq_field_evaluate, context, field, &array, values, count, job)) return;
  for (size_t i = 0; i < count; ++i) {
    array.coordinates = points + 3 * i;
    array.count = 1;
    if (!MSQ_FUZZ(msq_field_evaluate, context, field, &array, &alone, 1, job)) return;
    if (std::memcmp(&alone, &values[i], sizeof alone) != 0)
      wrong("value %zu of an array is %.17g, by itself %.17g", i, values[i], alone);
    const Known known = reference.at(points + 3 * i);
    if (!known.is_known) continue;
    long double expected = std::isnan(known.value) ? -static_cast<long double>(far) : known.value;
    if (std::abs(values[i]) == far && std::abs(expected) > 0.99L * far)
      continue;  // the ends of the range of the field
    if (!(std::abs(values[i] - expected) <= known.error))
      wrong("the value at (%.17g, %.17g, %.17g) is %.17g, and not %.17Lg with an error of %.3Lg",
            points[3 * i], points[3 * i + 1], points[3 * i + 2], values[i], expected, known.error);
  }
}

}  // namespace

void run_expression(const uint8_t* data, size_t size) {
  if (size > 4096 || std::memchr(data, 0, size)) return;
  const std::string text(reinterpret_cast<const char*>(data), size);
  const Owner<msq_context> context = make_context();
  const Job job;
  const msq_named_value parameters[2] = {{"a", 0.75}, {"t_2", -1.5}};
  msq_expression_field_def field_def = make_def(msq_expression_field_def_init);
  field_def.expression = text.c_str();
  field_def.parameters = parameters;
  field_def.parameter_count = 2;
  field_def.low = -far;
  field_def.high = far;
  msq_status status = MSQ_OK;
  const Owner<msq_field> field = make<msq_field>("msq_field_expression", [&](msq_field** f) {
    return status = msq_field_expression(context.get(), &field_def, f);
  });
  const ReferenceExpression reference(text, {{"a", 0.75}, {"t_2", -1.5}});
  const bool may_exceed = reference.depth() > 90 || reference.operations() > 8000;
  if (status == MSQ_E_LIMIT && !may_exceed && reference.is_valid())
    wrong("a limit was found: %s", msq_error_message());
  if (status != MSQ_OK) {
    if (status != MSQ_E_LIMIT && reference.is_valid())
      wrong("'%s' is refused: %s", text.c_str(), msq_error_message());
    return;
  }
  if (!reference.is_valid()) wrong("'%s' is taken", text.c_str());
  uint64_t seed = size;
  for (const char c : text) seed = seed * 31 + static_cast<unsigned char>(c);
  Random random(seed);
  check_values(context.get(), field.get(), reference, random, job);

  // As a structure, in cells.
  msq_functional_def def = make_def(msq_functional_def_init);
  def.function = MSQ_FUNCTION_EXPRESSION;
  def.expression = text.c_str();
  def.parameters = parameters;
  def.parameter_count = 2;
  def.clusters = 1 + static_cast<uint32_t>(seed % 6);
  def.kind = seed % 3 == 0 ? MSQ_FUNCTIONAL_SHEET : MSQ_FUNCTIONAL_NETWORK;
  def.level.value = 0.25;
  const Owner<msq_structure> structure = make<msq_structure>(
      "msq_structure_functional",
      [&](msq_structure** s) { return msq_structure_functional(context.get(), &def, s); });
  if (!structure)
    wrong("a field takes '%s', a structure does not: %s", text.c_str(), msq_error_message());
  const double low[3] = {-0.7, -0.6, -0.4}, high[3] = {1.3, 1.2, 1.6};
  const Owner<msq_shape> box = make<msq_shape>("msq_shape_from_box", [&](msq_shape** s) {
    return msq_shape_from_box(context.get(), low, high, s);
  });
  msq_scale_def scales[2] = {};
  scales[0].shape = box.get();
  scales[1].structure = structure.get();
  msq_model_def model_def = make_def(msq_model_def_init);
  model_def.scales = scales;
  model_def.scale_count = 2;
  const Owner<msq_model> model = make<msq_model>("msq_model_create", [&](msq_model** m) {
    return msq_model_create(context.get(), &model_def, m);
  });
  if (!model || job.is_cancelled()) return;
  uint8_t bytes[64];
  for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(random.word());
  Input numbers(bytes, sizeof bytes);
  Sight sight;
  sight.part = 1.0 / 16;
  check_model(numbers, context.get(), model.get(), sight, job);
}

}  // namespace msq::fuzz
