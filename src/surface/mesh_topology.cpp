// SPDX-License-Identifier: Apache-2.0
#include "surface/mesh_topology.h"

#include <algorithm>

#include "base/status.h"
#include "query/inside_points.h"

namespace msq {

namespace {

constexpr uint64_t max_vertices = UINT32_MAX;

/// The same edge of the cell on the other side of a face.
unsigned mirrored(unsigned edge, int axis) {
  const auto [dx, dy, dz] = offset_of_edge(edge);
  const unsigned x = axis == 0 ? 1u - dx : dx, y = axis == 1 ? 1u - dy : dy,
                 z = axis == 2 ? 1u - dz : dz;
  const int along = axis_of_edge(edge);
  return along == 0 ? cell_edge(0, y, z) : along == 1 ? cell_edge(1, x, z) : cell_edge(2, x, y);
}

GridEdge grid_edge(uint32_t i, uint32_t j, uint32_t k, unsigned edge) {
  const auto [dx, dy, dz] = offset_of_edge(edge);
  return {k + dz, axis_of_edge(edge), j + dy, i + dx};
}

}  // namespace

unsigned place_around_edge(unsigned edge) {
  const std::array<uint8_t, 3> d = offset_of_edge(edge);
  const size_t axis = static_cast<size_t>(axis_of_edge(edge));
  // An edge at the cell's low side has the cell behind it.
  const unsigned first = 1u - d[(axis + 1) % 3], second = 1u - d[(axis + 2) % 3];
  return second ? 3 - first : first;
}

void MeshTopology::add(uint32_t first, uint32_t end, Job* job) {
  if (!layers_.empty()) {
    Layer last = std::move(layers_.back());
    layers_.clear();
    layers_.push_back(std::move(last));
    first_ = first - 1;
    on_sides_.erase(on_sides_.begin(), on_sides_.lower_bound({{first, 0, 0, 0}, 0}));
  } else {
    first_ = first;
  }
  find_ambiguous(first, end, job);
  for (uint32_t k = first; k < end; ++k) number(k, job);
}

void MeshTopology::find_ambiguous(uint32_t first, uint32_t end, Job* job) {
  const MeshGrid& grid = nodes_.grid();
  const uint32_t rows = grid.nodes(1) - 1;
  const CellTable& table = cell_table();
  const size_t offset = first - first_;
  layers_.resize(offset + (end - first));
  for (size_t n = offset; n < layers_.size(); ++n) layers_[n].ambiguous.resize(rows);
  model_.executor().for_each(end - first, [&](uint64_t n) {
    const uint32_t k = first + static_cast<uint32_t>(n);
    for (uint32_t j = 0; j < rows; ++j) {
      check_cancelled(job);
      nodes_.for_each_cell(j, k, [&](uint32_t i, unsigned corners) {
        if (table.ambiguous[corners])
          layers_[offset + n].ambiguous[j].push_back({i, static_cast<uint8_t>(corners), 0});
      });
    }
  });
  std::vector<Vec3> points;
  std::vector<uint8_t> inside;
  for (uint32_t k = first; k < end; ++k) {
    points.clear();
    const auto for_each_face = [&](auto&& visit) {
      for (uint32_t j = 0; j < rows; ++j)
        for (AmbiguousCell& cell : layers_[k - first_].ambiguous[j])
          for (unsigned face = 0; face < 6; ++face)
            if (table.ambiguous[cell.corners] >> face & 1) visit(cell, j, face);
    };
    for_each_face([&](const AmbiguousCell& cell, uint32_t j, unsigned face) {
      const uint32_t index[3] = {cell.column, j, k};
      Vec3 p;
      for (int axis = 0; axis < 3; ++axis) {
        const uint32_t n = index[axis];
        p[axis] = static_cast<int>(face / 2) == axis
                      ? grid.at(axis, n + (face & 1))
                      : 0.5 * (grid.at(axis, n) + grid.at(axis, n + 1));
      }
      points.push_back(p);
    });
    find_inside(model_, resolved_, points, inside, job);
    size_t n = 0;
    for_each_face([&](AmbiguousCell& cell, uint32_t, unsigned face) {
      if (inside[n++]) cell.centres = static_cast<uint8_t>(cell.centres | 1u << face);
    });
  }
}

void MeshTopology::number(uint32_t k, const Job* job) {
  Layer& layer = layers_[k - first_];
  const uint32_t rows = nodes_.grid().nodes(1) - 1;
  layer.first_vertex = vertices_;
  layer.starts.assign(rows + 1, 0);
  std::vector<uint64_t> crossings(nodes_.grid().nodes(1), 0);
  model_.executor().for_each(nodes_.grid().nodes(1), [&](uint64_t n) {
    check_cancelled(job);
    const uint32_t j = static_cast<uint32_t>(n);
    for (int axis = 0; axis < 3; ++axis)
      if (j < nodes_.edge_rows(axis))
        for (size_t w = 0; w < nodes_.row_words(); ++w)
          crossings[n] += static_cast<uint64_t>(std::popcount(nodes_.edges(axis, k, j, w)));
    if (j == rows) return;
    uint32_t count = 0;
    for_each_cell(j, k, [&](uint32_t, unsigned, const CellLoops& loops) { count += loops.count; });
    layer.starts[j + 1] = count;
  });
  uint64_t all = 0;
  for (uint32_t& start : layer.starts) {
    all += start;
    start = static_cast<uint32_t>(all);
  }
  vertices_ += all;
  find_arcs(k);
  for (auto s = on_sides_.lower_bound({{k, 0, 0, 0}, 0});
       s != on_sides_.end() && s->first.edge.layer == k; ++s) {
    ++layer.triangles;
    if (!layer.middles.empty() && layer.middles.back() == s->first.edge) continue;
    layer.middles.push_back(s->first.edge);
    layer.triangles += 2;
  }
  vertices_ += layer.middles.size();
  layer.vertices = vertices_ - layer.first_vertex;
  for (const uint64_t count : crossings) layer.triangles += 2 * count;
  triangles_ += layer.triangles;
  if (vertices_ > max_vertices)
    fail(Status::limit, "%llu vertices up to layer %u of cells; the limit is %llu",
         static_cast<unsigned long long>(vertices_), k,
         static_cast<unsigned long long>(max_vertices));
}

bool MeshTopology::joins_arcs(uint32_t k, uint32_t j, const AmbiguousCell& cell,
                              unsigned face) const {
  const std::vector<AmbiguousCell>& row = layer(k).ambiguous[j];
  const auto found =
      std::lower_bound(row.begin(), row.end(), cell.column,
                       [](const AmbiguousCell& c, uint32_t column) { return c.column < column; });
  const CellLoops loops = find_loops(found->corners, found->centres);
  const CellFace& edges = cell_faces[face];
  return loops.of_edge[edges.edges[0]] == loops.of_edge[edges.edges[2]];
}

// Each face is seen from the cell behind it.
void MeshTopology::find_arcs(uint32_t k) {
  Layer& layer = layers_[k - first_];
  const CellTable& table = cell_table();
  for (uint32_t j = 0; j < layer.ambiguous.size(); ++j)
    for (const AmbiguousCell& cell : layer.ambiguous[j])
      for (int axis = 0; axis < 3; ++axis) {
        const unsigned face = 2 * static_cast<unsigned>(axis);
        if (!(table.ambiguous[cell.corners] >> face & 1)) continue;
        AmbiguousCell other = cell;
        if (axis == 0) --other.column;
        if (!joins_arcs(k, j, cell, face) ||
            !joins_arcs(k - (axis == 2), j - (axis == 1), other, face + 1))
          continue;
        const bool centre = cell.centres >> face & 1;
        for (uint8_t q = 0; q < 4; ++q) {
          const bool corner = cell.corners >> cell_faces[face].corners[q] & 1;
          if (corner == centre) continue;
          const uint32_t vertex = static_cast<uint32_t>(vertices_++);
          layer.arcs.push_back({{cell.column, j, k}, static_cast<uint8_t>(face), q, corner});
          for (const unsigned turn : {q + 3u, q + 0u}) {
            const unsigned edge = cell_faces[face].edges[turn % 4];
            const unsigned a = place_around_edge(edge), b = place_around_edge(mirrored(edge, axis));
            const unsigned side = (a + 1) % 4 == b ? a : b;
            on_sides_[{grid_edge(cell.column, j, k, edge), side}] = vertex;
          }
        }
      }
}

uint32_t MeshTopology::middle(const GridEdge& edge) const {
  const Layer& l = layer(edge.layer);
  const auto found = std::lower_bound(l.middles.begin(), l.middles.end(), edge);
  return static_cast<uint32_t>(l.first_vertex + l.vertices - l.middles.size() +
                               static_cast<uint64_t>(found - l.middles.begin()));
}

}  // namespace msq
