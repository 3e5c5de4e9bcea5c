// SPDX-License-Identifier: Apache-2.0
#include "slice/slicer.h"

#include <optional>

#include "base/checked.h"
#include "query/membership.h"

namespace msq {

namespace {

constexpr uint64_t most_samples = INT32_MAX;
constexpr uint64_t automatic_slab_bytes = uint64_t{32} << 20;
/// The same of slabs whose layers gain nothing by each other, for each thread: what is filled, cut
/// and written then stays in the caches of cores.
constexpr uint64_t shallow_slab_bytes = uint64_t{2} << 20;
/// Of an automatic slab: of less, each slab would redo much of what the one before it found about
/// the cells that both reach.
constexpr double automatic_slab_layers = 64;

/// Samples of a pitch that cover an extent; a remainder of rounding does not make one more.
double samples_across(double extent, double pitch) {
  return std::max(1.0, std::ceil(extent / pitch * (1 - 1e-12)));
}

uint64_t checked_count(double count, const char* what) {
  if (!(count <= static_cast<double>(most_samples)))
    fail(Status::limit, "%g %s; the limit is %llu", count, what,
         static_cast<unsigned long long>(most_samples));
  return static_cast<uint64_t>(count);
}

}  // namespace

Slicer::Slicer(Ref<const Model> model, SlicePlan plan)
    : model_(std::move(model)),
      plan_(std::move(plan)),
      resolved_(model_->resolved(plan_.length_scale)) {
  if (!plan_.has_region) plan_.region = model_->bounds();
  plan_axis(0);
  plan_axis(1);
  plan_layers();
  checked_product(checked_product(layer_stride(LayerFormat::bytes, grid_.nx), grid_.ny, "a layer"),
                  grid_.nz, "all layers");
  plan_slabs();
}

void Slicer::plan_axis(int axis) {
  const char* name = axis == 0 ? "x" : "y";
  const double low = plan_.region.min[axis], high = plan_.region.max[axis];
  const double extent = high - low;
  double pitch = plan_.pitch[axis];
  uint64_t count = plan_.resolution[axis];
  if (pitch == 0 && count == 0)
    fail(Status::argument, "neither pitch nor resolution is given along %s", name);
  if ((pitch == 0 || count == 0) && !(extent > 0))
    fail(Status::argument, "the region's extent along %s is %g; it must be positive", name, extent);
  if (pitch == 0) pitch = extent / static_cast<double>(count);
  if (count == 0) count = checked_count(samples_across(extent, pitch), "pixels along a side");
  if (count > most_samples)
    fail(Status::limit, "%llu pixels along %s; the limit is %llu",
         static_cast<unsigned long long>(count), name,
         static_cast<unsigned long long>(most_samples));
  const double corner =
      plan_.has_region ? low : low + 0.5 * (extent - static_cast<double>(count) * pitch);
  const double origin = corner + 0.5 * pitch;
  if (!(pitch > 0) || !std::isfinite(origin + static_cast<double>(count) * pitch) ||
      origin + pitch == origin ||
      origin + static_cast<double>(count) * pitch ==
          origin + static_cast<double>(count - 1) * pitch)
    fail(Status::argument, "a pitch of %g along %s is too small or too large at %g", pitch, name,
         origin);
  grid_.origin[axis] = origin;
  grid_.spacing[axis] = pitch;
  (axis == 0 ? grid_.nx : grid_.ny) = count;
}

void Slicer::plan_layers() {
  if (!plan_.heights.empty()) {
    grid_.heights = plan_.heights.data();
    grid_.nz = plan_.heights.size();
    return;
  }
  const double low = plan_.region.min.z, extent = plan_.region.max.z - low;
  const double height = plan_.layer_height;
  if (plan_.layer_count == 0 && !(extent > 0))
    fail(Status::argument, "the region's extent along z is %g; it must be positive", extent);
  grid_.nz = plan_.layer_count ? plan_.layer_count
                               : checked_count(samples_across(extent, height), "layers");
  if (grid_.nz > most_samples)
    fail(Status::limit, "%llu layers; the limit is %llu", static_cast<unsigned long long>(grid_.nz),
         static_cast<unsigned long long>(most_samples));
  grid_.origin.z = low + 0.5 * height;
  grid_.spacing.z = height;
  const double last = static_cast<double>(grid_.nz);
  if (!std::isfinite(grid_.origin.z + last * height) ||
      grid_.origin.z + last * height == grid_.origin.z + (last - 1) * height)
    fail(Status::argument, "a layer_height of %g is too small or too large at z = %g", height,
         grid_.origin.z);
}

void Slicer::plan_slabs() {
  if (plan_.slab_layers) {
    slab_layers_ = std::min<uint64_t>(plan_.slab_layers, grid_.nz);
    return;
  }
  const double extent = grid_.z(grid_.nz - 1) - grid_.z(0);
  const double height = grid_.nz > 1 ? extent / static_cast<double>(grid_.nz - 1) : 0;
  double layers = automatic_slab_layers;
  if (!resolved_.empty() && height > 0) {  // whole cells, at least one
    // As many layers to a cell as there are in exact numbers.
    const double cell = resolved_.back()->structure->neighbourhood().cell_size.z / height;
    constexpr double up = 1 + 1e-9;
    layers = std::floor(std::max(1.0, std::floor(automatic_slab_layers / cell * up)) * cell * up);
  }
  const uint64_t layer_bytes = words_for(grid_.nx) * grid_.ny * sizeof(uint64_t);
  uint64_t most_bytes = std::min(automatic_slab_bytes,
                                 shallow_slab_bytes * model_->executor().threads());
  for (const Scale* scale : resolved_)
    if (scale->structure->gains_by_layers() || !scale->skin.is_none())
      most_bytes = automatic_slab_bytes;
  const double fit = static_cast<double>(most_bytes / layer_bytes);
  slab_layers_ =
      static_cast<uint64_t>(std::clamp(std::min(layers, fit), 1.0, static_cast<double>(grid_.nz)));
}

void Slicer::run(uint64_t first, uint64_t last, const std::function<void(const Layer&)>& take,
                 Job* job) const {
  JobScope scope(job);
  if (first == last) return scope.done();
  const uint64_t layer_words = words_for(grid_.nx) * grid_.ny;
  const uint64_t deep = std::min(slab_layers_, last - first);
  const bool is_one_slab = deep == last - first;
  const Reservation reservation(model_->context().budget,
                                ((is_one_slab ? 1 : 2) * deep * layer_words +
                                 fill_slab_scratch_words(*model_, resolved_, grid_, deep)) *
                                        sizeof(uint64_t) +
                                    layer_bytes(),
                                "slabs of layers");
  std::vector<uint64_t> current(deep * layer_words), next(is_one_slab ? 0 : deep * layer_words);
  std::vector<uint8_t> bytes(layer_bytes());

  Job ahead_job(job);  // stops the slab ahead when a callback ends the run
  fill_slab(*model_, resolved_, grid_, first, first + deep, current.data(), job);
  for (uint64_t z0 = first; z0 < last; z0 += deep) {
    const uint64_t z1 = std::min(last, z0 + deep), z2 = std::min(last, z1 + deep);
    std::optional<Executor::Task> ahead;
    if (z1 < last)
      ahead.emplace(model_->executor(), [&, z1, z2] {
        fill_slab(*model_, resolved_, grid_, z1, z2, next.data(), &ahead_job);
      });
    try {
      for (uint64_t k = z0; k < z1; ++k) {
        check_cancelled(job);
        const uint64_t inside = write_layer(plan_.format, current.data() + (k - z0) * layer_words,
                                            grid_.nx, grid_.ny, bytes.data());
        take({k, grid_.z(k), bytes.data(), inside});
        if (job)
          job->set_progress(static_cast<double>(k + 1 - first) / static_cast<double>(last - first));
      }
    } catch (...) {
      ahead_job.cancel();
      throw;
    }
    if (ahead) ahead->wait();
    std::swap(current, next);
  }
}

void Slicer::slice_layer(uint64_t index, uint8_t* out, Job* job) const {
  const uint64_t layer_words = words_for(grid_.nx) * grid_.ny;
  const Reservation reservation(
      model_->context().budget,
      (layer_words + fill_slab_scratch_words(*model_, resolved_, grid_, 1)) * sizeof(uint64_t),
      "a layer");
  std::vector<uint64_t> words(layer_words);
  JobScope scope(job);
  fill_slab(*model_, resolved_, grid_, index, index + 1, words.data(), job);
  write_layer(plan_.format, words.data(), grid_.nx, grid_.ny, out);
  scope.done();
}

}  // namespace msq
