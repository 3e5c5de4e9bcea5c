// SPDX-License-Identifier: Apache-2.0
#include "atomic_folder.h"

#include <cerrno>
#include <cstdio>

#include "atomic_file.h"
#include "error.h"
#include "names.h"

namespace fs = std::filesystem;

namespace msq_io {

AtomicFolder::AtomicFolder(const fs::path& path, bool replace)
    : path_(path.lexically_normal()), replace_(replace) {
  if (!path_.has_filename()) path_ = path_.parent_path();  // "out/"
  std::error_code error;
  const fs::file_status status = fs::status(path_, error);
  is_new_ = !fs::exists(status);
  if (!is_new_ && !fs::is_directory(status))
    throw Error(MSQ_E_IO, "the name is not that of a folder: " + text_of(path_));
  for (int tries = 0; temporary_.empty(); ++tries) {
    fs::path name = is_new_ ? temporary_name(path_.parent_path(), path_.filename())
                            : temporary_name(path_, "msq");
    if (fs::create_directory(name, error))
      temporary_ = std::move(name);  // without memory: from here on it is removed
    else if (error || tries == 100)
      fail_io("cannot create the folder", error.default_error_condition().value(), text_of(path_));
  }
}

AtomicFolder::~AtomicFolder() {
  remove();
}

void AtomicFolder::remove() noexcept {
  if (temporary_.empty()) return;
  try {
    std::error_code error;
    fs::remove_all(temporary_, error);
  } catch (...) {
    // Without memory not even a folder can be listed.
  }
  temporary_.clear();
}

void AtomicFolder::check_free(const std::string& name) const {
  std::error_code error;
  if (!is_new_ && !replace_ && fs::exists(fs::symlink_status(path_ / name, error)))
    throw Error(MSQ_E_IO, "the file exists and replace is 0: " + text_of(path_ / name));
}

void AtomicFolder::write(const std::string& name, const void* bytes, size_t size) const {
  std::FILE* file = create_file(temporary_ / name);
  int code = file ? 0 : errno;
  if (file) {
    std::setvbuf(file, nullptr, _IONBF, 0);
    errno = 0;
    const bool is_written = std::fwrite(bytes, 1, size, file) == size;
    if (!is_written) code = errno ? errno : EIO;
    // A full disk may show only now.
    if (std::fclose(file) != 0 && is_written) code = errno ? errno : EIO;
  }
  if (code) fail_io("cannot write the file", code, text_of(path_ / name));
}

void AtomicFolder::commit(const std::vector<std::string>& names) {
  if (is_new_) {
    const int code = rename_to(temporary_, path_, false);
    if (code == 0) temporary_.clear();
    if (code == 0) return;
    std::error_code error;
    // Another process may have made it in the meantime.
    if (!fs::is_directory(path_, error))
      fail_io("cannot give the folder its name", code, text_of(path_));
  }
  const fs::path replaced = temporary_ / "replaced";
  std::error_code error;
  if (replace_) fs::create_directory(replaced, error);
  for (size_t i = 0; i < names.size(); ++i) {
    if (replace_) keep_old(names[i], replaced);
    const int code = rename_to(temporary_ / names[i], path_ / names[i], replace_);
    if (code == 0) continue;
    for (size_t k = 0; k <= i; ++k) put_back(names[k], replaced, k < i);
    fail_io("cannot give the file its name", code, text_of(path_ / names[i]));
  }
  remove();
}

void AtomicFolder::keep_old(const std::string& name, const fs::path& to) const {
  std::error_code error;
  if (!fs::exists(fs::symlink_status(path_ / name, error))) return;
  if (fs::is_directory(fs::symlink_status(path_ / name, error))) return;  // the rename will fail
  // A second name, where the disk has such: so the first always has a file.
  fs::create_hard_link(path_ / name, to / name, error);
  if (error) rename_to(path_ / name, to / name, true);
}

void AtomicFolder::put_back(const std::string& name, const fs::path& from, bool is_new) const {
  std::error_code error;
  if (fs::exists(fs::symlink_status(from / name, error)))
    rename_to(from / name, path_ / name, true);
  else if (is_new)
    fs::remove(path_ / name, error);
}

}  // namespace msq_io
