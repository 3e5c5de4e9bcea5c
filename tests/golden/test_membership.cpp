// SPDX-License-Identifier: Apache-2.0
// Membership against make_golden.py, a slow oracle of its own: see there for the points and marks.
#include <fstream>
#include <sstream>
#include <string>

#include "field/gradient.h"
#include "msq_test.h"
#include "structure/foam/foam.h"
#include "structure/foam/paper/delaunay.h"
#include "structure/lattice/lattice.h"

using namespace msq;

namespace {

constexpr size_t point_count = 2500;

/// One entry of the golden file.
struct Golden {
  std::string name, marks;
  Vec3 size, low, high;
  double radius_low = 0, radius_high = 0, jitter = 0;
  uint64_t seed = 0;
};

std::vector<Golden> read_golden() {
  std::vector<Golden> all;
  std::ifstream file(MSQ_SOURCE_DIR "/tests/golden/membership.txt");
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    if (line[0] == '0' || line[0] == '1' || line[0] == '?') {
      all.back().marks += line;
      continue;
    }
    Golden g;
    std::istringstream in(line);
    in >> g.name >> g.size.x >> g.size.y >> g.size.z >> g.radius_low >> g.radius_high >> g.low.x >>
        g.low.y >> g.low.z >> g.high.x >> g.high.y >> g.high.z >> g.seed >> g.jitter;
    assert_false(in.fail());
    all.push_back(g);
  }
  return all;
}

/// SplitMix64, written out once more: this side of the comparison shares no code with the other.
double coordinate(uint64_t n, double low, double high) {
  uint64_t x = 1234 + n * 0x9e3779b97f4a7c15;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  x ^= x >> 31;
  return low + (high - low) * static_cast<double>(x >> 44) / 1048576;
}

Ref<const Structure> make(const Golden& g, Ref<Context> context, FoamMethod method) {
  Neighbourhood grid;
  grid.cell_size = g.size;
  Parameter radius(g.radius_low);
  if (g.radius_low != g.radius_high)
    radius = Parameter(Ref<const Field>(make_ref<GradientField>(
        Vec3{g.low.x, 0, 0}, g.radius_low, Vec3{g.high.x, 0, 0}, g.radius_high)));
  if (g.name == "foam") return make_ref<Foam>(context, grid, radius, g.jitter, g.seed, method);
  return make_ref<Lattice>(grid,
                           g.name == "cubic" ? cubic_unit_cell()
                           : g.name == "bcc" ? bcc_unit_cell()
                                             : octet_unit_cell(),
                           radius);
}

void test_golden(void**) {
  const Ref<Context> context = make_ref<Context>(1u, uint64_t{64} << 20, uint64_t{0});
  const std::vector<Golden> all = read_golden();
  assert_int_equal(all.size(), 11);
  for (const Golden& g : all) {
    assert_int_equal(g.marks.size(), point_count);
    std::vector<Vec3> points;
    for (size_t i = 0; i < point_count; ++i)
      points.push_back({coordinate(3 * i, g.low.x, g.high.x),
                        coordinate(3 * i + 1, g.low.y, g.high.y),
                        coordinate(3 * i + 2, g.low.z, g.high.z)});
    size_t differ = 0, near = 0, held = 0;
    for (FoamMethod method :
         {FoamMethod::point, FoamMethod::method_1, FoamMethod::method_2, FoamMethod::direct}) {
      if (method == FoamMethod::method_2 && !can_triangulate()) continue;
      const Ref<const Structure> structure = make(g, context, method);
      std::vector<uint8_t> alive(point_count, 1);
      const size_t step = method == FoamMethod::point ? 20 : 1;  // its points are dear
      for (size_t i = 0; i < point_count; ++i) alive[i] = i % step == 0;
      structure->keep_points(points.data(), alive.data(), point_count);
      near = held = 0;
      for (size_t i = 0; i < point_count; i += step) {
        held += alive[i];
        near += g.marks[i] == '?';
        if (g.marks[i] == '?' || alive[i] == (g.marks[i] == '1')) continue;
        if (!differ++)
          print_error("%s: (%.17g, %.17g, %.17g) is %d, not %c\n", g.name.c_str(), points[i].x,
                      points[i].y, points[i].z, alive[i], g.marks[i]);
      }
    }
    print_message("%s: %zu points, %zu inside, %zu too near to say, %zu differ\n", g.name.c_str(),
                  point_count, held, near, differ);
    assert_int_equal(differ, 0);
    assert_in_range(held, 1, point_count - 1);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(test_golden)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
