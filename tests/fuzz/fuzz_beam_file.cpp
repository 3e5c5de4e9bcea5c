// SPDX-License-Identifier: Apache-2.0
// 3MF files with beam lattices. The first byte tells whether the rest is the archive or the text of
// the model in it: mutations of compressed bytes would not come far.
#include <cmath>

#include "agree.h"
#include "zip.h"

namespace msq::fuzz {

namespace {

void check_lattice(msq_context* context, const msq_beam_file* file, uint64_t lattice,
                   Input& numbers, const Job& job) {
  msq_beam_file_report report{};
  report.struct_size = sizeof report;
  if (!MSQ_FUZZ(msq_beam_file_info, file, lattice, &report))
    wrong("a lattice of a file has no report");
  for (const int32_t mesh : {MSQ_BEAM_FILE_SOLID, MSQ_BEAM_FILE_CLIPPING}) {
    const bool has_mesh = mesh == MSQ_BEAM_FILE_SOLID
                              ? report.mesh_triangle_count > 0 && lattice == 0
                              : report.clipping_triangle_count > 0;
    const Owner<msq_shape> shape = make<msq_shape>("msq_beam_file_shape", [&](msq_shape** s) {
      return msq_beam_file_shape(context, file, lattice, mesh, MSQ_WINDING_AUTO, s);
    });
    if (shape && !has_mesh) wrong("a file without a mesh made a shape");
  }
  msq_beams_def def = make_def(msq_beams_def_init);
  if (!MSQ_FUZZ(msq_beam_file_beams, file, lattice, &def))
    wrong("a lattice of a file has no definition");
  if (def.node_count != report.node_count || def.beam_count != report.beam_count ||
      def.ball_count != report.ball_count)
    wrong("the definition of a lattice has other counts");
  const Owner<msq_structure> beams = make<msq_structure>(
      "msq_structure_beams",
      [&](msq_structure** s) { return msq_structure_beams(context, &def, s, job); });
  if (job.is_cancelled()) return;
  if (!beams) wrong("the beams of a file are refused: %s", msq_error_message());

  const Owner<msq_shape> space = make<msq_shape>(
      "msq_shape_all_space", [&](msq_shape** s) { return msq_shape_all_space(context, s); });
  msq_scale_def scales[2] = {};
  scales[0].shape = space.get();
  scales[1].structure = beams.get();
  msq_model_def model_def = make_def(msq_model_def_init);
  model_def.scales = scales;
  model_def.scale_count = 2;
  const Owner<msq_model> model = make<msq_model>(
      "msq_model_create", [&](msq_model** m) { return msq_model_create(context, &model_def, m); });
  if (!model) return;
  Sight sight;
  double size = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (!(report.min[axis] <= report.max[axis]))
      wrong("a box from %g to %g", report.min[axis], report.max[axis]);
    sight.at[axis] = 0.5 * report.min[axis] + 0.5 * report.max[axis];
    size = std::fmax(size, report.max[axis] - report.min[axis]);
  }
  sight.unit = size > 1e-60 && size < 1e60 ? 0.25 * size : 1;
  sight.part = 0.25;
  // What is in the solid is in the box.
  Random random(numbers.word(4));
  for (int i = 0; i < 32; ++i) {
    double p[3];
    bool is_in_box = true;
    for (int axis = 0; axis < 3; ++axis) {
      p[axis] = sight.at[axis] + random.between(-3, 3) * sight.unit;
      const double margin = 1e-9 * (std::fabs(p[axis]) + size);
      is_in_box =
          is_in_box && p[axis] >= report.min[axis] - margin && p[axis] <= report.max[axis] + margin;
    }
    int32_t inside;
    if (MSQ_FUZZ(msq_point_membership, model.get(), p, nullptr, &inside) && inside && !is_in_box)
      wrong("(%.17g, %.17g, %.17g) is inside and outside of the box of the beams", p[0], p[1],
            p[2]);
  }
  check_model(numbers, context, model.get(), sight, job);
}

}  // namespace

void run_beam_file(const uint8_t* data, size_t size) {
  Input input(data, size);
  const bool is_text = input.below(2) == 0;
  const std::string_view rest = input.rest();
  const std::string bytes = is_text ? ZipWriter::of("3D/3dmodel.model", rest) : std::string(rest);
  msq_file_def def = make_def(msq_file_def_init);
  def.format = MSQ_FORMAT_3MF;
  def.max_bytes = 1 << 20;
  def.max_triangles = 2048;
  const Owner<msq_context> context = make_context();
  const Job job;
  const Owner<msq_beam_file> file =
      make<msq_beam_file>("msq_beam_file_open_memory", [&](msq_beam_file** f) {
        return msq_beam_file_open_memory(context.get(), bytes.data(), bytes.size(), &def, f, job);
      });
  if (!file) return;
  msq_beam_file_report report{};
  report.struct_size = sizeof report;
  if (!MSQ_FUZZ(msq_beam_file_info, file.get(), 0, &report)) wrong("a file of beams has no report");
  if (report.lattice_count == 0) wrong("a file of beams without a lattice");
  Input numbers(data, size < 64 ? size : 64);
  for (uint64_t i = 0; i < report.lattice_count && i < 3 && !job.is_cancelled(); ++i)
    check_lattice(context.get(), file.get(), i, numbers, job);
}

}  // namespace msq::fuzz
