// SPDX-License-Identifier: Apache-2.0
// Contours of a layer: the section of a model with a plane as rings of points.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/job.h"
#include "base/ref.h"
#include "model/model.h"
#include "slice/contour_grid.h"

namespace msq {

enum class ContourFormat : int32_t { int32 = 1, int64 = 2, float64 = 3 };

/// See msq_contours_def.
struct ContourPlan {
  LayerPlane plane;
  bool has_window = false;
  double window_min[2] = {0, 0}, window_max[2] = {0, 0};
  double tolerance = 0;
  double pitch = 0;  ///< 0: the tolerance
  ContourFormat format = ContourFormat::float64;
  double units = 1;
  double length_scale = 0;
  uint32_t topology_samples = 0;  ///< 0, 2, 4, 8 or 16
};

/// Coordinates of points; of one of the types.
struct ContourNumbers {
  std::vector<int32_t> int32;
  std::vector<int64_t> int64;
  std::vector<double> float64;
  size_t bytes() const {
    return int32.capacity() * sizeof(int32_t) + int64.capacity() * sizeof(int64_t) +
           float64.capacity() * sizeof(double);
  }
};

class Contours final : public RefCounted {
 public:
  Contours(ContourFormat format, uint32_t topology_samples)
      : format_(format), topology_samples_(topology_samples) {}

  ContourFormat format() const { return format_; }
  uint64_t point_count() const { return starts_.back(); }
  uint64_t ring_count() const { return starts_.size() - 1; }
  /// Two coordinates for each point, of the format.
  const void* points() const;
  const uint64_t* starts() const { return starts_.data(); }
  const int64_t* parents() const { return parents_.data(); }
  const uint8_t* holes() const { return holes_.data(); }
  uint64_t unresolved() const { return unresolved_; }
  void set_unresolved(uint64_t count) { unresolved_ = count; }
  /// See msq_contours_report.
  uint64_t topology() const { return topology_; }
  uint32_t topology_samples() const { return topology_samples_; }
  void set_topology(uint64_t count) { topology_ = count; }
  double pitch() const { return pitch_; }
  void set_pitch(double pitch) { pitch_ = pitch; }

  /// Adds a ring of points in units; false if fewer than three remain when they are rounded.
  bool add_ring(std::span<const Vec2> ring, int64_t parent, bool is_hole);
  /// From now on, points are written into `room`, whose memory is warm.
  void begin(ContourNumbers& room);
  /// Copies the points into memory of their own and gives `room` back.
  void close(ContourNumbers& room);

 private:
  ContourFormat format_;
  uint32_t topology_samples_;
  std::vector<uint64_t> starts_{0};
  std::vector<int64_t> parents_;
  std::vector<uint8_t> holes_;
  ContourNumbers numbers_;
  uint64_t unresolved_ = 0, topology_ = 0;
  double pitch_ = 0;
};

/// Throws Error(argument) for a window or units that make no sense, Error(limit) where numbers do
/// not hold the coordinates.
Ref<Contours> layer_contours(const Model& model, const ContourPlan& plan, Job* job);

}  // namespace msq
