// SPDX-License-Identifier: Apache-2.0
// What is doubtful about printing the layers of a slicer: islands, loose parts, enclosed voids,
// thin places, cups, overhangs. docs/concepts.md defines them.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/job.h"
#include "slice/slicer.h"

namespace msq {

enum class FindingKind : int32_t {
  island = 1,
  loose = 2,
  enclosed_void = 4,
  thin = 8,
  cup = 16,
  overhang = 32
};
constexpr size_t finding_kinds = 6;
constexpr uint32_t all_finding_kinds = (1u << finding_kinds) - 1;

/// See msq_printability_def.
struct PrintabilityPlan {
  uint32_t kinds = 7;  ///< a sum of FindingKind
  bool has_plate = true;
  double width = 0;  ///< of thin places
  double min_volume = 0;
  double overhang = 0;  ///< horizontal distance from the solid below
};

/// As msq_finding.
struct Finding {
  FindingKind kind;
  uint32_t reserved;
  uint64_t first_layer, last_layer;
  uint64_t sample_count;
  double volume;
  Vec3 point;
  Vec3 min, max;
};

struct PrintabilityCounts {
  uint64_t layers = 0;
  uint64_t solid_samples = 0;
  double solid_volume = 0;
  /// By kind.
  uint64_t counts[finding_kinds] = {};
  double volumes[finding_kinds] = {};
};

/// Calls take(findings, count) on this thread after layers that end findings, and at the end.
PrintabilityCounts find_doubtful(const Slicer& slicer, const PrintabilityPlan& plan,
                                 const std::function<void(const Finding*, size_t)>& take, Job* job);

}  // namespace msq
