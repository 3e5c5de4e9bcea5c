// SPDX-License-Identifier: Apache-2.0
#include "output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <cstdlib>
#include <cstring>

#include "failure.h"
#include "watch.h"

namespace command {

namespace {

constexpr size_t BUFFER = 1 << 18;

// Follows symbolic links, so that what they point to is replaced and not they.
std::string resolved(const std::string& path) {
  char found[PATH_MAX];
  return realpath(path.c_str(), found) ? found : path;
}

// Calls what writes a part of some bytes and returns how many, until all are written. Returns 0 or
// an errno value.
template <class F>
int write_all(const char* bytes, size_t count, F&& write_part) {
  while (count > 0) {
    const ssize_t written = write_part(bytes, count);
    if (written < 0) {
      if (errno != EINTR) return errno;
      heed_signals();
      continue;
    }
    if (written == 0) return ENOSPC;
    bytes += written;
    count -= static_cast<size_t>(written);
  }
  return 0;
}

}  // namespace

OutputFile::OutputFile(const std::string& path) : path_(path) {
  if (path == "-") {
    file_ = STDOUT_FILENO;
    path_ = "standard output";
    return;
  }
  struct stat status = {};
  const bool exists = stat(path.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode)) fail(EISDIR);
  if (exists && !S_ISREG(status.st_mode)) {
    file_ = open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (file_ < 0) fail(errno);
    return;
  }
  if (exists && access(path.c_str(), W_OK) != 0) fail(errno);
  final_ = exists ? resolved(path) : path;
  temporary_ = final_ + ".part" + std::to_string(getpid());
  file_ = open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (file_ < 0) {
    const int code = errno;
    temporary_.clear();
    fail(code);
  }
  guard_file(temporary_.c_str());
}

OutputFile::~OutputFile() {
  if (file_ >= 0 && file_ != STDOUT_FILENO) close(file_);
  if (!temporary_.empty()) {
    unlink(temporary_.c_str());
    guard_file(nullptr);
  }
}

void OutputFile::write(const void* bytes, size_t count) {
  if (count < BUFFER) {
    buffer_.append(static_cast<const char*>(bytes), count);
    if (buffer_.size() >= BUFFER) flush();
    return;
  }
  flush();
  const int code = write_all(static_cast<const char*>(bytes), count,
                             [&](const char* at, size_t n) { return ::write(file_, at, n); });
  if (code != 0) fail(code);
}

void OutputFile::write_at(uint64_t offset, const void* bytes, size_t count) {
  const int code = write_all(static_cast<const char*>(bytes), count, [&](const char* at, size_t n) {
    const ssize_t written = pwrite(file_, at, n, static_cast<off_t>(offset));
    if (written > 0) offset += static_cast<uint64_t>(written);
    return written;
  });
  if (code != 0) fail(code);
}

void OutputFile::flush() {
  std::string bytes;
  bytes.swap(buffer_);
  const int code = write_all(bytes.data(), bytes.size(),
                             [&](const char* at, size_t n) { return ::write(file_, at, n); });
  if (code != 0) fail(code);
}

void OutputFile::commit() {
  flush();
  if (file_ == STDOUT_FILENO) return;
  const int file = file_;
  file_ = -1;
  if (close(file) != 0 && errno != EINTR) fail(errno);  // a full disk may show only now
  if (temporary_.empty()) return;
  heed_signals();
  if (rename(temporary_.c_str(), final_.c_str()) != 0) fail(errno);
  temporary_.clear();
  guard_file(nullptr);
}

void OutputFile::fail(int code) const {
  throw Failure(path_ + ": " + std::strerror(code));
}

}  // namespace command
