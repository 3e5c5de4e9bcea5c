// SPDX-License-Identifier: Apache-2.0
#include "surface/mesh_vertices.h"

#include <algorithm>
#include <mutex>

#include "ray/cast.h"
#include "surface/inside_points.h"
#include "surface/quadric.h"

namespace msq {

namespace {

/// Of a pitch, halved as often, less than 2^-11 remains of the longest way within a cell.
constexpr int rounds = 14;
/// How far on either side of where the quadric puts a vertex a ray looks for the boundary, in
/// pitches.
constexpr double reach = 0.25;

Vec3 unit(Vec3 v) {
  const double size = length(v);
  return size > 0 ? v * (1 / size) : Vec3{};
}

Vec3 clamped(Vec3 p, const Box3& box) {
  return max(box.min, min(box.max, p));
}

}  // namespace

void MeshVertices::find(const MeshTopology& topology, MeshEdges& edges, uint32_t first,
                        uint32_t end, Job* job) {
  // The vertices of the last layer stay.
  const uint64_t kept = first > 0 ? topology.layer(first - 1).vertices : 0;
  const auto drop = [kept](std::vector<Vec3>& of) {
    of.erase(of.begin(), of.end() - static_cast<ptrdiff_t>(kept));
  };
  drop(places_);
  drop(normals_);
  const uint64_t begin = topology.layer(first).first_vertex;
  first_ = begin - kept;
  const MeshTopology::Layer& last = topology.layer(end - 1);
  const uint64_t all = last.first_vertex + last.vertices - first_;
  places_.resize(all);
  normals_.resize(all);
  seeds_.assign(all, {});
  find_seeds(topology, edges, first, end, job);
  place_on_boundary(kept, job);
  for (uint32_t k = first; k < end; ++k) place_others(topology, edges, k, job);
}

void MeshVertices::find_seeds(const MeshTopology& topology, MeshEdges& edges, uint32_t first,
                              uint32_t end, const Job* job) {
  const MeshGrid& grid = nodes_.grid();
  const uint32_t rows = grid.nodes(1) - 1;
  model_.executor().for_each(uint64_t{end - first} * rows, [&](uint64_t n) {
    check_cancelled(job);
    const uint32_t k = first + static_cast<uint32_t>(n / rows);
    const uint32_t j = static_cast<uint32_t>(n % rows);
    const MeshTopology::Layer& layer = topology.layer(k);
    uint64_t vertex = layer.first_vertex + layer.starts[j];
    const auto visit = [&](uint32_t i, unsigned corners, const CellLoops& loops,
                           const std::array<Crossing*, 12>& crossings) {
      const Box3 cell = grid.cell(i, j, k);
      for (uint8_t loop = 0; loop < loops.count; ++loop, ++vertex) {
        Vec3 points[12], normals[12], normal;
        size_t count = 0;
        Seed& seed = seeds_[vertex - first_];
        seed = {{i, j, k}, static_cast<uint8_t>(corners), 0};
        for (unsigned e = 0; e < 12; ++e) {
          if (loops.of_edge[e] != loop) continue;
          Crossing& crossing = *crossings[e];
          crossing.vertices[place_around_edge(e)] = static_cast<uint32_t>(vertex);
          seed.edges = static_cast<uint16_t>(seed.edges | 1u << e);
          points[count] = edges.point(axis_of_edge(e), k + offset_of_edge(e)[2], crossing);
          normals[count] = crossing.normal;
          normal = normal + crossing.normal;
          ++count;
        }
        const Box3 whole{{grid.at(0, i), grid.at(1, j), grid.at(2, k)},
                         {grid.at(0, i + 1), grid.at(1, j + 1), grid.at(2, k + 1)}};
        places_[vertex - first_] = clamped(nearest_to_planes(points, normals, count, whole), cell);
        normals_[vertex - first_] = unit(normal);
      }
    };
    edges.for_each_cell(topology, j, k, visit);
  });
}

/// Whether a point lies on a face of the box that looks outward as the direction does.
bool MeshVertices::is_on_face(Vec3 at, Vec3 outward, Vec3& normal) const {
  const Box3& box = nodes_.grid().box();
  for (int axis = 0; axis < 3; ++axis) {
    const double side = at[axis] == box.min[axis] ? -1 : at[axis] == box.max[axis] ? 1 : 0;
    if (!(side * outward[axis] > 0)) continue;
    normal = {};
    normal[axis] = side;
    return true;
  }
  return false;
}

void MeshVertices::place_on_boundary(uint64_t from, Job* job) {
  const MeshGrid& grid = nodes_.grid();
  const double snap = 0x1p-20 * grid.pitch(), far = reach * grid.pitch();
  /// Along the mean normal, within the cell; on a face of the box within that.
  const auto ray_of = [&](uint64_t vertex, RaySearch& search) {
    const Seed& seed = seeds_[vertex];
    Vec3& at = places_[vertex];
    Vec3 out = normals_[vertex];
    search.from = 0;
    search.to = -1;
    search.ray = {at, {1, 0, 0}};
    if (seed.edges == 0) return;
    const Box3 cell = grid.cell(seed.cell[0], seed.cell[1], seed.cell[2]);
    Vec3 within = out;
    for (int axis = 0; axis < 3; ++axis)
      for (const double face : {grid.box().min[axis], grid.box().max[axis]})
        if (std::abs(at[axis] - face) < snap) {
          at[axis] = face;
          within[axis] = 0;
        }
    constexpr double along_face = 0.05;  // less: the vertex is on the face and no edge
    if (length(within) > along_face) out = unit(within);
    if (!(dot(out, out) > 0)) return;
    double back = far, ahead = far;
    for (int axis = 0; axis < 3; ++axis) {
      if (out[axis] == 0) continue;
      const double up = (cell.max[axis] - at[axis]) / out[axis];
      const double down = (cell.min[axis] - at[axis]) / out[axis];
      back = std::min(back, std::max({up, down, 0.0}));
      ahead = std::min(ahead, std::max({-up, -down, 0.0}));
    }
    search.ray = {clamped(at + out * back, cell), out * -1.0};
    search.to = back + ahead;
  };
  const auto fill = [&](std::span<const uint64_t> rays, RaySearch* searches) {
    for (size_t n = 0; n < rays.size(); ++n) ray_of(from + rays[n], searches[n]);
  };
  std::vector<uint64_t> left;
  std::mutex mutex;
  // Where a vertex is put when its ray is known: rays are filled in more than once.
  std::vector<Vec3> found(places_.size() - from);
  const auto take = [&](std::span<const uint64_t> rays, const RayHit* hits) {
    for (size_t n = 0; n < rays.size(); ++n) {
      const uint64_t vertex = from + rays[n];
      const Seed& seed = seeds_[vertex];
      found[rays[n]] = places_[vertex];
      if (seed.edges == 0) continue;
      const RayHit& hit = hits[n];
      RaySearch search;
      ray_of(vertex, search);
      if (hit.scale >= 0 && !hit.starts_inside) {
        const Box3 cell = grid.cell(seed.cell[0], seed.cell[1], seed.cell[2]);
        found[rays[n]] = clamped(search.ray.at(hit.t), cell);
        normals_[vertex] = hit.normal;
      } else if (hit.scale >= 0 &&
                 is_on_face(search.ray.origin, search.ray.direction * -1.0, normals_[vertex])) {
        found[rays[n]] = search.ray.origin;
      } else {
        const std::lock_guard lock(mutex);
        left.push_back(vertex);
      }
    }
  };
  Job part(job);  // the progress of the call is another
  cast_rays(model_, resolved_, found.size(), fill, take, &part);
  std::copy(found.begin(), found.end(), places_.begin() + static_cast<ptrdiff_t>(from));
  std::sort(left.begin(), left.end());
  place_by_membership(left, job);
}

// There is a node of the other kind on an edge of the loop; the boundary lies between.
void MeshVertices::place_by_membership(const std::vector<uint64_t>& left, const Job* job) {
  const MeshGrid& grid = nodes_.grid();
  std::vector<Vec3> points;
  std::vector<uint8_t> inside;
  for (const uint64_t vertex : left) points.push_back(places_[vertex]);
  find_inside(model_, resolved_, points, inside, job);
  std::vector<BoundaryWay> ways;
  std::vector<uint64_t> moved;
  for (size_t n = 0; n < left.size(); ++n) {
    const Seed& seed = seeds_[left[n]];
    Vec3 face;
    if (inside[n] && is_on_face(points[n], normals_[left[n]], face)) {
      normals_[left[n]] = face;
      continue;
    }
    Vec3 nearest;
    double nearest_way = std::numeric_limits<double>::infinity();
    for (unsigned e = 0; e < 12; ++e) {
      if (!(seed.edges >> e & 1)) continue;
      const unsigned first = first_corner(e), second = second_corner(e);
      const unsigned corner = (seed.corners >> first & 1) != inside[n] ? first : second;
      Vec3 at;
      for (int axis = 0; axis < 3; ++axis)
        at[axis] = grid.at(axis, seed.cell[axis] + (corner >> axis & 1));
      const double way = dot(at - points[n], at - points[n]);
      if (way < nearest_way) {
        nearest = at;
        nearest_way = way;
      }
    }
    ways.push_back(inside[n] ? BoundaryWay{points[n], nearest} : BoundaryWay{nearest, points[n]});
    moved.push_back(left[n]);
  }
  halve(model_, resolved_, ways, rounds, job);
  for (size_t n = 0; n < moved.size(); ++n) {
    const Seed& seed = seeds_[moved[n]];
    places_[moved[n]] =
        clamped(ways[n].middle(), grid.cell(seed.cell[0], seed.cell[1], seed.cell[2]));
  }
}

// Between a corner of the face and its middle membership differs, or the face would not be
// ambiguous.
void MeshVertices::place_others(const MeshTopology& topology, const MeshEdges& edges, uint32_t k,
                                const Job* job) {
  const MeshGrid& grid = nodes_.grid();
  const MeshTopology::Layer& layer = topology.layer(k);
  uint64_t vertex = layer.first_vertex - first_ + layer.starts.back();
  const auto at_column = [&](const GridEdge& edge) -> const Crossing& {
    const MeshEdges::Edges& all = edges.edges(edge.axis, edge.layer);
    const auto row = all.crossings.begin() + all.starts[edge.row];
    return *std::lower_bound(row, all.crossings.begin() + all.starts[edge.row + 1], edge.column,
                             [](const Crossing& c, uint32_t column) { return c.column < column; });
  };
  std::vector<BoundaryWay> ways;
  for (const ArcVertex& arc : layer.arcs) {
    const CellFace& face = cell_faces[arc.face];
    Vec3 corner, middle;
    for (int axis = 0; axis < 3; ++axis) {
      const uint32_t n = arc.cell[axis];
      corner[axis] = grid.at(axis, n + (face.corners[arc.turn] >> axis & 1u));
      middle[axis] =
          axis == arc.face / 2 ? grid.at(axis, n) : 0.5 * (grid.at(axis, n) + grid.at(axis, n + 1));
    }
    ways.push_back(arc.corner_inside ? BoundaryWay{corner, middle} : BoundaryWay{middle, corner});
    Vec3 normal;
    for (const unsigned turn : {arc.turn + 3u, arc.turn + 0u}) {
      const unsigned e = face.edges[turn % 4];
      const std::array<uint8_t, 3> d = offset_of_edge(e);
      normal = normal + at_column({arc.cell[2] + d[2], axis_of_edge(e), arc.cell[1] + d[1],
                                   arc.cell[0] + d[0]})
                            .normal;
    }
    normals_[vertex + ways.size() - 1] = unit(normal);
  }
  halve(model_, resolved_, ways, rounds, job);
  for (const BoundaryWay& way : ways) places_[vertex++] = way.middle();
  for (const GridEdge& edge : layer.middles) {
    const Crossing& crossing = at_column(edge);
    places_[vertex] = edges.point(edge.axis, edge.layer, crossing);
    normals_[vertex] = crossing.normal;
    ++vertex;
  }
}

}  // namespace msq
