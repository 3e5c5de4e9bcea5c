// SPDX-License-Identifier: Apache-2.0
// Rays through functional structures in warped cells, or in those of a sampled map. The cells fill
// a shell, or a box, so a ray is searched in the one or two parts of it that are in there; at their
// ends the shell or the box is the boundary.
#pragma once

#include <optional>

#include "structure/common/ray_parts.h"
#include "structure/common/warp_shell.h"
#include "structure/functional/functional.h"

namespace msq {

class ShellRays {
 public:
  /// The job may be null.
  ShellRays(const Functional& solid, const Job* job)
      : solid_(solid), map_(solid.angles().sampled()), job_(job) {
    if (solid.angles().warp()) shell_.emplace(*solid.angles().warp());
  }

  /// As Structure::enter() and Structure::leave().
  void enter(RaySearch* searches, size_t count) const;
  double leave(const Ray& ray, double from, double to) const;

 private:
  /// Of [from, to]. Both ends are in the shell.
  RayParts parts_of(const Ray& ray, double from, double to) const;
  bool is_in_shell(const Ray& ray, double t) const { return solid_.angles().holds(ray.at(t)); }
  RayParts parts_of_box(const Ray& ray, double from, double to) const;
  Vec3 normal_of_shell(Vec3 p) const;

  const Functional& solid_;
  std::optional<WarpShell> shell_;  // of a warp
  const SampledMap* const map_;
  const Job* const job_;
};

}  // namespace msq
