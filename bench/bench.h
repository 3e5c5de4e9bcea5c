// SPDX-License-Identifier: Apache-2.0
// What the benchmarks share: medians of repeated runs, a table on standard output, JSON beside it.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "msq.h"

namespace bench {

inline void check(msq_status status) {
  if (status != MSQ_OK) throw std::runtime_error(msq_error_message());
}

inline double seconds_of(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Median of at least three runs that take about `most` seconds together; of one where one takes
/// more.
inline double median_seconds(const std::function<void()>& work, double most = 3) {
  std::vector<double> times{seconds_of(work)};
  while (times[0] < most && (times.size() < 3 || times.size() * times[0] < most) &&
         times.size() < 15)
    times.push_back(seconds_of(work));
  std::nth_element(times.begin(), times.begin() + times.size() / 2, times.end());
  return times[times.size() / 2];
}

/// Processor time of all threads. On a loaded machine it varies less than elapsed time.
inline double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

inline double processor_seconds_of(const std::function<void()>& work) {
  const double start = processor_seconds();
  work();
  return processor_seconds() - start;
}

/// Minimum of up to five runs that take about half a second together.
inline double min_processor_seconds(const std::function<void()>& work) {
  double least = 1e300, total = 0;
  for (int run = 0; run < 5 && (run == 0 || total < 0.5); ++run) {
    const double seconds = processor_seconds_of(work);
    least = std::min(least, seconds);
    total += seconds;
  }
  return least;
}

/// Rows of a table; written as JSON to the file of the program's first argument, if it has one.
class Report {
 public:
  explicit Report(const std::string& title) {
    json_["title"] = title;
    json_["rows"] = nlohmann::json::array();
    std::printf("%s\n%-64s %12s %14s\n", title.c_str(), "work", "seconds", "per unit");
  }
  /// `units`: what the time is divided by in the last column, named by `unit`.
  void add(const std::string& work, double seconds, double units, const std::string& unit) {
    std::printf("%-64s %12.4f %11.2f ns / %s\n", work.c_str(), seconds, seconds / units * 1e9,
                unit.c_str());
    std::fflush(stdout);
    json_["rows"].push_back({{"work", work},
                             {"seconds", seconds},
                             {"ns_per_unit", seconds / units * 1e9},
                             {"unit", unit}});
  }
  void note(const std::string& what, double value, const std::string& unit) {
    std::printf("%-64s %12.4g %s\n", what.c_str(), value, unit.c_str());
    std::fflush(stdout);
    json_["notes"].push_back({{"what", what}, {"value", value}, {"unit", unit}});
  }
  /// A note that an issue of the project sets a mark for.
  void mark(const std::string& what, double value, const std::string& unit, double target,
            bool at_least) {
    const bool is_met = at_least ? value >= target : value <= target;
    std::printf("%-64s %12.4g %s (to reach: %s %g: %s)\n", what.c_str(), value, unit.c_str(),
                at_least ? "at least" : "at most", target, is_met ? "met" : "not met");
    std::fflush(stdout);
    json_["marks"].push_back({{"what", what},
                              {"value", value},
                              {"unit", unit},
                              {"target", target},
                              {"at_least", at_least},
                              {"met", is_met}});
  }
  /// Numbers of the same thing side by side, by name.
  void compare(const std::string& what, const std::string& where,
               const std::map<std::string, double>& values) {
    std::printf("%-40s %-14s", what.c_str(), where.c_str());
    for (const auto& [name, value] : values) std::printf("  %s %5.1f", name.c_str(), value);
    std::printf("\n");
    std::fflush(stdout);
    json_["comparisons"].push_back({{"what", what}, {"where", where}, {"values", values}});
  }
  void write(int count, char** arguments) const {
    if (count > 1) std::ofstream(arguments[1]) << json_.dump(2) << '\n';
  }

 private:
  nlohmann::json json_;
};

/// Reads each word of a layer once, as a host would.
struct Reader {
  uint64_t inside = 0, sum = 0;
  static int32_t take(void* user, const msq_layer* layer) {
    auto& reader = *static_cast<Reader*>(user);
    reader.inside += layer->inside_count;
    const auto* words = reinterpret_cast<const uint64_t*>(layer->data);
    const size_t count = layer->stride / 8 * layer->height;
    uint64_t sum = 0;
    for (size_t i = 0; i < count; ++i) sum += words[i];
    reader.sum += sum;
    return 0;
  }
};

}  // namespace bench
