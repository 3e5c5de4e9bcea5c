// SPDX-License-Identifier: Apache-2.0
// Selects the segments of a set that may touch a box, and moves them into model space batch by
// batch. Their order is unspecified: it depends on the width of vectors.
#pragma once

#include <array>
#include <vector>

#include "base/vec.h"
#include "strut/segment_set.h"
#include "strut/strut_batch.h"

namespace msq {

/// From a set's coordinates to the model's: origin + matrix (row-major) * p.
struct SegmentFrame {
  Vec3 origin;
  std::array<double, 9> matrix;
};

class SegmentSelection {
 public:
  /// Selects the segments whose bounding box meets `box` (the set's coordinates). Replaces the
  /// earlier selection.
  void select(const SegmentSet& set, const Box3& box);
  size_t count() const { return count_; }
  /// Fills a batch with the segments from number `first` on, as many as fit; does not set its
  /// radii.
  void place(const SegmentFrame& frame, size_t first, StrutBatch& batch) const;

 private:
  size_t count_ = 0;
  std::array<std::vector<float>, 6> components_;
};

}  // namespace msq
