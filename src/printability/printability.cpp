// SPDX-License-Identifier: Apache-2.0
#include "printability/printability.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <optional>

#include "printability/components.h"
#include "printability/thin.h"

namespace msq {

namespace {

constexpr size_t max_batch = 4096;

/// The plan of the slicer's samples, one per pixel, as bits.
SlicePlan plan_of_bits(const Slicer& slicer) {
  SlicePlan plan = slicer.plan();
  plan.outputs = {OutputPlan{}};
  plan.orientation = {};
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

class Inspection {
 public:
  Inspection(const Slicer& slicer, const PrintabilityPlan& plan,
             const std::function<void(const Finding*, size_t)>& take)
      : slicer_(slicer), grid_(slicer.grid()), plan_(plan), take_(take) {
    const uint64_t nx = grid_.nx, ny = grid_.ny;
    const bool finds_islands = finds(FindingKind::island), finds_loose = finds(FindingKind::loose);
    const uint64_t mask = words_for(nx) * ny * sizeof(uint64_t);
    uint64_t bytes = mask;
    if (finds_islands || finds_loose) bytes += Components::bytes(nx, ny);
    if (finds(FindingKind::enclosed_void)) bytes += Components::bytes(nx, ny) + mask;
    if (finds(FindingKind::thin)) bytes += Components::bytes(nx, ny) + ThinSamples::bytes(nx, ny);
    reservation_ = Reservation(slicer.model().context().budget, bytes, "masks of layers");
    bits_.resize(words_for(nx) * ny);
    if (finds_islands || finds_loose) {
      Components::Rules rules;
      rules.joins_corners = true;
      rules.anchors_first_layer = plan.has_plate;
      rules.finds_islands = finds_islands;
      solid_.emplace(
          nx, ny, rules, [this](const ComponentTotals& part) { add_part(part); },
          [this](const ComponentTotals& island) { add(FindingKind::island, island); });
    }
    if (finds(FindingKind::enclosed_void)) {
      Components::Rules rules;
      rules.anchors_sides = true;
      rules.anchors_first_layer = !plan.has_plate;
      empty_.emplace(nx, ny, rules, [this](const ComponentTotals& totals) {
        add(FindingKind::enclosed_void, totals);
      });
      gaps_.resize(bits_.size());
    }
    if (finds(FindingKind::thin)) {
      const unsigned across[2] = {samples_across(plan.width, grid_.spacing.x, 'x'),
                                  samples_across(plan.width, grid_.spacing.y, 'y')};
      thin_samples_.emplace(nx, ny, across);
      Components::Rules rules;
      rules.joins_corners = true;
      thin_.emplace(nx, ny, rules,
                    [this](const ComponentTotals& totals) { add(FindingKind::thin, totals); });
    }
  }

  void add_layer(const Layer& layer) {
    read_bits(layer.main().data);
    const double height = layer_face(slicer_, layer.index, 1) - layer_face(slicer_, layer.index, 0);
    ++counts_.layers;
    counts_.solid_samples += layer.main().inside_count;
    counts_.solid_volume += static_cast<double>(layer.main().inside_count) * pixel_area() * height;
    if (solid_) solid_->add_layer(bits_.data(), height);
    if (empty_) empty_->add_layer(gaps_.data(), height);
    if (thin_) thin_->add_layer(thin_samples_->find(bits_.data()), height);
    flush();
  }

  PrintabilityCounts end() {
    if (solid_) solid_->end();
    if (thin_) thin_->end();
    // Voids that reach the last layer are open above.
    flush();
    return counts_;
  }

 private:
  bool finds(FindingKind kind) const { return (plan_.kinds & static_cast<uint32_t>(kind)) != 0; }
  double pixel_area() const { return grid_.spacing.x * grid_.spacing.y; }

  /// The bits of a layer, and the empty ones. Pixel i of a layer is bit 7 - i % 8 of byte i / 8.
  void read_bits(const uint8_t* data) {
    const size_t words = words_for(grid_.nx);
    static_assert(std::endian::native == std::endian::little);
    std::memcpy(bits_.data(), data, bits_.size() * sizeof(uint64_t));
    for (uint64_t& word : bits_) {
      word = (word >> 1 & 0x5555555555555555u) | (word & 0x5555555555555555u) << 1;
      word = (word >> 2 & 0x3333333333333333u) | (word & 0x3333333333333333u) << 2;
      word = (word >> 4 & 0x0f0f0f0f0f0f0f0fu) | (word & 0x0f0f0f0f0f0f0f0fu) << 4;
    }
    if (gaps_.empty()) return;
    for (size_t i = 0; i < bits_.size(); ++i) gaps_[i] = ~bits_[i];
    const uint64_t last = ~uint64_t{0} >> (bits_per_word - 1 - (grid_.nx - 1) % bits_per_word);
    for (uint64_t j = 0; j < grid_.ny; ++j) gaps_[(j + 1) * words - 1] &= last;
  }

  /// Of several parts without a plate, the largest is the part itself.
  void add_part(const ComponentTotals& part) {
    if (!finds(FindingKind::loose)) return;
    if (plan_.has_plate) return add(FindingKind::loose, part);
    if (!part_) {
      part_ = part;
    } else if (part.samples > part_->samples) {
      add(FindingKind::loose, *part_);
      part_ = part;
    } else {
      add(FindingKind::loose, part);
    }
  }

  void add(FindingKind kind, const ComponentTotals& totals) {
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
  }

  void flush() {
    for (size_t i = 0; i < findings_.size(); i += max_batch)
      take_(findings_.data() + i, std::min(max_batch, findings_.size() - i));
    findings_.clear();
  }

  const Slicer& slicer_;
  const SampleGrid& grid_;
  const PrintabilityPlan plan_;
  const std::function<void(const Finding*, size_t)>& take_;
  Reservation reservation_;
  std::vector<uint64_t> bits_, gaps_;
  std::optional<Components> solid_, empty_, thin_;
  std::optional<ThinSamples> thin_samples_;
  std::optional<ComponentTotals> part_;
  std::vector<Finding> findings_;
  PrintabilityCounts counts_;
};

}  // namespace

PrintabilityCounts find_doubtful(const Slicer& slicer, const PrintabilityPlan& plan,
                                 const std::function<void(const Finding*, size_t)>& take,
                                 Job* job) {
  const Ref<const Slicer> bits =
      make_ref<Slicer>(Ref<const Model>(&slicer.model()), plan_of_bits(slicer));
  Inspection inspection(*bits, plan, take);
  bits->run(
      0, bits->grid().nz, [&](const Layer& layer) { inspection.add_layer(layer); }, job);
  return inspection.end();
}

}  // namespace msq
