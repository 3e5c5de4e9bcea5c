// SPDX-License-Identifier: Apache-2.0
// Joints of a foam: the vertices of the Voronoi diagram, where struts meet.
//
// A vertex is equally far from four seeds, or more, and no seed is nearer. Its seeds name it, and
// its position follows from them in double precision, computed in the same way wherever it is
// found. Distances are lifted ones if seeds have weights (seeds/seeds.h). So the result does not
// depend on the brick of edges that led to it, whose positions are rounded to single precision
// (edges/edge_brick.h).
//
// A rounded position is within edge_error of the vertex, so the vertex's seeds are farther from it
// than the nearest one by at most twice that. Usually these are four seeds. If there are more,
// because vertices are close together or seeds are on one sphere, each four of them are tried.
#pragma once

#include <vector>

#include "base/id_hash.h"
#include "structure/foam/joints/named_seeds.h"

namespace msq {

struct Joint {
  Id id;
  std::vector<NamedSeed> seeds;  ///< in the order of seeds, at least four
  Vec3 position;                 ///< diagram units from the corner of the first seed's cell
};

/// Seeds that are farther from a vertex than its nearest one by this, in foam units, count as
/// equally far.
constexpr double equally_far = 1e-13;

class JointFinder {
 public:
  /// Calls take(joint) for the vertices about p, the rounded position of one in a brick, within
  /// `error`; among them is that one. In the space of the diagram. The joint may be moved from.
  template <class Take>
  void find(NamedSeeds& seeds, Vec3 p, double error, Take&& take) {
    gather(seeds, p, error);
    for (Joint& joint : joints_) take(joint);
  }

 private:
  void gather(NamedSeeds& seeds, Vec3 p, double error);
  void try_all(const NamedSeeds& seeds, Vec3 p, double within);

  std::vector<NamedSeed> near_;
  std::vector<Joint> joints_;
};

/// The point equally far from four seeds, by lifted distances (seeds/seeds.h). Returns false if
/// they are in a plane.
bool find_circumcentre(const LiftedSeed (&seeds)[4], Vec3& centre);
/// Whether three seeds are on a line.
bool are_collinear(const NamedSeed& a, const NamedSeed& b, const NamedSeed& c, Vec3 scale);

}  // namespace msq
