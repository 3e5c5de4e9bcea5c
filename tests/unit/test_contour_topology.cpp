// SPDX-License-Identifier: Apache-2.0
// The topology of contours against that of a mask of 16 x 16 samples to a cell.
#include "slice/contour_topology_cells.h"

#include <functional>
#include <string>

#include "expression/parser.h"
#include "meshes.h"
#include "query/membership.h"
#include "random.h"
#include "rings.h"
#include "shape/boolean.h"
#include "shape/primitive.h"
#include "slice/contours.h"
#include "structure/foam/foam.h"
#include "structure/functional/functional.h"
#include "structure/functional/presets.h"
#include "structure/lattice/cell/unit_cell.h"
#include "structure/lattice/lattice.h"
#include "suite.h"

namespace msq::test {

namespace {

/// Steps of cells of 4 x 4 samples, from their rows as text: the topmost one first, # is solid. All
/// around is the window's edge.
uint64_t steps(std::vector<std::string> rows, bool turns_right = false) {
  const uint32_t up = static_cast<uint32_t>(rows.size() - 1) / 4;
  const uint32_t across = static_cast<uint32_t>(rows[0].size() - 1) / 4;
  TopologyCells cells;
  for (uint32_t r = 0; r < up; ++r)
    for (uint32_t c = 0; c < across; ++c) {
      CellMask mask{4, {}};
      for (uint32_t j = 0; j <= 4; ++j)
        for (uint32_t i = 0; i <= 4; ++i)
          mask.rows[j] |= uint32_t{rows[rows.size() - 1 - 4 * r - j][4 * c + i] == '#'} << i;
      const unsigned sides = unsigned{r == 0} | unsigned{c + 1 == across} << 1 |
                             unsigned{r + 1 == up} << 2 | unsigned{c == 0} << 3;
      cells.add(c, r, mask, turns_right, sides);
    }
  return cells.steps(nullptr);
}

void test_cells(void**) {
  // As the rings have it.
  assert_int_equal(steps({".....", ".....", ".....", ".....", "....."}), 0);
  assert_int_equal(steps({"#####", "#####", "#####", "#####", "#####"}), 0);
  assert_int_equal(steps({"##...", "##...", "###..", "##...", "#...."}), 0);
  assert_int_equal(steps({".....", "...##", ".#.##", ".####", "#####"}), 0);  // bent
  assert_int_equal(steps({"##...", "##...", "##..#", "##.##", "##..#"}), 1);  // beside the edge
  // Parts within a cell.
  assert_int_equal(steps({"#####", "##.##", ".####", "..###", "..###"}), 1);
  assert_int_equal(steps({".....", ".##..", ".....", "...#.", "....."}), 2);
  assert_int_equal(steps({"#####", "#####", "##.##", "#####", "#####"}), 1);
  assert_int_equal(steps({"#####", "#...#", "#.#.#", "#...#", "#####"}), 2);
  // Saddles: solid at the lower left and the upper right, joined or not.
  assert_int_equal(steps({"...##", "...##", "..##.", "###..", "##..."}, true), 0);
  assert_int_equal(steps({"...##", "...##", "..##.", "###..", "##..."}, false), 1);
  assert_int_equal(steps({"...##", "....#", ".....", "#....", "##..."}, true), 1);
  assert_int_equal(steps({"...##", "....#", ".....", "#....", "##..."}, false), 0);
  // Corners join what is solid, not what is empty.
  assert_int_equal(steps({"...##", "...##", "..#..", "##...", "##..."}, true), 0);
  assert_int_equal(steps({"##...", "##...", "..#..", "...##", "...##"}, false), 0);
  // On the window's edge: parts, and a strip that cuts.
  assert_int_equal(steps({".....", ".....", "..###", ".....", "....."}), 1);
  assert_int_equal(steps({".....", ".....", "#####", ".....", "....."}), 1);
  assert_int_equal(steps({"#####", "#####", "#####", "#####", "##.##"}), 0);
  assert_int_equal(steps({"#.###", "#.###", "#.###", "#.###", "#.###"}), 1);
  // Across the side of two cells: a bulge is none, a part is one.
  assert_int_equal(steps({".........", "..#####..", ".........", ".........", "........."}), 1);
  assert_int_equal(steps({"....##...", "...###...", "..####...", "...###...", "....##..."}), 0);
  assert_int_equal(steps({"....#####", "....#####", "..#######", "....#####", "....#####"}), 0);
  assert_int_equal(steps({".....####", "...######", "..#######", "...######", ".....####"}), 0);
  assert_int_equal(steps({"#....####", "#.#######", "#.#######", "#.#######", "#....####"}), 0);
  assert_int_equal(steps({"#....####", "#.#######", "#.#..####", "#.#######", "#....####"}), 1);
  assert_int_equal(steps({"#....####", "#.#######", "#########", "#.#######", "#....####"}), 1);
  assert_int_equal(steps({"#########", "##.....##", "#########", "#########", "#########"}), 1);
  // A strip that leads from part to part through three cells.
  assert_int_equal(
      steps({"##.........##", "##.........##", "#############", "##.........##", "##.........##"}),
      1);
  // A node with a tail is one part; what the tail leads around is one more.
  assert_int_equal(steps({".........", ".........", ".........", "...###...", "..####...",
                          ".....#...", ".....#...", ".........", "........."}),
                   0);
  assert_true(steps({".........", "..#####..", "..#...#..", "..#...#..", "..#...#..", "..#...#..",
                     "..#####..", ".........", "........."}) >= 2);
}

Ref<Context> context() {
  static const Ref<Context> shared = make_ref<Context>(2u, uint64_t{64} << 20, uint64_t{0});
  return shared;
}

Neighbourhood cells(double size, Vec3 origin) {
  return {origin, {size, size, size}, {}};
}

Ref<const Shape> box() {
  return make_ref<BoxShape>(Box3{{0, 0, 0}, {8, 6, 4}});
}

/// Boxes, some of them thinner than a pitch, some of them taken away.
Ref<const Shape> boxes(Random& random) {
  const auto some = [&](int count) {
    std::vector<Ref<const Shape>> all;
    for (int n = 0; n < count; ++n) {
      Box3 b;
      for (int axis = 0; axis < 3; ++axis) {
        const bool is_thin = random.unit() < 0.4;
        b.min[axis] = random.between(0, 3.9);
        b.max[axis] = b.min[axis] + (is_thin ? random.between(0.01, 0.1) : random.between(0.2, 1));
      }
      all.push_back(make_ref<BoxShape>(b));
    }
    return all;
  };
  std::vector<Ref<const Shape>> members = some(60);
  Ref<const Shape> solid = make_ref<BooleanShape>(BooleanShape::Operation::united, some(300));
  members.insert(members.begin(), std::move(solid));
  return make_ref<BooleanShape>(BooleanShape::Operation::subtracted, std::move(members));
}

struct Kind {
  std::string name;
  std::function<Ref<Model>(Random&)> model;
  double pitch;
};

Ref<Model> filled(Ref<const Structure> structure, Parameter skin = Parameter(0)) {
  return make_ref<Model>(
      context(), box(),
      std::vector<Model::ScaleParts>{Model::ScaleParts(std::move(structure), std::move(skin))});
}

Vec3 origin(Random& random) {
  return random.in_box({{0, 0, 0}, {1, 1, 1}});
}

std::vector<Kind> kinds() {
  const auto foam = [](double low, double high) {
    return [=](Random& random) {
      return filled(make_ref<Foam>(context(), cells(1, origin(random)),
                                   Parameter(random.between(low, high)), 1.0, random.bits(),
                                   FoamMethod::direct));
    };
  };
  const auto lattice = [](double low, double high) {
    return [=](Random& random) {
      const double radius = random.between(low, high);
      return filled(make_ref<Lattice>(cells(1.3, origin(random)),
                                      random.below(2) ? bcc_unit_cell() : cubic_unit_cell(),
                                      Parameter(radius)));
    };
  };
  const auto gyroid = [](FunctionalKind kind, double low, double high) {
    return [=](Random& random) {
      return filled(make_ref<Functional>(cells(1.7, origin(random)),
                                         parse_expression(preset_expressions[0], {}), kind,
                                         Parameter(random.between(low, high)), 8));
    };
  };
  return {{"foams", foam(0.05, 0.25), 0.0625},
          {"foams of thin struts", foam(0.01, 0.05), 0.09375},
          {"foams with a skin",
           [](Random& random) {
             return filled(make_ref<Foam>(context(), cells(1, origin(random)), Parameter(0.1), 1.0,
                                          random.bits(), FoamMethod::direct),
                           Parameter(0.2));
           },
           0.0625},
          {"lattices", lattice(0.05, 0.4), 0.0625},
          {"lattices of thin struts", lattice(0.01, 0.05), 0.078125},
          {"gyroid networks", gyroid(FunctionalKind::network, -1.2, 1.2), 0.109375},
          {"gyroid sheets", gyroid(FunctionalKind::sheet, 0.05, 0.6), 0.109375},
          {"boxes",
           [](Random& random) {
             return make_ref<Model>(context(), boxes(random), std::vector<Model::ScaleParts>{});
           },
           0.0625}};
}

/// Numbers of the parts of a mask: solid ones, by sides and corners; and empty ones, by sides, that
/// have no sample on the mask's edges.
struct Parts {
  uint64_t solid = 0, enclosed = 0;
};
Parts parts_of(const std::vector<uint8_t>& inside, size_t across, size_t up) {
  Parts parts;
  std::vector<bool> seen(inside.size());
  std::vector<size_t> stack;
  for (size_t first = 0; first < inside.size(); ++first) {
    if (seen[first]) continue;
    const uint8_t is_solid = inside[first];
    bool is_enclosed = true;
    stack.assign(1, first);
    seen[first] = true;
    while (!stack.empty()) {
      const size_t at = stack.back(), i = at % across, j = at / across;
      stack.pop_back();
      if (i == 0 || j == 0 || i + 1 == across || j + 1 == up) is_enclosed = false;
      for (int dj = -1; dj <= 1; ++dj)
        for (int di = -1; di <= 1; ++di) {
          if (di != 0 && dj != 0 && !is_solid) continue;
          if ((i == 0 && di < 0) || (i + 1 == across && di > 0) || (j == 0 && dj < 0) ||
              (j + 1 == up && dj > 0))
            continue;
          const size_t next = static_cast<size_t>(static_cast<ptrdiff_t>(at) + di +
                                                  dj * static_cast<ptrdiff_t>(across));
          if (seen[next] || inside[next] != is_solid) continue;
          seen[next] = true;
          stack.push_back(next);
        }
    }
    if (is_solid)
      ++parts.solid;
    else
      parts.enclosed += is_enclosed;
  }
  return parts;
}

/// Numbers of outer rings and holes, and of parts of a mask that is 16 times as fine: alike where
/// nothing is counted, and else no more apart than the count. The edges of the windows lie on
/// nodes, so the mask's samples are those of the definition.
void test_against_mask(void** state) {
  const Kind& kind = *static_cast<const Kind*>(*state);
  Random random(41);
  uint64_t resolved_layers = 0, steps = 0, off = 0, all_parts = 0;
  const int layers = 4 + static_cast<int>(20 * test_scale());
  for (int n = 0; n < layers; ++n) {
    const Ref<Model> model = kind.model(random);
    const Scales resolved = model->resolved(0);
    const Box3& bounds = model->bounds();
    ContourPlan plan;
    plan.plane.axis = static_cast<int>(random.below(3));
    plan.plane.height =
        random.between(bounds.min[plan.plane.axis] + 0.1, bounds.max[plan.plane.axis] - 0.1);
    // Finer from time to time, so that all is resolved.
    plan.pitch = kind.pitch * (n % 4 == 3 ? 0.125 : 1);
    plan.tolerance = plan.pitch * random.between(0.05, 0.6);
    plan.topology_samples = 16;
    if (random.below(2)) {
      plan.format = ContourFormat::int64;
      plan.units = 1e6;
    }
    const double cells = 8 + static_cast<double>(random.below(12));
    plan.has_window = true;
    const int axes[2] = {plan.plane.u_axis(), plan.plane.v_axis()};
    for (int i = 0; i < 2; ++i) {
      const double first =
          std::floor(random.between(bounds.min[axes[i]] + 0.2,
                                    bounds.max[axes[i]] - cells * plan.pitch - 0.2) /
                     plan.pitch);
      plan.window_min[i] = (first + 0.3125) * plan.pitch;
      plan.window_max[i] = (first + cells + 0.3125) * plan.pitch;
    }
    const Ref<Contours> made = layer_contours(*model, plan, nullptr);
    assert_true(made->pitch() == plan.pitch);
    const Rings rings = rings_of(reinterpret_cast<const msq_contours*>(made.get()));
    check_rings(rings);
    const size_t count = static_cast<size_t>(16 * cells) + 1;
    std::vector<uint8_t> inside(count * count);
    for (size_t j = 0; j < count; ++j)
      for (size_t i = 0; i < count; ++i)
        inside[j * count + i] = model->inside(
            plan.plane.at(plan.window_min[0] + static_cast<double>(i) * (plan.pitch / 16),
                          plan.window_min[1] + static_cast<double>(j) * (plan.pitch / 16)),
            resolved);
    const Parts parts = parts_of(inside, count, count);
    uint64_t outer = 0, holes = 0;
    for (const uint8_t is_hole : rings.holes) (is_hole ? holes : outer) += 1;
    const auto apart = [](uint64_t a, uint64_t b) { return a > b ? a - b : b - a; };
    const uint64_t most = std::max(apart(outer, parts.solid), apart(holes, parts.enclosed));
    if (most > rings.topology)
      fail_msg("layer %d: %llu outer rings of %llu parts, %llu holes of %llu; the count is %llu", n,
               static_cast<unsigned long long>(outer), static_cast<unsigned long long>(parts.solid),
               static_cast<unsigned long long>(holes),
               static_cast<unsigned long long>(parts.enclosed),
               static_cast<unsigned long long>(rings.topology));
    resolved_layers += rings.topology == 0;
    steps += rings.topology;
    off += most;
    all_parts += parts.solid + parts.enclosed;
  }
  print_message("%s: %d layers, %llu without a count; %llu parts, counted %llu, off by %llu\n",
                kind.name.c_str(), layers, static_cast<unsigned long long>(resolved_layers),
                static_cast<unsigned long long>(all_parts), static_cast<unsigned long long>(steps),
                static_cast<unsigned long long>(off));
  assert_true(resolved_layers > 0);
  // A count that says too much would be of no use.
  assert_true(steps <= 2 * off + 8);
}

}  // namespace

}  // namespace msq::test

int main() {
  using namespace msq::test;
  const CMUnitTest single[] = {cmocka_unit_test(test_cells)};
  std::vector<Kind> all = kinds();
  return cmocka_run_group_tests(single, nullptr, nullptr) +
         run_for_each("topology of contours against a mask", all, test_against_mask);
}
