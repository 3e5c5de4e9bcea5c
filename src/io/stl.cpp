// SPDX-License-Identifier: Apache-2.0
// STL files, binary and ASCII, through Assimp. What it gets is written out anew from what was
// checked here: Assimp 5.2.5 takes the header of a binary file for text, reads past the end of
// ASCII files, knows lower-case keywords only, and leaks on facets that are not triangles.
#include <cstring>
#include <string>

#include "base/status.h"
#include "io/assimp_import.h"
#include "io/number_text.h"
#include "io/readers.h"
#include "io/text_cursor.h"

namespace msq {
namespace {

using Count = unsigned long long;

constexpr uint64_t header_bytes = 84, facet_bytes = 50;

uint64_t facet_count(std::string_view file) {
  uint64_t count = 0;
  for (int i = 0; i < 4; ++i)
    count |= uint64_t{static_cast<uint8_t>(file[80 + static_cast<size_t>(i)])} << (8 * i);
  return count;
}

/// Many binary files begin with "solid" too, so their length decides first, and then whether the
/// beginning goes on like text.
bool is_ascii(std::string_view file) {
  if (file.size() >= header_bytes && file.size() == header_bytes + facet_bytes * facet_count(file))
    return false;
  TextCursor text(without_byte_order_mark(file));
  if (!equal_ignoring_case(text.word(), "solid")) return false;
  text.line();
  const std::string_view next = text.word();
  if (next.empty()) return file.find('\0') == std::string_view::npos;
  return equal_ignoring_case(next, "facet") || equal_ignoring_case(next, "endsolid");
}

void read_binary(std::string_view file, SoupBuilder& soup) {
  if (file.size() < header_bytes)
    fail(Status::io, "STL: expected %llu bytes of header; the file has %llu",
         static_cast<Count>(header_bytes), static_cast<Count>(file.size()));
  const uint64_t facets = facet_count(file), expected = header_bytes + facet_bytes * facets;
  if (file.size() < expected)
    fail(Status::io, "STL: expected %llu bytes for %llu triangles; the file has %llu",
         static_cast<Count>(expected), static_cast<Count>(facets), static_cast<Count>(file.size()));
  if (!facets) fail(Status::mesh, "STL: the file has no triangles");
  soup.expect_triangles(facets);
  soup.expect_vertices(3 * facets);
  if (expected > UINT32_MAX)
    fail(Status::unsupported, "STL: %llu triangles take %llu bytes; Assimp reads no more than %llu",
         static_cast<Count>(facets), static_cast<Count>(expected), static_cast<Count>(UINT32_MAX));
  // Without the text of the header, the colours, and what some writers leave at the end.
  std::string clean(file.substr(0, expected));
  std::memset(clean.data(), 0, 80);
  for (uint64_t end = header_bytes + facet_bytes; end <= expected; end += facet_bytes)
    std::memset(clean.data() + end - 2, 0, 2);
  import_with_assimp(clean, "stl", soup);
}

class AsciiScan {
 public:
  AsciiScan(std::string_view file, SoupBuilder& soup)
      : text_(without_byte_order_mark(file)), soup_(soup) {
    clean_.reserve(file.size());
  }

  std::string run() {
    for (std::string_view word = text_.word(); !word.empty(); word = text_.word()) {
      if (!equal_ignoring_case(word, "solid")) unexpected(word, "solid");
      text_.line();  // the name
      scan_solid();
    }
    if (!facets_) fail(Status::mesh, "STL: the file has no triangles");
    return std::move(clean_);
  }

 private:
  void scan_solid() {
    clean_ += "solid\n";
    for (;;) {
      const std::string_view word = next();
      if (equal_ignoring_case(word, "endsolid")) break;
      if (!equal_ignoring_case(word, "facet")) unexpected(word, "facet or endsolid");
      soup_.expect_triangles(++facets_);
      expect("normal");
      for (int i = 0; i < 3; ++i) next();  // often wrong, and never used
      clean_ += "facet normal 0 0 0\n";
      expect("outer");
      expect("loop");
      for (int i = 0; i < 3; ++i) {
        expect("vertex");
        clean_ += "vertex";
        for (int axis = 0; axis < 3; ++axis) append_number(clean_, next(), "STL: vertex");
        clean_ += '\n';
      }
      expect("endloop");
      expect("endfacet");
    }
    text_.line();  // the name again
    clean_ += "endsolid\n";
  }

  std::string_view next() {
    const std::string_view word = text_.word();
    if (word.empty())
      fail(Status::io, "STL: the file ends after %llu triangles without \"endsolid\"",
           static_cast<Count>(facets_));
    return word;
  }
  void expect(const char* keyword) {
    const std::string_view word = next();
    if (!equal_ignoring_case(word, keyword)) unexpected(word, keyword);
  }
  [[noreturn]] void unexpected(std::string_view word, const char* expected) const {
    fail(Status::io, "STL: \"%s\" in place of %s, after %llu triangles", Quoted(word).text,
         expected, static_cast<Count>(facets_));
  }

  TextCursor text_;
  SoupBuilder& soup_;
  std::string clean_;
  uint64_t facets_ = 0;
};

}  // namespace

void read_stl(std::string_view file, SoupBuilder& soup) {
  if (is_ascii(file))
    import_with_assimp(AsciiScan(file, soup).run(), "stl", soup);
  else
    read_binary(file, soup);
}

}  // namespace msq
