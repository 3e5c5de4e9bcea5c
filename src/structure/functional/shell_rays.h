// SPDX-License-Identifier: Apache-2.0
// Rays through functional structures in warped cells, or in those of a sampled map. The cells fill
// a shell, or a box, so a ray is searched in the one or two parts of it that are in there; at their
// ends the shell or the box is the boundary.
#pragma once

#include <memory>

#include "structure/common/cell_shell.h"
#include "structure/functional/functional.h"

namespace msq {

class ShellRays {
 public:
  /// The job may be null.
  ShellRays(const Functional& solid, const Job* job)
      : solid_(solid), shell_(solid.angles().shell()), job_(job) {}

  /// As Structure::enter() and Structure::leave().
  void enter(RaySearch* searches, size_t count) const;
  double leave(const Ray& ray, double from, double to) const;

 private:
  /// Of [from, to]. Both ends are in the shell.
  RayParts parts_of(const Ray& ray, double from, double to) const;

  const Functional& solid_;
  const std::unique_ptr<const CellShell> shell_;
  const Job* const job_;
};

}  // namespace msq
