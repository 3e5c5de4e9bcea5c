// SPDX-License-Identifier: Apache-2.0
#include "names.h"

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstring>

#include "error.h"

#if defined(__linux__)
#include <fcntl.h>
#include <stdio.h>  // renameat2
#endif

namespace fs = std::filesystem;

namespace msq_io {

fs::path read_path(const char* path) {
  if (!path) fail(MSQ_E_ARGUMENT, "path is NULL");
  if (!*path) fail(MSQ_E_ARGUMENT, "path is empty");
#ifdef _WIN32
  return fs::path(reinterpret_cast<const char8_t*>(path));
#else
  return fs::path(path);
#endif
}

std::string text_of(const fs::path& path) {
  const auto text = path.u8string();
  return {text.begin(), text.end()};
}

std::string read_prefix(const char* prefix, const char* fallback, const char* name) {
  const std::string text = prefix ? prefix : fallback;
  if (text.empty() || text.size() > 64)
    fail(MSQ_E_ARGUMENT, "%s has %zu bytes; it must have 1 to 64", name, text.size());
  for (const char c : text)
    if (static_cast<unsigned char>(c) < 32 || c == 127 || std::strchr("/\\:", c))
      fail(MSQ_E_ARGUMENT, "%s is \"%s\"; it must be without / \\ : and control characters", name,
           text.c_str());
  if (text[0] == '.')
    fail(MSQ_E_ARGUMENT, "%s is \"%s\"; it begins with a dot", name, text.c_str());
  return text;
}

std::string numbered_name(const std::string& prefix, uint64_t number, uint32_t digits,
                          const char* extension) {
  std::string text = std::to_string(number);
  if (text.size() < digits) text.insert(0, digits - text.size(), '0');
  return prefix + text + extension;
}

fs::path temporary_name(const fs::path& folder, const fs::path& name) {
  // Names of other processes differ by their time; whoever creates the file makes sure.
  static std::atomic<uint64_t> calls{0};
  auto bits = static_cast<uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count());
  bits = (bits ^ (calls.fetch_add(1) << 48)) * 0x9e3779b97f4a7c15u;
  std::string letters;
  for (int i = 0; i < 8; ++i, bits <<= 5)
    letters += "abcdefghijklmnopqrstuvwxyz234567"[bits >> 59 & 31];
  // With the dots and letters it has at most the 255 bytes that a name may have. None of its
  // characters is cut.
  constexpr size_t max_kept = 240;
  auto kept = name.u8string();
  if (kept.size() > max_kept) {
    size_t end = max_kept;
    while (end > 0 && (static_cast<unsigned char>(kept[end]) & 0xc0) == 0x80) --end;
    kept.resize(end);
  }
  fs::path made = folder / ".";
  made += fs::path(kept);
  made += "." + letters + ".part";
  return made;
}

int rename_to(const fs::path& from, const fs::path& to, bool replace) {
#if defined(__linux__) && defined(RENAME_NOREPLACE)
  if (!replace) {
    if (renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return 0;
    if (errno != EINVAL && errno != ENOSYS) return errno;
  }
#endif
  std::error_code error;
  if (!replace && fs::symlink_status(to, error).type() != fs::file_type::not_found) return EEXIST;
  fs::rename(from, to, error);
  return error ? error.default_error_condition().value() : 0;
}

}  // namespace msq_io
