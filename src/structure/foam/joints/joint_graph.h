// SPDX-License-Identifier: Apache-2.0
// The joints about a brick of cells and the edges between them.
//
// The faces of the hulls of joints' seeds are those of the Delaunay diagram: each is that of two
// joints, the ends of one edge. A face that one joint has alone leads to the other
// (JointFinder::follow()). The edges that a seed owns hang together by the faces at the seed. So if
// a brick of edges has missed some, all faces with a seed in the brick are followed.
#pragma once

#include <cstdint>
#include <vector>

#include "base/id_table.h"
#include "structure/foam/joints/joint.h"

namespace msq {

class JointGraph {
 public:
  /// Before others: a brick of side^3 cells, and about how many joints there will be. The seeds
  /// must remain.
  void start(NamedSeeds& seeds, CellIndex corner, int side, size_t expected);
  /// Adds the joints at p, the rounded position of a vertex, within `error` (JointFinder::find()).
  void add_at(Vec3 p, double error);
  /// Finds the edges whose first seed is in the brick, and the joints that are missing.
  void find_edges();

  struct Edge {
    Id id;             ///< of the names of its seeds
    uint32_t ends[2];  ///< joints; only one is known while both are equal
    JointFace face;    ///< of the first
  };
  const std::vector<Joint>& joints() const { return joints_; }
  /// After find_edges(). May contain edges that others own.
  const std::vector<Edge>& edges() const { return edges_; }
  /// The first seed of an edge.
  const NamedSeed& owner(const Edge& edge) const;
  bool is_owned(const Edge& edge) const { return is_in_brick(owner(edge).cell); }

  size_t bytes() const {
    return joints_.capacity() * (sizeof(Joint) + 4 * sizeof(NamedSeed)) +
           edges_.capacity() * sizeof(Edge) + by_id_.bytes() + by_seeds_.bytes();
  }

 private:
  bool is_in_brick(CellIndex cell) const;
  /// Adds a joint unless it is there.
  void add(Joint&& joint);
  /// Adds the faces of a joint: those that the brick owns, or all with a seed in it.
  void add_faces(uint32_t joint, bool all);
  void add_all_faces(bool all);
  void follow_faces(bool all);
  bool has_open() const;

  JointFinder finder_;
  CellIndex corner_;
  int side_ = 0;
  bool is_certain_ = true;
  std::vector<Joint> joints_;
  std::vector<Edge> edges_;
  IdTable by_id_, by_seeds_;
};

}  // namespace msq
