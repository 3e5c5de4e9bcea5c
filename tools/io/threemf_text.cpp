// SPDX-License-Identifier: Apache-2.0
// Source: 3MF Consortium, "Core Specification", version 1.3, chapters 2 to 4.
#include "threemf_text.h"

#include <cmath>
#include <cstring>

#include "defs.h"

namespace msq_io {

void add_package_parts(ZipFile& zip) {
  static constexpr char types[] =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">"
      "<Default Extension=\"rels\" "
      "ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>"
      "<Default Extension=\"model\" "
      "ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/></Types>\n";
  static constexpr char relationships[] =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">"
      "<Relationship Target=\"/3D/3dmodel.model\" Id=\"rel0\" "
      "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>\n";
  zip.add("[Content_Types].xml", types, sizeof types - 1, true);
  zip.add("_rels/.rels", relationships, sizeof relationships - 1, true);
}

void begin_model(XmlText& text, std::string_view extensions, std::string_view names) {
  text << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"millimeter\" "
          "xml:lang=\"en-US\" "
          "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\" "
       << names << " requiredextensions=\"" << extensions
       << "\">\n<metadata name=\"Application\">msq</metadata>\n<resources>\n";
}

void end_model(XmlText& text, uint64_t object) {
  text << "</resources>\n<build><item objectid=\"" << object << "\"/></build>\n</model>\n";
}

HostMesh::HostMesh(const msq_mesh_def* def) : is_given_(def) {
  if (!def) return;
  msq_mesh_def defaults;
  check_msq(msq_mesh_def_init(&defaults, sizeof defaults));
  def_ = read_def(def, defaults, "mesh");
  require_range<int32_t>(def_.coordinate_type, MSQ_FLOAT32, MSQ_FLOAT64, "coordinate_type");
  if (!def_.vertices) fail(MSQ_E_ARGUMENT, "vertices is NULL");
  require(def_.triangles, "triangles");
  if (def_.triangle_count == 0) fail(MSQ_E_MESH, "the mesh has no triangles");
  if (def_.vertex_count > INT32_MAX || def_.triangle_count > INT32_MAX)
    fail(MSQ_E_LIMIT, "the mesh has %llu vertices and %llu triangles; the limit is %d of each",
         static_cast<unsigned long long>(def_.vertex_count),
         static_cast<unsigned long long>(def_.triangle_count), INT32_MAX);
  const uint64_t packed = def_.coordinate_type == MSQ_FLOAT32 ? 12 : 24;
  if (def_.vertex_stride != 0 && def_.vertex_stride < packed)
    fail(MSQ_E_ARGUMENT, "vertex_stride is %llu; a vertex has %llu bytes",
         static_cast<unsigned long long>(def_.vertex_stride),
         static_cast<unsigned long long>(packed));
  if (def_.vertex_stride == 0) def_.vertex_stride = packed;
  for (uint64_t i = 0; i < def_.vertex_count; ++i)
    for (int axis = 0; axis < 3; ++axis)
      if (!std::isfinite(coordinate(i, axis)))
        fail(MSQ_E_MESH, "vertex %llu of the mesh is not finite",
             static_cast<unsigned long long>(i));
  for (uint64_t i = 0; i < 3 * def_.triangle_count; ++i)
    if (def_.triangles[i] >= def_.vertex_count)
      fail(MSQ_E_MESH, "triangle %llu of the mesh has vertex index %u; there are %llu vertices",
           static_cast<unsigned long long>(i / 3), def_.triangles[i],
           static_cast<unsigned long long>(def_.vertex_count));
}

double HostMesh::coordinate(uint64_t vertex, int axis) const {
  const auto* at = static_cast<const char*>(def_.vertices) + vertex * def_.vertex_stride;
  if (def_.coordinate_type == MSQ_FLOAT32) {
    float value;
    std::memcpy(&value, at + axis * sizeof value, sizeof value);
    return double{value};
  }
  double value;
  std::memcpy(&value, at + axis * sizeof value, sizeof value);
  return value;
}

void HostMesh::write_vertices(uint64_t first, uint64_t count, XmlText& text) const {
  for (uint64_t i = first; i < first + count; ++i)
    text << "<vertex x=\"" << coordinate(i, 0) << "\" y=\"" << coordinate(i, 1) << "\" z=\""
         << coordinate(i, 2) << "\"/>\n";
}

void HostMesh::write_triangles(uint64_t first, uint64_t count, XmlText& text) const {
  for (uint64_t i = first; i < first + count; ++i) {
    const uint32_t* corners = def_.triangles + 3 * i;
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
    text << "<triangle v1=\"" << uint64_t{corners[0]} << "\" v2=\"" << uint64_t{corners[1]}
         << "\" v3=\"" << uint64_t{corners[2]} << "\"/>\n";
  }
}

}  // namespace msq_io
