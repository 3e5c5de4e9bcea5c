// SPDX-License-Identifier: Apache-2.0
#include "atomic_file.h"

#include <algorithm>
#include <cerrno>
#include <limits>

#include "error.h"
#include "names.h"

#ifdef _WIN32
#include <io.h>
#else
#include <unistd.h>
#endif

namespace fs = std::filesystem;

namespace msq_io {

namespace {

int seek_to(std::FILE* file, uint64_t offset) {
#ifdef _WIN32
  return _fseeki64(file, static_cast<long long>(offset), SEEK_SET);
#else
  return fseeko(file, static_cast<off_t>(offset), SEEK_SET);
#endif
}

/// 0, or an errno value. Files that cannot be synchronised, on some network disks, pass.
int synchronise(std::FILE* file) {
#ifdef _WIN32
  return _commit(_fileno(file)) == 0 ? 0 : errno;
#else
  if (fsync(fileno(file)) == 0 || errno == EINVAL || errno == ENOTSUP || errno == ENOSYS) return 0;
  return errno;
#endif
}

/// The path itself, or what its symbolic link leads to, which need not exist, so that the link
/// stays.
fs::path target_of(const fs::path& path) {
  constexpr int max_links = 40;
  fs::path target = path;
  for (int links = 0; links < max_links; ++links) {
    std::error_code error;
    if (!fs::is_symlink(target, error)) return target;
    const fs::path next = fs::read_symlink(target, error);
    if (error) return path;
    target = target.parent_path() / next;  // `next` itself if it is absolute
  }
  return path;
}

}  // namespace

std::FILE* create_file(const fs::path& path) {
#ifdef _WIN32
  return _wfopen(path.c_str(), L"wbx");
#else
  return std::fopen(path.c_str(), "wbx");
#endif
}

AtomicFile::AtomicFile(const fs::path& path, bool replace)
    : path_(target_of(path)), replace_(replace) {
  std::error_code error;
  const fs::file_status status = fs::status(path_, error);
  if (fs::exists(status)) {
    if (!fs::is_regular_file(status))
      throw Error(MSQ_E_IO, "cannot write, not a plain file: " + text_of(path_));
    if (!replace) throw Error(MSQ_E_IO, "the file exists and replace is 0: " + text_of(path_));
  }
  if (!path_.has_filename()) throw Error(MSQ_E_IO, "not the name of a file: " + text_of(path_));
  for (int tries = 0; !file_; ++tries) {
    temporary_ = temporary_name(path_.parent_path(), path_.filename());
    file_ = create_file(temporary_);
    if (!file_ && (errno != EEXIST || tries == 100))
      fail_io("cannot create the file", errno, text_of(path_));
  }
}

AtomicFile::~AtomicFile() {
  remove();
}

void AtomicFile::remove() noexcept {
  if (temporary_.empty()) return;
  if (file_) std::fclose(file_);
  file_ = nullptr;
  std::error_code error;
  fs::remove(temporary_, error);
  temporary_.clear();
}

void AtomicFile::fail_write(int code) const {
  fail_io("cannot write the file", code ? code : EIO, text_of(path_));
}

void AtomicFile::write(const void* bytes, uint64_t size) {
  const auto* next = static_cast<const char*>(bytes);
  errno = 0;
  for (uint64_t left = size; left > 0;) {
    const auto part = static_cast<size_t>(std::min<uint64_t>(left, uint64_t{1} << 30));
    if (std::fwrite(next, 1, part, file_) != part) fail_write(errno);
    next += part;
    left -= part;
  }
  offset_ += size;
  size_ = std::max(size_, offset_);
}

void AtomicFile::seek(uint64_t offset) {
  if (offset == offset_) return;
  errno = 0;
  if (offset > static_cast<uint64_t>(std::numeric_limits<int64_t>::max()) ||
      seek_to(file_, offset) != 0)
    fail_write(errno);
  offset_ = offset;
}

void AtomicFile::commit() {
  errno = 0;
  if (std::fflush(file_) != 0) fail_write(errno);
  if (const int code = synchronise(file_)) fail_write(code);
  const int closed = std::fclose(file_);
  file_ = nullptr;
  if (closed != 0) fail_write(errno);
  // Where the disk has none, a file is replaced without.
  std::error_code error;
  if (const fs::file_status replaced = fs::status(path_, error); fs::exists(replaced))
    fs::permissions(temporary_, replaced.permissions(), error);
  if (const int code = rename_to(temporary_, path_, replace_))
    fail_io("cannot give the file its name", code, text_of(path_));
  temporary_.clear();
}

}  // namespace msq_io
