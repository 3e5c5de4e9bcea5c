// SPDX-License-Identifier: Apache-2.0
// Strut lattices, r = 0.1 cell, in the unit cube: layers as bits, and sets of points with and
// without clusters.
//
// usage: lattice [results.json] [largest slices, default 2048]
#include <cstdlib>
#include <ctime>
#include <optional>
#include <string>

#include "base/random.h"
#include "setup.h"

namespace {

struct Setting {
  int32_t unit_cell = MSQ_UNIT_CELL_BCC;
  double cells = 32;       // along a side of the cube
  bool is_graded = false;  // r from 0.05 cell at one corner of the cube to 0.15 at the other
  bool is_turned = false;  // about two axes
  uint32_t clusters = 0;
  int32_t warp = 0;          // an msq_warp_kind about the middle of the cube; 0: none
  bool is_graded_z = false;  // cells from half to twice the size along z
};

/// Wall and processor time, of two threads; half of the latter is what two free cores would take.
struct Seconds {
  double wall, processor;
};

class Solid {
 public:
  explicit Solid(const Setting* setting) {
    context_ = bench::make_context();
    model_ =
        bench::make_model(context_, bench::make_cube(context_), setting ? make(*setting) : nullptr);
  }
  ~Solid() {
    msq_model_release(model_);
    msq_context_release(context_);
  }
  Solid(const Solid&) = delete;

  Seconds slice(uint32_t resolution) const {
    msq_slicer* slicer = bench::make_slicer(model_, bench::slices_of(resolution));
    bench::Reader reader;
    const Seconds seconds = measure([&] {
      bench::check(msq_slicer_run(slicer, 0, UINT64_MAX, bench::Reader::take, &reader, nullptr));
    });
    msq_slicer_release(slicer);
    return seconds;
  }

  Seconds ask(const std::vector<double>& coordinates) const {
    msq_points_def def;
    bench::check(msq_points_def_init(&def, sizeof def));
    def.kind = MSQ_POINTS_ARRAY;
    def.coordinates = coordinates.data();
    def.count = coordinates.size() / 3;
    std::vector<uint8_t> inside(def.count);
    return measure([&] {
      bench::check(
          msq_set_membership(model_, &def, nullptr, inside.data(), inside.size(), nullptr));
    });
  }

 private:
  static Seconds measure(const std::function<void()>& work) {
    std::vector<double> processor;
    const double wall = bench::median_seconds([&] {
      const std::clock_t start = std::clock();
      work();
      processor.push_back(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    });
    std::nth_element(processor.begin(), processor.begin() + processor.size() / 2, processor.end());
    return {wall, processor[processor.size() / 2]};
  }

  msq_structure* make(const Setting& setting) const {
    msq_lattice_def def;
    bench::check(msq_lattice_def_init(&def, sizeof def));
    def.unit_cell = setting.unit_cell;
    def.clusters = setting.clusters;
    for (double& size : def.grid.cell_size) size = 1 / setting.cells;
    def.radius.value = 0.1 / setting.cells;
    if (setting.is_turned) bench::turn(def.grid);
    msq_warp_def warp = bench::warp_of(setting.warp, setting.cells);
    std::optional<bench::SampledCells> map;
    if (setting.warp == MSQ_WARP_SAMPLED) map.emplace(context_, setting.cells).set(warp);
    if (setting.warp) {
      bench::put_in_middle(def.grid);
      def.warp = &warp;
    }
    const double positions[] = {0, 1}, sizes[] = {0.5 / setting.cells, 2 / setting.cells};
    msq_period_def period;
    bench::check(msq_period_def_init(&period, sizeof period));
    period.axis = 2;
    period.positions = positions;
    period.cell_sizes = sizes;
    period.count = 2;
    if (setting.is_graded_z) def.period = &period;
    msq_field* field = nullptr;
    if (setting.is_graded) {
      const double low[3] = {0, 0, 0}, high[3] = {1, 1, 1};
      bench::check(msq_field_gradient(context_, low, 0.05 / setting.cells, high,
                                      0.15 / setting.cells, &field));
      def.radius = {0, field};
    }
    msq_structure* structure;
    bench::check(msq_structure_lattice(context_, &def, &structure));
    msq_field_release(field);
    return structure;
  }

  msq_context* context_;
  msq_model* model_;
};

struct UnitCell {
  int32_t number;
  const char* name;
};
constexpr UnitCell unit_cells[] = {
    {MSQ_UNIT_CELL_BCC, "BCC"}, {MSQ_UNIT_CELL_OCTET, "octet"}, {MSQ_UNIT_CELL_KELVIN, "Kelvin"}};

std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

void bench_slices(bench::Report& report, uint32_t resolution) {
  const double samples = std::pow(double(resolution), 3);
  const auto add = [&](const std::string& name, const Setting* setting) {
    const Seconds seconds = Solid(setting).slice(resolution);
    report.add(name + ", " + std::to_string(resolution) + "^3", seconds.wall, samples, "sample");
    report.note("  processor time of both threads", seconds.processor, "s");
  };
  add("the cube alone", nullptr);
  for (const UnitCell& cell : unit_cells) {
    const auto add_cells = [&](double cells, bool is_graded, bool is_turned) {
      const Setting setting{cell.number, cells, is_graded, is_turned};
      add(std::string(cell.name) + ", " + number_text(cells) + "^3 cells" +
              (is_graded ? ", gradient of r" : "") + (is_turned ? ", turned grid" : ""),
          &setting);
    };
    for (double cells : {32.0, 128.0, 256.0}) add_cells(cells, false, false);
    for (double cells : {31.7, 127.3, 254.9}) add_cells(cells, false, false);  // no pitch tiles
    for (double cells : {32.0, 254.9}) add_cells(cells, true, false);
    if (cell.number == MSQ_UNIT_CELL_BCC) add_cells(31.7, false, true);
  }
  Setting setting;
  setting.is_graded_z = true;
  add("BCC, 32^2 cells, period graded along z", &setting);
  setting.is_graded_z = false;
  setting.warp = MSQ_WARP_CYLINDRICAL;
  add("BCC, 32 cells across, around an axis", &setting);
  setting.warp = MSQ_WARP_SPHERICAL;
  add("BCC, 32 cells across, around a point", &setting);
  setting.warp = MSQ_WARP_SAMPLED;
  add("BCC, 32 cells across, by a map of 65^3 samples", &setting);
}

/// The same points sorted by the cell that they lie in, or by its clusters, parts^3 a cell, those
/// of all cells together.
std::vector<double> sorted(const std::vector<double>& coordinates, double cells, int parts) {
  struct Point {
    uint64_t key;
    double at[3];
  };
  std::vector<Point> points(coordinates.size() / 3);
  for (size_t i = 0; i < points.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      const double place = coordinates[3 * i + axis] * cells, cell = std::floor(place);
      points[i].at[axis] = coordinates[3 * i + axis];
      points[i].key =
          points[i].key << 12 | static_cast<uint64_t>(parts ? (place - cell) * parts : cell);
    }
  std::sort(points.begin(), points.end(),
            [](const Point& a, const Point& b) { return a.key < b.key; });
  std::vector<double> out;
  for (const Point& p : points) out.insert(out.end(), p.at, p.at + 3);
  return out;
}

/// Points in no order, by cell and by cluster.
void bench_points(bench::Report& report, size_t count) {
  std::vector<double> coordinates(3 * count);
  for (size_t i = 0; i < coordinates.size(); ++i)
    coordinates[i] = static_cast<double>(msq::splitmix_output(1, i) >> 11) * 0x1p-53;
  const std::vector<double> by_cell = sorted(coordinates, 31.7, 0);
  const std::vector<double> by_cluster = sorted(coordinates, 31.7, 24);
  for (const UnitCell& cell : unit_cells)
    for (bool is_graded : {false, true}) {
      Setting setting{cell.number, 31.7, is_graded, false, 1};
      const std::string name = std::string(cell.name) + (is_graded ? ", gradient of r, " : ", ") +
                               std::to_string(count / 1000000) + " million points";
      const double without = Solid(&setting).ask(coordinates).processor;
      setting.clusters = 0;
      const double with = Solid(&setting).ask(coordinates).processor;
      report.add(name + ", no clusters (processor time)", without, double(count), "point");
      report.add(name + ", clusters", with, double(count), "point");
      report.mark("  without against with", without / with, "times", 3, true);
      report.add("  sorted by cell", Solid(&setting).ask(by_cell).processor, double(count),
                 "point");
      report.add("  sorted by cluster", Solid(&setting).ask(by_cluster).processor, double(count),
                 "point");
    }
}

}  // namespace

int main(int count, char** arguments) try {
  bench::Report report("Strut lattices, r = 0.1 cell, two threads");
  const uint32_t largest = count > 2 ? static_cast<uint32_t>(std::atoi(arguments[2])) : 2048;
  bench_slices(report, largest);
  bench_points(report, 4000000);
  report.write(count, arguments);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
