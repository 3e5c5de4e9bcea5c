// SPDX-License-Identifier: Apache-2.0
#include "surface/mesh_edges.h"

#include <algorithm>
#include <mutex>
#include <numeric>

#include "base/ray_normal.h"
#include "ray/cast.h"
#include "surface/boundary_ways.h"

namespace msq {

namespace {

/// Halves a pitch to less than 2^-24 of it.
constexpr int rounds_of_edge = 24;

}  // namespace

Vec3 MeshEdges::point(int axis, uint32_t layer, const Crossing& crossing) const {
  const MeshGrid& grid = nodes_.grid();
  Vec3 p{grid.at(0, crossing.column), grid.at(1, crossing.row), grid.at(2, layer)};
  p[axis] = crossing.at;
  return p;
}

uint64_t MeshEdges::count(uint32_t k) const {
  uint64_t all = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const uint32_t layer = axis == 2 ? k : k + 1;
    for (uint32_t j = 0; j < nodes_.edge_rows(axis); ++j)
      for (size_t w = 0; w < nodes_.row_words(); ++w)
        all += static_cast<uint64_t>(std::popcount(nodes_.edges(axis, layer, j, w)));
  }
  return all;
}

void MeshEdges::find(uint32_t first, uint32_t end, Job* job) {
  std::array<Edges, 3> shared;
  const bool goes_on = !layers_.empty();
  if (goes_on) shared = std::move(layers_.back());  // of node layer `first`: all but those along z
  layers_.clear();
  layers_.resize(end - first + 1);
  layers_[0] = std::move(shared);
  first_ = first;
  std::vector<Part> parts;
  for (uint32_t layer = first; layer <= end; ++layer)
    for (int axis = 0; axis < 3; ++axis)
      if (axis == 2 ? layer < end : layer > first || !goes_on) parts.push_back({axis, layer, 0});
  model_.executor().for_each(parts.size(), [&](uint64_t n) {
    check_cancelled(job);
    list(parts[n].axis, parts[n].layer);
  });
  uint64_t count = 0;
  for (Part& part : parts) {
    part.first = count;
    count += edges(part.axis, part.layer).crossings.size();
  }
  locate(parts, count, job);
}

void MeshEdges::list(int axis, uint32_t layer) {
  Edges& out = edges(axis, layer);
  const uint32_t rows = nodes_.edge_rows(axis);
  out.starts.assign(rows + 1, 0);
  uint64_t count = 0;
  for (uint32_t j = 0; j < rows; ++j) {
    for (size_t w = 0; w < nodes_.row_words(); ++w)
      count += static_cast<uint64_t>(std::popcount(nodes_.edges(axis, layer, j, w)));
    out.starts[j + 1] = static_cast<uint32_t>(count);
  }
  out.crossings.resize(count);
  Crossing* crossing = out.crossings.data();
  for (uint32_t j = 0; j < rows; ++j)
    for (size_t w = 0; w < nodes_.row_words(); ++w)
      for (uint64_t rest = nodes_.edges(axis, layer, j, w); rest; rest &= rest - 1) {
        crossing->column =
            static_cast<uint32_t>(w * 64) + static_cast<uint32_t>(std::countr_zero(rest));
        crossing->row = j;
        ++crossing;
      }
}

// A ray comes from the node outside. Where that is beyond the box, it comes from the box's face: if
// it starts inside there, its normal is that of the face.
void MeshEdges::locate(const std::vector<Part>& parts, uint64_t count, Job* job) {
  const MeshGrid& grid = nodes_.grid();
  struct Place {
    int axis;
    uint32_t layer;
    Crossing* crossing;
  };
  const auto find = [&](uint64_t ray) -> Place {
    const auto part = std::upper_bound(parts.begin(), parts.end(), ray,
                                       [](uint64_t n, const Part& p) { return n < p.first; }) -
                      1;
    return {part->axis, part->layer, &edges(part->axis, part->layer).crossings[ray - part->first]};
  };
  /// From outside to inside.
  const auto ends = [&](const Place& place, Vec3& from, Vec3& to) {
    const Crossing& c = *place.crossing;
    from = to = {grid.at(0, c.column), grid.at(1, c.row), grid.at(2, place.layer)};
    const uint32_t low = place.axis == 0 ? c.column : place.axis == 1 ? c.row : place.layer;
    to[place.axis] = grid.at(place.axis, low + 1);
    if (nodes_.inside(c.column, c.row, place.layer)) std::swap(from, to);
  };
  const auto fill = [&](std::span<const uint64_t> rays, RaySearch* searches) {
    for (size_t n = 0; n < rays.size(); ++n) {
      const Place place = find(rays[n]);
      Vec3 from, to;
      ends(place, from, to);
      const double way = to[place.axis] - from[place.axis];
      searches[n].ray = {from, {}};
      searches[n].ray.direction[place.axis] = way < 0 ? -1 : 1;
      searches[n].from = 0;
      searches[n].to = std::abs(way);
    }
  };
  std::vector<uint64_t> missed;
  std::mutex mutex;
  const auto take = [&](std::span<const uint64_t> rays, const RayHit* hits) {
    for (size_t n = 0; n < rays.size(); ++n) {
      if (hits[n].scale < 0) {
        const std::lock_guard lock(mutex);
        missed.push_back(rays[n]);
        continue;
      }
      const Place place = find(rays[n]);
      Vec3 from, to;
      ends(place, from, to);
      const double a = from[place.axis], b = to[place.axis];
      place.crossing->at =
          std::clamp(a + (b > a ? hits[n].t : -hits[n].t), std::min(a, b), std::max(a, b));
      place.crossing->normal = hits[n].normal;
    }
  };
  Job part(job);  // the progress of the call is another
  cast_rays(model_, resolved_, count, fill, take, &part);
  const auto halve_edges = [&](const std::vector<uint64_t>& rays) {
    std::vector<BoundaryWay> ways;
    for (const uint64_t ray : rays) {
      Vec3 from, to;
      ends(find(ray), from, to);
      ways.push_back({to, from});
    }
    halve(model_, resolved_, ways, rounds_of_edge, job);
    for (size_t n = 0; n < rays.size(); ++n) {
      const Place place = find(rays[n]);
      place.crossing->at = ways[n].middle()[place.axis];
    }
  };
  // Rays may overlook what is thinner than their tolerance; the node is inside all the same.
  halve_edges(missed);
  for (const uint64_t ray : missed) {
    check_cancelled(job);
    const Place place = find(ray);
    Vec3 from, to;
    ends(place, from, to);
    Ray way{from, {}};
    way.direction[place.axis] = to[place.axis] > from[place.axis] ? 1 : -1;
    place.crossing->normal = normal_by_membership(
        [&](Vec3 p) { return model_.inside(p, resolved_); }, way,
        std::abs(place.crossing->at - from[place.axis]), 0x1p-12 * grid.pitch());
  }
  if (!rays_are_coarse(model_, resolved_, grid)) return;
  constexpr uint64_t at_once = uint64_t{1} << 16;
  std::vector<uint64_t> some;
  for (uint64_t first = 0; first < count; first += at_once) {
    some.resize(std::min(at_once, count - first));
    std::iota(some.begin(), some.end(), first);
    halve_edges(some);
  }
}

}  // namespace msq
