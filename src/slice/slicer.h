// SPDX-License-Identifier: Apache-2.0
// Slices of a model, slab by slab. Source: paper, section "Slicing".
#pragma once

#include <functional>
#include <vector>

#include "base/job.h"
#include "base/sample_grid.h"
#include "model/model.h"
#include "slice/layer_frame.h"
#include "slice/layer_output.h"
#include "slice/layers_ahead.h"
#include "slice/orientation.h"
#include "slice/slabs_ahead.h"

namespace msq {

/// What a host may leave open is filled in by the constructor of Slicer; see msq_slicer_def.
struct SlicePlan {
  std::vector<OutputPlan> outputs = {OutputPlan{}};  ///< at least one
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
  Orientation orientation;
  /// Region, pixels, heights and layers are in its coordinates.
  LayerFrame frame;
  /// Layers of a run come with LayerPart::words.
  bool keeps_words = false;
};

/// What one of the outputs is in a layer.
struct LayerPart {
  const uint8_t* data = nullptr;  ///< null: contours
  /// Rows of the bits that the output is made of, before they are turned; null: it has none, the
  /// plan does not keep them, or the layer was filled in bands.
  const uint64_t* words = nullptr;
  uint64_t inside_count = 0;
  Contours* contours = nullptr;
};

struct Layer {
  uint64_t index;
  double z;
  const std::vector<LayerPart>& parts;  ///< of each output

  const LayerPart& main() const { return parts.front(); }
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
  size_t output_count() const { return outputs_.size(); }
  LayerFormat format(size_t output) const { return outputs_[output].plan.format; }
  /// Pixels of a layer that is written: those of the grid, exchanged if the plan transposes.
  uint64_t width() const { return plan_.orientation.transpose ? grid_.ny : grid_.nx; }
  uint64_t height() const { return plan_.orientation.transpose ? grid_.nx : grid_.ny; }
  uint64_t slab_layers() const { return slab_layers_; }
  /// Of an output. 0: contours.
  uint64_t stride(size_t output = 0) const {
    const LayerOutput* pixels = outputs_[output].pixels.get();
    return pixels ? layer_stride(pixels->pixel_bytes(), width()) : 0;
  }
  uint64_t layer_bytes(size_t output = 0) const { return stride(output) * height(); }

  /// Calls take(layer) for layers [first, last) in order, on this thread, while workers compute the
  /// next slab. What take() throws ends the run and is passed on.
  void run(uint64_t first, uint64_t last, const std::function<void(const Layer&)>& take,
           Job* job) const;

  /// The first output of one layer, which must not be contours, into layer_bytes(0) bytes.
  void slice_layer(uint64_t index, uint8_t* out, Job* job) const;

  /// Contours of a layer. `plan`: all but the plane and the length scale; without a window, that of
  /// the pixels.
  Ref<Contours> contours(uint64_t index, ContourPlan plan, Job* job) const;

 private:
  static constexpr size_t no_samples = SIZE_MAX;
  struct Output {
    OutputPlan plan;
    std::unique_ptr<const LayerOutput> pixels;  ///< null: contours
    size_t samples = no_samples;                ///< which of samples_
  };

  /// Of the frame.
  const char* axis_name(int axis) const;
  void plan_axis(int axis);
  void plan_layers();
  void plan_outputs();
  void plan_slabs();
  /// Layers of a slab, if the plan does not say; in_run: of slabs that become what row_output()
  /// says.
  uint64_t automatic_layers(bool in_run) const;
  /// Whether slabs have no more layers than caches hold: the structures do not gain by more.
  bool is_shallow() const;
  /// Of slabs of at most so many layers.
  SlabsAhead::Depth slab_depth(uint64_t layers) const;
  /// What a run computes at once, and the bytes that this takes.
  struct Portions {
    SlabsAhead::Depth depth;
    SlabsAhead::Bands bands;
    uint64_t bytes;
  };
  /// Of a run of so many layers, in what the context's memory_limit leaves beside these bytes.
  Portions portions(uint64_t layers, uint64_t beside) const;
  /// Rows of pixels of a layer to compute at once: as many as fit, if any do. bytes_of(rows): what
  /// they take.
  uint64_t band_rows(uint64_t max_sample_bytes,
                     const std::function<uint64_t(uint64_t)>& bytes_of) const;
  SampleGrid divided_pixels(unsigned across) const;
  /// What the rows of some samples become while they are filled in whole layers, if nothing else
  /// needs them; otherwise null.
  const RowOutput* row_output(size_t samples) const;
  /// Of a run in bands of so many rows of pixels.
  std::vector<SlabsAhead::GridUse> uses_of_samples(uint64_t band_rows) const;
  /// Whether all outputs of some samples serve without the rows that repeat others.
  bool takes_repeats(size_t samples) const;
  /// Bytes of rows of an output as it writes them, before they are turned; 0 where they are not.
  uint64_t plain_bytes(const Output& output, uint64_t rows) const;
  struct SampleRows {
    const uint64_t* words = nullptr;
    const RowRepeats* repeats = nullptr;  ///< as in LayerSource
    const RowFlips* flips = nullptr;
  };
  /// Writes rows [begin, end) of a layer from their bits, where the output has samples. The bands
  /// of a layer come in order. `plain`: plain_bytes(). `out`: of the whole layer.
  uint64_t write(const Output& output, uint64_t index, uint64_t begin, uint64_t end,
                 const SampleRows& samples, uint8_t* plain, uint8_t* out, Job* job) const;

  Ref<const Model> model_;
  SlicePlan plan_;
  Scales resolved_;
  /// The model in the coordinates of the frame, for bits and contours.
  Ref<const Model> framed_;
  Scales framed_resolved_;
  SampleGrid grid_;
  std::vector<Output> outputs_;
  /// What the bits of outputs are of: the pixels, or finer grids of the same layers. No two are
  /// equal.
  std::vector<SampleGrid> samples_;
  std::vector<RowRepeats> repeats_;  ///< of samples_
  std::array<uint64_t, 3> whole_;
  uint64_t slab_layers_ = 1;
  std::unique_ptr<LayersAhead> ahead_;  ///< null where single layers cost no more
};

}  // namespace msq
