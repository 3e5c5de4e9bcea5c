// SPDX-License-Identifier: Apache-2.0
// The colour that a ray of a camera sees.
#pragma once

#include <vector>

#include "ray/camera.h"
#include "ray/cast.h"
#include "ray/colour.h"

namespace msq {

enum class ColourBy { plain = 0, scale = 1, material = 2, normal = 3 };

struct Shading {
  ColourBy colour_by = ColourBy::plain;
  std::vector<Vec3> colours;  ///< not empty
  Colour background;
  Vec3 light{-0.4, 0.6, 1};  ///< direction to it: right, up, towards the eye; of any length but 0
  double ambient = 0.3;
  bool has_shadows = false;
  uint32_t occlusion_rays = 0;
  double occlusion_distance = 0;  ///< 0: a tenth of the diagonal of the model's bounds
};

/// One ray of a camera and what it met.
struct Seen {
  uint64_t pixel;   ///< unique among the pixels of the picture
  uint32_t sample;  ///< among those of the pixel
  double depth;
  uint32_t material;
};

class Shader {
 public:
  Shader(const Model& model, const Scales& resolved, const View& view, const Shading& shading);

  /// Sets colours[i] to the colour of hits[i]; pixels have `samples` rays. Casts rays towards the
  /// light and all around if the shading needs them, on the calling thread.
  void shade(const std::vector<Seen>& seen, uint32_t samples, const std::vector<RayHit>& hits,
             std::vector<Colour>& colours, const Job* job) const;

 private:
  /// How far above a hit rays begin.
  double offset_of(const RayHit& hit) const;
  Vec3 base_colour(const RayHit& hit, uint32_t material) const;
  RaySearch search_from(const Seen& seen, const RayHit& hit, Vec3 direction, double reach) const;
  /// Sets lit[i] to whether nothing is between hits[i] and the light.
  void find_lit(const std::vector<Seen>& seen, const std::vector<RayHit>& hits,
                std::vector<uint8_t>& lit, const Job* job) const;
  /// Sets open[i] to the fraction of the directions around hits[i] that nothing blocks.
  void find_open(const std::vector<Seen>& seen, uint32_t samples, const std::vector<RayHit>& hits,
                 std::vector<float>& open, const Job* job) const;

  const Model& model_;
  const Scales& resolved_;
  const View& view_;
  const Shading& shading_;
  Vec3 light_;                   ///< unit, in the model's frame
  double reach_;                 ///< of occlusion rays
  std::vector<double> offsets_;  ///< by scale, where the model has bounds
};

}  // namespace msq
