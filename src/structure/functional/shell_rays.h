// SPDX-License-Identifier: Apache-2.0
// Rays through functional structures in warped cells. The cells fill a shell, so a ray is searched
// in the one or two parts of it that are in the shell; at their ends the shell is the boundary.
#pragma once

#include "structure/functional/functional.h"

namespace msq {

class ShellRays {
 public:
  /// The job may be null.
  ShellRays(const Functional& solid, const Job* job)
      : solid_(solid), warp_(*solid.angles().warp()), job_(job) {}

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
  bool is_in_shell(const Ray& ray, double t) const {
    return warp_.is_in_shell(warp_.radius(ray.at(t)));
  }
  Vec3 normal_of_shell(Vec3 p) const;

  const Functional& solid_;
  const Warp& warp_;
  const Job* const job_;
};

}  // namespace msq
