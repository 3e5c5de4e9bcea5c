// SPDX-License-Identifier: Apache-2.0
// Evaluates the samples of rows by a structure's points, in batches of neighbours. If the structure
// has coverage of boxes, it first evaluates boxes of samples, which it bisects until they are
// decided or small.
#pragma once

#include <vector>

#include "structure/structure.h"

namespace msq {

class SampledRows {
 public:
  SampledRows(const Structure& structure, const RowBlock& block, const Job* job)
      : structure_(structure), block_(block), job_(job) {}

  void keep();

 private:
  /// Words [w0, w1) of rows [y0, y1) of layers [z0, z1).
  struct Region {
    uint64_t w0, w1, y0, y1, z0, z1;
  };
  struct Sample {
    uint64_t* word;
    unsigned bit;
  };
  /// A part of a word in a few rows.
  struct Patch {
    uint64_t w, y0, y1, z0, z1;
    unsigned first_bit;
    uint64_t mask;
  };

  void halve(const Region& region);
  void keep_tile(const Region& tile);
  /// Returns true if the patch is decided as a whole, or empty.
  bool keep_patch(const Patch& patch);
  void collect(const Patch& patch);
  void ask();
  BoxClass classify(uint64_t first, uint64_t last, uint64_t y0, uint64_t y1, uint64_t z0,
                    uint64_t z1) const;

  const Structure& structure_;
  const RowBlock& block_;
  const Job* job_;
  std::vector<Vec3> points_;
  std::vector<Sample> samples_;
  std::vector<uint8_t> alive_;
};

}  // namespace msq
