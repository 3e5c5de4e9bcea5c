// SPDX-License-Identifier: Apache-2.0
#include "slice/slicer.h"

#include <cstring>
#include <optional>

#include "base/checked.h"
#include "query/membership.h"
#include "query/reach.h"

namespace msq {

namespace {

constexpr uint64_t max_samples = INT32_MAX;
constexpr uint64_t automatic_slab_bytes = uint64_t{32} << 20;
/// The same of slabs whose layers gain nothing by each other, for each thread: what is filled, cut
/// and written then stays in the caches of cores.
constexpr uint64_t shallow_slab_bytes = uint64_t{2} << 20;
/// Of an automatic slab: of less, each slab would redo much of what the one before it found about
/// the cells that both reach.
constexpr double automatic_slab_layers = 64;
/// The first slab of a run has this part of the layers of a slab: 1 / 8.
constexpr uint64_t first_slab_part = 8;

/// Samples of a pitch that cover an extent; a remainder of rounding does not make one more.
double samples_across(double extent, double pitch) {
  return std::max(1.0, std::ceil(extent / pitch * (1 - 1e-12)));
}

uint64_t checked_count(double count, const char* what) {
  if (!(count <= static_cast<double>(max_samples)))
    fail(Status::limit, "%g %s; the limit is %llu", count, what,
         static_cast<unsigned long long>(max_samples));
  return static_cast<uint64_t>(count);
}

}  // namespace

Slicer::Slicer(Ref<const Model> model, SlicePlan plan)
    : model_(std::move(model)),
      plan_(std::move(plan)),
      resolved_(model_->resolved(plan_.length_scale)),
      output_(make_layer_output(plan_.format, plan_.grey)) {
  if (plan_.format == LayerFormat::material && !model_->has_material(resolved_))
    fail(Status::argument, "the output is materials, and no resolved scale has a material");
  if (!plan_.has_region && !model_->shape().is_bounded())
    fail(Status::argument, "has_region is 0; a model of all space has no bounds, so give a region");
  if (!plan_.has_region) plan_.region = model_->bounds();
  plan_axis(0);
  plan_axis(1);
  plan_layers();
  whole_ = {grid_.nx, grid_.ny, grid_.nz};
  grid_ = window_of(grid_, plan_.window);
  plan_samples();
  checked_product(checked_product(layer_stride(4, std::max(grid_.nx, samples_.nx)),
                                  std::max(grid_.ny, samples_.ny), "a layer"),
                  grid_.nz, "all layers");
  require_reach(*model_, resolved_,
                {grid_.at(0, 0, 0), grid_.at(grid_.nx - 1, grid_.ny - 1, grid_.nz - 1)},
                "the region");
  plan_slabs();
  if (slab_layers_ > 1 && LayersAhead::pays(*model_, resolved_))
    ahead_ = std::make_unique<LayersAhead>(*model_, resolved_, samples_, slab_layers_);
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
  if (count > max_samples)
    fail(Status::limit, "%llu pixels along %s; the limit is %llu",
         static_cast<unsigned long long>(count), name,
         static_cast<unsigned long long>(max_samples));
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
  if (grid_.nz > max_samples)
    fail(Status::limit, "%llu layers; the limit is %llu", static_cast<unsigned long long>(grid_.nz),
         static_cast<unsigned long long>(max_samples));
  grid_.origin.z = low + 0.5 * height;
  grid_.spacing.z = height;
  const double last = static_cast<double>(grid_.nz);
  if (!std::isfinite(grid_.origin.z + last * height) ||
      grid_.origin.z + last * height == grid_.origin.z + (last - 1) * height)
    fail(Status::argument, "a layer_height of %g is too small or too large at z = %g", height,
         grid_.origin.z);
}

void Slicer::plan_samples() {
  const unsigned across = output_->samples_across();
  if (across == 0) return;
  samples_ = divided(grid_, across);
  for (int axis = 0; axis < 2; ++axis) {
    const uint64_t count = whole_[static_cast<size_t>(axis)];
    if (count > max_samples / across)
      fail(Status::limit, "%llu pixels of %u samples along %s; the limit is %llu samples",
           static_cast<unsigned long long>(count), across, axis == 0 ? "x" : "y",
           static_cast<unsigned long long>(max_samples));
    const double last =
        samples_.origin[axis] + static_cast<double>(count * across) * samples_.spacing[axis];
    if (!(last - samples_.spacing[axis] < last))
      fail(Status::argument, "%u samples across a pitch of %g along %s coincide at %g", across,
           grid_.spacing[axis], axis == 0 ? "x" : "y", last);
  }
}

void Slicer::plan_slabs() {
  if (output_->samples_across() == 0) return;  // layer by layer
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
  const uint64_t layer_bytes = words_for(samples_.nx) * samples_.ny * sizeof(uint64_t);
  uint64_t max_bytes =
      std::min(automatic_slab_bytes, shallow_slab_bytes * model_->executor().threads());
  for (const Scale* scale : resolved_)
    if (scale->structure->gains_by_layers() || !scale->skin.is_none())
      max_bytes = automatic_slab_bytes;
  // Two slabs, and as much for cells, meshes and other calls.
  if (const uint64_t limit = model_->context().budget->limit())
    max_bytes = std::min(max_bytes, limit / 4);
  const uint64_t fit = max_bytes / layer_bytes;
  slab_layers_ = static_cast<uint64_t>(
      std::clamp(std::min(layers, static_cast<double>(fit)), 1.0, static_cast<double>(grid_.nz)));
}

void Slicer::run(uint64_t first, uint64_t last, const std::function<void(const Layer&)>& take,
                 Job* job) const {
  JobScope scope(job);
  if (first == last) return scope.done();
  if (output_->samples_across() == 0) return run_by_layers(first, last, take, job);
  const uint64_t layer_words = words_for(samples_.nx) * samples_.ny;
  const uint64_t deep = std::min(slab_layers_, last - first);
  // The host waits for the first slab, and workers fill the second one while it takes the first.
  const uint64_t shallow = (deep + first_slab_part - 1) / first_slab_part;
  const bool is_one_slab = deep == last - first;
  const uint64_t room[2] = {is_one_slab ? shallow : deep, is_one_slab ? deep - shallow : deep};
  const uint64_t scratch = std::max(fill_slab_scratch_words(*model_, resolved_, samples_, shallow),
                                    fill_slab_scratch_words(*model_, resolved_, samples_, deep));
  const Reservation reservation(model_->context().budget,
                                ((room[0] + room[1]) * layer_words + scratch) * sizeof(uint64_t) +
                                    layer_bytes() + plain_bytes(),
                                "slabs of layers");
  std::vector<uint64_t> current(room[0] * layer_words), next(room[1] * layer_words);
  std::vector<uint8_t> bytes(layer_bytes()), plain(plain_bytes());

  Job ahead_job(job);  // stops the slab ahead when a callback ends the run
  fill_slab(*model_, resolved_, samples_, first, first + shallow, current.data(), job);
  for (uint64_t z0 = first, z1 = first + shallow; z0 < last;) {
    // All slabs but the first begin at a multiple of their height: what is said of whole cells in
    // plan_slabs() holds for them.
    const uint64_t z2 = std::min(last, first + (z1 - first) / deep * deep + deep);
    std::optional<Executor::Task> ahead;
    if (z1 < last)
      ahead.emplace(model_->executor(), [&, z1, z2] {
        const CurrentJob current(&ahead_job);
        fill_slab(*model_, resolved_, samples_, z1, z2, next.data(), &ahead_job);
      });
    try {
      for (uint64_t k = z0; k < z1; ++k) {
        check_cancelled(job);
        const uint64_t inside =
            write(k, current.data() + (k - z0) * layer_words, plain.data(), bytes.data(), job);
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
    z0 = z1;
    z1 = z2;
  }
}

void Slicer::run_by_layers(uint64_t first, uint64_t last,
                           const std::function<void(const Layer&)>& take, Job* job) const {
  const Reservation reservation(model_->context().budget, layer_bytes() + plain_bytes(), "a layer");
  std::vector<uint8_t> bytes(layer_bytes()), plain(plain_bytes());
  for (uint64_t k = first; k < last; ++k) {
    check_cancelled(job);
    const uint64_t inside = write(k, nullptr, plain.data(), bytes.data(), job);
    take({k, grid_.z(k), bytes.data(), inside});
    if (job)
      job->set_progress(static_cast<double>(k + 1 - first) / static_cast<double>(last - first));
  }
}

uint64_t Slicer::plain_bytes() const {
  if (plan_.orientation.is_plain()) return 0;
  return layer_stride(output_->pixel_bytes(), grid_.nx) * grid_.ny;
}

uint64_t Slicer::write(uint64_t index, const uint64_t* words, uint8_t* plain, uint8_t* out,
                       Job* job) const {
  SampleGrid pixels = grid_;
  pixels.nz = 1;
  pixels.origin.z = grid_.z(index);
  pixels.spacing.z = 1;
  pixels.heights = nullptr;
  pixels.first[2] = 0;
  const bool is_plain = plan_.orientation.is_plain();
  const uint64_t inside =
      output_->write({*model_, resolved_, pixels, words, job}, is_plain ? out : plain);
  if (!is_plain)
    orient_layer(plan_.orientation, output_->pixel_bytes(), plain, grid_.nx, grid_.ny, out,
                 model_->context().executor);
  return inside;
}

void Slicer::slice_layer(uint64_t index, uint8_t* out, Job* job) const {
  JobScope scope(job);
  const bool has_samples = output_->samples_across() != 0;
  const uint64_t layer_words = words_for(samples_.nx) * samples_.ny;
  const uint64_t scratch =
      has_samples ? fill_slab_scratch_words(*model_, resolved_, samples_, 1) : 0;
  // A call that fails leaves `out` as it was: values are written beside it.
  const uint64_t beside = has_samples ? 0 : layer_bytes();
  const Reservation reservation(model_->context().budget,
                                (layer_words + scratch) * sizeof(uint64_t) + plain_bytes() + beside,
                                "a layer");
  std::vector<uint64_t> words(layer_words);
  std::vector<uint8_t> plain(plain_bytes()), bytes(beside);
  if (has_samples && !(ahead_ && ahead_->take(index, words.data(), job)))
    fill_slab(*model_, resolved_, samples_, index, index + 1, words.data(), job);
  write(index, words.data(), plain.data(), has_samples ? out : bytes.data(), job);
  if (!has_samples) std::memcpy(out, bytes.data(), bytes.size());
  scope.done();
}

}  // namespace msq
