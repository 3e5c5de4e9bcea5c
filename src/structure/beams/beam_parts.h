// SPDX-License-Identifier: Apache-2.0
// The convex parts whose union is a beam, and where rays meet them.
#pragma once

#include "base/ray.h"
#include "structure/beams/beam.h"

namespace msq {

struct BeamPart {
  enum Kind { between, at_a, at_b };
  static constexpr Kind kinds[] = {between, at_a, at_b};

  const Beam& beam;
  Kind kind;

  /// Whether the beam has it.
  bool exists() const {
    return kind == between ? beam.has_length()
                           : (kind == at_a ? beam.cap_a : beam.cap_b) != BeamCap::butt;
  }
  bool holds(Vec3 p) const {
    return kind == between ? beam.holds_between(p)
           : kind == at_a  ? beam.holds_at_a(p)
                           : beam.holds_at_b(p);
  }

  /// Computes where a ray is in the part. The error is rounding, which grows where the ray grazes
  /// the part. Returns false if the ray certainly misses it.
  bool meet(const Ray& ray, double& enter, double& leave) const;

  /// The face of the part nearest to a point inside or just outside the part.
  struct Face {
    double above;  ///< approximate distance of the point above the face
    Vec3 normal;   ///< outward, of length 1; 0 for a tip, and for faces within the beam
  };
  Face face_at(Vec3 p) const;
};

}  // namespace msq
