// SPDX-License-Identifier: Apache-2.0
// Rays through a model: where each first meets the solid.
// Source: paper, section "Set Queries for Ray-Casting": scale by scale, each evaluated only within
// the parts of the ray inside the coarser scales.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/job.h"
#include "base/ray.h"
#include "cell/neighbourhood.h"
#include "model/model.h"
#include "ray/ray_order.h"

namespace msq {

struct RayHit {
  double t = 0;
  int32_t scale = -1;   ///< whose surface was hit; -1: none was
  uint32_t region = 0;  ///< of a model of regions
  bool starts_inside = false;
  Vec3 normal;
  /// On the boundary, on the inner side, as precise as numbers of the shape's magnitude are.
  Vec3 point;
};

/// Rays of a batch.
constexpr uint64_t ray_batch = 1024;

/// Pixel of ray n, below ray_batch, in a tile of tile_side x tile_side pixels: every 16 rays from a
/// multiple of 16 on are a block of 4 x 4, every 64 one of 8 x 8 (Morton's order).
struct TilePixel {
  uint32_t x, y;
};
constexpr uint32_t tile_side = 32;
constexpr TilePixel tile_pixel(uint32_t n) {
  TilePixel pixel{0, 0};
  for (uint32_t bit = 0; bit < 5; ++bit) {
    pixel.x |= (n >> (2 * bit) & 1) << bit;
    pixel.y |= (n >> (2 * bit + 1) & 1) << bit;
  }
  return pixel;
}

/// Takes the hits of rays, which are given by their numbers.
using TakeHits = std::function<void(std::span<const uint64_t> rays, const RayHit* hits)>;

/// Fills, casts and takes the rays [0, count) batch by batch, in parallel. t is relative to the
/// ray's origin. The hit of a ray does not depend on the other rays or on their order. If rays
/// through structures are not close together already, they are sorted so that they are (RayOrder),
/// up to RayOrder::most at once, as far as the memory budget allows.
void cast_rays(const Model& model, const Scales& resolved, uint64_t count, const FillRays& fill,
               const TakeHits& take, Job* job);

/// The cell of the finest scale that contains a hit; 0, 0, 0 for a miss and if there is none.
CellIndex cell_of(const Scales& resolved, const RayHit& hit);

/// Id of the material at a hit; 0 for a miss and if there is none. `part`: as in Skin::find().
uint32_t material_id(const Model& model, const Scales& resolved, const RayHit& hit, uint32_t& part);

/// Builds the data of the model that rays need, if any. Call it before cast_batch().
void prepare_rays(const Model& model, const Scales& resolved, const Job* job);

/// The required data of hits. `place`: only whether there is a hit, t and point.
enum class HitDetail { all, place };

/// Casts rays on the calling thread. Sets hits[i] to the hit of searches[i]; overwrites the
/// searches.
void cast_batch(const Model& model, const Scales& resolved, std::vector<RaySearch>& searches,
                std::vector<RayHit>& hits, HitDetail detail, const Job* job);

/// How far past their ends rays are followed: what begins at an end is found within the tolerances
/// of shape and scales past it.
double way_past_end(const Model& model, const Scales& resolved);
/// The same for one ray, in a model that has no bounds.
double way_past_end(const Model& model, const Scales& resolved, const Ray& ray, double to);

/// Moves the origin of a ray, which meets a box at t = low, there: no number of the ray is then
/// larger than the box's. `offset` becomes the way from the old origin to the new one, `end` the t
/// from the new one up to which the ray is followed, which is s.to and `past` more, or where it
/// leaves the box. False where it misses the box. `near`: the box, and rounding.
bool move_to_box(const Box3& box, const Box3& near, double low, double high, double past,
                 RaySearch& s, double& offset, double& end);

}  // namespace msq
