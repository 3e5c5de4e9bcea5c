// SPDX-License-Identifier: Apache-2.0
// Bytes of mesh files in every format that msq reads. The first byte selects the format, the second
// the winding rule.
#include <cmath>

#include "agree.h"

namespace msq::fuzz {

void run_mesh(const uint8_t* data, size_t size) {
  Input input(data, size);
  msq_file_def def = make_def(msq_file_def_init);
  def.format = 1 + static_cast<int32_t>(input.below(7));
  def.winding_rule = static_cast<int32_t>(input.below(4));
  def.max_bytes = 1 << 20;
  def.max_triangles = 4096;
  const std::string_view bytes = input.rest();
  const Owner<msq_context> context = make_context();
  const Job job;
  const Owner<msq_shape> shape = make<msq_shape>("msq_shape_from_memory", [&](msq_shape** s) {
    return msq_shape_from_memory(context.get(), bytes.data(), bytes.size(), &def, s, job);
  });
  if (!shape) return;
  msq_shape_report report{};
  report.struct_size = sizeof report;
  if (!MSQ_FUZZ(msq_shape_info, shape.get(), &report)) wrong("a shape has no report");
  if (!report.is_mesh || report.triangles == 0 || report.triangles > def.max_triangles ||
      report.vertices < 3)
    wrong("a mesh of %zu triangles", static_cast<size_t>(report.triangles));
  double size_of_mesh = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(report.min[axis]) || !(report.min[axis] <= report.max[axis]))
      wrong("bounds %g to %g", report.min[axis], report.max[axis]);
    size_of_mesh = std::fmax(size_of_mesh, report.max[axis] - report.min[axis]);
  }
  if (report.closed && report.open_edges) wrong("a closed mesh with open edges");
  uint64_t pairs;
  (void)MSQ_FUZZ(msq_shape_self_intersections, shape.get(), &pairs, job);

  msq_scale_def scale = {};
  scale.shape = shape.get();
  msq_model_def model_def = make_def(msq_model_def_init);
  model_def.scales = &scale;
  model_def.scale_count = 1;
  const Owner<msq_model> model = make<msq_model>("msq_model_create", [&](msq_model** m) {
    return msq_model_create(context.get(), &model_def, m);
  });
  if (!model) return;
  Sight sight;
  sight.unit = size_of_mesh > 1e-60 && size_of_mesh < 1e60 ? size_of_mesh : 1;
  sight.part = 0.25;
  Input numbers(data, size < 64 ? size : 64);
  check_model(numbers, context.get(), model.get(), sight, job);
}

}  // namespace msq::fuzz
