// SPDX-License-Identifier: Apache-2.0
// Part of a tape, made ready to be evaluated for many points at once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "expression/tape.h"

namespace msq {

/// Operations on registers: first the inputs, then the constants, then temporaries, which are used
/// again once their values are no longer needed.
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

/// The program that computes the nodes `outputs` from the nodes `inputs`, which stand for
/// themselves whatever they are made of. Nothing is made of coordinates that are not inputs.
Program compile(const std::vector<Node>& nodes, const std::vector<uint32_t>& inputs,
                const std::vector<uint32_t>& outputs);

/// The program of a whole tape; its inputs are the three coordinates.
Program compile(const Tape& tape);

}  // namespace msq
