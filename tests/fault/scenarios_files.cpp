// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "scenarios.h"
#include "world.h"

namespace msq::test {

#if MSQ_WITH_ASSIMP

namespace {

template <class T>
void put(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

uint32_t crc32(const std::string& bytes) {
  uint32_t crc = ~0u;
  for (const char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0);
  }
  return ~crc;
}

/// An archive of one file that is not compressed.
std::string zip(const std::string& name, const std::string& file) {
  const auto header = [&](std::string& out) {
    put(out, uint16_t{20});
    put(out, uint64_t{0});  // flags, method, time, date
    put(out, crc32(file));
    put(out, static_cast<uint32_t>(file.size()));
    put(out, static_cast<uint32_t>(file.size()));
    put(out, static_cast<uint16_t>(name.size()));
    put(out, uint16_t{0});
  };
  std::string out = "PK\3\4";
  header(out);
  out += name + file;
  const size_t directory = out.size();
  out += "PK\1\2";
  put(out, uint16_t{20});
  header(out);
  put(out, uint32_t{0});  // comment, disk
  put(out, uint16_t{0});
  put(out, uint32_t{0});
  put(out, uint32_t{0});  // where the file begins
  out += name;
  const size_t end = out.size();
  out += "PK\5\6";
  put(out, uint32_t{0});
  put(out, uint16_t{1});
  put(out, uint16_t{1});
  put(out, static_cast<uint32_t>(end - directory));
  put(out, static_cast<uint32_t>(directory));
  put(out, uint16_t{0});
  return out;
}

// A tetrahedron in every format.
constexpr const char* stl =
    "solid t\nfacet normal 0 0 -1\nouter loop\nvertex 0 0 0\nvertex 0 4 0\nvertex 4 0 0\nendloop\n"
    "endfacet\nfacet normal 0 -1 0\nouter loop\nvertex 0 0 0\nvertex 4 0 0\nvertex 0 0 4\nendloop\n"
    "endfacet\nfacet normal 1 1 1\nouter loop\nvertex 4 0 0\nvertex 0 4 0\nvertex 0 0 4\nendloop\n"
    "endfacet\nfacet normal -1 0 0\nouter loop\nvertex 0 0 0\nvertex 0 0 4\nvertex 0 4 0\nendloop\n"
    "endfacet\nendsolid t\n";
constexpr const char* obj =
    "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 0 0 4\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
constexpr const char* ply =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
    "z\n"
    "element face 4\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n4 0 0\n0 4 0\n0 0 "
    "4\n"
    "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
constexpr const char* off =
    "OFF\n4 4 0\n0 0 0\n4 0 0\n0 4 0\n0 0 4\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
constexpr const char* amf =
    "<?xml version=\"1.0\"?><amf unit=\"millimeter\"><object id=\"1\"><mesh><vertices>"
    "<vertex><coordinates><x>0</x><y>0</y><z>0</z></coordinates></vertex>"
    "<vertex><coordinates><x>4</x><y>0</y><z>0</z></coordinates></vertex>"
    "<vertex><coordinates><x>0</x><y>4</y><z>0</z></coordinates></vertex>"
    "<vertex><coordinates><x>0</x><y>0</y><z>4</z></coordinates></vertex></vertices><volume>"
    "<triangle><v1>0</v1><v2>2</v2><v3>1</v3></triangle>"
    "<triangle><v1>0</v1><v2>1</v2><v3>3</v3></triangle>"
    "<triangle><v1>1</v1><v2>2</v2><v3>3</v3></triangle>"
    "<triangle><v1>0</v1><v2>3</v2><v3>2</v3></triangle></volume></mesh></object></amf>";
constexpr const char* threemf_model =
    "<?xml version=\"1.0\"?><model unit=\"millimeter\" "
    "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\"><resources>"
    "<object id=\"1\" type=\"model\"><mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/>"
    "<vertex x=\"4\" y=\"0\" z=\"0\"/><vertex x=\"0\" y=\"4\" z=\"0\"/>"
    "<vertex x=\"0\" y=\"0\" z=\"4\"/></vertices><triangles>"
    "<triangle v1=\"0\" v2=\"2\" v3=\"1\"/><triangle v1=\"0\" v2=\"1\" v3=\"3\"/>"
    "<triangle v1=\"1\" v2=\"2\" v3=\"3\"/><triangle v1=\"0\" v2=\"3\" "
    "v3=\"2\"/></triangles></mesh>"
    "</object></resources><build><item objectid=\"1\"/></build></model>";

constexpr const char* beams_model =
    "<?xml version=\"1.0\"?><model unit=\"millimeter\" requiredextensions=\"b\" "
    "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\" "
    "xmlns:b=\"http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02\"><resources>"
    "<object id=\"1\"><mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/>"
    "<vertex x=\"4\" y=\"0\" z=\"0\"/><vertex x=\"0\" y=\"4\" z=\"0\"/>"
    "<vertex x=\"0\" y=\"0\" z=\"4\"/></vertices><triangles>"
    "<triangle v1=\"0\" v2=\"2\" v3=\"1\"/><triangle v1=\"0\" v2=\"1\" v3=\"3\"/>"
    "<triangle v1=\"1\" v2=\"2\" v3=\"3\"/><triangle v1=\"0\" v2=\"3\" "
    "v3=\"2\"/></triangles></mesh></object>"
    "<object id=\"2\"><mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/>"
    "<vertex x=\"4\" y=\"0\" z=\"0\"/></vertices><b:beamlattice minlength=\"0.1\" radius=\"1\" "
    "clippingmode=\"inside\" clippingmesh=\"1\"><b:beams><b:beam v1=\"0\" v2=\"1\"/></b:beams>"
    "</b:beamlattice></mesh></object></resources><build><item objectid=\"1\"/>"
    "<item objectid=\"2\"/></build></model>";

#if MSQ_WITH_JSON
constexpr const char* gltf =
    "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}],"
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5121,\"count\":4,\"type\":\"VEC3\"},"
    "{\"bufferView\":0,\"byteOffset\":12,\"componentType\":5121,\"count\":12,\"type\":"
    "\"SCALAR\"}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":24}],\"buffers\":[{\"uri\":"
    "\"data:;base64,AAAABAAAAAQAAAAEAAIBAAEDAQIDAAMC\",\"byteLength\":24}]}";
#endif

std::string binary_stl() {
  const float corners[4][3] = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}};
  const int triangles[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  std::string out(80, ' ');
  put(out, uint32_t{4});
  for (const auto& triangle : triangles) {
    for (int i = 0; i < 3; ++i) put(out, 0.0f);  // the normal
    for (const int corner : triangle)
      for (const float x : corners[corner]) put(out, x);
    put(out, uint16_t{0});
  }
  return out;
}

struct Format {
  const char* name;
  int32_t format;
  std::string bytes;
  bool is_assimp;
};

const std::vector<Format>& formats() {
  static const std::vector<Format> all = {
    {"STL", MSQ_FORMAT_STL, stl, false},
    {"binary STL", MSQ_FORMAT_STL, binary_stl(), true},
    {"OBJ", MSQ_FORMAT_OBJ, obj, false},
    {"PLY", MSQ_FORMAT_PLY, ply, false},
    {"OFF", MSQ_FORMAT_OFF, off, false},
    {"AMF", MSQ_FORMAT_AMF, amf, false},
#if MSQ_WITH_JSON
    {"glTF", MSQ_FORMAT_GLTF, gltf, false},
#endif
    {"3MF", MSQ_FORMAT_3MF, zip("3D/3dmodel.model", threemf_model), false}
  };
  return all;
}

void finish_shape(msq_shape* shape, std::vector<double>& probe) {
  msq_shape_report report = {};
  report.struct_size = sizeof report;
  require_ok(msq_shape_info(shape, &report));
  probe[0] = report.volume;
  probe[1] = static_cast<double>(report.triangles);
  msq_shape_release(shape);
}

void set_limits(Stage& stage, const Format& format) {
  stage.needs_stack = stage.allows_leaks = stage.allows_io = format.is_assimp;
}

void finish_beams(msq_beam_file* file, std::vector<double>& probe) {
  msq_beam_file_report report{};
  report.struct_size = sizeof report;
  require_ok(msq_beam_file_info(file, 0, &report));
  msq_beams_def def = make_def(msq_beams_def_init);
  require_ok(msq_beam_file_beams(file, 0, &def));
  probe[0] = static_cast<double>(report.beam_count + 10 * report.mesh_triangle_count);
  probe[1] = static_cast<const double*>(def.radii)[1];
  msq_beam_file_retain(file);
  msq_beam_file_release(file);
  msq_beam_file_release(file);
}

void add_beam_files(std::vector<Scenario>& scenarios) {
  static const std::string bytes = zip("3D/3dmodel.model", beams_model);
  for (const bool from_file : {false, true})
    scenarios.push_back(
        {from_file ? "msq_beam_file_open" : "msq_beam_file_open_memory", [from_file](Stage& stage) {
           World world(stage);
           char path[] = "/tmp/msq_fault_XXXXXX";
           const int descriptor = mkstemp(path);
           require(descriptor >= 0, "no file can be made");
           const bool is_written =
               write(descriptor, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size());
           close(descriptor);
           msq_file_def def = make_def(msq_file_def_init);
           def.format = MSQ_FORMAT_3MF;
           msq_beam_file* file;
           std::vector<double> probe(2);
           stage.watch_handle(file);
           stage.watch_probe(probe);
           try {
             require(is_written, "the file cannot be written");
             stage.call(
                 [&] {
                   return from_file ? msq_beam_file_open(world.context, path, &def, &file, nullptr)
                                    : msq_beam_file_open_memory(world.context, bytes.data(),
                                                                bytes.size(), &def, &file, nullptr);
                 },
                 [&] { finish_beams(file, probe); });
           } catch (...) {
             unlink(path);
             throw;
           }
           unlink(path);
         }});
  scenarios.push_back({"msq_beam_file_shape", [](Stage& stage) {
                         World world(stage);
                         msq_file_def def = make_def(msq_file_def_init);
                         def.format = MSQ_FORMAT_3MF;
                         msq_beam_file* file;
                         require_ok(msq_beam_file_open_memory(world.context, bytes.data(),
                                                              bytes.size(), &def, &file, nullptr));
                         msq_shape* shape;
                         std::vector<double> probe(2);
                         stage.watch_handle(shape);
                         stage.watch_probe(probe);
                         stage.call(
                             [&] {
                               return msq_beam_file_shape(world.context, file, 0,
                                                          MSQ_BEAM_FILE_CLIPPING, MSQ_WINDING_AUTO,
                                                          &shape);
                             },
                             [&] { finish_shape(shape, probe); });
                         msq_beam_file_release(file);
                       }});
}

}  // namespace

std::vector<Scenario> file_scenarios() {
  std::vector<Scenario> scenarios;
  add_beam_files(scenarios);
  for (const Format& format : formats()) {
    scenarios.push_back(
        {std::string("msq_shape_from_memory: ") + format.name, [&format](Stage& stage) {
           set_limits(stage, format);
           World world(stage);
           msq_file_def def = make_def(msq_file_def_init);
           def.format = format.format;
           msq_shape* shape;
           std::vector<double> probe(2);
           stage.watch_handle(shape);
           stage.watch_probe(probe);
           stage.call(
               [&] {
                 return msq_shape_from_memory(world.context, format.bytes.data(),
                                              format.bytes.size(), &def, &shape, nullptr);
               },
               [&] { finish_shape(shape, probe); });
         }});
    scenarios.push_back(
        {std::string("msq_shape_from_file: ") + format.name, [&format](Stage& stage) {
           set_limits(stage, format);
           World world(stage);
           char path[] = "/tmp/msq_fault_XXXXXX";
           const int file = mkstemp(path);
           require(file >= 0, "no file can be made");
           const bool is_written = write(file, format.bytes.data(), format.bytes.size()) ==
                                   static_cast<ssize_t>(format.bytes.size());
           close(file);
           msq_file_def def = make_def(msq_file_def_init);
           def.format = format.format;
           msq_shape* shape;
           std::vector<double> probe(2);
           stage.watch_handle(shape);
           stage.watch_probe(probe);
           try {
             require(is_written, "the file cannot be written");
             stage.call(
                 [&] { return msq_shape_from_file(world.context, path, &def, &shape, nullptr); },
                 [&] { finish_shape(shape, probe); });
           } catch (...) {
             unlink(path);
             throw;
           }
           unlink(path);
         }});
  }
  return scenarios;
}

#else

std::vector<Scenario> file_scenarios() {
  return {};
}

#endif

}  // namespace msq::test
