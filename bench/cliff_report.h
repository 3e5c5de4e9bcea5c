// SPDX-License-Identifier: Apache-2.0
// Cases beside a plain case of the same work: their ratios, and the worst of them.
#pragma once

#include <string>
#include <vector>

#include "bench.h"

namespace bench {

class CliffReport {
 public:
  /// `wanted`: only sweeps whose names contain it are measured.
  CliffReport(double max_ratio, std::string wanted)
      : max_ratio_(max_ratio), wanted_(std::move(wanted)) {
    json_["title"] = "cases beside the plain case, processor seconds";
    json_["rows"] = nlohmann::json::array();
    std::printf("%-44s %-30s %10s %8s\n", "sweep", "case", "seconds", "ratio");
  }

  bool wants(const std::string& sweep) const { return sweep.find(wanted_) != std::string::npos; }

  /// A case of a sweep that would take `plain` seconds if it were as fast as the plain case.
  void add(const std::string& sweep, const std::string& name, double seconds, double plain) {
    const double ratio = seconds / plain;
    std::printf("%-44s %-30s %10.4f %8.2f%s\n", sweep.c_str(), name.c_str(), seconds, ratio,
                ratio > max_ratio_ ? "  !" : "");
    std::fflush(stdout);
    json_["rows"].push_back(
        {{"sweep", sweep}, {"case", name}, {"seconds", seconds}, {"ratio", ratio}});
    cases_.push_back({ratio, sweep + ": " + name});
  }

  /// A time without a plain case.
  void note(const std::string& what, double seconds) {
    std::printf("%-75s %10.4f\n", what.c_str(), seconds);
    std::fflush(stdout);
    json_["notes"].push_back({{"what", what}, {"seconds", seconds}});
  }

  /// Prints the cases above the maximum ratio, the worst first, and writes JSON.
  void finish(const char* file) {
    std::sort(cases_.begin(), cases_.end(),
              [](const Case& a, const Case& b) { return a.ratio > b.ratio; });
    std::printf("\nabove %g times the plain case, worst first:\n", max_ratio_);
    for (const Case& one : cases_)
      if (one.ratio > max_ratio_) std::printf("%8.2f  %s\n", one.ratio, one.name.c_str());
    if (!cases_.empty())
      json_["worst"] = {{"case", cases_.front().name}, {"ratio", cases_.front().ratio}};
    if (file) std::ofstream(file) << json_.dump(2) << '\n';
  }

 private:
  struct Case {
    double ratio;
    std::string name;
  };
  const double max_ratio_;
  const std::string wanted_;
  std::vector<Case> cases_;
  nlohmann::json json_;
};

}  // namespace bench
