// SPDX-License-Identifier: Apache-2.0
#include "slice/contour_line.h"

#include <cmath>
#include <vector>

#include "random.h"
#include "suite.h"

namespace msq::test {

namespace {

constexpr size_t max_look_ahead = 64;

struct Ring {
  std::vector<Vec2> at;
  std::vector<LineGate> gates;
  std::vector<LineRun> runs;
};

/// A walk in all directions that turns by little, with gates across it, and some points that stay.
Ring random_ring(uint32_t count, Random& random) {
  Ring ring;
  Vec2 p;
  double angle = random.between(0, 6);
  ring.runs.push_back({p, 0, 0});
  for (uint32_t i = 0; i < count; ++i) {
    angle += random.between(-0.3, 0.35);
    const Vec2 d{std::cos(angle), std::sin(angle)};
    p = p + d * random.between(0.2, 1);
    const Vec2 left = p + Vec2{-d.y, d.x} * random.between(0, 0.2);
    const Vec2 right = p + Vec2{d.y, -d.x} * random.between(0, 0.2);
    ring.at.push_back(p);
    ring.gates.push_back({left.x, right.x, left.y, right.y});
    if (random.between(0, 1) < 0.02) {
      ring.runs.back().end = i + 1;
      p = p + d * 0.1;
      ring.runs.push_back({p, i + 1, 0});
    }
  }
  ring.runs.back().end = count;
  ring.runs.push_back({p + Vec2{5, 5}, count, count});
  return ring;
}

/// Whether the segment passes the gates from `first` up to `end`.
bool passes(const Ring& ring, Vec2 from, Vec2 to, size_t first, size_t end) {
  for (size_t i = first; i < end; ++i) {
    const LineGate& g = ring.gates[i];
    const Vec2 left = Vec2{g.left_x, g.left_y} - from, right = Vec2{g.right_x, g.right_y} - from;
    const Vec2 d = to - from;
    if (!(cross(right, left) > 0 && cross(right, d) >= 0 && cross(d, left) >= 0)) return false;
  }
  return true;
}

/// The definition: from each point that remains to the last that a segment may lead to.
std::vector<Vec2> remaining(const Ring& ring) {
  std::vector<Vec2> out;
  for (size_t r = 0; r < ring.runs.size(); ++r) {
    const LineRun& run = ring.runs[r];
    const Vec2 end = ring.runs[(r + 1) % ring.runs.size()].from;
    const auto point = [&](size_t i) { return i < run.end ? ring.at[i] : end; };
    Vec2 from = run.from;
    for (size_t next = run.first;;) {
      out.push_back(from);
      size_t last = next;
      for (size_t i = next; i <= run.end && i - last <= max_look_ahead; ++i)
        if (passes(ring, from, point(i), next, i)) last = i;
      if (last == run.end) break;
      from = point(last);
      next = last + 1;
    }
  }
  return out;
}

void test_simplify(void**) {
  Random random(73);
  size_t points = 0, left = 0;
  for (int n = 0; n < 300; ++n) {
    const Ring ring = random_ring(1 + static_cast<uint32_t>(n), random);
    std::vector<Vec2> out(ring.at.size() + ring.runs.size());
    out.resize(simplify_ring(ring.runs.data(), ring.runs.size(), ring.at.data(), ring.gates.data(),
                             1, out.data()));
    assert_true(out == remaining(ring));
    points += ring.at.size();
    left += out.size();
  }
  assert_in_range(left, points / 6, points / 2);
}

}  // namespace

}  // namespace msq::test

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(msq::test::test_simplify)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
