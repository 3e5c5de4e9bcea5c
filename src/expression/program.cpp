// SPDX-License-Identifier: Apache-2.0
#include "expression/program.h"

#include <algorithm>

namespace msq {

Program compile(const std::vector<Node>& nodes, const std::vector<uint32_t>& inputs,
                const std::vector<uint32_t>& outputs) {
  constexpr uint16_t none = UINT16_MAX;
  constexpr size_t never = SIZE_MAX;
  Program program;
  program.inputs = inputs.size();
  std::vector<uint16_t> home(nodes.size(), none);  // register of each node
  for (size_t i = 0; i < inputs.size(); ++i)
    if (inputs[i] < nodes.size()) home[inputs[i]] = static_cast<uint16_t>(i);

  std::vector<bool> is_needed(nodes.size());
  std::vector<size_t> last_use(nodes.size(), 0);
  for (uint32_t o : outputs) {
    is_needed[o] = true;
    last_use[o] = never;
  }
  for (size_t i = nodes.size(); i-- > 0;) {
    if (!is_needed[i] || home[i] != none || nodes[i].op < Op::add) continue;
    const uint32_t a = nodes[i].a, b = has_two_operands(nodes[i].op) ? nodes[i].b : a;
    for (uint32_t operand : {a, b}) {
      is_needed[operand] = true;
      last_use[operand] = std::max(last_use[operand], i);
    }
  }
  for (size_t i = 0; i < nodes.size(); ++i)
    if (is_needed[i] && home[i] == none && nodes[i].op == Op::constant) {
      home[i] = static_cast<uint16_t>(program.inputs + program.constants.size());
      program.constants.push_back(nodes[i].value);
    }

  const size_t first = program.inputs + program.constants.size();
  std::vector<uint16_t> free;
  for (size_t i = 0; i < nodes.size(); ++i) {
    if (!is_needed[i] || home[i] != none) continue;
    const uint32_t a = nodes[i].a, b = has_two_operands(nodes[i].op) ? nodes[i].b : a;
    // An operand's register may take the result: lanes are read before they are written.
    for (uint32_t operand : {a, b}) {
      if (last_use[operand] != i || home[operand] < first) continue;
      free.push_back(home[operand]);
      last_use[operand] = never;  // once, also where both operands are the same
    }
    if (free.empty()) free.push_back(static_cast<uint16_t>(first + program.temporaries++));
    home[i] = free.back();
    free.pop_back();
    program.code.push_back({nodes[i].op, home[i], home[a], home[b]});
  }
  for (uint32_t o : outputs) program.outputs.push_back(home[o]);
  return program;
}

Program compile(const Tape& tape) {
  std::vector<uint32_t> inputs(3, UINT32_MAX);
  for (uint32_t i = 0; i < tape.nodes.size(); ++i)
    if (tape.nodes[i].op >= Op::x && tape.nodes[i].op <= Op::z)
      inputs[static_cast<size_t>(tape.nodes[i].op) - static_cast<size_t>(Op::x)] = i;
  return compile(tape.nodes, inputs, {static_cast<uint32_t>(tape.nodes.size() - 1)});
}

}  // namespace msq
