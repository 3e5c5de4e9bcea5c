// SPDX-License-Identifier: Apache-2.0
#include "api/warp.h"

#include "api/guard.h"

namespace msq::api {

namespace {

msq_warp_def warp_defaults() {
  msq_warp_def def{};
  def.kind = MSQ_WARP_CYLINDRICAL;
  return def;
}

static_assert(static_cast<int>(Warp::Kind::cylindrical) == MSQ_WARP_CYLINDRICAL &&
              static_cast<int>(Warp::Kind::spherical) == MSQ_WARP_SPHERICAL);

}  // namespace

std::optional<Warp> read_warp(const msq_warp_def*& def, msq_warp_def& known,
                              const Neighbourhood& grid) {
  if (!def) return {};
  known = read_def(def, warp_defaults(), "warp");
  def = &known;
  const auto kind = static_cast<Warp::Kind>(
      require_range(known.kind, MSQ_WARP_CYLINDRICAL, MSQ_WARP_SPHERICAL, "warp.kind"));
  return Warp(kind, grid, {known.count, known.count_polar, known.inner_radius, known.outer_radius});
}

}  // namespace msq::api

using namespace msq;
using namespace msq::api;

msq_status msq_warp_def_init(msq_warp_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, warp_defaults(), "msq_warp_def"); });
}
