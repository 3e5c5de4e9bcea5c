// SPDX-License-Identifier: Apache-2.0
// Files of every format to read, and what is to come of them, for the tests of the mesh reader.
#pragma once

#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>
#if MSQ_WITH_ASSIMP
#include <zip.h>
#endif

#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "base/status.h"
#include "io/mesh_file.h"

extern "C" {
#include <cmocka.h>  // last: it has a macro called fail
}

namespace mesh_file_fixtures {

using msq::MeshFileOptions;
using msq::MeshFormat;
using msq::Status;
using msq::TriangleSoup;
using msq::Vec3;

// A box of 2 x 3 x 4 at (1, 1, 1), its six sides counter-clockwise from outside.
constexpr double box_volume = 24;
constexpr int corners[8][3] = {{1, 1, 1}, {3, 1, 1}, {3, 4, 1}, {1, 4, 1},
                               {1, 1, 5}, {3, 1, 5}, {3, 4, 5}, {1, 4, 5}};
constexpr int sides[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                             {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

inline std::array<std::array<int, 3>, 12> box_triangles() {
  std::array<std::array<int, 3>, 12> result;
  for (size_t i = 0; i < 6; ++i) {
    result[2 * i] = {sides[i][0], sides[i][1], sides[i][2]};
    result[2 * i + 1] = {sides[i][0], sides[i][2], sides[i][3]};
  }
  return result;
}

inline std::string text(const char* format, ...) __attribute__((format(printf, 1, 2)));
inline std::string text(const char* format, ...) {
  char line[512];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(line, sizeof line, format, arguments);
  va_end(arguments);
  return line;
}

template <class Value>
void put(std::string& bytes, Value value, bool big_endian = false) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  for (size_t i = 0; i < sizeof value; ++i) bytes += raw[big_endian ? sizeof value - 1 - i : i];
}

inline std::string stl_binary() {
  std::string file = "solid, says the header of this binary file";
  file.resize(80, ' ');
  put(file, uint32_t{12});
  for (const auto& triangle : box_triangles()) {
    for (int i = 0; i < 3; ++i) put(file, 0.0f);
    for (const int corner : triangle)
      for (const int x : corners[corner]) put(file, static_cast<float>(x));
    put(file, uint16_t{0x8123});
  }
  return file;
}

inline std::string stl_ascii() {
  std::string file = "solid a facet of vertex 1 2 3\n";
  for (const auto& triangle : box_triangles()) {
    file += "  facet normal nan 0 1\n    outer loop\n";
    for (const int c : triangle)
      file += text("      vertex %d.0 %de0 %d\n", corners[c][0], corners[c][1], corners[c][2]);
    file += "    endloop\n  endfacet\n";
  }
  return file + "endsolid a\n";
}

inline std::string obj() {
  std::string file = "# a box\nmtllib /etc/passwd\nmtllib elsewhere.mtl\no box\n";
  for (const auto& p : corners) file += text("v %d %d %d\n", p[0], p[1], p[2]);
  file += "vn 0 0 1\nvt .5 .5\nusemtl none\nl 1 2\np 3\n";
  for (int i = 0; i < 6; ++i) {
    const int* s = sides[i];
    if (i % 2)
      file += text("f %d/1/1 %d//1 %d/1 %d\n", s[0] + 1, s[1] + 1, s[2] + 1, s[3] + 1);
    else
      file += text("f %d %d \\\n %d %d\n", s[0] - 8, s[1] - 8, s[2] - 8, s[3] - 8);
  }
  return file;
}

enum class PlyKind { ascii, little, big };

inline std::string ply(PlyKind kind) {
  constexpr const char* names[] = {"ascii", "binary_little_endian", "binary_big_endian"};
  std::string file = text(
      "ply\nformat %s 1.0\ncomment a box\nelement vertex 8\nproperty float x\nproperty double y\n"
      "property uchar red\nproperty float z\nelement face 6\n"
      "property list uchar int vertex_indices\nproperty list uchar float texcoord\nend_header\n",
      names[static_cast<int>(kind)]);
  const bool big = kind == PlyKind::big;
  for (const auto& p : corners) {
    if (kind == PlyKind::ascii) {
      file += text("%d %d 10 %d\n", p[0], p[1], p[2]);
      continue;
    }
    put(file, static_cast<float>(p[0]), big);
    put(file, static_cast<double>(p[1]), big);
    put(file, uint8_t{10});
    put(file, static_cast<float>(p[2]), big);
  }
  for (const auto& s : sides) {
    if (kind == PlyKind::ascii) {
      file += text("4 %d %d %d %d 1 0.5\n", s[0], s[1], s[2], s[3]);
      continue;
    }
    put(file, uint8_t{4});
    for (const int index : s) put(file, static_cast<int32_t>(index), big);
    put(file, uint8_t{1});
    put(file, 0.5f, big);
  }
  return file;
}

inline std::string off() {
  std::string file = "OFF # a box\n8 6 0\n";
  for (const auto& p : corners) file += text("%d %d %d\n", p[0], p[1], p[2]);
  file += "# sides\n";
  for (const auto& s : sides) file += text("4 %d %d %d %d 255 0 0\n", s[0], s[1], s[2], s[3]);
  return file;
}

/// A folder of its own for the whole run.
class Folder {
 public:
  Folder() {
    const char* parent = getenv("TMPDIR");
    path_ = std::string(parent && *parent ? parent : "/tmp") + "/msq_mesh_file_XXXXXX";
    if (!mkdtemp(path_.data())) abort();
  }
  ~Folder() {
    if (DIR* folder = opendir(path_.c_str())) {
      while (const dirent* entry = readdir(folder)) {
        const std::string name = file(entry->d_name);
        if (entry->d_name[0] != '.' && unlink(name.c_str()) != 0) rmdir(name.c_str());
      }
      closedir(folder);
    }
    rmdir(path_.c_str());
  }
  std::string file(const std::string& name) const { return path_ + "/" + name; }
  std::string write(const std::string& name, const std::string& content) const {
    std::FILE* out = fopen(file(name).c_str(), "wb");
    assert_non_null(out);
    assert_int_equal(fwrite(content.data(), 1, content.size(), out), content.size());
    fclose(out);
    return file(name);
  }

 private:
  std::string path_;
};

inline const Folder& folder() {
  static const Folder folder;
  return folder;
}

#if MSQ_WITH_ASSIMP

struct Entry {
  std::string name, content;
};

inline std::string zip_archive(const std::vector<Entry>& entries) {
  const std::string path = folder().file("archive");
  zipFile zip = zipOpen(path.c_str(), APPEND_STATUS_CREATE);
  assert_non_null(zip);
  for (const Entry& entry : entries) {
    zip_fileinfo info = {};
    assert_int_equal(zipOpenNewFileInZip(zip, entry.name.c_str(), &info, nullptr, 0, nullptr, 0,
                                         nullptr, Z_DEFLATED, Z_BEST_COMPRESSION),
                     ZIP_OK);
    assert_int_equal(
        zipWriteInFileInZip(zip, entry.content.data(), static_cast<unsigned>(entry.content.size())),
        ZIP_OK);
    assert_int_equal(zipCloseFileInZip(zip), ZIP_OK);
  }
  assert_int_equal(zipClose(zip, nullptr), ZIP_OK);
  std::FILE* in = fopen(path.c_str(), "rb");
  assert_non_null(in);
  std::string content;
  char block[4096];
  for (size_t n; (n = fread(block, 1, sizeof block, in)) > 0;) content.append(block, n);
  fclose(in);
  return content;
}

/// The archive with end records of Zip64, as some writers of 3MF make them of any size.
inline std::string zip64_archive(std::string archive) {
  constexpr size_t end_bytes = 22;
  const size_t end = archive.size() - end_bytes;
  const auto number = [&](size_t at, size_t bytes) {
    uint64_t value = 0;
    for (size_t i = 0; i < bytes; ++i)
      value |= uint64_t{static_cast<uint8_t>(archive[end + at + i])} << (8 * i);
    return value;
  };
  const uint64_t entries = number(10, 2), bytes = number(12, 4), offset = number(16, 4);
  archive.resize(end);
  archive += "PK\x06\x06";
  put(archive, uint64_t{44});
  put(archive, uint32_t{45 | 45 << 16});
  put(archive, uint64_t{0});
  for (const uint64_t value : {entries, entries, bytes, offset}) put(archive, value);
  archive += "PK\x06\x07";
  put(archive, uint32_t{0});
  put(archive, uint64_t{end});
  put(archive, uint32_t{1});
  archive += "PK\x05\x06";
  put(archive, uint32_t{0});
  for (int i = 0; i < 3; ++i) put(archive, UINT32_MAX);
  put(archive, uint16_t{0});
  return archive;
}

inline std::string threemf_mesh() {
  std::string mesh = "<mesh><vertices><vertex x=\"9\" y=\"9\" z=\"9\"/>";
  for (const auto& p : corners)
    mesh += text("<vertex x=\"%d\" y=\"%d\" z=\"%d\"/>", p[0], p[1], p[2]);
  mesh += "</vertices><triangles>";
  for (const auto& t : box_triangles())
    mesh += text("<triangle v1=\"%d\" v2=\"%d\" v3=\"%d\"/>", t[0] + 1, t[1] + 1, t[2] + 1);
  return mesh + "</triangles></mesh>";
}

constexpr const char* relationships =
    "<?xml version=\"1.0\"?><Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/"
    "relationships\"><Relationship Target=\"/3D/other.model\" Id=\"rel0\" Type=\"http://schemas."
    "microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>";

inline std::string threemf_model(const std::string& attributes, const std::string& resources,
                                 const std::string& build) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model " + attributes +
         " xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\"><resources>" +
         resources + "</resources><build>" + build + "</build></model>";
}

inline std::string threemf(const std::string& attributes, const std::string& resources,
                           const std::string& build) {
  return zip_archive({{"3D/3dmodel.model", threemf_model(attributes, resources, build)}});
}

/// Inches; the box by itself, and twice in a component object: moved, and mirrored.
inline std::string threemf() {
  return threemf("unit=\"inch\"",
                 "<object id=\"1\" type=\"model\">" + threemf_mesh() +
                     "</object><object id=\"7\"><components>"
                     "<component objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 100 0 0\"/>"
                     "<component objectid=\"1\" transform=\"-1 0 0 0 1 0 0 0 1 0 100 0\"/>"
                     "</components></object><object id=\"8\">" +
                     threemf_mesh() + "</object>",
                 "<item objectid=\"1\"/>"
                 "<item objectid=\"7\" transform=\"0 2 0 -2 0 0 0 0 2 0 0 1000\"/>");
}

#endif  // MSQ_WITH_ASSIMP

inline std::string amf_object(const char* id) {
  std::string object = text("<object id=\"%s\"><mesh><vertices>", id);
  for (const auto& p : corners)
    object += text("<vertex><coordinates><x>%d</x><y> %d </y><z>%d</z></coordinates></vertex>",
                   p[0], p[1], p[2]);
  object += "</vertices><volume>";
  int n = 0;
  for (const auto& t : box_triangles()) {
    if (++n == 7) object += "</volume><volume>";
    object += text("<triangle><v1>%d</v1><v2>%d</v2><v3>%d</v3></triangle>", t[0], t[1], t[2]);
  }
  return object + "</volume></mesh></object>";
}

inline std::string amf() {
  return "<?xml version=\"1.0\"?>\n<amf unit=\"inch\">" + amf_object("0") + amf_object("a") +
         "<constellation id=\"5\"><instance objectid=\"a\"><deltax>100</deltax><rz>90</rz>"
         "</instance><instance objectid=\"a\"><deltaz>-50</deltaz></instance></constellation>"
         "</amf>";
}

// ---- helpers

inline MeshFileOptions options_for(MeshFormat format) {
  MeshFileOptions options;
  options.format = format;
  return options;
}

inline TriangleSoup read(const std::string& file, const MeshFileOptions& options) {
  return msq::read_mesh_memory(file.data(), file.size(), options);
}

inline double volume(const TriangleSoup& soup, size_t first, size_t count) {
  double six = 0;
  for (size_t i = first; i < first + count; ++i) {
    const msq::Triangle& t = soup.triangles[i];
    six += dot(soup.vertices[t[0]], cross(soup.vertices[t[1]], soup.vertices[t[2]]));
  }
  return six / 6;
}

inline double volume(const TriangleSoup& soup) {
  return volume(soup, 0, soup.triangles.size());
}

inline void assert_near(double value, double expected) {
  if (!(std::abs(value - expected) <= 1e-9 * (1 + std::abs(expected))))
    fail_msg("%.17g is not %.17g", value, expected);
}

inline void assert_bounds(const TriangleSoup& soup, size_t first, size_t count, Vec3 min,
                          Vec3 max) {
  const double inf = std::numeric_limits<double>::infinity();
  Vec3 low{inf, inf, inf}, high{-inf, -inf, -inf};
  for (size_t i = first; i < first + count; ++i)
    for (const uint32_t v : soup.triangles[i]) {
      low = msq::min(low, soup.vertices[v]);
      high = msq::max(high, soup.vertices[v]);
    }
  for (int axis = 0; axis < 3; ++axis) {
    assert_near(low[axis], min[axis]);
    assert_near(high[axis], max[axis]);
  }
}

inline void assert_box(const TriangleSoup& soup, double unit) {
  assert_int_equal(soup.triangles.size(), 12);
  assert_near(volume(soup), box_volume * unit * unit * unit);
  assert_bounds(soup, 0, 12, Vec3{1, 1, 1} * unit, Vec3{3, 4, 5} * unit);
}

inline void assert_valid(const TriangleSoup& soup) {
  assert_false(soup.triangles.empty());
  for (const Vec3& v : soup.vertices) assert_true(is_finite(v));
  for (const msq::Triangle& t : soup.triangles)
    for (const uint32_t v : t) assert_true(v < soup.vertices.size());
}

inline void assert_fails(const std::function<void()>& call, Status status,
                         const std::vector<std::string>& words) {
  try {
    call();
  } catch (const msq::Error& error) {
    if (error.status != status)
      fail_msg("status %d, not %d: %s", static_cast<int>(error.status), static_cast<int>(status),
               error.what());
    for (const std::string& word : words)
      if (!strstr(error.what(), word.c_str()))
        fail_msg("\"%s\" lacks \"%s\"", error.what(), word.c_str());
    return;
  }
  fail_msg("no error");
}

inline void assert_refused(const std::string& file, MeshFormat format, Status status,
                           const std::vector<std::string>& words) {
  assert_fails([&] { read(file, options_for(format)); }, status, words);
}

/// Reads a malformed file: any Error will do.
inline void read_anything(const std::string& content, MeshFormat format) {
  MeshFileOptions options = options_for(format);
  options.max_bytes = 1 << 24;
  options.max_triangles = 100000;
  // A copy of its own, so that reading past the end is seen.
  const std::vector<char> copy(content.begin(), content.end());
  try {
    assert_valid(msq::read_mesh_memory(copy.data(), copy.size(), options));
  } catch (const msq::Error& error) {
    assert_true(error.what()[0] != '\0');
    if (error.status == Status::internal) fail_msg("%s", error.what());
  }
}

struct Sample {
  const char* name;
  MeshFormat format;
  std::string content;
  double unit;  // of the first 12 triangles
};

inline const std::vector<Sample>& samples() {
  static const std::vector<Sample> all = {
#if MSQ_WITH_ASSIMP
    {"binary.STL", MeshFormat::stl, stl_binary(), 1},
    {"three.3mf", MeshFormat::threemf, threemf(), 25.4},
    {"zip64.3mf", MeshFormat::threemf, zip64_archive(threemf()), 25.4},
    {"box.amf", MeshFormat::amf, amf(), 25.4},
    {"zipped.amf", MeshFormat::amf, zip_archive({{"readme", "no"}, {"x.AMF", amf()}}), 25.4},
#endif
    {"ascii.stl", MeshFormat::stl, stl_ascii(), 1},
    {"box.obj", MeshFormat::obj, obj(), 1},
    {"ascii.ply", MeshFormat::ply, ply(PlyKind::ascii), 1},
    {"little.Ply", MeshFormat::ply, ply(PlyKind::little), 1},
    {"big.ply", MeshFormat::ply, ply(PlyKind::big), 1},
    {"box.off", MeshFormat::off, off(), 1},
  };
  return all;
}

}  // namespace mesh_file_fixtures
