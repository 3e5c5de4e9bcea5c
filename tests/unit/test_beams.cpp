// SPDX-License-Identifier: Apache-2.0
// Beams: what one holds, by other expressions; that the tree finds all that hold a point, however
// beams lie; distances that are exact outside; and what is left where memory runs out.
#include <functional>
#include <set>

#include "beam_lists.h"
#include "msq_test.h"
#include "random.h"
#include "structure/beams/beam_distance.h"
#include "structure/beams/beams.h"
#include "structure/beams/hilbert.h"

using namespace msq;
using namespace msq::test;

namespace {

Ref<Beams> make(const std::vector<Beam>& beams, unsigned threads = 2) {
  const Executor executor(threads);
  return Beams::make(source_of(beams), 0, executor, std::make_shared<MemoryBudget>(uint64_t{0}),
                     nullptr);
}

Beam any_beam(Random& random, Vec3 at, double size) {
  Beam beam{
      at, at + random.direction() * (size * random.unit()), 0, 0, BeamCap::sphere, BeamCap::sphere};
  beam.radius_a = 0.3 * size * random.unit();
  beam.radius_b = random.below(3) ? 0.3 * size * random.unit() : beam.radius_a;
  beam.cap_a = static_cast<BeamCap>(random.below(3));
  beam.cap_b = static_cast<BeamCap>(random.below(3));
  if (random.below(10) == 0) beam.b = beam.a;
  return beam;
}

/// By how much a point is beyond the boundary (positive) or within it, in long doubles, from the
/// coordinates along and across the axis. The least over the parts, for each the greatest over its
/// conditions.
long double excess(const Beam& beam, Vec3 p) {
  using L = long double;
  const L ab[3] = {L(beam.b.x) - beam.a.x, L(beam.b.y) - beam.a.y, L(beam.b.z) - beam.a.z};
  const L ap[3] = {L(p.x) - beam.a.x, L(p.y) - beam.a.y, L(p.z) - beam.a.z};
  L ll = 0, along = 0, pp = 0, bb = 0;
  for (int i = 0; i < 3; ++i) {
    ll += ab[i] * ab[i];
    along += ab[i] * ap[i];
    pp += ap[i] * ap[i];
    bb += (ap[i] - ab[i]) * (ap[i] - ab[i]);
  }
  const L size = std::sqrt(ll), z = size > 0 ? along / size : 0;
  const L across = std::sqrt(std::max(L(0), pp - z * z));
  L least = 1e300L;
  const auto part = [&](std::initializer_list<L> conditions) {
    least = std::min(least, std::max(conditions));
  };
  const L to_a = std::sqrt(pp) - beam.radius_a, to_b = std::sqrt(bb) - beam.radius_b;
  if (size > 0)
    part({-z, z - size, across - (beam.radius_a + (L(beam.radius_b) - beam.radius_a) * z / size)});
  if (beam.cap_a == BeamCap::sphere) part({to_a});
  if (beam.cap_b == BeamCap::sphere) part({to_b});
  if (beam.cap_a == BeamCap::hemisphere) part({to_a, size > 0 ? z : -1e300L});
  if (beam.cap_b == BeamCap::hemisphere) part({to_b, size > 0 ? size - z : -1e300L});
  return least;
}

void a_beam_holds_what_its_parts_do(void**) {
  Random random(1);
  const size_t count = test_count(2000000);
  size_t held = 0, near = 0, wrong = 0;
  for (size_t i = 0; i < count; ++i) {
    const Beam beam = any_beam(random, random.in_box({{-1, -1, -1}, {1, 1, 1}}), 1);
    const Box3 box = beam.box();
    const Vec3 p = random.in_box(box.grown(0.05));
    const bool holds = beam.holds(p);
    held += holds;
    if (holds) assert_true(box.contains(p));
    const long double e = excess(beam, p);
    if (std::abs(e) < 1e-13L)
      ++near;
    else
      wrong += holds != (e < 0);
  }
  assert_int_equal(wrong, 0);
  assert_in_range(held, count / 10, count);
  assert_in_range(near, 0, count / 1000);
}

void ends_are_as_they_are_defined(void**) {
  const auto beam = [](double ra, double rb, BeamCap cap_a, BeamCap cap_b) {
    return Beam{{0, 0, 0}, {4, 0, 0}, ra, rb, cap_a, cap_b};
  };
  const BeamCap ball = BeamCap::sphere, half = BeamCap::hemisphere, flat = BeamCap::butt;
  const Beam capsule = beam(1, 1, ball, half), cylinder = beam(1, 1, flat, flat);
  assert_true(capsule.holds({-1, 0, 0}) && capsule.holds({5, 0, 0}) && capsule.holds({2, 1, 0}));
  assert_false(cylinder.holds({-0x1p-40, 0, 0}) || cylinder.holds({4 + 0x1p-40, 0, 0}));
  assert_true(cylinder.holds({0, 1, 0}) && cylinder.holds({4, 0, -1}));
  // The ball of the thicker end sticks out of the side; half of it does not.
  const Vec3 beside{3.5, 1.9, 0};
  assert_true(beam(0.5, 2, flat, ball).holds(beside));
  assert_false(beam(0.5, 2, flat, half).holds(beside));
  // It may even reach beyond the other end.
  assert_true(beam(0.5, 5, flat, ball).holds({-0.5, 0, 0}));
  assert_false(beam(0.5, 5, flat, half).holds({-0.5, 0, 0}));
  // A tip.
  const Beam cone = beam(0, 1, ball, flat);
  assert_true(cone.holds({0, 0, 0}) && cone.holds({2, 0.5, 0}));
  assert_false(cone.holds({-0x1p-60, 0, 0}) || cone.holds({1, 0.2500001, 0}));
  // No length: balls and nothing.
  Beam point{{1, 2, 3}, {1, 2, 3}, 0.5, 0.25, half, flat};
  assert_true(point.is_solid() && point.holds({1.5, 2, 3}));
  point.cap_a = flat;
  assert_true(!point.is_solid() && !point.holds({1, 2, 3}));
}

/// Sets of beams that trees may find hard.
std::vector<std::pair<const char*, std::vector<Beam>>> hard_sets() {
  Random random(2);
  std::vector<std::pair<const char*, std::vector<Beam>>> sets;
  const auto add = [&](const char* name, size_t count, auto&& beam) {
    std::vector<Beam> beams;
    for (size_t i = 0; i < count; ++i) beams.push_back(beam(i));
    sets.emplace_back(name, beams);
  };
  const Box3 unit{{0, 0, 0}, {1, 1, 1}};
  for (const size_t count : {size_t{1}, size_t{3}, size_t{33}, size_t{5000}})
    add("anywhere", count, [&](size_t) { return any_beam(random, random.in_box(unit), 0.1); });
  const Beam same = any_beam(random, {0.5, 0.5, 0.5}, 1);
  add("all the same", 3000, [&](size_t) { return same; });
  add("in one place", 3000, [&](size_t) { return any_beam(random, {0.5, 0.5, 0.5}, 1); });
  add("of all sizes", 3000, [&](size_t) {
    return any_beam(random, random.in_box(unit), std::exp2(-random.between(0, 30)));
  });
  add("in two clusters far apart", 3000, [&](size_t i) {
    const double far = i % 2 ? 1e9 : 0;
    return any_beam(random, random.in_box(unit) * 1e-3 + Vec3{far, -far, far}, 1e-3);
  });
  add("on a line", 3000, [&](size_t) {
    return any_beam(random, Vec3{1, 0, 0} * (100 * random.unit()), 0.1);
  });
  add("far from the origin", 3000, [&](size_t) {
    return any_beam(random, random.in_box(unit) + Vec3{1e8, 1e8, -1e8}, 0.1);
  });
  add("long", 500, [&](size_t) {
    Beam beam = any_beam(random, random.in_box(unit), 0.1);
    beam.b = random.in_box(unit);
    return beam;
  });
  add("tiny", 500, [&](size_t) { return any_beam(random, random.in_box(unit) * 1e-60, 1e-61); });
  add("huge", 500, [&](size_t) { return any_beam(random, random.in_box(unit) * 1e75, 1e74); });
  return sets;
}

/// Near a beam of the list, or anywhere about all.
Vec3 any_point(Random& random, const std::vector<Beam>& beams, const Box3& all) {
  if (random.below(8) == 0) return random.in_box(all.grown(0.2 * max_component(all.extent())));
  const Box3 box = beams[random.below(beams.size())].box();
  return random.in_box(box.grown(0.1 * max_component(box.extent())));
}

void the_tree_finds_all_that_hold_a_point(void**) {
  Random random(3);
  for (const auto& [name, beams] : hard_sets()) {
    const Ref<Beams> made = make(beams);
    size_t held = 0;
    for (size_t n = test_count(3000); n > 0; --n) {
      const Vec3 p = any_point(random, beams, made->tree().box());
      bool expected = false;
      for (const Beam& beam : beams) expected = expected || beam.holds(p);
      held += expected;
      if (made->inside(p) != expected)
        fail_msg("%s: (%.17g, %.17g, %.17g) is %d", name, p.x, p.y, p.z, !expected);
    }
    if (test_count(3000) > 500) assert_true(held > 0);
  }
}

void threads_change_no_order(void**) {
  for (const auto& [name, beams] : hard_sets()) {
    const Ref<Beams> one = make(beams, 1), two = make(beams, 2);
    assert_int_equal(one->beams().size(), two->beams().size());
    for (size_t i = 0; i < one->beams().size(); ++i) {
      const Beam a = one->beams().at(i), b = two->beams().at(i);
      assert_true(a.a == b.a && a.b == b.b && a.radius_a == b.radius_a && a.cap_b == b.cap_b);
    }
  }
}

/// Outside, the point at the distance is on the boundary: just beyond it is inside, or a ball that
/// is a little larger holds a point inside.
void distances_are_exact_outside(void**) {
  Random random(4);
  size_t asked = 0;
  for (const auto& [name, beams] : hard_sets()) {
    const Ref<Beams> made = make(beams);
    const double unit = max_component(made->tree().box().extent());
    for (size_t n = test_count(2000); n > 0; --n) {
      const Vec3 p = any_point(random, beams, made->tree().box());
      double least = std::numeric_limits<double>::infinity();
      for (const Beam& beam : beams) least = std::min(least, distance_to_beam(beam, p));
      const double d = made->distance(p);
      if (made->inside(p)) {
        assert_true(d <= 0);
        continue;
      }
      // As far as the nearest of all, one by one.
      if (std::abs(d - least) > 1e-13 * (least + unit + max_magnitude(p)))
        fail_msg("%s: (%.17g, %.17g, %.17g) is %.17g away, not %.17g", name, p.x, p.y, p.z, d,
                 least);
      ++asked;
    }
  }
  assert_true(asked > 0);
}

void the_distance_to_a_beam_leads_to_it(void**) {
  Random random(5);
  for (size_t n = test_count(100000); n > 0; --n) {
    const Beam beam = any_beam(random, random.in_box({{-1, -1, -1}, {1, 1, 1}}), 1);
    if (!beam.is_solid()) continue;
    const Vec3 p = random.in_box(beam.box().grown(0.5));
    if (beam.holds(p)) continue;
    const double d = distance_to_beam(beam, p);
    if (d < 1e-6) continue;
    // Down the slope, which is known to about 1e-9 but where two boundaries are as near.
    constexpr double step = 1e-5;
    Vec3 slope, other;
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 by;
      by[axis] = step;
      slope[axis] = (distance_to_beam(beam, p + by) - distance_to_beam(beam, p - by)) / (2 * step);
      other[axis] =
          (distance_to_beam(beam, p + by * 0.5) - distance_to_beam(beam, p - by * 0.5)) / step;
    }
    if (length(slope - other) > 1e-6 || std::abs(length(slope) - 1) > 1e-6) continue;
    const Vec3 there = p - slope * (d / length(slope));
    const double left = static_cast<double>(excess(beam, there));
    if (std::abs(left) > 1e-4)
      fail_msg("%.17g from (%.17g, %.17g, %.17g) is %g beyond it", d, p.x, p.y, p.z, left);
  }
}

/// The first ray meets the ball beside the axis, the second in the side, the third the half ball.
void normals_of_round_ends_are_those_of_balls(void**) {
  const double s = std::sqrt(0.5);
  const std::vector<Beam> beams{{{0, 0, 0}, {4, 0, 0}, 1, 2, BeamCap::sphere, BeamCap::hemisphere}};
  const Ref<Beams> made = make(beams);
  for (const auto& [origin, way, t, normal] :
       {std::tuple{Vec3{-3, 0.6, 0}, Vec3{1, 0, 0}, 2.2, Vec3{-0.8, 0.6, 0}},
        {Vec3{-s, -3, 0}, Vec3{0, 1, 0}, 3 - s, Vec3{-s, -s, 0}},
        {Vec3{9, 0, -1.2}, Vec3{-1, 0, 0}, 3.4, Vec3{0.8, 0, -0.6}}}) {
    RaySearch search{{origin, way}, 0, 20};
    made->enter(&search, 1, nullptr);
    assert_true(search.found && std::abs(search.t - t) < 1e-9);
    assert_true(length(search.normal - normal) < 1e-9);
    assert_true(length(made->normal(search.ray, search.t) - normal) < 1e-9);
  }
}

/// The whole ball of the thicker end would stand out of the side there.
void normals_beside_half_balls_are_those_of_sides(void**) {
  const Vec3 a{0, 0, 0}, b{4, 0, 0};
  const double by = 1 / std::sqrt(17.0);
  constexpr BeamCap half = BeamCap::hemisphere;
  for (const auto& [beam, x, normal] :
       {std::tuple{Beam{a, b, 2, 1, half, half}, 0.2, Vec3{by, 4 * by, 0}},
        {Beam{a, b, 1, 2, half, half}, 3.8, Vec3{-by, 4 * by, 0}}}) {
    const Ref<Beams> made = make({beam});
    RaySearch search{{{x, 5, 0}, {0, -1, 0}}, 0, 20};
    made->enter(&search, 1, nullptr);
    assert_true(search.found && std::abs(search.t - 3.05) < 1e-9);
    assert_true(length(search.normal - normal) < 1e-9);
    assert_true(length(made->normal(search.ray, search.t) - normal) < 1e-9);
  }
}

/// So slender that rounding of the squared distance from the axis exceeds the squared radius. The
/// rays cross the axis, soon after they begin.
void rays_meet_slender_beams(void**) {
  constexpr double radius = 1e-9, before = 1e-8;
  Random random(9);
  for (int n = 0; n < 300; ++n) {
    const Vec3 a = random.in_box({{-1, -1, -1}, {1, 1, 1}}), along = random.direction();
    const Vec3 on = a + along * random.between(0.02, 0.98), way = random.direction();
    const double sine = length(cross(along, way));
    if (sine < 0.3) continue;
    const std::vector<Beam> beams{{a, a + along, radius, radius, BeamCap::butt, BeamCap::butt}};
    const Ref<Beams> made = make(beams);
    RaySearch search{{on - way * before, way}, 0, 1};
    made->enter(&search, 1, nullptr);
    if (!search.found) fail_msg("ray %d is lost", n);
    assert_true(std::abs(search.t - (before - radius / sine)) <= 2 * made->ray_tolerance());
    // From farther away, and to an end within the beam.
    RaySearch ended{{on - way, way}, 0, 1};
    made->enter(&ended, 1, nullptr);
    if (made->inside(ended.ray.at(1)) && !ended.found) fail_msg("ray %d ends in the beam", n);
  }
}

void the_curve_goes_from_neighbour_to_neighbour(void**) {
  for (const unsigned bits : {1u, 2u, 4u}) {
    const uint32_t side = uint32_t{1} << bits;
    std::vector<Vec3> cells(size_t{side} * side * side, Vec3{-9, -9, -9});
    for (uint32_t z = 0; z < side; ++z)
      for (uint32_t y = 0; y < side; ++y)
        for (uint32_t x = 0; x < side; ++x)
          cells.at(hilbert_index(x, y, z, bits)) = {double(x), double(y), double(z)};
    for (size_t i = 1; i < cells.size(); ++i) assert_true(length(cells[i] - cells[i - 1]) == 1);
  }
}

void memory_is_counted_and_given_back(void**) {
  Random random(6);
  std::vector<Beam> beams;
  for (size_t i = 0; i < 10000; ++i)
    beams.push_back(any_beam(random, random.in_box({{0, 0, 0}, {1, 1, 1}}), 0.1));
  const BeamSource source = source_of(beams);
  const Executor executor(2);
  const auto held_by = [&](uint64_t limit) {
    const auto budget = std::make_shared<MemoryBudget>(limit);
    try {
      const Ref<Beams> made = Beams::make(source, 0, executor, budget, nullptr);
      assert_in_range(budget->held(), made->beams().size() * 64, made->beams().size() * 100);
    } catch (const Error& error) {
      assert_int_equal(error.status, Status::limit);
    }
    assert_int_equal(budget->held(), 0);
    return budget->peak();
  };
  const uint64_t peak = held_by(0);
  assert_int_equal(held_by(peak), peak);
  assert_true(held_by(peak - 1) < peak);
  assert_int_equal(held_by(1000), 0);
}

void a_cancelled_job_stops_it(void**) {
  std::vector<Beam> beams(100000, {{0, 0, 0}, {1, 0, 0}, 1, 1, BeamCap::sphere, BeamCap::sphere});
  const BeamSource source = source_of(beams);
  const Executor executor(2);
  const auto budget = std::make_shared<MemoryBudget>(uint64_t{0});
  Job job;
  job.cancel();
  try {
    Beams::make(source, 0, executor, budget, &job);
    fail_msg("it went on");
  } catch (const Error& error) {
    assert_int_equal(error.status, Status::cancelled);
  }
  assert_int_equal(budget->held(), 0);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_beam_holds_what_its_parts_do),
      cmocka_unit_test(ends_are_as_they_are_defined),
      cmocka_unit_test(the_tree_finds_all_that_hold_a_point),
      cmocka_unit_test(threads_change_no_order),
      cmocka_unit_test(distances_are_exact_outside),
      cmocka_unit_test(the_distance_to_a_beam_leads_to_it),
      cmocka_unit_test(normals_of_round_ends_are_those_of_balls),
      cmocka_unit_test(normals_beside_half_balls_are_those_of_sides),
      cmocka_unit_test(rays_meet_slender_beams),
      cmocka_unit_test(the_curve_goes_from_neighbour_to_neighbour),
      cmocka_unit_test(memory_is_counted_and_given_back),
      cmocka_unit_test(a_cancelled_job_stops_it),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
