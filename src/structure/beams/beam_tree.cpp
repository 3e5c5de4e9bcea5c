// SPDX-License-Identifier: Apache-2.0
#include "structure/beams/beam_tree.h"

#include <limits>

#include "base/run_parts.h"

namespace msq {

namespace {

uint64_t rounded_up(uint64_t count, uint64_t to) {
  return (count + to - 1) / to;
}

}  // namespace

uint64_t BeamTree::bytes(uint64_t beams) {
  uint64_t nodes = 0;
  for (uint64_t count = rounded_up(beams, leaf); nodes == 0 || count > 1;) {
    count = rounded_up(count, wide);
    nodes += count;
  }
  return nodes * sizeof(Node);
}

BeamTree::BeamTree(const BeamList& beams, const Box3& box, const Executor& executor, Job* job,
                   Interval progress)
    : count_(beams.size()), box_(box) {
  middle_ = box.min + (box.max - box.min) * 0.5;
  scale_ = 2 / max_component(box.extent());
  uint64_t count = rounded_up(count_, leaf);
  size_t all = 0;
  do {
    count = rounded_up(count, wide);
    levels_.push_back({all, count});
    all += count;
  } while (count > 1);
  nodes_.resize(all);

  constexpr float nowhere = std::numeric_limits<float>::infinity();
  // Sets the box of child c; join(axis, low, high) extends it.
  const auto set = [](Node& node, size_t c, auto&& join) {
    for (int axis = 0; axis < 3; ++axis) {
      float low = nowhere, high = -nowhere;
      join(axis, low, high);
      node.low[axis][c] = low;
      node.high[axis][c] = high;
    }
  };
  constexpr uint64_t at_once = 256;  // nodes
  for (size_t l = 0; l < levels_.size(); ++l) {
    const Level level = levels_[l];
    const Interval part = l == 0 ? progress : Interval{progress.high, progress.high};
    run_parts(executor, rounded_up(level.count, at_once), job, part, [&](uint64_t n) {
      for (size_t i = n * at_once, end = std::min(level.count, i + at_once); i < end; ++i) {
        Node& made = nodes_[level.first + i];
        for (size_t c = 0; c < wide; ++c) {
          const size_t child = i * wide + c;
          if (l > 0) {
            const bool is_there = child < levels_[l - 1].count;
            const Node& below = nodes_[levels_[l - 1].first + (is_there ? child : 0)];
            set(made, c, [&](int axis, float& low, float& high) {
              for (size_t k = 0; k < wide && is_there; ++k) {
                low = std::min(low, below.low[axis][k]);
                high = std::max(high, below.high[axis][k]);
              }
            });
            continue;
          }
          Box3 boxes[leaf];
          const size_t first = beam_of(child), last = beam_of(child + 1);
          for (size_t b = first; b < last; ++b) boxes[b - first] = beams.at(b).box();
          set(made, c, [&](int axis, float& low, float& high) {
            for (size_t b = 0; b < last - first; ++b) {
              low = std::min(low, to_frame(boxes[b].min[axis], axis));
              high = std::max(high, to_frame(boxes[b].max[axis], axis));
            }
          });
        }
      }
    });
  }
}

}  // namespace msq
