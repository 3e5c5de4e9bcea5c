// SPDX-License-Identifier: Apache-2.0
#include "printability/printability.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <tuple>
#include <vector>

#include "printability/bit_row.h"
#include "printability/components.h"
#include "printability/thin.h"
#include "slice/layer_output.h"

namespace msq {

namespace {

constexpr size_t max_batch = 4096;

/// The plan of the slicer's samples, one per pixel, as bits.
SlicePlan plan_of_bits(const Slicer& slicer) {
  SlicePlan plan = slicer.plan();
  plan.outputs = {OutputPlan{}};
  plan.orientation = {};
  plan.keeps_words = true;
  return plan;
}

/// Samples across the disc that must fit where the solid is not thin.
unsigned samples_across(double width, double pitch, char axis) {
  const double count = width / pitch * (1 + 1e-9);
  if (!(count >= 2 && count < ThinSamples::max_across + 1))
    fail(Status::argument, "width is %g, %g pixels along %c; it must be from 2 to %u pixels", width,
         count, axis, ThinSamples::max_across);
  return static_cast<unsigned>(count);
}

/// Where a layer ends below (side 0) or above (1): half-way to the next layer of the whole plan.
double layer_face(const Slicer& slicer, uint64_t index, int side) {
  const SampleGrid& grid = slicer.grid();
  if (!grid.heights) return grid.z(index) + (side - 0.5) * grid.spacing.z;
  const uint64_t at = grid.first[2] + index, count = slicer.whole()[2];
  const double* z = grid.heights;
  if (count == 1) return z[0];
  const bool has_lower = at > 0, has_upper = at + 1 < count;
  const double lower = 0.5 * (z[at] - z[has_lower ? at - 1 : at]),
               upper = 0.5 * (z[has_upper ? at + 1 : at] - z[at]);
  if (side == 0) return z[at] - (has_lower ? lower : upper);
  return z[at] + (has_upper ? upper : lower);
}

/// Bands of a layer of so many words. A band has enough samples to be worth the threads' while.
unsigned band_count(uint64_t words, uint64_t ny, unsigned threads) {
  constexpr uint64_t min_words = 512;
  if (threads < 2) return 1;
  const uint64_t most = std::min({uint64_t{2} * threads, words / min_words, strips_for(ny)});
  return static_cast<unsigned>(std::max<uint64_t>(most, 1));
}

class Inspection {
 public:
  Inspection(const Slicer& slicer, const PrintabilityPlan& plan,
             const std::function<void(const Finding*, size_t)>& take)
      : slicer_(slicer),
        grid_(slicer.grid()),
        plan_(plan),
        take_(take),
        executor_(slicer.model().context().executor),
        words_(words_for(grid_.nx)) {
    const uint64_t nx = grid_.nx, ny = grid_.ny;
    const bool finds_solid = finds(FindingKind::island) || finds(FindingKind::loose);
    const bool finds_empty = finds(FindingKind::enclosed_void) || finds(FindingKind::cup);
    const unsigned bands = band_count(words_ * ny, ny, executor_.threads());
    if (finds(FindingKind::thin)) {
      const unsigned across[2] = {samples_across(plan.width, grid_.spacing.x, 'x'),
                                  samples_across(plan.width, grid_.spacing.y, 'y')};
      thin_.emplace(across);
    }
    if (finds(FindingKind::overhang)) {
      const double pitch[2] = {grid_.spacing.x, grid_.spacing.y};
      for (int axis = 0; axis < 2; ++axis)
        if (!(plan.overhang <= OverhangSamples::max_reach * pitch[axis]))
          fail(Status::argument, "overhang is %g, %g pixels along %c; it must be at most %u pixels",
               plan.overhang, plan.overhang / pitch[axis], "xy"[axis], OverhangSamples::max_reach);
      overhangs_.emplace(plan.overhang, pitch);
    }
    const uint64_t mask = words_ * ny;
    uint64_t words = 0;
    if (finds_empty) words += mask;
    if (thin_) words += mask + bands * thin_->scratch_words(words_);
    if (overhangs_) words += 2 * mask + bands * overhangs_->scratch_words(words_);
    const uint64_t analyses =
        uint64_t{finds_solid} + finds_empty + thin_.has_value() + overhangs_.has_value();
    reserve(words * sizeof(uint64_t) + analyses * Components::bytes(nx, ny), "masks of layers");
    if (finds_solid) {
      Components::Rules rules;
      rules.joins_corners = true;
      rules.anchors_first_layer = plan.has_plate;
      rules.finds_islands = finds(FindingKind::island);
      analyses_.emplace_back(Samples::solid, Components(nx, ny, rules, bands));
    }
    if (finds_empty) {
      Components::Rules rules;
      rules.anchors_sides = true;
      rules.anchors_first_layer = !plan.has_plate;
      rules.finds_cups = finds(FindingKind::cup);
      analyses_.emplace_back(Samples::empty, Components(nx, ny, rules, bands));
      analyses_.back().rows.resize(mask);
    }
    Components::Rules rules;
    rules.joins_corners = true;
    if (thin_) {
      analyses_.emplace_back(Samples::thin, Components(nx, ny, rules, bands));
      analyses_.back().rows.resize(mask);
      analyses_.back().scratch.assign(bands, std::vector<uint64_t>(thin_->scratch_words(words_)));
    }
    if (overhangs_) {
      analyses_.emplace_back(Samples::overhang, Components(nx, ny, rules, bands));
      analyses_.back().rows.resize(mask);
      analyses_.back().scratch.assign(bands,
                                      std::vector<uint64_t>(overhangs_->scratch_words(words_)));
      below_.resize(mask);
    }
    bands_ = bands;
    reserve_held();
  }

  void add_layer(const Layer& layer) {
    const double height = layer_face(slicer_, layer.index, 1) - layer_face(slicer_, layer.index, 0);
    ++counts_.layers;
    counts_.solid_samples += layer.main().inside_count;
    counts_.solid_volume += static_cast<double>(layer.main().inside_count) * pixel_area() * height;
    const uint64_t* rows = rows_of(layer.main());
    const uint64_t tasks = analyses_.size() * bands_;
    executor_.for_each(tasks, [&](uint64_t i) {
      Analysis& analysis = analyses_[i / bands_];
      const auto band = static_cast<unsigned>(i % bands_);
      analysis.components.scan(band, prepare(analysis, band, rows, layer.index));
    });
    executor_.for_each(analyses_.size(), [&](uint64_t i) { analyses_[i].components.join(height); });
    executor_.for_each(tasks, [&](uint64_t i) {
      Analysis& analysis = analyses_[i / bands_];
      const auto band = static_cast<unsigned>(i % bands_);
      analysis.components.settle(band);
      if (analysis.samples != Samples::overhang) return;
      const size_t begin = analysis.components.first_row(band) * words_,
                   end = analysis.components.end_row(band) * words_;
      std::copy(rows + begin, rows + end, below_.begin() + static_cast<std::ptrdiff_t>(begin));
    });
    for (Analysis& analysis : analyses_) take_events(analysis, analysis.components.finish());
    reserve_held();
    flush();
  }

  PrintabilityCounts end() {
    has_ended_ = true;
    for (Analysis& analysis : analyses_) take_events(analysis, analysis.components.end());
    flush();
    return counts_;
  }

 private:
  enum class Samples { solid, empty, thin, overhang };
  struct Analysis {
    Analysis(Samples of, Components made) : samples(of), components(std::move(made)) {}
    Samples samples;
    Components components;
    std::vector<uint64_t> rows;                  ///< none: those of the layer
    std::vector<std::vector<uint64_t>> scratch;  ///< of each band
  };

  bool finds(FindingKind kind) const { return (plan_.kinds & static_cast<uint32_t>(kind)) != 0; }
  double pixel_area() const { return grid_.spacing.x * grid_.spacing.y; }

  const uint64_t* rows_of(const LayerPart& bits) {
    if (bits.words) return bits.words;
    if (rows_.empty()) {
      reserve(words_ * grid_.ny * sizeof(uint64_t), "masks of layers");
      rows_.resize(words_ * grid_.ny);
    }
    read_bit_output(bits.data, rows_.size(), rows_.data());
    return rows_.data();
  }

  void reserve(uint64_t bytes, const char* what) {
    reservations_.push_back(Reservation(slicer_.model().context().budget, bytes, what));
  }
  /// Runs, totals and findings, as much as there is by now.
  void reserve_held() {
    uint64_t held = findings_.capacity() * sizeof(Finding);
    for (const Analysis& analysis : analyses_) held += analysis.components.held_bytes();
    if (held <= held_) return;
    reserve(held - held_, "the runs of layers");
    held_ = held;
  }

  /// The rows of a band of the samples that an analysis is about, among those of the whole layer.
  const uint64_t* prepare(Analysis& analysis, unsigned band, const uint64_t* rows, uint64_t index) {
    const uint64_t begin = analysis.components.first_row(band),
                   end = analysis.components.end_row(band);
    uint64_t* out = analysis.rows.data();
    switch (analysis.samples) {
      case Samples::solid:
        return rows;
      case Samples::empty: {
        const uint64_t last = ~uint64_t{0} >> (bits_per_word - 1 - (grid_.nx - 1) % bits_per_word);
        for (uint64_t j = begin; j < end; ++j)
          invert_row(rows + j * words_, words_, last, out + j * words_);
        return out;
      }
      case Samples::thin:
        thin_->find({rows, words_, grid_.ny}, begin, end, analysis.scratch[band].data(), out);
        return out;
      case Samples::overhang:
        // The first layer stays without.
        if (index > 0)
          overhangs_->find({rows, words_, grid_.ny}, below_.data(), begin, end,
                           analysis.scratch[band].data(), out);
        return out;
    }
    return out;
  }

  void take_events(const Analysis& analysis, const Components::Events& events) {
    switch (analysis.samples) {
      case Samples::solid:
        for (const ComponentTotals& island : events.islands) add(FindingKind::island, island);
        for (const ComponentTotals& part : events.ended) add_part(part);
        return;
      case Samples::empty:
        for (const ComponentTotals& cup : events.cups) add(FindingKind::cup, cup);
        // Voids that reach the last layer are open above.
        for (const ComponentTotals& empty : events.ended)
          add(has_ended_ ? FindingKind::cup : FindingKind::enclosed_void, empty);
        return;
      case Samples::thin:
        for (const ComponentTotals& place : events.ended) add(FindingKind::thin, place);
        return;
      case Samples::overhang:
        for (const ComponentTotals& place : events.ended) add(FindingKind::overhang, place);
        return;
    }
  }

  /// Of several parts without a plate, the largest is the part itself, and of equal ones the first.
  void add_part(const ComponentTotals& part) {
    if (plan_.has_plate) return add(FindingKind::loose, part);
    const auto begin_of = [](const ComponentTotals& of) {
      return std::tuple(of.first_layer, of.place[1], of.place[0]);
    };
    if (!part_) {
      part_ = part;
    } else if (part.samples > part_->samples ||
               (part.samples == part_->samples && begin_of(part) < begin_of(*part_))) {
      add(FindingKind::loose, *part_);
      part_ = part;
    } else {
      add(FindingKind::loose, part);
    }
  }

  void add(FindingKind kind, const ComponentTotals& totals) {
    if (!finds(kind)) return;
    const double volume =
        (kind == FindingKind::island
             ? static_cast<double>(totals.samples) * (layer_face(slicer_, totals.first_layer, 1) -
                                                      layer_face(slicer_, totals.first_layer, 0))
             : totals.height_sum) *
        pixel_area();
    if (volume < plan_.min_volume) return;
    const auto index = static_cast<size_t>(std::countr_zero(static_cast<uint32_t>(kind)));
    ++counts_.counts[index];
    counts_.volumes[index] += volume;
    if (!take_) return;
    const Vec3 half{0.5 * grid_.spacing.x, 0.5 * grid_.spacing.y, 0};
    Finding found{kind, 0, totals.first_layer, totals.last_layer, totals.samples, volume, {},
                  {},   {}};
    found.point = grid_.at(totals.place[0], totals.place[1], totals.first_layer);
    found.min = grid_.at(totals.low[0], totals.low[1], totals.first_layer) - half;
    found.max = grid_.at(totals.high[0], totals.high[1], totals.last_layer) + half;
    found.min.z = layer_face(slicer_, totals.first_layer, 0);
    found.max.z = layer_face(slicer_, totals.last_layer, 1);
    findings_.push_back(found);
    if (findings_.size() == max_batch) flush();
  }

  void flush() {
    if (!findings_.empty()) take_(findings_.data(), findings_.size());
    findings_.clear();
  }

  const Slicer& slicer_;
  const SampleGrid& grid_;
  const PrintabilityPlan plan_;
  const std::function<void(const Finding*, size_t)>& take_;
  const Executor& executor_;
  const size_t words_;  ///< of a row
  uint64_t bands_ = 1;
  std::vector<Reservation> reservations_;
  uint64_t held_ = 0;
  std::vector<Analysis> analyses_;
  std::vector<uint64_t> below_;  ///< the layer before, for overhangs
  std::vector<uint64_t> rows_;   ///< the layer, if it was filled in bands
  std::optional<ThinSamples> thin_;
  std::optional<OverhangSamples> overhangs_;
  std::optional<ComponentTotals> part_;
  bool has_ended_ = false;
  std::vector<Finding> findings_;
  PrintabilityCounts counts_;
};

}  // namespace

PrintabilityCounts find_doubtful(const Slicer& slicer, const PrintabilityPlan& plan,
                                 const std::function<void(const Finding*, size_t)>& take,
                                 Job* job) {
  const Ref<const Slicer> bits =
      make_ref<Slicer>(Ref<const Model>(&slicer.model()), plan_of_bits(slicer));
  JobScope scope(job);
  // The run is a part of the call, and the host is still to be called after it.
  const Ref<Job> of_run = job ? make_ref<Job>(job) : Ref<Job>();
  const uint64_t count = bits->grid().nz;
  Inspection inspection(*bits, plan, take);
  bits->run(
      0, count,
      [&](const Layer& layer) {
        inspection.add_layer(layer);
        if (job)
          job->set_progress(static_cast<double>(layer.index + 1) / static_cast<double>(count + 1));
      },
      of_run.get());
  if (job) job->counts().add(of_run->counts());
  const PrintabilityCounts counts = inspection.end();
  scope.done();
  return counts;
}

}  // namespace msq
