// SPDX-License-Identifier: Apache-2.0
#include "structure/functional/clusters.h"

#include <cstring>
#include <limits>
#include <map>

namespace msq {

namespace {

constexpr size_t most_tapes = 64;

/// A tape as a key: equal only for equal tapes.
std::vector<uint64_t> key_of(const Tape& tape) {
  std::vector<uint64_t> key;
  for (const Node& node : tape.nodes) {
    uint64_t value;
    std::memcpy(&value, &node.value, sizeof value);
    key.push_back(static_cast<uint64_t>(node.op) << 56 | uint64_t{node.a} << 24 | node.b);
    key.push_back(value);
  }
  return key;
}

}  // namespace

Clusters::Clusters(const Tape& tape, int side, Interval levels) : side_(side) {
  tapes_.push_back(tape);
  if (side == 1) {  // none: nothing is known
    const double all = std::numeric_limits<double>::infinity();
    clusters_.push_back({{-all, all}, 0});
    return;
  }
  bool has_choices = false;
  for (const Node& node : tape.nodes)
    has_choices =
        has_choices || node.op == Op::minimum || node.op == Op::maximum || node.op == Op::absolute;
  std::map<std::vector<uint64_t>, uint16_t> known{{key_of(tape), 0}};
  const auto extent = [side](int i) {
    // Wider than the rounding of number().
    return Interval{angle_of(i == 0 ? 0 : (i - 0x1p-40) / side),
                    angle_of(i == side - 1 ? 1 : (i + 1 + 0x1p-40) / side)};
  };
  std::vector<Enclosure> nodes;
  clusters_.reserve(static_cast<size_t>(side) * static_cast<size_t>(side) *
                    static_cast<size_t>(side));
  for (int z = 0; z < side; ++z)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        enclose(tape, {extent(x), extent(y), extent(z)}, nodes);
        const Enclosure onset = nodes.back();
        uint16_t number = 0;
        if (has_choices && onset.high > levels.low && onset.low <= levels.high) {
          Tape shorter = shortened(tape, nodes);
          std::vector<uint64_t> key = key_of(shorter);
          const auto found = known.find(key);
          if (found != known.end()) {
            number = found->second;
          } else if (tapes_.size() < most_tapes) {
            number = static_cast<uint16_t>(tapes_.size());
            known.emplace(std::move(key), number);
            tapes_.push_back(std::move(shorter));
          }
        }
        clusters_.push_back({onset, number});
      }
}

}  // namespace msq
