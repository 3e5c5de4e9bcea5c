// SPDX-License-Identifier: Apache-2.0
// Lists of beams for tests.
#pragma once

#include <vector>

#include "structure/beams/beam_list.h"

namespace msq::test {

/// The list must stay alive.
inline BeamSource source_of(const std::vector<Beam>& beams) {
  return {beams.size(), [&beams](uint64_t i, Beam& beam) {
            beam = beams[i];
            return beam.is_solid();
          }};
}

}  // namespace msq::test
