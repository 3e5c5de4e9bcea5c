// SPDX-License-Identifier: Apache-2.0
// The mesh reader: its errors, files cut off at every byte, and files with random bytes changed.
#include <random>

#include "mesh_file_fixtures.h"

namespace {

using namespace mesh_file_fixtures;

void refuses_files_it_cannot_read(void**) {
  const std::string missing = folder().file("missing.stl");
  assert_fails([&] { msq::read_mesh_file(missing, {}); }, Status::io, {missing, strerror(ENOENT)});
  const std::string directory = folder().file("directory.stl");
  assert_int_equal(mkdir(directory.c_str(), 0700), 0);
  assert_fails([&] { msq::read_mesh_file(directory, {}); }, Status::io,
               {directory, strerror(EISDIR)});
  if (geteuid() != 0) {  // root reads everything
    const std::string secret = folder().write("secret.stl", stl_binary());
    chmod(secret.c_str(), 0);
    assert_fails([&] { msq::read_mesh_file(secret, {}); }, Status::io, {secret, strerror(EACCES)});
  }
  for (const char* name : {"part.step", "part", "stl", "part.stl.gz", "x.obj/part"})
    assert_fails([&] { msq::read_mesh_file(folder().file(name), {}); }, Status::unsupported,
                 {name, "stl, obj, ply, off, 3mf, amf, gltf, glb"});
  const std::string path = folder().write("broken.stl", "not a mesh");
  assert_fails([&] { msq::read_mesh_file(path, {}); }, Status::io, {path, "84", "10"});
}

void refuses_bad_arguments(void**) {
  const std::string file = obj();
  assert_fails([&] { read(file, {}); }, Status::argument, {"automatic"});
  assert_fails([&] { read(file, options_for(static_cast<MeshFormat>(8))); }, Status::argument,
               {"8", "7"});
  assert_fails([&] { msq::read_mesh_memory(nullptr, 5, options_for(MeshFormat::obj)); },
               Status::argument, {"NULL", "5"});
  for (const double unit : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    MeshFileOptions options = options_for(MeshFormat::obj);
    options.unit_mm = unit;
    assert_fails([&] { read(file, options); }, Status::argument, {"unit_mm"});
  }
}

void keeps_limits(void**) {
  for (const Sample& sample : samples()) {
    MeshFileOptions options = options_for(sample.format);
    options.max_bytes = sample.content.size() - 1;
    const std::string path = folder().write(sample.name, sample.content);
    for (const bool from_file : {false, true})
      assert_fails(
          [&] {
            if (from_file)
              msq::read_mesh_file(path, options);
            else
              read(sample.content, options);
          },
          Status::limit,
          {text("%zu bytes", sample.content.size()), text("is %zu", sample.content.size() - 1)});
    options = options_for(sample.format);
    const uint64_t triangles = sample.unit == 1 ? 12 : 36;
    options.max_triangles = triangles;
    assert_int_equal(read(sample.content, options).triangles.size(), triangles);
    options.max_triangles = 11;
    assert_fails([&] { read(sample.content, options); }, Status::limit,
                 {sample.unit == 1 ? "12" : " triangles", "11"});
  }
}

void refuses_bad_indices(void**) {
  const auto replaced = [](std::string file, const char* from, const std::string& to) {
    const size_t at = file.rfind(from);
    assert_true(at != std::string::npos);
    return file.replace(at, strlen(from), to);
  };
  for (const char* index : {"8", "99", "-1", "4000000000"})
    assert_refused(replaced(off(), "4 3 0 4 7", text("4 3 0 4 %s", index)), MeshFormat::off,
                   Status::mesh, {index, "8 vertices"});
  for (const char* index : {"8", "99", "-1", "4000000000"})
    assert_refused(replaced(ply(PlyKind::ascii), "4 3 0 4 7", text("4 3 0 4 %s", index)),
                   MeshFormat::ply, Status::mesh, {index, "8 vertices"});
  for (const char* index : {"9", "-9", "0", "4000000000"})
    assert_refused(obj() + "f 1 2 " + index + "\n", MeshFormat::obj, Status::mesh,
                   {index, "8 vertices"});
  std::string binary = ply(PlyKind::little);
  binary[binary.size() - 6] = 1;  // the last byte of the last index
  assert_refused(binary, MeshFormat::ply, Status::mesh, {"16777223", "8 vertices"});
  for (const char* index : {"9", "-1", "4000000000"}) {
    assert_refused(
        threemf("",
                "<object id=\"1\">" +
                    replaced(threemf_mesh(), "v3=\"8\"", text("v3=\"%s\"", index)) + "</object>",
                "<item objectid=\"1\"/>"),
        MeshFormat::threemf, Status::mesh, {index, "9 vertices"});
    assert_refused(replaced(amf(), "<v3>7</v3>", text("<v3>%s</v3>", index)), MeshFormat::amf,
                   Status::mesh, {index, "8 vertices"});
  }
}

void refuses_vertices_that_are_not_finite(void**) {
  for (const char* number : {"nan", "inf", "-inf"}) {
    assert_refused(text("v 0 0 0\nv 1 0 %s\nv 0 1 0\nf 1 2 3\n", number), MeshFormat::obj,
                   Status::mesh, {number});
    assert_refused(text("OFF 3 1 0\n0 0 0\n1 0 %s\n0 1 0\n3 0 1 2\n", number), MeshFormat::off,
                   Status::mesh, {"vertex 1", number});
  }
  std::string file = stl_binary();
  const float infinite = std::numeric_limits<float>::infinity();
  std::memcpy(file.data() + 84 + 50 + 12, &infinite, 4);
  assert_refused(file, MeshFormat::stl, Status::mesh, {"vertex 3", "inf"});
  assert_refused("OFF 3 1 0\n0 0 0\n1 0 1e999\n0 1 0\n3 0 1 2\n", MeshFormat::off, Status::mesh,
                 {"1e999"});
  MeshFileOptions options = options_for(MeshFormat::off);
  options.unit_mm = 1e10;
  assert_fails([&] { read("OFF 3 1 0\n0 0 0\n1 0 1e300\n0 1 0\n3 0 1 2\n", options); },
               Status::mesh, {"vertex 1", "inf"});
}

void refuses_files_without_triangles(void**) {
  const struct {
    MeshFormat format;
    std::string content;
  } empty[] = {
      {MeshFormat::stl, "solid a\nendsolid a\n"},
      {MeshFormat::stl, std::string(84, '\0')},
      {MeshFormat::obj, "v 0 0 0\nv 1 0 0\nl 1 2\nf 1 2\n"},
      {MeshFormat::off, "OFF 2 1 0\n0 0 0\n1 0 0\n2 0 1\n"},
      {MeshFormat::ply,
       "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
       "property float z\nend_header\n0 0 0\n"},
      {MeshFormat::threemf, threemf("", "<object id=\"1\">" + threemf_mesh() + "</object>", "")},
      {MeshFormat::amf, "<amf/>"}};
  for (const auto& file : empty)
    assert_refused(file.content, file.format, Status::mesh, {"no triangles"});
}

/// Of formats that are read, kinds of files that are not.
void refuses_other_kinds_of_files(void**) {
  const struct {
    MeshFormat format;
    std::string content;
    Status status;
    std::vector<std::string> words;
  } files[] = {{MeshFormat::off, "OFF BINARY\n", Status::unsupported, {"OFF", "binary"}},
               {MeshFormat::ply,
                "ply\nformat ascii 1.0\nelement face 1\nproperty list float int vertex_indices\n"
                "end_header\n3 0 1 2\n",
                Status::io,
                {"PLY", "count", "float"}},
               {MeshFormat::ply,
                "ply\nformat ascii 1.0\nelement tristrips 1\nproperty list int int vertex_indices\n"
                "end_header\n3 0 1 2\n",
                Status::unsupported,
                {"PLY", "triangle strips"}},
               {MeshFormat::amf, "<mesh/>", Status::io, {"AMF", "<mesh>"}},
               {MeshFormat::threemf,
                threemf("", "<object id=\"1\">" + threemf_mesh() + "</object>",
                        "<item objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 0 0 0 9\"/>"),
                Status::io,
                {"3MF", "more than 12"}}};
  for (const auto& file : files) assert_refused(file.content, file.format, file.status, file.words);
}

void refuses_truncated_stl(void**) {
  const std::string file = stl_binary();
  assert_refused(file.substr(0, 683), MeshFormat::stl, Status::io, {"684", "683"});
  std::string huge = file.substr(0, 84);
  std::memset(huge.data() + 80, 0xff, 4);
  assert_refused(huge, MeshFormat::stl, Status::io, {"214748364834", "84"});
  assert_box(read(file + "trailing", options_for(MeshFormat::stl)), 1);
}

void refuses_claims_that_do_not_fit(void**) {
  assert_refused("OFF\n4000000000 1 0\n0 0 0\n", MeshFormat::off, Status::io, {"4000000000"});
  assert_refused("OFF\n1 999999999999 0\n0 0 0\n", MeshFormat::off, Status::io, {"999999999999"});
  assert_refused("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4000000000 0 1 2\n", MeshFormat::off, Status::io,
                 {"ends"});
  const std::string head =
      "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\n"
      "property float y\nproperty float z\n";
  assert_refused(head + "end_header\n0123", MeshFormat::ply, Status::io, {"4000000000", "12"});
  assert_refused(head + "element face 9\nend_header\n", MeshFormat::ply, Status::io,
                 {"4000000000"});
  assert_refused("ply\nformat ascii 1.0\nelement nothing 4000000000\nend_header\n", MeshFormat::ply,
                 Status::io, {"nothing"});
  const std::string faces =
      "element vertex 1\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
      "property list int int vertex_indices\nend_header\n";
  assert_refused("ply\nformat ascii 1.0\n" + faces + "0 0 0\n-3 0 0 0\n", MeshFormat::ply,
                 Status::io, {"-3"});
  assert_refused("ply\nformat ascii 1.0\n" + faces + "0 0 0\n2000000000 0 0 0\n", MeshFormat::ply,
                 Status::io, {"2000000000"});
}

void refuses_archives_that_unpack_to_too_much(void**) {
  const std::string bomb = threemf("", std::string(3000000, ' '), "");
  assert_true(bomb.size() < 10000);
  MeshFileOptions options = options_for(MeshFormat::threemf);
  options.max_bytes = 2999999;
  assert_fails([&] { read(bomb, options); }, Status::limit, {"3000", "max_bytes is 2999999"});
  options.budget = std::make_shared<msq::MemoryBudget>(8 * 2500000);
  assert_fails([&] { read(bomb, options); }, Status::limit,
               {"3000", "the limit is 2500000", "memory_limit of 20000000"});
  options.budget = std::make_shared<msq::MemoryBudget>(8 * 2999999);
  assert_fails([&] { read(bomb, options); }, Status::limit, {"3000", "max_bytes is 2999999"});
  options.format = MeshFormat::amf;
  options.max_bytes = 1000000;
  assert_fails(
      [&] {
        read(zip_archive({{"a.amf", std::string(3000000, ' ')}}), options);
      },
      Status::limit, {"3000000", "1000000"});
  // Objects of two components each: 12 * 2^60 triangles.
  std::string objects = "<object id=\"0\">" + threemf_mesh() + "</object>";
  for (int i = 1; i <= 60; ++i)
    objects += text(
        "<object id=\"%d\"><components><component objectid=\"%d\"/>"
        "<component objectid=\"%d\"/></components></object>",
        i, i - 1, i - 1);
  assert_refused(threemf("", objects, "<item objectid=\"60\"/>"), MeshFormat::threemf,
                 Status::limit, {"200000000"});
  // The same of objects without triangles ends at once.
  objects.replace(0, objects.find("</object>"), "<object id=\"0\">");
  assert_refused(threemf("", objects, "<item objectid=\"60\"/>"), MeshFormat::threemf, Status::mesh,
                 {"no triangles"});
  assert_refused(threemf("",
                         "<object id=\"1\"><components><component objectid=\"2\"/></components>"
                         "</object><object id=\"2\"><components><component objectid=\"1\"/>"
                         "</components></object>",
                         "<item objectid=\"1\"/>"),
                 MeshFormat::threemf, Status::io, {"contains itself"});
  // Nested too deep, with the innermost first in the file and with the outermost first.
  for (const bool innermost_first : {true, false}) {
    std::string chain = "<amf>" + amf_object("0");
    for (int i = 1; i <= 200; ++i) {
      const int k = innermost_first ? i : 201 - i;
      chain += text("<constellation id=\"%03d\"><instance objectid=\"%03d\"/></constellation>",
                    k + 100, k == 1 ? 0 : k + 99);
    }
    chain.replace(chain.find("objectid=\"000\""), 14, "objectid=\"0\"");
    assert_refused(chain + "</amf>", MeshFormat::amf, Status::limit, {"100"});
  }
  assert_refused("<amf><constellation id=\"a\"><instance objectid=\"a\"/></constellation></amf>",
                 MeshFormat::amf, Status::io, {"contains itself"});
  // Entities stay as they are.
  assert_refused(
      "<!DOCTYPE amf [<!ENTITY a \"1\"><!ENTITY b SYSTEM \"/etc/passwd\">]>"
      "<amf unit=\"&b;\"></amf>",
      MeshFormat::amf, Status::io, {"&b;"});
}

// ---- malformed files at random

void survives_truncation(void**) {
  for (const Sample& sample : samples())
    for (size_t n = 0; n < sample.content.size(); ++n)
      read_anything(sample.content.substr(0, n), sample.format);
}

void survives_mutation(void**) {
  constexpr int rounds = 3000;
  std::mt19937_64 random(20240117);
  for (const Sample& sample : samples())
    for (int round = 0; round < rounds; ++round) {
      std::string content = sample.content;
      const int changes = 1 + static_cast<int>(random() % 4);
      for (int i = 0; i < changes; ++i) {
        char& byte = content[random() % content.size()];
        switch (random() % 3) {
          case 0:
            byte = static_cast<char>(byte ^ (1 << (random() % 8)));
            break;
          case 1:
            byte = static_cast<char>(random());
            break;
          default:
            byte = "0123456789-./ \n\\\"<>eE\xff"[random() % 22];
        }
      }
      read_anything(content, sample.format);
    }
  // The XML inside packages too, which the checksum would shield otherwise.
  const std::string model = threemf_model(
      "unit=\"inch\"",
      "<object id=\"1\">" + threemf_mesh() +
          "</object><object id=\"7\"><components><component objectid=\"1\" transform=\"1 0 0 0 1 0 "
          "0 0 1 100 0 0\"/></components></object>",
      "<item objectid=\"1\"/><item objectid=\"7\"/>");
  for (int round = 0; round < rounds; ++round) {
    std::string content = model;
    for (int i = 0; i < 2; ++i)
      content[random() % content.size()] = "0123456789-./ \n\\\"<>eE\xff"[random() % 22];
    read_anything(zip_archive({{"3D/3dmodel.model", content}}), MeshFormat::threemf);
  }
}

/// Whether minizip takes what ends archives for damage or, wrongly, for memory that failed.
void survives_damaged_ends_of_archives(void**) {
  std::mt19937_64 random(31);
  for (const std::string& archive : {threemf(), zip64_archive(threemf())})
    for (int round = 0; round < 4000; ++round) {
      std::string content = archive;
      for (uint64_t changes = 1 + random() % 3; changes > 0; --changes)
        content[content.size() - 1 - random() % 98] = "\x00\x01\xff\x7f\x05\x06PK"[random() % 8];
      if (round % 4 == 0) content.resize(content.size() - random() % 100);
      read_anything(content, MeshFormat::threemf);
    }
  assert_refused(threemf().substr(0, 100), MeshFormat::threemf, Status::io, {"not a zip archive"});
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(refuses_files_it_cannot_read),
      cmocka_unit_test(refuses_bad_arguments),
      cmocka_unit_test(keeps_limits),
      cmocka_unit_test(refuses_bad_indices),
      cmocka_unit_test(refuses_vertices_that_are_not_finite),
      cmocka_unit_test(refuses_files_without_triangles),
      cmocka_unit_test(refuses_other_kinds_of_files),
      cmocka_unit_test(refuses_truncated_stl),
      cmocka_unit_test(refuses_claims_that_do_not_fit),
      cmocka_unit_test(refuses_archives_that_unpack_to_too_much),
      cmocka_unit_test(survives_truncation),
      cmocka_unit_test(survives_mutation),
      cmocka_unit_test(survives_damaged_ends_of_archives),
  };
  return cmocka_run_group_tests_name("mesh_file_errors", tests, nullptr, nullptr);
}
