// SPDX-License-Identifier: Apache-2.0
// msq_io_file, and meshes that are written through it.
#include <optional>

#include "atomic_file.h"
#include "defs.h"
#include "names.h"

using namespace msq_io;

struct msq_io_file {
  std::optional<AtomicFile> file;
  std::optional<Failure> error;
  bool is_finished = false;

  template <class Body>
  void step(Body&& body) {
    if (error) raise(*error);
    if (is_finished) fail(MSQ_E_ARGUMENT, "the file is finished");
    try {
      body(*file);
    } catch (...) {
      error = current_failure();
      file.reset();
      raise(*error);
    }
  }
};

msq_status msq_io_file_create(const char* path, int32_t replace, msq_io_file** file) {
  return guard([&] {
    require(file, "file");
    const std::filesystem::path name = read_path(path);
    const bool replaces = require_range(replace, 0, 1, "replace") != 0;
    auto made = std::make_unique<msq_io_file>();
    made->file.emplace(name, replaces);
    *file = made.release();
  });
}

msq_status msq_io_file_write(msq_io_file* file, const void* bytes, uint64_t size) {
  return guard([&] {
    msq_io_file& to = require(file, "file");
    if (size > 0 && !bytes) fail(MSQ_E_ARGUMENT, "bytes is NULL");
    to.step([&](AtomicFile& open) {
      open.seek(open.size());
      open.write(bytes, size);
    });
  });
}

int32_t msq_io_file_part(void* user, const msq_file_part* part) {
  return guard([&] {
    auto& to = require(static_cast<msq_io_file*>(user), "user");
    const msq_file_part& from = require(part, "part");
    to.step([&](AtomicFile& open) {
      open.seek(from.offset);
      open.write(from.bytes, from.size);
    });
  });
}

msq_status msq_io_file_finish(msq_io_file* file) {
  return guard([&] {
    msq_io_file& to = require(file, "file");
    to.step([&](AtomicFile& open) {
      open.commit();
      to.is_finished = true;
    });
    to.file.reset();
  });
}

void msq_io_file_release(msq_io_file* file) {
  delete file;
}

msq_status msq_io_surface_save(const msq_model* model, const msq_surface_def* def, int32_t format,
                               const char* path, int32_t replace, msq_job* job) {
  return guard([&] {
    const std::filesystem::path name = read_path(path);
    const bool replaces = require_range(replace, 0, 1, "replace") != 0;
    msq_io_file file;
    file.file.emplace(name, replaces);
    const msq_status status = msq_surface_file(model, def, format, msq_io_file_part, &file, job);
    if (file.error) raise(*file.error);
    check_msq(status);
    file.file->commit();
  });
}
