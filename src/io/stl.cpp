// SPDX-License-Identifier: Apache-2.0
// STL files (3D Systems, "StereoLithography Interface Specification"). msq reads text itself
// because Assimp 5.2.5 rounds its coordinates to floats, not always correctly, accepts only
// lower-case keywords, reads past the end, and leaks on facets that are not triangles. Assimp reads
// binary files, in pieces that are checked here first and cannot fail there. So a cancelled job
// ends soon, and files may be larger than Assimp's 4 GiB.
#include <algorithm>
#include <cstring>
#include <string>

#include "base/status.h"
#include "io/assimp_import.h"
#include "io/readers.h"
#include "io/text_cursor.h"
#include "io/text_lines.h"

namespace msq {
namespace {

using Count = unsigned long long;

constexpr uint64_t header_bytes = 84, facet_bytes = 50;
/// What Assimp reads at once: some milliseconds of work.
constexpr uint64_t piece_facets = 16384;

uint64_t facet_count(std::string_view file) {
  uint64_t count = 0;
  for (int i = 0; i < 4; ++i)
    count |= uint64_t{static_cast<uint8_t>(file[80 + static_cast<size_t>(i)])} << (8 * i);
  return count;
}

/// "solid" in UTF-16 or UTF-32, with or without its mark.
bool is_wide_solid(std::string_view file) {
  if (!is_wide_text(file)) return false;
  std::string letters;
  for (const char c : file.substr(0, 32))
    if (c > 0 && c < 127) letters += c;
  return equal_ignoring_case(TextCursor(letters).word().substr(0, 5), "solid");
}

/// Many binary files begin with "solid" too, so their length decides first, and then whether the
/// beginning goes on like text.
bool is_ascii(std::string_view file) {
  if (file.size() >= header_bytes && file.size() == header_bytes + facet_bytes * facet_count(file))
    return false;
  if (is_wide_solid(file)) refuse_wide_text(file, "STL");
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
  soup.reserve_vertices(3 * facets);
  for (uint64_t first = 0; first < facets; first += piece_facets) {
    soup.report_now(file.size() - header_bytes - first * facet_bytes);
    const uint64_t count = std::min(piece_facets, facets - first);
    // Without the text of the header and the colours, which Assimp looks at.
    std::string piece(80, '\0');
    for (int i = 0; i < 4; ++i) piece += static_cast<char>(count >> (8 * i));
    piece += file.substr(header_bytes + first * facet_bytes, count * facet_bytes);
    for (size_t end = header_bytes + facet_bytes; end <= piece.size(); end += facet_bytes)
      std::memset(piece.data() + end - 2, 0, 2);
    import_with_assimp(piece, "stl", soup);
  }
}

/// Text: solids of facets of three vertices. Words in any case, layout free; names of solids, up to
/// the end of the line, and normals are passed over.
class AsciiReader {
 public:
  AsciiReader(std::string_view text, SoupBuilder& soup)
      : text_(text), soup_(soup), at_(text.data()) {}

  /// Where the reader is, for messages.
  const char* const& at() const { return at_; }

  void run() {
    for (std::string_view word = take(); !word.empty(); word = take()) {
      if (!equal_ignoring_case(word, "solid")) unexpected(word, "solid");
      text_.line();
      read_solid();
    }
  }

 private:
  void read_solid() {
    for (;;) {
      const std::string_view word = next();
      if (equal_ignoring_case(word, "endsolid")) break;
      if (!equal_ignoring_case(word, "facet")) unexpected(word, "facet or endsolid");
      expect("normal");
      for (int i = 0; i < 3; ++i) next();  // often wrong, and never used
      expect("outer");
      expect("loop");
      Vec3 corners[3];
      for (Vec3& corner : corners) {
        expect("vertex");
        for (int axis = 0; axis < 3; ++axis) corner[axis] = parse_finite(next(), "vertex");
      }
      expect("endloop");
      expect("endfacet");
      soup_.add_triangle(corners);
    }
    text_.line();
  }

  std::string_view take() {
    soup_.report(text_.remaining());
    const std::string_view word = text_.word();
    at_ = word.data();
    return word;
  }
  std::string_view next() {
    const std::string_view word = take();
    if (word.empty())
      fail(Status::io, "the file ends after %llu triangles without \"endsolid\"",
           static_cast<Count>(soup_.triangles()));
    return word;
  }
  void expect(const char* keyword) {
    const std::string_view word = next();
    if (!equal_ignoring_case(word, keyword)) unexpected(word, keyword);
  }
  [[noreturn]] void unexpected(std::string_view word, const char* expected) const {
    fail(Status::io, "\"%s\" in place of %s, after %llu triangles", Quoted(word).text, expected,
         static_cast<Count>(soup_.triangles()));
  }

  TextCursor text_;
  SoupBuilder& soup_;
  const char* at_;
};

}  // namespace

void read_stl(std::string_view file, SoupBuilder& soup) {
  if (!is_ascii(file)) return read_binary(file, soup);
  const std::string_view text = without_byte_order_mark(file);
  AsciiReader reader(text, soup);
  with_lines("STL", text, reader.at(), [&] { reader.run(); });
}

}  // namespace msq
