// SPDX-License-Identifier: Apache-2.0
// Lists of beams in the unit cube: building and slicing 10^4 to 10^7 of them, against the lattice
// of which they are the struts. Nodes are those of a BCC lattice, moved by up to 0.1 cell each.
//
// usage: beams [results.json] [resolution, default 2048] [most beams, default 10^7] [least, 10^4]
#include <cstdlib>
#include <ctime>
#include <string>

#include "base/random.h"
#include "setup.h"

namespace {

/// Wall and processor time, of two threads; half of the latter is what two free cores would take.
struct Seconds {
  double wall, processor;
};

Seconds measure(const std::function<void()>& work, double most) {
  std::vector<double> processor;
  const double wall = bench::median_seconds(
      [&] {
        const std::clock_t start = std::clock();
        work();
        processor.push_back(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
      },
      most);
  std::nth_element(processor.begin(), processor.begin() + processor.size() / 2, processor.end());
  return {wall, processor[processor.size() / 2]};
}

enum class Sort { capsules, cones, flat, lattice };

/// The struts of cells^3 BCC cells.
class BeamArrays {
 public:
  BeamArrays(int cells, Sort sort, bool is_moved) : sort_(sort), cells_(cells) {
    const int side = cells + 1;
    const auto corner = [&](int i, int j, int k) {
      return static_cast<uint32_t>((k * side + j) * side + i);
    };
    const auto add_node = [&](double x, double y, double z) {
      for (const double place : {x, y, z}) {
        const double moved = is_moved ? 0.2 * (random() - 0.5) : 0;
        nodes_.push_back((place + moved) / cells);
      }
      node_radii_.push_back((sort == Sort::cones ? 0.05 + 0.1 * random() : 0.1) / cells);
    };
    for (int k = 0; k < side; ++k)
      for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) add_node(i, j, k);
    for (int k = 0; k < cells; ++k)
      for (int j = 0; j < cells; ++j)
        for (int i = 0; i < cells; ++i) {
          const auto centre = static_cast<uint32_t>(node_radii_.size());
          add_node(i + 0.5, j + 0.5, k + 0.5);
          for (int c = 0; c < 8; ++c) {
            beams_.push_back(centre);
            beams_.push_back(corner(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2)));
          }
        }
    if (sort == Sort::cones)
      for (const uint32_t node : beams_) radii_.push_back(node_radii_[node]);
  }

  size_t count() const { return beams_.size() / 2; }
  msq_structure* make(msq_context* context) const {
    msq_structure* structure;
    msq_beams_def def;
    bench::check(msq_beams_def_init(&def, sizeof def));
    def.cap = sort_ == Sort::flat ? MSQ_CAP_BUTT : MSQ_CAP_SPHERE;
    def.nodes = nodes_.data();
    def.node_count = nodes_.size() / 3;
    def.beams = beams_.data();
    def.beam_count = count();
    def.radii = radii_.empty() ? nullptr : radii_.data();
    def.radius = 0.1 / cells_;
    bench::check(msq_structure_beams(context, &def, &structure, nullptr));
    return structure;
  }

 private:
  double random() { return static_cast<double>(msq::splitmix_output(1, drawn_++) >> 11) * 0x1p-53; }

  Sort sort_;
  int cells_;
  uint64_t drawn_ = 0;
  std::vector<double> nodes_, node_radii_, radii_;
  std::vector<uint32_t> beams_;
};

msq_structure* make_lattice(msq_context* context, int cells) {
  msq_lattice_def def;
  bench::check(msq_lattice_def_init(&def, sizeof def));
  for (double& size : def.grid.cell_size) size = 1.0 / cells;
  def.radius.value = 0.1 / cells;
  msq_structure* structure;
  bench::check(msq_structure_lattice(context, &def, &structure));
  return structure;
}

Seconds slice(msq_model* model, uint32_t resolution) {
  msq_slicer* slicer = bench::make_slicer(model, bench::slices_of(resolution));
  bench::Reader reader;
  const Seconds seconds = measure(
      [&] {
        bench::check(msq_slicer_run(slicer, 0, UINT64_MAX, bench::Reader::take, &reader, nullptr));
      },
      3);
  msq_slicer_release(slicer);
  return seconds;
}

/// Single points in and about beams.
double point_seconds(msq_model* model, size_t count) {
  std::vector<double> coordinates(3 * count);
  for (size_t i = 0; i < coordinates.size(); ++i)
    coordinates[i] = static_cast<double>(msq::splitmix_output(2, i) >> 11) * 0x1p-53;
  msq_points_def def;
  bench::check(msq_points_def_init(&def, sizeof def));
  def.kind = MSQ_POINTS_ARRAY;
  def.coordinates = coordinates.data();
  def.count = count;
  std::vector<uint8_t> inside(count);
  return measure(
             [&] {
               bench::check(
                   msq_set_membership(model, &def, nullptr, inside.data(), count, nullptr));
             },
             3)
      .processor;
}

void bench_beams(bench::Report& report, uint32_t resolution, int cells, bool is_largest) {
  const double samples = std::pow(double(resolution), 3);
  msq_context* context = bench::make_context();
  double lattice = 0;
  for (const Sort sort : {Sort::lattice, Sort::capsules, Sort::cones, Sort::flat}) {
    const char* const names[] = {"capsules", "cones", "flat ends", "as a lattice"};
    const std::string name = names[static_cast<int>(sort)];
    msq_structure* structure = nullptr;
    std::string work = std::to_string(8 * cells * cells * cells) + " beams, " + name;
    if (sort == Sort::lattice) {
      structure = make_lattice(context, cells);
    } else {
      const BeamArrays arrays(cells, sort, true);
      const Seconds build = measure(
          [&] {
            msq_structure_release(structure);
            structure = arrays.make(context);
          },
          3);
      report.add(work + ", built", build.wall, double(arrays.count()), "beam");
      report.note("  processor time of both threads", build.processor, "s");
      if (is_largest) report.mark("  half of it", build.processor / 2, "s", 3, false);
    }
    msq_model* model = bench::make_model(context, bench::make_cube(context), structure);
    const Seconds seconds = slice(model, resolution);
    report.add(work + ", " + std::to_string(resolution) + "^3", seconds.wall, samples, "sample");
    report.note("  processor time of both threads", seconds.processor, "s");
    if (sort == Sort::lattice) {
      lattice = seconds.processor;
    } else {
      report.note("  against the lattice", seconds.processor / lattice, "times the time");
      if (is_largest) report.mark("  half of it", seconds.processor / 2, "s", 2, false);
    }
    report.add(work + ", random points (processor time)", point_seconds(model, 1000000), 1e6,
               "point");
    msq_model_release(model);
  }
  msq_memory_report memory;
  memory.struct_size = sizeof memory;
  bench::check(msq_context_memory(context, &memory));
  report.note("  peak memory", static_cast<double>(memory.peak_bytes) / 1e6, "MB");
  msq_context_release(context);
}

}  // namespace

int main(int count, char** arguments) try {
  bench::Report report("Lists of beams, r = 0.1 cell, two threads");
  const uint32_t resolution = count > 2 ? static_cast<uint32_t>(std::atoi(arguments[2])) : 2048;
  const double most = count > 3 ? std::atof(arguments[3]) : 1e7;
  const double least = count > 4 ? std::atof(arguments[4]) : 1e4;
  for (const double beams : {1e4, 1e5, 1e6, 1e7})
    if (beams >= least && beams <= most)
      bench_beams(report, resolution, static_cast<int>(std::lround(std::cbrt(beams / 8))),
                  beams == 1e7);
  report.write(count, arguments);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
