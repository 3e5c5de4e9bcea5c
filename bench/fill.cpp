// SPDX-License-Identifier: Apache-2.0
// Fill lines of a foam, with and without pairs of lines, beside those of a gyroid of equal density:
// travel, paths, the time of the call, and the time that a printer would take.
#include <cmath>
#include <cstdio>
#include <string>

#include "setup.h"

namespace {

constexpr double line_width = 0.45, layer_height = 0.2;  // mm
constexpr double print_speed = 60, travel_speed = 150;   // mm/s
constexpr double acceleration = 1500;                    // mm/s^2
/// By which the velocity may jump at a corner, in mm/s.
constexpr double jerk = 8;
/// Slicers retract before longer travel, for which the nozzle stops; mm.
constexpr double travel_without_stop = 2;

/// Moves of a printer, planned ahead: speeds are limited along moves and at corners, and change by
/// the acceleration.
class Printer {
 public:
  void move(double x, double y, double speed, bool stops_before) {
    const double dx = x - x_, dy = y - y_, length = std::sqrt(dx * dx + dy * dy);
    x_ = x;
    y_ = y;
    if (!(length > 0)) return;
    const double ux = dx / length, uy = dy / length;
    double corner = 0;
    if (!moves_.empty() && !stops_before) {
      const double jump = std::hypot(ux - ux_, uy - uy_);
      corner = std::min(speed, moves_.back().speed);
      if (jump * corner > jerk) corner = jerk / jump;
    }
    moves_.push_back({length, speed, corner});
    ux_ = ux;
    uy_ = uy;
  }
  double distance(double x, double y) const { return std::hypot(x - x_, y - y_); }
  void go_to(double x, double y) {
    x_ = x;
    y_ = y;
  }
  double seconds() {
    double speed = 0;
    for (size_t i = moves_.size(); i-- > 0;) {  // slow enough for what follows
      const double most = std::sqrt(speed * speed + 2 * acceleration * moves_[i].length);
      moves_[i].leaves_at = speed;
      speed = std::min(moves_[i].enters_at, most);
      moves_[i].enters_at = speed;
    }
    double sum = 0;
    speed = 0;
    for (const Move& move : moves_) {
      const double first = std::min(speed, move.enters_at);
      const double last =
          std::min(move.leaves_at, std::sqrt(first * first + 2 * acceleration * move.length));
      const double top = std::min(
          move.speed, std::sqrt(acceleration * move.length + 0.5 * (first * first + last * last)));
      const double ramps = (2 * top * top - first * first - last * last) / (2 * acceleration);
      sum += (2 * top - first - last) / acceleration + (move.length - ramps) / top;
      speed = last;
    }
    moves_.clear();
    return sum;
  }

 private:
  struct Move {
    double length, speed, enters_at, leaves_at = 0;
  };
  std::vector<Move> moves_;
  double x_ = 0, y_ = 0, ux_ = 0, uy_ = 0;
};

/// What is compared. PAIRS: a foam some of whose walls are two lines side by side.
enum Pattern { FOAM, PAIRS, GYROID, PATTERNS };
constexpr const char* names[PATTERNS] = {"foam", "foam in pairs", "gyroid"};

msq_structure* make_structure(msq_context* context, Pattern pattern, const double cell[3]) {
  msq_structure* structure;
  if (pattern != GYROID) {
    msq_foam_def def;
    bench::check(msq_foam_def_init(&def, sizeof def));
    for (int i = 0; i < 3; ++i) def.grid.cell_size[i] = cell[i];
    def.radius.value = 0.01 * cell[0];
    bench::check(msq_structure_foam(context, &def, &structure));
  } else {
    msq_functional_def def;
    bench::check(msq_functional_def_init(&def, sizeof def));
    for (int i = 0; i < 3; ++i) def.grid.cell_size[i] = cell[i];
    def.kind = MSQ_FUNCTIONAL_SHEET;
    def.level.value = 0.1;
    bench::check(msq_structure_functional(context, &def, &structure));
  }
  return structure;
}

struct Totals {
  double length = 0, travel = 0, seconds = 0, paths = 0, call = 0;
};

void add_layer(Totals& totals, const msq_fill_report& paths) {
  const auto* points = static_cast<const int64_t*>(paths.points);
  Printer printer;
  const auto go = [&](uint64_t i, double speed, bool stops) {
    printer.move(1e-6 * static_cast<double>(points[2 * i]),
                 1e-6 * static_cast<double>(points[2 * i + 1]), speed, stops);
  };
  for (uint64_t p = 0; p < paths.path_count; ++p) {
    const uint64_t first = paths.path_starts[p], last = paths.path_starts[p + 1];
    const double x = 1e-6 * static_cast<double>(points[2 * first]),
                 y = 1e-6 * static_cast<double>(points[2 * first + 1]);
    if (p == 0) printer.go_to(x, y);
    const bool stops = printer.distance(x, y) > travel_without_stop;
    go(first, travel_speed, stops);
    for (uint64_t i = first + 1; i < last; ++i) go(i, print_speed, i == first + 1 && stops);
    if (paths.closed[p]) go(first, print_speed, false);
  }
  totals.seconds += printer.seconds();
  totals.length += paths.length;
  totals.travel += paths.travel;
  totals.paths += static_cast<double>(paths.path_count);
}

Totals fill_stack(msq_context* context, const msq_structure* structure, Pattern pattern,
                  double side, int layers, double step) {
  const auto end = static_cast<int64_t>(side * 1e6);
  const int64_t square[8] = {0, 0, end, 0, end, end, 0, end};
  const msq_ring ring = {square, 4};
  Totals totals;
  for (int k = 0; k < layers; ++k) {
    msq_fill_def def;
    bench::check(msq_fill_def_init(&def, sizeof def));
    def.rings = &ring;
    def.ring_count = 1;
    def.scale = 1e-6;
    def.z = (k + 0.5) * step;
    def.tolerance = 0.0125;
    def.min_length = 0.8 * line_width;
    def.pair_distance = pattern == PAIRS ? line_width : 0;
    msq_fill* fill = nullptr;
    totals.call += bench::seconds_of(
        [&] { bench::check(msq_fill_lines(context, structure, &def, &fill, nullptr)); });
    msq_fill_report paths{};
    paths.struct_size = sizeof paths;
    bench::check(msq_fill_info(fill, &paths));
    add_layer(totals, paths);
    msq_fill_release(fill);
  }
  return totals;
}

msq_structure* calibrated(msq_context* context, Pattern pattern, double density, double cell[3]) {
  for (int i = 0; i < 3; ++i) cell[i] = 1;
  msq_structure* unit = make_structure(context, pattern, cell);
  bench::check(msq_fill_calibrate(context, unit, line_width, density, cell, nullptr));
  msq_structure_release(unit);
  return make_structure(context, pattern, cell);
}

/// Calibration counts each line once. In pairs lines cover more, which is measured and divided by.
msq_structure* of_density(msq_context* context, Pattern pattern, double density, double cell[3]) {
  msq_structure* structure = calibrated(context, pattern, density, cell);
  if (pattern != PAIRS) return structure;
  const double side = 20 * cell[0];
  const int layers = 8;
  const Totals sum = fill_stack(context, structure, pattern, side, layers, 2.11);
  msq_structure_release(structure);
  const double found = sum.length * line_width / (layers * side * side);
  return calibrated(context, pattern, density * density / found, cell);
}

/// Rings and solid layers of a cube besides its fill: what both patterns print alike.
double seconds_of_shells(double side, int layers, int solid_layers) {
  Printer printer;
  double low = 0.5 * line_width, high = side - low;
  for (int ring = 0; ring < 2; ++ring, low += line_width, high -= line_width) {
    printer.move(low, low, travel_speed, true);
    printer.move(high, low, print_speed, true);
    printer.move(high, high, print_speed, false);
    printer.move(low, high, print_speed, false);
    printer.move(low, low, print_speed, false);
  }
  const double rings = printer.seconds();
  bool is_back = false;
  for (double y = low; y < high; y += line_width, is_back = !is_back) {
    printer.move(is_back ? high : low, y, print_speed, y == low);
    printer.move(is_back ? low : high, y, print_speed, false);
  }
  return layers * rings + solid_layers * printer.seconds();
}

void measure(bench::Report& report, double density) {
  char text[120];
  msq_context* context = bench::make_context(1);
  double cell[PATTERNS][3], fill[PATTERNS], cubes[PATTERNS];
  msq_structure* structures[PATTERNS];
  const auto all = {FOAM, PAIRS, GYROID};
  for (const Pattern p : all) structures[p] = of_density(context, p, density, cell[p]);
  const double side = 20 * cell[FOAM][0];
  const int layers = 32;
  // A cube as slicers print it, with 2 rings and 5 + 5 solid layers.
  const double cube = 40, inner = cube - 4 * line_width;
  const int cube_layers = static_cast<int>(cube / layer_height), solid = 10;
  for (const Pattern p : all) {
    const Totals sum = fill_stack(context, structures[p], p, side, layers, 1.37);
    std::snprintf(text, sizeof text, "%s, %.0f %%, %.0f x %.0f mm, cells of %.2f mm: call",
                  names[p], 100 * density, side, side, cell[p][0]);
    report.add(text, sum.call / layers, sum.length / layers, "mm");
    const auto note = [&](const char* what, double value, const char* unit) {
      std::snprintf(text, sizeof text, "%s, %.0f %%: %s", names[p], 100 * density, what);
      report.note(text, value, unit);
    };
    fill[p] = sum.seconds / sum.length;
    note("travel", 100 * sum.travel / sum.length, "% of the length");
    note("paths", sum.paths / layers, "per layer");
    note("length of a path", sum.length / sum.paths, "mm");
    note("density", 100 * sum.length * line_width / (layers * side * side), "%");
    note("printing", fill[p] * 1000, "s per m of line");
    const Totals stack =
        fill_stack(context, structures[p], p, inner, cube_layers - solid, layer_height);
    cubes[p] = stack.seconds + seconds_of_shells(cube, cube_layers, solid);
    note("cube of 40 mm, of which the fill", 100 * stack.seconds / cubes[p], "%");
    note("cube of 40 mm", cubes[p] / 60, "min");
  }
  for (const Pattern p : {FOAM, PAIRS}) {
    std::snprintf(text, sizeof text, "%s / gyroid, %.0f %%: time of the fill", names[p],
                  100 * density);
    report.note(text, fill[p] / fill[GYROID], "times");
    std::snprintf(text, sizeof text, "%s / gyroid, %.0f %%: time of the cube", names[p],
                  100 * density);
    if (p == PAIRS)
      report.mark(text, cubes[p] / cubes[GYROID], "times", 1.1, false);
    else
      report.note(text, cubes[p] / cubes[GYROID], "times");
  }
  for (msq_structure* structure : structures) msq_structure_release(structure);
  msq_context_release(context);
}

}  // namespace

int main(int count, char** arguments) try {
  bench::Report report("fill lines of 0.45 mm, one thread");
  for (const double density : {0.15, 0.3}) measure(report, density);
  report.write(count, arguments);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
