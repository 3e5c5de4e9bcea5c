// SPDX-License-Identifier: Apache-2.0
#include "slice/slicer.h"

#include <algorithm>
#include <cstring>

#include "base/borrowed.h"
#include "base/checked.h"
#include "query/membership.h"
#include "query/reach.h"
#include "slice/contours_ahead.h"
#include "slice/framed_model.h"

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
/// The first slab of a run has this part of the layers of a slab, 1 / 32, unless the slabs of
/// structures are shallow already: each slab has a cost of its own.
constexpr uint64_t first_slab_part = 32;
/// What one thread fills, cuts and writes in its own caches. Several threads take whole layers
/// where these fit: more of the next layer is then computed while the host has one.
constexpr uint64_t near_band_bytes = uint64_t{1} << 20;
/// Of samples. Bands have no fewer: each takes up again the cells that the one before it reached.
constexpr uint64_t min_band_rows = 16;

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

/// What a slab takes of a memory limit: two of them leave as much for cells, meshes and other
/// calls.
uint64_t slab_share(uint64_t limit) {
  return limit ? limit / 4 : UINT64_MAX;
}

/// Bytes that a call may take. Cached cells give way.
uint64_t room_in(const Context& context) {
  const uint64_t limit = context.budget->limit();
  if (limit == 0) return UINT64_MAX;
  const uint64_t held = context.budget->held(), cached = context.cache.counters().bytes;
  return limit - std::min(limit, held - std::min(held, cached));
}

/// Samples of a layer or of a part of it. Few are borrowed: to get fresh pages for each layer takes
/// about as long as to fill it.
class LayerWords {
 public:
  uint64_t* of(size_t count) {
    std::vector<uint64_t>& from = count <= max_borrowed ? *borrowed_ : own_;
    if (from.size() < count) from.resize(count);
    return from.data();
  }

 private:
  static constexpr size_t max_borrowed = size_t{1} << 19;  // 4 MiB for each thread of the host
  const Borrowed<std::vector<uint64_t>> borrowed_;
  std::vector<uint64_t> own_;
};

/// Whether slabs are as deep as memory allows.
bool gains_by_layers(const Scale& scale) {
  return scale.structure->gains_by_layers() || !scale.skin.is_none();
}

}  // namespace

Slicer::Slicer(Ref<const Model> model, SlicePlan plan)
    : model_(std::move(model)),
      plan_(std::move(plan)),
      resolved_(model_->resolved(plan_.length_scale)),
      framed_(plan_.frame.is_that_of_model() ? model_ : make_framed_model(*model_, plan_.frame)),
      framed_resolved_(framed_->resolved(plan_.length_scale)) {
  for (const OutputPlan& output : plan_.outputs)
    outputs_.push_back({output, make_layer_output(output, *model_, resolved_)});
  if (!plan_.has_region && !model_->shape().is_bounded())
    fail(Status::argument, "has_region is 0; a model of all space has no bounds, so give a region");
  if (!plan_.has_region) plan_.region = framed_->bounds();
  plan_axis(0);
  plan_axis(1);
  plan_layers();
  whole_ = {grid_.nx, grid_.ny, grid_.nz};
  grid_ = window_of(grid_, plan_.window);
  plan_outputs();
  uint64_t nx = grid_.nx, ny = grid_.ny;
  for (const SampleGrid& samples : samples_) {
    nx = std::max(nx, samples.nx);
    ny = std::max(ny, samples.ny);
  }
  checked_product(checked_product(layer_stride(4, nx), ny, "a layer"), grid_.nz, "all layers");
  require_reach(*framed_, framed_resolved_,
                {grid_.at(0, 0, 0), grid_.at(grid_.nx - 1, grid_.ny - 1, grid_.nz - 1)},
                "the region");
  plan_slabs();
  const size_t samples = outputs_.front().samples;
  if (samples == no_samples || !LayersAhead::pays(framed_resolved_)) return;
  const uint64_t ahead = plan_.slab_layers ? slab_layers_ : automatic_layers(false);
  if (ahead > 1)
    ahead_ = std::make_unique<LayersAhead>(*framed_, framed_resolved_, samples_[samples], ahead);
}

const char* Slicer::axis_name(int axis) const {
  static constexpr const char* names[2][3] = {{"u", "v", "w"}, {"x", "y", "z"}};
  return names[plan_.frame.is_that_of_model()][axis];
}

void Slicer::plan_axis(int axis) {
  const char* name = axis_name(axis);
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
    fail(Status::argument, "the region's extent along %s is %g; it must be positive", axis_name(2),
         extent);
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
    fail(Status::argument, "a layer_height of %g is too small or too large at %s = %g", height,
         axis_name(2), grid_.origin.z);
}

// Outputs that need as many samples across a pixel share their bits.
void Slicer::plan_outputs() {
  std::vector<unsigned> across;  // of samples_
  for (Output& output : outputs_) {
    const unsigned wanted = output.pixels ? output.pixels->samples_across() : 0;
    if (wanted == 0) continue;
    output.samples =
        static_cast<size_t>(std::find(across.begin(), across.end(), wanted) - across.begin());
    if (output.samples < across.size()) continue;
    across.push_back(wanted);
    samples_.push_back(divided_pixels(wanted));
    repeats_.push_back(find_row_repeats(*framed_, framed_resolved_, samples_.back()));
  }
}

bool Slicer::takes_repeats(size_t samples) const {
  return repeats_[samples].any() && !plan_.keeps_words &&
         std::all_of(outputs_.begin(), outputs_.end(), [&](const Output& output) {
           return output.samples != samples || output.pixels->takes_repeats();
         });
}

SampleGrid Slicer::divided_pixels(unsigned across) const {
  const SampleGrid samples = divided(grid_, across);
  for (int axis = 0; axis < 2; ++axis) {
    const uint64_t count = whole_[static_cast<size_t>(axis)];
    if (count > max_samples / across)
      fail(Status::limit, "%llu pixels of %u samples along %s; the limit is %llu samples",
           static_cast<unsigned long long>(count), across, axis_name(axis),
           static_cast<unsigned long long>(max_samples));
    const double last =
        samples.origin[axis] + static_cast<double>(count * across) * samples.spacing[axis];
    if (!(last - samples.spacing[axis] < last))
      fail(Status::argument, "%u samples across a pitch of %g along %s coincide at %g", across,
           grid_.spacing[axis], axis_name(axis), last);
  }
  return samples;
}

void Slicer::plan_slabs() {
  if (samples_.empty()) return;  // layer by layer
  slab_layers_ =
      plan_.slab_layers ? std::min<uint64_t>(plan_.slab_layers, grid_.nz) : automatic_layers(true);
}

uint64_t Slicer::automatic_layers(bool in_run) const {
  const double extent = grid_.z(grid_.nz - 1) - grid_.z(0);
  const double height = grid_.nz > 1 ? extent / static_cast<double>(grid_.nz - 1) : 0;
  double layers = automatic_slab_layers;
  if (!framed_resolved_.empty() && height > 0) {  // whole cells, at least one
    // As many layers to a cell as there are in exact numbers.
    const double cell = framed_resolved_.back()->structure->neighbourhood().cell_size.z / height;
    constexpr double up = 1 + 1e-9;
    layers = std::floor(std::max(1.0, std::floor(automatic_slab_layers / cell * up)) * cell * up);
  }
  uint64_t layer_bytes = 0;
  for (size_t i = 0; i < samples_.size(); ++i)
    layer_bytes += SlabsAhead::bytes_of_rows(samples_[i], samples_[i].ny / grid_.ny,
                                             in_run ? row_output(i) : nullptr);
  uint64_t max_bytes =
      std::min(automatic_slab_bytes, shallow_slab_bytes * model_->executor().threads());
  for (const Scale* scale : framed_resolved_)
    if (gains_by_layers(*scale)) max_bytes = automatic_slab_bytes;
  max_bytes = std::min(max_bytes, slab_share(model_->context().budget->limit()));
  const uint64_t fit = max_bytes / layer_bytes;
  return static_cast<uint64_t>(
      std::clamp(std::min(layers, static_cast<double>(fit)), 1.0, static_cast<double>(grid_.nz)));
}

bool Slicer::is_shallow() const {
  return plan_.slab_layers == 0 && !framed_resolved_.empty() &&
         std::none_of(framed_resolved_.begin(), framed_resolved_.end(),
                      [](const Scale* scale) { return gains_by_layers(*scale); });
}

SlabsAhead::Depth Slicer::slab_depth(uint64_t layers) const {
  const uint64_t depth = std::min(slab_layers_, layers);
  return {is_shallow() ? depth : (depth + first_slab_part - 1) / first_slab_part, depth};
}

uint64_t Slicer::band_rows(uint64_t max_sample_bytes,
                           const std::function<uint64_t(uint64_t)>& bytes_of) const {
  uint64_t across = 1, row_bytes = 0;
  for (const SampleGrid& samples : samples_) {
    across = std::max(across, samples.ny / grid_.ny);
    row_bytes += words_for(samples.nx) * (samples.ny / grid_.ny) * sizeof(uint64_t);
  }
  const uint64_t room = room_in(model_->context());
  const uint64_t fewest = std::min(grid_.ny, (min_band_rows + across - 1) / across);
  uint64_t least_rows = grid_.ny, least = UINT64_MAX;
  for (uint64_t rows = grid_.ny;; rows = std::max(fewest, (rows + 1) / 2)) {
    const uint64_t bytes = bytes_of(rows);
    if (bytes <= room && rows * row_bytes <= max_sample_bytes) return rows;
    if (bytes < least) {
      least = bytes;
      least_rows = rows;
    }
    if (rows == fewest) return least_rows;
  }
}

Slicer::Portions Slicer::portions(uint64_t layers, uint64_t beside) const {
  Portions made{slab_depth(layers), {grid_.ny, grid_.ny}, 0};
  const auto bytes_of = [&](uint64_t rows) {
    uint64_t plain = 0;
    for (const Output& output : outputs_) plain = std::max(plain, plain_bytes(output, rows));
    return beside + plain +
           SlabsAhead::bytes(*framed_, framed_resolved_, samples_, uses_of_samples(rows),
                             made.depth, {grid_.ny, rows}, layers);
  };
  const Context& context = model_->context();
  while (plan_.slab_layers == 0 && made.depth.others > 1 && bytes_of(grid_.ny) > room_in(context))
    made.depth = slab_depth((made.depth.others + 1) / 2);
  if (made.depth.others == 1) {
    uint64_t most = std::min(automatic_slab_bytes, slab_share(context.budget->limit()));
    // Each band computes a period of repeated rows anew, so such bands stay large.
    bool repeats = true;
    for (size_t i = 0; i < samples_.size(); ++i) repeats = repeats && takes_repeats(i);
    if (is_shallow() && !repeats && model_->executor().threads() == 1)
      most = std::min(most, near_band_bytes);
    made.bands.band_rows = band_rows(most, bytes_of);
  }
  made.bytes = bytes_of(made.bands.band_rows);
  return made;
}

void Slicer::run(uint64_t first, uint64_t last, const std::function<void(const Layer&)>& take,
                 Job* job) const {
  JobScope scope(job);
  if (first == last) return scope.done();
  uint64_t all_bytes = 0, max_plain_bytes = 0;
  std::vector<size_t> with_contours;
  for (size_t i = 0; i < outputs_.size(); ++i) {
    all_bytes += layer_bytes(i);
    if (!outputs_[i].pixels) with_contours.push_back(i);
  }
  const Portions portion = portions(last - first, all_bytes);
  const SlabsAhead::Bands& bands = portion.bands;
  const std::vector<SlabsAhead::GridUse> uses = uses_of_samples(bands.band_rows);
  const auto is_in_slab = [&](const Output& output) {
    return output.samples != no_samples && uses[output.samples].output;
  };
  const Reservation reservation(model_->context().budget, portion.bytes,
                                samples_.empty()    ? "a layer"
                                : bands.count() > 1 ? "a layer and bands of its rows"
                                                    : "slabs of layers");
  for (const Output& output : outputs_)
    max_plain_bytes = std::max(max_plain_bytes, plain_bytes(output, bands.band_rows));
  std::vector<uint8_t> plain(max_plain_bytes);
  // Of each output that slabs do not hold; none for contours.
  std::vector<std::vector<uint8_t>> layers(outputs_.size());
  for (size_t i = 0; i < outputs_.size(); ++i)
    if (!is_in_slab(outputs_[i])) layers[i].resize(layer_bytes(i));
  std::vector<LayerPart> parts(outputs_.size());
  SlabsAhead slabs(*framed_, framed_resolved_, samples_, uses, portion.depth, bands, first, last,
                   job);
  const auto make = [&](uint64_t layer, size_t n, Job* part) {
    return contours(layer, outputs_[with_contours[n]].plan.contours, part);
  };
  ContoursAhead rings(*model_, make, with_contours.size(), first, last, job);
  const auto write_band = [&](uint64_t layer, uint64_t band) {
    slabs.go_to(layer, band);
    for (size_t i = 0; i < outputs_.size(); ++i) {
      const Output& output = outputs_[i];
      if (!output.pixels) continue;
      SampleRows rows;
      RowRepeats repeats;
      if (output.samples != no_samples) rows.words = slabs.words(output.samples);
      if (is_in_slab(output)) {
        parts[i].data = reinterpret_cast<const uint8_t*>(rows.words);
        parts[i].inside_count = slabs.inside_count(output.samples);
        continue;
      }
      if (rows.words) repeats = slabs.repeats(output.samples);
      if (repeats.any()) {
        rows.repeats = &repeats;
        rows.flips = &slabs.flips(output.samples);
      } else if (bands.count() == 1) {
        parts[i].words = rows.words;
      }
      Job part(job);  // its progress is not that of the call
      parts[i].inside_count += write(output, layer, bands.begin(band), bands.end(band), rows,
                                     plain.data(), layers[i].data(), &part);
      if (job) job->counts().add(part.counts());
    }
  };
  for (uint64_t k = first; k < last; ++k) {
    for (size_t i = 0; i < outputs_.size(); ++i) parts[i] = {layers[i].data()};
    for (uint64_t band = 0; band < bands.count(); ++band) {
      check_cancelled(job);
      write_band(k, band);
    }
    rings.go_to(k);
    for (size_t n = 0; n < with_contours.size(); ++n)
      parts[with_contours[n]].contours = rings.contours(n).get();
    take({k, grid_.z(k), parts});
    if (job)
      job->set_progress(static_cast<double>(k + 1 - first) / static_cast<double>(last - first));
  }
}

const RowOutput* Slicer::row_output(size_t samples) const {
  if (plan_.keeps_words || !plan_.orientation.is_plain()) return nullptr;
  const Output* only = nullptr;
  for (const Output& output : outputs_) {
    if (output.samples != samples) continue;
    if (only) return nullptr;
    only = &output;
  }
  const auto* const rows = dynamic_cast<const RowOutput*>(only->pixels.get());
  if (!rows || rows->pixel_bytes() == 0) return rows;
  const bool is_by_tile =
      fills_by_tile(*framed_, framed_resolved_) && !repeats_[samples].any() && !is_shallow();
  return is_by_tile ? rows : nullptr;
}

std::vector<SlabsAhead::GridUse> Slicer::uses_of_samples(uint64_t band_rows) const {
  std::vector<SlabsAhead::GridUse> uses;
  for (size_t i = 0; i < samples_.size(); ++i)
    uses.push_back(
        {repeats_[i], takes_repeats(i), band_rows == grid_.ny ? row_output(i) : nullptr});
  return uses;
}

uint64_t Slicer::plain_bytes(const Output& output, uint64_t rows) const {
  if (plan_.orientation.is_plain() || !output.pixels) return 0;
  return layer_stride(output.pixels->pixel_bytes(), grid_.nx) * rows;
}

uint64_t Slicer::write(const Output& output, uint64_t index, uint64_t begin, uint64_t end,
                       const SampleRows& samples, uint8_t* plain, uint8_t* out, Job* job) const {
  SampleGrid pixels = rows_of(grid_, begin, end);
  pixels.nz = 1;
  pixels.origin.z = grid_.z(index);
  pixels.spacing.z = 1;
  pixels.heights = nullptr;
  pixels.first[2] = 0;
  const unsigned pixel_bytes = output.pixels->pixel_bytes();
  const bool is_plain = plan_.orientation.is_plain();
  const uint64_t inside = output.pixels->write(
      {*model_, resolved_, plan_.frame, pixels, samples.words, job, samples.repeats, samples.flips},
      is_plain ? out + begin * layer_stride(pixel_bytes, grid_.nx) : plain);
  if (!is_plain)
    orient_rows(plan_.orientation, pixel_bytes, plain, begin, end, grid_.nx, grid_.ny, out,
                model_->context().executor);
  return inside;
}

void Slicer::slice_layer(uint64_t index, uint8_t* out, Job* job) const {
  JobScope scope(job);
  const Output& output = outputs_.front();
  const SampleGrid* samples = output.samples == no_samples ? nullptr : &samples_[output.samples];
  const auto sample_rows = [&](uint64_t begin, uint64_t end) {
    const uint64_t across = samples->ny / grid_.ny;
    return rows_of(*samples, across * begin, across * end);
  };
  // A call that fails leaves `out` as it was: what is not written from the bits of the whole layer
  // is written beside it, and so is all where a loop of the host may fail.
  const auto is_beside = [&](uint64_t rows) {
    return !samples || rows < grid_.ny || model_->executor().is_of_host();
  };
  const auto bytes_of = [&](uint64_t rows) {
    uint64_t of_samples = 0;
    if (samples) {
      const SampleGrid band = sample_rows(0, rows);
      of_samples = words_for(band.nx) * band.ny * sizeof(uint64_t);
      if (repeats_[output.samples].any()) of_samples += RowFlips::max_bytes(of_samples);
      of_samples += fill_slab_scratch_words(*framed_, framed_resolved_, band, 1) * sizeof(uint64_t);
    }
    return of_samples + plain_bytes(output, rows) + (is_beside(rows) ? layer_bytes(0) : 0);
  };
  const std::shared_ptr<MemoryBudget>& budget = model_->context().budget;
  uint64_t most =
      std::max(layer_bytes(0), std::min(automatic_slab_bytes, slab_share(budget->limit())));
  if (is_shallow() && output.pixels->samples_across() > 1)
    most = std::min(most, near_band_bytes * model_->executor().threads());
  const uint64_t band = band_rows(most, bytes_of);
  const Reservation reservation(budget, bytes_of(band), "a layer");
  LayerWords memory;
  uint64_t* const words =
      samples ? memory.of(words_for(samples->nx) * sample_rows(0, band).ny) : nullptr;
  std::vector<uint8_t> plain(plain_bytes(output, band));
  std::unique_ptr<uint8_t[]> beside;
  if (is_beside(band)) beside = std::make_unique_for_overwrite<uint8_t[]>(layer_bytes(0));
  uint8_t* const bytes = beside ? beside.get() : out;
  const bool is_ahead = samples && band == grid_.ny && ahead_;
  for (uint64_t begin = 0; begin < grid_.ny; begin += band) {
    check_cancelled(job);
    const uint64_t end = std::min(grid_.ny, begin + band);
    RowRepeats repeats;
    if (samples) {
      const uint64_t across = samples->ny / grid_.ny;
      repeats = repeats_[output.samples].of_rows(across * begin, across * end);
    }
    // One thread computes the period of a layer.
    if (repeats.any() &&
        repeats.period * model_->executor().threads() <= repeats.end - repeats.first)
      fill_repeating_slab(*framed_, framed_resolved_, sample_rows(begin, end), repeats, index,
                          index + 1, words, job, {}, nullptr);
    else if (samples && !(is_ahead && ahead_->take(index, words, job)))
      fill_slab(*framed_, framed_resolved_, sample_rows(begin, end), index, index + 1, words, job);
    write(output, index, begin, end, {words}, plain.data(), bytes, job);
  }
  if (beside) std::memcpy(out, bytes, layer_bytes(0));
  scope.done();
}

Ref<Contours> Slicer::contours(uint64_t index, ContourPlan plan, Job* job) const {
  plan.length_scale = plan_.length_scale;
  plan.plane = {2, grid_.z(index)};
  if (!plan.has_window) {
    plan.has_window = true;
    for (int i = 0; i < 2; ++i) {
      const double first = static_cast<double>(grid_.first[static_cast<size_t>(i)]);
      const double count = static_cast<double>(i == 0 ? grid_.nx : grid_.ny);
      plan.window_min[i] = grid_.origin[i] + (first - 0.5) * grid_.spacing[i];
      plan.window_max[i] = grid_.origin[i] + (first + count - 0.5) * grid_.spacing[i];
    }
  }
  // Axes of contours are those of the model in their order.
  const std::array<int, 3> axes = plan_.frame.model_axes();
  if (axes != std::array<int, 3>{1, 2, 0} && axes != std::array<int, 3>{0, 2, 1})
    return layer_contours(*framed_, plan, job);
  plan.plane.axis = axes[2];
  return layer_contours(*model_, plan, job);
}

}  // namespace msq
