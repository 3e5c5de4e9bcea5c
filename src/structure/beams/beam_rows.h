// SPDX-License-Identifier: Apache-2.0
// Draws beams into the rows of a block. The drawing of a beam leaves some samples in doubt. The
// predicate of that beam alone decides them, so that the bits are those of the definition.
#pragma once

#include "base/borrowed.h"
#include "structure/beams/beams.h"
#include "structure/beams/part_batch.h"
#include "strut/span_raster.h"

namespace msq {

class BeamRows {
 public:
  /// `beams` must stay alive.
  BeamRows(const Beams& beams, const RowBlock& block, const Job* job);

  /// True if no sample is alive: nothing to do.
  bool empty() const { return raster_.empty(); }
  /// Finds the beams near the samples. Returns false if there are so many beams, and so few
  /// samples, that single points are faster than drawing.
  bool find();
  /// Call after find(): clears the samples outside all beams.
  void keep();

 private:
  void add(const Beam& beam);
  void draw_capsules();
  void draw_others();

  const Beams& beams_;
  const Job* const job_;
  SpanRaster raster_;
  double margin_;  // of positions
  Box3 reach_;
  struct Run {
    uint32_t begin, end;
  };
  std::vector<Run> found_;  // beams
  struct Batches {
    StrutBatch capsules;
    FrustumBatch frusta;
    BallBatch balls;
  };
  const Borrowed<Batches> batches_;  // 20 KB, too much for the stacks of small threads
  StrutBatch& capsules_;
  FrustumBatch& frusta_;
  BallBatch& balls_;
  double capsule_rounding_ = 0, other_rounding_ = 0;
  std::vector<Beam> of_capsules_, others_;
};

}  // namespace msq
