// SPDX-License-Identifier: Apache-2.0
// How soon long calls return once their job is cancelled. Each call is begun anew, with nothing
// cached, for each of a row of moments at which it is cancelled, spread over its first two seconds.
//
// usage: cancel [results.json [part of a name]]
#include <atomic>
#include <cstring>
#include <memory>
#include <string>
#include <thread>

#include "rippled_torus.h"
#include "setup.h"

namespace {

using namespace bench;

constexpr double longest = 2;  // seconds of a call that are looked at
constexpr int moments = 15;
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
struct Case {
  std::string name;
  std::function<void(Setup&)> prepare;
  Call call;
};

// ---- structures ------------------------------------------------------------------------------

struct FoamOf {
  int cells = 64;
  double radius = 0.1;  // in cells
  int32_t method = MSQ_FOAM_AUTO;
  double density = 1;
};

msq_structure* foam(Setup& setup, const FoamOf& of) {
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
msq_structure* steep_foam(Setup& setup, int cells) {
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
msq_structure* dense_lattice(Setup& setup, uint32_t clusters, bool turned = false) {
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

msq_structure* expression(Setup& setup, const char* text, uint32_t clusters) {
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
std::string long_expression() {
  std::string text = "0";
  for (int i = 1; i <= 60; ++i) {
    char term[96];
    std::snprintf(term, sizeof term, "+sin(%d*x+%d)*cos(%d*y-z)/%d", i, i, i + 1, i);
    text += term;
  }
  return text;
}

void fill_mesh(Setup& setup, msq_structure* with, msq_param skin) {
  static const MeshArrays mesh = rippled_torus(1000, 500);
  setup.model = make_model(setup.context, make_shape(setup.context, mesh), with, skin);
}

// ---- calls -------------------------------------------------------------------------------------

msq_points_def array_of(const Setup& setup) {
  msq_points_def def;
  check(msq_points_def_init(&def, sizeof def));
  def.kind = MSQ_POINTS_ARRAY;
  def.coordinates = setup.points.data();
  def.count = setup.points.size() / 3;
  return def;
}

msq_points_def strata_of(uint64_t side, uint32_t per_cell, double extent = 1) {
  msq_points_def def;
  check(msq_points_def_init(&def, sizeof def));
  def.kind = MSQ_POINTS_STRATIFIED;
  def.per_cell = per_cell;
  for (int axis = 0; axis < 3; ++axis)
    def.spacing[axis] = extent / static_cast<double>(side), def.counts[axis] = side;
  return def;
}

msq_status ask_membership(Setup& setup, msq_job* job) {
  const msq_points_def points = array_of(setup);
  setup.inside.resize(points.count);
  return msq_set_membership(setup.model, &points, nullptr, setup.inside.data(), points.count, job);
}

msq_status ask_distance(Setup& setup, msq_job* job) {
  const msq_points_def points = array_of(setup);
  setup.values.resize(points.count);
  return msq_set_distance(setup.model, &points, nullptr, setup.values.data(), points.count, job);
}

msq_slicer_def slices_of(uint32_t resolution) {
  msq_slicer_def def;
  check(msq_slicer_def_init(&def, sizeof def));
  def.resolution[0] = def.resolution[1] = resolution;
  def.layer_height = 1.0 / resolution;
  return def;
}

Call slice(uint32_t resolution) {
  return [=](Setup& setup, msq_job* job) {
    const msq_slicer_def def = slices_of(resolution);
    msq_slicer* slicer;
    check(msq_slicer_create(setup.model, &def, &slicer));
    const auto take = [](void*, const msq_layer*) -> int32_t { return 0; };
    const msq_status status = msq_slicer_run(slicer, 0, UINT64_MAX, take, nullptr, job);
    msq_slicer_release(slicer);
    return status;
  };
}

Call slice_one(uint32_t resolution) {
  return [=](Setup& setup, msq_job* job) {
    const msq_slicer_def def = slices_of(resolution);
    msq_slicer* slicer;
    check(msq_slicer_create(setup.model, &def, &slicer));
    std::vector<uint8_t> layer(resolution * resolution);
    const msq_status status =
        msq_slice_layer(slicer, resolution / 2, layer.data(), layer.size(), job);
    msq_slicer_release(slicer);
    return status;
  };
}

/// From points all over the model, each its own way.
msq_status cast(Setup& setup, msq_job* job) {
  msq_rays_def def;
  check(msq_rays_def_init(&def, sizeof def));
  def.count = setup.points.size() / 6;
  def.origins = setup.points.data();
  def.directions = setup.points.data() + 3 * def.count;
  setup.hits.resize(def.count);
  return msq_ray_cast(setup.model, &def, nullptr, setup.hits.data(), def.count, job);
}

Call render(uint32_t size, uint32_t occlusion_rays) {
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

msq_status fraction(Setup& setup, msq_job* job) {
  const msq_points_def sample = strata_of(200, 4);
  msq_estimate estimate;
  return msq_volume_fraction(setup.model, &sample, nullptr, MSQ_PHASE_SOLID, &estimate, job);
}

msq_status paths(Setup& setup, msq_job* job) {
  const msq_points_def sample = strata_of(60, 4);
  const double lengths[] = {0.01, 0.1};
  msq_segments_def def;
  check(msq_segments_def_init(&def, sizeof def));
  def.lengths = lengths, def.length_count = 2;
  def.phase = MSQ_PHASE_VOID;
  msq_estimate estimates[2];
  return msq_lineal_path(setup.model, &sample, nullptr, &def, estimates, 2, job);
}

msq_status calibrate(Setup& setup, msq_job* job) {
  const msq_points_def sample = strata_of(100, 2);
  msq_calibration_report report = {};
  report.struct_size = sizeof report;
  return msq_structure_calibrate(setup.context, setup.structure, &sample, 0.1, nullptr, nullptr, 0,
                                 &report, job);
}

/// The mesh as a file in memory.
std::string file_of(const MeshArrays& mesh, int32_t format) {
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

Call load(int32_t format) {
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

// ---- the cases
// -----------------------------------------------------------------------------------

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  const auto add = [&](const char* name, std::function<void(Setup&)> prepare, Call call) {
    cases.push_back({name, std::move(prepare), std::move(call)});
  };
  const auto with_points = [](FoamOf of, size_t count) {
    return [=](Setup& s) {
      s.fill_cube(foam(s, of));
      s.add_points(count);
    };
  };
  add("array, foam, POINT, r 0.1", with_points({64, 0.1, MSQ_FOAM_POINT}, 1000000), ask_membership);
  add("array, foam, POINT, r 1", with_points({64, 1, MSQ_FOAM_POINT}, 1000000), ask_membership);
  add("array, foam, METHOD_1, r 0.1", with_points({64, 0.1, MSQ_FOAM_METHOD_1}, 1000000),
      ask_membership);
  add("array, foam, METHOD_1, r 1", with_points({64, 1, MSQ_FOAM_METHOD_1}, 1000000),
      ask_membership);
  add("array, foam, METHOD_2, r 1", with_points({64, 1, MSQ_FOAM_METHOD_2}, 1000000),
      ask_membership);
  add("array, foam, r 1", with_points({64, 1}, 1000000), ask_membership);
  add("array, foam of density 32768", with_points({8, 0.003, 0, 32768}, 1000000), ask_membership);
  add("array, foam of density 32768, thick", with_points({8, 0.3, 0, 32768}, 1000000),
      ask_membership);
  add("distances, foam of density 32768", with_points({8, 0.003, 0, 32768}, 1000000), ask_distance);
  const auto with_foam = [](FoamOf of) { return [=](Setup& s) { s.fill_cube(foam(s, of)); }; };
  add("slices, foam", with_foam({128, 0.1}), slice(1024));
  add("one layer, foam", with_foam({128, 0.1}), slice_one(2048));
  add("slices, foam of density 32768", with_foam({8, 0.003, 0, 32768}), slice(1024));
  const auto steep = [](Setup& s) {
    s.fill_cube(steep_foam(s, 4));
    s.add_points(200000);
  };
  add("slices, a coarse cell among the finest", steep, slice(1024));
  add("array, a coarse cell among the finest", steep, ask_membership);
  add("rays, a coarse cell among the finest", steep, cast);
  add("rays, foam", with_points({64, 0.1}, 1000000), cast);
  add("rays, foam, r 1e-4", with_points({64, 1e-4}, 1000000), cast);
  add("rays, foam of density 32768", with_points({8, 0.003, 0, 32768}, 1000000), cast);
  add("picture, foam of density 32768", with_foam({8, 0.003, 0, 32768}), render(1024, 0));
  add("picture with occlusion, foam", with_foam({64, 0.1}), render(1024, 64));
  add(
      "calibration, foam of density 32768",
      [](Setup& s) {
        s.structure = foam(s, {8, 0.003, 0, 32768});
      },
      calibrate);
  add(
      "loading OBJ, 10^6 triangles", [](Setup&) {}, load(MSQ_FORMAT_OBJ));
  add(
      "loading binary STL, 10^6 triangles", [](Setup&) {}, load(MSQ_FORMAT_STL));
  add(
      "distances, 10^6 triangles",
      [](Setup& s) {
        fill_mesh(s, nullptr, {});
        s.add_points(1000000);
      },
      ask_distance);
  add(
      "slices, 10^6 triangles with a skin",
      [](Setup& s) {
        fill_mesh(s, foam(s, {64, 0.1}), {0.01, nullptr});
      },
      slice(1024));
  add(
      "rays, 10^6 triangles",
      [](Setup& s) {
        fill_mesh(s, nullptr, {});
        s.add_points(1000000);
      },
      cast);
  const auto with_lattice = [](uint32_t clusters, bool turned) {
    return [=](Setup& s) {
      s.fill_cube(dense_lattice(s, clusters, turned), 4);
      s.add_points(1000000, 4);
    };
  };
  add("array, lattice of 2048 struts, 64^3 clusters", with_lattice(64, false), ask_membership);
  add("distances, lattice of 2048 struts", with_lattice(0, false), ask_distance);
  add("slices, lattice of 2048 struts", with_lattice(0, false), slice(1024));
  add("slices, the same turned", with_lattice(0, true), slice(1024));
  add("rays, lattice of 2048 struts", with_lattice(0, false), cast);
  add("lineal path, lattice of 2048 struts", with_lattice(0, false), paths);
  static const std::string waves = long_expression();
  const auto with_waves = [](uint32_t clusters) {
    return [=](Setup& s) {
      s.fill_cube(expression(s, waves.c_str(), clusters));
      s.add_points(1000000);
    };
  };
  add("slices, long expression, 64^3 clusters", with_waves(64), slice(1024));
  add("array, long expression", with_waves(0), ask_membership);
  add("distances, long expression", with_waves(0), ask_distance);
  add("rays, long expression", with_waves(0), cast);
  add("volume fraction, long expression", with_waves(0), fraction);
  return cases;
}

/// Seconds from cancel to the call's return, or -1 if it ended before; `delay` seconds after it
/// began.
double latency(const Case& of, double delay, double& duration) {
  using Clock = std::chrono::steady_clock;
  const auto since = [](Clock::time_point t) {
    return std::chrono::duration<double>(Clock::now() - t).count();
  };
  Setup setup;
  of.prepare(setup);
  msq_job* job;
  check(msq_job_create(&job));
  std::atomic<bool> ended{false};
  msq_status status = MSQ_OK;
  const Clock::time_point start = Clock::now();
  std::thread caller([&] {
    status = of.call(setup, job);
    ended = true;
  });
  while (!ended && since(start) < delay)
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  const Clock::time_point cancelled = Clock::now();
  check(msq_job_cancel(job));
  caller.join();
  const double seconds = since(cancelled);
  duration = since(start);
  msq_job_release(job);
  if (status != MSQ_OK && status != MSQ_E_CANCELLED)
    throw std::runtime_error(of.name + ": " + msq_status_name(status));
  return status == MSQ_E_CANCELLED ? seconds : -1;
}

}  // namespace

int main(int count, char** arguments) {
  Report report("cancelling long calls");
  for (const Case& of : all_cases()) {
    if (count > 2 && of.name.find(arguments[2]) == std::string::npos) continue;
    double duration;
    latency(of, longest, duration);
    const double whole = std::min(duration, longest);
    std::vector<double> times;
    for (int i = 0; i < moments; ++i) {
      const double time = latency(of, whole * (i + 0.5) / moments, duration);
      if (time >= 0) times.push_back(1e3 * time);
    }
    std::sort(times.begin(), times.end());
    if (times.empty()) times.push_back(0);
    report.compare(
        of.name, "ms",
        {{"median", times[times.size() / 2]}, {"longest", times.back()}, {"of", 1e3 * whole}});
  }
  report.write(count, arguments);
}
