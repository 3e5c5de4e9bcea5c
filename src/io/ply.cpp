// SPDX-License-Identifier: Apache-2.0
// PLY files (Turk, "The PLY polygon file format", 1994), ASCII and binary. msq reads them itself
// because Assimp 5.2.5 writes out of bounds on bad indices, loses the first byte of binary data
// that begins with a line feed, and rounds doubles to floats. A scan to guard it would already be a
// reader.
#include <bit>
#include <cstring>
#include <string>
#include <vector>

#include "base/status.h"
#include "io/readers.h"
#include "io/text_cursor.h"
#include "io/text_lines.h"

namespace msq {
namespace {

using Count = unsigned long long;

enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

constexpr struct {
  const char* names[2];
  Type type;
  uint64_t size;
} types[] = {
    {{"char", "int8"}, Type::int8, 1},        {{"uchar", "uint8"}, Type::uint8, 1},
    {{"short", "int16"}, Type::int16, 2},     {{"ushort", "uint16"}, Type::uint16, 2},
    {{"int", "int32"}, Type::int32, 4},       {{"uint", "uint32"}, Type::uint32, 4},
    {{"float", "float32"}, Type::float32, 4}, {{"double", "float64"}, Type::float64, 8},
};

uint64_t size_of(Type type) {
  return types[static_cast<int>(type)].size;
}
bool is_integer(Type type) {
  return type < Type::float32;
}

struct Property {
  std::string name;
  Type type = Type::float32;
  bool is_list = false;
  Type count_type = Type::uint8;
};

struct Element {
  std::string name;
  uint64_t count = 0;
  std::vector<Property> properties;
};

enum class Encoding { ascii, little, big };

struct Header {
  Encoding encoding = Encoding::ascii;
  std::vector<Element> elements;
};

Type parse_type(std::string_view word) {
  for (const auto& known : types)
    if (word == known.names[0] || word == known.names[1]) return known.type;
  fail(Status::io, "PLY: \"%s\" is not a type", Quoted(word).text);
}

Property parse_property(TextCursor& line) {
  Property property;
  std::string_view word = line.word();
  if (word == "list") {
    property.is_list = true;
    property.count_type = parse_type(line.word());
    if (!is_integer(property.count_type))
      fail(Status::io, "PLY: a list has a count that is a float");
    word = line.word();
  }
  property.type = parse_type(word);
  property.name = line.word();
  return property;
}

/// One line of the header. All lines end like the first one, since binary data that begins with a
/// line feed may follow a carriage return or a line feed.
std::string_view header_line(std::string_view& rest, std::string_view line_end) {
  const size_t n = rest.find(line_end);
  if (n == std::string_view::npos) fail(Status::io, "PLY: the file ends in its header");
  const std::string_view line = rest.substr(0, n);
  rest.remove_prefix(n + line_end.size());
  return line;
}

/// Reads the header and moves `rest` to the data.
Header read_header(std::string_view& rest) {
  const size_t first = rest.find_first_of("\r\n");
  if (first == std::string_view::npos || TextCursor(rest.substr(0, first)).word() != "ply")
    fail(Status::io, "PLY: the file does not begin with a line \"ply\"");
  const std::string_view line_end = rest.substr(first).starts_with("\r\n") ? "\r\n"
                                    : rest[first] == '\r'                  ? "\r"
                                                                           : "\n";
  rest.remove_prefix(first + line_end.size());

  Header header;
  bool has_format = false;
  for (;;) {
    TextCursor line(header_line(rest, line_end));
    const std::string_view keyword = line.word();
    if (keyword == "end_header") break;
    if (keyword == "comment" || keyword == "obj_info" || keyword.empty()) continue;
    if (keyword == "format") {
      const std::string_view word = line.word();
      has_format = true;
      if (word == "ascii")
        header.encoding = Encoding::ascii;
      else if (word == "binary_little_endian")
        header.encoding = Encoding::little;
      else if (word == "binary_big_endian")
        header.encoding = Encoding::big;
      else
        fail(Status::io, "PLY: \"%s\" is not a format", Quoted(word).text);
    } else if (keyword == "element") {
      Element element;
      element.name = line.word();
      element.count = parse_count(line.word(), "PLY: element count");
      header.elements.push_back(std::move(element));
    } else if (keyword == "property") {
      if (header.elements.empty()) fail(Status::io, "PLY: a property stands before all elements");
      header.elements.back().properties.push_back(parse_property(line));
    } else {
      fail(Status::io, "PLY: \"%s\" is not a word of the header", Quoted(keyword).text);
    }
  }
  if (!has_format) fail(Status::io, "PLY: the header names no format");
  return header;
}

/// The data after the header, one value after another.
class Values {
 public:
  Values(std::string_view data, Encoding encoding) : data_(data), encoding_(encoding) {}

  uint64_t remaining() const { return data_.remaining(); }
  /// Minimum number of bytes of a value of the type: in ASCII a digit, and a space before the next.
  uint64_t min_bytes(Type type) const { return encoding_ == Encoding::ascii ? 2 : size_of(type); }

  double real(Type type) {
    if (encoding_ == Encoding::ascii) return parse_real(word(), "PLY: value");
    if (type == Type::float32) return take<float, uint32_t>();
    if (type == Type::float64) return take<double, uint64_t>();
    return static_cast<double>(integer(type));
  }
  int64_t integer(Type type) {
    if (encoding_ == Encoding::ascii) return parse_integer(word(), "PLY: value");
    switch (type) {
      case Type::int8:
        return take<int8_t, uint8_t>();
      case Type::uint8:
        return take<uint8_t, uint8_t>();
      case Type::int16:
        return take<int16_t, uint16_t>();
      case Type::uint16:
        return take<uint16_t, uint16_t>();
      case Type::int32:
        return take<int32_t, uint32_t>();
      default:
        return take<uint32_t, uint32_t>();
    }
  }

 private:
  std::string_view word() {
    const std::string_view word = data_.word();
    if (word.empty()) truncated();
    return word;
  }
  template <class Value, class Bits>
  Value take() {
    if (data_.remaining() < sizeof(Bits)) truncated();
    Bits bits = 0;
    for (size_t i = 0; i < sizeof(Bits); ++i) {
      const size_t shift = 8 * (encoding_ == Encoding::little ? i : sizeof(Bits) - 1 - i);
      bits = static_cast<Bits>(bits | Bits{static_cast<uint8_t>(data_.rest()[i])} << shift);
    }
    data_.skip(sizeof(Bits));
    return std::bit_cast<Value>(bits);
  }
  [[noreturn]] static void truncated() { fail(Status::io, "PLY: the file ends in its data"); }

  TextCursor data_;
  Encoding encoding_;
};

/// Throws if the elements cannot fit into the data, before anything is allocated for them.
void check_counts(const Header& header, const Values& values) {
  uint64_t room =
      values.remaining() + 1;  // the last value of an ASCII file needs no space after it
  for (const Element& element : header.elements) {
    uint64_t least = 0;
    for (const Property& property : element.properties)
      least += values.min_bytes(property.is_list ? property.count_type : property.type);
    if (!least && element.count)
      fail(Status::io, "PLY: the element \"%s\" has no properties", Quoted(element.name).text);
    if (least && element.count > room / least)
      fail(Status::io, "PLY: %llu of \"%s\" take %llu bytes each or more; %llu bytes are left",
           static_cast<Count>(element.count), Quoted(element.name).text, static_cast<Count>(least),
           static_cast<Count>(room));
    room -= element.count * least;
  }
}

uint64_t list_count(Values& values, const Property& property) {
  const int64_t count = values.integer(property.count_type);
  if (count < 0)
    fail(Status::io, "PLY: a list of \"%s\" has %lld entries", Quoted(property.name).text,
         static_cast<long long>(count));
  if (static_cast<uint64_t>(count) > (values.remaining() + 1) / values.min_bytes(property.type))
    fail(Status::io, "PLY: a list of \"%s\" has %lld entries; only %llu bytes are left",
         Quoted(property.name).text, static_cast<long long>(count),
         static_cast<Count>(values.remaining()));
  return static_cast<uint64_t>(count);
}

void skip(Values& values, const Property& property) {
  const uint64_t n = property.is_list ? list_count(values, property) : 1;
  for (uint64_t i = 0; i < n; ++i) values.real(property.type);
}

void read_vertices(const Element& element, Values& values, SoupBuilder& soup) {
  std::vector<int> axes;  // of each property; -1: another one
  bool found[3] = {};
  for (const Property& property : element.properties) {
    const bool is_axis = !property.is_list && property.name.size() == 1 &&
                         property.name[0] >= 'x' && property.name[0] <= 'z';
    axes.push_back(is_axis ? property.name[0] - 'x' : -1);
    if (is_axis) found[axes.back()] = true;
  }
  if (!found[0] || !found[1] || !found[2]) fail(Status::io, "PLY: vertices lack x, y or z");
  soup.expect_vertices(element.count);
  soup.reserve_vertices(element.count);
  for (uint64_t i = 0; i < element.count; ++i) {
    soup.report(values.remaining());
    Vec3 position;
    for (size_t k = 0; k < axes.size(); ++k) {
      if (axes[k] < 0)
        skip(values, element.properties[k]);
      else
        position[axes[k]] = values.real(element.properties[k].type);
    }
    soup.add_vertex(position);
  }
}

bool is_index_list(const Property& property) {
  return property.is_list && (property.name == "vertex_indices" || property.name == "vertex_index");
}

void read_faces(const Element& element, Values& values, SoupBuilder& soup) {
  int lists = 0;
  for (const Property& property : element.properties) {
    if (!is_index_list(property)) continue;
    ++lists;
    if (!is_integer(property.type)) fail(Status::io, "PLY: the vertex indices of faces are floats");
  }
  if (lists != 1) fail(Status::io, "PLY: faces have %d lists of vertex indices, not one", lists);
  std::vector<int64_t> polygon;
  for (uint64_t i = 0; i < element.count; ++i)
    for (const Property& property : element.properties) {
      soup.report(values.remaining());
      if (!is_index_list(property)) {
        skip(values, property);
        continue;
      }
      const uint64_t n = list_count(values, property);
      polygon.clear();
      for (uint64_t k = 0; k < n; ++k) polygon.push_back(values.integer(property.type));
      soup.add_polygon(polygon);
    }
}

}  // namespace

void read_ply(std::string_view file, SoupBuilder& soup) {
  refuse_wide_text(file, "PLY");
  std::string_view rest = file;
  const Header header = read_header(rest);
  Values values(rest, header.encoding);
  check_counts(header, values);
  bool has_vertices = false;
  for (const Element& element : header.elements) {
    if (element.name == "vertex" && !has_vertices) {
      has_vertices = true;
      read_vertices(element, values, soup);
    } else if (element.name == "face" && element.count) {
      if (!has_vertices) fail(Status::unsupported, "PLY: the faces stand before the vertices");
      read_faces(element, values, soup);
    } else if (element.name == "tristrips" && element.count) {
      fail(Status::unsupported, "PLY: triangle strips are not read");
    } else {
      for (uint64_t i = 0; i < element.count; ++i)
        for (const Property& property : element.properties) {
          soup.report(values.remaining());
          skip(values, property);
        }
    }
  }
}

}  // namespace msq
