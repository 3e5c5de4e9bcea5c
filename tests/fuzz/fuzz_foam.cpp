// SPDX-License-Identifier: Apache-2.0
// Foams by all methods: DIRECT, METHOD_1 and METHOD_2 against the definition, which POINT
// evaluates.
#include "objects.h"

namespace msq::fuzz {

void run_foam(const uint8_t* data, size_t size) {
  Input input(data, size);
  const Owner<msq_context> context = make_context();
  const Job job;
  Maker maker(input, context.get(), job);
  msq_foam_def def = make_def(msq_foam_def_init);
  def.grid = maker.grid();
  const double unit = maker.sight().unit;
  def.seed = input.word(8);
  // METHOD_2 may differ below 0.01, by its definition.
  static constexpr double jitters[] = {1, 1, 0.5, 0.1, 0.01, 0.013, 0.25, 0.9};
  def.jitter = jitters[input.below(8)];
  def.radius.value = unit * input.between(0.001, 0.6);
  const Owner<msq_field> field = input.chance(80) ? maker.field(0, 0.4 * unit) : nullptr;
  def.radius.field = field.get();

  msq_points_def grid = make_def(msq_points_def_init), array = grid;
  grid.kind = MSQ_POINTS_GRID;
  array.kind = MSQ_POINTS_ARRAY;
  uint64_t count = 1;
  const double cells = input.between(0.2, 1.6);
  for (int axis = 0; axis < 3; ++axis) {
    grid.counts[axis] = 1 + input.below(axis == 0 ? 16 : 5);
    count *= grid.counts[axis];
    grid.spacing[axis] = input.chance(80)
                             ? unit / (1 + input.below(16))
                             : 2 * cells * unit / static_cast<double>(grid.counts[axis]);
    grid.origin[axis] = maker.sight().at[axis] - (input.chance(80) ? 0 : cells * unit);
  }
  std::vector<double> points(3 * count);
  if (!MSQ_FUZZ(msq_points_generate, &grid, 0, count, points.data())) return;
  array.coordinates = points.data();
  array.count = count;

  std::vector<uint8_t> truth;
  for (const int32_t method :
       {MSQ_FOAM_POINT, MSQ_FOAM_DIRECT, MSQ_FOAM_METHOD_1, MSQ_FOAM_METHOD_2, MSQ_FOAM_AUTO}) {
    def.method = method;
    const Owner<msq_structure> foam = make<msq_structure>(
        "msq_structure_foam",
        [&](msq_structure** s) { return msq_structure_foam(context.get(), &def, s); });
    if (!foam && method == MSQ_FOAM_METHOD_2) continue;  // a build without CGAL
    if (!foam) return;
    const Owner<msq_model> model = maker.model_of(foam.get(), 8);
    if (!model) return;
    if (method == MSQ_FOAM_POINT) {
      for (uint64_t i = 0; i < count; ++i) {
        int32_t inside;
        if (!MSQ_FUZZ(msq_point_membership, model.get(), &points[3 * i], nullptr, &inside)) return;
        truth.push_back(static_cast<uint8_t>(inside));
      }
    }
    for (const msq_points_def* set : {&grid, &array}) {
      std::vector<uint8_t> inside(count, 9);
      if (!MSQ_FUZZ(msq_set_membership, model.get(), set, nullptr, inside.data(), count, job) ||
          job.is_cancelled())
        return;
      for (uint64_t i = 0; i < count; ++i)
        if (inside[i] != truth[i])
          wrong("method %d, %s: (%.17g, %.17g, %.17g) is %d, by itself %d", method,
                set == &grid ? "grid" : "array", points[3 * i], points[3 * i + 1],
                points[3 * i + 2], inside[i], truth[i]);
    }
  }
}

}  // namespace msq::fuzz
