// SPDX-License-Identifier: Apache-2.0
// Renders pictures of a model from the rays of a camera, tile by tile and pass by pass.
#pragma once

#include <functional>

#include "base/job.h"
#include "ray/camera.h"
#include "ray/shade.h"

namespace msq {

/// Output for the pixels of a tile; null outputs are skipped. Pixel (i, j), j from the top down, is
/// at j * row_pixels + i. See msq_frame in msq.h.
struct Frame {
  uint64_t row_pixels = 0;
  float* depth = nullptr;
  float* normal = nullptr;
  int32_t* scale = nullptr;
  uint32_t* material = nullptr;
  uint8_t* rgba = nullptr;

  bool has_data() const { return depth || normal || scale || material; }
};

constexpr uint32_t max_render_samples = 16;

struct RenderPlan {
  uint32_t tile_x = 0, tile_y = 0, tile_width = 0, tile_height = 0;  ///< within the view's pixels
  uint32_t samples = 1;     ///< of colour, along each side of a pixel: at most max_render_samples
  uint32_t first_step = 1;  ///< a power of two
  Shading shading;
};

struct RenderPass {
  uint32_t step = 1;     ///< pixels along each side of the blocks that share a ray
  uint32_t samples = 1;  ///< along each side of a pixel
  bool is_last = false;
};

/// Fills the frame. on_pass, which may be null, is called after each pass on the calling thread. If
/// it is null there is only one step. The bits of the last pass do not depend on earlier passes.
void render(const Model& model, const Scales& resolved, const View& view, const RenderPlan& plan,
            const Frame& frame, const std::function<void(const RenderPass&)>& on_pass, Job* job);

}  // namespace msq
