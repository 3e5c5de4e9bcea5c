// SPDX-License-Identifier: Apache-2.0
// Sums of waves: the definition against one written out in scalars, rows against the definition bit
// for bit at many pitches, levels against the normal distribution, directions in their cones, tiles
// that repeat, distances and rays against samples.
#include "structure/waves/waves.h"

#include <hwy/highway.h>

#include <cmath>
#include <cstring>

#include "base/pi.h"
#include "bit_rows.h"
#include "expression/tape.h"
#include "field/gradient.h"
#include "field/map.h"
#include "random.h"
#include "structure/waves/wave_kernels.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

WaveDirections directions(uint32_t count, Vec3 degrees = {90, 0, 0}, uint64_t seed = 5) {
  WaveDirections made;
  made.seed = seed;
  made.count = count;
  made.half_angles = degrees * (pi / 180);
  return made;
}

/// As wave_set.h says it.
double written_out(const WaveSet& waves, Vec3 u) {
  double sums[WaveSet::sums] = {};
  for (size_t i = 0; i < waves.count(); ++i) {
    const Vec3 n = waves.wave(i);
    const double t = ((n.x * u.x + n.y * u.y) + n.z * u.z) + waves.phases()[i];
    const double turn = t - std::floor(t);
    sums[i % WaveSet::sums] += waves.amplitude() * apply(Op::cosine, turn * two_pi, 0);
  }
  for (size_t half = WaveSet::sums / 2; half > 0; half /= 2)
    for (size_t i = 0; i < half; ++i) sums[i] += sums[i + half];
  return sums[0];
}

/// Within a turn angles are reduced in a way of their own; at its ends and where quarters change,
/// too, the bits are those of all other sines and cosines.
void sines_of_turns_are_those_of_angles(void**) {
  std::vector<double> turns;
  for (int eighth = -9; eighth <= 9; ++eighth) {
    double below = eighth / 8.0, above = below;
    for (int i = 0; i < 8; ++i) {
      turns.insert(turns.end(), {below, above});
      below = std::nextafter(below, -2);
      above = std::nextafter(above, 2);
    }
    turns.insert(turns.end(), {eighth / 8.0 - 1e-17, eighth / 8.0 + 1e-9});
  }
  Random random(8);
  while (turns.size() < 4000 || turns.size() % 16) turns.push_back(random.between(-3, 3));
  std::vector<double> sines(turns.size()), cosines(turns.size());
  for (int64_t all = hwy::SupportedTargets() & HWY_TARGETS; all; all &= all - 1) {
    hwy::SetSupportedTargetsForTest(all & -all);
    sines_of_turns(turns.data(), turns.size(), sines.data(), cosines.data());
    for (size_t i = 0; i < turns.size(); ++i) {
      const double angle = (turns[i] - std::floor(turns[i])) * two_pi;
      const double sine = apply(Op::sine, angle, 0), cosine = apply(Op::cosine, angle, 0);
      if (std::memcmp(&sine, &sines[i], 8) != 0 || std::memcmp(&cosine, &cosines[i], 8) != 0)
        fail_msg("turn %.17g: %.17g, %.17g; expected %.17g, %.17g", turns[i], sines[i], cosines[i],
                 sine, cosine);
    }
  }
  hwy::SetSupportedTargetsForTest(0);
}

void all_instruction_sets_give_the_written_sum(void**) {
  for (int64_t all = hwy::SupportedTargets() & HWY_TARGETS; all; all &= all - 1) {
    hwy::SetSupportedTargetsForTest(all & -all);
    Random random(3);
    for (const uint32_t count : {1u, 15u, 16u, 17u, 100u}) {
      const WaveSet waves(directions(count));
      for (size_t i = test_count(300); i > 0; --i) {
        const Vec3 u = random.in_box({{-50, -50, -50}, {50, 50, 50}});
        const double wanted = written_out(waves, u);
        Vec3 gradient;
        assert_true(wave_sum(waves, u) == wanted);
        assert_true(wave_gradient(waves, u, gradient) == wanted);
        assert_true(expand_waves(waves, u, {1, 2, 3}).value == wanted);
      }
    }
    hwy::SetSupportedTargetsForTest(0);
  }
}

void derivatives_are_those_of_the_sum(void**) {
  const WaveSet waves(directions(40));
  Random random(4);
  for (size_t i = test_count(200) + 5; i > 0; --i) {
    const Vec3 u = random.in_box({{-5, -5, -5}, {5, 5, 5}}), du{0.3, -0.4, 0.5};
    const WaveExpansion at = expand_waves(waves, u, du);
    constexpr double h = 1e-3;
    const double a = wave_sum(waves, u - du * h), b = wave_sum(waves, u + du * h);
    const double aa = wave_sum(waves, u - du * (2 * h)), bb = wave_sum(waves, u + du * (2 * h));
    assert_true(std::abs((b - a) / (2 * h) - at.first) < 1e-3);
    assert_true(std::abs((a + b - 2 * at.value) / (h * h) - at.second) < 1e-2);
    assert_true(std::abs((bb - 2 * b + 2 * a - aa) / (2 * h * h * h) - at.third) < 1e-1);
    Vec3 gradient;
    wave_gradient(waves, u, gradient);
    assert_true(std::abs(dot(gradient, du) - at.first) < 1e-10);
  }
}

/// Values of Python's statistics.NormalDist.inv_cdf.
void levels_are_quantiles(void**) {
  const double known[][2] = {{0.5, 0},
                             {0.3, -0.52440051270804089},
                             {0.7, 0.52440051270804067},
                             {0.05, -1.6448536269514729},
                             {0.975, 1.9599639845400536},
                             {1e-6, -4.7534243088228987},
                             {1e-13, -7.3487961028006774}};
  for (const auto& [p, level] : known) {
    assert_true(std::abs(gaussian_level(p, false) - level) <= 1e-14 * (1 + std::abs(level)));
    if (p > 0.5)
      assert_true(std::abs(gaussian_level(2 * p - 1, true) - level) <= 1e-13 * (1 + level));
  }
}

void directions_are_in_their_cones(void**) {
  const Vec3 cones[] = {{90, 0, 0}, {15, 0, 0}, {0, 20, 20}, {30, 30, 30}, {0, 0, 90}, {60, 60, 0}};
  for (const Vec3 degrees : cones) {
    const WaveSet waves(directions(4096, degrees));
    double squares[3] = {};
    size_t in_cone[3] = {};
    for (size_t i = 0; i < waves.count(); ++i) {
      const Vec3 n = waves.wave(i);
      assert_true(std::abs(dot(n, n) - 1) < 1e-14);
      bool is_in = false;
      for (int axis = 0; axis < 3; ++axis) {
        squares[axis] += n[axis] * n[axis] / 4096;
        const bool is_here =
            degrees[axis] > 0 && std::abs(n[axis]) >= std::cos(degrees[axis] * (pi / 180)) - 1e-15;
        in_cone[axis] += is_here;
        is_in = is_in || is_here;
      }
      assert_true(is_in);
    }
    // Of all directions each square is 1/3; equal cones have equal parts.
    if (max_component(degrees) == 90)
      for (const double square : squares) assert_true(std::abs(square - 1.0 / 3) < 0.02);
    if (degrees.x == 30)
      for (const size_t count : in_cone) assert_in_range(count, 1365 - 130, 1365 + 130);
  }
}

void tiles_repeat(void**) {
  WaveDirections tiled = directions(60);
  tiled.tile[0] = 3;
  tiled.tile[2] = 5;
  const WaveSet waves(tiled);
  Random random(8);
  for (size_t i = test_count(200) + 5; i > 0; --i) {
    const Vec3 u = random.in_box({{-5, -5, -5}, {5, 5, 5}});
    assert_true(std::abs(wave_sum(waves, u) - wave_sum(waves, u + Vec3{3, 0, -10})) < 1e-11);
    assert_true(std::abs(wave_sum(waves, u) - wave_sum(waves, u + Vec3{0, 1, 0})) > 0);
  }
}

const Rotation skew{{0.8, -0.6, 0, 0.6, 0.8, 0, 0, 0, 1}};

Ref<Waves> make(uint32_t count, WavesKind kind, Parameter level, Vec3 cell = {1, 1, 1},
                Rotation rotation = {}) {
  return make_ref<Waves>(Neighbourhood{{0.3, -0.2, 0.1}, cell, rotation}, directions(count), kind,
                         std::move(level));
}

Parameter ramp(bool is_bent) {
  Ref<const Field> field = make_ref<GradientField>(Vec3{-1, -1, -1}, 0.1, Vec3{2, 3, 2}, 0.9);
  if (is_bent) field = make_ref<MapField>(field, Curve({{0.1, 0.2}, {0.5, 0.9}, {0.9, 0.1}}));
  return Parameter(field);
}

/// The share of the samples of three blocks at each pitch; few and many knots along each axis.
void rows_are_the_definition(void**) {
  Random random(12);
  size_t samples = 0, held = 0;
  for (const double pitch : {1.0 / 200, 1.0 / 64, 1.0 / 17, 1.0 / 5, 1.7})
    for (const WavesKind kind : {WavesKind::network, WavesKind::sheet})
      for (int form = 0; form < 4; ++form) {
        const Parameter level = form < 2 ? Parameter(0.4) : ramp(form == 3);
        const Ref<Waves> solid =
            make(form == 1 ? 400 : 37, kind, level, {1, 1.5, 0.8}, form % 2 ? skew : Rotation{});
        SampleGrid grid;
        grid.origin = random.in_box({{-2, -2, -2}, {2, 2, 2}});
        grid.spacing = {pitch, 1.3 * pitch, 0.7 * pitch};
        grid.nx = 64 + random.below(80);
        grid.ny = 1 + random.below(test_count(70) + 1);
        grid.nz = 1 + random.below(4);
        const std::vector<double> heights{-0.4, 0.1, 0.11, 0.9};
        if (form == 2) grid.heights = heights.data();
        BitRows rows(grid);
        for (uint64_t k = 0; k < grid.nz; ++k)
          for (uint64_t j = 0; j < grid.ny; ++j) set_bits(rows.block().row(j, k), 1, grid.nx - 1);
        solid->keep_rows(rows.block(), nullptr);
        for (uint64_t k = 0; k < grid.nz; ++k)
          for (uint64_t j = 0; j < grid.ny; ++j)
            for (uint64_t i = 0; i < grid.nx; ++i) {
              const bool is_inside = i > 0 && solid->inside(grid.at(i, j, k));
              if (rows.get(i, j, k) != is_inside)
                fail_msg("pitch %g, form %d: sample %d %d %d is %d", pitch, form, int(i), int(j),
                         int(k), rows.get(i, j, k));
              ++samples;
              held += is_inside;
            }
      }
  assert_in_range(held, samples / 5, samples);
}

void volumes_are_those_asked_for(void**) {
  // A mean over many structures: one has few independent parts.
  for (const bool is_sheet : {false, true})
    for (const double wanted : {0.2, 0.5, 0.8}) {
      const Parameter level(gaussian_level(wanted, is_sheet));
      size_t held = 0;
      const size_t sets = 200, each = 200;
      Random random(21);
      for (size_t n = 0; n < sets; ++n) {
        const Waves solid(Neighbourhood{}, directions(64, {90, 0, 0}, n),
                          is_sheet ? WavesKind::sheet : WavesKind::network, level);
        for (size_t i = 0; i < each; ++i)
          held += solid.inside(random.in_box({{0, 0, 0}, {40, 40, 40}}));
      }
      const double count = static_cast<double>(sets * each);
      const double got = static_cast<double>(held) / count;
      // The fourth moment of 64 waves is 3 - 1.5 / 64: less than 0.003 of the volume.
      if (std::abs(got - wanted) > 4 * std::sqrt(wanted * (1 - wanted) / count) + 0.003)
        fail_msg("%g of the volume, not %g", got, wanted);
    }
}

void distances_are_bounds(void**) {
  Random random(31);
  for (const WavesKind kind : {WavesKind::network, WavesKind::sheet})
    for (int form = 0; form < 2; ++form) {
      const Ref<Waves> solid =
          make(30, kind, form ? ramp(false) : Parameter(0.3), {1, 2, 0.7}, skew);
      double most = 0;
      for (size_t i = test_count(3000); i > 0; --i) {
        const Vec3 p = random.in_box({{-3, -3, -3}, {3, 3, 3}});
        const double bound = solid->distance_bound(p);
        most = std::max(most, bound);
        const Vec3 to = random.in_box({{-1, -1, -1}, {1, 1, 1}});
        const Vec3 q = p + to * (0.999 * bound / length(to));
        assert_true(solid->inside(q) == solid->inside(p));
        const Vec3 near = p + to * 0.01;
        assert_true(std::abs(solid->distance_bound(near) - bound) <= 0.01 * length(to) + 1e-9);
      }
      assert_true(most > 0.02);
    }
}

void rays_find_the_first_change(void**) {
  Random random(41);
  size_t found = 0;
  for (const WavesKind kind : {WavesKind::network, WavesKind::sheet})
    for (int form = 0; form < 3; ++form) {
      const Parameter level =
          form == 0 ? Parameter(-0.5 + (kind == WavesKind::sheet)) : ramp(form == 2);
      const Ref<Waves> solid = make(50, kind, level, {1, 1.5, 0.8}, skew);
      for (size_t i = test_count(60) + 3; i > 0; --i) {
        const Vec3 way = random.in_box({{-1, -1, -1}, {1, 1, 1}});
        const Ray ray{random.in_box({{-2, -2, -2}, {2, 2, 2}}), way * (1 / length(way))};
        RaySearch search{ray, 0, 3};
        const bool begins_inside = solid->inside(ray.at(0));
        solid->enter(&search, 1, nullptr);
        const double end = search.found ? search.t : 3;
        for (int n = 0; n < 500; ++n) {
          const double t = end * (n / 500.0);
          if (solid->inside(ray.at(t)) && t + 1e-9 < end)
            fail_msg("inside at %.17g, entered at %.17g", t, end);
        }
        if (!search.found) continue;
        ++found;
        assert_true(solid->inside(ray.at(search.t)));
        if (!begins_inside) {
          assert_true(!solid->inside(ray.at(search.t - 2 * solid->ray_tolerance())));
          const Vec3 normal = solid->normal(ray, search.t);
          assert_true(std::abs(length(normal) - 1) < 1e-12 && dot(normal, ray.direction) < 1e-3);
        }
        const double out = solid->leave(ray, search.t, 3, nullptr);
        for (int n = 0; n < 200; ++n) {
          const double t = search.t + (out - search.t) * (n / 200.0);
          if (!solid->inside(ray.at(t)) && t + 1e-9 < out)
            fail_msg("outside at %.17g, left at %.17g", t, out);
        }
      }
    }
  assert_true(found > 5);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(sines_of_turns_are_those_of_angles),
      cmocka_unit_test(all_instruction_sets_give_the_written_sum),
      cmocka_unit_test(derivatives_are_those_of_the_sum),
      cmocka_unit_test(levels_are_quantiles),
      cmocka_unit_test(directions_are_in_their_cones),
      cmocka_unit_test(tiles_repeat),
      cmocka_unit_test(rows_are_the_definition),
      cmocka_unit_test(volumes_are_those_asked_for),
      cmocka_unit_test(distances_are_bounds),
      cmocka_unit_test(rays_find_the_first_change),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
