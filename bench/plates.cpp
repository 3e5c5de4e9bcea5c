// SPDX-License-Identifier: Apache-2.0
// Plate lattices, t = 0.1 cell, in the unit cube: layers as bits.
//
// usage: plates [results.json] [samples along a side, default 2048] [part of the names of the
// works]
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <string>

#include "setup.h"

namespace {

struct Work {
  const char* name;
  int32_t plate_cell;
  double cells;
  bool is_graded;  // t from 0.05 cell at one corner of the cube to 0.15 at the other
  bool is_turned;  // about two axes
};
constexpr Work works[] = {
    {"cubic, 32^3 cells", MSQ_PLATE_CELL_CUBIC, 32, false, false},
    {"cubic, 31.7^3 cells", MSQ_PLATE_CELL_CUBIC, 31.7, false, false},
    {"cubic and octet, 32^3 cells", MSQ_PLATE_CELL_CUBIC_OCTET, 32, false, false},
    {"cubic and octet, 31.7^3 cells", MSQ_PLATE_CELL_CUBIC_OCTET, 31.7, false, false},
    {"cubic and octet, 127.3^3 cells", MSQ_PLATE_CELL_CUBIC_OCTET, 127.3, false, false},
    {"cubic and octet, gradient of t", MSQ_PLATE_CELL_CUBIC_OCTET, 31.7, true, false},
    {"cubic and octet, turned grid", MSQ_PLATE_CELL_CUBIC_OCTET, 31.7, false, true},
    {"Kelvin, 31.7^3 cells", MSQ_PLATE_CELL_KELVIN, 31.7, false, false},
};

/// Processor time of two threads.
double slice(const Work& work, uint32_t resolution) {
  msq_context* context = bench::make_context();
  msq_plate_lattice_def def;
  bench::check(msq_plate_lattice_def_init(&def, sizeof def));
  def.plate_cell = work.plate_cell;
  for (double& size : def.grid.cell_size) size = 1 / work.cells;
  def.thickness.value = 0.1 / work.cells;
  if (work.is_turned) bench::turn(def.grid);
  msq_field* field = nullptr;
  if (work.is_graded) {
    const double low[3] = {0, 0, 0}, high[3] = {1, 1, 1};
    bench::check(
        msq_field_gradient(context, low, 0.05 / work.cells, high, 0.15 / work.cells, &field));
    def.thickness = {0, field};
  }
  msq_structure* structure;
  bench::check(msq_structure_plate_lattice(context, &def, &structure));
  msq_field_release(field);
  msq_model* model = bench::make_model(context, bench::make_cube(context), structure);
  msq_slicer* slicer = bench::make_slicer(model, bench::slices_of(resolution));
  bench::Reader reader;
  const std::clock_t start = std::clock();
  bench::check(msq_slicer_run(slicer, 0, UINT64_MAX, bench::Reader::take, &reader, nullptr));
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  msq_slicer_release(slicer);
  msq_model_release(model);
  msq_context_release(context);
  return seconds;
}

}  // namespace

int main(int argc, char** argv) try {
  const uint32_t resolution = argc > 2 ? static_cast<uint32_t>(std::atoi(argv[2])) : 2048;
  bench::Report report("Plate lattices, t = 0.1 cell, processor time of two threads");
  for (const Work& work : works) {
    if (argc > 3 && !std::strstr(work.name, argv[3])) continue;
    report.add(std::string(work.name) + ", " + std::to_string(resolution) + "^3",
               slice(work, resolution), std::pow(double(resolution), 3), "sample");
  }
  report.write(argc, argv);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
