// SPDX-License-Identifier: Apache-2.0
// The sieve of capsules for rays, against what is found in double precision.
#include <algorithm>
#include <limits>
#include <vector>

#include "base/vec.h"
#include "msq_test.h"
#include "random.h"
#include "strut/capsule_rays.h"
#include "strut/segment.h"

using namespace msq;
using namespace msq::test;

namespace {

constexpr double none = std::numeric_limits<double>::infinity();

/// Where a ray is within `radius` of a segment from `from` on: by steps no longer than the distance
/// that is left.
double first_within(Vec3 o, Vec3 u, const Segment& segment, double radius, double from, double to) {
  for (double t = from; t <= to;) {
    const double left = std::sqrt(segment.distance_squared(o + u * t)) - radius;
    if (left <= 1e-12) return t;
    t += left;
  }
  return none;
}

Vec3 direction_of(Random& random) {
  while (true) {
    const Vec3 d = random.in_box({{-1, -1, -1}, {1, 1, 1}});
    const double size = length(d);
    if (size > 0.1 && size < 1) return d * (1 / size);
  }
}

struct List {
  std::vector<Segment> segments;
  std::vector<float> values;
  std::vector<uint32_t> ids;
  CapsuleView view;

  /// Of all lengths, some along `u`.
  List(Random& random, size_t count, Vec3 corner, Vec3 u)
      : values(6 * count + capsule_padding), ids(count + capsule_padding) {
    for (size_t i = 0; i < count; ++i) {
      const double size = i % 5 == 0 ? 0 : std::pow(10.0, -4 * random.in_box({{}, {1, 1, 1}}).x);
      Vec3 d = i % 3 == 0 ? u : direction_of(random);
      if (i % 6 == 0) d = d + direction_of(random) * 1e-3;
      const Vec3 a = random.in_box({{-1, -1, -1}, {2, 2, 2}});
      const double parts[6] = {a.x - corner.x, a.y - corner.y, a.z - corner.z,
                               d.x * size,     d.y * size,     d.z * size};
      double kept[6];
      for (size_t k = 0; k < 6; ++k) kept[k] = values[k * count + i] = static_cast<float>(parts[k]);
      const Vec3 from = Vec3{kept[0], kept[1], kept[2]} + corner;
      segments.emplace_back(from, from + Vec3{kept[3], kept[4], kept[5]});
      ids[i] = static_cast<uint32_t>(7 * i);
    }
    for (size_t k = 0; k < 3; ++k) {
      view.a[k] = values.data() + k * count;
      view.ab[k] = values.data() + (k + 3) * count;
    }
    view.ids = ids.data();
    view.count = count;
  }
};

struct Packet {
  Vec3 origins[RayPacket::most], directions[RayPacket::most];
  RayPacket rays;

  /// All along u, or with directions like it.
  Packet(Random& random, size_t count, double apart, Vec3 u, bool is_parallel = false) {
    const Vec3 start = random.in_box({{-0.5, -0.5, -0.5}, {1.5, 1.5, 1.5}});
    rays.count = count;
    rays.starts = true;
    rays.is_parallel = is_parallel;
    const double reach = 2;
    Vec3 in, out;
    for (size_t n = 0; n < RayPacket::most; ++n) {
      rays.from[n] = 1;
      rays.to[n] = -1;
    }
    for (size_t n = 0; n < count; ++n) {
      Vec3 d = is_parallel ? u : u + direction_of(random) * (0.2 * apart);
      d = d * (1 / length(d));
      const Vec3 o = start + direction_of(random) * apart;
      double kept[6] = {o.x, o.y, o.z, d.x, d.y, d.z};
      for (int k = 0; k < 3; ++k) {
        kept[k] = rays.origin[k][n] = static_cast<float>(kept[k]);
        kept[k + 3] = rays.direction[k][n] = static_cast<float>(kept[k + 3]);
      }
      origins[n] = {kept[0], kept[1], kept[2]};
      directions[n] = {kept[3], kept[4], kept[5]};
      rays.from[n] = 0;
      rays.to[n] = static_cast<float>(reach);
      in = in + origins[n] * (1.0 / static_cast<double>(count));
      out = out + (origins[n] + directions[n] * reach) * (1.0 / static_cast<double>(count));
    }
    const Vec3 along = (out - in) * (1 / length(out - in));
    double spread = 0;
    for (size_t n = 0; n < count; ++n)
      spread = std::max(
          {spread, length(origins[n] - in), length(origins[n] + directions[n] * reach - out)});
    for (int k = 0; k < 3; ++k) {
      rays.centre[k] = static_cast<float>(in[k]);
      rays.along[k] = is_parallel ? rays.direction[k][0] : static_cast<float>(along[k]);
    }
    rays.spread = static_cast<float>(spread + 1e-5);
  }
};

void finds_what_rays_meet_first(void**) {
  Random random(5);
  constexpr double radius = 0.1;
  const size_t rounds = test_count(3000);
  size_t met = 0, far = 0;
  for (size_t round = 0; round < rounds; ++round) {
    const Vec3 u = direction_of(random), corner{double(random.below(3)), -1, 0};
    const List list(random, 1 + random.below(round % 10 == 0 ? 600 : 60), corner, u);
    const Packet packet(random, 1 + random.below(RayPacket::most), round % 2 ? 0.1 : 1e-6, u,
                        round % 4 < 2);
    const float from[3] = {static_cast<float>(corner.x), static_cast<float>(corner.y),
                           static_cast<float>(corner.z)};
    PacketHits hits;
    hits.clear();
    meet_capsules(list.view, static_cast<float>(radius), from, packet.rays, nullptr, hits);
    for (size_t n = 0; n < packet.rays.count; ++n) {
      double first = none, other = none;
      for (size_t i = 0; i < list.segments.size(); ++i) {
        const double t =
            first_within(packet.origins[n], packet.directions[n], list.segments[i], radius, 0, 2);
        first = std::min(first, t);
        if (list.ids[i] != hits.id[n]) other = std::min(other, t);
      }
      if (first == none) continue;
      ++met;
      if (!(hits.first[n] <= first)) fail_msg("met at %.9g, not before %.9g", first, hits.first[n]);
      if (!(hits.second[n] <= other))
        fail_msg("another met at %.9g, not before %.9g", other, hits.second[n]);
      // It is the one, mostly: the bound of capsules along the ray is coarse.
      far += hits.first[n] < first - 0.01;
    }
  }
  assert_true(met > rounds / 4);
  assert_true(far < met / 20);
}

void finds_all_that_one_ray_meets(void**) {
  Random random(8);
  constexpr double radius = 0.1, reach = 2;
  const size_t rounds = test_count(3000);
  size_t met = 0, found = 0;
  std::vector<uint32_t> ids;
  std::vector<float> from;
  for (size_t round = 0; round < rounds; ++round) {
    const Vec3 u = direction_of(random), o = random.in_box({{}, {1, 1, 1}});
    const List list(random, 1 + random.below(round % 10 == 0 ? 600 : 60), {}, u);
    CapsuleRay ray;
    Vec3 origin, direction;
    for (int k = 0; k < 3; ++k) {
      origin[k] = ray.origin[k] = static_cast<float>(o[k]);
      direction[k] = ray.direction[k] = static_cast<float>(u[k]);
    }
    ray.to = static_cast<float>(reach);
    ids.assign(list.segments.size() + capsule_padding, UINT32_MAX);
    from.resize(ids.size());
    const size_t count =
        capsules_on_ray(list.view, static_cast<float>(radius), ray, ids.data(), from.data());
    assert_in_range(count, 0, list.segments.size());
    ids.resize(count);
    for (size_t i = 0; i < list.segments.size(); ++i) {
      const auto place = std::find(ids.begin(), ids.end(), list.ids[i]);
      const bool is_found = place != ids.end();
      const Segment& s = list.segments[i];
      const double first = first_within(origin, direction, s, radius, 0, reach);
      if (first < none) {
        ++met;
        if (!is_found) fail_msg("capsule %zu of round %zu is left out", i, round);
        const double bound = from[static_cast<size_t>(place - ids.begin())];
        if (bound > first) fail_msg("capsule %zu: %g is above %g", i, bound, first);
        assert_true(bound > first - 2 * radius - length(s.ab) - 1e-3);
      }
      found += is_found;
    }
  }
  assert_true(met > rounds / 10);
  // Those beside the ray's ends, and few others.
  assert_true(found < met + met / 4);
}

/// One by one, where the ray comes close to the radius anywhere along the axis.
void finds_thin_capsules_that_one_ray_meets(void**) {
  Random random(9);
  for (const double radius : {1e-5, 1e-4, 1e-3, 0.02, 0.1})
    for (size_t round = 0; round < test_count(20000); ++round) {
      const Vec3 d = direction_of(random), u = direction_of(random), side = cross(d, u);
      if (length(side) < 0.2) continue;
      const Vec3 a = random.in_box({{}, {1, 1, 1}}), ab = d * random.between(0.1, 2.5);
      const Vec3 o =
          a + ab * random.unit() + side * (0.9 * radius / length(side)) - u * random.unit();
      float values[6 + capsule_padding] = {};
      uint32_t ids[1 + capsule_padding] = {7}, found[1 + capsule_padding];
      CapsuleView view;
      view.ids = ids;
      view.count = 1;
      CapsuleRay ray;
      ray.to = 1;
      for (int k = 0; k < 3; ++k) {
        values[k] = static_cast<float>(a[k]);
        values[k + 3] = static_cast<float>(ab[k]);
        view.a[k] = values + k;
        view.ab[k] = values + k + 3;
        ray.origin[k] = static_cast<float>(o[k]);
        ray.direction[k] = static_cast<float>(u[k]);
      }
      float from[capsule_padding + 1];
      if (capsules_on_ray(view, static_cast<float>(radius), ray, found, from) != 1 || found[0] != 7)
        fail_msg("a capsule of radius %g and length %g is left out", radius, length(ab));
    }
}

void counts_a_strut_in_two_lists_once(void**) {
  Random random(6);
  const Vec3 u{0, 0, 1};
  List list(random, 1, {}, u);
  Packet packet(random, 4, 1e-3, u);
  list.values[0] = packet.rays.centre[0];
  list.values[1] = packet.rays.centre[1];
  list.values[2] = packet.rays.centre[2] + 1;
  const float corner[3] = {};
  PacketHits hits;
  hits.clear();
  for (int times = 0; times < 2; ++times)
    meet_capsules(list.view, 0.1f, corner, packet.rays, nullptr, hits);
  for (size_t n = 0; n < 4; ++n) {
    assert_true(std::abs(hits.first[n] - 0.9f) < 1e-2f);
    assert_true(hits.second[n] == std::numeric_limits<float>::infinity());
  }
}

/// In parts of the way, each capsule asked about once: as all at once.
void parts_find_what_the_whole_does(void**) {
  Random random(7);
  constexpr float radius = 0.1f;
  for (size_t round = 0; round < test_count(10000); ++round) {
    const Vec3 u = direction_of(random);
    const List list(random, 1 + random.below(100), {}, u);
    Packet packet(random, RayPacket::most, 0.1, u, round % 2);
    const float corner[3] = {};
    PacketHits whole, parts;
    whole.clear();
    parts.clear();
    meet_capsules(list.view, radius, corner, packet.rays, nullptr, whole);
    SeenIds seen;
    seen.clear();
    for (int part = 0; part < 8; ++part) {
      // Beyond the ends by what rays differ in; the last ones again.
      packet.rays.near = static_cast<float>(std::min(part, 6)) * 0.4f - 0.3f;
      packet.rays.far = packet.rays.near + 0.9f;
      meet_capsules(list.view, radius, corner, packet.rays, &seen, parts);
    }
    for (size_t n = 0; n < RayPacket::most; ++n) {
      assert_true(parts.first[n] == whole.first[n]);
      assert_true(parts.second[n] == whole.second[n]);
    }
  }
}

void tells_new_ids(void**) {
  SeenIds seen;
  seen.clear();
  for (uint32_t id = 0; id < 100; ++id) assert_true(seen.add(id << 16 | id));
  size_t again = 0;
  for (uint32_t id = 0; id < 100; ++id) again += !seen.add(id << 16 | id);
  assert_true(again > 50);
  seen.clear();
  assert_true(seen.add(0));
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(finds_what_rays_meet_first),
      cmocka_unit_test(finds_all_that_one_ray_meets),
      cmocka_unit_test(finds_thin_capsules_that_one_ray_meets),
      cmocka_unit_test(counts_a_strut_in_two_lists_once),
      cmocka_unit_test(parts_find_what_the_whole_does),
      cmocka_unit_test(tells_new_ids),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
