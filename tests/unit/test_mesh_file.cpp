// SPDX-License-Identifier: Apache-2.0
// The mesh reader: every format from file and memory.
#include <assimp/IOStream.hpp>

#include "io/memory_io_system.h"
#include "mesh_file_fixtures.h"

namespace {

using namespace mesh_file_fixtures;

void reads_every_format(void**) {
  for (const Sample& sample : samples()) {
    const std::string path = folder().write(sample.name, sample.content);
    for (const TriangleSoup& soup :
         {msq::read_mesh_file(path, {}), msq::read_mesh_file(path, options_for(sample.format)),
          read(sample.content, options_for(sample.format))}) {
      assert_valid(soup);
      assert_true(soup.triangles.size() % 12 == 0);
      for (size_t i = 0; i < soup.triangles.size(); i += 12) assert_true(volume(soup, i, 12) > 0);
      if (sample.unit == 1) assert_box(soup, 1);
      assert_near(volume(soup, 0, 12), box_volume * std::pow(sample.unit, 3));
    }
  }
}

void applies_unit_mm(void**) {
  for (const Sample& sample : samples()) {
    MeshFileOptions options = options_for(sample.format);
    options.unit_mm = 10;
    const TriangleSoup soup = read(sample.content, options);
    assert_near(volume(soup, 0, 12), box_volume * std::pow(sample.unit == 1 ? 10 : 25.4, 3));
  }
}

void places_3mf_instances(void**) {
  const TriangleSoup soup = read(threemf(), options_for(MeshFormat::threemf));
  constexpr double inch = 25.4;
  assert_int_equal(soup.triangles.size(), 36);
  assert_int_equal(soup.vertices.size(), 24);  // the one that no triangle uses is gone
  assert_bounds(soup, 0, 12, Vec3{1, 1, 1} * inch, Vec3{3, 4, 5} * inch);
  // (x + 100, y, z), then (x, y, z) -> (-2y, 2x, 2z + 1000)
  assert_near(volume(soup, 12, 12), 8 * box_volume * inch * inch * inch);
  assert_bounds(soup, 12, 12, Vec3{-8, 202, 1002} * inch, Vec3{-2, 206, 1010} * inch);
  // (-x, y + 100, z), then the same
  assert_near(volume(soup, 24, 12), 8 * box_volume * inch * inch * inch);
  assert_bounds(soup, 24, 12, Vec3{-208, -6, 1002} * inch, Vec3{-202, -2, 1010} * inch);
}

void reads_3mf_units_parts_and_extensions(void**) {
  const std::string object = "<object id=\"1\">" + threemf_mesh() + "</object>";
  const std::string item = "<item objectid=\"1\"/>";
  const struct {
    const char* attributes;
    double unit;
  } units[] = {{"", 1},
               {"unit=\"micron\"", 0.001},
               {"unit=\"millimeter\"", 1},
               {"unit=\"centimeter\"", 10},
               {"unit=\"foot\"", 304.8},
               {"unit=\"meter\"", 1000}};
  for (const auto& known : units)
    assert_box(read(threemf(known.attributes, object, item), options_for(MeshFormat::threemf)),
               known.unit);
  assert_refused(threemf("unit=\"parsec\"", object, item), MeshFormat::threemf, Status::io,
                 {"parsec"});
  // The model where the package's relationships say; an object in another part.
  const std::string main_part = threemf_model(
      "requiredextensions=\"p\" "
      "xmlns:p=\"http://schemas.microsoft.com/3dmanufacturing/production/2015/06\"",
      "<object id=\"2\"><components><component p:path=\"/3D/Objects/o.model\" objectid=\"1\"/>"
      "</components></object>",
      "<item objectid=\"2\"/>");
  assert_box(read(zip_archive({{"_rels/.rels", relationships},
                               {"3D/other.model", main_part},
                               {"3D/Objects/o.model", threemf_model("", object, "")}}),
                  options_for(MeshFormat::threemf)),
             1);
  assert_refused(
      threemf("requiredextensions=\"b\" xmlns:b=\"http://example.org/beams\"", object, item),
      MeshFormat::threemf, Status::unsupported, {"\"b\"", "http://example.org/beams"});
}

void places_amf_instances(void**) {
  const TriangleSoup soup = read(amf(), options_for(MeshFormat::amf));
  constexpr double inch = 25.4;
  assert_int_equal(soup.triangles.size(), 36);
  assert_bounds(soup, 0, 12, Vec3{1, 1, 1} * inch, Vec3{3, 4, 5} * inch);
  assert_bounds(soup, 12, 12, Vec3{96, 1, 1} * inch, Vec3{99, 3, 5} * inch);
  assert_bounds(soup, 24, 12, Vec3{1, 1, -49} * inch, Vec3{3, 4, -45} * inch);
  const struct {
    const char* attributes;
    double unit;
  } units[] = {{"", 1},
               {"unit=\"millimeter\"", 1},
               {"unit=\"feet\"", 304.8},
               {"unit=\"foot\"", 304.8},
               {"unit=\"meter\"", 1000},
               {"unit=\"micron\"", 0.001},
               {"unit=\"micrometer\"", 0.001}};
  for (const auto& known : units)
    assert_box(read(std::string("<amf ") + known.attributes + ">" + amf_object("0") + "</amf>",
                    options_for(MeshFormat::amf)),
               known.unit);
  assert_refused("<amf unit=\"league\">" + amf_object("0") + "</amf>", MeshFormat::amf, Status::io,
                 {"league"});
}

void triangulates_concave_polygons(void**) {
  // A prism over a U of 10 corners, area 7, height 1; OBJ and OFF.
  constexpr int u[8][2] = {{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}};
  std::string off = "OFF\n16 10 0\n", obj, bottom, top, sides_of_off, sides_of_obj;
  for (int z = 0; z < 2; ++z)
    for (const auto& p : u) {
      off += text("%d %d %d\n", p[0], p[1], z);
      obj += text("v %d %d %d\n", p[0], p[1], z);
    }
  off += "8 7 6 5 4 3 2 1 0\n8 8 9 10 11 12 13 14 15\n";
  obj += "f 8 7 6 5 4 3 2 1\nf 9 10 11 12 13 14 15 16\n";
  for (int i = 0; i < 8; ++i) {
    const int j = (i + 1) % 8;
    off += text("4 %d %d %d %d\n", i, j, j + 8, i + 8);
    obj += text("f %d %d %d %d\n", i + 1, j + 1, j + 9, i + 9);
  }
  for (const TriangleSoup& soup :
       {read(off, options_for(MeshFormat::off)), read(obj, options_for(MeshFormat::obj))}) {
    assert_int_equal(soup.triangles.size(), 28);
    assert_near(volume(soup), 7);
    double area = 0;
    for (const msq::Triangle& t : soup.triangles) {
      const Vec3 a = soup.vertices[t[0]];
      area += length(cross(soup.vertices[t[1]] - a, soup.vertices[t[2]] - a)) / 2;
    }
    assert_near(area, 2 * 7 + 16);  // more if triangles left the polygon
  }
}

void reads_what_assimp_reads_wrong(void**) {
  // Numbers that begin with a point, colours, weights, and signs and zeros before indices.
  const TriangleSoup soup =
      read("v .5 -.5 +.25\nv 1 0 0 1 1 1 1\nv 0 1 0 9 9\n\tf +1 002 3\nf 1 3 2 # back\n",
           options_for(MeshFormat::obj));
  assert_int_equal(soup.triangles.size(), 2);
  assert_bounds(soup, 0, 2, {0, -0.5, 0}, {1, 1, 0.25});
  // Homogeneous coordinates.
  const std::string tetrahedron =
      "4 4 0\n0 0 0 1\n4 0 0 2\n0 2 0 1\n0 0 2 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
  for (const char* keyword : {"4OFF\n", "C4OFF ", "4OFF"})
    assert_bounds(read(keyword + tetrahedron, options_for(MeshFormat::off)), 0, 4, {0, 0, 0},
                  {2, 2, 2});
  assert_refused("4nOFF\n3\n" + tetrahedron, MeshFormat::off, Status::unsupported,
                 {"\"4nOFF\"", "three dimensions"});
  // OFF polygons of more than nine vertices.
  assert_int_equal(read("OFF 10 1 0\n0 0 0\n1 0 0\n2 1 0\n2 2 0\n2 3 0\n1 4 0\n0 4 0\n-1 3 0\n"
                        "-1 2 0\n-1 1 0\n10 0 1 2 3 4 5 6 7 8 9\n",
                        options_for(MeshFormat::off))
                       .triangles.size(),
                   8);
  // Binary PLY data that begins with a line feed, after either kind of line end; doubles.
  for (const char* line_end : {"\n", "\r\n"}) {
    std::string file;
    for (const char* line :
         {"ply", "format binary_little_endian 1.0", "element vertex 3", "property double x",
          "property double y", "property double z", "element face 1",
          "property list uchar uint vertex_index", "end_header"})
      file += std::string(line) + line_end;
    uint64_t bits = 0x3ff000000000000a;  // just over 1
    double first;
    std::memcpy(&first, &bits, sizeof first);
    for (const double x : {first, 2.0, 3.0, 4.0, 5.0, 1.0 / 3, 0.0, 0.0, 0.0}) put(file, x);
    put(file, uint8_t{3});
    for (const uint32_t index : {0u, 1u, 2u}) put(file, index);
    const TriangleSoup read_back = read(file, options_for(MeshFormat::ply));
    assert_true(read_back.vertices[0].x == first);
    assert_true(read_back.vertices[1].z == 1.0 / 3);
  }
  // Upper-case ASCII STL with a byte order mark and more than one solid.
  std::string upper = stl_ascii();
  for (char& c : upper) c = static_cast<char>(c >= 'a' && c <= 'z' ? c - 32 : c);
  assert_int_equal(
      read("\xef\xbb\xbf" + upper + stl_ascii(), options_for(MeshFormat::stl)).triangles.size(),
      24);
}

void reads_long_binary_stl(void**) {
  // More than Assimp is shown at once, with trailing bytes.
  constexpr uint32_t facets = 50001;
  std::string file(80, 'C');
  put(file, facets);
  float next = 0.1f;
  for (uint32_t i = 0; i < facets; ++i) {
    for (int k = 0; k < 12; ++k) put(file, next = next * 1.0001f + (k < 3 ? 0 : 1));
    put(file, static_cast<uint16_t>(0xffff - i));
    if (next > 1e30f) next = -0.3f;
  }
  const TriangleSoup soup = read(file + "the end", options_for(MeshFormat::stl));
  assert_int_equal(soup.triangles.size(), facets);
  for (uint32_t i = 0; i < facets; ++i)
    for (uint32_t corner = 0; corner < 3; ++corner)
      for (uint32_t axis = 0; axis < 3; ++axis) {
        float expected;
        std::memcpy(&expected, file.data() + 84 + 50 * i + 12 * (corner + 1) + 4 * axis, 4);
        const Vec3& p = soup.vertices[soup.triangles[i][corner]];
        assert_true(p[static_cast<int>(axis)] == static_cast<double>(expected));
      }
}

void opens_no_other_file(void**) {
  // Opening a pipe would block for ever.
  const std::string pipe = folder().file("pipe.mtl");
  assert_int_equal(mkfifo(pipe.c_str(), 0600), 0);
  const std::string path =
      folder().write("with_lib.obj", "mtllib pipe.mtl\nmtllib " + pipe + "\n" + obj());
  folder().write("with_lib.mtl", "newmtl none\n");
  assert_box(msq::read_mesh_file(path, {}), 1);
  assert_fails([&] { msq::read_mesh_file(pipe, options_for(MeshFormat::obj)); }, Status::io,
               {pipe, "not a regular file"});
}

void shows_assimp_one_file_alone(void**) {
  const std::string other = folder().write("other.mtl", "newmtl none\n");
  msq::MemoryIoSystem system("mesh.obj", "0123456789");
  assert_true(system.Exists("mesh.obj"));
  for (const char* path : {other.c_str(), "/etc/passwd", "./mesh.obj", "mesh.mtl", ""}) {
    assert_false(system.Exists(path));
    assert_null(system.Open(path, "rb"));
  }
  assert_null(system.Open("mesh.obj", "wb"));
  const std::string folder_of_its_own = folder().file("made");
  assert_false(system.CreateDirectory(folder_of_its_own));
  assert_int_equal(access(folder_of_its_own.c_str(), F_OK), -1);
  assert_false(system.DeleteFile(other));
  assert_int_equal(access(other.c_str(), F_OK), 0);

  Assimp::IOStream* stream = system.Open("mesh.obj", "rb");
  assert_non_null(stream);
  char block[4] = {};
  assert_int_equal(stream->Read(block, 1, 4), 4);
  assert_memory_equal(block, "0123", 4);
  assert_int_equal(stream->Seek(8, aiOrigin_SET), aiReturn_SUCCESS);
  assert_int_equal(stream->Read(block, 1, 4), 2);
  assert_memory_equal(block, "89", 2);
  assert_int_equal(stream->Seek(11, aiOrigin_SET), aiReturn_FAILURE);
  assert_int_equal(stream->Tell(), 10);
  system.Close(stream);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(reads_every_format),
      cmocka_unit_test(applies_unit_mm),
      cmocka_unit_test(places_3mf_instances),
      cmocka_unit_test(reads_3mf_units_parts_and_extensions),
      cmocka_unit_test(places_amf_instances),
      cmocka_unit_test(triangulates_concave_polygons),
      cmocka_unit_test(reads_what_assimp_reads_wrong),
      cmocka_unit_test(reads_long_binary_stl),
      cmocka_unit_test(opens_no_other_file),
      cmocka_unit_test(shows_assimp_one_file_alone),
  };
  return cmocka_run_group_tests_name("mesh_file", tests, nullptr, nullptr);
}
