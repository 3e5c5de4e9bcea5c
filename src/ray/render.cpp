// SPDX-License-Identifier: Apache-2.0
#include "ray/render.h"

#include <array>
#include <cstring>

#include "base/borrowed.h"
#include "base/run_parts.h"
#include "base/simd.h"
#include "ray/search.h"

namespace msq {

namespace {

/// Points of a tile, ordered so that consecutive rays are close together.
constexpr auto tile_order = [] {
  std::array<TilePixel, ray_batch> order{};
  for (uint32_t n = 0; n < ray_batch; ++n) order[n] = tile_pixel(n);
  return order;
}();

/// Side of the squares of pixels whose samples are cast together: at most tile_side samples.
uint32_t square_side(uint32_t samples) {
  uint32_t side = tile_side;
  while (side * samples > tile_side) side /= 2;
  return side;
}

/// One pass over the tile: its pixels (step * i, step * j), except those of an earlier pass, each
/// with samples x samples rays.
struct Pass : RenderPass {
  bool leaves_out = false;  ///< those where i and j are even
  bool has_data = true, has_colour = true;
};

/// One ray of a tile.
struct Sample {
  uint32_t x, y;   // pixel of the tile
  uint32_t place;  // among the samples of the square, row by row
  double size;     // of the ray's direction
};

/// Memory of a thread, reused from batch to batch.
struct Batch {
  std::vector<Sample> samples;
  std::vector<RaySearch> searches;
  std::vector<RayHit> hits;
  std::vector<Seen> seen;
  std::vector<Colour> colours, square;

  void resize(size_t count) {
    samples.resize(count);
    searches.resize(count);
    seen.resize(count);
  }
};

class Renderer {
 public:
  Renderer(const Model& model, const Scales& resolved, const View& view, const RenderPlan& plan,
           const Frame& frame, Job* job)
      : model_(model),
        resolved_(resolved),
        view_(view),
        plan_(plan),
        frame_(frame),
        job_(job),
        shader_(model, resolved, view, plan.shading) {}

  void run(const std::function<void(const RenderPass&)>& on_pass) {
    const std::vector<Pass> passes = passes_of(static_cast<bool>(on_pass));
    for (const Pass& pass : passes) all_rays_ += rays_of(pass);
    prepare_rays(model_, resolved_, job_);
    for (const Pass& pass : passes) {
      run(pass);
      if (on_pass) on_pass(pass);
    }
  }

 private:
  std::vector<Pass> passes_of(bool are_seen) const {
    std::vector<Pass> passes;
    const bool has_sub_samples = frame_.rgba && plan_.samples > 1;
    const uint32_t first = are_seen ? plan_.first_step : 1;
    if (are_seen || frame_.has_data() || !has_sub_samples)
      for (uint32_t step = first; step > 0; step /= 2) {
        Pass pass;
        pass.step = step;
        pass.leaves_out = step < first;
        pass.has_colour = frame_.rgba && (are_seen || !has_sub_samples);
        passes.push_back(pass);
      }
    if (has_sub_samples) {
      Pass pass;
      pass.samples = plan_.samples;
      pass.has_data = false;
      passes.push_back(pass);
    }
    passes.back().is_last = true;
    return passes;
  }

  static uint64_t points_across(uint64_t pixels, uint64_t step) {
    return (pixels + step - 1) / step;
  }

  uint64_t rays_of(const Pass& pass) const {
    const uint64_t points =
        points_across(plan_.tile_width, pass.step) * points_across(plan_.tile_height, pass.step);
    return points * pass.samples * pass.samples;
  }

  void run(const Pass& pass) {
    const uint64_t side = square_side(pass.samples);
    const uint64_t across = points_across(points_across(plan_.tile_width, pass.step), side);
    const uint64_t down = points_across(points_across(plan_.tile_height, pass.step), side);
    const double rays = static_cast<double>(all_rays_), begin = static_cast<double>(rays_done_);
    rays_done_ += rays_of(pass);
    const Interval progress{begin / rays, static_cast<double>(rays_done_) / rays};
    run_parts(model_.executor(), across * down, job_, progress, [&](uint64_t index) {
      const auto x = static_cast<uint32_t>(index % across * side);
      const auto y = static_cast<uint32_t>(index / across * side);
      const Borrowed<Batch> borrowed;
      Batch& batch = *borrowed;
      fill(pass, x, y, batch);
      cast_batch(model_, resolved_, batch.searches, batch.hits, HitDetail::all, job_);
      see(pass, batch);
      if (pass.has_data) write_data(pass, batch);
      if (pass.has_colour) write_colour(pass, x, y, batch);
    });
  }

  /// Fills in the rays of the square of points that begins at point (x0, y0).
  void fill(const Pass& pass, uint32_t x0, uint32_t y0, Batch& batch) const {
    const uint32_t n = pass.samples, side = square_side(n) * n;
    struct Place {
      uint32_t pixel, sample;
      double middle;  // of the sample, from the pixel's corner
    };
    std::array<Place, tile_side> places;
    for (uint32_t i = 0; i < side; ++i) places[i] = {i / n, i % n, (i % n + 0.5) / n};
    const Camera& camera = view_.camera();
    const auto set_search = [&](double at_x, double at_y, double& size, RaySearch& search) {
      const Vec3 direction = view_.direction(at_x, at_y);
      size = size_of(direction);
      search_along(view_.origin(at_x, at_y), direction, size, camera.clip_near, camera.clip_far,
                   search);
    };
    double size;
    RaySearch first;  // for orthographic cameras: but for its origin, that of all pixels
    set_search(0, 0, size, first);
    batch.resize(ray_batch);
    size_t count = 0;
    for (const TilePixel& at : tile_order) {
      if (at.x >= side || at.y >= side) continue;
      const Place& right = places[at.x];
      const Place& down = places[at.y];
      const uint32_t i = x0 + right.pixel, j = y0 + down.pixel;
      const uint32_t x = i * pass.step, y = j * pass.step;
      if (x >= plan_.tile_width || y >= plan_.tile_height) continue;
      if (pass.leaves_out && i % 2 == 0 && j % 2 == 0) continue;
      const uint32_t picture_x = plan_.tile_x + x, picture_y = plan_.tile_y + y;
      const double at_x = picture_x + right.middle, at_y = picture_y + down.middle;
      RaySearch& search = batch.searches[count];
      if (camera.is_perspective) {
        search = {};
        set_search(at_x, at_y, size, search);
      } else {
        search = first;
        search.ray.origin = view_.origin(at_x, at_y);
      }
      const uint64_t pixel = uint64_t{picture_y} * view_.width() + picture_x;
      batch.samples[count] = {x, y, at.y * side + at.x, size};
      batch.seen[count] = {pixel, down.sample * n + right.sample, 0, 0};
      if (pass.has_data) prefetch_data(y * frame_.row_pixels + x);
      ++count;
    }
    batch.resize(count);
  }

  /// Begins to load what is written of a pixel later: pictures are larger than caches.
  HWY_INLINE void prefetch_data(uint64_t pixel) const {
    if (frame_.depth) prefetch_to_write(frame_.depth + pixel);
    if (frame_.normal) prefetch_to_write(frame_.normal + 3 * pixel, 3);
    if (frame_.scale) prefetch_to_write(frame_.scale + pixel);
    if (frame_.material) prefetch_to_write(frame_.material + pixel);
  }

  void see(const Pass& pass, Batch& batch) const {
    const bool wants_material = (pass.has_data && frame_.material) ||
                                (pass.has_colour && plan_.shading.colour_by == ColourBy::material);
    uint32_t part = 0;
    for (size_t i = 0; i < batch.hits.size(); ++i) {
      const RayHit& hit = batch.hits[i];
      Seen& seen = batch.seen[i];
      seen.depth = parameter_of(hit, batch.samples[i].size, view_.camera().clip_near,
                                view_.camera().clip_far);
      if (wants_material) seen.material = material_id(model_, resolved_, hit, part);
    }
  }

  /// Calls write(index) for the pixels of the block whose ray is in pixel (x, y) of the tile.
  template <class Write>
  void for_block(const Pass& pass, const Sample& sample, Write&& write) const {
    if (pass.step == 1) return write(sample.y * frame_.row_pixels + sample.x);
    const uint64_t x1 = std::min(plan_.tile_width, sample.x + pass.step);
    const uint64_t y1 = std::min(plan_.tile_height, sample.y + pass.step);
    for (uint64_t y = sample.y; y < y1; ++y)
      for (uint64_t x = sample.x; x < x1; ++x) write(y * frame_.row_pixels + x);
  }

  void write_data(const Pass& pass, const Batch& batch) const {
    for (size_t i = 0; i < batch.hits.size(); ++i) {
      const RayHit& hit = batch.hits[i];
      const Seen& seen = batch.seen[i];
      for_block(pass, batch.samples[i], [&](uint64_t pixel) {
        if (frame_.depth) frame_.depth[pixel] = static_cast<float>(seen.depth);
        if (frame_.scale) frame_.scale[pixel] = hit.scale;
        if (frame_.material) frame_.material[pixel] = seen.material;
        if (!frame_.normal) return;
        for (int axis = 0; axis < 3; ++axis)
          frame_.normal[3 * pixel + static_cast<uint64_t>(axis)] =
              static_cast<float>(hit.normal[axis]);
      });
    }
  }

  void write_colour(const Pass& pass, uint32_t x0, uint32_t y0, Batch& batch) const {
    const uint32_t n = pass.samples;
    shader_.shade(batch.seen, n * n, batch.hits, batch.colours, job_);
    const uint32_t pixels = square_side(n), side = pixels * n;
    if (n == 1) {
      for (size_t i = 0; i < batch.colours.size(); ++i) {
        const Sample& sample = batch.samples[i];
        uint8_t* first = frame_.rgba + 4 * (sample.y * frame_.row_pixels + sample.x);
        write_rgba(batch.colours[i], first);
        if (pass.step > 1)
          for_block(pass, sample,
                    [&](uint64_t pixel) { std::memmove(frame_.rgba + 4 * pixel, first, 4); });
      }
      return;
    }
    batch.square.resize(uint64_t{side} * side);
    for (size_t i = 0; i < batch.colours.size(); ++i)
      batch.square[batch.samples[i].place] = batch.colours[i];
    const uint32_t x1 = std::min(plan_.tile_width, x0 + pixels);
    const uint32_t y1 = std::min(plan_.tile_height, y0 + pixels);
    for (uint32_t y = y0; y < y1; ++y)
      for (uint32_t x = x0; x < x1; ++x) {
        // In the order of the samples in their pixel, for any position of the tile.
        Colour sum;
        for (uint32_t v = 0; v < n; ++v)
          for (uint32_t u = 0; u < n; ++u)
            sum = sum + batch.square[((y - y0) * n + v) * side + (x - x0) * n + u];
        write_rgba(sum * (1.0f / static_cast<float>(n * n)),
                   frame_.rgba + 4 * (y * frame_.row_pixels + x));
      }
  }

  const Model& model_;
  const Scales& resolved_;
  const View& view_;
  const RenderPlan& plan_;
  const Frame& frame_;
  Job* const job_;
  const Shader shader_;
  uint64_t all_rays_ = 1;  // and the callback after them
  uint64_t rays_done_ = 0;
};

}  // namespace

void render(const Model& model, const Scales& resolved, const View& view, const RenderPlan& plan,
            const Frame& frame, const std::function<void(const RenderPass&)>& on_pass, Job* job) {
  JobScope scope(job);
  Renderer(model, resolved, view, plan, frame, job).run(on_pass);
  scope.done();
}

}  // namespace msq
