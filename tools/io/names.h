// SPDX-License-Identifier: Apache-2.0
// Paths, and names of files in folders and archives.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace msq_io {

/// A path of the C ABI, in UTF-8. Fails for NULL and "".
std::filesystem::path read_path(const char* path);

/// For messages.
std::string text_of(const std::filesystem::path& path);

/// A name as prefix in msq_io_png_def has it; `fallback` if it is NULL.
std::string read_prefix(const char* prefix, const char* fallback, const char* name);

/// prefix, the number with at least so many digits, and the extension.
std::string numbered_name(const std::string& prefix, uint64_t number, uint32_t digits,
                          const char* extension);

/// ".<name>.<letters>.part" in the folder; other letters at each call. Of a long name it has the
/// beginning.
std::filesystem::path temporary_name(const std::filesystem::path& folder,
                                     const std::filesystem::path& name);

/// Gives a file or folder another name. Where `replace` is false, it returns EEXIST for a name that
/// exists, in one step if the system can do that. Returns an errno value or 0.
int rename_to(const std::filesystem::path& from, const std::filesystem::path& to, bool replace);

}  // namespace msq_io
