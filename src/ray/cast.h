// SPDX-License-Identifier: Apache-2.0
// Rays through a model: where each first meets the solid.
// Source: paper, section "Set Queries for Ray-Casting": scale by scale, each asked only within the
// parts of the ray that the scales above it hold.
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
  int32_t scale = -1;  ///< whose surface was hit; -1: none was
  bool starts_inside = false;
  Vec3 normal;
  /// On the boundary, on the inside, to the accuracy of numbers no larger than the shape's.
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

/// Takes what rays, by their numbers, meet.
using TakeHits = std::function<void(std::span<const uint64_t> rays, const RayHit* hits)>;

/// Fills, casts and takes the rays [0, count) batch by batch, in parallel. t is from the ray's
/// origin on. What a ray meets does not depend on the others, nor on their order: rays through
/// structures that do not lie together already are cast in an order in which they do (RayOrder), up
/// to RayOrder::most at once, as far as the memory budget has room.
void cast_rays(const Model& model, const Scales& resolved, uint64_t count, const FillRays& fill,
               const TakeHits& take, Job* job);

/// The cell of the finest scale that a hit is in; 0, 0, 0 in a miss and where there is none.
CellIndex cell_of(const Scales& resolved, const RayHit& hit);

/// Id of the material at a hit, 0 in a miss and where there is none. `part`: as in Skin::find().
uint32_t material_id(const Model& model, const Scales& resolved, const RayHit& hit, uint32_t& part);

/// Builds what rays need of the model, if anything. Before cast_batch().
void prepare_rays(const Model& model, const Scales& resolved);

/// What is wanted of hits. `place`: no more than whether there is one, t and point.
enum class HitDetail { all, place };

/// Casts rays on the calling thread: hits[i] becomes what searches[i], which are used up, meet.
void cast_batch(const Model& model, const Scales& resolved, std::vector<RaySearch>& searches,
                std::vector<RayHit>& hits, HitDetail detail, const Job* job);

}  // namespace msq
