// SPDX-License-Identifier: Apache-2.0
#include "zip_file.h"

#include <minizip/zip.h>

#include <cstring>
#include <limits>

#include "names.h"

namespace msq_io {

/// What minizip calls for a file.
struct ZipCalls {
  static void* open(void* user, const void*, int) { return user; }
  static uLong read(void*, void*, void*, uLong) { return 0; }
  static uLong write(void* user, void*, const void* bytes, uLong size) {
    auto& zip = *static_cast<ZipFile*>(user);
    return attempt(zip, [&] { zip.file_.write(bytes, size); }) ? size : 0;
  }
  static ZPOS64_T tell(void* user, void*) { return static_cast<ZipFile*>(user)->file_.offset(); }
  static long seek(void* user, void*, ZPOS64_T offset, int origin) {
    auto& zip = *static_cast<ZipFile*>(user);
    uint64_t from = 0;
    if (origin == ZLIB_FILEFUNC_SEEK_CUR) from = zip.file_.offset();
    if (origin == ZLIB_FILEFUNC_SEEK_END) from = zip.file_.size();
    return attempt(zip, [&] { zip.file_.seek(from + offset); }) ? 0 : -1;
  }
  static int close(void*, void*) { return 0; }
  static int error(void* user, void*) { return static_cast<ZipFile*>(user)->error_ ? 1 : 0; }
  template <class Body>
  static bool attempt(ZipFile& zip, Body&& body) noexcept {
    try {
      body();
      return true;
    } catch (...) {
      if (!zip.error_) zip.error_ = current_failure();
      return false;
    }
  }
};

std::tm utc_of(int64_t seconds) {
  int64_t days = seconds / 86400, rest = seconds % 86400;
  if (rest < 0) rest += 86400, --days;
  const int64_t shifted = days + 719468, era = (shifted >= 0 ? shifted : shifted - 146096) / 146097;
  const int64_t day_of_era = shifted - era * 146097;
  const int64_t year_of_era =
      (day_of_era - day_of_era / 1460 + day_of_era / 36524 - day_of_era / 146096) / 365;
  const int64_t day_of_year =
      day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
  const int64_t month = (5 * day_of_year + 2) / 153;  // from March
  std::tm time{};
  time.tm_mday = static_cast<int>(day_of_year - (153 * month + 2) / 5 + 1);
  time.tm_mon = static_cast<int>(month < 10 ? month + 2 : month - 10);
  time.tm_year = static_cast<int>(year_of_era + era * 400 + (time.tm_mon < 2 ? 1 : 0) - 1900);
  time.tm_hour = static_cast<int>(rest / 3600);
  time.tm_min = static_cast<int>(rest / 60 % 60);
  time.tm_sec = static_cast<int>(rest % 60);
  return time;
}

ZipFile::ZipFile(const std::filesystem::path& path, bool replace, int64_t created)
    : file_(path, replace), created_(created) {
  zlib_filefunc64_def calls{};
  calls.zopen64_file = ZipCalls::open;
  calls.zread_file = ZipCalls::read;
  calls.zwrite_file = ZipCalls::write;
  calls.ztell64_file = ZipCalls::tell;
  calls.zseek64_file = ZipCalls::seek;
  calls.zclose_file = ZipCalls::close;
  calls.zerror_file = ZipCalls::error;
  calls.opaque = this;
  zip_ = zipOpen2_64("", APPEND_STATUS_CREATE, nullptr, &calls);
  if (!zip_) throw std::bad_alloc();
}

ZipFile::~ZipFile() {
  // What this writes goes with the temporary file.
  if (zip_) zipClose(zip_, nullptr);
}

void ZipFile::fail_zip(const char* what) const {
  if (error_) raise(*error_);
  fail(MSQ_E_IO, "minizip cannot %s: %s", what, text_of(file_.path()).c_str());
}

void ZipFile::add(const std::string& name, const void* bytes, uint64_t size, bool is_deflated) {
  begin(name, is_deflated, size > 0xf0000000u);
  append(bytes, size);
  end();
}

void ZipFile::begin(const std::string& name, bool is_deflated, bool is_large) {
  const std::tm time = utc_of(created_);
  zip_fileinfo info{};
  info.tmz_date.tm_sec = static_cast<uInt>(time.tm_sec);
  info.tmz_date.tm_min = static_cast<uInt>(time.tm_min);
  info.tmz_date.tm_hour = static_cast<uInt>(time.tm_hour);
  info.tmz_date.tm_mday = static_cast<uInt>(time.tm_mday);
  info.tmz_date.tm_mon = static_cast<uInt>(time.tm_mon);
  info.tmz_date.tm_year = static_cast<uInt>(time.tm_year + 1900);
  bool is_ascii = true;
  for (const char c : name) is_ascii = is_ascii && static_cast<unsigned char>(c) < 128;
  constexpr uLong utf8_names = 1 << 11;
  if (zipOpenNewFileInZip4_64(zip_, name.c_str(), &info, nullptr, 0, nullptr, 0, nullptr,
                              is_deflated ? Z_DEFLATED : 0, Z_DEFAULT_COMPRESSION, 0, -MAX_WBITS,
                              DEF_MEM_LEVEL, Z_DEFAULT_STRATEGY, nullptr, 0, 0,
                              is_ascii ? 0 : utf8_names, is_large) != ZIP_OK)
    fail_zip("begin an entry");
}

void ZipFile::append(const void* bytes, uint64_t size) {
  const auto* next = static_cast<const char*>(bytes);
  for (uint64_t left = size; left > 0;) {
    const auto part = static_cast<unsigned>(left < (1u << 30) ? left : 1u << 30);
    if (zipWriteInFileInZip(zip_, next, part) != ZIP_OK || error_) fail_zip("write an entry");
    next += part;
    left -= part;
  }
}

void ZipFile::end() {
  if (zipCloseFileInZip(zip_) != ZIP_OK || error_) fail_zip("end an entry");
}

void ZipFile::commit() {
  void* zip = zip_;
  zip_ = nullptr;
  if (zipClose(zip, nullptr) != ZIP_OK || error_) fail_zip("end the archive");
  file_.commit();
}

}  // namespace msq_io
