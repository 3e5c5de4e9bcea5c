// SPDX-License-Identifier: Apache-2.0
// Replaces the search for self-intersections in builds without CGAL.
#include "base/status.h"
#include "shape/self_intersections.h"

namespace msq {

uint64_t count_self_intersections(const Mesh&, const Job*) {
  fail(Status::unsupported,
       "this build of msq has no search for self-intersections (MSQ_WITH_CGAL is off)");
}

}  // namespace msq
