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

namespace {

Ref<const GridField> read_samples(const msq_field* field, const char* name) {
  const Field& known = object(field, name);
  const auto* grid = dynamic_cast<const GridField*>(&known);
  if (!grid)
    fail(Status::argument, "%s is another field than one of samples (msq_field_grid)", name);
  return Ref<const GridField>(grid);
}

std::shared_ptr<const SampledMap> read_sampled(const msq_warp_def& def) {
  if (def.count || def.count_polar)
    fail(Status::argument, "warp.count is %u and warp.count_polar %u; of a sampled map both are 0",
         def.count, def.count_polar);
  if (def.inner_radius != 0 || def.outer_radius != 0)
    fail(Status::argument,
         "warp.inner_radius is %g and warp.outer_radius %g; of a sampled map both are 0",
         def.inner_radius, def.outer_radius);
  if (def.shear_outwards != 0 || def.shear_along != 0)
    fail(Status::argument,
         "warp.shear_outwards is %g and warp.shear_along %g; of a sampled map both are 0",
         def.shear_outwards, def.shear_along);
  return std::make_shared<const SampledMap>(SampledMap::Fields{
      read_samples(def.u, "warp.u"), read_samples(def.v, "warp.v"), read_samples(def.w, "warp.w")});
}

}  // namespace

CellMap read_warp(const msq_warp_def*& def, msq_warp_def& known, const Neighbourhood& grid) {
  if (!def) return {};
  known = read_def(def, warp_defaults(), "warp");
  def = &known;
  const int32_t kind =
      require_range(known.kind, MSQ_WARP_CYLINDRICAL, MSQ_WARP_SAMPLED, "warp.kind");
  if (kind == MSQ_WARP_SAMPLED) return {{}, read_sampled(known)};
  if (known.u || known.v || known.w)
    fail(Status::argument,
         "warp.u, v or w is given, but warp.kind is %d: only a sampled map has "
         "them",
         kind);
  return {Warp(static_cast<Warp::Kind>(kind), grid,
               {known.count, known.count_polar, known.inner_radius, known.outer_radius,
                known.shear_outwards, known.shear_along}),
          {}};
}

}  // namespace msq::api

using namespace msq;
using namespace msq::api;

msq_status msq_warp_def_init(msq_warp_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, warp_defaults(), "msq_warp_def"); });
}
