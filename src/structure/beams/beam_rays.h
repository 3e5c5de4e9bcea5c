// SPDX-License-Identifier: Apache-2.0
// Where rays enter and leave beams. The tree finds the beams along the ray. Formulas give the entry
// into each part, and membership in the part corrects it.
#pragma once

#include "base/ray.h"
#include "structure/beams/beam_parts.h"

namespace msq {

class Beams;

class BeamRays {
 public:
  /// `beams` must stay alive.
  explicit BeamRays(const Beams& beams);

  /// Sets `found`, `t` and `normal`, as Structure::enter().
  void enter(RaySearch& search) const;
  /// As Structure::leave().
  double leave(const Ray& ray, double from, double to, const Job* job) const;
  /// As Structure::normal().
  Vec3 normal(const Ray& ray, double t) const;

 private:
  /// Finds the first t in [from, to] at which the part contains the ray's point, for a ray that is
  /// in the part from about `enter` to about `leave`.
  bool settle(const BeamPart& part, const Ray& ray, double enter, double leave, double from,
              double to, double& t) const;

  const Beams& beams_;
  const double tolerance_, formula_error_;
};

}  // namespace msq
