// SPDX-License-Identifier: Apache-2.0
// OFF files (Geomview), ASCII. msq reads them itself because Assimp 5.2.5 drops polygons of more
// than nine vertices, clamps indices out of range and allocates the sizes that the header gives.
#include <vector>

#include "base/status.h"
#include "io/readers.h"
#include "io/text_cursor.h"
#include "io/text_lines.h"

namespace msq {
namespace {

using Count = unsigned long long;

/// Next word outside of comments.
std::string_view next_word(TextCursor& text, const char* what) {
  for (;;) {
    const std::string_view word = text.word();
    if (word.empty()) fail(Status::io, "OFF: the file ends in its %s", what);
    if (word[0] != '#') return word;
    text.line();
  }
}

/// Skips the keyword [ST][C][N][4][n]OFF, which may be missing. Returns whether vertices have a
/// fourth, homogeneous coordinate.
bool read_keyword(TextCursor& text) {
  TextCursor ahead = text;
  const std::string_view word = next_word(ahead, "header");
  const bool is_count = word[0] >= '0' && word[0] <= '9' && word.find("OFF") == word.npos;
  if (is_count) return false;
  std::string_view letters = word;
  if (letters.starts_with("ST")) letters.remove_prefix(2);
  if (letters.starts_with('C')) letters.remove_prefix(1);
  if (letters.starts_with('N')) letters.remove_prefix(1);
  const bool homogeneous = letters.starts_with('4');
  if (homogeneous) letters.remove_prefix(1);
  if (letters.starts_with('n'))
    fail(Status::unsupported, "OFF: vertices of other than three dimensions (\"%s\")",
         Quoted(word).text);
  if (!letters.starts_with("OFF"))
    fail(Status::io, "OFF: the file begins with \"%s\", not with OFF", Quoted(word).text);
  // Some files have the first count directly after the keyword.
  const size_t after = static_cast<size_t>(letters.data() + 3 - text.rest().data());
  text.skip(after);
  TextCursor rest = text;
  if (rest.word_of_line() == "BINARY")
    fail(Status::unsupported, "OFF: binary files are not read, only ASCII ones");
  return homogeneous;
}

}  // namespace

void read_off(std::string_view file, SoupBuilder& soup) {
  refuse_wide_text(file, "OFF");
  TextCursor text(without_byte_order_mark(file));
  const bool homogeneous = read_keyword(text);
  const uint64_t vertices = parse_count(next_word(text, "header"), "OFF: vertex count");
  const uint64_t faces = parse_count(next_word(text, "header"), "OFF: face count");
  parse_count(next_word(text, "header"), "OFF: edge count");

  // A vertex takes 6 bytes or more ("0 0 0" and a line end), a face 2.
  const uint64_t room = text.remaining() + 1;
  if (vertices > room / 6 || faces > (room - 6 * vertices) / 2)
    fail(Status::io, "OFF: the header claims %llu vertices and %llu faces; only %llu bytes follow",
         static_cast<Count>(vertices), static_cast<Count>(faces),
         static_cast<Count>(text.remaining()));
  soup.expect_vertices(vertices);
  soup.reserve_vertices(vertices);

  // Colours and other data may follow on the line of a vertex or a face.
  for (uint64_t i = 0; i < vertices; ++i) {
    soup.report(text.remaining());
    double p[4] = {0, 0, 0, 1};
    for (int axis = 0; axis < (homogeneous ? 4 : 3); ++axis)
      p[axis] = parse_real(next_word(text, "vertices"), "OFF: vertex");
    text.line();
    soup.add_vertex({p[0] / p[3], p[1] / p[3], p[2] / p[3]});
  }
  std::vector<int64_t> polygon;
  for (uint64_t i = 0; i < faces; ++i) {
    const uint64_t n = parse_count(next_word(text, "faces"), "OFF: vertices of a face");
    polygon.clear();
    for (uint64_t k = 0; k < n; ++k) {
      soup.report(text.remaining());
      polygon.push_back(parse_integer(next_word(text, "faces"), "OFF: vertex index"));
    }
    text.line();
    soup.add_polygon(polygon);
  }
}

}  // namespace msq
