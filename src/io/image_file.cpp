// SPDX-License-Identifier: Apache-2.0
#include "io/image_file.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>
#include <string_view>
#include <vector>

#include "base/checked.h"
#include "base/status.h"

namespace msq {

namespace {

constexpr uint64_t max_size = 1 << 20;

constexpr struct {
  std::string_view name;
  ValueType type;
} type_names[] = {{"uchar", ValueType::uint8},
                  {"unsigned char", ValueType::uint8},
                  {"uint8", ValueType::uint8},
                  {"uint8_t", ValueType::uint8},
                  {"short", ValueType::int16},
                  {"short int", ValueType::int16},
                  {"signed short", ValueType::int16},
                  {"signed short int", ValueType::int16},
                  {"int16", ValueType::int16},
                  {"int16_t", ValueType::int16},
                  {"ushort", ValueType::uint16},
                  {"unsigned short", ValueType::uint16},
                  {"unsigned short int", ValueType::uint16},
                  {"uint16", ValueType::uint16},
                  {"uint16_t", ValueType::uint16},
                  {"float", ValueType::float32},
                  {"double", ValueType::float64}};

uint64_t bytes_of(ValueType type) {
  return type == ValueType::uint8     ? 1
         : type == ValueType::float32 ? 4
         : type == ValueType::float64 ? 8
                                      : 2;
}

std::string_view trimmed(std::string_view text) {
  const size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// `count` finite numbers with spaces, brackets and commas between them, and nothing else.
std::optional<std::vector<double>> numbers(std::string_view text, size_t count) {
  std::vector<double> found;
  while (true) {
    const size_t first = text.find_first_not_of(" (,)\t");
    if (first == std::string_view::npos) break;
    text.remove_prefix(first);
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || !std::isfinite(number) || found.size() == count) return {};
    found.push_back(number);
    text.remove_prefix(static_cast<size_t>(end - text.data()));
  }
  if (found.size() != count) return {};
  return found;
}

/// The header of a file in NRRD, line by line.
class Header {
 public:
  Header(ImageFile& file) : file_(file) {}

  void read(std::string_view text) {
    size_t at = 0;
    if (!line(text, at).starts_with("NRRD000")) refuse("does not begin with NRRD000");
    for (std::string_view now = line(text, at); !now.empty(); now = line(text, at)) {
      if (now[0] == '#') continue;
      const size_t colon = now.find(':');
      if (colon == std::string_view::npos) refuse("a line has no colon", now);
      if (now.substr(colon + 1).starts_with('=')) continue;  // a key and its value
      take(now.substr(0, colon), trimmed(now.substr(colon + 1)));
    }
    if (!has_dimension_) refuse("names no dimension");
    if (!has_type_) refuse("names no type");
    if (file_.layout.size[0] == 0) refuse("names no sizes");
    if (!has_encoding_) refuse("names no encoding");
    file_.layout.skip_bytes = at;
  }

 private:
  [[noreturn]] static void refuse(const char* why, std::string_view value = {}) {
    fail(Status::io, "the header %s%s%.*s", why, value.empty() ? "" : ": ",
         static_cast<int>(std::min<size_t>(value.size(), 80)), value.data());
  }
  static std::string_view line(std::string_view text, size_t& at) {
    const size_t end = text.find('\n', at);
    if (end == std::string_view::npos) refuse("does not end with an empty line");
    const std::string_view found = trimmed(text.substr(at, end - at));
    at = end + 1;
    return found;
  }
  std::vector<double> all(std::string_view value, size_t count, const char* why) const {
    auto found = numbers(value, count);
    if (!found) refuse(why, value);
    return *std::move(found);
  }

  void take(std::string_view name, std::string_view value) {
    ImageLayout& layout = file_.layout;
    if (name == "dimension") {
      if (value != "3") refuse("has a dimension that is not 3", value);
      has_dimension_ = true;
    } else if (name == "type") {
      for (const auto& known : type_names)
        if (known.name == value) {
          layout.type = known.type;
          has_type_ = true;
        }
      if (!has_type_)
        fail(Status::unsupported,
             "the type is %.*s; uint8, int16, uint16, float and double are read",
             static_cast<int>(std::min<size_t>(value.size(), 80)), value.data());
    } else if (name == "encoding") {
      if (value != "raw")
        fail(Status::unsupported, "the encoding is %.*s; raw is read",
             static_cast<int>(std::min<size_t>(value.size(), 80)), value.data());
      has_encoding_ = true;
    } else if (name == "endian") {
      if (value != "little" && value != "big") refuse("has a wrong endian", value);
      layout.is_big_endian = value == "big";
    } else if (name == "sizes") {
      const auto sizes = all(value, 3, "has wrong sizes");
      for (size_t axis = 0; axis < 3; ++axis) {
        if (!(sizes[axis] >= 1 && sizes[axis] <= double{max_size}) ||
            sizes[axis] != std::floor(sizes[axis]))
          refuse("has wrong sizes; each must be 1 to 1048576", value);
        layout.size[axis] = static_cast<uint64_t>(sizes[axis]);
      }
    } else if (name == "spacings") {
      const auto spacings = all(value, 3, "has wrong spacings");
      std::copy(spacings.begin(), spacings.end(), file_.spacing);
    } else if (name == "space origin") {
      const auto origin = all(value, 3, "has a wrong space origin");
      std::copy(origin.begin(), origin.end(), file_.origin);
    } else if (name == "space directions") {
      const auto directions = all(value, 9, "has wrong space directions");
      for (size_t axis = 0; axis < 3; ++axis) {
        const double* v = &directions[3 * axis];
        const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
        file_.spacing[axis] = length;
        for (size_t i = 0; i < 3; ++i)
          file_.rotation[3 * i + axis] = length > 0 ? v[i] / length : 0;
      }
    } else if (name == "axis mins" || name == "axismins" || name == "axis maxs" ||
               name == "axismaxs") {
      fail(Status::unsupported,
           "%.*s say where the values are; spacings and space directions are read",
           static_cast<int>(name.size()), name.data());
    } else if (name == "data file" || name == "datafile") {
      fail(Status::unsupported, "the values are in another file, %.*s; values in the file are read",
           static_cast<int>(std::min<size_t>(value.size(), 80)), value.data());
    } else if (name == "byte skip" || name == "byteskip" || name == "line skip" ||
               name == "lineskip") {
      if (value != "0") refuse("skips bytes or lines, which must be 0", value);
    }
    // Others, such as content and kinds, say nothing about the values.
  }

  ImageFile& file_;
  bool has_dimension_ = false, has_type_ = false, has_encoding_ = false;
};

FileContent read_content(ImageFile& file, const std::string& path,
                         const ImageFileOptions& options) {
  return read_whole_file(path, options.job, [&](uint64_t bytes) {
    if (bytes > options.max_bytes)
      fail(Status::limit, "%s: the file has %llu bytes; the limit is %llu", shown(path).c_str(),
           static_cast<unsigned long long>(bytes),
           static_cast<unsigned long long>(options.max_bytes));
    if (options.budget) file.reservation = Reservation(options.budget, bytes, "an image file");
    file.read_bytes = bytes;
  });
}

/// Checks that the file holds the values and no more, and turns their bytes.
void arrange(ImageFile& file) {
  const ImageLayout& layout = file.layout;
  const uint64_t width = bytes_of(layout.type);
  uint64_t bytes = width;
  for (uint64_t size : layout.size) bytes = checked_product(bytes, size, "the image");
  const uint64_t held =
      file.content.size - std::min<uint64_t>(layout.skip_bytes, file.content.size);
  if (held != bytes)
    fail(Status::io, "there are %llu bytes of values; %llu x %llu x %llu values take %llu",
         static_cast<unsigned long long>(held), static_cast<unsigned long long>(layout.size[0]),
         static_cast<unsigned long long>(layout.size[1]),
         static_cast<unsigned long long>(layout.size[2]), static_cast<unsigned long long>(bytes));
  if (width == 1 || layout.is_big_endian == (std::endian::native == std::endian::big)) return;
  char* at = file.content.bytes.get() + layout.skip_bytes;
  for (uint64_t i = 0; i < bytes; i += width) std::reverse(at + i, at + i + width);
}

}  // namespace

ImageFile read_nrrd_file(const std::string& path, const ImageFileOptions& options) {
  ImageFile file;
  file.content = read_content(file, path, options);
  of_file(path, [&] {
    Header(file).read(file.content.view());
    arrange(file);
  });
  return file;
}

ImageFile read_raw_file(const std::string& path, const ImageLayout& layout,
                        const ImageFileOptions& options) {
  ImageFile file;
  file.layout = layout;
  file.content = read_content(file, path, options);
  of_file(path, [&] { arrange(file); });
  return file;
}

}  // namespace msq
