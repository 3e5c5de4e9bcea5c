// SPDX-License-Identifier: Apache-2.0
// msq info: describes a part, a model or this program.
#include "report.h"
#include "scene.h"
#include "text.h"
#include "watch.h"

namespace command {

namespace {

Report build() {
  msq_build_report found = {};
  found.struct_size = sizeof found;
  check(msq_build_info(&found));
  Report report;
  report.add("version", std::to_string(found.version / 10000) + "." +
                            std::to_string(found.version / 100 % 100) + "." +
                            std::to_string(found.version % 100));
  report.add("licence", found.licence);
  report.add("instructions", found.simd);
  report.add("all_mesh_files", found.with_assimp != 0);
  report.add("self_intersections", found.with_cgal != 0);
  report.add("hashes", found.with_xxhash != 0);
  report.add("model_files", found.with_json != 0);
  report.add("tiff_files", found.with_tiff != 0);
  return report;
}

Report diagnosis(const msq_shape* shape, const msq_shape_report& found, bool with_intersections) {
  Report report;
  report.add("vertices", found.vertices);
  report.add("triangles", found.triangles);
  report.add("closed", found.closed != 0);
  report.add("open_edges", found.open_edges);
  report.add("flipped_edges", found.flipped_edges);
  report.add("non_manifold_edges", found.non_manifold_edges);
  report.add("degenerate_triangles", found.degenerate_triangles);
  report.add("duplicate_triangles", found.duplicate_triangles);
  if (with_intersections) {
    Work work("looking for intersections");
    uint64_t pairs = 0;
    check(msq_shape_self_intersections(shape, &pairs, work.job()), "--self-intersections");
    report.add("self_intersections", pairs);
  }
  return report;
}

// Nothing where an object has no hash or the build has none.
void add_hash(Report& report, std::string_view name, msq_status status, const uint8_t hash[16]) {
  if (status == MSQ_E_UNSUPPORTED) return;
  check(status);
  report.add(name, to_hex(hash, 16));
}

}  // namespace

void run_info(const Arguments& arguments) {
  Report report;
  if (arguments.operand(0).empty()) {
    build().print(arguments);
    return;
  }
  const Scene scene = open_scene(arguments);
  report.add("file", arguments.operand(0));
  if (scene.document) {
    msq_document_report found = {};
    found.struct_size = sizeof found;
    check(msq_document_info(scene.document.get(), &found));
    report.add("title", found.title);
    report.add("format", uint64_t{found.version});
    report.add("files", uint64_t{found.files});
    report.add("has_slicing", found.has_slicing != 0);
    report.add("has_view", found.has_view != 0);
  }
  double corners[2][3];
  check(msq_model_bounds(scene.model.get(), corners[0], corners[1]));
  const double size[3] = {corners[1][0] - corners[0][0], corners[1][1] - corners[0][1],
                          corners[1][2] - corners[0][2]};
  report.add("min", corners[0], 3);
  report.add("max", corners[1], 3);
  report.add("size", size, 3);
  bool has_mesh = false;
  if (scene.part) {
    msq_shape_report found = {};
    found.struct_size = sizeof found;
    check(msq_shape_info(scene.part.get(), &found));
    report.add("volume", found.volume);
    report.add("area", found.area);
    has_mesh = found.is_mesh != 0;
    if (has_mesh) {
      report.add("mesh", diagnosis(scene.part.get(), found, arguments.has("self-intersections")));
    }
  }
  if (arguments.has("self-intersections") && !has_mesh) {
    arguments.refuse("self-intersections", "needs a file of a mesh");
  }
  if (scene.structure) report.add("structure", describe_structure(arguments));
  std::vector<Report> scales;
  double length = 0;
  for (uint32_t i = 1; msq_model_scale_length(scene.model.get(), i, &length) == MSQ_OK; ++i) {
    Report scale;
    scale.add("scale", uint64_t{i});
    scale.add("characteristic_length", length);
    scales.push_back(std::move(scale));
  }
  if (!scales.empty()) report.add("scales", std::move(scales));
  uint8_t hash[16] = {};
  if (scene.part) {
    add_hash(report, "part_hash", msq_shape_hash(scene.part.get(), hash), hash);
  }
  if (scene.structure) {
    add_hash(report, "structure_hash", msq_structure_hash(scene.structure.get(), hash), hash);
  }
  add_hash(report, "model_hash", msq_model_hash(scene.model.get(), hash), hash);
  report.add("build", build());
  report.print(arguments);
}

}  // namespace command
