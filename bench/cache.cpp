// SPDX-License-Identifier: Apache-2.0
// The cell cache: what a hit costs, what two threads build twice, and how many cells of real work
// are found if not all fit, under both policies.
//
// usage: cache [results.json]
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <thread>

#include "base/random.h"
#include "bench.h"
#include "cell/cache.h"
#include "foam_rays.h"

namespace {

using bench::check;

struct Data final : msq::CellData {
  uint64_t bytes() const override { return 1000; }
};

/// Nanoseconds of processor time for a hit, in `threads` threads at once, which fetch the same
/// cells or their own.
double hit_nanoseconds(int threads, int cells, bool is_shared) {
  msq::CellCache cache(1 << 30, std::make_shared<msq::MemoryBudget>(0));
  const auto fetch = [&](int first, uint64_t count) {
    for (uint64_t i = 0; i < count; ++i)
      cache.fetch(1, {first + static_cast<int>(i * 7 % static_cast<uint64_t>(cells)), 0, 0},
                  [] { return std::make_shared<const Data>(); });
  };
  constexpr uint64_t count = 2000000;
  const auto first_of = [&](int t) { return is_shared ? 0 : t * cells; };
  for (int t = 0; t < threads; ++t) fetch(first_of(t), static_cast<uint64_t>(cells));
  double least = 1e300;
  for (int run = 0; run < 3; ++run) {
    const std::clock_t start = std::clock();
    std::vector<std::thread> running;
    for (int t = 1; t < threads; ++t) running.emplace_back(fetch, first_of(t), count);
    fetch(first_of(0), count);
    for (std::thread& thread : running) thread.join();
    least = std::min(least, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return least / static_cast<double>(count * static_cast<uint64_t>(threads)) * 1e9;
}

/// Seconds until two threads have fetched all of 2000 cells, each built in about 50 us, in the same
/// order; and how many were built twice.
void bench_same_cells(bench::Report& report) {
  msq::CellCache cache(1 << 30, std::make_shared<msq::MemoryBudget>(0));
  const auto work = [&] {
    for (int i = 0; i < 2000; ++i)
      cache.fetch(1, {i, 0, 0}, [&] {
        const auto end = std::chrono::steady_clock::now() + std::chrono::microseconds(50);
        while (std::chrono::steady_clock::now() < end) continue;
        return std::make_shared<const Data>();
      });
  };
  const double seconds = bench::seconds_of([&] {
    std::thread other(work);
    work();
    other.join();
  });
  report.add("two threads fetch the same 2000 cells of 50 us in one order", seconds, 2000, "cell");
  report.note("  built twice", static_cast<double>(cache.counters().duplicates) / 2000, "a cell");
}

/// What a context is made of for a piece of work.
struct Setting {
  uint64_t cache_bytes = uint64_t{4} << 30;
  int32_t policy = MSQ_CACHE_FIFO;
  uint32_t threads = 2;
};

msq_context* make_context(const Setting& setting) {
  return bench::make_context(setting.threads, setting.cache_bytes, setting.policy);
}

double uniform(uint64_t& state) {
  return msq::random_fraction(msq::splitmix_output(77, state++));
}

/// A stack of slabs, bottom to top.
void slice_upwards(msq_context* context) {
  msq_model* model = bench::make_foam_model(context, 128);
  msq_slicer* slicer = bench::make_slicer(model, bench::slices_of(1024));
  bench::Reader reader;
  check(msq_slicer_run(slicer, 0, 512, bench::Reader::take, &reader, nullptr));
  msq_slicer_release(slicer);
  msq_model_release(model);
}

/// Parts of the stack, as someone asks who looks through it: on and back, now and then elsewhere.
void slice_about(msq_context* context) {
  msq_model* model = bench::make_foam_model(context, 128);
  msq_slicer* slicer = bench::make_slicer(model, bench::slices_of(1024));
  bench::Reader reader;
  uint64_t state = 0;
  double z = 300;
  for (int i = 0; i < 24; ++i) {
    z += uniform(state) < 0.15 ? 600 * (uniform(state) - 0.5) : 120 * (uniform(state) - 0.5);
    z = std::abs(std::remainder(z, 2048));
    const uint64_t first = std::min(uint64_t{1024 - 32}, static_cast<uint64_t>(z));
    check(msq_slicer_run(slicer, first, 32, bench::Reader::take, &reader, nullptr));
  }
  msq_slicer_release(slicer);
  msq_model_release(model);
}

/// Frames of 192^2 rays while the eye goes round the cube.
void orbit(msq_context* context) {
  msq_model* model = bench::make_foam_model(context, 64);
  bench::Picture picture(192);
  for (int frame = 0; frame < 32; ++frame) {
    const double angle = 0.5 + frame * 0.03;
    const auto camera = bench::fit_camera(model, {std::cos(angle), std::sin(angle), -0.3}, 192);
    picture.render(model, camera);
  }
  msq_model_release(model);
}

/// Frames of 192^2 rays that come closer, and back.
void zoom(msq_context* context) {
  msq_model* model = bench::make_foam_model(context, 64);
  bench::Picture picture(192);
  msq_camera camera = bench::fit_camera(model, {-1, -0.7, -0.4}, 192);
  const double height = camera.height;
  for (int frame = 0; frame < 32; ++frame) {
    camera.height = height * std::pow(0.85, std::min(frame, 31 - frame));
    picture.render(model, camera);
  }
  msq_model_release(model);
}

/// The host's cells of 4 kB, 64^3 of them; sets of random points in boxes about the middle.
void random_boxes(msq_context* context) {
  msq_host_structure_def def;
  check(msq_host_structure_def_init(&def, sizeof def));
  def.concurrent = 1;
  for (double& size : def.grid.cell_size) size = 1.0 / 64;
  def.build_cell = [](void*, const int32_t*, void** data, uint64_t* bytes) -> int32_t {
    static int one;
    *data = &one;
    *bytes = 4000;
    return 0;
  };
  def.evaluate_cell = [](void*, const void*, const msq_host_points* points,
                         uint8_t* inside) -> int32_t {
    for (uint64_t i = 0; i < points->count; ++i) inside[i] = 1;
    return 0;
  };
  msq_structure* structure;
  check(msq_structure_host(context, &def, &structure));
  msq_model* model = bench::make_model(context, bench::make_cube(context), structure);
  uint64_t state = 0;
  std::vector<double> points(3 * 20000);
  std::vector<uint8_t> inside(20000);
  for (int set = 0; set < 200; ++set) {
    const double side = 0.03 + 0.25 * uniform(state) * uniform(state);
    double low[3];
    for (double& c : low)  // denser about the middle
      c = (1 - side) * (uniform(state) + uniform(state) + uniform(state)) / 3;
    for (size_t i = 0; i < points.size(); ++i) points[i] = low[i % 3] + side * uniform(state);
    msq_points_def asked;
    check(msq_points_def_init(&asked, sizeof asked));
    asked.coordinates = points.data();
    asked.count = inside.size();
    check(msq_set_membership(model, &asked, nullptr, inside.data(), inside.size(), nullptr));
  }
  msq_model_release(model);
}

/// Does the work with caches that hold a part of all its cells, under both policies.
void bench_work(bench::Report& report, const std::string& name, void (*work)(msq_context*)) {
  const auto cache_after = [&](const Setting& setting, double* seconds) {
    msq_context* context = make_context(setting);
    const double taken = bench::seconds_of([&] { work(context); });
    const msq_cache_report cache = bench::cache_of(context);
    msq_context_release(context);
    if (seconds) *seconds = taken;
    return cache;
  };
  const auto fetches_of = [](const msq_cache_report& cache) {
    return static_cast<double>(cache.hits + cache.misses);
  };
  // With room for all cells, the peak is what they take.
  const msq_cache_report all = cache_after({}, nullptr);
  report.note(name + ": fetches", fetches_of(all), "");
  report.note("  different cells", static_cast<double>(all.misses - all.duplicates), "");
  report.note("  these take", static_cast<double>(all.peak_bytes) / 1e6, "MB");
  for (const double part : {0.125, 0.25, 0.5})
    for (const int32_t policy : {MSQ_CACHE_FIFO, MSQ_CACHE_SEGMENTED}) {
      double seconds;
      const auto room = static_cast<uint64_t>(part * static_cast<double>(all.peak_bytes));
      const msq_cache_report cache = cache_after({room, policy}, &seconds);
      const std::string title = name + ", " + std::to_string(part * 100).substr(0, 4) +
                                (policy ? " % of it, segmented" : " % of it, FIFO");
      report.add(title + ", two threads", seconds, fetches_of(cache), "fetch");
      report.note("  hits", 100 * static_cast<double>(cache.hits) / fetches_of(cache), "%");
      report.note("  built twice",
                  100 * static_cast<double>(cache.duplicates) / static_cast<double>(cache.misses),
                  "% of misses");
      report.note("  no room", static_cast<double>(cache.unkept), "misses");
    }
}

}  // namespace

int main(int count, char** arguments) try {
  bench::Report report("Cell cache");
  for (const int cells : {1, 1000, 100000}) {
    const std::string of = ", " + std::to_string(cells) + " cells";
    report.note("hit, one thread" + of, hit_nanoseconds(1, cells, true), "ns");
    report.note("hit, two threads, the same" + of, hit_nanoseconds(2, cells, true), "ns");
    report.note("hit, two threads, each its own" + of, hit_nanoseconds(2, cells, false), "ns");
  }
  bench_same_cells(report);
  bench_work(report, "slices of 128^3 cells, upwards", slice_upwards);
  bench_work(report, "slices of 128^3 cells, to and fro", slice_about);
  bench_work(report, "rays, orbit round 64^3 cells", orbit);
  bench_work(report, "rays, zoom into 64^3 cells", zoom);
  bench_work(report, "random sets in boxes, 64^3 host cells", random_boxes);
  report.write(count, arguments);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
