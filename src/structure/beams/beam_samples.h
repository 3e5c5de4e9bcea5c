// SPDX-License-Identifier: Apache-2.0
// Samples among so many beams that drawing them does not pay. Each sample asks the tree until a
// beam holds it. Where many beams' boxes overlap and few beams hold a sample, that looks at many
// beams for each sample. After a number of looks, boxes of samples are halved instead. Each has the
// beams that may reach it. A box within one beam is done, and so is a box without beams.
#pragma once

#include <vector>

#include "structure/beams/beams.h"

namespace msq {

class BeamSamples {
 public:
  /// `beams` and the block must stay alive.
  BeamSamples(const Beams& beams, const RowBlock& block, const Job* job);

  /// Clears the samples outside all beams.
  void keep();
  /// How many beams were compared with a sample or a box.
  uint64_t looks() const { return looks_; }

 private:
  /// Samples of a part of a word.
  struct Box {
    uint64_t first[3], end[3];  // x, y, z
    uint64_t samples() const {
      return (end[0] - first[0]) * (end[1] - first[1]) * (end[2] - first[2]);
    }
  };

  void keep_tile(const Box& tile);
  /// Keeps the samples of a box, among beams_ from `begin` on, which are all that may reach it.
  void halve(const Box& box, size_t begin);
  /// Appends those of beams [begin, end) of beams_ that may reach a box. True if one contains it.
  bool select(const Box3& box, size_t begin, size_t end);
  template <class Holds>
  void keep_alive(const Box& box, Holds&& holds);
  Box3 bounds(const Box& box) const;
  bool is_in_a_beam(Vec3 p);

  const Beams& structure_;
  const RowBlock& block_;
  const Job* const job_;
  uint64_t looks_ = 0;
  std::vector<uint32_t> beams_;  // of the boxes that are being halved, the largest first
};

}  // namespace msq
