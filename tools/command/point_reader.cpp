// SPDX-License-Identifier: Apache-2.0
#include "point_reader.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstring>

#include "failure.h"
#include "text.h"
#include "watch.h"

namespace command {

namespace {

static_assert(std::endian::native == std::endian::little, "NPY is read and written as it lies");

constexpr size_t MAX_LINE = 1 << 16;

// Whether a column may be meant as a number, a wrong one too. Headings are not.
bool looks_like_number(std::string_view part) {
  part = trimmed(part);
  if (part.starts_with('"')) part = trimmed(part.substr(1));
  std::string text(part);
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return !text.empty() && (std::strchr("+-.0123456789", text[0]) != nullptr || text == "nan" ||
                           text == "inf" || text == "infinity");
}

// Bytes of a file or of standard input.
class Input {
 public:
  explicit Input(const std::string& path) : name_(path) {
    if (path == "-") {
      name_ = "standard input";
      file_ = STDIN_FILENO;
    } else {
      file_ = open_file(path, O_RDONLY | O_CLOEXEC);
      if (file_ < 0) fail(std::strerror(errno));
    }
    struct stat status = {};
    if (fstat(file_, &status) == 0 && S_ISREG(status.st_mode)) {
      size_ = static_cast<uint64_t>(status.st_size);
    }
  }
  ~Input() {
    if (file_ != STDIN_FILENO) close(file_);
  }
  Input(const Input&) = delete;
  Input& operator=(const Input&) = delete;

  // Fewer than count only at the end of the file.
  size_t read(char* bytes, size_t count) {
    size_t done = 0;
    while (done < count) {
      const ssize_t got = ::read(file_, bytes + done, count - done);
      if (got < 0 && errno != EINTR) fail(std::strerror(errno));
      if (got < 0) heed_signals();
      if (got == 0) break;
      if (got > 0) done += static_cast<size_t>(got);
    }
    read_ += done;
    return done;
  }

  double share() const {
    return size_ == 0 ? -1 : static_cast<double>(read_) / static_cast<double>(size_);
  }

  [[noreturn]] void fail(const std::string& why) const { throw Failure(name_ + ": " + why); }

 private:
  std::string name_;
  int file_ = -1;
  uint64_t size_ = 0, read_ = 0;
};

class CsvReader : public PointReader {
 public:
  explicit CsvReader(const std::string& path) : input_(path) {}

  void next(std::vector<double>& points, size_t most) override {
    points.clear();
    std::string_view line;
    while (points.size() < 3 * most && next_line(line)) add(points, line);
  }

  double share() const override { return input_.share(); }

 private:
  // The text is valid until the next call.
  bool next_line(std::string_view& line) {
    for (;;) {
      const size_t end = text_.find('\n', begin_);
      if (end != std::string::npos) {
        line = std::string_view(text_).substr(begin_, end - begin_);
        begin_ = end + 1;
        break;
      }
      if (text_.size() - begin_ > MAX_LINE) {
        fail(line_ + 1, "more than " + std::to_string(MAX_LINE) + " bytes long");
      }
      if (is_end_) {
        if (begin_ == text_.size()) return false;
        line = std::string_view(text_).substr(begin_);
        begin_ = text_.size();
        break;
      }
      text_.erase(0, begin_);
      begin_ = 0;
      const size_t before = text_.size();
      text_.resize(before + MAX_LINE);
      const size_t got = input_.read(text_.data() + before, MAX_LINE);
      text_.resize(before + got);
      is_end_ = got < MAX_LINE;
    }
    ++line_;
    return true;
  }

  void add(std::vector<double>& points, std::string_view line) {
    if (line_ == 1 && line.starts_with("\xef\xbb\xbf")) line.remove_prefix(3);
    line = trimmed(line);
    if (line.empty() || line[0] == '#') return;
    const std::vector<std::string_view> parts = split(line, ',');
    const bool is_first = !std::exchange(has_row_, true);
    if (parts.size() < 3) {
      fail(line_, std::to_string(parts.size()) + " columns, and a point has 3");
    }
    if (is_first && std::none_of(parts.begin(), parts.begin() + 3, looks_like_number)) {
      has_heading_ = true;
      return;
    }
    if (parts.size() > 3 && !has_heading_) {
      fail(line_, std::to_string(parts.size()) +
                      " columns, and a point has 3; more need a heading, which names them");
    }
    double point[3];
    for (size_t i = 0; i < 3; ++i) {
      const std::optional<double> value = to_number(parts[i]);
      if (!value) fail(line_, "'" + one_line(parts[i]) + "' is not a finite number");
      point[i] = *value;
    }
    points.insert(points.end(), point, point + 3);
  }

  [[noreturn]] void fail(uint64_t line, const std::string& why) const {
    input_.fail("line " + std::to_string(line) + ": " + why);
  }

  Input input_;
  std::string text_;
  size_t begin_ = 0;
  uint64_t line_ = 0;
  bool is_end_ = false, has_row_ = false, has_heading_ = false;
};

class NpyReader : public PointReader {
 public:
  explicit NpyReader(const std::string& path) : input_(path) { read_head(); }

  void next(std::vector<double>& points, size_t most) override {
    const auto count = static_cast<size_t>(std::min<uint64_t>(most, count_ - at_));
    const size_t values = 3 * count;
    points.resize(values);
    if (is_double_) {
      read_exactly(reinterpret_cast<char*>(points.data()), values * sizeof(double));
    } else {
      narrow_.resize(values);
      read_exactly(reinterpret_cast<char*>(narrow_.data()), values * sizeof(float));
      std::copy(narrow_.begin(), narrow_.end(), points.begin());
    }
    for (size_t i = 0; i < values; ++i) {
      if (!std::isfinite(points[i])) {
        input_.fail("point " + std::to_string(at_ + i / 3) + ": " + exact(points[i]) +
                    " is not a finite number");
      }
    }
    at_ += count;
  }

  double share() const override {
    return count_ == 0 ? -1 : static_cast<double>(at_) / static_cast<double>(count_);
  }

 private:
  void read_exactly(char* bytes, size_t count) {
    if (input_.read(bytes, count) != count) {
      input_.fail("ends before point " + std::to_string(count_) + " of " + std::to_string(count_));
    }
  }

  // Format: numpy.lib.format, versions 1 to 3: a dictionary of Python as text.
  void read_head() {
    unsigned char start[12] = {};
    if (input_.read(reinterpret_cast<char*>(start), 8) != 8 ||
        std::memcmp(start, "\x93NUMPY", 6) != 0) {
      input_.fail("is no NPY file");
    }
    if (start[6] < 1 || start[6] > 3) {
      input_.fail("version " + std::to_string(start[6]) + " of NPY is not 1 to 3");
    }
    const size_t width = start[6] == 1 ? 2 : 4;
    if (input_.read(reinterpret_cast<char*>(start) + 8, width) != width) {
      input_.fail("ends in its heading");
    }
    size_t size = 0;
    for (size_t i = 0; i < width; ++i) size |= size_t{start[8 + i]} << (8 * i);
    if (size > MAX_LINE) {
      input_.fail("a head of " + std::to_string(size) + " bytes is above the limit of " +
                  std::to_string(MAX_LINE));
    }
    std::string head(size, '\0');
    if (input_.read(head.data(), size) != size) input_.fail("ends within its head");

    const std::string type = value_of(head, "'descr':");
    is_double_ = type.starts_with("'<f8'");
    if (!is_double_ && !type.starts_with("'<f4'")) {
      const size_t end = type.find_first_of(type.starts_with('[') ? "]" : "'", 1);
      input_.fail("the type of its numbers is not <f4 or <f8 but " + type.substr(0, end + 1));
    }
    if (!value_of(head, "'fortran_order':").starts_with("False")) {
      input_.fail("its values are in Fortran order; write numpy.ascontiguousarray(points)");
    }
    const std::string shape = value_of(head, "'shape':");
    const std::vector<std::string_view> sides = split(shape, ',');
    const auto count = sides[0].starts_with('(') ? to_count(sides[0].substr(1)) : std::nullopt;
    if (sides.size() < 2 || !count || !trimmed(sides[1]).starts_with("3)") ||
        *count > UINT64_MAX / 24) {
      input_.fail("its shape is not (n, 3) but " + shape.substr(0, shape.find(')') + 1));
    }
    count_ = *count;
  }

  // The text behind a key.
  static std::string value_of(const std::string& head, std::string_view key) {
    const size_t found = head.find(key);
    if (found == std::string::npos) return "";
    return std::string(trimmed(std::string_view(head).substr(found + key.size())));
  }

  Input input_;
  std::vector<float> narrow_;
  bool is_double_ = true;
  uint64_t count_ = 0, at_ = 0;
};

}  // namespace

std::unique_ptr<PointReader> open_points(const std::string& path) {
  if (path == "-" || ending(path) == ".csv") return std::make_unique<CsvReader>(path);
  if (ending(path) == ".npy") return std::make_unique<NpyReader>(path);
  throw UsageError("'" + path + "' ends neither in .csv nor in .npy");
}

}  // namespace command
