// SPDX-License-Identifier: Apache-2.0
// What a slicer makes of a layer: pixels, or contours. An output of pixels is one file with one
// line in make_layer_output().
//
// Three kinds of source serve outputs of pixels: the bits of one sample per pixel, the bits of
// k x k samples per pixel (coverage), and no bits at all, where the output computes values itself.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "base/job.h"
#include "base/sample_grid.h"
#include "model/model.h"
#include "query/repeating_rows.h"
#include "slice/contours.h"
#include "slice/layer_frame.h"

namespace msq {

enum class LayerFormat : int32_t {
  bits = 1,
  bytes = 2,
  grey = 3,
  distance = 4,
  material = 5,
  onset = 6,
  contours = 7,
  channel = 8
};

/// How coverage becomes grey. See msq_slicer_def.
struct GreyScale {
  unsigned samples = 4;  ///< per pixel along x and along y: 2, 4, 8 or 16
  double gamma = 1;
  unsigned threshold = 0;  ///< smaller values become 0
};

/// One of the things that a slicer makes of each layer. See msq_output_def.
struct OutputPlan {
  LayerFormat format = LayerFormat::bits;
  GreyScale grey;
  size_t onset_scale = 0;  ///< 0: the finest that is resolved
  bool is_onset_signed = false;
  std::string channel{};
  /// Plane and length scale are those of the slicer.
  ContourPlan contours;
};

/// One layer, to be written.
struct LayerSource {
  const Model& model;
  const Scales& resolved;
  const LayerFrame& frame;
  SampleGrid pixels;      ///< of the one layer, in the frame
  const uint64_t* words;  ///< rows of bits in words_for() words; null for outputs without samples
  Job* job;
  /// Of `words`: null if all rows are there. Otherwise those that repeat others are not.
  const RowRepeats* repeats = nullptr;
  const RowFlips* flips = nullptr;  ///< of the layer, by rows
};

class LayerOutput {
 public:
  virtual ~LayerOutput() = default;

  /// Bytes of one pixel; 0: one bit.
  virtual unsigned pixel_bytes() const = 0;
  /// Samples per pixel along x and along y, whose bits the output is made from; 0: none.
  virtual unsigned samples_across() const = 0;
  /// Writes height rows of layer_stride() bytes, with zeros past the width. Returns the number of
  /// samples, or pixels where there are none, that are inside.
  virtual uint64_t write(const LayerSource& source, uint8_t* out) const = 0;
  /// Whether write() serves sources whose repeated rows are not there.
  virtual bool takes_repeats() const { return false; }
};

/// An output whose rows are made of their samples alone, so that a slab can be written while it is
/// filled.
class RowOutput : public LayerOutput {
 public:
  /// Writes rows of `width` pixels, of layer_stride() bytes, from the bits of samples_across() rows
  /// each, in words_for() words. `out` may be the words themselves if there is one sample per
  /// pixel, and one bit. Returns the number inside.
  virtual uint64_t write_rows(const uint64_t* words, uint64_t width, uint64_t rows,
                              uint8_t* out) const = 0;

  uint64_t write(const LayerSource& source, uint8_t* out) const override {
    return write_rows(source.words, source.pixels.nx, source.pixels.ny, out);
  }
};

/// Bytes from one row to the next, a multiple of 8.
inline uint64_t layer_stride(unsigned pixel_bytes, uint64_t width) {
  return pixel_bytes ? (width * pixel_bytes + 7) / 8 * 8 : words_for(width) * 8;
}

/// The samples of pixels divided into across x across. Sample a of pixel i along x lies at
/// x(i) + ((a + 1/2) / across - 1/2) * pitch, and so along y.
SampleGrid divided(const SampleGrid& pixels, unsigned across);

/// Null for contours. Throws Error(argument) and Error(unsupported) for what the resolved scales of
/// the model do not have.
std::unique_ptr<const LayerOutput> make_layer_output(const OutputPlan& plan, const Model& model,
                                                     const Scales& resolved);

/// The rows of bits, sample 0 in the lowest bit, that the bit output has written.
void read_bit_output(const uint8_t* written, size_t words, uint64_t* rows);

// Of the files of outputs, for make_layer_output().
std::unique_ptr<const LayerOutput> make_bit_output();
std::unique_ptr<const LayerOutput> make_byte_output();
std::unique_ptr<const LayerOutput> make_grey_output(const GreyScale& grey);
std::unique_ptr<const LayerOutput> make_distance_output();
std::unique_ptr<const LayerOutput> make_material_output();
std::unique_ptr<const LayerOutput> make_channel_output(const std::string& channel);
std::unique_ptr<const LayerOutput> make_onset_output(const Structure& structure, bool is_signed);

}  // namespace msq
