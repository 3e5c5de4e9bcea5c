// SPDX-License-Identifier: Apache-2.0
// The text of 3MF files: XML without names that need escapes, and numbers that are read back to the
// same doubles. lib3mf 1.8.1 is not used for it: it cuts coordinates off after six digits, writes
// those of slices with six significant digits in the locale of the host, and holds the whole model
// in memory (docs/decisions/007-mesh-files.md).
#pragma once

#include <charconv>
#include <cstdint>
#include <string>
#include <string_view>

#include "error.h"
#include "zip_file.h"

namespace msq_io {

class XmlText {
 public:
  explicit XmlText(std::string& to) : to_(to) {}

  XmlText& operator<<(std::string_view text) {
    to_ += text;
    return *this;
  }
  XmlText& operator<<(double value) { return put(value == 0 ? 0.0 : value); }
  XmlText& operator<<(uint64_t value) { return put(value); }

 private:
  template <class Number>
  XmlText& put(Number value) {
    char digits[40];
    to_.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
    return *this;
  }

  std::string& to_;
};

/// Name of the part that holds the model.
inline constexpr const char* threemf_part = "3D/3dmodel.model";

/// Adds the two parts that say where the model is.
void add_package_parts(ZipFile& zip);

/// The element <model>, up to and with <resources>. extensions: prefixes that a reader must know,
/// separated by spaces; names: their namespaces, as attributes.
void begin_model(XmlText& text, std::string_view extensions, std::string_view names);

/// Ends the resources and the model, whose build is one object.
void end_model(XmlText& text, uint64_t object);

/// A mesh of the host, whose numbers are checked as msq_shape_from_mesh checks them.
class HostMesh {
 public:
  /// NULL: no mesh.
  explicit HostMesh(const msq_mesh_def* def);
  uint64_t vertex_count() const { return is_given_ ? def_.vertex_count : 0; }
  uint64_t triangle_count() const { return is_given_ ? def_.triangle_count : 0; }
  /// A range of the list of vertices or triangles, without the element around it.
  void write_vertices(uint64_t first, uint64_t count, XmlText& text) const;
  void write_triangles(uint64_t first, uint64_t count, XmlText& text) const;

 private:
  double coordinate(uint64_t vertex, int axis) const;

  bool is_given_;
  msq_mesh_def def_{};
};

}  // namespace msq_io
