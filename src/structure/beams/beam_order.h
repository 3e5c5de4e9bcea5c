// SPDX-License-Identifier: Apache-2.0
// An order of beams in which neighbours lie close together and have similar sizes: by size, in
// powers of 4, and then along Hilbert's curve. If many beams fall into one cell of the curve, a
// finer curve orders them. A beam that equals another, bit for bit, is no part of the order, so
// that no query looks at it. Source: Kamel and Faloutsos, "On packing R-trees", 1993.
#pragma once

#include <cstdint>
#include <vector>

#include "base/interval.h"
#include "base/job.h"
#include "base/parallel.h"
#include "structure/beams/beam_list.h"

namespace msq {

/// The beams that are not left out.
struct BeamOrder {
  std::vector<uint32_t> numbers;    ///< of the source; no two beams are equal
  std::vector<BeamRepeat> repeats;  ///< in the order of their places
  Box3 box;                         ///< around all beams
  double longest = 0;               ///< maximum of axis lengths and diameters

  /// Bytes needed while that many beams are ordered, including the result.
  static uint64_t bytes(uint64_t count) {
    return count * (2 * sizeof(uint64_t) + sizeof(uint32_t));
  }
};

BeamOrder order_beams(const BeamSource& source, const Executor& executor, Job* job,
                      Interval progress);

}  // namespace msq
