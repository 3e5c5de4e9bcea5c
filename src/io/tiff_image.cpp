// SPDX-License-Identifier: Apache-2.0
// Stacks of pictures in TIFF (TIFF Revision 6.0, Adobe, 1992, and BigTIFF), through libtiff.
//
// A file is read into memory first, so libtiff opens nothing itself. Of its codecs only those of
// whole numbers without loss are let in: the others, JPEG among them, are most of its code, and no
// scan needs them. What a page says is checked before any memory depends on it, pages are counted
// before their values are, and libtiff allocates no more at once than a multiple of the file.
#include <tiffio.h>

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <cstring>

#include "base/checked.h"
#include "base/job.h"
#include "base/status.h"
#include "io/image_file.h"

namespace msq {

namespace {

constexpr uint64_t max_side = 1 << 20;
constexpr tmsize_t min_allocation = 1 << 22;  // for the state of a codec
constexpr tmsize_t max_expansion = 8;         // of a list of numbers in memory

struct Page {
  uint64_t width = 0, height = 0;
  ValueType type = ValueType::uint8;

  uint64_t row_bytes() const { return width * (type == ValueType::uint8 ? 1 : 2); }
  bool operator==(const Page&) const = default;
};

/// The file in memory, as libtiff reads it, and the first thing that it had to say.
struct Source {
  std::string_view bytes;
  uint64_t at = 0;
  char problem[256] = "";
};

tmsize_t read_bytes(thandle_t handle, void* to, tmsize_t count) {
  Source& source = *static_cast<Source*>(handle);
  const uint64_t left =
      source.at < source.bytes.size() ? source.bytes.size() - source.at : uint64_t{0};
  const uint64_t given = std::min(left, count > 0 ? static_cast<uint64_t>(count) : uint64_t{0});
  if (given) std::memcpy(to, source.bytes.data() + source.at, given);
  source.at += given;
  return static_cast<tmsize_t>(given);
}
tmsize_t write_nothing(thandle_t, void*, tmsize_t) {
  return 0;
}
toff_t seek_to(thandle_t handle, toff_t offset, int whence) {
  Source& source = *static_cast<Source*>(handle);
  const uint64_t from = whence == SEEK_SET   ? 0
                        : whence == SEEK_CUR ? source.at
                                             : static_cast<uint64_t>(source.bytes.size());
  source.at = from + offset;
  return source.at;
}
int close_nothing(thandle_t) {
  return 0;
}
toff_t file_size(thandle_t handle) {
  return static_cast<Source*>(handle)->bytes.size();
}

/// Keeps what libtiff would print.
int keep_problem(TIFF*, void* user, const char*, const char* format, va_list values) {
  Source& source = *static_cast<Source*>(user);
  if (source.problem[0] != '\0') return 1;
  std::vsnprintf(source.problem, sizeof source.problem, format, values);
  // Most begin with the name that the file was opened by, and that is empty.
  if (std::strncmp(source.problem, ": ", 2) == 0)
    std::memmove(source.problem, source.problem + 2, std::strlen(source.problem + 2) + 1);
  return 1;
}
int ignore_warning(TIFF*, void*, const char*, const char*, va_list) {
  return 1;
}

class TiffFile {
 public:
  explicit TiffFile(std::string_view bytes) : source_{bytes} {
    TIFFOpenOptions* options = TIFFOpenOptionsAlloc();
    if (!options) throw std::bad_alloc();
    TIFFOpenOptionsSetMaxSingleMemAlloc(
        options, std::max(min_allocation, max_expansion * static_cast<tmsize_t>(bytes.size())));
    TIFFOpenOptionsSetErrorHandlerExtR(options, keep_problem, &source_);
    TIFFOpenOptionsSetWarningHandlerExtR(options, ignore_warning, nullptr);
    tiff_ = TIFFClientOpenExt("", "rm", &source_, read_bytes, write_nothing, seek_to, close_nothing,
                              file_size, nullptr, nullptr, options);
    TIFFOpenOptionsFree(options);
    if (!tiff_) fail(Status::io, "the file is no TIFF: %s", source_.problem);
  }
  ~TiffFile() { TIFFClose(tiff_); }
  TiffFile(const TiffFile&) = delete;
  TiffFile& operator=(const TiffFile&) = delete;

  bool is_last() const { return TIFFLastDirectory(tiff_) != 0; }
  void first() {
    page_ = 0;
    if (!TIFFSetDirectory(tiff_, 0)) damaged();
  }
  void next() {
    ++page_;
    if (!TIFFReadDirectory(tiff_)) damaged();
  }

  /// What the page says, checked.
  Page page() const {
    uint32_t width = 0, height = 0;
    if (!TIFFGetField(tiff_, TIFFTAG_IMAGEWIDTH, &width) ||
        !TIFFGetField(tiff_, TIFFTAG_IMAGELENGTH, &height))
      refuse(Status::io, "has no width or no height");
    if (width < 1 || width > max_side || height < 1 || height > max_side)
      refuse(Status::limit, "has %u x %u pixels; a side may have 1 to %u", width, height,
             static_cast<unsigned>(max_side));
    if (TIFFIsTiled(tiff_)) refuse(Status::unsupported, "is stored in tiles; strips are read");
    const unsigned compression = number(TIFFTAG_COMPRESSION);
    if (compression != COMPRESSION_NONE && compression != COMPRESSION_LZW &&
        compression != COMPRESSION_ADOBE_DEFLATE && compression != COMPRESSION_DEFLATE &&
        compression != COMPRESSION_PACKBITS)
      refuse(Status::unsupported,
             "has compression %u; none (1), LZW (5), Deflate (8, 32946) and PackBits (32773) are "
             "read",
             compression);
    if (const unsigned samples = number(TIFFTAG_SAMPLESPERPIXEL); samples != 1)
      refuse(Status::unsupported, "has %u samples per pixel; grey pictures with 1 are read",
             samples);
    uint16_t photometric = 0;
    if (!TIFFGetField(tiff_, TIFFTAG_PHOTOMETRIC, &photometric))
      refuse(Status::io, "has no photometric interpretation");
    if (photometric != PHOTOMETRIC_MINISBLACK)
      refuse(Status::unsupported,
             "has photometric interpretation %u; 1 is read, grey values whose 0 is black",
             unsigned{photometric});
    if (const unsigned orientation = number(TIFFTAG_ORIENTATION);
        orientation != ORIENTATION_TOPLEFT)
      refuse(Status::unsupported, "has orientation %u; 1 is read, rows from the top", orientation);
    return {width, height, type()};
  }

  /// to: page().height rows.
  void read(const Page& page, char* to) {
    uint32_t rows_per_strip = 0;
    TIFFGetFieldDefaulted(tiff_, TIFFTAG_ROWSPERSTRIP, &rows_per_strip);
    if (rows_per_strip == 0) refuse(Status::io, "has strips of 0 rows");
    uint64_t row = 0;
    for (uint32_t strip = 0; row < page.height; ++strip) {
      const uint64_t rows = std::min<uint64_t>(rows_per_strip, page.height - row);
      const auto bytes = static_cast<tmsize_t>(rows * page.row_bytes());
      // libtiff reads lists that are too short as if zeros followed.
      if (TIFFGetStrileOffset(tiff_, strip) == 0)
        refuse(Status::io, "is damaged: strip %u has no place in the file", strip + 1);
      if (TIFFReadEncodedStrip(tiff_, strip, to + row * page.row_bytes(), bytes) != bytes)
        damaged();
      row += rows;
    }
  }

  /// As a message, of the page that is current.
  [[noreturn]] void refuse(Status status, const char* format, ...) const MSQ_PRINTF_FORMAT(3, 4) {
    char why[400];
    va_list values;
    va_start(values, format);
    std::vsnprintf(why, sizeof why, format, values);
    va_end(values);
    fail(status, "page %llu %s", static_cast<unsigned long long>(page_ + 1), why);
  }

 private:
  [[noreturn]] void damaged() const {
    refuse(Status::io, "is damaged: %s",
           source_.problem[0] ? source_.problem : "it ends before its values do");
  }
  unsigned number(uint32_t tag) const {
    uint16_t value = 0;
    TIFFGetFieldDefaulted(tiff_, tag, &value);
    return value;
  }
  ValueType type() const {
    const unsigned bits = number(TIFFTAG_BITSPERSAMPLE), format = number(TIFFTAG_SAMPLEFORMAT);
    const bool is_signed = format == SAMPLEFORMAT_INT;
    if (bits != 8 && bits != 16)
      refuse(Status::unsupported, "has %u bits per sample; 8 and 16 are read", bits);
    if (format != SAMPLEFORMAT_UINT && !(is_signed && bits == 16))
      refuse(Status::unsupported,
             "has sample format %u with %u bits; whole numbers are read, with a sign only of 16 "
             "bits",
             format, bits);
    return bits == 8 ? ValueType::uint8 : is_signed ? ValueType::int16 : ValueType::uint16;
  }

  Source source_;
  TIFF* tiff_ = nullptr;
  uint64_t page_ = 0;
};

/// The stack that is read so far.
class Stack {
 public:
  Stack(const ImageFileOptions& options, size_t file_count)
      : options_(options), file_count_(file_count) {}

  void add(std::string_view bytes) {
    TiffFile tiff(bytes);
    const uint64_t first = pages_;
    for (check(tiff); !tiff.is_last(); check(tiff)) {
      check_cancelled(options_.job);
      tiff.next();
    }
    make_room(first);
    tiff.first();
    for (uint64_t page = first;;) {
      check_cancelled(options_.job);
      tiff.read(page_, values_.bytes.get() + page * page_bytes());
      if (++page == pages_) break;
      tiff.next();
    }
    ++files_;
  }
  /// Of a file, which counts against the limit as the values do.
  uint64_t admit(uint64_t bytes) {
    if (bytes > options_.max_bytes - bytes_)
      fail(Status::limit, "the file has %llu bytes; the limit is %llu",
           static_cast<unsigned long long>(bytes),
           static_cast<unsigned long long>(options_.max_bytes - bytes_));
    return bytes_ += bytes;
  }
  ImageFile finish() {
    ImageFile file;
    file.layout.type = page_.type;
    file.layout.size[0] = page_.width;
    file.layout.size[1] = page_.height;
    file.layout.size[2] = pages_;
    file.content = std::move(values_);
    file.content.size = pages_ * page_bytes();
    file.reservation = std::move(reservation_);
    file.read_bytes = bytes_ + file.content.size;
    return file;
  }

 private:
  uint64_t page_bytes() const { return page_.height * page_.row_bytes(); }

  /// Counts the page that is current.
  void check(const TiffFile& tiff) {
    const Page page = tiff.page();
    if (pages_ == 0) page_ = page;
    if (page != page_)
      tiff.refuse(Status::io, "has %llu x %llu pixels of %d bytes; the first has %llu x %llu of %d",
                  static_cast<unsigned long long>(page.width),
                  static_cast<unsigned long long>(page.height),
                  static_cast<int>(page.row_bytes() / page.width),
                  static_cast<unsigned long long>(page_.width),
                  static_cast<unsigned long long>(page_.height),
                  static_cast<int>(page_.row_bytes() / page_.width));
    if (++pages_ > max_side)
      tiff.refuse(Status::limit, "is one too many; the limit is %u",
                  static_cast<unsigned>(max_side));
    const uint64_t left = options_.max_bytes - bytes_;
    if (page_bytes() > left / pages_)
      tiff.refuse(Status::limit, "ends %llu bytes of values; the limit is %llu",
                  static_cast<unsigned long long>(pages_ * page_bytes()),
                  static_cast<unsigned long long>(left));
  }

  /// For pages_, and at the first file for as many from each file.
  void make_room(uint64_t filled) {
    if (pages_ <= capacity_) return;
    const uint64_t left = (options_.max_bytes - bytes_) / page_bytes();
    const uint64_t wanted = files_ ? std::max(pages_, 2 * capacity_)
                                   : checked_product(pages_, file_count_, "the image");
    const uint64_t capacity = std::max(pages_, std::min({wanted, left, max_side}));
    const uint64_t bytes = checked_product(capacity, page_bytes(), "the image");
    Reservation reservation;
    if (options_.budget) reservation = Reservation(options_.budget, bytes, "an image file");
    std::unique_ptr<char[]> room(new char[bytes]);
    if (filled) std::memcpy(room.get(), values_.bytes.get(), filled * page_bytes());
    values_.bytes = std::move(room);
    reservation_ = std::move(reservation);
    capacity_ = capacity;
  }

  const ImageFileOptions& options_;
  uint64_t file_count_, files_ = 0, pages_ = 0, capacity_ = 0, bytes_ = 0;
  Page page_;
  FileContent values_;
  Reservation reservation_;
};

}  // namespace

bool can_read_tiff() {
  return true;
}

ImageFile read_tiff_files(std::span<const std::string> paths, const ImageFileOptions& options) {
  Stack stack(options, paths.size());
  for (const std::string& path : paths) {
    Reservation reservation;
    const FileContent content = read_whole_file(path, options.job, [&](uint64_t bytes) {
      of_file(path, [&] { stack.admit(bytes); });
      if (options.budget) reservation = Reservation(options.budget, bytes, "an image file");
    });
    of_file(path, [&] { stack.add(content.view()); });
  }
  return stack.finish();
}

}  // namespace msq
