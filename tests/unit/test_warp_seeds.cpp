// SPDX-License-Identifier: Apache-2.0
// Seeds of sheared cells whose boxes have so many that they are kept in the cache: they are those
// of the definition, whatever the cache holds, for several threads and two maps in one context. So
// are the walls between them, and the rays to these.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>
#include <vector>

#include "base/infinity.h"
#include "base/pi.h"
#include "msq_test.h"
#include "random.h"
#include "structure/foam/seeds/warp_seeds.h"
#include "structure/foam/walls/foam_walls.h"

using namespace msq;
using namespace msq::test;

namespace {

constexpr uint32_t count = 12;
constexpr double inner = 0.8, outer = 2.6, high = 0.75;
constexpr int threads = 4;
constexpr uint64_t cache_sizes[] = {0, 65536, uint64_t{64} << 20};

/// Maps with boxes of the same size.
struct Map {
  double outwards, along;
  uint64_t seed;
};
constexpr Map maps[] = {{0.5, 2, 7}, {-0.5, -2, 8}};

std::shared_ptr<const PlacedSeeds> make_seeds(const Ref<Context>& context, const Map& map) {
  const Neighbourhood grid{{}, {1, 1, high}, {}};
  const Warp warp{Warp::Kind::cylindrical, grid, {count, 0, inner, outer, map.outwards, map.along}};
  return std::make_shared<const WarpSeeds>(context, warp, 1.0, map.seed);
}

Ref<Context> make_context(uint64_t cache_bytes) {
  return make_ref<Context>(1u, cache_bytes, uint64_t{0});
}

/// Places of seeds by the definition, of cells around the shell and farther than any that decides.
std::vector<Vec3> places(const Map& map) {
  const FoamSeeds seeds(map.seed, 1, {1, 1, 1});
  constexpr int first = -1, last = 16, top = 20;
  std::vector<Vec3> places;
  for (int k = -top; k < top; ++k)
    for (int j = 0; j < static_cast<int>(count); ++j)
      for (int i = first; i <= last; ++i) {
        const Vec3 cells = seeds.at({}, i, j, k);
        const double r = inner + cells.x,
                     angle =
                         two_pi / count * (cells.y - map.outwards * cells.x - map.along * cells.z);
        places.push_back({r * std::cos(angle), r * std::sin(angle), high * cells.z});
      }
  return places;
}

std::vector<CellIndex> boxes_near() {
  std::vector<CellIndex> boxes;
  for (int z = -1; z <= 1; ++z)
    for (int y = -2; y <= 1; ++y)
      for (int x = -2; x <= 1; ++x) boxes.push_back({x, y, z});
  return boxes;
}

bool is_same(const PlacedSeed& a, const PlacedSeed& b) {
  return a.box == b.box && a.in_box == b.in_box && a.number == b.number && a.level == b.level;
}

/// Whether the seeds of a box are some of these places, in the order of their numbers, and all of
/// those in the shell. Boxes beyond the outermost ring of cells have a seed of their own, of number
/// 0, in place of the rest.
bool are_right(const PlacedSeeds& seeds, CellIndex box, const std::vector<Vec3>& places) {
  std::vector<PlacedSeed> found;
  seeds.find(box, found);
  const Vec3 size = seeds.grid().cell_size;
  const Vec3 low = Vec3{double(box.x), double(box.y), double(box.z)} * size;
  const auto is_near = [&](const PlacedSeed& seed, Vec3 place) {
    return length(low + seed.in_box * size - place) < 1e-9;
  };
  for (size_t i = 0; i < found.size(); ++i) {
    if (i > 0 && found[i].number <= found[i - 1].number) return false;
    if (!is_same(found[i], seeds.seed(box, found[i].number))) return false;
    if (found[i].number > 0 && std::none_of(places.begin(), places.end(),
                                            [&](Vec3 place) { return is_near(found[i], place); }))
      return false;
  }
  return std::all_of(places.begin(), places.end(), [&](Vec3 place) {
    const bool is_in_box = min_component(place - low) >= 0 && max_component(place - low - size) < 0;
    return !is_in_box || std::hypot(place.x, place.y) > outer ||
           std::any_of(found.begin(), found.end(),
                       [&](const PlacedSeed& seed) { return is_near(seed, place); });
  });
}

template <class Work>
void on_threads(Work&& work) {
  std::vector<std::thread> workers;
  for (int t = 0; t < threads; ++t) workers.emplace_back([&work, t] { work(t); });
  for (std::thread& worker : workers) worker.join();
}

void test_seeds_are_those_of_the_definition(void**) {
  const std::vector<CellIndex> boxes = boxes_near();
  const std::vector<Vec3> of_maps[] = {places(maps[0]), places(maps[1])};
  for (const uint64_t cache_bytes : cache_sizes) {
    const Ref<Context> context = make_context(cache_bytes);
    const std::shared_ptr<const PlacedSeeds> seeds[] = {make_seeds(context, maps[0]),
                                                        make_seeds(context, maps[1])};
    assert_true(seeds[0]->grid().cell_size == seeds[1]->grid().cell_size);
    std::atomic<size_t> wrong{0};
    on_threads([&](int t) {
      // Both maps in turn; boxes from the first on and from the last back.
      for (size_t n = 0; n < 4 * boxes.size(); ++n) {
        const size_t map = (n + static_cast<size_t>(t)) % 2, i = n / 2 % boxes.size();
        const CellIndex box = boxes[t < 2 ? i : boxes.size() - 1 - i];
        wrong += !are_right(*seeds[map], box, of_maps[map]);
      }
    });
    assert_int_equal(wrong, 0);
    const CellCache::Counters counters = context->cache.counters();
    print_message("cache of %llu bytes: %llu misses, %llu hits, %llu evictions\n",
                  static_cast<unsigned long long>(cache_bytes),
                  static_cast<unsigned long long>(counters.misses),
                  static_cast<unsigned long long>(counters.hits),
                  static_cast<unsigned long long>(counters.evictions));
    assert_true(counters.misses > 0);
    if (cache_bytes > 65536) assert_true(counters.hits > 0);
    if (cache_bytes == 65536) assert_true(counters.evictions > 0);
  }
}

/// Seeds that are gone leave none in the cache.
void test_cells_go_with_the_seeds(void**) {
  const Ref<Context> context = make_context(cache_sizes[2]);
  for (const Map& map : maps) {
    const std::vector<Vec3> of_map = places(map);
    const auto seeds = make_seeds(context, map);
    for (const CellIndex box : boxes_near()) assert_true(are_right(*seeds, box, of_map));
    assert_true(context->cache.counters().cells > 0);
    context->cache.clear();
    for (const CellIndex box : boxes_near()) assert_true(are_right(*seeds, box, of_map));
  }
  assert_int_equal(context->cache.counters().cells, 0);
  assert_int_equal(context->cache.counters().bytes, 0);
}

/// Of a point the distance to the boundary of the Voronoi cell that holds it: to the nearest of the
/// planes halfway to other seeds.
double wall_distance(const std::vector<Vec3>& places, Vec3 p) {
  const auto squared = [](Vec3 v) { return dot(v, v); };
  const Vec3 nearest = *std::min_element(places.begin(), places.end(), [&](Vec3 a, Vec3 b) {
    return squared(a - p) < squared(b - p);
  });
  double distance = infinity;
  for (const Vec3 place : places) {
    const double apart = length(place - nearest);
    if (apart > 0)
      distance = std::min(distance, (squared(place - p) - squared(nearest - p)) / (2 * apart));
  }
  return distance;
}

struct Question {
  Ray ray;
  double end;  // of the ray, within the shell
  double distance;
};

Vec3 in_shell(Random& random) {
  for (;;) {
    const Vec3 p = random.in_box({{-outer, -outer, -1}, {outer, outer, 1}});
    const double r = std::hypot(p.x, p.y);
    if (r > inner && r < outer) return p;
  }
}

/// Whether a point is as its distance tells, and the ray meets the first wall.
bool is_right(const Structure& walls, const Question& question, double thickness,
              const std::vector<Vec3>& places) {
  constexpr double rounding = 1e-9;
  const auto is_sure = [&](double distance) {
    return std::abs(distance - 0.5 * thickness) > rounding;
  };
  const bool is_inside = walls.inside(question.ray.origin);
  if (is_sure(question.distance) && is_inside != (question.distance < 0.5 * thickness))
    return false;
  RaySearch search{question.ray, 0, question.end};
  walls.enter(&search, 1, nullptr);
  if (search.found && !walls.inside(question.ray.at(search.t))) return false;
  const double end = search.found ? search.t : question.end;
  constexpr int steps = 8;
  for (int n = 0; n < steps; ++n) {
    const double t = end * n / steps;
    if (t + rounding >= end) break;
    const double distance = wall_distance(places, question.ray.at(t));
    if (is_sure(distance) && distance < 0.5 * thickness) return false;
  }
  return true;
}

void test_walls_are_those_of_the_definition(void**) {
  constexpr double thickness = 0.06;
  Random random(9);
  std::vector<Vec3> of_maps[2];
  std::vector<Question> questions[2];
  for (size_t map = 0; map < 2; ++map) {
    of_maps[map] = places(maps[map]);
    for (size_t n = 0; n < test_count(60) + 4; ++n) {
      const Vec3 p = in_shell(random), way = in_shell(random) - p;
      const double end = std::min(length(way), std::hypot(p.x, p.y) - inner);
      questions[map].push_back({{p, way * (1 / length(way))}, end, wall_distance(of_maps[map], p)});
    }
  }
  for (const uint64_t cache_bytes : cache_sizes) {
    const Ref<Context> context = make_context(cache_bytes);
    std::vector<Ref<const Structure>> walls;
    for (const Map& map : maps) {
      const auto placed = make_seeds(context, map);
      walls.push_back(make_ref<FoamWalls>(context, placed->grid(), Parameter(thickness), 1.0,
                                          map.seed, Parameter(1), Parameter(0), Vec3{1, 1, 1}, 0.0,
                                          placed));
    }
    std::atomic<size_t> wrong{0};
    on_threads([&](int t) {
      for (size_t n = 0; n < 2 * questions[0].size(); ++n) {
        const size_t map = (n + static_cast<size_t>(t)) % 2;
        wrong += !is_right(*walls[map], questions[map][n / 2], thickness, of_maps[map]);
      }
    });
    assert_int_equal(wrong, 0);
    assert_true(context->cache.counters().misses > 0);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(test_seeds_are_those_of_the_definition),
      cmocka_unit_test(test_cells_go_with_the_seeds),
      cmocka_unit_test(test_walls_are_those_of_the_definition),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
