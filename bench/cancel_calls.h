// SPDX-License-Identifier: Apache-2.0
// The long calls that bench/cancel.cpp cancels, and what they need.
#pragma once

#include <algorithm>
#include <cstring>
#include <memory>
#include <string>

#include "rippled_torus.h"
#include "setup.h"
#include "varied_structures.h"

namespace bench {

constexpr uint32_t threads = 2;

/// What one call needs. Whatever a case makes is released with it.
struct Setup {
  msq_context* context = make_context(threads);
  msq_model* model = nullptr;
  msq_structure* structure = nullptr;
  std::vector<double> points, directions, values;
  std::vector<uint8_t> inside;
  std::vector<msq_ray_hit> hits;

  Setup() = default;
  Setup(const Setup&) = delete;
  Setup& operator=(const Setup&) = delete;
  ~Setup() {
    msq_model_release(model);
    msq_structure_release(structure);
    msq_context_release(context);
  }

  /// Takes over the structure, which may be null.
  void fill_cube(msq_structure* with, double extent = 1, msq_param skin = {0, nullptr}) {
    model = make_model(context, make_cube(context, extent), with, skin);
  }
  void add_points(size_t count, double extent = 1) {
    uint64_t state = 1;
    for (size_t i = 0; i < 3 * count; ++i) {
      state = state * 6364136223846793005u + 1442695040888963407u;
      points.push_back(extent * static_cast<double>(state >> 11) * 0x1p-53);
    }
  }
};

using Call = std::function<msq_status(Setup&, msq_job*)>;
// ---- structures ------------------------------------------------------------------------------

struct FoamOf {
  int cells = 64;
  double radius = 0.1;  // in cells
  int32_t method = MSQ_FOAM_AUTO;
  double density = 1;
};

inline msq_structure* foam(Setup& setup, const FoamOf& of) {
  msq_foam_def def;
  check(msq_foam_def_init(&def, sizeof def));
  def.method = of.method;
  def.radius.value = of.radius / of.cells;
  def.density.value = of.density;
  for (double& size : def.grid.cell_size) size = 1.0 / of.cells;
  msq_structure* made;
  check(msq_structure_foam(setup.context, &def, &made));
  return made;
}

/// Foams of one coarse cell in the midst of the finest ones.
inline msq_structure* steep_foam(Setup& setup, int cells) {
  const double center[3] = {0.5, 0.5, 0.5};
  msq_radial_field_def radial;
  check(msq_radial_field_def_init(&radial, sizeof radial));
  std::memcpy(radial.center, center, sizeof center);
  radial.from_value = 1, radial.from_radius = 0.7 / cells;
  radial.to_value = 32768, radial.to_radius = 0.8 / cells;
  msq_field* density;
  check(msq_field_radial(setup.context, &radial, &density));
  msq_foam_def def;
  check(msq_foam_def_init(&def, sizeof def));
  def.radius.value = 0.002 / cells;
  def.density = {0, density};
  for (double& size : def.grid.cell_size) size = 1.0 / cells;
  msq_structure* made;
  check(msq_structure_foam(setup.context, &def, &made));
  msq_field_release(density);
  return made;
}

/// A unit cell of as many struts as there may be.
inline msq_structure* dense_lattice(Setup& setup, uint32_t clusters, bool turned = false) {
  constexpr uint32_t count = 2048;
  std::vector<double> nodes;
  std::vector<uint32_t> struts;
  uint64_t state = 7;
  for (uint32_t i = 0; i < 2 * count; ++i)
    for (int axis = 0; axis < 3; ++axis) {
      state = state * 6364136223846793005u + 1442695040888963407u;
      const double random = static_cast<double>(state >> 11) * 0x1p-53;
      nodes.push_back(i % 2 ? std::clamp(nodes[nodes.size() - 3] + 0.2 * (random - 0.5), 0.0, 1.0)
                            : random);
    }
  for (uint32_t i = 0; i < 2 * count; ++i) struts.push_back(i);
  msq_lattice_def def;
  check(msq_lattice_def_init(&def, sizeof def));
  def.unit_cell = MSQ_UNIT_CELL_CUSTOM;
  def.nodes = nodes.data(), def.node_count = 2 * count;
  def.struts = struts.data(), def.strut_count = count;
  def.clusters = clusters;
  def.radius.value = 0.01;
  if (turned) turn(def.grid);
  msq_structure* made;
  check(msq_structure_lattice(setup.context, &def, &made));
  return made;
}

inline msq_structure* expression(Setup& setup, const char* text, uint32_t clusters) {
  msq_functional_def def;
  check(msq_functional_def_init(&def, sizeof def));
  def.function = MSQ_FUNCTION_EXPRESSION;
  def.expression = text;
  def.clusters = clusters;
  for (double& size : def.grid.cell_size) size = 0.25;
  msq_structure* made;
  check(msq_structure_functional(setup.context, &def, &made));
  return made;
}

/// Sums of waves: hundreds of operations.
inline std::string long_expression() {
  std::string text = "0";
  for (int i = 1; i <= 60; ++i) {
    char term[96];
    std::snprintf(term, sizeof term, "+sin(%d*x+%d)*cos(%d*y-z)/%d", i, i, i + 1, i);
    text += term;
  }
  return text;
}

inline void fill_mesh(Setup& setup, msq_structure* with, msq_param skin) {
  static const MeshArrays mesh = rippled_torus(1000, 500);
  setup.model = make_model(setup.context, make_shape(setup.context, mesh), with, skin);
}

// ---- calls -------------------------------------------------------------------------------------

inline msq_points_def array_of(const Setup& setup) {
  msq_points_def def;
  check(msq_points_def_init(&def, sizeof def));
  def.kind = MSQ_POINTS_ARRAY;
  def.coordinates = setup.points.data();
  def.count = setup.points.size() / 3;
  return def;
}

inline msq_points_def strata_of(uint64_t side, uint32_t per_cell, double extent = 1) {
  msq_points_def def;
  check(msq_points_def_init(&def, sizeof def));
  def.kind = MSQ_POINTS_STRATIFIED;
  def.per_cell = per_cell;
  for (int axis = 0; axis < 3; ++axis)
    def.spacing[axis] = extent / static_cast<double>(side), def.counts[axis] = side;
  return def;
}

inline msq_status ask_membership(Setup& setup, msq_job* job) {
  const msq_points_def points = array_of(setup);
  setup.inside.resize(points.count);
  return msq_set_membership(setup.model, &points, nullptr, setup.inside.data(), points.count, job);
}

inline msq_status ask_distance(Setup& setup, msq_job* job) {
  const msq_points_def points = array_of(setup);
  setup.values.resize(points.count);
  return msq_set_distance(setup.model, &points, nullptr, setup.values.data(), points.count, job);
}

inline Call slice(uint32_t resolution) {
  return [=](Setup& setup, msq_job* job) {
    msq_slicer* slicer = make_slicer(setup.model, slices_of(resolution));
    const auto take = [](void*, const msq_layer*) -> int32_t { return 0; };
    const msq_status status = msq_slicer_run(slicer, 0, UINT64_MAX, take, nullptr, job);
    msq_slicer_release(slicer);
    return status;
  };
}

inline Call slice_one(uint32_t resolution) {
  return [=](Setup& setup, msq_job* job) {
    msq_slicer* slicer = make_slicer(setup.model, slices_of(resolution));
    std::vector<uint8_t> layer(resolution * resolution);
    const msq_status status =
        msq_slice_layer(slicer, resolution / 2, layer.data(), layer.size(), job);
    msq_slicer_release(slicer);
    return status;
  };
}

/// From points all over the model, each its own way.
inline msq_status cast(Setup& setup, msq_job* job) {
  msq_rays_def def;
  check(msq_rays_def_init(&def, sizeof def));
  def.count = setup.points.size() / 6;
  def.origins = setup.points.data();
  def.directions = setup.points.data() + 3 * def.count;
  setup.hits.resize(def.count);
  return msq_ray_cast(setup.model, &def, nullptr, setup.hits.data(), def.count, job);
}

inline Call render(uint32_t size, uint32_t occlusion_rays) {
  return [=](Setup& setup, msq_job* job) {
    const double direction[3] = {-0.5, 0.8, -0.4};
    msq_camera camera;
    check(msq_camera_init(&camera, sizeof camera));
    check(msq_camera_fit(setup.model, direction, nullptr, size, size, &camera));
    msq_render_def def;
    check(msq_render_def_init(&def, sizeof def));
    def.width = def.height = size;
    def.occlusion_rays = occlusion_rays;
    msq_frame frame;
    check(msq_frame_init(&frame, sizeof frame));
    setup.inside.resize(size_t{4} * size * size);
    frame.rgba = setup.inside.data();
    return msq_render(setup.model, &camera, &def, nullptr, &frame, nullptr, nullptr, job);
  };
}

inline msq_status fraction(Setup& setup, msq_job* job) {
  const msq_points_def sample = strata_of(200, 4);
  msq_estimate estimate;
  return msq_volume_fraction(setup.model, &sample, nullptr, MSQ_PHASE_SOLID, &estimate, job);
}

inline msq_status paths(Setup& setup, msq_job* job) {
  const msq_points_def sample = strata_of(60, 4);
  const double lengths[] = {0.01, 0.1};
  msq_segments_def def;
  check(msq_segments_def_init(&def, sizeof def));
  def.lengths = lengths, def.length_count = 2;
  def.phase = MSQ_PHASE_VOID;
  msq_estimate estimates[2];
  return msq_lineal_path(setup.model, &sample, nullptr, &def, estimates, 2, job);
}

inline msq_status calibrate(Setup& setup, msq_job* job) {
  const msq_points_def sample = strata_of(100, 2);
  msq_calibration_report report = {};
  report.struct_size = sizeof report;
  return msq_structure_calibrate(setup.context, setup.structure, &sample, 0.1, nullptr, nullptr, 0,
                                 &report, job);
}

/// The mesh as a file in memory.
inline std::string file_of(const MeshArrays& mesh, int32_t format) {
  std::string text;
  const auto put = [&](const auto& value) {
    text.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  if (format == MSQ_FORMAT_OBJ) {
    char line[128];
    for (size_t i = 0; i < mesh.vertices.size(); i += 3) {
      const double* v = &mesh.vertices[i];
      std::snprintf(line, sizeof line, "v %.9g %.9g %.9g\n", v[0], v[1], v[2]);
      text += line;
    }
    for (size_t i = 0; i < mesh.triangles.size(); i += 3) {
      const uint32_t* t = &mesh.triangles[i];
      std::snprintf(line, sizeof line, "f %u %u %u\n", t[0] + 1, t[1] + 1, t[2] + 1);
      text += line;
    }
    return text;
  }
  text.assign(80, ' ');
  put(static_cast<uint32_t>(mesh.triangles.size() / 3));
  for (size_t i = 0; i < mesh.triangles.size(); i += 3) {
    text.append(12, '\0');
    for (size_t n = i; n < i + 3; ++n)
      for (size_t axis = 0; axis < 3; ++axis)
        put(static_cast<float>(mesh.vertices[3 * mesh.triangles[n] + axis]));
    put(uint16_t{0});
  }
  return text;
}

inline Call load(int32_t format) {
  const auto file = std::make_shared<std::string>(file_of(rippled_torus(1000, 500), format));
  return [=](Setup& setup, msq_job* job) {
    msq_file_def def;
    check(msq_file_def_init(&def, sizeof def));
    def.format = format;
    msq_shape* shape = nullptr;
    const msq_status status =
        msq_shape_from_memory(setup.context, file->data(), file->size(), &def, &shape, job);
    msq_shape_release(shape);
    return status;
  };
}

inline Call outline(uint32_t resolution) {
  return [=](Setup& setup, msq_job* job) {
    msq_contours_def def;
    check(msq_contours_def_init(&def, sizeof def));
    def.pitch = 1.0 / resolution;
    def.tolerance = 0.25 / resolution;
    msq_contours* contours = nullptr;
    const msq_status status = msq_layer_contours(setup.model, 0.503, &def, &contours, job);
    msq_contours_release(contours);
    return status;
  };
}

inline Call mesh(uint32_t resolution) {
  return [=](Setup& setup, msq_job* job) {
    msq_surface_def def;
    check(msq_surface_def_init(&def, sizeof def));
    def.pitch = 1.0 / resolution;
    const auto take = [](void*, const msq_surface_slab*) -> int32_t { return 0; };
    return msq_surface_mesh(setup.model, &def, take, nullptr, job);
  };
}

inline Call examine(uint32_t resolution) {
  return [=](Setup& setup, msq_job* job) {
    msq_slicer* slicer = make_slicer(setup.model, slices_of(resolution));
    msq_printability_def def;
    check(msq_printability_def_init(&def, sizeof def));
    def.kinds |= MSQ_FINDING_THIN;
    def.width = 3.0 / resolution;
    msq_printability_report found{};
    found.struct_size = sizeof found;
    const msq_status status = msq_printability(slicer, &def, nullptr, nullptr, &found, job);
    msq_slicer_release(slicer);
    return status;
  };
}

inline msq_status fill_lines(Setup& setup, msq_job* job) {
  const int64_t square[8] = {0, 0, 1000000, 0, 1000000, 1000000, 0, 1000000};
  const msq_ring ring = {square, 4};
  msq_fill_def def;
  check(msq_fill_def_init(&def, sizeof def));
  def.rings = &ring, def.ring_count = 1;
  def.scale = 1e-6;
  def.z = 0.503;
  def.tolerance = 1e-5;
  msq_fill* fill = nullptr;
  const msq_status status = msq_fill_lines(setup.context, setup.structure, &def, &fill, job);
  msq_fill_release(fill);
  return status;
}

inline msq_struts_def struts_of(double extent) {
  msq_struts_def def;
  check(msq_struts_def_init(&def, sizeof def));
  for (int axis = 0; axis < 3; ++axis) def.min[axis] = 0, def.max[axis] = extent;
  return def;
}

inline msq_status list_struts(Setup& setup, msq_job* job) {
  const msq_struts_def def = struts_of(1);
  const auto take = [](void*, const msq_strut*, uint64_t) -> int32_t { return 0; };
  return msq_structure_struts(setup.context, setup.structure, &def, take, nullptr, job);
}

inline msq_status list_graph(Setup& setup, msq_job* job) {
  const msq_struts_def def = struts_of(1);
  msq_strut_graph* graph = nullptr;
  const msq_status status =
      msq_structure_strut_graph(setup.context, setup.structure, &def, &graph, job);
  msq_strut_graph_release(graph);
  return status;
}

inline msq_status ask_onset(Setup& setup, msq_job* job) {
  const msq_points_def points = array_of(setup);
  setup.values.resize(points.count);
  return msq_set_onset(setup.context, setup.structure, &points, MSQ_ONSET_PLAIN,
                       setup.values.data(), points.count, nullptr, 0, job);
}

inline msq_status correlate(Setup& setup, msq_job* job) {
  const msq_points_def sample = strata_of(100, 4);
  const double lengths[] = {0.01, 0.02, 0.05, 0.1};
  msq_segments_def def;
  check(msq_segments_def_init(&def, sizeof def));
  def.lengths = lengths, def.length_count = 4;
  msq_estimate estimates[4];
  return msq_two_point_correlation(setup.model, &sample, nullptr, &def, estimates, 4, job);
}

inline msq_status intersect_itself(Setup& setup, msq_job* job) {
  static const MeshArrays torus = rippled_torus(1000, 500);
  msq_shape* const shape = make_shape(setup.context, torus);
  uint64_t pairs;
  const msq_status status = msq_shape_self_intersections(shape, &pairs, job);
  msq_shape_release(shape);
  return status;
}

inline msq_status index_beams(Setup& setup, msq_job* job) {
  std::vector<uint32_t> beams(setup.points.size() / 3);
  for (size_t i = 0; i < beams.size(); ++i) beams[i] = static_cast<uint32_t>(i);
  msq_beams_def def;
  check(msq_beams_def_init(&def, sizeof def));
  def.nodes = setup.points.data();
  def.node_count = setup.points.size() / 3;
  def.beams = beams.data();
  def.beam_count = beams.size() / 2;
  def.radius = 0.001;
  msq_structure* structure = nullptr;
  const msq_status status = msq_structure_beams(setup.context, &def, &structure, job);
  msq_structure_release(structure);
  return status;
}

inline msq_status evaluate_field(Setup& setup, msq_job* job) {
  static const std::string text = [] {
    std::string sum = "0";
    for (int i = 1; i <= 200; ++i)
      sum += "+sin(" + std::to_string(i) + "*x)*exp(cos(" + std::to_string(i) + "*y))";
    return sum;
  }();
  msq_expression_field_def def;
  check(msq_expression_field_def_init(&def, sizeof def));
  def.expression = text.c_str();
  msq_field* field;
  check(msq_field_expression(setup.context, &def, &field));
  const msq_points_def points = array_of(setup);
  setup.values.resize(points.count);
  const msq_status status =
      msq_field_evaluate(setup.context, field, &points, setup.values.data(), points.count, job);
  msq_field_release(field);
  return status;
}

}  // namespace bench
