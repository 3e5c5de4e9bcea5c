// SPDX-License-Identifier: Apache-2.0
// What long calls hold beside what memory_limit counts: layers of 16384^2 pixels and 10^9 voxels,
// points or nodes, each in a process of its own. Linux alone.
//
// usage: memory [results.json [part of a name [seconds a case, default 20]]]
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <string>
#include <thread>

#include "setup.h"
#include "varied_structures.h"

namespace {

using bench::check;

constexpr uint32_t width = 16384;  // pixels of a layer
constexpr uint64_t side = 1000;    // voxels, points or nodes along a side
constexpr uint32_t threads = 2;

/// Megabytes of the process: "VmRSS:" now, "VmHWM:" at most since forget_peak().
double megabytes(const char* what) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (word == what) {
      double kilobytes;
      status >> kilobytes;
      return kilobytes / 1024;
    }
  return 0;
}
void forget_peak() {
  std::ofstream("/proc/self/clear_refs") << 5;
}

struct Setup {
  msq_context* context = nullptr;
  msq_model* model = nullptr;
  std::vector<uint8_t> bytes;  // of the host
  Setup() = default;
  Setup(const Setup&) = delete;
  ~Setup() {
    msq_model_release(model);
    msq_context_release(context);
  }
};

struct Case {
  std::string name;
  uint64_t limit;  // MB
  std::function<void(Setup&)> prepare;
  std::function<msq_status(Setup&, msq_job*)> call;
};

msq_structure* make_structure(msq_context* context, char kind, int cells) {
  msq_structure* structure;
  if (kind == 'f') {
    msq_foam_def def;
    check(msq_foam_def_init(&def, sizeof def));
    for (double& size : def.grid.cell_size) size = 1.0 / cells;
    def.radius.value = 0.1 / cells;
    check(msq_structure_foam(context, &def, &structure));
  } else if (kind == 'l') {
    msq_lattice_def def;
    check(msq_lattice_def_init(&def, sizeof def));
    for (double& size : def.grid.cell_size) size = 1.0 / cells;
    def.radius.value = 0.1 / cells;
    bench::turn(def.grid);
    check(msq_structure_lattice(context, &def, &structure));
  } else {
    msq_functional_def def;
    check(msq_functional_def_init(&def, sizeof def));
    for (double& size : def.grid.cell_size) size = 1.0 / cells;
    def.kind = MSQ_FUNCTIONAL_SHEET;
    def.level.value = 0.3;
    check(msq_structure_functional(context, &def, &structure));
  }
  return structure;
}

std::function<void(Setup&)> cube_of(char kind, int cells) {
  return [=](Setup& s) {
    s.model = bench::make_model(s.context, bench::make_cube(s.context),
                                make_structure(s.context, kind, cells));
  };
}

/// 10^9 voxels of the host, which msq reads in place; a ball.
void prepare_voxels(Setup& s) {
  s.bytes.resize(side * side * side);
  for (uint64_t z = 0, i = 0; z < side; ++z)
    for (uint64_t y = 0; y < side; ++y)
      for (uint64_t x = 0; x < side; ++x, ++i) {
        const double u = static_cast<double>(x) - 500, v = static_cast<double>(y) - 500,
                     w = static_cast<double>(z) - 500;
        s.bytes[i] = u * u + v * v + w * w < 230000 ? 255 : 0;
      }
}

msq_status make_voxels(Setup& s, msq_job*) {
  msq_voxels_def def;
  check(msq_voxels_def_init(&def, sizeof def));
  def.threshold = 128;
  def.image.values = s.bytes.data();
  def.image.value_type = MSQ_UINT8;
  for (uint64_t& size : def.image.size) size = side;
  msq_shape* shape = nullptr;
  const msq_status status = msq_shape_from_voxels(s.context, &def, &shape);
  msq_shape_release(shape);
  return status;
}

msq_slicer* slicer_for(const Setup& s, int32_t output) {
  msq_slicer_def def = bench::slices_of(width);
  def.output = output;
  return bench::make_slicer(s.model, def);
}

std::function<msq_status(Setup&, msq_job*)> slices(int32_t output, uint64_t layers) {
  return [=](Setup& s, msq_job* job) {
    msq_slicer* slicer = slicer_for(s, output);
    const auto take = [](void*, const msq_layer*) -> int32_t { return 0; };
    const msq_status status = msq_slicer_run(slicer, width / 2, layers, take, nullptr, job);
    msq_slicer_release(slicer);
    return status;
  };
}

/// The host's buffer is made, and counted, before.
void add_layer(Setup& s) {
  s.bytes.assign(size_t{width} * width / 8, 1);
}

msq_status slice_one(Setup& s, msq_job* job) {
  msq_slicer* slicer = slicer_for(s, MSQ_LAYER_BITS);
  const msq_status status = msq_slice_layer(slicer, width / 2, s.bytes.data(), s.bytes.size(), job);
  msq_slicer_release(slicer);
  return status;
}

msq_status outline(Setup& s, msq_job* job) {
  msq_contours_def def;
  check(msq_contours_def_init(&def, sizeof def));
  def.type = MSQ_INT64;
  def.units = 1e7;
  def.pitch = 1.0 / width;
  def.tolerance = 0.25 / width;
  msq_contours* contours = nullptr;
  const msq_status status = msq_layer_contours(s.model, 0.503, &def, &contours, job);
  msq_contours_release(contours);
  return status;
}

msq_status examine(Setup& s, msq_job* job) {
  msq_slicer* slicer = slicer_for(s, MSQ_LAYER_BITS);
  msq_printability_report report{};
  report.struct_size = sizeof report;
  const msq_status status = msq_printability(slicer, nullptr, nullptr, nullptr, &report, job);
  msq_slicer_release(slicer);
  return status;
}

msq_status mesh(Setup& s, msq_job* job) {
  msq_surface_def def;
  check(msq_surface_def_init(&def, sizeof def));
  def.pitch = 1.0 / static_cast<double>(side);
  const auto take = [](void*, const msq_surface_slab*) -> int32_t { return 0; };
  return msq_surface_mesh(s.model, &def, take, nullptr, job);
}

msq_points_def points_of(int32_t kind) {
  msq_points_def def;
  check(msq_points_def_init(&def, sizeof def));
  def.kind = kind;
  def.per_cell = 2;
  for (int axis = 0; axis < 3; ++axis)
    def.counts[axis] = side, def.spacing[axis] = 1.0 / static_cast<double>(side);
  if (kind == MSQ_POINTS_STRATIFIED) def.counts[0] /= 2;
  return def;
}

void add_memberships(Setup& s) {
  s.bytes.assign(side * side * side, 1);
}

msq_status ask_membership(Setup& s, msq_job* job) {
  const msq_points_def points = points_of(MSQ_POINTS_GRID);
  return msq_set_membership(s.model, &points, nullptr, s.bytes.data(), s.bytes.size(), job);
}

msq_status fraction(Setup& s, msq_job* job) {
  const msq_points_def sample = points_of(MSQ_POINTS_STRATIFIED);
  msq_estimate estimate;
  return msq_volume_fraction(s.model, &sample, nullptr, MSQ_PHASE_SOLID, &estimate, job);
}

std::vector<Case> all_cases() {
  const auto both = [](std::function<void(Setup&)> a, std::function<void(Setup&)> b) {
    return [=](Setup& s) { a(s), b(s); };
  };
  std::vector<Case> cases = {
      {"4 layers, foam of 512^3 cells, bits", 256, cube_of('f', 512), slices(MSQ_LAYER_BITS, 4)},
      {"4 layers, foam of 64^3 cells, bits", 256, cube_of('f', 64), slices(MSQ_LAYER_BITS, 4)},
      {"4 layers, turned lattice, bits", 256, cube_of('l', 64), slices(MSQ_LAYER_BITS, 4)},
      {"4 layers, gyroid, bits", 256, cube_of('g', 64), slices(MSQ_LAYER_BITS, 4)},
      {"2 layers, foam of 64^3 cells, bytes", 1024, cube_of('f', 64), slices(MSQ_LAYER_BYTES, 2)},
      {"one layer, foam of 512^3 cells", 256, both(cube_of('f', 512), add_layer), slice_one},
      {"one layer, gyroid", 256, both(cube_of('g', 64), add_layer), slice_one},
      {"contours, foam of 512^3 cells", 4096, cube_of('f', 512), outline},
      {"contours, gyroid", 4096, cube_of('g', 64), outline},
      {"printability, foam of 64^3 cells", 512, cube_of('f', 64), examine},
      {"image of 10^9 voxels", 2048, prepare_voxels, make_voxels},
      {"membership of 10^9 points, foam", 256, both(cube_of('f', 64), add_memberships),
       ask_membership},
      {"volume fraction, 10^9 points, foam", 256, cube_of('f', 64), fraction},
      {"volume fraction, 10^9 points, gyroid", 256, cube_of('g', 64), fraction},
      {"preview mesh, 10^9 nodes, foam", 512, cube_of('f', 64), mesh},
      {"preview mesh, 10^9 nodes, gyroid", 512, cube_of('g', 64), mesh},
  };
  for (const bench::Varied& kind : bench::varied_structures) {
    const auto cube = [make = kind.make](Setup& s) {
      s.model = bench::make_model(s.context, bench::make_cube(s.context), make(s.context, 64));
    };
    cases.push_back(
        {std::string("4 layers, ") + kind.name + ", bits", 256, cube, slices(MSQ_LAYER_BITS, 4)});
    cases.push_back({std::string("membership of 10^9 points, ") + kind.name, 256,
                     both(cube, add_memberships), ask_membership});
  }
  return cases;
}

struct Found {
  double grown, counted;  // MB
  int32_t status;
};

/// Ends the call after the seconds: what it streams, it holds from the start.
Found run(const Case& of, double seconds) {
  Setup setup;
  msq_context_def def;
  check(msq_context_def_init(&def, sizeof def));
  def.threads = threads;
  def.memory_limit = of.limit << 20;
  check(msq_context_create(&def, &setup.context));
  of.prepare(setup);
  msq_job* job;
  check(msq_job_create(&job));
  forget_peak();
  const double before = megabytes("VmRSS:");
  std::atomic<bool> ended{false};
  std::thread timer([&] {
    for (double left = seconds; left > 0 && !ended; left -= 0.01)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    if (!ended) check(msq_job_cancel(job));
  });
  Found found{};
  found.status = of.call(setup, job);
  if (found.status == MSQ_E_LIMIT)
    std::fprintf(stderr, "%s: %s\n", of.name.c_str(), msq_error_message());
  ended = true;
  timer.join();
  found.grown = megabytes("VmHWM:") - before;
  msq_memory_report memory{};
  memory.struct_size = sizeof memory;
  check(msq_context_memory(setup.context, &memory));
  found.counted = static_cast<double>(memory.peak_bytes) / (1 << 20);
  msq_job_release(job);
  return found;
}

}  // namespace

int main(int count, char** arguments) try {
  const double seconds = count > 3 ? std::atof(arguments[3]) : 20;
  bench::Report report("memory of long calls, MB, two threads");
  for (const Case& of : all_cases()) {
    if (count > 2 && of.name.find(arguments[2]) == std::string::npos) continue;
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("no pipe");
    const pid_t child = fork();
    if (child == 0) {
      const Found found = run(of, seconds);
      const bool is_written = write(ends[1], &found, sizeof found) == sizeof found;
      _exit(is_written ? 0 : 1);
    }
    close(ends[1]);
    Found found{};
    const bool is_read = child > 0 && read(ends[0], &found, sizeof found) == sizeof found;
    close(ends[0]);
    int status = 0;
    if (child > 0) waitpid(child, &status, 0);
    if (!is_read) throw std::runtime_error(of.name + ": the process ended");
    report.compare(of.name, msq_status_name(found.status),
                   {{"limit", static_cast<double>(of.limit)},
                    {"counted", found.counted},
                    {"grown", found.grown},
                    {"outside", found.grown - found.counted}});
  }
  report.write(count, arguments);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
