// SPDX-License-Identifier: Apache-2.0
// Slices of a model, slab by slab. Source: paper, section "Slicing".
#pragma once

#include <functional>
#include <vector>

#include "base/job.h"
#include "base/sample_grid.h"
#include "model/model.h"
#include "slice/layer_output.h"
#include "slice/layers_ahead.h"
#include "slice/orientation.h"

namespace msq {

/// What a host may leave open is filled in by the constructor of Slicer; see msq_slicer_def.
struct SlicePlan {
  LayerFormat format = LayerFormat::bits;
  double pitch[2] = {0, 0};
  uint32_t resolution[2] = {0, 0};
  double layer_height = 0;
  uint64_t layer_count = 0;
  bool has_region = false;
  Box3 region;
  uint32_t slab_layers = 0;
  std::vector<double> heights;
  double length_scale = 0;
  SampleWindow window;
  GreyScale grey;
  Orientation orientation;
};

struct Layer {
  uint64_t index;
  double z;
  const uint8_t* data;
  uint64_t inside_count;
};

class Slicer final : public RefCounted {
 public:
  Slicer(Ref<const Model> model, SlicePlan plan);

  const Model& model() const { return *model_; }
  double length_scale() const { return plan_.length_scale; }
  /// As completed by the constructor; a slicer of it has the same grid.
  const SlicePlan& plan() const { return plan_; }
  /// Of the window. Layers are counted in it.
  const SampleGrid& grid() const { return grid_; }
  /// Pixels along x and y, and layers, of the whole plan.
  const std::array<uint64_t, 3>& whole() const { return whole_; }
  LayerFormat format() const { return plan_.format; }
  /// Pixels of a layer that is written: those of the grid, exchanged if the plan transposes.
  uint64_t width() const { return plan_.orientation.transpose ? grid_.ny : grid_.nx; }
  uint64_t height() const { return plan_.orientation.transpose ? grid_.nx : grid_.ny; }
  uint64_t slab_layers() const { return slab_layers_; }
  uint64_t stride() const { return layer_stride(output_->pixel_bytes(), width()); }
  uint64_t layer_bytes() const { return stride() * height(); }

  /// Calls take(layer) for layers [first, last) in order, on this thread, while workers compute the
  /// next slab. What take() throws ends the run and is passed on.
  void run(uint64_t first, uint64_t last, const std::function<void(const Layer&)>& take,
           Job* job) const;

  /// One layer into layer_bytes() bytes.
  void slice_layer(uint64_t index, uint8_t* out, Job* job) const;

 private:
  void plan_axis(int axis);
  void plan_layers();
  void plan_samples();
  void plan_slabs();
  /// Bytes of a layer as the output writes it, before it is turned; 0 where it is not.
  uint64_t plain_bytes() const;
  /// Writes one layer from its bits, where the output has samples. `plain`: plain_bytes().
  uint64_t write(uint64_t index, const uint64_t* words, uint8_t* plain, uint8_t* out,
                 Job* job) const;
  void run_by_layers(uint64_t first, uint64_t last, const std::function<void(const Layer&)>& take,
                     Job* job) const;

  Ref<const Model> model_;
  SlicePlan plan_;
  Scales resolved_;
  const std::unique_ptr<const LayerOutput> output_;
  SampleGrid grid_;
  /// What the bits are of: the pixels, or a finer grid of the same layers. Empty for outputs that
  /// have no samples.
  SampleGrid samples_;
  std::array<uint64_t, 3> whole_;
  uint64_t slab_layers_ = 1;
  std::unique_ptr<LayersAhead> ahead_;  ///< null where single layers cost no more
};

}  // namespace msq
