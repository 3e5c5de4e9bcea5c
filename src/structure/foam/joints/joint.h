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
// Which are on one sphere is decided exactly (exact_seeds.h).
//
// Where seeds are almost on one sphere, bricks may lack edges, or have vertices in wrong places:
// they are found with tolerances. Then joints lead to each other: three seeds that one joint has on
// a face of their hull are on an edge, and the vertex at its other end follows.
#pragma once

#include <vector>

#include "base/id_hash.h"
#include "structure/foam/joints/exact_seeds.h"
#include "structure/foam/joints/named_seeds.h"

namespace msq {

struct Joint {
  Id id;
  std::vector<NamedSeed> seeds;  ///< in the order of seeds, four to max_near
  Vec3 position;                 ///< diagram units from the corner of the first seed's cell
};

/// The seeds, by bits, of a face of the hull of a joint's seeds: all that are equally far from the
/// points of one edge.
using JointFace = uint32_t;

class JointFinder {
 public:
  /// No arrangement of seeds on a grid has as many about a vertex. A place with more is left out;
  /// joints about it lead there (follow()).
  static constexpr size_t max_near = 24;

  /// Before others: the seeds that the following calls refer to.
  void move_to(NamedSeeds& seeds) {
    seeds_ = &seeds;
    exact_ = ExactSeeds(seeds.scale());
  }

  /// Calls take(joint) for the vertices about p, the rounded position of one in a brick, within
  /// `error`. In the space of the diagram. The joint may be moved from. Returns whether one of them
  /// is the one at p for certain.
  template <class Take>
  bool find(Vec3 p, double error, Take&& take) {
    const bool is_certain = gather(p, error);
    for (Joint& joint : joints_) take(joint);
    return is_certain;
  }

  /// Calls take(face) for the faces of the hull of a joint's seeds.
  template <class Take>
  void for_each_face(const Joint& joint, Take&& take) {
    if (joint.seeds.size() == 4) {
      for (JointFace left_out = 8; left_out; left_out >>= 1) take(JointFace{15} ^ left_out);
      return;
    }
    find_faces(joint);
    for (const JointFace face : faces_) take(face);
  }

  /// Finds the joint at the other end of the edge of a face. One of the face's seeds is in the
  /// brick. Returns false if it is not found, which rounding does not cause for seeds of a foam.
  bool follow(const Joint& joint, JointFace face, Joint& other);

 private:
  /// Three seeds of a face, those with the greatest area.
  struct Three {
    const NamedSeed* seed[3];
    ExactSeeds::Seed at[3];  ///< from the cell of the joint's first seed
    Vec3 normal;             ///< of length 1, away from the other seeds
    int outward;             ///< ExactSeeds::side() there
  };
  bool choose(const Joint& joint, JointFace face, Three& three) const;

  bool gather(Vec3 p, double error);
  /// Takes the vertex of near_, which are four. Returns false if it is not at p.
  bool take_four(Vec3 p, double within);
  /// Tries each four of near_. Returns whether brick and vertices agree beyond doubt.
  bool try_all(Vec3 p, double within);
  /// Fills faces_, for more than four seeds.
  void find_faces(const Joint& joint);
  /// A point that is given from the corner of a cell, from the brick's.
  Vec3 from_corner(CellIndex cell, Vec3 p) const;
  /// Sets the position. Returns false if the seeds are in a plane.
  bool place(Joint& joint) const;

  NamedSeeds* seeds_ = nullptr;
  ExactSeeds exact_{{1, 1, 1}};
  std::vector<NamedSeed> near_;
  std::vector<Joint> joints_;
  std::vector<JointFace> faces_, planes_;  // planes: faces, and others of more than three seeds
};

/// The point equally far from four seeds, by lifted distances (seeds/seeds.h), in double precision.
/// Returns six times the volume of their tetrahedron over the product of its edges at the first
/// one: the error is about 2^-53 over that. Returns 0 if they are in a plane, as far as that tells.
double find_circumcentre(const LiftedSeed (&seeds)[4], Vec3& centre);

}  // namespace msq
