// SPDX-License-Identifier: Apache-2.0
// A tree of boxes around consecutive beams, with eight children per node and four beams per leaf.
// So neither depth nor memory depends on where the beams lie. Source: Kamel and Faloutsos, "On
// packing R-trees", 1993.
//
// Boxes are stored in single precision, in a frame in which all beams lie between -1 and 1. The map
// to the frame rounds but is monotone: points within limits, or beyond them, stay so.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/interval.h"
#include "base/job.h"
#include "base/parallel.h"
#include "base/ray.h"
#include "structure/beams/beam_list.h"

namespace msq {

class BeamTree {
 public:
  /// `box`: around all beams.
  BeamTree(const BeamList& beams, const Box3& box, const Executor& executor, Job* job,
           Interval progress);
  static uint64_t bytes(uint64_t beams);

  const Box3& box() const { return box_; }

  /// Calls visit(begin, end) for ranges of beams, until visit returns false. The ranges include all
  /// beams whose box overlaps `box`. Returns false if visit did.
  template <class Visit>
  bool find_overlapping(const Box3& box, Visit&& visit) const;

  /// The same for beams within a distance of p. visit(begin, end) returns the distance for the rest
  /// of the search; it is `within` at first.
  template <class Visit>
  void find_near(Vec3 p, double within, Visit&& visit) const;

  /// The same for beams that a ray may meet in [from, to], roughly in the order along the ray.
  /// visit(begin, end) returns the end of the search range from then on.
  template <class Visit>
  void find_along(const Ray& ray, double from, double to, Visit&& visit) const;

 private:
  static constexpr size_t wide = 8, leaf = 4;
  /// Exceeds the errors of positions in the frame, in single precision.
  static constexpr float slack = 0x1p-20f;

  struct Node {
    float low[3][wide], high[3][wide];  // boxes of children; missing children have empty boxes
  };
  struct Level {
    size_t first, count;  // of nodes
  };
  struct Place {
    uint32_t level;
    uint32_t node;  // in the level
    float key;
  };
  static constexpr size_t max_places = 12 * wide;  // on a path to a leaf

  float to_frame(double x, int axis) const {
    return static_cast<float>(std::clamp((x - middle_[axis]) * scale_, -4.0, 4.0));
  }
  const Node& node(const Place& place) const {
    return nodes_[levels_[place.level].first + place.node];
  }
  size_t beam_of(size_t child) const { return std::min(leaf * child, count_); }
  static uint32_t children_in(const Node& node, const float (&low)[3], const float (&high)[3]) {
    uint32_t in[wide], found = 0;
    for (size_t c = 0; c < wide; ++c)
      in[c] = (node.low[0][c] <= high[0]) & (node.high[0][c] >= low[0]) &
              (node.low[1][c] <= high[1]) & (node.high[1][c] >= low[1]) &
              (node.low[2][c] <= high[2]) & (node.high[2][c] >= low[2]);
    for (size_t c = 0; c < wide; ++c) found |= in[c] << c;
    return found;
  }

  size_t count_;
  Box3 box_;
  Vec3 middle_;
  double scale_;
  std::vector<Node> nodes_;
  std::vector<Level> levels_;  // the lowest level first
};

template <class Visit>
bool BeamTree::find_overlapping(const Box3& box, Visit&& visit) const {
  if (!box.overlaps(box_)) return true;
  float low[3], high[3];
  for (int axis = 0; axis < 3; ++axis) {
    low[axis] = to_frame(box.min[axis], axis);
    high[axis] = to_frame(box.max[axis], axis);
  }
  Place places[max_places];
  size_t count = 0;
  places[count++] = {static_cast<uint32_t>(levels_.size() - 1), 0, 0};
  while (count > 0) {
    const Place place = places[--count];
    for (uint32_t rest = children_in(node(place), low, high); rest;) {
      // Visits leaves in the beams' order.
      const auto child = place.level > 0 ? static_cast<uint32_t>(std::bit_width(rest)) - 1
                                         : static_cast<uint32_t>(std::countr_zero(rest));
      rest &= ~(uint32_t{1} << child);
      const uint32_t number = place.node * wide + child;
      if (place.level > 0)
        places[count++] = {place.level - 1, number, 0};
      else if (!visit(beam_of(number), beam_of(number + 1)))
        return false;
    }
  }
  return true;
}

template <class Visit>
void BeamTree::find_near(Vec3 p, double within, Visit&& visit) const {
  float at[3];
  double gap[3];  // distance beyond the frame, which single precision does not hold
  for (int axis = 0; axis < 3; ++axis) {
    const double x = (p[axis] - middle_[axis]) * scale_, inside = std::clamp(x, -1.0, 1.0);
    gap[axis] = std::abs(x - inside);
    at[axis] = static_cast<float>(inside);
  }
  // Distances, in the frame, from p to points in it: along each axis, the gap and the distance from
  // the nearest point of the frame add up.
  const double beyond2 = gap[0] * gap[0] + gap[1] * gap[1] + gap[2] * gap[2];
  const double per_unit = scale_ * (1 + 1e-6);
  const auto is_near = [&](float squared) {
    const double inside = std::max(0.0, std::sqrt(double{squared}) - slack);
    return std::sqrt(inside * inside + beyond2) * (1 - 1e-6) <= within * per_unit;
  };
  Place places[max_places];
  size_t count = 0;
  places[count++] = {static_cast<uint32_t>(levels_.size() - 1), 0, 0};
  while (count > 0) {
    const Place place = places[--count];
    if (!is_near(place.key)) continue;
    const Node& n = node(place);
    float squared[wide];
    for (size_t c = 0; c < wide; ++c) {
      float sum = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const float away =
            std::max(std::max(n.low[axis][c] - at[axis], at[axis] - n.high[axis][c]), 0.0f);
        sum += away * away;
      }
      squared[c] = sum;
    }
    // The nearest is taken first.
    Place near[wide];
    size_t found = 0;
    for (uint32_t c = 0; c < wide; ++c) {
      if (!(squared[c] < 1e30f) || !is_near(squared[c])) continue;
      size_t to = found++;
      for (; to > 0 && near[to - 1].key < squared[c]; --to) near[to] = near[to - 1];
      near[to] = {place.level - 1, static_cast<uint32_t>(place.node * wide + c), squared[c]};
    }
    if (place.level > 0) {
      std::copy_n(near, found, places + count);
      count += found;
      continue;
    }
    while (found-- > 0)
      if (is_near(near[found].key))
        within = visit(beam_of(near[found].node), beam_of(near[found].node + 1));
  }
}

template <class Visit>
void BeamTree::find_along(const Ray& ray, double from, double to, Visit&& visit) const {
  // Begins where the ray comes near the beams, so that its numbers are of the order of 1. The
  // frame's lengths are those of the ray times the scale.
  const Box3 around = box_.grown(max_component(box_.extent()) * 0x1p-20);
  if (!clip_to_box(ray, around, from, to)) return;
  const Vec3 start = ray.at(from);
  float origin[3], inverse[3];
  for (int axis = 0; axis < 3; ++axis) {
    const double d = ray.direction[axis];
    origin[axis] = to_frame(start[axis], axis);
    // If the ray is parallel to a face, the limits are far away, before and behind.
    inverse[axis] = static_cast<float>(1 / (std::abs(d) < 1e-18 ? std::copysign(1e-18, d) : d));
  }
  // Points of the ray are rounded, too.
  const double rounded =
      0x1p-50 * (max_magnitude(ray.origin) + std::abs(from) + max_magnitude(start));
  const float margin = slack + static_cast<float>(std::min(1.0, rounded * scale_));
  const auto limit = [&] { return static_cast<float>((to - from) * scale_ * (1 + 1e-6)) + margin; };
  float last = limit();
  Place places[max_places];
  size_t count = 0;
  places[count++] = {static_cast<uint32_t>(levels_.size() - 1), 0, 0};
  while (count > 0) {
    const Place place = places[--count];
    if (place.key > last) continue;
    const Node& n = node(place);
    float near[wide], far[wide];
    for (size_t c = 0; c < wide; ++c) {
      near[c] = 0;
      far[c] = last;
      for (int axis = 0; axis < 3; ++axis) {
        const float a = (n.low[axis][c] - margin - origin[axis]) * inverse[axis];
        const float b = (n.high[axis][c] + margin - origin[axis]) * inverse[axis];
        near[c] = std::max(near[c], std::min(a, b));
        far[c] = std::min(far[c], std::max(a, b));
      }
    }
    Place met[wide];
    size_t found = 0;
    for (uint32_t c = 0; c < wide; ++c) {
      // Widened by the rounding of both, which is relative.
      if (!(near[c] * (1 - 1e-5f) <= far[c] * (1 + 1e-5f)) || !(n.low[0][c] < 4)) continue;
      size_t at = found++;
      for (; at > 0 && met[at - 1].key < near[c]; --at) met[at] = met[at - 1];
      met[at] = {place.level - 1, static_cast<uint32_t>(place.node * wide + c), near[c]};
    }
    if (place.level > 0) {
      std::copy_n(met, found, places + count);
      count += found;
      continue;
    }
    while (found-- > 0) {
      if (met[found].key > last) continue;
      to = visit(beam_of(met[found].node), beam_of(met[found].node + 1));
      last = std::min(last, limit());
    }
  }
}

}  // namespace msq
