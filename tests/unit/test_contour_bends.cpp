// SPDX-License-Identifier: Apache-2.0
#include "slice/contour_bends.h"

#include <cmath>
#include <vector>

#include "base/vec2.h"
#include "random.h"
#include "suite.h"

namespace msq::test {

namespace {

constexpr double tolerance = 0.05, close_points = 0.02, corner = 0.1;

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

/// The definition of what find_bends() tells: of six points, between the third and the fourth.
bool may_bend(const Vec2 (&p)[6]) {
  const Vec2 d0 = p[1] - p[0], d1 = p[2] - p[1], ab = p[3] - p[2], d2 = p[4] - p[3],
             d3 = p[5] - p[4];
  if (!(length(ab) > tolerance)) return false;
  if (length(d1) < close_points || length(d2) < close_points) return true;
  if (std::abs(cross(d0, d1)) > corner * length(d0) ||
      std::abs(cross(d2, d3)) > corner * length(d3))
    return true;
  const double turn1 = cross(d1, ab), turn2 = cross(ab, d2), turn = cross(d1, d2);
  if (turn1 * turn2 <= 0)
    return std::max(std::abs(turn1) / length(d1), std::abs(turn2) / length(d2)) > 2 * tolerance;
  const auto turns_back = [&](double other, Vec2 d) {
    return other * turn1 < 0 && std::abs(other) > tolerance * length(d);
  };
  if (turns_back(cross(d0, d1), d0) || turns_back(cross(d2, d3), d3)) return true;
  return !(turn * turn1 > 0 && std::abs(turn1 * turn2 / turn) <= tolerance * length(ab));
}

/// The fast test for bends against its definition.
void test_bends(void**) {
  Random random(31);
  for (const size_t count : {size_t{3}, size_t{64}, size_t{130}, size_t{1000}}) {
    const Line line = random_line(count, random);
    std::vector<uint64_t> bits((count + 63) / 64);
    find_bends(line.x.data(), line.y.data(), count, {tolerance, close_points, corner}, bits.data());
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
    find_bends_at_ends(line.x.data(), line.y.data(), rings, {tolerance, close_points, corner},
                       bits.data());
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
  const CMUnitTest tests[] = {cmocka_unit_test(test_bends), cmocka_unit_test(test_ends_of_rings)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
