// SPDX-License-Identifier: Apache-2.0
// Stands in for tiff_image.cpp.
#include "base/status.h"
#include "io/image_file.h"

namespace msq {

bool can_read_tiff() {
  return false;
}

ImageFile read_tiff_files(std::span<const std::string> paths, const ImageFileOptions&) {
  fail(Status::unsupported, "%s: this build of msq does not read TIFF (MSQ_WITH_TIFF is off)",
       paths.empty() ? "" : shown(paths[0]).c_str());
}

}  // namespace msq
