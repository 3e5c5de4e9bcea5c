// SPDX-License-Identifier: Apache-2.0
#include "io/whole_file.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <new>
#include <system_error>

#include "base/status.h"

namespace msq {

/// A path for messages: only the end of a long one, so that there is room for the reason.
std::string shown(const std::string& path) {
  constexpr size_t most = 200;
  if (path.size() <= most) return path;
  size_t first = path.size() - most;
  while (first < path.size() && (path[first] & 0xc0) == 0x80) ++first;  // whole characters of UTF-8
  return "..." + path.substr(first);
}

namespace {

namespace fs = std::filesystem;

/// From UTF-8. Elsewhere than on Windows a path is bytes in no set encoding.
fs::path system_path(const std::string& path) {
#ifdef _WIN32
  return fs::path(std::u8string(path.begin(), path.end()));
#else
  return fs::path(path);
#endif
}

std::FILE* open_to_read(const fs::path& path) {
#ifdef _WIN32
  return _wfopen(path.c_str(), L"rb");
#else
  return std::fopen(path.c_str(), "rb");
#endif
}

}  // namespace

FileContent read_whole_file(const std::string& path, const Job* job,
                            const std::function<void(uint64_t)>& admit) {
  const fs::path file_path = system_path(path);
  const auto give_up = [&](int error) {
    if (error == ENOMEM) throw std::bad_alloc();
    fail(Status::io, "%s: %s", shown(path).c_str(), std::generic_category().message(error).c_str());
  };
  std::error_code error;
  const fs::file_status status = fs::status(file_path, error);
  if (status.type() == fs::file_type::not_found) give_up(ENOENT);
  if (error) give_up(error.value());
  if (status.type() == fs::file_type::directory) give_up(EISDIR);
  // Pipes and devices have no size to check, and may never end.
  if (status.type() != fs::file_type::regular)
    fail(Status::io, "%s: not a regular file", shown(path).c_str());
  const uint64_t bytes = fs::file_size(file_path, error);
  if (error) give_up(error.value());
  admit(bytes);

  const auto close = [](std::FILE* file) { std::fclose(file); };
  errno = 0;
  const std::unique_ptr<std::FILE, decltype(close)> file(open_to_read(file_path), close);
  if (!file) give_up(errno ? errno : ENOMEM);
  // Unbuffered, directly into memory that is not filled with zeros first.
  std::setvbuf(file.get(), nullptr, _IONBF, 0);
  FileContent content{std::make_unique_for_overwrite<char[]>(bytes), bytes};
  constexpr uint64_t piece = 4 << 20;
  for (uint64_t at = 0; at < bytes;) {
    check_cancelled(job);
    errno = 0;
    const size_t got =
        std::fread(content.bytes.get() + at, 1, std::min(piece, bytes - at), file.get());
    at += got;
    if (got > 0) continue;
    if (std::ferror(file.get())) give_up(errno ? errno : EIO);
    fail(Status::io, "%s: ended after %llu of %llu bytes", shown(path).c_str(),
         static_cast<unsigned long long>(at), static_cast<unsigned long long>(bytes));
  }
  return content;
}

}  // namespace msq
