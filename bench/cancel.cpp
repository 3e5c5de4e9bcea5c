// SPDX-License-Identifier: Apache-2.0
// How soon long calls return once their job is cancelled. Each call is begun anew, with nothing
// cached, for each of a row of random moments at which it is cancelled, in its first two seconds.
// The processor time of all threads from then on says what the call still did; the time that passes
// says on a busy machine how long others ran.
//
// usage: cancel [results.json [part of a name [moments, default 15]]]
#include <atomic>
#include <cstdlib>
#include <ctime>
#include <random>
#include <string>
#include <thread>

#include "cancel_calls.h"

namespace {

using namespace bench;

constexpr double longest = 2;  // seconds of a call that are looked at
constexpr double target = 50;  // milliseconds of processor time

struct Case {
  std::string name;
  std::function<void(Setup&)> prepare;
  Call call;
};

// ---- the cases ----------------------------------------------------------------------------------

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  const auto add = [&](std::string name, std::function<void(Setup&)> prepare, Call call) {
    cases.push_back({name, std::move(prepare), std::move(call)});
  };
  const auto with_points = [](FoamOf of, size_t count) {
    return [=](Setup& s) {
      s.fill_cube(foam(s, of));
      s.add_points(count);
    };
  };
  add("array, foam, POINT, r 0.1", with_points({64, 0.1, MSQ_FOAM_POINT}, 1000000), ask_membership);
  add("array, foam, POINT, r 1", with_points({64, 1, MSQ_FOAM_POINT}, 1000000), ask_membership);
  add("array, foam, METHOD_1, r 0.1", with_points({64, 0.1, MSQ_FOAM_METHOD_1}, 1000000),
      ask_membership);
  add("array, foam, METHOD_1, r 1", with_points({64, 1, MSQ_FOAM_METHOD_1}, 1000000),
      ask_membership);
  add("array, foam, METHOD_2, r 1", with_points({64, 1, MSQ_FOAM_METHOD_2}, 1000000),
      ask_membership);
  add("array, foam, r 1", with_points({64, 1}, 1000000), ask_membership);
  add("array, foam of density 32768", with_points({8, 0.003, 0, 32768}, 1000000), ask_membership);
  add("array, foam of density 32768, thick", with_points({8, 0.3, 0, 32768}, 1000000),
      ask_membership);
  add("distances, foam of density 32768", with_points({8, 0.003, 0, 32768}, 1000000), ask_distance);
  const auto with_foam = [](FoamOf of) { return [=](Setup& s) { s.fill_cube(foam(s, of)); }; };
  add("slices, foam", with_foam({128, 0.1}), slice(1024));
  add("one layer, foam", with_foam({128, 0.1}), slice_one(2048));
  add("slices, foam of density 32768", with_foam({8, 0.003, 0, 32768}), slice(1024));
  const auto steep = [](Setup& s) {
    s.fill_cube(steep_foam(s, 4));
    s.add_points(200000);
  };
  add("slices, a coarse cell among the finest", steep, slice(1024));
  add("array, a coarse cell among the finest", steep, ask_membership);
  add("rays, a coarse cell among the finest", steep, cast);
  add("rays, foam", with_points({64, 0.1}, 1000000), cast);
  add("rays, foam, r 1e-4", with_points({64, 1e-4}, 1000000), cast);
  add("rays, foam of density 32768", with_points({8, 0.003, 0, 32768}, 1000000), cast);
  add("picture, foam of density 32768", with_foam({8, 0.003, 0, 32768}), render(1024, 0));
  add("picture with occlusion, foam", with_foam({64, 0.1}), render(1024, 64));
  add(
      "calibration, foam of density 32768",
      [](Setup& s) {
        s.structure = foam(s, {8, 0.003, 0, 32768});
      },
      calibrate);
  add(
      "loading OBJ, 10^6 triangles", [](Setup&) {}, load(MSQ_FORMAT_OBJ));
  add(
      "loading binary STL, 10^6 triangles", [](Setup&) {}, load(MSQ_FORMAT_STL));
  add(
      "distances, 10^6 triangles",
      [](Setup& s) {
        fill_mesh(s, nullptr, {});
        s.add_points(1000000);
      },
      ask_distance);
  add(
      "slices, 10^6 triangles with a skin",
      [](Setup& s) {
        fill_mesh(s, foam(s, {64, 0.1}), {0.01, nullptr});
      },
      slice(1024));
  add(
      "rays, 10^6 triangles",
      [](Setup& s) {
        fill_mesh(s, nullptr, {});
        s.add_points(1000000);
      },
      cast);
  const auto with_lattice = [](uint32_t clusters, bool turned) {
    return [=](Setup& s) {
      s.fill_cube(dense_lattice(s, clusters, turned), 4);
      s.add_points(1000000, 4);
    };
  };
  add("array, lattice of 2048 struts, 64^3 clusters", with_lattice(64, false), ask_membership);
  add("distances, lattice of 2048 struts", with_lattice(0, false), ask_distance);
  add("slices, lattice of 2048 struts", with_lattice(0, false), slice(1024));
  add("slices, the same turned", with_lattice(0, true), slice(1024));
  add("rays, lattice of 2048 struts", with_lattice(0, false), cast);
  add("lineal path, lattice of 2048 struts", with_lattice(0, false), paths);
  static const std::string waves = long_expression();
  const auto with_waves = [](uint32_t clusters) {
    return [=](Setup& s) {
      s.fill_cube(expression(s, waves.c_str(), clusters));
      s.add_points(1000000);
    };
  };
  add("slices, long expression, 64^3 clusters", with_waves(64), slice(1024));
  add("array, long expression", with_waves(0), ask_membership);
  add("distances, long expression", with_waves(0), ask_distance);
  add("rays, long expression", with_waves(0), cast);
  add("volume fraction, long expression", with_waves(0), fraction);
  add("contours, foam", with_foam({256, 0.1}), outline(8192));
  add("contours, long expression", with_waves(0), outline(2048));
  add("preview mesh, foam", with_foam({64, 0.1}), mesh(512));
  add("preview mesh, long expression", with_waves(0), mesh(512));
  add("printability, foam", with_foam({64, 0.1}), examine(1024));
  add("two-point correlation, foam", with_foam({64, 0.1}), correlate);
  add("one layer of 16384^2, foam", with_foam({512, 0.1}), slice_one(16384));
  const auto with_structure = [](FoamOf of) {
    return [=](Setup& s) {
      s.structure = foam(s, of);
      s.add_points(1000000);
    };
  };
  add("fill lines, foam", with_structure({512, 0.1}), fill_lines);
  add(
      "fill lines, long expression",
      [](Setup& s) { s.structure = expression(s, waves.c_str(), 0); }, fill_lines);
  add("struts, foam", with_structure({128, 0.1}), list_struts);
  add("graph of struts, foam", with_structure({96, 0.1}), list_graph);
  add("onsets, foam", with_structure({64, 0.1}), ask_onset);
  add("onsets, foam of density 32768", with_structure({8, 0.003, 0, 32768}), ask_onset);
  const auto with_array = [](Setup& s) { s.add_points(4000000); };
  add("index of 2 * 10^6 beams", with_array, index_beams);
  add("values of a field, 4 * 10^6 points", with_array, evaluate_field);
  add(
      "self-intersections, 10^6 triangles", [](Setup&) {}, intersect_itself);
  for (const Varied& kind : varied_structures) {
    const auto with_kind = [make = kind.make](int cells, size_t points) {
      return [=](Setup& s) {
        s.fill_cube(make(s.context, cells));
        s.add_points(points);
      };
    };
    add(std::string("slices, ") + kind.name, with_kind(48, 0), slice(1024));
    add(std::string("array, ") + kind.name, with_kind(48, 1000000), ask_membership);
    add(std::string("distances, ") + kind.name, with_kind(48, 1000000), ask_distance);
    add(std::string("rays, ") + kind.name, with_kind(48, 1000000), cast);
  }
  return cases;
}

/// What passed between the cancellation and the call's return.
struct Latency {
  double seconds = 0;
  double processor = 0;  ///< of all threads
  double duration = 0;   ///< of the call
  bool was_cancelled = false;
};

/// Cancels `delay` seconds after the call began.
Latency latency(const Case& of, double delay) {
  using Clock = std::chrono::steady_clock;
  const auto since = [](Clock::time_point t) {
    return std::chrono::duration<double>(Clock::now() - t).count();
  };
  Setup setup;
  of.prepare(setup);
  msq_job* job;
  check(msq_job_create(&job));
  std::atomic<bool> ended{false};
  msq_status status = MSQ_OK;
  const Clock::time_point start = Clock::now();
  std::thread caller([&] {
    status = of.call(setup, job);
    ended = true;
  });
  while (!ended && since(start) < delay)
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  const Clock::time_point cancelled = Clock::now();
  const std::clock_t processor = std::clock();
  check(msq_job_cancel(job));
  caller.join();
  Latency found;
  found.processor = static_cast<double>(std::clock() - processor) / CLOCKS_PER_SEC;
  found.seconds = since(cancelled);
  found.duration = since(start);
  found.was_cancelled = status == MSQ_E_CANCELLED;
  msq_job_release(job);
  if (status != MSQ_OK && status != MSQ_E_CANCELLED)
    throw std::runtime_error(of.name + ": " + msq_status_name(status));
  return found;
}

double median(std::vector<double>& values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

}  // namespace

int main(int count, char** arguments) try {
  const int moments = count > 3 ? std::atoi(arguments[3]) : 15;
  Report report("cancelling long calls: milliseconds until they return");
  std::mt19937_64 random(1);
  double most = 0;
  for (const Case& of : all_cases()) {
    if (count > 2 && of.name.find(arguments[2]) == std::string::npos) continue;
    const double whole = std::min(latency(of, longest).duration, longest);
    std::vector<double> passed, processor;
    for (int i = 0; i < moments; ++i) {
      const double within = static_cast<double>(random() >> 11) * 0x1p-53;
      const Latency found = latency(of, whole * (i + within) / moments);
      if (!found.was_cancelled) continue;
      passed.push_back(1e3 * found.seconds);
      processor.push_back(1e3 * found.processor);
    }
    if (passed.empty()) continue;
    const double middle = median(processor), middle_passed = median(passed);
    most = std::max(most, processor.back());
    report.compare(of.name, "ms",
                   {{"processor, median", middle},
                    {"processor, longest", processor.back()},
                    {"passed, median", middle_passed},
                    {"passed, longest", passed.back()},
                    {"of", 1e3 * whole}});
  }
  report.mark("the longest of all, processor time", most, "ms", target, false);
  report.write(count, arguments);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
