// SPDX-License-Identifier: Apache-2.0
// Struts as a graph, on two threads, passed to a callback that reads them: lattices of 256^3 cells,
// foams, and beams. Seconds are of wall time; the processor time of two threads, halved, is what
// two free cores would take.
//
// usage: struts [results.json] [cells of lattices along a side, default 256]
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "setup.h"

namespace {

struct Sum {
  double length = 0;
  uint64_t count = 0;
};

int32_t add_up(void* user, const msq_strut* struts, uint64_t count) {
  Sum& sum = *static_cast<Sum*>(user);
  for (uint64_t i = 0; i < count; ++i) {
    const msq_strut& s = struts[i];
    sum.length += s.b[0] - s.a[0] + s.radii[0];
  }
  sum.count += count;
  return 0;
}

struct Row {
  std::string name;
  double cells;
  msq_structure* (*make)(msq_context* context, double cells);
  bool is_target = false;
  bool is_cut = false;
};

msq_structure* make_lattice(msq_context* context, int32_t unit_cell, msq_param radius) {
  msq_lattice_def def;
  bench::check(msq_lattice_def_init(&def, sizeof def));
  def.unit_cell = unit_cell;
  def.radius = radius;
  msq_structure* structure;
  bench::check(msq_structure_lattice(context, &def, &structure));
  return structure;
}

msq_structure* make_bcc(msq_context* context, double) {
  return make_lattice(context, MSQ_UNIT_CELL_BCC, {0.1, nullptr});
}

msq_structure* make_octet(msq_context* context, double) {
  return make_lattice(context, MSQ_UNIT_CELL_OCTET, {0.1, nullptr});
}

msq_structure* make_graded_bcc(msq_context* context, double cells) {
  const double from[3] = {0, 0, 0}, to[3] = {cells, 0, 0};
  msq_field* field;
  bench::check(msq_field_gradient(context, from, 0.05, to, 0.15, &field));
  msq_structure* structure = make_lattice(context, MSQ_UNIT_CELL_BCC, {0, field});
  msq_field_release(field);
  return structure;
}

msq_structure* make_foam(msq_context* context, double) {
  msq_foam_def def;
  bench::check(msq_foam_def_init(&def, sizeof def));
  def.radius.value = 0.1;
  msq_structure* structure;
  bench::check(msq_structure_foam(context, &def, &structure));
  return structure;
}

/// One along each x edge of cells.
msq_structure* make_beams(msq_context* context, double cells) {
  const uint32_t n = static_cast<uint32_t>(cells);
  std::vector<float> nodes;
  std::vector<uint32_t> beams;
  for (uint32_t z = 0; z < n; ++z)
    for (uint32_t y = 0; y < n; ++y)
      for (uint32_t x = 0; x < n; ++x) {
        const uint32_t node = static_cast<uint32_t>(nodes.size() / 3);
        nodes.insert(nodes.end(), {float(x), float(y), float(z)});
        if (x > 0) beams.insert(beams.end(), {node - 1, node});
      }
  msq_beams_def def;
  bench::check(msq_beams_def_init(&def, sizeof def));
  def.coordinate_type = MSQ_FLOAT32;
  def.nodes = nodes.data();
  def.node_count = nodes.size() / 3;
  def.beams = beams.data();
  def.beam_count = beams.size() / 2;
  def.radius = 0.1;
  msq_structure* structure;
  bench::check(msq_structure_beams(context, &def, &structure, nullptr));
  return structure;
}

}  // namespace

int main(int argc, char** argv) {
  const double cells = argc > 2 ? std::strtod(argv[2], nullptr) : 256;
  const Row rows[] = {
      {"BCC", cells, make_bcc, true},
      {"octet", cells / 2, make_octet},
      {"BCC, graded radius", cells / 2, make_graded_bcc},
      {"BCC in a ball", cells / 4, make_bcc, false, true},
      {"foam", cells / 4, make_foam},
      {"beams", cells / 2, make_beams},
  };
  bench::Report report("Struts as a graph, two threads");
  for (const Row& row : rows) {
    msq_context* context = bench::make_context();
    msq_structure* structure = row.make(context, row.cells);
    msq_struts_def def;
    bench::check(msq_struts_def_init(&def, sizeof def));
    for (double& m : def.max) m = row.cells;
    msq_shape* ball = nullptr;
    if (row.is_cut) {
      const double centre[3] = {row.cells / 2, row.cells / 2, row.cells / 2};
      bench::check(msq_shape_from_sphere(context, centre, row.cells / 2, &ball));
      def.shape = ball;
    }
    Sum sum;
    const std::clock_t begin = std::clock();
    const double seconds = bench::seconds_of([&] {
      bench::check(msq_structure_struts(context, structure, &def, add_up, &sum, nullptr));
    });
    const double processor = 0.5 * double(std::clock() - begin) / CLOCKS_PER_SEC;
    const std::string name = row.name + ", " + std::to_string(int(row.cells)) + "^3 cells";
    const double count = static_cast<double>(sum.count);
    report.add(name, seconds, count, "strut");
    report.add(name + ", half of the processor time", processor, count, "strut");
    if (row.is_target)
      report.mark("million struts per second of half the processor time", count / processor * 1e-6,
                  "M/s", 10, true);
    msq_shape_release(ball);
    msq_structure_release(structure);
    msq_context_release(context);
  }
  report.write(argc, argv);
  return 0;
}
