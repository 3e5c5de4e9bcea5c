// SPDX-License-Identifier: Apache-2.0
// Middle lines of walls: they lie in the solid; the sign of a function changes across them and
// nowhere else; they do not depend on the window.
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/pi.h"
#include "random.h"
#include "structure/host/host_function.h"
#include "structure/waves/wave_kernels.h"
#include "structure/waves/waves.h"
#include "structures.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

/// The function, less the level of a network; where its cells are; no number elsewhere.
double level_at(const Structure& structure, Vec3 p) {
  if (const auto* f = dynamic_cast<const Functional*>(&structure)) {
    if (f->angles().is_mapped() && !f->angles().holds(p)) return NAN;
    return evaluate(f->function(), f->angles().at(p)) - (f->is_sheet() ? 0 : f->level().at(p));
  }
  if (const auto* host = dynamic_cast<const HostFunction*>(&structure)) {
    double value;
    host->differences(&p, 1, &value);
    return value;
  }
  const auto& waves = dynamic_cast<const Waves&>(structure);
  return wave_sum(waves.waves(), waves.position(p)) - (waves.is_sheet() ? 0 : waves.level().at(p));
}

/// Whether the cells around an axis are too narrow there for the grid that lines are found on.
bool is_narrow(const Structure& structure, Vec3 p) {
  const auto* f = dynamic_cast<const Functional*>(&structure);
  if (!f || !f->angles().warp()) return false;
  const Warp& warp = *f->angles().warp();
  return two_pi * warp.axis_distance(p) / warp.shell().count < 0.5 * warp.grid().cell_size.x;
}

bool has_level(const Structure& structure) {
  return dynamic_cast<const Functional*>(&structure) || dynamic_cast<const Waves*>(&structure) ||
         dynamic_cast<const HostFunction*>(&structure);
}

/// Lines of a network are its boundary; those of an open foam are the faces of its cells.
bool holds_lines(const StructureRow& row, const Structure& structure) {
  if (const auto* f = dynamic_cast<const Functional*>(&structure)) return f->is_sheet();
  if (const auto* waves = dynamic_cast<const Waves*>(&structure)) return waves->is_sheet();
  if (const auto* host = dynamic_cast<const HostFunction*>(&structure)) return host->is_sheet();
  // Fillets take a part of the walls.
  return row.kind.family != "combined" && row.kind.family != "smooth" &&
         !dynamic_cast<const Foam*>(&structure) &&
         !(row.kind.family == "warped foam" && row.kind.name.find("struts") != std::string::npos &&
           row.kind.name.find("walls") == std::string::npos);
}

Vec2 point_on(const LineGraph& graph, const std::array<uint32_t, 2>& line, double t) {
  return graph.points[line[0]] + (graph.points[line[1]] - graph.points[line[0]]) * t;
}

/// An upper bound on the distance to the level, by the slope in the plane; infinity where it is too
/// flat to tell.
double distance_to_level(const Structure& structure, Vec2 p, double z, double cell) {
  const double step = 1e-5 * cell;
  const auto at = [&](double x, double y) { return level_at(structure, {x, y, z}); };
  const double slope = std::hypot(at(p.x + step, p.y) - at(p.x - step, p.y),
                                  at(p.x, p.y + step) - at(p.x, p.y - step)) /
                       (2 * step);
  return slope * cell > 0.5 ? std::abs(at(p.x, p.y)) / slope : NAN;
}

size_t crossings(const LineGraph& graph, Vec2 p, Vec2 q) {
  size_t count = 0;
  for (const auto& [a, b] : graph.lines) {
    const Vec2 from = graph.points[a], to = graph.points[b];
    if (std::min(from.x, to.x) > std::max(p.x, q.x) || std::max(from.x, to.x) < std::min(p.x, q.x))
      continue;
    const bool splits = (cross(q - p, from - p) > 0) != (cross(q - p, to - p) > 0);
    const bool is_split = (cross(to - from, p - from) > 0) != (cross(to - from, q - from) > 0);
    count += splits && is_split;
  }
  return count;
}

void check_signs(const StructureRow& row, const Structure& structure, const LineGraph& graph,
                 const Box2& window, double z, double cell) {
  Random random(row.index + 5);
  size_t changes = 0, wrong = 0, asked = 0;
  for (size_t i = 0; i < test_count(1500); ++i) {
    const Vec2 p{random.between(window.min.x, window.max.x),
                 random.between(window.min.y, window.max.y)};
    const double angle = random.between(0, 2 * pi);
    const Vec2 q = p + Vec2{std::cos(angle), std::sin(angle)} * (0.2 * cell);
    if (!window.contains(q) || is_narrow(structure, {p.x, p.y, z})) continue;
    const double at_p = level_at(structure, {p.x, p.y, z}),
                 at_q = level_at(structure, {q.x, q.y, z});
    if (!(std::abs(at_p) + std::abs(at_q) < 1e9)) continue;
    // Lines closer than a square of the grid may be joined.
    if (!(distance_to_level(structure, p, z, cell) > cell / 32) ||
        !(distance_to_level(structure, q, z, cell) > cell / 32))
      continue;
    const bool differ = (at_p <= 0) != (at_q <= 0);
    ++asked;
    changes += differ;
    if (differ != (crossings(graph, p, q) % 2 == 1)) {
      ++wrong;
      print_message("lines and signs differ at %.17g, %.17g to %.17g, %.17g\n", p.x, p.y, q.x, q.y);
    }
  }
  assert_true(test_scale() < 1 || (asked > 100 && changes > 10));
  assert_int_equal(wrong, 0);
}

void check_points(const StructureRow& row, const Structure& structure, const LineGraph& graph,
                  double z) {
  Random random(row.index + 6);
  for (size_t i = 0; i < test_count(2000); ++i) {
    const auto& line = graph.lines[random.below(graph.lines.size())];
    const Vec2 p = point_on(graph, line, random.between(0.01, 0.99));
    if (!is_narrow(structure, {p.x, p.y, z}) && !structure.inside({p.x, p.y, z}))
      fail_msg("the line at %.17g, %.17g is outside", p.x, p.y);
  }
}

using Line = std::array<double, 4>;

/// By their first coordinate.
std::vector<Line> lines_within(const LineGraph& graph, const Box2& box) {
  std::vector<Line> found;
  for (const auto& [a, b] : graph.lines) {
    Vec2 p = graph.points[a], q = graph.points[b];
    if (!box.contains(p) || !box.contains(q)) continue;
    if (p.x > q.x || (p.x == q.x && p.y > q.y)) std::swap(p, q);
    found.push_back({p.x, p.y, q.x, q.y});
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// Whether each line is one of the others. Those of seeds without jitter are rounded differently.
void check_found(const std::vector<Line>& lines, const std::vector<Line>& others, double rounding) {
  for (const Line& line : lines) {
    auto other = std::lower_bound(others.begin(), others.end(), Line{line[0] - rounding, 0, 0, 0});
    const auto has_ends = [&](const Line& known, size_t first) {
      for (size_t i = 0; i < 4; ++i)
        if (std::abs(known[(first + i) % 4] - line[i]) > rounding) return false;
      return true;
    };
    // Rounding may exchange the ends of a line along y.
    const auto is_same = [&](const Line& known) {
      return has_ends(known, 0) || has_ends(known, 2);
    };
    while (other != others.end() && (*other)[0] <= line[0] + rounding && !is_same(*other)) ++other;
    if (other == others.end() || !is_same(*other))
      fail_msg("no line from %.17g, %.17g to %.17g, %.17g", line[0], line[1], line[2], line[3]);
  }
}

void test_row(void** state) {
  const StructureRow& row = *static_cast<const StructureRow*>(*state);
  const Ref<const Structure> structure = row.make({});
  const Neighbourhood& grid = row.variant.grid;
  const double cell = min_component(structure->neighbourhood().cell_size), size = row.unit();
  const double z = grid.origin.z + 0.317 * size, x = grid.origin.x, y = grid.origin.y;
  const Box2 window{{x - 1.7 * size, y - 1.4 * size}, {x + 1.9 * size, y + 1.6 * size}};
  const LineGraph graph = structure->wall_lines({z, window, 1e-3 * cell});
  print_message("%s: %zu lines\n", row.name.c_str(), graph.lines.size());
  assert_true(graph.lines.size() > 10);
  if (has_level(*structure)) check_signs(row, *structure, graph, window, z, cell);
  if (holds_lines(row, *structure)) check_points(row, *structure, graph, z);
  const Box2 small{{x - 1.6 * size, y - 1.2 * size}, {x + 1.2 * size, y + 1.5 * size}};
  const Box2 within = small.grown(-0.047 * size);
  const std::vector<Line> all = lines_within(graph, within);
  const std::vector<Line> part =
      lines_within(structure->wall_lines({z, small, 1e-3 * cell}), within);
  assert_true(all.size() > 3);
  check_found(all, part, 1e-9 * size);
  check_found(part, all, 1e-9 * size);
}

}  // namespace

int main() {
  std::vector<StructureRow> rows;
  for (const StructureRow& row : structures()) {
    if (row.is_graded || row.is_method_1() || row.is_method_2() || row.has_dear_points()) continue;
    if (test_scale() < 1 && row.variant.is_axis_aligned && !row.variant.name.empty()) continue;
    if (row.make({})->thin_walls() != ThinWalls::none) rows.push_back(row);
  }
  return run_for_each("wall lines", rows, test_row);
}
