// SPDX-License-Identifier: Apache-2.0
// Contours on their way to a file.
#pragma once

#include "pipeline.h"

namespace msq_io {

/// Keeps the contours of an output in the packet. Fails if the output is of another kind.
void take_contours(const msq_output& output, Packet& packet);

/// The rings of contours, with coordinates of any type.
class Rings {
 public:
  /// units: what coordinates are divided by. The contours must outlive it.
  Rings(const msq_contours* contours, double units);

  uint64_t count() const { return report_.ring_count; }
  uint64_t point_count() const { return report_.point_count; }
  bool is_hole(uint64_t ring) const { return report_.holes[ring] != 0; }
  /// Points of a ring: from begin(ring) to begin(ring + 1) - 1.
  uint64_t begin(uint64_t ring) const { return report_.starts[ring]; }
  /// Coordinate u (0) or v (1) of a point.
  double at(uint64_t point, int axis) const;

 private:
  msq_contours_report report_{};
  double units_;
};

}  // namespace msq_io
