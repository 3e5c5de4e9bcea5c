// SPDX-License-Identifier: Apache-2.0
// Slices of a model, slab by slab. Source: paper, section "Slicing".
#pragma once

#include <functional>
#include <vector>

#include "base/job.h"
#include "base/sample_grid.h"
#include "model/model.h"
#include "slice/layer_format.h"

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

  const SampleGrid& grid() const { return grid_; }
  LayerFormat format() const { return plan_.format; }
  uint64_t slab_layers() const { return slab_layers_; }
  uint64_t stride() const { return layer_stride(plan_.format, grid_.nx); }
  uint64_t layer_bytes() const { return stride() * grid_.ny; }

  /// Calls take(layer) for layers [first, last) in order, on this thread, while workers compute the
  /// next slab. What take() throws ends the run and is passed on.
  void run(uint64_t first, uint64_t last, const std::function<void(const Layer&)>& take,
           Job* job) const;

  /// One layer into layer_bytes() bytes.
  void slice_layer(uint64_t index, uint8_t* out, Job* job) const;

 private:
  void plan_axis(int axis);
  void plan_layers();
  void plan_slabs();

  Ref<const Model> model_;
  SlicePlan plan_;
  Scales resolved_;
  SampleGrid grid_;
  uint64_t slab_layers_ = 1;
};

}  // namespace msq
