// SPDX-License-Identifier: Apache-2.0
// OBJ files (Wavefront) through Assimp, which gets the v and f statements alone, checked and
// written out anew: Assimp 5.2.5 opens what mtllib names, drops vertices with a number that begins
// with a point or with five or seven numbers, so that all later indices point elsewhere, reads
// "+12" and "012" as two indices, drops the last line of files over 16 MB without a line end, and
// steps out of its buffers on much else.
#include <string>

#include "base/status.h"
#include "io/assimp_import.h"
#include "io/number_text.h"
#include "io/readers.h"
#include "io/text_cursor.h"

namespace msq {
namespace {

using Count = unsigned long long;

class ObjScan {
 public:
  ObjScan(std::string_view file, SoupBuilder& soup)
      : text_(without_byte_order_mark(file)), soup_(soup) {
    clean_.reserve(file.size());
  }

  std::string run() {
    while (text_.remaining()) {
      ++line_;
      const std::string_view keyword = next();
      if (keyword == "v")
        scan_vertex();
      else if (keyword == "f")
        scan_face();
      while (!next().empty()) {
      }
      text_.line();
    }
    if (highest_ > vertices_)
      fail(Status::mesh, "OBJ: line %llu has vertex index %lld; the file has %llu vertices",
           static_cast<Count>(highest_line_), static_cast<long long>(highest_),
           static_cast<Count>(vertices_));
    if (highest_ > INT32_MAX)
      fail(Status::unsupported, "OBJ: vertex index %lld; Assimp reads no more than %d",
           static_cast<long long>(highest_), INT32_MAX);
    if (!triangles_) fail(Status::mesh, "OBJ: the file has no triangles");
    clean_ += "# the end\n# the end\n";  // Assimp wants 16 bytes
    return std::move(clean_);
  }

 private:
  /// Next word of the statement, which goes on behind a backslash at the end of a line. Empty at
  /// its end and from a comment on.
  std::string_view next() {
    for (;;) {
      std::string_view word = text_.word_of_line();
      if (word.starts_with('#')) {
        while (!text_.word_of_line().empty()) {
        }
        return {};
      }
      if (!word.ends_with('\\')) return word;
      TextCursor ahead = text_;
      if (!ahead.word_of_line().empty()) return word;
      text_.line();
      ++line_;
      word.remove_suffix(1);
      if (!word.empty()) return word;
    }
  }

  void scan_vertex() {
    // What follows is a weight, for curves only, or a colour.
    clean_ += 'v';
    for (int axis = 0; axis < 3; ++axis) {
      const std::string_view word = next();
      if (word.empty())
        fail(Status::io, "OBJ: line %llu: a vertex has %d coordinates", static_cast<Count>(line_),
             axis);
      append_number(clean_, word, "OBJ: vertex");
    }
    clean_ += '\n';
    ++vertices_;
    soup_.expect_vertices(static_cast<uint64_t>(vertices_));
  }

  void scan_face() {
    const size_t begin = clean_.size();
    clean_ += 'f';
    uint64_t corners = 0;
    for (std::string_view word = next(); !word.empty(); word = next(), ++corners) {
      int64_t index = parse_integer(word.substr(0, word.find('/')), "OBJ: vertex index");
      if (index < 0 && index >= -vertices_) index += vertices_ + 1;
      if (index < 1)
        fail(Status::mesh, "OBJ: line %llu has vertex index %lld; there are %llu vertices so far",
             static_cast<Count>(line_), static_cast<long long>(index),
             static_cast<Count>(vertices_));
      if (index > highest_) {
        highest_ = index;
        highest_line_ = line_;
      }
      clean_ += ' ';
      clean_ += std::to_string(index);
    }
    clean_ += '\n';
    if (corners < 3)
      clean_.resize(begin);
    else
      soup_.expect_triangles(triangles_ += corners - 2);
  }

  TextCursor text_;
  SoupBuilder& soup_;
  std::string clean_;
  uint64_t line_ = 0, triangles_ = 0, highest_line_ = 0;
  int64_t vertices_ = 0, highest_ = 0;
};

}  // namespace

void read_obj(std::string_view file, SoupBuilder& soup) {
  import_with_assimp(ObjScan(file, soup).run(), "obj", soup);
}

}  // namespace msq
