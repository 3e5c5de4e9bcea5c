// SPDX-License-Identifier: Apache-2.0
// Beam lattices of 3MF files: what is read, what is refused, and files with random bytes changed.
#include <cstring>
#include <random>

#include "mesh_file_fixtures.h"

namespace {

using namespace mesh_file_fixtures;
using msq::BeamFile;
using msq::BeamLattice;

constexpr const char* beam_names =
    "requiredextensions=\"b b2\" "
    "xmlns:b=\"http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02\" "
    "xmlns:b2=\"http://schemas.microsoft.com/3dmanufacturing/beamlattice/balls/2020/07\"";

constexpr const char* vertices =
    "<vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"4\" y=\"0\" z=\"0\"/>"
    "<vertex x=\"4\" y=\"3\" z=\"0\"/><vertex x=\"4\" y=\"3\" z=\"0.125\"/></vertices>";

/// A mesh without triangles, and beams along its vertices.
std::string lattice(const std::string& attributes, const std::string& beams,
                    const std::string& rest = "") {
  return std::string("<mesh>") + vertices + "<b:beamlattice " + attributes + "><b:beams>" + beams +
         "</b:beams>" + rest + "</b:beamlattice></mesh>";
}

constexpr const char* plain = "radius=\"0.5\" minlength=\"0.25\"";
constexpr const char* path = "<b:beam v1=\"0\" v2=\"1\"/><b:beam v1=\"1\" v2=\"2\"/>";

std::string model(const std::string& mesh, const std::string& item = "<item objectid=\"1\"/>",
                  const std::string& others = "") {
  return threemf_model(beam_names, others + "<object id=\"1\">" + mesh + "</object>", item);
}

std::string file_of(const std::string& text) {
  return zip_archive({{"3D/3dmodel.model", text}});
}

BeamFile read_beams(const std::string& text, MeshFileOptions options) {
  options.format = MeshFormat::threemf;
  const std::string file = file_of(text);
  return msq::read_beam_memory(file.data(), file.size(), options);
}

BeamFile read_beams(const std::string& text) {
  return read_beams(text, {});
}

void refuses(const std::string& text, Status status, const std::vector<std::string>& words) {
  assert_fails([&] { read_beams(text); }, status, words);
}

/// Also where the file does not say that beams are required: its triangles are not the part.
void meshes_with_beams_are_no_triangles(void**) {
  for (const char* names : {beam_names, beam_names + std::strlen("requiredextensions=\"b b2\" ")}) {
    const std::string text = threemf_model(
        names, "<object id=\"1\">" + lattice(plain, path) + "</object>", "<item objectid=\"1\"/>");
    assert_refused(file_of(text), MeshFormat::threemf, Status::unsupported,
                   {"beam lattices", "msq_beam_file_open"});
    assert_int_equal(read_beams(text).lattices[0].beams.size(), 2);
  }
}

void radii_and_caps_have_defaults(void**) {
  const BeamFile file = read_beams(
      model(lattice(std::string(plain) + " cap=\"hemisphere\"",
                    "<b:beam v1=\"0\" v2=\"1\"/><b:beam v1=\"1\" v2=\"2\" r1=\"0.25\"/>"
                    "<b:beam v1=\"0\" v2=\"2\" r1=\"0\" r2=\"2e-1\" cap2=\"butt\" p1=\"3\"/>"
                    "<b:beam v1=\"2\" v2=\"3\"/>"  // shorter than minlength
                    "<b:other/>")));
  assert_int_equal(file.lattices.size(), 1);
  assert_true(file.mesh.triangles.empty());
  const BeamLattice& found = file.lattices[0];
  assert_int_equal(found.beams.size(), 3);
  assert_int_equal(found.nodes.size(), 3);  // the last was used by the short beam alone
  const double radii[3][2] = {{0.5, 0.5}, {0.25, 0.25}, {0, 0.2}};
  for (size_t i = 0; i < 3; ++i)
    for (size_t end : {0, 1}) {
      assert_true(found.radii[i][end] == radii[i][end]);
      assert_int_equal(found.caps[i][end], i == 2 && end == 1 ? 2 : 1);
    }
}

void names_of_drafts_are_read(void**) {
  const BeamFile file = read_beams(model(
      lattice("radius=\"0.5\" precision=\"3.5\" clipping=\"inside\" clippingmesh=\"5\"", path),
      "<item objectid=\"1\"/>", "<object id=\"5\">" + threemf_mesh() + "</object>"));
  assert_int_equal(file.lattices[0].beams.size(), 1);
  assert_true(file.lattices[0].clipping == msq::Clipping::inside);
}

void balls_have_three_modes(void**) {
  const std::string balls =
      "<b2:balls><b2:ball vindex=\"3\"/><b2:ball vindex=\"1\" r=\"0.75\"/></b2:balls>";
  for (const char* mode : {"none", "mixed", "all"}) {
    const BeamFile file = read_beams(
        model(lattice(std::string(plain) + " b2:ballradius=\"0.625\" b2:ballmode=\"" + mode + "\"",
                      path, balls)));
    const BeamLattice& found = file.lattices[0];
    const size_t count = mode[0] == 'n' ? 0 : mode[0] == 'm' ? 2 : 4;
    assert_int_equal(found.balls.size(), count);
    for (size_t i = 0; i < count; ++i) assert_true(found.ball_radii[i] == (i == 1 ? 0.75 : 0.625));
  }
}

void instances_are_placed(void**) {
  // Unclipped lattices are one; each clipped one is its own.
  const std::string clip = "<object id=\"5\">" + threemf_mesh() + "</object>";
  const std::string both =
      "<item objectid=\"1\" transform=\"3 0 0 0 -3 0 0 0 3 10 0 0\"/><item objectid=\"1\"/>"
      "<item objectid=\"5\"/>";
  BeamFile file = read_beams(model(lattice(plain, path), both, clip));
  assert_int_equal(file.lattices.size(), 1);
  assert_int_equal(file.lattices[0].beams.size(), 4);
  assert_int_equal(file.lattices[0].nodes.size(), 6);
  assert_near(file.lattices[0].nodes[2].y, -9);
  assert_near(file.lattices[0].radii[0][0], 1.5);
  assert_true(file.lattices[0].radii[2][0] == 0.5);
  assert_int_equal(file.mesh.triangles.size(), 12);
  file = read_beams(
      model(lattice(std::string(plain) + " clippingmode=\"outside\" clippingmesh=\"5\"", path),
            both, clip));
  assert_int_equal(file.lattices.size(), 2);
  assert_int_equal(static_cast<int>(file.lattices[1].clipping), 2);
  assert_near(volume(file.lattices[0].clip), 27 * box_volume);
  assert_near(volume(file.lattices[1].clip), box_volume);
}

void refuses_what_it_cannot_keep(void**) {
  refuses(model(lattice("radius=\"1\"", path)), Status::io, {"minlength"});
  refuses(model(lattice("minlength=\"1\"", path)), Status::io, {"radius"});
  refuses(model(lattice(std::string(plain) + " cap=\"round\"", path)), Status::unsupported,
          {"cap", "round", "butt"});
  refuses(model(lattice(std::string(plain) + " clippingmode=\"across\"", path)),
          Status::unsupported, {"clippingmode", "across"});
  refuses(model(lattice(std::string(plain) + " clippingmode=\"inside\"", path)), Status::io,
          {"clippingmesh"});
  const std::string clipped =
      lattice(std::string(plain) + " clippingmode=\"inside\" clippingmesh=\"5\"", path);
  refuses(model(clipped), Status::io, {"id 5", "clippingmesh"});
  refuses(model(clipped, "<item objectid=\"1\"/>", "<object id=\"5\"/>"), Status::mesh,
          {"object 5", "no triangles"});
  refuses(model(clipped, "<item objectid=\"1\"/>",
                "<object id=\"5\"><components><component objectid=\"6\"/></components></object>"
                "<object id=\"6\">" +
                    threemf_mesh() + "</object>"),
          Status::unsupported, {"object 5", "components"});
  refuses(model(lattice(std::string(plain) + " clippingmode=\"inside\" clippingmesh=\"1\"", path)),
          Status::unsupported, {"object 1", "beam lattice"});
  refuses(model(lattice(std::string(plain) + " b2:ballmode=\"all\"", path)), Status::io,
          {"ballradius"});
  refuses(model(lattice(plain, "<b:beam v1=\"0\" v2=\"4\"/>")), Status::mesh, {"beam 0", "4"});
  refuses(model(lattice(plain, "<b:beam v1=\"-1\" v2=\"1\"/>")), Status::mesh, {"beam 0", "-1"});
  refuses(model(lattice(plain, "<b:beam v1=\"2\" v2=\"2\"/>")), Status::mesh, {"beam 0", "both"});
  refuses(model(lattice(plain, "<b:beam v1=\"2\"/>")), Status::io, {"beam 0", "v2"});
  refuses(model(lattice(plain, "<b:beam v1=\"0\" v2=\"1\" r2=\"1\"/>")), Status::io, {"r2", "r1"});
  for (const char* radius : {"-1", "nan", "inf", "1e80", "1e-200", "x", ""})
    assert_fails(
        [&] {
          read_beams(model(lattice(plain, text("<b:beam v1=\"0\" v2=\"1\" r1=\"%s\"/>", radius))));
        },
        radius[0] == 'x' || !*radius ? Status::io : Status::mesh, {"radius of a beam"});
  refuses(model(lattice(plain, "<b:beam v1=\"0\" v2=\"1\" r1=\"0\"/>")), Status::mesh,
          {"beam 0", "both 0"});
  refuses(
      model(lattice(plain, path), "<item objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 2 0 0 0\"/>"),
      Status::unsupported, {"1, 1 and 2"});
  refuses(
      model(lattice(plain, path), "<item objectid=\"1\" transform=\"1 0 0 1 1 0 0 0 1 0 0 0\"/>"),
      Status::unsupported, {"shears"});
  refuses(
      model(lattice(plain, path), "<item objectid=\"1\" transform=\"0 0 0 0 0 0 0 0 0 0 0 0\"/>"),
      Status::unsupported, {"0, 0 and 0"});
  refuses(
      model(lattice(plain, path), "<item objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 nan 0 0\"/>"),
      Status::mesh, {"node 0", "nan"});
  refuses(model(lattice(plain, "")), Status::mesh, {"no beams"});
  refuses(model(lattice(plain, path), ""), Status::mesh, {"no beams"});
  // Triangles alone would be a part of the solid only.
  assert_refused(file_of(model(lattice(plain, path))), MeshFormat::threemf, Status::unsupported,
                 {"msq_beam_file_open"});
}

/// The archive of one entry, with its sizes and its place in fields of Zip64, as lib3mf writes it.
std::string with_zip64_entry(const std::string& archive) {
  const size_t record = archive.rfind("PK\x01\x02");
  const auto number = [&](size_t at, size_t bytes) {
    uint64_t value = 0;
    for (size_t i = 0; i < bytes; ++i)
      value |= uint64_t{static_cast<uint8_t>(archive[at + i])} << (8 * i);
    return value;
  };
  const uint64_t packed = number(record + 20, 4), unpacked = number(record + 24, 4);
  const size_t name = number(26, 2), data = 30 + name + number(28, 2);
  const auto head = [&](size_t from) {  // from the method up to the length of the extra field
    std::string bytes = archive.substr(from, 10);
    put(bytes, UINT32_MAX);
    put(bytes, UINT32_MAX);
    put(bytes, static_cast<uint16_t>(name));
    return bytes;
  };
  std::string file = archive.substr(0, 8) + head(8);
  put(file, uint16_t{20});
  file += archive.substr(30, name);
  const auto put_sizes = [&](uint16_t bytes) {
    put(file, uint16_t{1});
    put(file, bytes);
    put(file, unpacked);
    put(file, packed);
  };
  put_sizes(16);
  file += archive.substr(data, packed);
  const size_t directory = file.size();
  file += archive.substr(record, 10) + head(record + 10);
  put(file, uint16_t{28});
  file += archive.substr(record + 32, 10);
  put(file, UINT32_MAX);
  file += archive.substr(record + 46, name);
  put_sizes(24);
  put(file, uint64_t{0});
  const size_t end = file.size();
  file += archive.substr(archive.size() - 22, 12);
  put(file, static_cast<uint32_t>(end - directory));
  put(file, static_cast<uint32_t>(directory));
  put(file, uint16_t{0});
  return file;
}

void reads_zip64_entries(void**) {
  const std::string small = with_zip64_entry(file_of(model(lattice(plain, path))));
  // Larger than the pieces in which it is unpacked.
  const std::string large =
      with_zip64_entry(file_of(model(lattice(plain, path)) + std::string(700000, ' ') + "<!-- " +
                               std::string(300000, 'x') + " -->"));
  MeshFileOptions options = options_for(MeshFormat::threemf);
  options.max_bytes = 2000000;
  options.max_triangles = 1000;
  for (const std::string& file : {small, large})
    assert_int_equal(
        msq::read_beam_memory(file.data(), file.size(), options).lattices[0].beams.size(), 2);
  options.max_bytes = 1000000;
  assert_fails([&] { msq::read_beam_memory(large.data(), large.size(), options); }, Status::limit,
               {"max_bytes is 1000000"});
  // Damage is found by the checksum, if not before.
  std::mt19937_64 random(64);
  int refused = 0;
  constexpr int rounds = 3000;
  for (int round = 0; round < rounds; ++round) {
    std::string content = small;
    if (round % 8 == 0) content.resize(random() % content.size());
    if (!content.empty()) content[random() % content.size()] = static_cast<char>(random());
    try {
      msq::read_beam_memory(content.data(), content.size(), options);
    } catch (const msq::Error& error) {
      assert_true(error.status != Status::internal && error.what()[0] != '\0');
      ++refused;
    }
  }
  assert_true(refused > rounds / 2);
}

/// Few bytes that ask for many beams.
void keeps_limits(void**) {
  MeshFileOptions options;
  options.max_triangles = 2;
  assert_int_equal(read_beams(model(lattice(plain, path)), options).lattices[0].size(), 2);
  options.max_triangles = 1;
  assert_fails([&] { read_beams(model(lattice(plain, path)), options); }, Status::limit,
               {"more than 1 beams", "max_triangles is 1"});
  // Each object is the one before it twice.
  std::string resources = "<object id=\"1\">" + lattice(plain, path) + "</object>";
  for (int i = 2; i <= 60; ++i)
    resources += text(
        "<object id=\"%d\"><components><component objectid=\"%d\"/>"
        "<component objectid=\"%d\"/></components></object>",
        i, i - 1, i - 1);
  refuses(threemf_model(beam_names, resources, "<item objectid=\"60\"/>"), Status::limit,
          {"1152921504606846976 beams", "200000000"});
}

void survives_mutation(void**) {
  const std::string whole = model(
      lattice(std::string(plain) +
                  " clippingmode=\"inside\" clippingmesh=\"5\" cap=\"butt\" b2:ballmode=\"all\" "
                  "b2:ballradius=\"2\"",
              "<b:beam v1=\"0\" v2=\"1\" r1=\"0.5\" cap2=\"sphere\"/><b:beam v1=\"1\" v2=\"2\"/>",
              "<b2:balls><b2:ball vindex=\"3\" r=\"1\"/></b2:balls><b:beamsets/>"),
      "<item objectid=\"1\" transform=\"0 2 0 -2 0 0 0 0 2 0 0 10\"/><item objectid=\"1\"/>",
      "<object id=\"5\">" + threemf_mesh() + "</object>");
  std::mt19937_64 random(20260101);
  int read = 0, refused = 0;
  MeshFileOptions options;
  options.max_bytes = 1 << 24;
  options.max_triangles = 100000;
  for (int round = 0; round < 1200; ++round) {
    std::string content = whole;
    if (round % 3 == 0) content.resize(random() % content.size());
    for (int i = round % 2 ? 2 : 0; i < 3 && !content.empty(); ++i)
      content[random() % content.size()] = "0123456789-./ \n\\\"<>eEnab\xff"[random() % 25];
    try {
      for (const BeamLattice& found : read_beams(content, options).lattices) {
        assert_true(found.size() > 0 && found.beams.size() == found.radii.size() &&
                    found.beams.size() == found.caps.size() &&
                    found.balls.size() == found.ball_radii.size());
        for (const std::array<uint32_t, 2>& beam : found.beams)
          assert_true(beam[0] < found.nodes.size() && beam[1] < found.nodes.size());
        for (const uint32_t ball : found.balls) assert_true(ball < found.nodes.size());
        if (found.clipping != msq::Clipping::none) assert_valid(found.clip);
        ++read;
      }
    } catch (const msq::Error& error) {
      assert_true(error.status != Status::internal && error.what()[0] != '\0');
      ++refused;
    }
  }
  assert_true(read > 50 && refused > 50);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(meshes_with_beams_are_no_triangles),
      cmocka_unit_test(radii_and_caps_have_defaults),
      cmocka_unit_test(names_of_drafts_are_read),
      cmocka_unit_test(balls_have_three_modes),
      cmocka_unit_test(instances_are_placed),
      cmocka_unit_test(refuses_what_it_cannot_keep),
      cmocka_unit_test(reads_zip64_entries),
      cmocka_unit_test(keeps_limits),
      cmocka_unit_test(survives_mutation),
  };
  return cmocka_run_group_tests_name("mesh_file_beams", tests, nullptr, nullptr);
}
