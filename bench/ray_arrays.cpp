// SPDX-License-Identifier: Apache-2.0
// Arrays of rays in several orders, two threads: the rays of a picture of a Voronoi foam (r = 0.1
// cell) tile by tile, row by row and shuffled, and rays from anywhere to anywhere; a new context's
// first call and the next.
//
// usage: ray_arrays [results.json]
#include <cstring>
#include <numeric>
#include <random>

#include "foam_rays.h"

namespace {

using bench::check;

struct RayArray {
  std::vector<double> origins, directions;

  uint64_t count() const { return origins.size() / 3; }
  void add(const double* origin, const double* direction) {
    origins.insert(origins.end(), origin, origin + 3);
    directions.insert(directions.end(), direction, direction + 3);
  }
  template <class Random>
  RayArray shuffled(Random& random) const {
    std::vector<uint32_t> order(count());
    std::iota(order.begin(), order.end(), 0u);
    std::shuffle(order.begin(), order.end(), random);
    RayArray rays;
    for (const uint32_t i : order) rays.add(&origins[3 * i], &directions[3 * i]);
    return rays;
  }
};

/// By squares of `tile` pixels' side, a power of 2, row by row in each.
RayArray picture_rays(const msq_camera& camera, uint32_t side, uint32_t tile) {
  RayArray rays;
  for (uint32_t n = 0; n < side * side; ++n) {
    const uint32_t square = n / (tile * tile), in = n % (tile * tile), across = side / tile;
    const uint32_t x = square % across * tile + in % tile, y = square / across * tile + in / tile;
    const double position[2] = {x + 0.5, y + 0.5};
    double origin[3], direction[3];
    check(msq_camera_ray(&camera, side, side, position, origin, direction));
    rays.add(origin, direction);
  }
  return rays;
}

/// Through two points each: one outside the unit cube, on a sphere about it, one within.
template <class Random>
RayArray random_rays(uint64_t count, Random& random) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  RayArray rays;
  for (uint64_t i = 0; i < count; ++i) {
    double from[3], to[3], size = 0;
    for (double& x : from) {
      x = normal(random);
      size += x * x;
    }
    for (int axis = 0; axis < 3; ++axis) {
      from[axis] = 0.5 + from[axis] / std::sqrt(size);
      to[axis] = uniform(random) - from[axis];
    }
    rays.add(from, to);
  }
  return rays;
}

void cast(const msq_model* model, const RayArray& array, std::vector<msq_ray_hit>& hits) {
  msq_rays_def rays;
  check(msq_rays_def_init(&rays, sizeof rays));
  rays.origins = array.origins.data();
  rays.directions = array.directions.data();
  rays.count = array.count();
  check(msq_ray_cast(model, &rays, nullptr, hits.data(), hits.size(), nullptr));
}

/// Seconds of the next call.
double bench_rays(bench::Report& report, const std::string& name, int cells, const RayArray& rays) {
  msq_context* context = bench::make_context();
  msq_model* model = bench::make_foam_model(context, cells);
  std::vector<msq_ray_hit> hits(rays.count());
  const auto work = [&] { cast(model, rays, hits); };
  report.add(name + ", first call", bench::seconds_of(work), static_cast<double>(rays.count()),
             "ray");
  const double seconds = bench::median_seconds(work);
  report.add(name + ", next call", seconds, static_cast<double>(rays.count()), "ray");
  msq_model_release(model);
  msq_context_release(context);
  return seconds;
}

}  // namespace

int main(int count, char** arguments) try {
  bench::Report report("Arrays of rays, two threads");
  std::mt19937_64 random(1);
  for (const int cells : {32, 128}) {
    constexpr uint32_t side = 1024;
    const std::string of = ", " + std::to_string(cells) + "^3 cells";
    msq_context* context = bench::make_context();
    msq_model* model = bench::make_foam_model(context, cells);
    for (const bool is_slanted : {false, true}) {
      const msq_camera camera = is_slanted ? bench::fit_camera(model, {-0.3, 1, -0.2}, side)
                                           : bench::fit_camera(model, {0, 1, 0}, side);
      const std::string view = std::string(is_slanted ? "slanted " : "front ") + "picture";
      const RayArray tiles = picture_rays(camera, side, 32);
      const double ordered = bench_rays(report, view + " by tiles" + of, cells, tiles);
      bench_rays(report, view + " by rows" + of, cells, picture_rays(camera, side, side));
      const double mixed =
          bench_rays(report, view + " shuffled" + of, cells, tiles.shuffled(random));
      report.note("  against tiles", mixed / ordered, "times as long");
    }
    msq_model_release(model);
    msq_context_release(context);
    bench_rays(report, "from anywhere" + of, cells, random_rays(1000000, random));
  }
  report.write(count, arguments);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
