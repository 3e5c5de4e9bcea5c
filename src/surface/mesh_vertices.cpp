// SPDX-License-Identifier: Apache-2.0
#include "surface/mesh_vertices.h"

#include <algorithm>
#include <mutex>
#include <numeric>

#include "query/inside_points.h"
#include "ray/cast.h"
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

/// The direction of a sum of normals; that of one of them where they cancel, as those on both sides
/// of a thin wall do.
Vec3 mean_direction(Vec3 sum, Vec3 one) {
  constexpr double rounding = 0x1p-40;
  return length(sum) > rounding ? unit(sum) : one;
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
  const double snap = 0x1p-20 * grid.pitch();
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
        seed = {{i, j, k}, static_cast<uint8_t>(corners), 0, 0, 0};
        for (unsigned e = 0; e < 12; ++e) {
          if (loops.of_edge[e] != loop) continue;
          Crossing& crossing = *crossings[e];
          crossing.vertices[place_around_edge(e)] = static_cast<uint32_t>(vertex);
          seed.edges = static_cast<uint16_t>(seed.edges | 1u << e);
          const int along = axis_of_edge(e);
          points[count] = edges.point(along, k + offset_of_edge(e)[2], crossing);
          if (crossing.at < grid.box().min[along] + snap ||
              crossing.at > grid.box().max[along] - snap)
            seed.onto = static_cast<uint16_t>(seed.onto | 1u << e);
          normals[count] = crossing.normal;
          normal = normal + crossing.normal;
          ++count;
        }
        const Box3 whole{{grid.at(0, i), grid.at(1, j), grid.at(2, k)},
                         {grid.at(0, i + 1), grid.at(1, j + 1), grid.at(2, k + 1)}};
        const Vec3 place = nearest_to_planes(points, normals, count, whole);
        for (unsigned e = 0; e < 12; ++e) {
          const int along = axis_of_edge(e);
          if ((seed.onto >> e & 1) && (place[along] < grid.box().min[along] + snap ||
                                       place[along] > grid.box().max[along] - snap))
            seed.faces = static_cast<uint8_t>(seed.faces | 1u << along);
        }
        places_[vertex - first_] = clamped(place, cell);
        normals_[vertex - first_] = mean_direction(normal, normals[0]);
      }
    };
    edges.for_each_cell(topology, j, k, visit);
  });
}

/// A point of the vertex's cell, with the coordinates of the faces that the vertex lies on.
Vec3 MeshVertices::on_faces(const Seed& seed, Vec3 at) const {
  const MeshGrid& grid = nodes_.grid();
  for (int axis = 0; axis < 3; ++axis)
    if (seed.faces >> axis & 1)
      at[axis] = seed.cell[axis] == 0 ? grid.box().min[axis] : grid.box().max[axis];
  return at;
}

/// Of the face that looks most into a direction.
Vec3 MeshVertices::face_normal(const Seed& seed, Vec3 outward) {
  int most = -1;
  for (int axis = 0; axis < 3; ++axis)
    if ((seed.faces >> axis & 1) && (most < 0 || std::abs(outward[axis]) > std::abs(outward[most])))
      most = axis;
  Vec3 normal;
  normal[most] = seed.cell[most] == 0 ? -1 : 1;
  return normal;
}

/// Whether a ray begins next to a face of the box, and comes through it: the vertex lies there.
bool MeshVertices::comes_from_face(const Ray& ray, Seed& seed) const {
  const MeshGrid& grid = nodes_.grid();
  const Box3 cell = grid.cell(seed.cell[0], seed.cell[1], seed.cell[2]);
  const double snap = 0x1p-20 * grid.pitch();
  for (int axis = 0; axis < 3; ++axis) {
    const uint32_t n = seed.cell[axis];
    const double at = ray.origin[axis], along = ray.direction[axis];
    if ((along > 0 && n == 0 && at < cell.min[axis] + snap) ||
        (along < 0 && n + 2 == grid.nodes(axis) && at > cell.max[axis] - snap)) {
      seed.faces = static_cast<uint8_t>(1u << axis);
      return true;
    }
  }
  return false;
}

// A vertex on a face of the box is searched next to the face, within the box: on the face itself
// rounding may decide, where the model ends there too.
void MeshVertices::place_on_boundary(uint64_t from, Job* job) {
  const MeshGrid& grid = nodes_.grid();
  const double far = reach * grid.pitch();
  /// Along the mean normal, within the cell; along the face if the vertex is on an edge there.
  /// False if it is on the face alone.
  const auto ray_of = [&](uint64_t vertex, RaySearch& search) {
    const Seed& seed = seeds_[vertex];
    const Vec3 at = places_[vertex];
    Vec3 out = normals_[vertex], within = out;
    search.from = 0;
    search.to = -1;
    search.ray = {at, {1, 0, 0}};
    if (seed.edges == 0) return false;
    const Box3 cell = grid.cell(seed.cell[0], seed.cell[1], seed.cell[2]);
    for (int axis = 0; axis < 3; ++axis)
      if (seed.faces >> axis & 1) within[axis] = 0;
    constexpr double along_face = 0.05;
    const bool may_move = seed.faces == 0 || length(within) > along_face;
    if (may_move) out = unit(within);
    if (!(dot(out, out) > 0)) return false;
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
    return may_move;
  };
  const auto fill = [&](std::span<const uint64_t> rays, RaySearch* searches) {
    for (size_t n = 0; n < rays.size(); ++n) ray_of(from + rays[n], searches[n]);
  };
  const bool is_coarse = rays_are_coarse(model_, resolved_, grid);
  std::vector<uint64_t> left;
  std::mutex mutex;
  // Where a vertex is put when its ray is known: rays are filled in more than once.
  std::vector<Vec3> found(places_.size() - from);
  const auto take = [&](std::span<const uint64_t> rays, const RayHit* hits) {
    for (size_t n = 0; n < rays.size(); ++n) {
      const uint64_t vertex = from + rays[n];
      Seed& seed = seeds_[vertex];
      found[rays[n]] = places_[vertex];
      if (seed.edges == 0) continue;
      const RayHit& hit = hits[n];
      RaySearch search;
      const bool may_move = ray_of(vertex, search);
      if (hit.scale >= 0 && !hit.starts_inside && may_move && !is_coarse) {
        const Box3 cell = grid.cell(seed.cell[0], seed.cell[1], seed.cell[2]);
        found[rays[n]] = on_faces(seed, clamped(search.ray.at(hit.t), cell));
        normals_[vertex] = hit.normal;
      } else if (hit.scale >= 0 && hit.starts_inside && !may_move) {
        found[rays[n]] = on_faces(seed, places_[vertex]);
        normals_[vertex] = face_normal(seed, normals_[vertex]);
      } else if (hit.scale >= 0 && hit.starts_inside && comes_from_face(search.ray, seed)) {
        found[rays[n]] = on_faces(seed, search.ray.origin);
        normals_[vertex] = face_normal(seed, search.ray.direction * -1.0);
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

// There is a node of the other kind on an edge of the loop; the boundary lies between. For a vertex
// on a face the crossing of an edge with that face is such a point.
void MeshVertices::place_by_membership(const std::vector<uint64_t>& left, const Job* job) {
  const MeshGrid& grid = nodes_.grid();
  std::vector<Vec3> points;
  points.reserve(left.size());
  std::vector<uint8_t> inside;
  for (const uint64_t vertex : left) points.push_back(places_[vertex]);
  find_inside(model_, resolved_, points, inside, job);
  std::vector<BoundaryWay> ways;
  std::vector<uint64_t> moved;
  for (size_t n = 0; n < left.size(); ++n) {
    Seed& seed = seeds_[left[n]];
    if (inside[n] && seed.faces) {
      places_[left[n]] = on_faces(seed, points[n]);
      normals_[left[n]] = face_normal(seed, normals_[left[n]]);
      continue;
    }
    Vec3 nearest;
    if (!find_other(seed, points[n], inside[n] != 0, nearest)) {
      seed.faces = 0;
      find_other(seed, points[n], inside[n] != 0, nearest);
    }
    ways.push_back(inside[n] ? BoundaryWay{points[n], nearest} : BoundaryWay{nearest, points[n]});
    moved.push_back(left[n]);
  }
  halve(model_, resolved_, ways, rounds, job);
  for (size_t n = 0; n < moved.size(); ++n) {
    const Seed& seed = seeds_[moved[n]];
    const Box3 cell = grid.cell(seed.cell[0], seed.cell[1], seed.cell[2]);
    places_[moved[n]] = on_faces(seed, clamped(ways[n].middle(), cell));
  }
  take_normals(moved, ways, job);
  for (size_t n = 0; n < moved.size(); ++n) {
    Vec3& normal = normals_[moved[n]];
    Seed seed = seeds_[moved[n]];
    // A way may begin on a face of the box, inside the model. It then leads through the face.
    const Ray ray{ways[n].outside, ways[n].inwards()};
    if (seed.faces)
      normal = face_normal(seed, normal);
    else if (comes_from_face(ray, seed))
      normal = face_normal(seed, ray.direction * -1.0);
  }
}

/// The normals where short ways cross the boundary. A vertex may have moved to another side of a
/// thin wall than that of its crossings.
void MeshVertices::take_normals(std::span<const uint64_t> vertices,
                                std::span<const BoundaryWay> ways, const Job* job) {
  const auto fill = [&](std::span<const uint64_t> rays, RaySearch* searches) {
    for (size_t n = 0; n < rays.size(); ++n) {
      const BoundaryWay& way = ways[rays[n]];
      const double size = way.size();
      searches[n].ray = {way.outside, size > 0 ? way.inwards() : Vec3{1, 0, 0}};
      searches[n].from = 0;
      searches[n].to = size > 0 ? 2 * size : -1;
    }
  };
  const auto take = [&](std::span<const uint64_t> rays, const RayHit* hits) {
    for (size_t n = 0; n < rays.size(); ++n) {
      const BoundaryWay& way = ways[rays[n]];
      Vec3& normal = normals_[vertices[rays[n]]];
      if (hits[n].scale >= 0 && !hits[n].starts_inside)
        normal = hits[n].normal;
      else if (dot(normal, way.outside - way.inside) < 0)
        normal = normal * -1.0;
    }
  };
  Job part(job);
  cast_rays(model_, resolved_, vertices.size(), fill, take, &part);
}

/// The nearest end, of the other kind, of an edge of the loop. For a vertex on faces of the box,
/// which is outside, the nearest crossing on one of them: the vertex stays on that one. False if
/// there is none.
bool MeshVertices::find_other(Seed& seed, Vec3 place, bool is_inside, Vec3& other) const {
  const MeshGrid& grid = nodes_.grid();
  double nearest = std::numeric_limits<double>::infinity();
  const unsigned faces = seed.faces;
  for (unsigned e = 0; e < 12; ++e) {
    if (!(seed.edges >> e & 1)) continue;
    const int along = axis_of_edge(e);
    if (faces && !((seed.onto >> e & 1) && (faces >> along & 1))) continue;
    const unsigned first = first_corner(e);
    const unsigned corner = (seed.corners >> first & 1) != is_inside ? first : second_corner(e);
    Vec3 at;
    for (int axis = 0; axis < 3; ++axis)
      at[axis] = faces && axis == along ? place[axis]
                                        : grid.at(axis, seed.cell[axis] + (corner >> axis & 1));
    const double way = dot(at - place, at - place);
    if (!(way < nearest)) continue;
    other = at;
    nearest = way;
    if (faces) seed.faces = static_cast<uint8_t>(1u << along);
  }
  return nearest > 0 && std::isfinite(nearest);
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
    Vec3 normal, one;
    for (const unsigned turn : {arc.turn + 3u, arc.turn + 0u}) {
      const unsigned e = face.edges[turn % 4];
      const std::array<uint8_t, 3> d = offset_of_edge(e);
      one = at_column({arc.cell[2] + d[2], axis_of_edge(e), arc.cell[1] + d[1], arc.cell[0] + d[0]})
                .normal;
      normal = normal + one;
    }
    normals_[vertex + ways.size() - 1] = mean_direction(normal, one);
  }
  halve(model_, resolved_, ways, rounds, job);
  std::vector<uint64_t> placed(ways.size());
  std::iota(placed.begin(), placed.end(), vertex);
  take_normals(placed, ways, job);
  for (const BoundaryWay& way : ways) places_[vertex++] = way.middle();
  for (const GridEdge& edge : layer.middles) {
    const Crossing& crossing = at_column(edge);
    places_[vertex] = edges.point(edge.axis, edge.layer, crossing);
    normals_[vertex] = crossing.normal;
    ++vertex;
  }
}

}  // namespace msq
