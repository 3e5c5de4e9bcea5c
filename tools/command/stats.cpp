// SPDX-License-Identifier: Apache-2.0
// msq stats: measures a model in a box.
#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "report.h"
#include "scene.h"
#include "text.h"
#include "watch.h"

namespace command {

namespace {

constexpr uint32_t POINTS_A_CELL = 2;

// Side of so many cubes that fill a box. A side of the box that is shorter has one cube across it.
double side_of_cubes(const double min[3], const double max[3], double count) {
  std::vector<double> sizes;
  for (size_t i = 0; i < 3; ++i) sizes.push_back(max[i] - min[i]);
  std::sort(sizes.begin(), sizes.end(), std::greater<>());
  for (size_t wide = 3; wide > 1; --wide) {
    double volume = 1 / count;
    for (size_t i = 0; i < wide; ++i) volume *= sizes[i];
    const double side = std::pow(volume, 1 / static_cast<double>(wide));
    if (side <= sizes[wide - 1]) return side;
  }
  return sizes[0] / count;
}

// Two points in each of about as many cubes as the number requests.
msq_points_def make_sample(const Arguments& arguments, const double min[3], const double max[3]) {
  constexpr uint64_t MOST = 1'000'000'000'000;
  const uint64_t wanted = arguments.count("samples", 1'000'000, MOST, 2);
  auto sample = defaults(msq_points_def_init);
  sample.kind = MSQ_POINTS_STRATIFIED;
  sample.per_cell = POINTS_A_CELL;
  sample.seed = arguments.count("sample-seed", 0);
  const double side =
      side_of_cubes(min, max, static_cast<double>(wanted) / static_cast<double>(POINTS_A_CELL));
  for (size_t i = 0; i < 3; ++i) {
    const double size = max[i] - min[i];
    const double count = std::fmin(std::fmax(std::round(size / side), 1), 1e9);
    sample.counts[i] = static_cast<uint64_t>(count);
    sample.origin[i] = min[i];
    sample.spacing[i] = size / count;
  }
  return sample;
}

void add(Report& report, const msq_estimate& estimate) {
  report.add("value", estimate.value);
  report.add("standard_error", estimate.standard_error);
  report.add("low", estimate.low);
  report.add("high", estimate.high);
}

// A,B,... or FIRST:LAST:COUNT.
std::vector<double> read_lengths(const Arguments& arguments, std::string_view option) {
  const std::string& text = arguments.text(option);
  const std::vector<std::string_view> range = split(text, ':');
  std::vector<double> lengths;
  if (range.size() == 1) {
    for (const std::string_view part : split(text, ',')) {
      const std::optional<double> length = to_number(part);
      if (!length) arguments.refuse(option, "'" + std::string(part) + "' is not a number");
      lengths.push_back(*length);
    }
    return lengths;
  }
  const auto first = to_number(range[0]), last = to_number(range[1]);
  const uint64_t count = range.size() == 3 ? to_count(range[2]).value_or(0) : 0;
  if (!first || !last || count < 2 || count > 4096) {
    arguments.refuse(option, "'" + text + "' is not FIRST:LAST:COUNT with a COUNT from 2 to 4096");
  }
  for (uint64_t i = 0; i < count; ++i) {
    lengths.push_back(*first +
                      static_cast<double>(i) * (*last - *first) / static_cast<double>(count - 1));
  }
  return lengths;
}

// What both functions of lengths have in common.
using Function = msq_status (*)(const msq_model*, const msq_points_def*, const msq_query_def*,
                                const msq_segments_def*, msq_estimate*, uint64_t, msq_job*);

std::vector<Report> measure(const Arguments& arguments, const Scene& scene,
                            const msq_points_def& sample, int32_t phase, std::string_view option,
                            Function function) {
  const std::vector<double> lengths = read_lengths(arguments, option);
  const msq_query_def query = make_query(arguments);
  auto def = defaults(msq_segments_def_init);
  def.phase = phase;
  def.lengths = lengths.data();
  def.length_count = lengths.size();
  if (arguments.has("direction")) {
    const std::vector<double> direction = arguments.numbers("direction", {3});
    if (direction == std::vector<double>(3, 0.0)) {
      arguments.refuse("direction", "'" + arguments.text("direction") + "' has no direction");
    }
    std::copy(direction.begin(), direction.end(), def.direction);
  }
  std::vector<msq_estimate> estimates(lengths.size());
  {
    Work work("measuring " + std::string(option));
    check(function(scene.model.get(), &sample, &query, &def, estimates.data(), estimates.size(),
                   work.job()),
          "--" + std::string(option));
  }
  std::vector<Report> rows(lengths.size());
  for (size_t i = 0; i < rows.size(); ++i) {
    rows[i].add("length", lengths[i]);
    rows[i].add("value", estimates[i].value);
    rows[i].add("standard_error", estimates[i].standard_error);
  }
  return rows;
}

// Sums over the triangles of a mesh, whose vertices come in parts.
struct Surface {
  std::vector<double> vertices;
  double area = 0, volume = 0;
  uint64_t triangles = 0;
  Carried carried;
};

int32_t take_slab(void* user, const msq_surface_slab* slab) {
  auto* surface = static_cast<Surface*>(user);
  return surface->carried.run([&] {
    surface->vertices.insert(surface->vertices.end(), slab->vertices,
                             slab->vertices + 3 * slab->vertex_count);
    for (uint64_t i = 0; i < slab->triangle_count; ++i) {
      const double* p[3];
      for (size_t k = 0; k < 3; ++k) {
        p[k] = surface->vertices.data() + 3 * size_t{slab->triangles[3 * i + k]};
      }
      double normal[3];  // twice the area long
      for (size_t a = 0; a < 3; ++a) {
        const size_t b = (a + 1) % 3, c = (a + 2) % 3;
        normal[a] =
            (p[1][b] - p[0][b]) * (p[2][c] - p[0][c]) - (p[1][c] - p[0][c]) * (p[2][b] - p[0][b]);
      }
      surface->area += std::hypot(normal[0], normal[1], normal[2]) / 2;
      surface->volume += (normal[0] * p[0][0] + normal[1] * p[0][1] + normal[2] * p[0][2]) / 6;
    }
    surface->triangles += slab->triangle_count;
  });
}

Report measure_surface(const Arguments& arguments, const Scene& scene, const double min[3],
                       const double max[3]) {
  auto def = defaults(msq_surface_def_init);
  def.pitch = arguments.number("surface", 0);
  def.length_scale = arguments.number("length-scale", 0);
  if (arguments.has("box")) {
    def.has_box = 1;
    std::copy(min, min + 3, def.min);
    std::copy(max, max + 3, def.max);
  }
  Surface surface;
  {
    Work work("meshing");
    surface.carried.check(
        msq_surface_mesh(scene.model.get(), &def, take_slab, &surface, work.job()));
  }
  Report report;
  report.add("pitch", def.pitch);
  report.add("triangles", surface.triangles);
  report.add("area", surface.area);
  report.add("volume", surface.volume);
  return report;
}

}  // namespace

void run_stats(const Arguments& arguments) {
  const int32_t phase = arguments.text("phase") == "void" ? MSQ_PHASE_VOID : MSQ_PHASE_SOLID;
  const Scene scene = open_scene(arguments);
  double min[3], max[3];
  take_box(arguments, scene.model.get(), min, max);
  const msq_points_def sample = make_sample(arguments, min, max);
  const msq_query_def query = make_query(arguments);
  auto coarse = defaults(msq_query_def_init);
  coarse.length_scale = INFINITY;

  Report report;
  report.add("file", arguments.operand(0));
  if (scene.structure) report.add("structure", describe_structure(arguments));
  report.add("min", min, 3);
  report.add("max", max, 3);
  report.add("samples", sample.counts[0] * sample.counts[1] * sample.counts[2] * POINTS_A_CELL);
  report.add("phase", phase == MSQ_PHASE_SOLID ? "solid" : "void");
  msq_estimate estimate = {}, solid = {}, part = {};
  {
    Work work("measuring volume");
    const msq_model* model = scene.model.get();
    check(msq_volume_fraction(model, &sample, &query, phase, &estimate, work.job()));
    check(msq_volume_fraction(model, &sample, &query, MSQ_PHASE_SOLID, &solid, work.job()));
    check(msq_volume_fraction(model, &sample, &coarse, MSQ_PHASE_SOLID, &part, work.job()));
  }
  Report fraction;
  add(fraction, estimate);
  report.add("volume_fraction", std::move(fraction));
  const double box = (max[0] - min[0]) * (max[1] - min[1]) * (max[2] - min[2]);
  report.add("part_volume", part.value * box);
  report.add("solid_volume", solid.value * box);
  report.add("relative_density", solid.value / part.value);
  if (arguments.has("direction") && !arguments.has("two-point") && !arguments.has("lineal-path")) {
    arguments.refuse("direction", "needs --two-point or --lineal-path");
  }
  if (arguments.has("two-point")) {
    report.add("two_point",
               measure(arguments, scene, sample, phase, "two-point", msq_two_point_correlation));
  }
  if (arguments.has("lineal-path")) {
    report.add("lineal_path",
               measure(arguments, scene, sample, phase, "lineal-path", msq_lineal_path));
  }
  if (arguments.has("surface")) {
    report.add("surface", measure_surface(arguments, scene, min, max));
  }
  report.print(arguments);
}

}  // namespace command
