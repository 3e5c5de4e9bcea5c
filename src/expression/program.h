// SPDX-License-Identifier: Apache-2.0
// Part of a tape, prepared for evaluation at many points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "expression/tape.h"

namespace msq {

/// Operations on registers: first the inputs, then the constants, then the temporaries. A
/// temporary's register is reused once its value is no longer needed.
struct Program {
  struct Instruction {
    Op op;
    uint16_t to, a, b;
  };
  size_t inputs = 0, temporaries = 0;
  std::vector<double> constants;
  std::vector<Instruction> code;
  std::vector<uint16_t> outputs;  ///< registers that hold the results at the end

  size_t registers() const { return inputs + constants.size() + temporaries; }
};

/// The program that computes the nodes `outputs` from the nodes `inputs`. An input's own operands
/// are ignored. The outputs must not depend on coordinates that are not inputs.
Program compile(const std::vector<Node>& nodes, const std::vector<uint32_t>& inputs,
                const std::vector<uint32_t>& outputs);

/// The program of a whole tape; its inputs are the three coordinates.
Program compile(const Tape& tape);

}  // namespace msq
