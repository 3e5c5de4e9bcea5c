// SPDX-License-Identifier: Apache-2.0
#include "structure/functional/clusters.h"

#include <algorithm>
#include <cstring>
#include <map>

#include "base/job.h"
#include "structure/functional/row_kernels.h"

namespace msq {

namespace {

constexpr size_t max_tapes = 64;

/// A tape as a key; keys are equal only for equal tapes.
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

Clusters::Clusters(const Tape& tape, int side, Interval levels) {
  tapes_.push_back(tape);
  grids_.push_back({side, {}});
  if (side == 1) return;
  std::vector<Cluster>& clusters = grids_[0].clusters;
  bool has_choices = false;
  for (const Node& node : tape.nodes) has_choices = has_choices || is_choice(node.op);
  std::map<std::vector<uint64_t>, uint16_t> known{{key_of(tape), 0}};
  const auto extent = [side](int i) {
    // Wider than the rounding of number().
    return Interval{angle_of(i == 0 ? 0 : (i - 0x1p-40) / side),
                    angle_of(i == side - 1 ? 1 : (i + 1 + 0x1p-40) / side)};
  };
  std::vector<Enclosure> nodes;
  clusters.reserve(static_cast<size_t>(side) * static_cast<size_t>(side) *
                   static_cast<size_t>(side));
  for (int z = 0; z < side; ++z)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        check_cancelled();
        enclose(tape, {extent(x), extent(y), extent(z)}, nodes);
        const Enclosure onset = nodes.back();
        uint16_t number = 0;
        if (has_choices && onset.high > levels.low && onset.low <= levels.high) {
          Tape shorter = shortened(tape, nodes);
          std::vector<uint64_t> key = key_of(shorter);
          const auto found = known.find(key);
          if (found != known.end()) {
            number = found->second;
          } else if (tapes_.size() < max_tapes) {
            number = static_cast<uint16_t>(tapes_.size());
            known.emplace(std::move(key), number);
            tapes_.push_back(std::move(shorter));
          }
        }
        clusters.push_back({onset, number});
      }
  while (grids_.back().side % 2 == 0 && grids_.back().side > 4)
    grids_.push_back(coarser(grids_.back()));
}

Clusters::Grid Clusters::coarser(const Grid& fine) {
  Grid grid{fine.side / 2, {}};
  grid.clusters.reserve(fine.clusters.size() / 8);
  for (int z = 0; z < grid.side; ++z)
    for (int y = 0; y < grid.side; ++y)
      for (int x = 0; x < grid.side; ++x) {
        Cluster all = fine.at(2 * x, 2 * y, 2 * z);
        for (int i = 1; i < 8; ++i) {
          const Cluster& part = fine.at(2 * x + (i & 1), 2 * y + (i >> 1 & 1), 2 * z + (i >> 2));
          all.onset.low = std::min(all.onset.low, part.onset.low);
          all.onset.high = std::max(all.onset.high, part.onset.high);
          if (part.tape != all.tape) all.tape = 0;
        }
        grid.clusters.push_back(all);
      }
  return grid;
}

const Clusters::Grid* Clusters::at_most(double side) const {
  for (const Grid& grid : grids_)
    if (grid.side > 1 && grid.side <= side) return &grid;
  return nullptr;
}

}  // namespace msq
