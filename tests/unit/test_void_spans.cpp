// SPDX-License-Identifier: Apache-2.0
// Spans of the void of a cell against each sample in double precision. Planes pass by samples
// within rounding: those must be in doubt.
#include <algorithm>
#include <cmath>
#include <vector>

#include "msq_test.h"
#include "random.h"
#include "structure/foam/walls/void_spans.h"

using namespace msq;
using namespace msq::test;

namespace {

constexpr int rows = 40, layers = 37, words = 3;
constexpr int64_t samples = 64 * words;

/// A block of samples about a seed.
struct Block {
  double per_unit;  // samples in a foam unit
  double place[3];  // of the seed, in samples
  double dy;        // of rows, in foam units; sometimes less than single precision can tell
  std::vector<uint64_t> bits = std::vector<uint64_t>(rows * layers * words, ~uint64_t{0});

  explicit Block(Random& random) : per_unit(random.between(6, 40)) {
    place[0] = random.between(0, samples);
    place[1] = random.between(10, 30);
    place[2] = random.between(10, 27);
    dy = (random.below(8) == 0 ? 1e-9 : 1) / per_unit;
  }
  Vec3 at(int64_t i, int j, int k) const {
    return Vec3{double(i) - place[0], double(j) - place[1], double(k) - place[2]} * (1 / per_unit);
  }
  bool holds(int64_t i, int j, int k) const {
    return bits[static_cast<size_t>((k * rows + j) * words + i / 64)] >> (i % 64) & 1;
  }
};

struct Void {
  std::vector<FaceBrick::Face> faces;
  VoidFaces planes;
};

Vec3 random_normal(Random& random, bool may_be_along) {
  Vec3 n{random.normal(), random.normal(), random.normal()};
  switch (random.below(12)) {
    case 0:
      if (may_be_along) n.x = 0;  // along the rows
      break;
    case 1:
      if (may_be_along) n.x *= 1e-7;
      break;
    case 2:
      n.x *= 0.01;
      break;
    default:
      break;
  }
  return n * (1 / length(n));
}

/// A convex cell, most of whose planes pass by a sample.
Void random_void(Random& random, const Block& block) {
  Void made;
  VoidFaces& p = made.planes;
  p.half = random.between(0, 0.1);
  if (random.below(4) == 0)
    p.tilt = {random.between(-0.1, 0.1), random.between(-0.1, 0.1), random.between(-0.1, 0.1)};
  const auto row = [&](double from, uint64_t count) {
    return static_cast<int>(std::clamp(std::floor(from), 0.0, double(count - 1)));
  };
  const bool may_be_along = random.below(4) == 0;
  // Closed by the first six.
  const float skew = may_be_along ? 0 : 0.1f;
  for (int axis = 0; axis < 3; ++axis)
    for (const float sign : {1.0f, -1.0f}) {
      FaceBrick::Face face{{skew, skew, skew}, 0.7f};
      face.normal[axis] = sign;
      made.faces.push_back(face);
    }
  while (made.faces.size() < 18) {
    const Vec3 n = random_normal(random, may_be_along);
    FaceBrick::Face face{
        {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)},
        static_cast<float>(random.between(0.3, 0.6))};
    const Vec3 middle = n * double(face.distance);
    const int64_t i = std::clamp<int64_t>(std::llround(block.place[0] + middle.x * block.per_unit),
                                          0, samples - 1);
    const Vec3 by = block.at(i, row(block.place[1] + middle.y / block.dy, rows),
                             row(block.place[2] + middle.z * block.per_unit, layers));
    const Vec3 exact{face.normal[0], face.normal[1], face.normal[2]};
    const double distance = dot(exact + p.tilt, by) + p.half + random.between(-2e-6, 2e-6);
    if (distance > 0.2 && distance < 0.7) face.distance = static_cast<float>(distance);
    made.faces.push_back(face);
  }
  p.faces = made.faces.data();
  p.count = made.faces.size();
  p.reach = 1;
  p.margin = static_cast<float>(void_margin(1));
  return made;
}

/// How far a sample is in the void, along the nearest plane.
double depth(const Void& within, Vec3 x) {
  double least = 1e300;
  for (const FaceBrick::Face& face : within.faces) {
    const Vec3 n = Vec3{face.normal[0], face.normal[1], face.normal[2]} + within.planes.tilt;
    least = std::min(least, face.distance - within.planes.half - dot(n, x));
  }
  return least;
}

void test_random_cells(void**) {
  Random random(31);
  size_t close = 0, cleared = 0, doubtful = 0;
  for (size_t n = test_count(300); n > 0; --n) {
    Block block(random);
    const Void cell = random_void(random, block);
    std::vector<float> y(rows + 64), z(layers + 64);
    for (int j = 0; j < rows; ++j)
      y[static_cast<size_t>(j)] = static_cast<float>(block.at(0, j, 0).y);
    for (int k = 0; k < layers; ++k)
      z[static_cast<size_t>(k)] = static_cast<float>(block.at(0, 0, k).z);
    // The rows and layers within reach.
    const auto part = [](const std::vector<float>& v, int count, size_t& first) {
      size_t found = 0;
      first = 0;
      for (int i = 0; i < count; ++i) {
        const float at = v[static_cast<size_t>(i)];
        if (std::abs(at) <= 1) found == 0 ? (first = static_cast<size_t>(i), ++found) : ++found;
      }
      return found;
    };
    size_t row, layer;
    const size_t near_rows = part(y, rows, row), near_layers = part(z, layers, layer);
    const double base = std::floor(block.place[0]);
    std::vector<DoubtfulSamples> doubts;
    clear_void(
        cell.planes,
        {y.data() + row, z.data() + layer, near_rows, near_layers, static_cast<uint32_t>(row),
         static_cast<uint32_t>(layer), block.bits.data() + (layer * rows + row) * words, words,
         size_t{rows} * words, static_cast<float>(block.per_unit),
         static_cast<float>(block.place[0] - base), static_cast<int64_t>(base), samples - 1},
        doubts);
    std::vector<bool> in_doubt(block.bits.size() * 64, false);
    for (const DoubtfulSamples& run : doubts)
      for (uint64_t i = 0; i < run.count; ++i)
        in_doubt[(run.layer * rows + run.row) * 64 * words + run.first + i] = true;
    for (int k = 0; k < layers; ++k)
      for (int j = 0; j < rows; ++j)
        for (int64_t i = 0; i < samples; ++i) {
          const double in = depth(cell, block.at(i, j, k));
          const bool is_in_doubt = in_doubt[static_cast<size_t>(((k * rows + j) * words) * 64 + i)];
          close += std::abs(in) < 2e-6;
          doubtful += is_in_doubt;
          cleared += !block.holds(i, j, k);
          if (!block.holds(i, j, k) && in < -1e-12) fail_msg("a wall is cleared: depth %g", in);
          if (block.holds(i, j, k) && !is_in_doubt && in > 1e-12)
            fail_msg("a void is left: depth %g", in);
        }
  }
  print_message("%zu samples cleared, %zu in doubt, %zu within rounding of a plane\n", cleared,
                doubtful, close);
  assert_true(close > test_count(300));
  assert_true(cleared > 1000 * test_count(300));
  // Planes along the rows leave more of them.
  assert_true(doubtful < cleared / 100);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(test_random_cells)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
