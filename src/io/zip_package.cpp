// SPDX-License-Identifier: Apache-2.0
#include "io/zip_package.h"

#include <unzip.h>

#include <algorithm>
#include <cstring>
#include <new>

#include "base/status.h"
#include "io/text_cursor.h"
#include "io/zip64_entry.h"
#include "io/zip_directory.h"

namespace msq {
namespace {

using Count = unsigned long long;

/// The file as minizip sees it.
struct Source {
  std::string_view content;
  uint64_t position = 0;
};

Source& source_of(voidpf stream) {
  return *static_cast<Source*>(stream);
}

voidpf open_source(voidpf opaque, const void*, int) {
  return opaque;
}

uLong read_source(voidpf, voidpf stream, void* buffer, uLong bytes) {
  Source& source = source_of(stream);
  const uLong n = std::min<uLong>(bytes, source.content.size() - source.position);
  if (n) std::memcpy(buffer, source.content.data() + source.position, n);
  source.position += n;
  return n;
}

uLong write_source(voidpf, voidpf, const void*, uLong) {
  return 0;
}

ZPOS64_T tell_source(voidpf, voidpf stream) {
  return source_of(stream).position;
}

long seek_source(voidpf, voidpf stream, ZPOS64_T offset, int origin) {
  Source& source = source_of(stream);
  const uint64_t size = source.content.size();
  const uint64_t base = origin == ZLIB_FILEFUNC_SEEK_SET   ? 0
                        : origin == ZLIB_FILEFUNC_SEEK_CUR ? source.position
                                                           : size;
  if (offset > size - base) return -1;
  source.position = base + offset;
  return 0;
}

int close_source(voidpf, voidpf) {
  return 0;
}
int source_error(voidpf, voidpf) {
  return 0;
}

/// Throws if memory failed: minizip has no code of its own for that, and uses this one for nothing
/// else.
void check_memory(int result) {
  if (result == UNZ_INTERNALERROR || result == Z_MEM_ERROR) throw std::bad_alloc();
}

}  // namespace

struct ZipPackage::Archive {
  explicit Archive(std::string_view content) : source{content} {
    zlib_filefunc64_def functions = {open_source, read_source,  write_source, tell_source,
                                     seek_source, close_source, source_error, &source};
    handle = unzOpen2_64("", &functions);
  }
  ~Archive() {
    if (handle) unzClose(handle);
  }

  Source source;
  unzFile handle;
};

ZipPackage::ZipPackage(std::string_view file, UnpackLimit limit, const Job* job)
    : archive_(std::make_unique<Archive>(file)),
      limit_(limit),
      bytes_left_(limit.bytes),
      job_(job) {
  if (archive_->handle) return;
  // minizip gives no reason.
  if (has_zip_directory(file)) throw std::bad_alloc();
  fail(Status::io, "the file is not a zip archive, or is truncated");
}

ZipPackage::~ZipPackage() = default;

void ZipPackage::fail_large(const std::string& name, uint64_t bytes) const {
  if (limit_.memory_limit)
    fail(Status::limit,
         "the zip entry \"%s\" unpacks to %llu bytes; the limit is %llu with the context's "
         "memory_limit of %llu",
         Quoted(name).text, static_cast<Count>(bytes), static_cast<Count>(limit_.bytes),
         static_cast<Count>(limit_.memory_limit));
  fail(Status::limit, "the zip entry \"%s\" unpacks to %llu bytes; max_bytes is %llu",
       Quoted(name).text, static_cast<Count>(bytes), static_cast<Count>(limit_.bytes));
}

std::optional<std::string> ZipPackage::read(const std::string& name) {
  constexpr int ignoring_case = 2;
  const unzFile handle = archive_->handle;
  if (unzLocateFile(handle, name.c_str(), ignoring_case) != UNZ_OK) return std::nullopt;
  unz_file_info64 info;
  if (unzGetCurrentFileInfo64(handle, &info, nullptr, 0, nullptr, 0, nullptr, 0) != UNZ_OK)
    fail(Status::io, "the zip entry \"%s\" is damaged", Quoted(name).text);
  if (info.flag & 1)
    fail(Status::unsupported, "the zip entry \"%s\" is encrypted", Quoted(name).text);
  const std::optional<Zip64Entry> zip64 =
      read_zip64_entry(archive_->source.content, unzGetOffset64(handle));
  if (zip64) info.uncompressed_size = zip64->unpacked;
  if (info.uncompressed_size > bytes_left_) fail_large(name, info.uncompressed_size);
  if (zip64) {
    std::optional<std::string> unpacked = unpack(archive_->source.content, *zip64, job_);
    if (!unpacked) fail(Status::io, "the zip entry \"%s\" is damaged", Quoted(name).text);
    bytes_left_ -= unpacked->size();
    return unpacked;
  }
  const int opened = unzOpenCurrentFile(handle);
  check_memory(opened);
  if (opened != UNZ_OK)
    fail(Status::io, "the zip entry \"%s\" cannot be opened", Quoted(name).text);

  // Piece by piece, so that memory follows the actual content and not the size that the entry
  // gives.
  std::string content;
  int got = 0;
  do {
    check_cancelled(job_);
    constexpr uint64_t piece = 1 << 18;
    const size_t size = content.size();
    const uint64_t wanted = std::min<uint64_t>(piece, info.uncompressed_size - size);
    if (!wanted) break;
    content.resize(size + wanted);
    got = unzReadCurrentFile(handle, content.data() + size, static_cast<unsigned>(wanted));
    content.resize(size + static_cast<size_t>(std::max(got, 0)));
  } while (got > 0);
  const int closed = unzCloseCurrentFile(handle);  // compares the checksum
  check_memory(got);
  if (got < 0 || closed != UNZ_OK || content.size() != info.uncompressed_size)
    fail(Status::io, "the zip entry \"%s\" is damaged: %zu of %llu bytes unpacked",
         Quoted(name).text, content.size(), static_cast<Count>(info.uncompressed_size));
  bytes_left_ -= content.size();
  return content;
}

std::string ZipPackage::find_by_ending(std::string_view ending) {
  const unzFile handle = archive_->handle;
  std::string first;
  for (int result = unzGoToFirstFile(handle); result == UNZ_OK; result = unzGoToNextFile(handle)) {
    char name[256] = {};
    if (unzGetCurrentFileInfo64(handle, nullptr, name, sizeof name - 1, nullptr, 0, nullptr, 0) !=
        UNZ_OK)
      break;
    const std::string_view entry = name;
    if (entry.size() >= ending.size() &&
        equal_ignoring_case(entry.substr(entry.size() - ending.size()), ending))
      return name;
    if (first.empty()) first = name;
  }
  return first;
}

}  // namespace msq
