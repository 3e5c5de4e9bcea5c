// SPDX-License-Identifier: Apache-2.0
// glTF files: what is read, what is refused, and files with random bytes changed.
#include <random>

#include "mesh_file_fixtures.h"

namespace {

using namespace mesh_file_fixtures;

/// The box of the fixtures in metres, with y up: point c becomes 1000 c in millimetres.
std::string positions() {
  std::string bytes;
  for (const auto& c : corners) {
    put(bytes, static_cast<float>(c[0]));
    put(bytes, static_cast<float>(c[2]));
    put(bytes, static_cast<float>(-c[1]));
  }
  return bytes;
}

template <class Index>
std::string indices() {
  std::string bytes;
  for (const auto& triangle : box_triangles())
    for (const int corner : triangle) put(bytes, static_cast<Index>(corner));
  return bytes;
}

/// A file of parts that tests replace.
struct Parts {
  std::string data = positions() + indices<uint16_t>();
  std::string uri;  ///< with its key; empty: none
  std::string asset = R"("asset":{"version":"2.0"})";
  std::string views =
      R"({"buffer":0,"byteLength":96},{"buffer":0,"byteOffset":96,"byteLength":72})";
  std::string accessors = R"({"bufferView":0,"componentType":5126,"count":8,"type":"VEC3"},)"
                          R"({"bufferView":1,"componentType":5123,"count":36,"type":"SCALAR"})";
  std::string primitives = R"({"attributes":{"POSITION":0},"indices":1})";
  std::string nodes = R"({"mesh":0})";
  std::string scenes = R"("scenes":[{"nodes":[0]}])";
  uint64_t length = data.size();

  std::string json() const {
    return "{" + asset + "," + scenes + ",\"nodes\":[" + nodes + "],\"meshes\":[{\"primitives\":[" +
           primitives + "]}],\"accessors\":[" + accessors + "],\"bufferViews\":[" + views +
           "],\"buffers\":[{" + uri + "\"byteLength\":" + std::to_string(length) + "}]}";
  }
  std::string glb() const {
    std::string text = json(), binary = data;
    while (text.size() % 4) text += ' ';
    while (binary.size() % 4) binary += '\0';
    std::string file = "glTF";
    put(file, uint32_t{2});
    put(file, static_cast<uint32_t>(28 + text.size() + binary.size()));
    put(file, static_cast<uint32_t>(text.size()));
    file += "JSON" + text;
    put(file, static_cast<uint32_t>(binary.size()));
    return file + std::string("BIN\0", 4) + binary;
  }
};

std::string base64(const std::string& bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t bits = 0;
    for (size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<uint8_t>(bytes[i + k]) : 0u);
    for (size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : digits[bits >> (18 - 6 * k) & 63];
  }
  return text;
}

std::string as_text(Parts parts) {
  parts.uri = R"("uri":"data:application/octet-stream;base64,)" + base64(parts.data) + "\",";
  return parts.json();
}

TriangleSoup read_gltf(const std::string& file) {
  return read(file, options_for(MeshFormat::gltf));
}

void refuses(const Parts& parts, Status status, const std::vector<std::string>& words) {
  assert_refused(parts.glb(), MeshFormat::gltf, status, words);
}

void reads_metres_with_y_up(void**) {
  assert_box(read_gltf(Parts().glb()), 1000);
  assert_box(read_gltf(as_text({})), 1000);
  assert_box(read_gltf("\xef\xbb\xbf" + as_text({})), 1000);
  for (const char* name : {"box.glb", "box.gltf", "box.GLB"}) {
    const bool is_text = strstr(name, ".gltf");
    const std::string path = folder().write(name, is_text ? as_text({}) : Parts().glb());
    assert_box(msq::read_mesh_file(path, {}), 1000);
  }
}

void reads_all_forms_of_indices(void**) {
  Parts parts;
  parts.data = positions() + indices<uint8_t>();
  parts.length = 132;
  parts.views = R"({"buffer":0,"byteLength":96},{"buffer":0,"byteOffset":96,"byteLength":36})";
  parts.accessors = R"({"bufferView":0,"componentType":5126,"count":8,"type":"VEC3"},)"
                    R"({"bufferView":1,"componentType":5121,"count":36,"type":"SCALAR"})";
  assert_box(read_gltf(parts.glb()), 1000);
  parts.data = positions() + indices<uint32_t>();
  parts.length = 240;
  // Through one view, with an offset, and a buffer that is longer.
  parts.data += "more";
  parts.length = 244;
  parts.views = R"({"buffer":0,"byteLength":240})";
  parts.accessors =
      R"({"bufferView":0,"componentType":5126,"count":8,"type":"VEC3"},)"
      R"({"bufferView":0,"byteOffset":96,"componentType":5125,"count":36,"type":"SCALAR"})";
  assert_box(read_gltf(parts.glb()), 1000);
  // None, and vertices with something between them.
  parts.data.clear();
  for (const auto& triangle : box_triangles())
    for (const int corner : triangle) {
      parts.data += positions().substr(static_cast<size_t>(corner) * 12, 12);
      put(parts.data, 7.0f);
    }
  parts.length = 576;
  parts.views = R"({"buffer":0,"byteLength":576,"byteStride":16})";
  parts.accessors = R"({"bufferView":0,"componentType":5126,"count":36,"type":"VEC3"})";
  parts.primitives = R"({"attributes":{"POSITION":0}})";
  const TriangleSoup soup = read_gltf(parts.glb());
  assert_int_equal(soup.vertices.size(), 36);
  assert_box(soup, 1000);
}

/// A square in z = 0 of msq, with its normal up.
void reads_strips_and_fans(void**) {
  const float around[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 0, -1}, {0, 0, -1}};
  for (const bool is_strip : {false, true}) {
    Parts parts;
    parts.data.clear();
    for (const int i : {0, 1, is_strip ? 3 : 2, is_strip ? 2 : 3})
      for (const float x : around[i]) put(parts.data, x);
    parts.length = 48;
    parts.views = R"({"buffer":0,"byteLength":48})";
    parts.accessors = R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"})";
    parts.primitives =
        text(R"({"mode":%d,"attributes":{"POSITION":0}},{"mode":1,"attributes":{"POSITION":0}})",
             is_strip ? 5 : 6);
    const TriangleSoup soup = read_gltf(parts.glb());
    assert_int_equal(soup.triangles.size(), 2);
    double area = 0;
    for (const msq::Triangle& t : soup.triangles) {
      const Vec3 a = soup.vertices[t[0]];
      const Vec3 normal = cross(soup.vertices[t[1]] - a, soup.vertices[t[2]] - a);
      assert_near(normal.z, 1e6);
      area += normal.z / 2;
    }
    assert_near(area, 1e6);
  }
}

void places_nodes(void**) {
  Parts parts;
  parts.scenes = R"("scene":1,"scenes":[{},{"nodes":[0,3]}])";
  // Turned by 90 degrees about y of the file, which is z of msq, and moved up; a child that is
  // mirrored; a node that is not in the scene.
  parts.nodes =
      R"({"mesh":0,"translation":[0,10,0],"rotation":[0,0.7071067811865476,0,0.7071067811865476],)"
      R"("scale":[1,2,1],"children":[1]},)"
      R"({"mesh":0,"matrix":[-1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]},{"mesh":0},{"children":[]})";
  const TriangleSoup soup = read_gltf(parts.glb());
  assert_int_equal(soup.triangles.size(), 24);
  assert_near(volume(soup, 0, 12), 2 * box_volume * 1e9);
  assert_near(volume(soup, 12, 12), 2 * box_volume * 1e9);
  assert_bounds(soup, 0, 12, {-4000, 1000, 12000}, {-1000, 3000, 20000});
  assert_bounds(soup, 12, 12, {-4000, -3000, 12000}, {-1000, -1000, 20000});
}

void reads_quantized_positions(void**) {
  Parts parts;
  parts.asset += R"(,"extensionsRequired":["KHR_mesh_quantization","KHR_materials_unlit"])";
  parts.data.clear();
  for (const auto& c : corners) {
    for (const int x : {c[0], c[2], -c[1]}) put(parts.data, static_cast<int16_t>(x * 6553));
    put(parts.data, int16_t{0});
  }
  parts.data += indices<uint16_t>();
  parts.length = 136;
  parts.views =
      R"({"buffer":0,"byteLength":64,"byteStride":8},{"buffer":0,"byteOffset":64,"byteLength":72})";
  parts.accessors =
      R"({"bufferView":0,"componentType":5122,"normalized":true,"count":8,"type":"VEC3"},)"
      R"({"bufferView":1,"componentType":5123,"count":36,"type":"SCALAR"})";
  assert_box(read_gltf(parts.glb()), 1000 * (6553.0 / 32767));
}

Parts with(std::string Parts::*part, const char* text) {
  Parts parts;
  parts.*part = text;
  return parts;
}

void refuses_what_it_does_not_read(void**) {
  refuses(with(&Parts::asset, R"("asset":{"version":"1.0"})"), Status::unsupported, {"1.0", "2.0"});
  refuses(with(&Parts::asset, R"("a":1)"), Status::unsupported, {"version is \"\""});
  for (const char* name : {"KHR_draco_mesh_compression", "EXT_mesh_gpu_instancing"})
    refuses(with(&Parts::asset,
                 text(R"("asset":{"version":"2.0"},"extensionsRequired":["%s"])", name).c_str()),
            Status::unsupported, {name});
  refuses(with(&Parts::uri, R"("uri":"box.bin",)"), Status::unsupported,
          {"buffer 0", "another file", "box.bin"});
  refuses(with(&Parts::uri, R"("uri":"file:///etc/passwd",)"), Status::unsupported,
          {"/etc/passwd"});
  refuses(with(&Parts::uri, R"("uri":"data:;base64,AAA!",)"), Status::io, {"base64"});
  refuses(with(&Parts::uri, R"("uri":"data:;base64,AAAA",)"), Status::io, {"3 bytes", "168"});
  refuses(with(&Parts::nodes, R"({"mesh":0,"skin":0})"), Status::unsupported, {"skin"});
  refuses(with(&Parts::nodes, R"({"mesh":1})"), Status::mesh, {"no mesh 1", "has 1"});
  refuses(with(&Parts::nodes, R"({"mesh":-1})"), Status::io, {"whole number"});
  refuses(with(&Parts::nodes, R"({"children":[0]})"), Status::io, {"contains itself"});
  refuses(with(&Parts::nodes, R"({"mesh":0,"matrix":[1,2]})"), Status::io, {"matrix", "16"});
  refuses(with(&Parts::nodes, R"({"mesh":0,"scale":[1,2,"x"]})"), Status::io, {"not a number"});
  refuses(with(&Parts::nodes, R"({"mesh":0,"scale":[1,2,1e999]})"), Status::io, {"glTF"});
  refuses(with(&Parts::nodes, R"(5)"), Status::io, {"not an object"});
  refuses(with(&Parts::scenes, R"("scene":3,"scenes":[])"), Status::mesh, {"no scene 3"});
  refuses(with(&Parts::scenes, R"("scenes":[{"nodes":[7]}])"), Status::mesh, {"no node 7"});
  refuses(with(&Parts::scenes, R"("scenes":[{}])"), Status::mesh, {"no triangles"});
  refuses(with(&Parts::scenes, R"("scenes":{"a":1})"), Status::io, {"scenes is not an array"});
  refuses(with(&Parts::primitives, R"({"attributes":{"POSITION":0},"mode":7})"), Status::io, {"7"});
  refuses(with(&Parts::primitives, R"({"attributes":{"POSITION":1},"indices":1})"), Status::io,
          {"three numbers"});
  refuses(with(&Parts::primitives, R"({"attributes":{"POSITION":0},"indices":0})"), Status::io,
          {"indices"});
  refuses(with(&Parts::primitives,
               R"({"attributes":{"POSITION":0},"extensions":{"KHR_draco_mesh_compression":{}}})"),
          Status::unsupported, {"KHR_draco_mesh_compression"});
  refuses(with(&Parts::views,
               R"({"buffer":0,"byteLength":97},{"buffer":0,"byteOffset":97,"byteLength":72})"),
          Status::io, {"97", "168"});
  refuses(
      with(
          &Parts::views,
          R"({"buffer":0,"byteLength":96},{"buffer":0,"byteOffset":18446744073709551615,"byteLength":72})"),
      Status::io, {"18446744073709551615"});
  refuses(with(&Parts::views, R"({"buffer":1,"byteLength":96})"), Status::mesh, {"no buffer 1"});
  const auto accessor = [](const char* first) {
    return with(&Parts::accessors,
                (std::string(first) +
                 R"(,{"bufferView":1,"componentType":5123,"count":36,"type":"SCALAR"})")
                    .c_str());
  };
  refuses(accessor(R"({"bufferView":0,"componentType":5126,"count":9,"type":"VEC3"})"), Status::io,
          {"9 elements", "96 bytes"});
  refuses(accessor(R"({"bufferView":0,"componentType":5126,"count":4294967296,"type":"VEC3"})"),
          Status::io, {"4294967296"});
  refuses(
      accessor(
          R"({"bufferView":0,"componentType":5126,"count":18446744073709551615,"type":"VEC3"})"),
      Status::io, {"18446744073709551615"});
  refuses(
      accessor(R"({"bufferView":0,"byteOffset":4,"componentType":5126,"count":8,"type":"VEC3"})"),
      Status::io, {"byte 4"});
  refuses(accessor(R"({"bufferView":0,"componentType":5124,"count":8,"type":"VEC3"})"), Status::io,
          {"5124"});
  refuses(accessor(R"({"bufferView":0,"componentType":5126,"count":8,"type":"MAT4"})"), Status::io,
          {"MAT4"});
  refuses(accessor(R"({"componentType":5126,"count":8,"type":"VEC3"})"), Status::io,
          {"bufferView"});
  refuses(
      accessor(
          R"({"bufferView":0,"componentType":5126,"count":8,"type":"VEC3","sparse":{"count":1000000000}})"),
      Status::unsupported, {"sparse"});
  Parts parts;
  parts.data[96] = 8;
  refuses(parts, Status::mesh, {"vertex index 8", "8 vertices"});
  parts = {};
  put(parts.data, std::numeric_limits<float>::quiet_NaN());
  parts.data.replace(0, 4, parts.data, 168, 4);
  refuses(parts, Status::mesh, {"not finite"});
  assert_refused("{\"asset\":", MeshFormat::gltf, Status::io, {"glTF: 1:"});
  assert_refused("", MeshFormat::gltf, Status::io, {"glTF"});
  assert_refused("glTF\2", MeshFormat::gltf, Status::io, {"header"});
  std::string file = Parts().glb();
  file[4] = 1;
  assert_refused(file, MeshFormat::gltf, Status::unsupported, {"container is 1"});
  file = Parts().glb();
  file.resize(file.size() - 1);
  assert_refused(file, MeshFormat::gltf, Status::io, {"expected"});
}

/// Few bytes that ask for much memory or time.
void keeps_limits(void**) {
  MeshFileOptions options = options_for(MeshFormat::gltf);
  options.max_triangles = 11;
  assert_fails([&] { read(Parts().glb(), options); }, Status::limit, {"12", "11"});
  Parts parts;
  for (int i = 1; i < 64; ++i) parts.nodes += text(R"(,{"children":[%d,%d]})", i - 1, i - 1);
  parts.scenes = R"("scenes":[{"nodes":[63]}])";
  refuses(parts, Status::limit, {"200000000"});
  parts = {};
  for (int i = 1; i < 300; ++i) parts.nodes += text(R"(,{"children":[%d]})", i - 1);
  parts.scenes = R"("scenes":[{"nodes":[299]}])";
  refuses(parts, Status::limit, {"100"});
  // Each primitive would have a million vertices, most of them in no triangle.
  parts = {};
  constexpr size_t vertices = 1000000, primitives = 300;
  parts.data = positions() + std::string(12 * vertices, '\0') + indices<uint16_t>();
  parts.length = parts.data.size();
  parts.views =
      text(R"({"buffer":0,"byteLength":%zu},{"buffer":0,"byteOffset":%zu,"byteLength":72})",
           96 + 12 * vertices, 96 + 12 * vertices);
  parts.accessors = text(R"({"bufferView":0,"componentType":5126,"count":%zu,"type":"VEC3"},)"
                         R"({"bufferView":1,"componentType":5123,"count":36,"type":"SCALAR"})",
                         8 + vertices);
  const std::string one = parts.primitives;
  for (size_t i = 1; i < primitives; ++i) parts.primitives += "," + one;
  assert_int_equal(read_gltf(parts.glb()).vertices.size(), 8 * primitives);
  // Lists within lists.
  assert_refused(std::string(100000, '['), MeshFormat::gltf, Status::limit, {"max_depth"});
}

void survives_truncation_and_mutation(void**) {
  Parts parts;
  parts.nodes =
      R"({"mesh":0,"translation":[0,10,0],"rotation":[0,0.7,0,0.7],"scale":[1,2,1],"children":[1]},)"
      R"({"mesh":0,"matrix":[-1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]})";
  std::mt19937_64 random(20260102);
  const char* numbers[] = {
      "0",   "1",    "7",    "255",  "65535", "4294967295", "-1", "18446744073709551615",
      "1e9", "5121", "5125", "5126", "5",     "6",          "96", "null",
      "[]"};
  for (const std::string& whole : {parts.glb(), as_text(parts)}) {
    for (size_t n = 0; n < whole.size(); ++n) read_anything(whole.substr(0, n), MeshFormat::gltf);
    for (int round = 0; round < 6000; ++round) {
      std::string content = whole;
      for (uint64_t changes = 1 + random() % 3; changes > 0; --changes) {
        const size_t at = random() % content.size();
        const size_t digit = content.find_first_of("0123456789", at);
        if (random() % 2 && digit < content.size()) {
          const size_t end =
              std::min(content.find_first_not_of("0123456789", digit), content.size());
          const std::string number = numbers[random() % 17];
          // The length of the chunk stays right if the number is as long.
          std::string filled = number;
          while (filled.size() < end - digit) filled += ' ';
          content.replace(digit, end - digit, filled);
        } else {
          content[at] = static_cast<char>(random());
        }
      }
      read_anything(content, MeshFormat::gltf);
    }
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(reads_metres_with_y_up),
      cmocka_unit_test(reads_all_forms_of_indices),
      cmocka_unit_test(reads_strips_and_fans),
      cmocka_unit_test(places_nodes),
      cmocka_unit_test(reads_quantized_positions),
      cmocka_unit_test(refuses_what_it_does_not_read),
      cmocka_unit_test(keeps_limits),
      cmocka_unit_test(survives_truncation_and_mutation),
  };
  return cmocka_run_group_tests_name("gltf", tests, nullptr, nullptr);
}
