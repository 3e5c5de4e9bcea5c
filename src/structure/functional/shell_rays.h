// SPDX-License-Identifier: Apache-2.0
// Rays through functional structures in warped cells, or in those of a sampled map. The cells fill
// a shell, or a box, so a ray is searched in the one or two parts of it that are in there; at their
// ends the shell or the box is the boundary.
#pragma once

#include "structure/functional/functional.h"

namespace msq {

class ShellRays {
 public:
  /// The job may be null.
  ShellRays(const Functional& solid, const Job* job)
      : solid_(solid),
        warp_(solid.angles().warp() ? &*solid.angles().warp() : nullptr),
        map_(solid.angles().sampled()),
        job_(job) {}

  /// As Structure::enter() and Structure::leave().
  void enter(RaySearch* searches, size_t count) const;
  double leave(const Ray& ray, double from, double to) const;

 private:
  struct Part {
    double from, to;
    bool is_entry;  // whether the ray enters the shell at `from`
  };
  struct Parts {
    Part part[2];
    size_t count = 0;
  };
  /// Of [from, to]. Both ends are in the shell.
  Parts parts_of(const Ray& ray, double from, double to) const;
  bool is_in_shell(const Ray& ray, double t) const { return solid_.angles().holds(ray.at(t)); }
  Parts parts_of_box(const Ray& ray, double from, double to) const;
  /// Moves an end that rounding has put outside of the shell towards `end`; infinite, away from it,
  /// if nothing of the shell is found.
  double settle(const Ray& ray, double t, double end, double tolerance) const;
  Vec3 normal_of_shell(Vec3 p) const;

  const Functional& solid_;
  const Warp* const warp_;
  const SampledMap* const map_;
  const Job* const job_;
};

}  // namespace msq
