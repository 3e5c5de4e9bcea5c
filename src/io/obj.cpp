// SPDX-License-Identifier: Apache-2.0
// OBJ files (Wavefront Technologies, "Advanced Visualizer Manual", appendix B1): their vertices and
// faces. Normals, texture coordinates, groups, materials, points, lines and free-form curves and
// surfaces are skipped, and no other file is opened. msq reads them itself because Assimp 5.2.5
// rounds coordinates to floats, not always correctly, and accesses memory outside its buffers.
#include <string_view>
#include <vector>

#include "base/status.h"
#include "io/readers.h"
#include "io/text_cursor.h"
#include "io/text_lines.h"

namespace msq {
namespace {

using Count = unsigned long long;

class ObjReader {
 public:
  ObjReader(std::string_view text, SoupBuilder& soup)
      : text_(text), soup_(soup), begin_(text.data()), at_(text.data()) {}

  /// The reader's position, for messages.
  const char* const& at() const { return at_; }

  void run() {
    while (text_.remaining()) {
      const std::string_view keyword = next();
      if (keyword == "v")
        read_vertex();
      else if (keyword == "f")
        read_face();
      while (!next().empty()) {
      }
      text_.line();
    }
    add_waiting_faces();
  }

 private:
  /// Next word of the statement, which continues after a backslash at the end of a line. Empty at
  /// its end and from a comment on.
  std::string_view next() {
    soup_.report(text_.remaining());
    for (;;) {
      std::string_view word = text_.word_of_line();
      at_ = word.data();
      if (word.starts_with('#')) {
        text_.rest_of_line();
        return {};
      }
      if (!word.ends_with('\\')) return word;
      TextCursor ahead = text_;
      if (!ahead.word_of_line().empty()) return word;
      text_.line();
      word.remove_suffix(1);
      if (!word.empty()) return word;
    }
  }

  void read_vertex() {
    // What follows is a weight, for curves only, or a colour.
    Vec3 position;
    for (int axis = 0; axis < 3; ++axis) {
      const std::string_view word = next();
      if (word.empty()) fail(Status::io, "a vertex has %d coordinates", axis);
      position[axis] = parse_finite(word, "vertex");
    }
    soup_.expect_vertices(1);
    soup_.add_vertex(position);
  }

  void read_face() {
    const char* const at = at_;
    const auto vertices = static_cast<int64_t>(soup_.vertices());
    bool is_ahead = false;
    polygon_.clear();
    for (std::string_view word = next(); !word.empty(); word = next()) {
      // Counts from 1, or back from -1, the last one so far.
      const int64_t index = parse_integer(word.substr(0, word.find('/')), "vertex index");
      if (index == 0 || index < -vertices)
        fail(Status::mesh, "vertex index %lld; there are %lld vertices so far",
             static_cast<long long>(index), static_cast<long long>(vertices));
      polygon_.push_back(index > 0 ? index - 1 : vertices + index);
      is_ahead |= index > vertices;
    }
    if (!is_ahead) return soup_.add_polygon(polygon_);
    waiting_.push_back(at - begin_);
    waiting_.push_back(static_cast<int64_t>(polygon_.size()));
    waiting_.insert(waiting_.end(), polygon_.begin(), polygon_.end());
  }

  /// Adds faces that come before their vertices.
  void add_waiting_faces() {
    for (size_t i = 0; i < waiting_.size();) {
      soup_.report(0);
      at_ = begin_ + waiting_[i];
      const auto corners = static_cast<size_t>(waiting_[i + 1]);
      const std::span<const int64_t> polygon(waiting_.data() + i + 2, corners);
      for (const int64_t index : polygon)
        if (static_cast<uint64_t>(index) >= soup_.vertices())
          fail(Status::mesh, "vertex index %lld; the file has %llu vertices",
               static_cast<long long>(index) + 1, static_cast<Count>(soup_.vertices()));
      soup_.add_polygon(polygon);
      i += 2 + corners;
    }
  }

  TextCursor text_;
  SoupBuilder& soup_;
  const char* const begin_;
  const char* at_;
  std::vector<int64_t> polygon_;
  std::vector<int64_t> waiting_;  // for each face: position, number of corners, corners
};

}  // namespace

void read_obj(std::string_view file, SoupBuilder& soup) {
  refuse_wide_text(file, "OBJ");
  const std::string_view text = without_byte_order_mark(file);
  ObjReader reader(text, soup);
  with_lines("OBJ", text, reader.at(), [&] { reader.run(); });
}

}  // namespace msq
