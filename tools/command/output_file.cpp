// SPDX-License-Identifier: Apache-2.0
#include "output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "watch.h"

namespace command {

namespace {

constexpr size_t BUFFER = 1 << 18;

}  // namespace

void check_io(msq_status status) {
  if (status == MSQ_OK) return;
  if (status == MSQ_E_CANCELLED) throw Interrupted();
  throw Failure(msq_io_error_message());
}

OutputFile::OutputFile(const std::string& path) : path_(path) {
  // What the shell has opened goes on from where it is, also if it is a plain file.
  if (path == "-" || path == "/dev/stdout" || path == "/dev/fd/1" || path == "/proc/self/fd/1") {
    descriptor_ = STDOUT_FILENO;
    path_ = "standard output";
    return;
  }
  if (path == "/dev/stderr" || path == "/dev/fd/2" || path == "/proc/self/fd/2") {
    descriptor_ = STDERR_FILENO;
    return;
  }
  struct stat status = {};
  const bool exists = stat(path.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode)) fail(EISDIR);
  if (exists && access(path.c_str(), W_OK) != 0) fail(errno);
  if (exists && !S_ISREG(status.st_mode)) {
    descriptor_ = open_file(path, O_WRONLY | O_CLOEXEC);
    if (descriptor_ < 0) fail(errno);
    return;
  }
  check_io(msq_io_file_create(path.c_str(), 1, file_.out()));
}

OutputFile::~OutputFile() {
  if (descriptor_ > STDERR_FILENO) close(descriptor_);
}

void OutputFile::write(const void* bytes, size_t count) {
  if (count >= BUFFER) {
    flush();
    put(static_cast<const char*>(bytes), count);
    return;
  }
  buffer_.append(static_cast<const char*>(bytes), count);
  if (buffer_.size() >= BUFFER) flush();
}

void OutputFile::write_at(uint64_t offset, const void* bytes, size_t count) {
  flush();
  if (!file_) {
    if (pwrite(descriptor_, bytes, count, static_cast<off_t>(offset)) < 0) fail(errno);
    return;
  }
  msq_file_part part = {};
  part.struct_size = sizeof part;
  part.offset = offset;
  part.size = count;
  part.total = offset + count;
  part.bytes = static_cast<const uint8_t*>(bytes);
  check_io(msq_io_file_part(file_.get(), &part));
}

void OutputFile::commit() {
  flush();
  if (!file_) return;
  heed_signals();
  check_io(msq_io_file_finish(file_.get()));
}

void OutputFile::flush() {
  std::string bytes;
  bytes.swap(buffer_);
  put(bytes.data(), bytes.size());
}

void OutputFile::put(const char* bytes, size_t count) {
  if (file_) {
    check_io(msq_io_file_write(file_.get(), bytes, count));
    return;
  }
  while (count > 0) {
    const ssize_t written = ::write(descriptor_, bytes, count);
    if (written < 0 && errno != EINTR) fail(errno);
    if (written < 0) {
      heed_signals();
      continue;
    }
    bytes += written;
    count -= static_cast<size_t>(written);
  }
}

void OutputFile::fail(int code) const {
  throw Failure(path_ + ": " + std::strerror(code));
}

}  // namespace command
