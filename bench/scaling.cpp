// SPDX-License-Identifier: Apache-2.0
// What slices would gain by more cores than the machine has. The loops of msq run on threads of
// this program, more than there are cores, which count the processor time of each part of the work:
//
//   loops: of all threads. More threads do more if two of them build the same cell.
//   serial: of the calling thread, outside of loops and of the callback.
//   callback: of the host, which reads each byte. msq computes the next slab meanwhile.
//
// The model: a loop has about four tiles for each thread, so on P cores its work W takes at least
// W / P, and at most a tile longer, W / 4P. The elapsed time is that of all loops and the serial
// part, or that of the callback and the serial part if that is longer. The speed-up is that over
// the processor time with one thread.
//
// usage: scaling [results.json] [samples along a side, default 2048] [layers, default 256]
#include <time.h>

#include <array>
#include <atomic>
#include <cstdlib>
#include <string>
#include <thread>

#include "setup.h"

namespace {

double thread_seconds() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Threads for each loop, and the processor time of what they do.
class Loops {
 public:
  static int32_t run(void* user, uint64_t count, msq_task_fn body, void* task) {
    return static_cast<Loops*>(user)->run(count, body, task);
  }
  double work() const { return static_cast<double>(nanoseconds_.load()) * 1e-9; }
  /// Of the thread that calls msq: what it spends on loops, starting threads included.
  double of_caller() const { return of_caller_; }

 private:
  int32_t run(uint64_t count, msq_task_fn body, void* task) {
    const double start = thread_seconds();
    std::vector<std::jthread> threads;
    threads.reserve(count);
    for (uint64_t i = 0; i < count; ++i)
      threads.emplace_back([&, i] {
        const double begin = thread_seconds();
        body(task, i);
        nanoseconds_ += static_cast<uint64_t>((thread_seconds() - begin) * 1e9);
      });
    threads.clear();
    of_caller_ += thread_seconds() - start;
    return 0;
  }

  std::atomic<uint64_t> nanoseconds_{0};
  double of_caller_ = 0;
};

struct Parts {
  double loops = 0, serial = 0, callback = 0;
  double cells_built_twice = 0;  // of those built
  double all() const { return loops + serial + callback; }
};

struct Delivery {
  bench::Reader reader;
  double seconds = 0;
  static int32_t take(void* user, const msq_layer* layer) {
    auto& delivery = *static_cast<Delivery*>(user);
    const double start = thread_seconds();
    const int32_t code = bench::Reader::take(&delivery.reader, layer);
    delivery.seconds += thread_seconds() - start;
    return code;
  }
};

struct Case {
  const char* name;
  bool is_foam;
  int cells;
  std::array<double, 3> goals;  // speed-up by 4, 16 and 64 cores
};

Parts run(const Case& of, uint32_t threads, uint32_t resolution, uint64_t layers) {
  Loops loops;
  msq_context_def def;
  bench::check(msq_context_def_init(&def, sizeof def));
  def.threads = threads;
  if (threads > 1) {
    def.parallel_for = &Loops::run;
    def.parallel_for_user = &loops;
  }
  msq_context* context;
  bench::check(msq_context_create(&def, &context));
  msq_structure* structure;
  if (of.is_foam) {
    msq_foam_def foam;
    bench::check(msq_foam_def_init(&foam, sizeof foam));
    for (double& size : foam.grid.cell_size) size = 1.0 / of.cells;
    foam.radius.value = 0.1 / of.cells;
    bench::check(msq_structure_foam(context, &foam, &structure));
  } else {
    msq_lattice_def lattice;
    bench::check(msq_lattice_def_init(&lattice, sizeof lattice));
    lattice.unit_cell = MSQ_UNIT_CELL_BCC;
    for (double& size : lattice.grid.cell_size) size = 1.0 / of.cells;
    lattice.radius.value = 0.1 / of.cells;
    bench::check(msq_structure_lattice(context, &lattice, &structure));
  }
  msq_model* model = bench::make_model(context, bench::make_cube(context), structure);
  msq_slicer* slicer = bench::make_slicer(model, bench::slices_of(resolution));

  Delivery delivery;
  const double start = thread_seconds();
  bench::check(msq_slicer_run(slicer, 0, layers, Delivery::take, &delivery, nullptr));
  const double of_caller = thread_seconds() - start;
  Parts parts;
  parts.callback = delivery.seconds;
  if (threads == 1) {
    parts.loops = of_caller - delivery.seconds;
  } else {
    parts.loops = loops.work();
    parts.serial = of_caller - delivery.seconds - loops.of_caller();
  }
  msq_cache_report cache;
  cache.struct_size = sizeof cache;
  bench::check(msq_cache_stats(context, &cache));
  if (cache.misses)
    parts.cells_built_twice =
        static_cast<double>(cache.duplicates) / static_cast<double>(cache.misses);
  msq_slicer_release(slicer);
  msq_model_release(model);
  msq_context_release(context);
  return parts;
}

}  // namespace

int main(int count, char** arguments) try {
  const uint32_t resolution = count > 2 ? static_cast<uint32_t>(std::atoi(arguments[2])) : 2048;
  const uint64_t layers = count > 3 ? std::strtoull(arguments[3], nullptr, 10) : 256;
  bench::Report report("Slices on more threads than cores, " + std::to_string(resolution) +
                       "^2 x " + std::to_string(layers));
  const Case cases[] = {{"foam, 256^3 cells", true, 256, {3.8, 14, 45}},
                        {"foam, 32^3 cells", true, 32, {}},
                        {"BCC, 33^3 cells", false, 33, {3, 6, 10}}};
  for (const Case& of : cases) {
    const double alone = run(of, 1, resolution, layers).all();
    report.add(std::string(of.name) + ", one thread", alone,
               double(resolution) * resolution * double(layers), "sample");
    for (const uint32_t threads : {4u, 16u, 64u}) {
      const Parts parts = run(of, threads, resolution, layers);
      const std::string name = "  " + std::to_string(threads) + " threads: ";
      report.note(name + "loops, times one thread's work", parts.loops / alone, "");
      report.note(name + "cells built twice", 100 * parts.cells_built_twice, "%");
      report.note(name + "serial", 100 * parts.serial / alone, "% of one thread's work");
      report.note(name + "callback", 100 * parts.callback / alone, "% of one thread's work");
      const auto speed_up = [&](double longer) {
        return alone / (parts.serial + std::max(parts.callback, parts.loops * longer / threads));
      };
      report.note(name + "speed-up, loops with a tile to wait for", speed_up(1.25), "times");
      const size_t goal = threads == 4 ? 0 : threads == 16 ? 1 : 2;
      if (of.goals[goal] > 0)
        report.mark(name + "speed-up", speed_up(1), "times", of.goals[goal], true);
      else
        report.note(name + "speed-up", speed_up(1), "times");
    }
  }
  report.write(count, arguments);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
