// SPDX-License-Identifier: Apache-2.0
#include "slice/contour_bends.h"

#include <cmath>
#include <memory>
#include <vector>

#include "base/vec2.h"
#include "random.h"
#include "suite.h"

namespace msq::test {

namespace {

constexpr double tolerance = 0.05, close_points = 0.02, corner = 0.1, arc = 0.025;
constexpr BendLimits limits{tolerance, close_points, corner, arc};

struct Line {
  std::vector<double> x, y;

  explicit Line(size_t count) : x(count), y(count) {}
  size_t count() const { return x.size(); }
  Vec2 at(size_t i) const { return {x[i], y[i]}; }
};

/// Turns either way, or along even bends, in steps some of which are short.
Line random_line(size_t count, Random& random) {
  Line line(count);
  double angle = 0, turn = 0;
  for (size_t i = 1; i < count; ++i) {
    if (random.between(0, 1) < 0.1) turn = random.between(-0.6, 0.7);
    angle += random.between(0, 1) < 0.2 ? random.between(-0.6, 0.7) : turn;
    const double step = random.between(0, 1) < 0.1 ? random.between(0, 0.03) : 0.3;
    line.x[i] = line.x[i - 1] + step * std::cos(angle);
    line.y[i] = line.y[i - 1] + step * std::sin(angle);
  }
  return line;
}

/// The definition of what six points tell about the piece from the third to the fourth.
struct Bends {
  bool bends = false, turns_left = false, turns_right = false, has_triangle = false;

  explicit Bends(const Vec2 (&p)[6]) {
    const Vec2 d0 = p[1] - p[0], d1 = p[2] - p[1], ab = p[3] - p[2], d2 = p[4] - p[3],
               d3 = p[5] - p[4];
    const bool is_by_corner = std::abs(cross(d0, d1)) > corner * length(d0) ||
                              std::abs(cross(d2, d3)) > corner * length(d3);
    const double turn1 = cross(d1, ab), turn2 = cross(ab, d2), turn = cross(d1, d2);
    if (turn1 * turn2 <= 0) {
      bends = is_by_corner ||
              std::max(std::abs(turn1) / length(d1), std::abs(turn2) / length(d2)) > 2 * tolerance;
      return;
    }
    const auto turns_back = [&](double other, Vec2 d) {
      return other * turn1 < 0 && std::abs(other) > tolerance * length(d);
    };
    const bool turns_one_way =
        !is_by_corner && !turns_back(cross(d0, d1), d0) && !turns_back(cross(d2, d3), d3);
    turns_left = turns_one_way && turn1 > 0;
    turns_right = turns_one_way && turn1 < 0;
    has_triangle = turn * turn1 > 0;
    bends = !(turns_one_way && has_triangle &&
              std::abs(turn1 * turn2 / turn) <= tolerance * length(ab));
  }
};

/// The definition of what find_bends() tells of points in a row.
bool may_bend(const Vec2 (&p)[6]) {
  if (!(length(p[3] - p[2]) > tolerance)) return false;
  return length(p[2] - p[1]) < close_points || length(p[4] - p[3]) < close_points || Bends(p).bends;
}

/// Curvature of the circle through three points.
double curvature(Vec2 a, Vec2 b, Vec2 c) {
  return 2 * cross(b - a, c - b) / (length(b - a) * length(c - b) * length(c - a));
}

/// The fast test for bends against its definition.
void test_bends(void**) {
  Random random(31);
  for (const size_t count : {size_t{3}, size_t{64}, size_t{130}, size_t{1000}}) {
    const Line line = random_line(count, random);
    std::vector<uint64_t> bits((count + 63) / 64);
    find_bends(line.x.data(), line.y.data(), count, limits, bits.data());
    size_t found = 0, flat = 0;
    for (size_t i = 2; i + 3 < count; ++i) {
      const bool bends = may_bend({line.at(i - 2), line.at(i - 1), line.at(i), line.at(i + 1),
                                   line.at(i + 2), line.at(i + 3)});
      const bool is_found = bits[i / 64] >> (i % 64) & 1;
      // Near both ends of the points, words are not looked at.
      const bool may_differ = i < 64 || i / 64 * 64 + 67 > count;
      if (is_found != bends && !(may_differ && is_found)) fail_msg("piece %zu of %zu", i, count);
      found += bends;
      flat += !is_found;
    }
    if (count == 1000) assert_true(found > 50 && flat > 50);
  }
}

/// What is told of single pieces, against its definition.
void test_pieces(void**) {
  Random random(33);
  const Line line = random_line(4000, random);
  const auto pieces = std::make_unique<PieceBlock>();
  constexpr size_t shift = 23;  // from piece to piece
  size_t arcs = 0, others = 0, left = 0, right = 0, triangles = 0;
  for (size_t first = 0; first + shift * PieceBlock::capacity + 6 < line.count(); ++first) {
    const size_t count = 1 + first % PieceBlock::capacity;
    const auto point = [&](size_t i, size_t n) { return line.at(first + i * shift + n); };
    for (size_t i = 0; i < count; ++i)
      for (size_t n = 0; n < 6; ++n) {
        pieces->x[n][i] = point(i, n).x;
        pieces->y[n][i] = point(i, n).y;
      }
    find_bends(*pieces, count, limits);
    for (size_t i = 0; i < count; ++i) {
      const PieceBlock::Bits& bits = pieces->bits[i / 64];
      const auto bit = [&](uint64_t word) { return (word >> (i % 64) & 1) != 0; };
      Vec2 p[6];
      for (size_t n = 0; n < 6; ++n) p[n] = point(i, n);
      const Bends expected(p);
      if (bit(bits.bends) != expected.bends || bit(bits.turns_left) != expected.turns_left ||
          bit(bits.turns_right) != expected.turns_right ||
          bit(bits.has_triangle) != expected.has_triangle)
        fail_msg("piece %zu of %zu", i, count);
      left += expected.turns_left;
      right += expected.turns_right;
      triangles += expected.has_triangle;
      double k[4];
      for (size_t n = 0; n < 4; ++n) k[n] = curvature(p[n], p[n + 1], p[n + 2]);
      const bool turns_alike = k[0] * k[1] > 0 && k[1] * k[2] > 0 && k[2] * k[3] > 0;
      const Vec2 ab = p[3] - p[2];
      const double height = std::abs(k[1] + k[2]) / 16 * dot(ab, ab);
      if (turns_alike && height > arc) assert_true(bit(bits.may_be_arc));
      if (!turns_alike) assert_false(bit(bits.may_be_arc));
      arcs += turns_alike && height > arc;
      others += !bit(bits.may_be_arc);
    }
  }
  assert_true(arcs > 1000 && others > 1000 && left > 1000 && right > 1000 && triangles > 1000);
}

/// Near the ends of rings: as of points that go around.
void test_ends_of_rings(void**) {
  Random random(32);
  const Line line = random_line(4000, random);
  std::vector<RingPoints> rings;
  for (uint32_t first = 3; first + 40 < line.count();) {
    const uint32_t size = 4 + static_cast<uint32_t>(random.between(0, 30));
    rings.push_back({first, first + size});
    first += size + 1;
  }
  // Bits beside the ends stay as they are.
  for (const uint64_t before : {uint64_t{0}, ~uint64_t{0}}) {
    std::vector<uint64_t> bits((line.count() + 63) / 64, before);
    find_bends_at_ends(line.x.data(), line.y.data(), rings, limits, bits.data());
    size_t found = 0, flat = 0, next = 0;
    for (const RingPoints ring : rings) {
      const auto bit = [&](uint32_t id) { return (bits[id / 64] >> (id % 64) & 1) != 0; };
      for (; next < ring.first; ++next)
        assert_true(bit(static_cast<uint32_t>(next)) == (before != 0));
      next = ring.end;
      const uint32_t size = ring.end - ring.first;
      for (uint32_t i = 0; i < size; ++i) {
        const bool is_found = bit(ring.first + i);
        if (size < 10) {
          assert_true(is_found);
          continue;
        }
        if (i >= 2 && i + 3 < size) {
          assert_true(is_found == (before != 0));
          continue;
        }
        Vec2 p[6];
        for (uint32_t n = 0; n < 6; ++n) p[n] = line.at(ring.first + (i + size + n - 2) % size);
        const bool bends = may_bend(p);
        if (is_found != bends) fail_msg("piece %u of the ring from %u", i, ring.first);
        found += bends;
        flat += !bends;
      }
    }
    assert_true(found > 50 && flat > 50);
  }
}

}  // namespace

}  // namespace msq::test

int main() {
  using namespace msq::test;
  const CMUnitTest tests[] = {cmocka_unit_test(test_bends), cmocka_unit_test(test_pieces),
                              cmocka_unit_test(test_ends_of_rings)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
