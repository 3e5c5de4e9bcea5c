// SPDX-License-Identifier: Apache-2.0
// Rays hit where membership first changes, against dense samples of membership: at random, along
// the axes, and past surfaces that they only just touch or miss, found by halving between rays that
// hit and rays that go on. Some are aimed at a point inside, which they must not pass. Normals are
// the gradient of the onset, and point out.
//
// 10^5 rays of one structure: contract_test_ray_hits "octet, thin" 100000; with its grid 1000 cells
// from where it was: contract_test_ray_hits "octet, thin*" 100000 1000; of every kind:
// scripts/test_rays.
#include <map>
#include <string>
#include <vector>

#include "random.h"
#include "ray_checker.h"
#include "structures.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

size_t asked_rays = 0;  // of each row, on the command line

/// Of all rows of a family: rows alone have few normals, and some of them near edges.
std::map<std::string, Flatness> flatness;

/// The number of families whose normals are not across the boundary.
int tilted_families() {
  int count = 0;
  for (const auto& [family, normals] : flatness) {
    if (!normals.are_most_tilted()) continue;
    print_error("%s: %zu normals are tilted, %zu are not\n", family.c_str(), normals.tilted,
                normals.straight);
    ++count;
  }
  return count;
}

/// Casts a ray, one in four at a point inside, and one in two with another beside it.
void test_ray(const StructureRow& row, const Structure& structure, RayChecker& checker, size_t i,
              Random& random) {
  const Neighbourhood& grid = row.variant.grid;
  const double to = 2.5 * row.unit();
  const auto point = [&] {
    return grid.from_grid(random.in_box({{-1, -1, -1}, {2, 2, 2}}) * grid.cell_size);
  };
  const Vec3 from = point();
  Vec3 target = point();
  if (i % 8 == 0) {  // along an axis of the grid
    Vec3 along;
    along[static_cast<int>(random.below(3))] = 1;
    target = from + grid.rotation.apply(along);
  }
  Ray ray{from, (target - from) * (1 / length(target - from))};
  double aimed = -1;
  for (int tries = 0; i % 4 == 1 && tries < 500 && aimed < 0; ++tries) {
    const Vec3 p = point();
    if (!structure.inside(p)) continue;
    const double t = random.between(0.1, 0.9) * to;
    ray.origin = p - ray.direction * t;
    if (checker.is_seen(ray, t)) aimed = t;
  }
  const RaySearch search = checker.cast(ray, to);
  if (aimed >= 0) checker.check_aimed(search, aimed);
  checker.check(search);
  if (i % 2) return;
  Ray beside = ray;
  const Vec3 across{random.normal(), random.normal(), random.normal()};
  beside.origin = ray.origin + across * (0.1 * row.unit());
  checker.check_graze(ray, beside, to, std::exp2(-random.between(4, 30)) * row.unit());
}

/// Rays that graze a strut, by name of row. Those that are inside at `inside` are for some 10^-5
/// cells around it, though no deeper than 10^-8 below the surface; of the other about one number
/// in two is inside in the last tolerances before its hit, and never a hundred in a row.
struct Graze {
  const char* row;
  Ray ray;
  double inside;  // or -1
};
constexpr Graze grazes[] = {
    {"cubic, ties, turned",
     {{-0.94520947975099712, -0.2411891513291588, 1.6900650912750186},
      {0.50162867075469952, 0.86212209465818002, -0.071513429361663702}},
     -1},
    {"octet, ties, turned, graded",
     {{1.9496972455690804, 1.0776144132603105, -1.0955140224842412},
      {0.0085023846776999933, 0.79066003807606833, 0.61219638486709704}},
     0.26852113580415443},
    {"octet, ties, turned, graded",
     {{-3.578522017986308, 1.0546618022806282, -3.8332355580592656},
      {0.76484218728448861, 0.64421768723769102, 0}},
     4.4534265316017416},
    {"foam DIRECT, jitter 0 r 0.1",
     {{1.2851384441127873, -1.0045542991754357, 1.0998971912549012},
      {0.1281784581470522, 0.99091028507381407, 0.040830011045517103}},
     0.00041476002988929397},
};

void test_graze(const StructureRow& row, RayChecker& checker, const Graze& graze) {
  const RaySearch search = checker.cast(graze.ray, 2.5 * row.unit());
  if (graze.inside >= 0) {
    assert_true(checker.is_seen(graze.ray, graze.inside));
    checker.check_aimed(search, graze.inside);
  }
  checker.check(search);
}

void test_row(void** state) {
  const StructureRow& row = *static_cast<const StructureRow*>(*state);
  const Neighbourhood& grid = row.variant.grid;
  const Vec3 centre = grid.from_grid(grid.cell_size * 0.5);
  const Ref<const Structure> structure = row.make(centre);
  RayChecker checker(row, *structure, row.parameter(centre),
                     row.cells_away > 0 ? row.max_coordinate() : 0, asked_rays > 0);
  Random random(row.index + 17);
  const size_t count =
      asked_rays ? asked_rays : row.samples((row.is_lattice() ? 60 : 8) * row.family_rows);
  size_t failures = 0;
  const auto count_failure = [&](auto&& test) {
    try {
      test();
    } catch (const RayFailure&) {
      ++failures;
    }
  };
  for (const Graze& graze : grazes)
    if (row.name == graze.row) count_failure([&] { test_graze(row, checker, graze); });
  for (size_t i = 0; i < count; ++i)
    count_failure([&] { test_ray(row, *structure, checker, i, random); });
  if (asked_rays) {
    print_message("rays %zu hits %zu grazes %zu normals %zu failures %zu\n", count, checker.hits,
                  checker.grazes, checker.normals, failures);
    assert_int_equal(failures, 0);
  }
  assert_true(checker.hits > 0);
  // Structures of the host that know membership alone have estimates.
  if (row.kind.family != "host" || structure->has_onset())
    flatness[row.kind.family].add(checker.flatness);
  if (count < 50) return;
  if (structure->has_onset()) assert_true(checker.normals > 0);
  if (checker.inward * 10 > checker.outward)
    fail_msg("%zu normals point in, %zu out", checker.inward, checker.outward);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<StructureRow> rows = structures_by_point();
  if (argc > 2) asked_rays = std::strtoull(argv[2], nullptr, 10);
  if (const double away = argc > 3 ? std::strtod(argv[3], nullptr) : 0; away > 0)
    for (StructureRow& row : rows) row = row.moved(away);
  if (argc > 1)
    cmocka_set_test_filter(argv[1]);
  else  // the others by name only: their edges are dear, and test_rays.cpp asks a few
    std::erase_if(rows, [](const StructureRow& row) {
      const std::string tried = "foam DIRECT, density 1 to 30, jitter 1 r 0.06";
      return row.name.find("density") != std::string::npos && row.name != tried &&
             row.name != tried + ", graded";
    });
  const int failed = run_for_each("ray_hits", rows, test_row);
  return failed + tilted_families();
}
