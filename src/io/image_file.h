// SPDX-License-Identifier: Apache-2.0
// Voxel images from files: NRRD with its values in the file, in raw encoding (teem's format,
// http://teem.sourceforge.net/nrrd/format.html), TIFF, and raw files whose layout is known.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "base/memory.h"
#include "base/status.h"
#include "io/whole_file.h"

namespace msq {

enum class ValueType { uint8, int16, uint16, float32, float64 };

struct ImageLayout {
  ValueType type = ValueType::uint8;
  uint64_t size[3] = {0, 0, 0};
  bool is_big_endian = false;
  uint64_t skip_bytes = 0;  ///< before the values
};

struct ImageFile {
  ImageLayout layout;
  /// As a file in NRRD says: value (i, j, k) is at origin + rotation * ((i, j, k) * spacing).
  double origin[3] = {0, 0, 0}, spacing[3] = {1, 1, 1};
  double rotation[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  FileContent content;
  Reservation reservation;  ///< of the content
  uint64_t read_bytes = 0;  ///< of the files, and of values that were compressed in them

  const void* values() const { return content.bytes.get() + layout.skip_bytes; }
};

struct ImageFileOptions {
  uint64_t max_bytes;
  std::shared_ptr<MemoryBudget> budget;
  const Job* job = nullptr;
};

/// The values in the byte order of the machine. Throws Error(io) for files that are missing or
/// malformed, Error(unsupported) for encodings and types that are not read, Error(limit).
ImageFile read_nrrd_file(const std::string& path, const ImageFileOptions& options);
ImageFile read_raw_file(const std::string& path, const ImageLayout& layout,
                        const ImageFileOptions& options);

/// False in builds without libtiff.
bool can_read_tiff();
/// The pages of the files, of one size and kind, one above the other: grey values of 8 or 16 bits.
/// The files and the values together have at most options.max_bytes. Throws as read_nrrd_file(),
/// and Error(unsupported) in builds without libtiff.
ImageFile read_tiff_files(std::span<const std::string> paths, const ImageFileOptions& options);

/// Runs body, and puts the path before what it is refused for.
template <class Body>
void of_file(const std::string& path, Body&& body) {
  try {
    body();
  } catch (const Error& error) {
    throw Error(error.status, shown(path) + ": " + error.what());
  }
}

}  // namespace msq
