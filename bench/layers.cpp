// SPDX-License-Identifier: Apache-2.0
// Single layers against a run, in processor time for each layer: one after the other, scattered,
// and from several threads of the host at once. And the resident memory that layers of several
// sizes take, in a process of their own. And grey layers against bits.
//
// usage: layers [results.json] [pixels along a side, default 2048] [part of the names of works, or
// "resident" or "grey"]
#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <random>
#include <thread>

#include "rippled_torus.h"
#include "setup.h"

namespace {

enum class Kind { foam, walls, lattice, turned_lattice, gyroid, graded_gyroid, mesh };

struct Work {
  const char* name;
  Kind kind;
  int cells;
};
constexpr Work works[] = {{"foam, 32^3 cells", Kind::foam, 32},
                          {"foam, 128^3 cells", Kind::foam, 128},
                          {"walls, 32^3 cells", Kind::walls, 32},
                          {"lattice, 32^3 cells", Kind::lattice, 32},
                          {"turned lattice, 32^3 cells", Kind::turned_lattice, 32},
                          {"gyroid, 32^3 cells", Kind::gyroid, 32},
                          {"graded gyroid, 32^3 cells", Kind::graded_gyroid, 32},
                          {"mesh", Kind::mesh, 0}};

msq_structure* make_structure(msq_context* context, const Work& work) {
  msq_structure* made = nullptr;
  const double size = work.cells ? 1.0 / work.cells : 1;
  const auto cells = [&](msq_neighbourhood& grid) {
    for (double& side : grid.cell_size) side = size;
  };
  if (work.kind == Kind::foam || work.kind == Kind::walls) {
    msq_foam_def def;
    bench::check(msq_foam_def_init(&def, sizeof def));
    cells(def.grid);
    (work.kind == Kind::foam ? def.radius : def.wall_thickness).value = 0.1 * size;
    bench::check(msq_structure_foam(context, &def, &made));
  } else if (work.kind == Kind::lattice || work.kind == Kind::turned_lattice) {
    msq_lattice_def def;
    bench::check(msq_lattice_def_init(&def, sizeof def));
    cells(def.grid);
    def.unit_cell = MSQ_UNIT_CELL_BCC;
    def.radius.value = 0.1 * size;
    if (work.kind == Kind::turned_lattice) bench::turn(def.grid);
    bench::check(msq_structure_lattice(context, &def, &made));
  } else if (work.kind != Kind::mesh) {
    msq_functional_def def;
    bench::check(msq_functional_def_init(&def, sizeof def));
    cells(def.grid);
    msq_field* field = nullptr;
    if (work.kind == Kind::graded_gyroid) {
      const double from[3] = {0, 0, 0}, to[3] = {1, 1, 1};
      bench::check(msq_field_gradient(context, from, 0.1, to, 0.5, &field));
      def.level.field = field;
    }
    bench::check(msq_structure_functional(context, &def, &made));
    msq_field_release(field);
  }
  return made;
}

msq_shape* make_shape(msq_context* context, const Work& work) {
  if (work.kind != Kind::mesh) return bench::make_cube(context);
  const bench::MeshArrays mesh = bench::rippled_torus(520, 260);
  msq_mesh_def def;
  bench::check(msq_mesh_def_init(&def, sizeof def));
  def.vertices = mesh.vertices.data();
  def.vertex_count = mesh.vertices.size() / 3;
  def.triangles = mesh.triangles.data();
  def.triangle_count = mesh.triangles.size() / 3;
  msq_shape* shape;
  bench::check(msq_shape_from_mesh(context, &def, &shape));
  return shape;
}

/// A slicer of the unit cube with its own context.
class Slices {
 public:
  Slices(const Work& work, uint32_t resolution, uint32_t threads, uint64_t cache = 1u << 30,
         uint64_t memory = 0, int32_t output = MSQ_LAYER_BITS) {
    msq_context_def context_def;
    bench::check(msq_context_def_init(&context_def, sizeof context_def));
    context_def.threads = threads;
    context_def.cache_bytes = cache;
    context_def.memory_limit = memory;
    bench::check(msq_context_create(&context_def, &context_));
    msq_model* model =
        bench::make_model(context_, make_shape(context_, work), make_structure(context_, work));
    msq_slicer_def def;
    bench::check(msq_slicer_def_init(&def, sizeof def));
    def.resolution[0] = def.resolution[1] = resolution;
    def.layer_height = 1.0 / resolution;
    def.output = output;
    def.has_region = 1;
    for (double& corner : def.region_max) corner = 1;
    bench::check(msq_slicer_create(model, &def, &slicer_));
    msq_model_release(model);
    msq_slicer_report report{};
    report.struct_size = sizeof report;
    bench::check(msq_slicer_info(slicer_, &report));
    bytes_ = report.layer_bytes;
  }
  ~Slices() {
    msq_slicer_release(slicer_);
    msq_context_release(context_);
  }
  Slices(const Slices&) = delete;

  uint64_t layer_bytes() const { return bytes_; }
  void run(uint64_t first, uint64_t count) const {
    bench::Reader reader;
    bench::check(msq_slicer_run(slicer_, first, count, bench::Reader::take, &reader, nullptr));
  }
  void layer(uint64_t k, std::vector<uint8_t>& into) const {
    bench::check(msq_slice_layer(slicer_, k, into.data(), into.size(), nullptr));
  }
  uint64_t peak() const {
    msq_memory_report report{};
    report.struct_size = sizeof report;
    bench::check(msq_context_memory(context_, &report));
    return report.peak_bytes;
  }

 private:
  msq_context* context_;
  msq_slicer* slicer_;
  uint64_t bytes_;
};

/// Threads of the host take layer after layer from a counter, or each a range of its own.
void ask_by_threads(const Slices& slices, unsigned threads, uint64_t first, uint64_t count,
                    bool is_by_ranges) {
  std::atomic<uint64_t> next{0};
  std::vector<std::thread> workers;
  for (unsigned t = 0; t < threads; ++t)
    workers.emplace_back([&, t] {
      std::vector<uint8_t> bytes(slices.layer_bytes());
      if (is_by_ranges) {
        for (uint64_t k = count * t / threads; k < count * (t + 1) / threads; ++k)
          slices.layer(first + k, bytes);
        return;
      }
      for (uint64_t k = next++; k < count; k = next++) slices.layer(first + k, bytes);
    });
  for (std::thread& worker : workers) worker.join();
}

void bench_work(bench::Report& report, const Work& work, uint32_t resolution) {
  // Up to the last layer, as of a whole stack, and enough that the first ones do not weigh much.
  const uint64_t count = std::min<uint64_t>(768, resolution), first = resolution - count;
  const auto median = [&](const std::function<void(const Slices&)>& ask) {
    std::vector<double> times;
    for (int i = 0; i < 3; ++i) {
      const Slices slices(work, resolution, 1);
      // What is made at the first use is not measured, and cells of other layers are not there.
      slices.run(0, 1);
      times.push_back(bench::processor_seconds_of([&] { ask(slices); }));
    }
    std::sort(times.begin(), times.end());
    return times[1];
  };
  const std::string name = work.name;
  const double run = median([&](const Slices& slices) { slices.run(first, count); });
  report.add(name + ", run", run, static_cast<double>(count), "layer");
  const auto compare = [&](const std::string& how, double target,
                           const std::function<void(const Slices&)>& ask) {
    const double seconds = median(ask);
    report.add(name + ", " + how, seconds, static_cast<double>(count), "layer");
    if (target > 0)
      report.mark("  times a run's share", seconds / run, "", target, false);
    else
      report.note("  times a run's share", seconds / run, "");
  };
  compare("one after the other", 1.3, [&](const Slices& slices) {
    std::vector<uint8_t> bytes(slices.layer_bytes());
    for (uint64_t k = first; k < first + count; ++k) slices.layer(k, bytes);
  });
  compare("scattered", 0, [&](const Slices& slices) {
    std::vector<uint8_t> bytes(slices.layer_bytes());
    std::vector<uint64_t> order(count);
    for (uint64_t k = 0; k < count; ++k) order[k] = first + k;
    std::shuffle(order.begin(), order.end(), std::mt19937(7));
    for (const uint64_t k : order) slices.layer(k, bytes);
  });
  for (const unsigned threads : {2u, 4u, 8u}) {
    compare(std::to_string(threads) + " threads by a counter", 1.3,
            [&](const Slices& slices) { ask_by_threads(slices, threads, first, count, false); });
    compare(std::to_string(threads) + " threads by ranges", 1.3,
            [&](const Slices& slices) { ask_by_threads(slices, threads, first, count, true); });
  }
}

/// 4 x 4 samples per pixel beside one, and beside bits of as many samples.
void bench_grey(bench::Report& report, const Work& work, uint32_t resolution) {
  const uint64_t count = 64, first = resolution / 4;
  const auto seconds = [&](uint32_t pixels, int32_t output) {
    const Slices slices(work, pixels, 1, 1u << 30, 0, output);
    slices.run(first, count);
    std::vector<double> times;
    for (int i = 0; i < 5; ++i)
      times.push_back(bench::processor_seconds_of([&] { slices.run(first, count); }));
    std::sort(times.begin(), times.end());
    return times[2];
  };
  const std::string name = std::string(work.name) + ", ";
  const double bits = seconds(resolution, MSQ_LAYER_BITS);
  const double grey = seconds(resolution, MSQ_LAYER_GREY);
  report.add(name + "bits", bits, static_cast<double>(count), "layer");
  report.add(name + "bits, 4 times the pixels along a side",
             seconds(4 * resolution, MSQ_LAYER_BITS), static_cast<double>(count), "layer");
  report.add(name + "grey, 4 x 4", grey, static_cast<double>(count), "layer");
  report.mark("  times the bits", grey / bits, "", 4.5, false);
}

/// In a process of its own: prints the bytes that layers take beyond those of the process before.
int measure_resident(uint32_t resolution, bool is_run, uint64_t limit, bool is_grey) {
  const auto resident = [] {
    rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) * 1024;
  };
  const Work work{"foam", Kind::foam, 128};
  const double before = resident();
  uint64_t peak = 0;
  try {
    const Slices slices(work, resolution, 2, limit / 4, limit,
                        is_grey ? MSQ_LAYER_GREY : MSQ_LAYER_BITS);
    const uint64_t first = resolution / 4, count = resolution > 4096 ? 16 : 160;
    if (is_run) {
      slices.run(first, count);
    } else {
      std::vector<uint8_t> bytes(slices.layer_bytes());
      for (uint64_t k = first; k < first + count / 4; ++k) slices.layer(k, bytes);
    }
    peak = slices.peak();
  } catch (const std::exception& error) {
    std::printf("refused %s\n", error.what());
    return 0;
  }
  std::printf("%.0f %.0f\n", resident() - before, static_cast<double>(peak));
  return 0;
}

void bench_resident(bench::Report& report) {
  for (const uint32_t resolution : {512u, 4096u, 16384u})
    for (const char* way : {"run", "layers", "grey"})
      for (const uint64_t megabytes : {32u, 48u, 128u, 512u}) {
        const std::string command = "/proc/" + std::to_string(getpid()) + "/exe --resident " +
                                    std::to_string(resolution) + " " + way + " " +
                                    std::to_string(megabytes);
        const std::unique_ptr<FILE, int (*)(FILE*)> child(popen(command.c_str(), "r"), pclose);
        char line[512] = "";
        const std::string name = std::to_string(resolution) + "^2, " +
                                 (way == std::string("layers") ? "single layers"
                                  : way == std::string("run")  ? "run"
                                                               : "run of grey") +
                                 ", memory_limit " + std::to_string(megabytes) + " MiB: ";
        if (!child || !std::fgets(line, sizeof line, child.get()))
          throw std::runtime_error("no answer of " + command);
        double taken = 0, accounted = 0;
        if (std::sscanf(line, "%lf %lf", &taken, &accounted) != 2) {
          std::printf("%s%s", name.c_str(), line);
          continue;
        }
        report.note(name + "resident", taken / (1 << 20), "MiB");
        report.note("  of it accounted at most", accounted / (1 << 20), "MiB");
      }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 5 && !std::strcmp(argv[1], "--resident"))
    return measure_resident(
        static_cast<uint32_t>(std::atoi(argv[2])), std::strcmp(argv[3], "layers") != 0,
        static_cast<uint64_t>(std::atoi(argv[4])) << 20, !std::strcmp(argv[3], "grey"));
  const uint32_t resolution = argc > 2 ? static_cast<uint32_t>(std::atoi(argv[2])) : 2048;
  const std::string part = argc > 3 ? argv[3] : "";
  bench::Report report("single layers, " + std::to_string(resolution) +
                       "^2 pixels, processor time");
  for (const Work& work : works)
    if (std::string(work.name).find(part) != std::string::npos)
      bench_work(report, work, resolution);
  if (std::string("grey").find(part) != std::string::npos)
    for (const Work& work : works)
      if (work.kind == Kind::foam || work.kind == Kind::lattice || work.kind == Kind::gyroid)
        bench_grey(report, work, resolution);
  if (std::string("resident").find(part) != std::string::npos) bench_resident(report);
  report.write(argc, argv);
}
