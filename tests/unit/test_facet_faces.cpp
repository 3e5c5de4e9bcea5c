// SPDX-License-Identifier: Apache-2.0
// The cells of bricks by their faces: from the walk over Delaunay tetrahedra, and cell by cell.
#include <cmath>
#include <memory>

#include "msq_test.h"
#include "random.h"
#include "structure/foam/walls/face_brick.h"
#include "structure/foam/walls/facet_faces.h"

using namespace msq;
using namespace msq::test;

namespace {

/// Faces so small that rounding decides whether they exist.
constexpr double small_area = 1e-5;
constexpr double tolerance = 2e-6;

struct Brick {
  std::vector<FaceBrick::Cell> cells;
  std::vector<FaceBrick::Face> faces;
};

bool is_same(const FaceBrick::Face& a, const FaceBrick::Face& b) {
  double most = std::abs(double(a.distance) - b.distance);
  for (int axis = 0; axis < 3; ++axis)
    most = std::max(most, std::abs(double(a.normal[axis]) - b.normal[axis]));
  return most < tolerance;
}

/// Each face of a cell must be among those of the other, if it is large; returns how many are.
size_t compare(const FaceBrick& expected, const Brick& got) {
  size_t large = 0;
  assert_int_equal(got.cells.size(), expected.cells().size());
  for (size_t i = 0; i < got.cells.size(); ++i) {
    const FaceBrick::Cell &a = expected.cells()[i], &b = got.cells[i];
    assert_true(length(a.seed - b.seed) < 1e-12);
    for (int axis = 0; axis < 3; ++axis) {
      assert_true(std::abs(a.low[axis] - b.low[axis]) < tolerance);
      assert_true(std::abs(a.high[axis] - b.high[axis]) < tolerance);
    }
    const FaceBrick::Face* const faces = got.faces.data() + b.first;
    std::vector<bool> is_known(b.count, false);
    for (uint32_t f = 0; f < a.count; ++f) {
      bool is_found = false;
      for (uint32_t g = 0; g < b.count; ++g)
        if (is_same(expected.faces(a)[f], faces[g])) is_found = is_known[g] = true;
      const bool is_large = expected.areas(a)[f].area > small_area;
      large += is_large;
      if (is_large && !is_found) fail_msg("cell %zu lacks a face", i);
    }
    // No more than the few small ones that rounding leaves out of the other.
    size_t unknown = 0;
    for (const bool known : is_known) unknown += !known;
    assert_true(unknown <= 1);
  }
  return large;
}

void test_random_bricks(void**) {
  const auto walk = std::make_unique<FacetFaces>();
  Random random(23);
  const Vec3 scales[] = {{1, 1, 1}, {1, 0.8, 0.9}, {0.6, 0.6, 1}};
  size_t bricks = 0, refused = 0, faces = 0;
  for (const double jitter : {1.0, 0.5, 0.05})
    for (const Vec3 scale : scales)
      for (size_t n = test_count(2); n > 0; --n) {
        const FoamSeeds seeds(random.bits(), jitter, scale);
        const auto place = [&] { return static_cast<int32_t>(random.below(1u << 20)) - 16; };
        const CellIndex corner{place(), place(), place()};
        Brick got;
        ++bricks;
        if (!walk->build(seeds, corner, {1, 1, 1}, got.cells, got.faces)) {
          ++refused;
          assert_true(got.cells.empty() && got.faces.empty());
          continue;
        }
        faces += compare(FaceBrick(seeds, corner, true), got);
      }
  print_message("%zu faces of %zu bricks; %zu bricks refused\n", faces, bricks, refused);
  assert_true(8 * refused <= bricks);
  assert_true(faces > (bricks - refused) * 512 * 13);
}

/// Cells moved from the space of a diagram: each face has as far to its seed as its image.
void test_factor(void**) {
  const auto walk = std::make_unique<FacetFaces>();
  const FoamSeeds seeds(5, 1, {1, 1, 1});
  const Vec3 factor{1, 0.5, 0.25};
  Brick plain, moved;
  assert_true(walk->build(seeds, {3, 4, 5}, {1, 1, 1}, plain.cells, plain.faces));
  assert_true(walk->build(seeds, {3, 4, 5}, factor, moved.cells, moved.faces));
  assert_int_equal(moved.faces.size(), plain.faces.size());
  for (size_t i = 0; i < plain.cells.size(); ++i) {
    assert_true(length(plain.cells[i].seed * factor - moved.cells[i].seed) < 1e-12);
    for (uint32_t f = 0; f < plain.cells[i].count; ++f) {
      const FaceBrick::Face &a = plain.faces[plain.cells[i].first + f],
                            &b = moved.faces[moved.cells[i].first + f];
      // The plane n . x = d becomes (n / factor) . X = d.
      const Vec3 n{a.normal[0] / factor.x, a.normal[1] / factor.y, a.normal[2] / factor.z};
      for (int axis = 0; axis < 3; ++axis)
        assert_true(std::abs(n[axis] / length(n) - b.normal[axis]) < tolerance);
      assert_true(std::abs(a.distance / length(n) - b.distance) < tolerance);
    }
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(test_random_bricks),
      cmocka_unit_test(test_factor),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
