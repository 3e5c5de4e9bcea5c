// SPDX-License-Identifier: Apache-2.0
// The Voronoi cells of seeds of which there are more than one in a cell of the grid
// (seeds/graded_seeds.h), one after the other.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "structure/foam/edges/clipped_cell.h"
#include "structure/foam/edges/voronoi_cell.h"
#include "structure/foam/seeds/seed_trees.h"

namespace msq {

/// Works for one brick after another and reuses its memory.
class GradedCells {
 public:
  void move_to(const std::shared_ptr<const GradedSeeds>& seeds, CellIndex home);
  size_t bytes() const { return sizeof *this + trees_.bytes(); }

  /// Appends the seeds of a cell of the grid, in order.
  void append_seeds(CellIndex cell, std::vector<LeafSeed>& seeds);

  /// Finds the Voronoi cell of a seed.
  void find(const LeafSeed& own);

  // After find(), relative to the seed and in sizes of its leaf, unless stated otherwise:
  double unit() const { return unit_; }  ///< size of the leaf, foam units
  struct Seed {
    uint64_t order;
    int level;
  };
  struct Edge {
    Vec3 from, to;
    std::array<Seed, 2> others;
    bool is_sure;  // that these are its seeds, and that no other is equally near
  };
  /// The edges whose first seed is the own one.
  const std::vector<Edge>& owned_edges() const { return edges_; }
  /// Fills `neighbours` with seeds whose planes bound the cell, and perhaps others. The box holds
  /// the vertices. All in foam units from the seed.
  void find_faces(std::vector<Vec3>& neighbours, Box3& box);
  /// The cell, if a walk found it: its planes with edges are those of find_faces(), in order.
  const VoronoiCell* walked() const { return way_ == Way::walked ? &cell_ : nullptr; }

 private:
  struct Neighbour {
    Vec3 at;
    double half_squared;  // of its length
    uint64_t order;
    int level;
  };
  enum class Way { walked, clipped, tried };

  Neighbour neighbour(const LeafSeed& seed) const;
  static std::array<Seed, 2> others(const Neighbour& a, const Neighbour& b);
  static uint32_t octant(Vec3 v) { return (v.x > 0) | (v.y > 0) << 1 | (v.z > 0) << 2; }
  /// Gathers the seeds within D, which grows until they suffice for a cell, or shrinks until they
  /// are not too many.
  void gather();
  /// Adds the seeds of a twig that are within D.
  void add_near(const SeedTrees::Twig& twig);
  void choose_first();
  void add_nearest_in_octant(uint32_t wanted);
  void sort_planes();
  bool is_plane(uint64_t order) const;
  // Three ways to fill edges_, each more robust and slower than the one before; the first two
  // return whether they succeeded.

  bool walk();
  bool walk_once();
  bool clip();
  /// Every pair of neighbours, cut by all others.
  void try_pairs();
  void try_pairs_once();
  void sort_by_distance();
  /// Adds the seeds nearest to the vertices, if they are nearer than the own seed.
  bool add_violators();
  /// Finds the deepest of the seeds in memory in a vertex's ball.
  void check_near(Vec3 v);
  /// The same for all seeds. All points of the true cell are within the empty radius of the own
  /// seed. Let a vertex be farther away. Move it towards the own seed, to that distance: the ball
  /// about the new point lies in the vertex's ball, and already contains a seed. So searches stay
  /// close.
  void check_far(Vec3 v, double squared);

  SeedTrees trees_;
  CellIndex home_;
  Vec3 scale_;
  bool is_placed_ = false;
  double empty_radius_ = 0, first_reach_squared_ = 0;
  LeafSeed own_{};
  double unit_ = 1;                // size of the own leaf, in foam units
  double reach_squared_ = 0;       // D^2
  std::vector<Neighbour> near_;    // within D, in the order of seeds
  bool has_all_near_ = true;       // whether the planes include all of near_
  std::vector<Neighbour> planes_;  // of the cell, in the order of seeds
  std::vector<Neighbour> by_distance_, found_;
  VoronoiCell cell_;
  ClippedCell clipped_;
  std::vector<uint32_t> unproven_;  // vertices of clipped_ whose ball may contain a seed
  std::vector<Vec3> vertices_;
  std::vector<bool> is_used_;  // planes, in find_faces()
  std::vector<Edge> edges_;    // owned ones
  Way way_ = Way::walked;
};

}  // namespace msq
