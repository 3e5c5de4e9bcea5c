// SPDX-License-Identifier: Apache-2.0
#include "slice/layer_output.h"

namespace msq {

SampleGrid divided(const SampleGrid& pixels, unsigned across) {
  SampleGrid samples = pixels;
  for (int axis = 0; axis < 2; ++axis) {
    samples.spacing[axis] = pixels.spacing[axis] / across;
    samples.origin[axis] = pixels.origin[axis] + (0.5 / across - 0.5) * pixels.spacing[axis];
    samples.first[static_cast<size_t>(axis)] *= across;
  }
  samples.nx *= across;
  samples.ny *= across;
  return samples;
}

std::unique_ptr<const LayerOutput> make_layer_output(LayerFormat format, const GreyScale& grey) {
  switch (format) {
    case LayerFormat::bits:
      return make_bit_output();
    case LayerFormat::bytes:
      return make_byte_output();
    case LayerFormat::grey:
      return make_grey_output(grey);
    case LayerFormat::distance:
      return make_distance_output();
    case LayerFormat::material:
      return make_material_output();
  }
  return nullptr;
}

}  // namespace msq
