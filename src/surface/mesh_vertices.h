// SPDX-License-Identifier: Apache-2.0
// The places and normals of the vertices of a mesh: the quadric of the crossings of a loop says
// where, and a ray from there finds the boundary.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/job.h"
#include "model/model.h"
#include "surface/boundary_ways.h"
#include "surface/mesh_edges.h"
#include "surface/mesh_topology.h"

namespace msq {

class MeshVertices {
 public:
  MeshVertices(const Model& model, const Scales& resolved, const MeshNodes& nodes)
      : model_(model), resolved_(resolved), nodes_(nodes) {}

  /// Finds the vertices of the cells of layers [first, end), and tells the crossings. Forgets all
  /// but those of the layer before them.
  void find(const MeshTopology& topology, MeshEdges& edges, uint32_t first, uint32_t end, Job* job);

  /// Number of the first that is known, in the mesh.
  uint64_t first() const { return first_; }
  const std::vector<Vec3>& places() const { return places_; }
  const std::vector<Vec3>& normals() const { return normals_; }

  /// Bytes of working memory for a vertex.
  static constexpr uint64_t bytes = 2 * sizeof(Vec3) + sizeof(Vec3) + 4 * sizeof(uint32_t);

 private:
  /// What is known of a vertex of a cell before it is placed.
  struct Seed {
    uint32_t cell[3];
    uint8_t corners;
    uint8_t faces;         // of the box, on which it lies: by axis, as bits
    uint16_t edges, onto;  // of the loop, as bits; of these, those that cross on faces of the box
  };
  void find_seeds(const MeshTopology& topology, MeshEdges& edges, uint32_t first, uint32_t end,
                  const Job* job);
  void place_on_boundary(uint64_t from, Job* job);
  void place_by_membership(const std::vector<uint64_t>& left, const Job* job);
  void take_normals(std::span<const uint64_t> vertices, std::span<const BoundaryWay> ways,
                    const Job* job);
  void place_others(const MeshTopology& topology, const MeshEdges& edges, uint32_t k,
                    const Job* job);
  Vec3 on_faces(const Seed& seed, Vec3 at) const;
  bool comes_from_face(const Ray& ray, Seed& seed) const;
  bool find_other(Seed& seed, Vec3 place, bool is_inside, Vec3& other) const;
  static Vec3 face_normal(const Seed& seed, Vec3 outward);

  const Model& model_;
  const Scales& resolved_;
  const MeshNodes& nodes_;
  uint64_t first_ = 0;
  std::vector<Vec3> places_, normals_;
  std::vector<Seed> seeds_;  // no edges: not of a cell
};

}  // namespace msq
