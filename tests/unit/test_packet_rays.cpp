// SPDX-License-Identifier: Apache-2.0
// Rays of a packet in vectors, against single rays: the same bits in all instruction sets.
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <vector>

#include "msq_test.h"
#include "random.h"
#include "structure/foam/rays/packet_path.h"
#include "structure/foam/rays/packet_rays.h"

using namespace msq;
using namespace msq::test;

namespace {

constexpr size_t most = PacketRays::most;

/// Rays that begin in a ball and have about the same direction.
struct Packet {
  Neighbourhood grid;
  FoamFrame frame{&grid, 1.7, 1e-11};
  std::vector<RaySearch> searches;
  PacketRays rays;

  explicit Packet(Random& random) : searches(1 + random.below(most)) {
    grid.origin = random.in_box({{-9, -9, -9}, {9, 9, 9}});
    if (random.below(2)) {
      const double turn = random.between(0, 6);
      grid.rotation.m = {
          std::cos(turn), -std::sin(turn), 0, std::sin(turn), std::cos(turn), 0, 0, 0, 1};
    }
    const Vec3 centre = random.in_box({{-20, -20, -20}, {20, 20, 20}}), along = random.direction();
    const double apart = random.between(0, 1.2), turned = random.below(2) ? 0 : 0.04;
    for (RaySearch& search : searches) {
      search.ray.origin = centre + random.direction() * apart;
      const Vec3 d = along + random.direction() * turned;
      search.ray.direction = d * (1 / length(d));
      search.from = random.below(3) ? 0 : random.between(0, 1);
      search.to = random.between(0, 30);
    }
    rays.set(frame, searches.data(), searches.size());
  }
  FoamRay ray(size_t n) const { return frame.ray(searches[n]); }
  /// Some of those that do not end before they begin.
  uint32_t live(Random& random) const {
    const uint64_t chosen = random.below(2) ? random.bits() : ~uint64_t{0} << random.below(8);
    uint32_t live = 0;
    for (size_t n = 0; n < searches.size(); ++n) live |= uint32_t{ray(n).from <= ray(n).to} << n;
    return live & static_cast<uint32_t>(chosen);
  }
};

void assert_near(double x, double y, double apart) {
  assert_true(std::abs(x - y) <= apart);
}

template <class Check>
void for_all_instruction_sets(size_t count, Check&& check) {
  Random random(2);
  for (int64_t all = hwy::SupportedTargets() & HWY_TARGETS; all; all &= all - 1) {
    hwy::SetSupportedTargetsForTest(all & -all);
    for (size_t n = test_count(count); n > 0; --n) check(random);
    hwy::SetSupportedTargetsForTest(0);
  }
}

void rays_have_the_bits_of_single_ones(void**) {
  for_all_instruction_sets(20000, [](Random& random) {
    const Packet packet(random);
    for (size_t n = 0; n < packet.searches.size(); ++n) {
      const FoamRay one = packet.ray(n), other = packet.rays.ray(n);
      for (int axis = 0; axis < 3; ++axis) {
        assert_true(one.origin[axis] == other.origin[axis]);
        assert_true(one.direction[axis] == other.direction[axis]);
      }
      assert_true(one.from == other.from && one.to == other.to);
      assert_true(one.error == other.error && one.tolerance == other.tolerance);
      assert_ptr_equal(one.search, other.search);
    }
    for (size_t n = packet.searches.size(); n < most; ++n)
      assert_true(packet.rays.from[n] > packet.rays.to[n]);
  });
}

void rays_beside_a_ray(void**) {
  for_all_instruction_sets(20000, [](Random& random) {
    const Packet packet(random);
    const size_t first = random.below(packet.searches.size());
    const FoamRay ray = packet.ray(first);
    const double apart = random.between(0.3, 1), turned = random.between(0.01, 0.1);
    const uint32_t found = packet.rays.beside(first, apart, turned);
    assert_true(found >> first & 1);
    for (size_t n = 0; n < packet.searches.size(); ++n) {
      const FoamRay other = packet.ray(n);
      const Vec3 way = other.at(other.from) - ray.at(ray.from);
      const double off = length(way - ray.direction * dot(way, ray.direction));
      const double turn = length(other.direction - ray.direction);
      if (std::abs(off - apart) > 1e-9 && std::abs(turn - turned) > 1e-9)
        assert_int_equal(found >> n & 1, off < apart && turn < turned);
    }
  });
}

/// The course, the path from a plane on, and the rays that a strut may be met by.
void paths_follow_their_rays(void**) {
  size_t refused = 0, taken = 0;
  for_all_instruction_sets(20000, [&](Random& random) {
    const Packet packet(random);
    const uint32_t live = packet.live(random);
    if (!live) return;
    const Vec3 scale = random.in_box({{0.5, 0.5, 0.5}, {2, 2, 2}});
    PacketCourse course;
    RayPacket floats;
    if (!set_course(packet.rays, live, scale, course, floats)) {
      ++refused;
      return;
    }
    ++taken;
    floats.count = packet.searches.size();
    const int k = course.axis, lateral[2] = {(k + 1) % 3, (k + 2) % 3};
    PathBase base{(std::floor(course.begin / scale[k]) + !course.up) * scale[k], {}};
    for (double& corner : base.corner) corner = random.between(-3, 3);
    PacketPath path;
    set_path(packet.rays, course, base, scale, live, path, floats);
    bool starts = false, is_parallel = true;
    const auto first_live = static_cast<size_t>(std::countr_zero(live));
    double begin = course.up ? 1e300 : -1e300, error = 0;
    for (uint32_t rest = live; rest; rest &= rest - 1) {
      const auto n = static_cast<size_t>(std::countr_zero(rest));
      const FoamRay ray = packet.ray(n);
      const double d = ray.direction[k], place = ray.at(ray.from)[k];
      assert_true(course.up ? d > 0 : d < 0);
      for (int axis = 0; axis < 3; ++axis) {
        const auto narrow = static_cast<float>(ray.direction[axis]);
        const auto of_first = static_cast<float>(packet.ray(first_live).direction[axis]);
        assert_true(floats.direction[axis][n] == narrow && floats.along[axis] == of_first);
        is_parallel = is_parallel && narrow == of_first;
      }
      begin = course.up ? std::min(begin, place) : std::max(begin, place);
      error = std::max(error, ray.error);
      // Where it crosses the plane and the next one, to the rounding of single precision.
      assert_near(ray.at(path.enter[n])[k], base.plane, 1e-12);
      assert_near(std::abs(path.way[n] * d), scale[k], 1e-12);
      assert_true(path.step[n] == static_cast<float>(path.way[n]));
      for (int side = 0; side < 2; ++side) {
        const double in = ray.at(path.enter[n])[lateral[side]] - base.corner[side];
        const double out = ray.at(path.enter[n] + path.way[n])[lateral[side]] - base.corner[side];
        assert_near(path.place[side][n], in, 1e-5);
        assert_near(path.place[side][n] + path.slope[side][n], out, 1e-5);
        assert_true(floats.origin[lateral[side]][n] == path.place[side][n]);
      }
      assert_near(path.from[n], ray.from - path.enter[n], 1e-5);
      assert_near(path.to[n], ray.to - path.enter[n], 1e-5);
      assert_true(floats.from[n] <= std::max(0.0, ray.from - path.enter[n]));
      assert_true(floats.to[n] >= ray.to - path.enter[n]);
      starts |= ray.from >= path.enter[n];
    }
    for (size_t n = 0; n < most; ++n)
      if (!(live >> n & 1)) assert_true(floats.from[n] > floats.to[n]);
    assert_true(course.begin == begin && course.error == error);
    assert_int_equal(floats.is_parallel, is_parallel);
    if (starts) assert_true(floats.starts);

    PacketHits hits;
    hits.clear();
    for (size_t n = 0; n < most; ++n)
      if (random.below(2)) hits.first[n] = static_cast<float>(random.between(0, 3));
    const int slab = static_cast<int>(random.below(4));
    const double seen = random.below(2) ? std::numeric_limits<double>::infinity() : random.unit();
    const uint32_t near = who_may_meet(packet.rays, slab, hits, live, seen, path);
    assert_false(near & ~live);
    for (uint32_t rest = live; rest; rest &= rest - 1) {
      const auto n = static_cast<size_t>(std::countr_zero(rest));
      const FoamRay ray = packet.ray(n);
      const double enter = path.enter[n] + slab * path.way[n];
      const double limit = std::min(
          {ray.to, enter + path.way[n] + 0.5 * ray_list_margin, enter + seen * path.way[n]});
      assert_true(path.last[n] == limit);
      assert_int_equal(near >> n & 1, path.enter[n] + double(hits.first[n]) <= limit);
    }
  });
  assert_true(taken > 10 * refused);
}

/// The parts of [0, 1] at which a ray is within `room` of a cell; empty if from > to.
struct WayInCell {
  double from = 0, to = 1;

  WayInCell(const PacketPath& path, size_t ray, int slab, const SlabCells& cells,
            const CrossedCell& cell, double room) {
    for (int side = 0; side < 2; ++side) {
      const double slope = path.slope[side][ray], in = path.place[side][ray] + slab * slope;
      const double low = cell.cell[side] * double(cells.size[side]) - room - in,
                   high = low + cells.size[side] + 2 * room;
      if (slope == 0) {
        if (low > 0 || high < 0) to = -1;
        continue;
      }
      from = std::max(from, std::min(low / slope, high / slope));
      to = std::min(to, std::max(low / slope, high / slope));
    }
  }
};

/// Rays are always in one of the cells found for them, and cross each of these.
void rays_cross_the_cells_found(void**) {
  size_t crossed = 0, all = 0;
  for_all_instruction_sets(5000, [&](Random& random) {
    PacketPath path;
    SlabCells cells;
    const int slab = static_cast<int>(random.below(4));
    const auto active = static_cast<uint32_t>(1 + random.below((1u << most) - 1));
    for (int side = 0; side < 2; ++side) {
      const double place = random.between(-2, 2), apart = random.between(0, 0.8);
      const double steep[] = {0, 1e-7, 1e-3, 1, 1, 1, 1};
      const double slope = steep[random.below(7)] * random.between(-1.2, 1.2);
      cells.size[side] = static_cast<float>(random.between(0.7, 1.5));
      float low = 1e30f, high = -1e30f;
      for (size_t n = 0; n < most; ++n) {
        path.place[side][n] = static_cast<float>(place + random.between(0, apart));
        // Some on the planes between cells.
        if (random.below(8) == 0)
          path.place[side][n] =
              std::floor(path.place[side][n] / cells.size[side]) * cells.size[side];
        path.slope[side][n] = static_cast<float>(slope * random.between(1, 1.02));
        if (!(active >> n & 1)) continue;
        const float in = path.place[side][n] + static_cast<float>(slab) * path.slope[side][n];
        const float out = in + path.slope[side][n];
        low = std::min(low, std::min(in, out));
        high = std::max(high, std::max(in, out));
      }
      cells.first[side] = static_cast<int32_t>(std::floor(low / cells.size[side]));
      cells.last[side] = static_cast<int32_t>(std::floor(high / cells.size[side]));
      if (cells.last[side] - cells.first[side] >= SlabCells::most) return;
    }
    CrossedCell found[SlabCells::most * SlabCells::most];
    const size_t count = find_crossed_cells(path, slab, active, cells, found);
    all += static_cast<size_t>((cells.last[0] - cells.first[0] + 1) *
                               (cells.last[1] - cells.first[1] + 1));
    crossed += count;
    constexpr double rounding = 1e-5;
    const auto first = static_cast<size_t>(std::countr_zero(active));
    const bool is_straight = std::max(std::abs(path.slope[0][first]),
                                      std::abs(path.slope[1][first])) < least_crossing_slope;
    for (size_t c = 0; c < count && !is_straight; ++c) {
      assert_true(found[c].rays != 0 && (found[c].rays & ~active) == 0);
      double enter = 1, leave = 0;
      for (uint32_t rest = found[c].rays; rest; rest &= rest - 1) {
        const auto n = static_cast<size_t>(std::countr_zero(rest));
        const WayInCell wide(path, n, slab, cells, found[c], 3e-5);
        assert_true(wide.from <= wide.to);
        enter = std::min(enter, wide.from);
        leave = std::max(leave, wide.to);
      }
      assert_true(found[c].enter >= enter - rounding && found[c].leave <= leave + rounding);
    }
    for (uint32_t rest = active; rest; rest &= rest - 1) {
      const auto n = static_cast<size_t>(std::countr_zero(rest));
      for (int step = 0; step <= 64; ++step) {
        const double part = step / 64.0;
        const bool is_seen = std::any_of(found, found + count, [&](const CrossedCell& cell) {
          const WayInCell way(path, n, slab, cells, cell, rounding);
          return cell.rays >> n & 1 && way.from <= part && part <= way.to && cell.enter <= part &&
                 part <= cell.leave;
        });
        if (!is_seen) fail_msg("ray %zu is in no cell at %g of its way", n, part);
      }
    }
  });
  assert_true(crossed < all * 19 / 20);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(rays_have_the_bits_of_single_ones), cmocka_unit_test(rays_beside_a_ray),
      cmocka_unit_test(paths_follow_their_rays), cmocka_unit_test(rays_cross_the_cells_found)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
