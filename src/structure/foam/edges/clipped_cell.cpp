// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/edges/clipped_cell.h"

#include <algorithm>
#include <cmath>

namespace msq {

void ClippedCell::start(double half_width) {
  planes_.clear();
  vertices_.clear();
  cuts_ = 0;
  made_ = 0;
  is_empty_ = false;
  // Plane 2 axis is low, 2 axis + 1 high.
  for (int axis = 0; axis < 3; ++axis)
    for (double sign : {-1.0, 1.0}) {
      Vec3 normal;
      normal[axis] = sign;
      planes_.push_back({normal, half_width, 0, 0});
    }
  // Vertex number: high in x, y, z as bits. Seen from outside, x, y, z turn counter-clockwise about
  // corners with an odd number of highs.
  for (uint32_t v = 0; v < 8; ++v) {
    const uint32_t x = v & 1, y = 2 + (v >> 1 & 1), z = 4 + (v >> 2);
    Vertex vertex{};
    vertex.is_there = true;
    if ((x + y + z) % 2)
      vertex = {{x, y, z}, {v ^ 4, v ^ 1, v ^ 2}, {}, true};
    else
      vertex = {{x, z, y}, {v ^ 2, v ^ 1, v ^ 4}, {}, true};
    place(vertex);
    vertices_.push_back(vertex);
  }
}

void ClippedCell::place(Vertex& vertex) const {
  const Plane &p = planes_[vertex.plane[0]], &q = planes_[vertex.plane[1]],
              &r = planes_[vertex.plane[2]];
  const Vec3 qr = cross(q.normal, r.normal), rp = cross(r.normal, p.normal),
             pq = cross(p.normal, q.normal);
  vertex.position = (qr * p.offset + rp * q.offset + pq * r.offset) * (1 / dot(p.normal, qr));
}

bool ClippedCell::cut(Vec3 neighbour, double offset) {
  removed_.clear();
  made_ = vertices_.size();
  size_t left = 0;
  for (uint32_t v = 0; v < vertices_.size(); ++v) {
    Vertex& vertex = vertices_[v];
    if (!vertex.is_there) continue;
    const double slack = tolerance * std::max(1.0, dot(vertex.position, vertex.position));
    if (dot(neighbour, vertex.position) - offset > slack) {
      vertex.is_there = false;
      removed_.push_back(v);
    } else {
      ++left;
    }
  }
  const uint32_t number = static_cast<uint32_t>(planes_.size());
  ++cuts_;
  planes_.push_back({neighbour, offset, 0, 0});
  if (removed_.empty()) return true;
  is_empty_ = left == 0;
  if (is_empty_) return false;

  hole_.clear();
  for (uint32_t v : removed_)
    for (int i = 0; i < 3; ++i) {
      const Vertex& vertex = vertices_[v];
      if (vertices_[vertex.next[i]].is_there)
        hole_.push_back({vertex.plane[i], vertex.plane[(i + 1) % 3], vertex.next[i]});
    }
  for (const Side& side : hole_) {
    Plane& plane = planes_[side.a];
    if (plane.cut == cuts_) return false;  // the hole touches a face twice
    plane.cut = cuts_;
    plane.start = static_cast<uint32_t>(vertices_.size());
    Vertex vertex{{side.a, side.b, number}, {side.outside, 0, 0}, {}, true};
    place(vertex);
    if (!is_finite(vertex.position)) return false;
    Vertex& outside = vertices_[side.outside];
    for (int i = 0; i < 3; ++i)
      if (outside.plane[i] == side.b && outside.plane[(i + 1) % 3] == side.a)
        outside.next[i] = plane.start;
    vertices_.push_back(vertex);
  }
  // There must be one loop; otherwise the cut is not a simple hole.
  size_t seen = 0;
  uint32_t at = static_cast<uint32_t>(made_);
  do {
    const Plane& following = planes_[vertices_[at].plane[1]];
    if (following.cut != cuts_) return false;
    vertices_[at].next[1] = following.start;
    vertices_[following.start].next[2] = at;
    at = following.start;
    ++seen;
  } while (at != made_ && seen <= hole_.size());
  return seen == hole_.size();
}

}  // namespace msq
