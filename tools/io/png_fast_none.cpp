// SPDX-License-Identifier: Apache-2.0
// Stands in for png_fast_isal.cpp in a build without ISA-L.
#include "png_stream.h"

namespace msq_io {

bool encode_fast(const PngRows&, const std::vector<uint8_t>&, std::vector<uint8_t>&) {
  return false;
}

}  // namespace msq_io
