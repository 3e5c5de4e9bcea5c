// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "scenarios.h"
#include "world.h"

namespace msq::test {

#if MSQ_WITH_JSON

namespace {

/// Every kind of object that needs no file, and both settings.
constexpr const char* text = R"({
  "msq_model": 1, "title": "all",
  "fields": {"f": {"map": {"argument": {"radial": {"to_value": 1}}, "curve": [[0, 0.1], [1, 0.2]]}},
             "g": {"grid": {"image": {"value_type": "uint8", "size": [1, 1, 2], "values": [1, 2]}}}},
  "regions": [
    {"scales": [{"shape": {"boolean": {"operation": "union", "shapes": [
                   {"box": {"min": [0, 0, 0], "max": [4, 4, 4]}},
                   {"placed": {"original": {"sphere": {"radius": 1}},
                               "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0]}}]}}},
                {"structure": {"lattice": {"radius": "f", "cells": [{}, {"unit_cell": "fcc"}]}}}]},
    {"scales": [{"shape": {"mesh": {"vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
                   "triangles": [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]}},
                 "material": {"plain": {"id": 1, "channels": [{"name": "E", "value": "f"}]}}},
                {"structure": {"functional": {"function": "expression", "expression": "sin(x) - k",
                   "parameters": {"k": 0.5}}}, "skin": 0.1},
                {"structure": {"beams": {"nodes": [[0, 0, 0], [1, 1, 1]], "beams": [[0, 1]],
                   "radius": 0.1}}}]}],
  "slicing": {"pitch": 0.1, "layer_height": 0.1,
              "outputs": [{"output": "contours", "contours": {"tolerance": 0.1}}]},
  "view": {"direction": [0, 0, -1], "width": 8, "height": 8, "colours": [[1, 1, 1]]}
})";

msq_document* read(World& world) {
  msq_document* document;
  require_ok(
      msq_document_from_json(world.context, text, std::strlen(text), nullptr, &document, nullptr));
  return document;
}

void require_model(msq_document* document) {
  msq_model* model;
  require_ok(msq_document_model(document, &model));
  double min[3], max[3];
  require_ok(msq_model_bounds(model, min, max));
  require(max[0] == 4, "another model");
  msq_model_release(model);
  msq_document_release(document);
}

#if MSQ_WITH_TIFF

/// Membership on a grid.
void probe_model(msq_document* document, std::vector<uint8_t>& inside) {
  msq_model* model;
  require_ok(msq_document_model(document, &model));
  const msq_points_def points = grid_of(10);
  require_ok(msq_set_membership(model, &points, nullptr, inside.data(), inside.size(), nullptr));
  const auto count = std::count(inside.begin(), inside.end(), 1);
  require(count > 0 && count < 500, "another image");
  msq_model_release(model);
  msq_document_release(document);
}

/// Two pages of 2 x 2 values of 16 bits, in strips of one row, without compression.
std::string tiff() {
  std::string bytes("II*\0", 4);
  const auto put = [&](uint32_t value, int width) {
    for (int i = 0; i < width; ++i) bytes += static_cast<char>(value >> (8 * i) & 255);
  };
  constexpr uint32_t head = 8, strip = 4, entries = 10, lists = 2 * strip + 2 * 8,
                     page_bytes = lists + 2 + 12 * entries + 4;
  put(head + lists, 4);
  for (uint32_t page = 0; page < 2; ++page) {
    const uint32_t begin = head + page * page_bytes, offsets = begin + 2 * strip;
    for (uint32_t i = 0; i < 4; ++i) put(page * 4 + i, 2);
    put(begin, 4);
    put(begin + strip, 4);
    put(strip, 4);
    put(strip, 4);
    // Width, height, bits, compression, black is 0, strips, samples, rows of a strip, bytes of
    // strips, signed.
    const uint32_t tags[entries][2] = {{256, 2},           {257, 2},       {258, 16}, {259, 1},
                                       {262, 1},           {273, offsets}, {277, 1},  {278, 1},
                                       {279, offsets + 8}, {339, 2}};
    put(entries, 2);
    for (const auto& [tag, value] : tags) {
      const bool is_list = tag == 273 || tag == 279;
      put(tag, 2);
      put(is_list ? 4 : 3, 2);  // of 32 bits, or of 16
      put(is_list ? 2 : 1, 4);
      put(value, 4);
    }
    put(page == 0 ? begin + page_bytes + lists : 0, 4);
  }
  return bytes;
}

#endif

/// A document and a mesh that it names, for as long as this lives.
class Files {
 public:
  Files() {
    const char* parent = std::getenv("TMPDIR");
    folder_ = std::string(parent && *parent ? parent : "/tmp") + "/msq-test-XXXXXX";
    require(mkdtemp(folder_.data()) != nullptr, "no folder");
    write("t.obj", "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 0 0 4\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
    write("m.json",
          "{\"msq_model\": 1, \"scales\": [{\"shape\": {\"file\": {\"file\": "
          "\"t.obj\"}}}]}");
#if MSQ_WITH_TIFF
    write("v.tif", tiff());
    write("v.json",
          "{\"msq_model\": 1, \"scales\": [{\"shape\": {\"voxels\": {\"image\": {\"files\": "
          "[\"v.tif\", \"v.tif\"]}, \"threshold\": 6}}}]}");
#endif
  }
  ~Files() {
    for (const char* name : {"t.obj", "m.json", "v.tif", "v.json"}) std::remove(path(name).c_str());
    rmdir(folder_.c_str());
  }
  std::string path(const char* name) const {
    return folder_ + "/" + name;
  }

 private:
  void write(const char* name, const std::string& content) const {
    std::FILE* file = std::fopen(path(name).c_str(), "wb");
    require(file && std::fwrite(content.data(), 1, content.size(), file) == content.size() &&
                std::fclose(file) == 0,
            "no file");
  }
  std::string folder_;
};

}  // namespace

#endif

std::vector<Scenario> document_scenarios() {
  std::vector<Scenario> scenarios = {
      {"msq_document_def_init",
       [](Stage& stage) {
         msq_document_def def;
         stage.watch(def);
         stage.call([&] { return msq_document_def_init(&def, sizeof def); });
       }},
      {"msq_json_def_init", [](Stage& stage) {
         msq_json_def def;
         stage.watch(def);
         stage.call([&] { return msq_json_def_init(&def, sizeof def); });
       }}};
#if MSQ_WITH_JSON
  scenarios.push_back({"msq_document_from_json", [](Stage& stage) {
                         World world(stage);
                         msq_document* document;
                         stage.needs_stack = true;
                         stage.watch_handle(document);
                         stage.call(
                             [&] {
                               return msq_document_from_json(world.context, text, std::strlen(text),
                                                             nullptr, &document, nullptr);
                             },
                             [&] { require_model(document); });
                       }});
  scenarios.push_back({"msq_document_from_file", [](Stage& stage) {
                         World world(stage);
                         const Files files;
                         const std::string path = files.path("m.json");
                         msq_document* document;
                         stage.needs_stack = true;
                         stage.watch_handle(document);
                         stage.call(
                             [&] {
                               return msq_document_from_file(world.context, path.c_str(), nullptr,
                                                             &document, nullptr);
                             },
                             [&] { require_model(document); });
                       }});
#if MSQ_WITH_TIFF
  scenarios.push_back({"msq_document_from_file, TIFF", [](Stage& stage) {
                         World world(stage);
                         const Files files;
                         const std::string path = files.path("v.json");
                         msq_document* document;
                         std::vector<uint8_t> inside(1000);
                         stage.watch_probe(inside);
                         stage.needs_stack = stage.allows_io = true;
                         stage.watch_handle(document);
                         stage.call(
                             [&] {
                               return msq_document_from_file(world.context, path.c_str(), nullptr,
                                                             &document, nullptr);
                             },
                             [&] { probe_model(document, inside); });
                       }});
#endif
  scenarios.push_back({"msq_document_info", [](Stage& stage) {
                         World world(stage);
                         msq_document* document = read(world);
                         msq_document_report report{};
                         stage.call([&] {
                           report = {};
                           report.struct_size = sizeof report;
                           return msq_document_info(document, &report);
                         });
                         require(report.has_slicing == 1, "no slicing");
                         msq_document_release(document);
                       }});
  scenarios.push_back({"msq_document_model", [](Stage& stage) {
                         World world(stage);
                         msq_document* document = read(world);
                         msq_model* model;
                         stage.watch_handle(model);
                         stage.call([&] { return msq_document_model(document, &model); },
                                    [&] { msq_model_release(model); });
                         msq_document_release(document);
                       }});
  scenarios.push_back({"msq_document_slicing, msq_document_view", [](Stage& stage) {
                         World world(stage);
                         msq_document* document = read(world);
                         stage.call([&] {
                           msq_slicer_def slicing{};
                           slicing.struct_size = sizeof slicing;
                           msq_camera camera{};
                           camera.struct_size = sizeof camera;
                           msq_render_def render{};
                           render.struct_size = sizeof render;
                           const msq_status status = msq_document_slicing(document, &slicing);
                           return status == MSQ_OK ? msq_document_view(document, &camera, &render)
                                                   : status;
                         });
                         msq_document_retain(document);
                         msq_document_release(document);
                         msq_document_release(document);
                       }});
  scenarios.push_back({"msq_model_to_json", [](Stage& stage) {
                         World world(stage);
                         msq_document* document = read(world);
                         msq_model* model;
                         require_ok(msq_document_model(document, &model));
                         msq_document_release(document);
                         std::vector<char> written(4096);
                         uint64_t bytes = 0;
                         stage.watch(written);
                         stage.watch(bytes);
                         stage.needs_stack = true;
                         stage.call([&] {
                           return msq_model_to_json(model, nullptr, written.data(), written.size(),
                                                    &bytes);
                         });
                         msq_model_release(model);
                       }});
#endif
  return scenarios;
}

}  // namespace msq::test
