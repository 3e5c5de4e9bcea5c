// SPDX-License-Identifier: Apache-2.0
// Sums of waves.
#include "structure/waves/waves.h"

#include "api/definitions.h"
#include "api/guard.h"
#include "api/level.h"
#include "api/neighbourhood.h"
#include "base/pi.h"

using namespace msq;
using namespace msq::api;

namespace {

constexpr uint32_t max_waves = 4096, max_tile = uint32_t{1} << 20;
constexpr double min_cone = 0.1, max_cone = 90;

msq_waves_def waves_defaults() {
  msq_waves_def def{};
  def.kind = MSQ_FUNCTIONAL_NETWORK;
  def.count = 256;
  def.cone_angles[0] = max_cone;
  def.grid = neighbourhood_defaults();
  return def;
}

WaveDirections read_directions(const msq_waves_def& def) {
  if (def.count < 1 || def.count > max_waves)
    fail(Status::argument, "count is %u; it must be from 1 to %u", def.count, max_waves);
  WaveDirections directions;
  directions.seed = def.seed;
  directions.count = def.count;
  for (int axis = 0; axis < 3; ++axis) {
    const uint32_t tile = def.tile[axis];
    if (tile > max_tile)
      fail(Status::argument, "tile[%d] is %u; the limit is %u", axis, tile, max_tile);
    directions.tile[axis] = tile;
    const double angle = def.cone_angles[axis];
    if (angle != 0 && !(angle >= min_cone && angle <= max_cone))
      fail(Status::argument, "cone_angles[%d] is %g degrees; it must be 0, or from %g to %g", axis,
           angle, min_cone, max_cone);
    directions.half_angles[axis] = angle * (pi / 180);
  }
  if (max_component(directions.half_angles) == 0)
    fail(Status::argument, "cone_angles are all 0; at least one must be %g degrees or more",
         min_cone);
  return directions;
}

Parameter read_waves_level(const msq_waves_def& def) {
  const double fraction = def.volume_fraction;
  if (fraction == 0) return read_level(def.level, def.kind);
  if (!(fraction > 0 && fraction < 1))
    fail(Status::argument, "volume_fraction is %g; it must be above 0 and below 1, or 0", fraction);
  if (def.level.field || def.level.value != 0)
    fail(Status::argument, "both level and volume_fraction are given; waves take one of them");
  return Parameter(gaussian_level(fraction, def.kind == MSQ_FUNCTIONAL_SHEET));
}

}  // namespace

msq_status msq_waves_def_init(msq_waves_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, waves_defaults(), "msq_waves_def"); });
}

msq_status msq_structure_waves(msq_context* context, const msq_waves_def* def,
                               msq_structure** structure) {
  return guard([&] {
    object(context, "context");
    require(structure, "structure");
    msq_waves_def known = read_def(def, waves_defaults(), "def");
    const Neighbourhood grid = read_neighbourhood(known.grid);
    const int32_t kind =
        require_range(known.kind, MSQ_FUNCTIONAL_NETWORK, MSQ_FUNCTIONAL_SHEET, "kind");
    const WaveDirections directions = read_directions(known);
    const Ref<Structure> made =
        make_ref<Waves>(grid, directions, static_cast<WavesKind>(kind), read_waves_level(known));
    keep(*made, known);
    *structure = new_handle<msq_structure>(made);
  });
}
