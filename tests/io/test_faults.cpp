// SPDX-License-Identifier: Apache-2.0
// Memory that runs out and a disk that fills up, at each step of each format: the call says so, and
// nothing is left. The same call succeeds afterwards, with the bytes of the first time.
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "failing_allocator.h"
#include "msq_io.h"
#include "msq_test.h"

namespace {

namespace fs = std::filesystem;
using msq::test::Failing;

void check(msq_status status) {
  if (status != MSQ_OK) fail_msg("%s / %s", msq_error_message(), msq_io_error_message());
}

template <class T, void (*RELEASE)(T*)>
struct Releaser {
  void operator()(T* object) const { RELEASE(object); }
};
template <class T, void (*RELEASE)(T*)>
using Handle = std::unique_ptr<T, Releaser<T, RELEASE>>;

/// What the formats are written from.
struct World {
  World() {
    msq_context_def def;
    check(msq_context_def_init(&def, sizeof def));
    def.threads = 1;
    msq_context* made_context;
    check(msq_context_create(&def, &made_context));
    context.reset(made_context);
    const double low[3] = {0, 0, 0}, high[3] = {4, 3, 2};
    msq_shape* box;
    check(msq_shape_from_box(context.get(), low, high, &box));
    msq_lattice_def lattice;
    check(msq_lattice_def_init(&lattice, sizeof lattice));
    for (double& side : lattice.grid.cell_size) side = 2;
    lattice.radius.value = 0.3;
    msq_structure* structure;
    check(msq_structure_lattice(context.get(), &lattice, &structure));
    msq_scale_def scales[2] = {};
    scales[0].shape = box;
    scales[1].structure = structure;
    msq_model_def model_def;
    check(msq_model_def_init(&model_def, sizeof model_def));
    model_def.scales = scales;
    model_def.scale_count = 2;
    model_def.scale_size = sizeof scales[0];
    msq_model* made_model;
    check(msq_model_create(context.get(), &model_def, &made_model));
    model.reset(made_model);
    msq_struts_def struts;
    check(msq_struts_def_init(&struts, sizeof struts));
    std::copy(low, low + 3, struts.min);
    std::copy(high, high + 3, struts.max);
    msq_strut_graph* made_graph;
    check(msq_structure_strut_graph(context.get(), structure, &struts, &made_graph, nullptr));
    graph.reset(made_graph);
    msq_structure_release(structure);
    msq_shape_release(box);

    msq_contours_def rings;
    check(msq_contours_def_init(&rings, sizeof rings));
    rings.tolerance = 0.02;
    msq_output_def outputs[2];
    for (msq_output_def& output : outputs) check(msq_output_def_init(&output, sizeof output));
    outputs[0].output = MSQ_LAYER_GREY;
    outputs[1].output = MSQ_LAYER_CONTOURS;
    outputs[1].contours = &rings;
    msq_slicer_def plan;
    check(msq_slicer_def_init(&plan, sizeof plan));
    check(msq_io_panel_def_init(&panel, sizeof panel));
    panel.pixels[0] = 60;
    panel.pixels[1] = 40;
    panel.size[0] = 6;
    panel.size[1] = 4;
    plan.layer_height = 0.25;
    plan.outputs = outputs;
    plan.output_count = 2;
    check(msq_io_panel_plan(model.get(), &panel, &plan));
    msq_slicer* made_slicer;
    check(msq_slicer_create(model.get(), &plan, &made_slicer));
    slicer.reset(made_slicer);
  }

  Handle<msq_context, msq_context_release> context;
  Handle<msq_model, msq_model_release> model;
  Handle<msq_strut_graph, msq_strut_graph_release> graph;
  Handle<msq_slicer, msq_slicer_release> slicer;
  msq_io_panel_def panel;
};

/// A way to write files to a path.
struct Way {
  const char* name;
  std::function<msq_status(const World&, const char* path)> write;
};

using Create = std::function<msq_status(const World&, const char* path, const msq_io_writer_def&,
                                        msq_io_writer** writer)>;

/// All layers, by one thread, so that allocations come in the same order each time.
Way layers(const char* name, uint32_t output, Create create) {
  return {name, [output, create](const World& world, const char* path) {
            msq_io_writer_def def;
            check(msq_io_writer_def_init(&def, sizeof def));
            def.threads = 1;
            def.output = output;
            msq_io_writer* writer = nullptr;
            msq_status status = create(world, path, def, &writer);
            if (status == MSQ_OK)
              status = msq_slicer_run(world.slicer.get(), 0, UINT64_MAX, msq_io_writer_layer,
                                      writer, nullptr);
            if (status == MSQ_OK || status == MSQ_E_HOST) {
              const msq_status finished = msq_io_writer_finish(writer);
              // The failure of a layer is that of the writer.
              if (status == MSQ_E_HOST) assert_int_not_equal(finished, MSQ_OK);
              status = finished;
            }
            msq_io_writer_release(writer);
            return status;
          }};
}

Way png(const char* name, int32_t level) {
  return layers(name, 0,
                [level](const World& world, const char* path, const msq_io_writer_def& common,
                        msq_io_writer** writer) {
                  msq_io_png_def def;
                  check(msq_io_png_def_init(&def, sizeof def));
                  def.level = level;
                  return msq_io_png_create(world.slicer.get(), path, &common, &def, writer);
                });
}

Way svg(const char* name, int32_t layout) {
  return layers(name, 1,
                [layout](const World& world, const char* path, const msq_io_writer_def& common,
                         msq_io_writer** writer) {
                  msq_io_svg_def def;
                  check(msq_io_svg_def_init(&def, sizeof def));
                  def.layout = layout;
                  return msq_io_svg_create(world.slicer.get(), path, &common, &def, writer);
                });
}

msq_status write_mesh(const World& world, const char* path) {
  msq_surface_def def;
  check(msq_surface_def_init(&def, sizeof def));
  def.pitch = 0.5;
  return msq_io_surface_save(world.model.get(), &def, MSQ_SURFACE_PLY, path, 0, nullptr);
}

msq_status write_text(const World&, const char* path) {
  msq_io_file* file = nullptr;
  static const std::string text(20000, 'x');
  msq_status status = msq_io_file_create(path, 0, &file);
  if (status == MSQ_OK) status = msq_io_file_write(file, text.data(), text.size());
  if (status == MSQ_OK) status = msq_io_file_finish(file);
  msq_io_file_release(file);
  return status;
}

std::vector<Way> ways() {
  return {
      png("PNG by ISA-L", 0),
      png("PNG by libpng", 1),
      layers("SL1", 0,
             [](const World& world, const char* path, const msq_io_writer_def& common,
                msq_io_writer** writer) {
               msq_io_sl1_def def;
               check(msq_io_sl1_def_init(&def, sizeof def));
               def.panel = &world.panel;
               return msq_io_sl1_create(world.slicer.get(), path, &common, &def, writer, nullptr);
             }),
      svg("SVG in one file", MSQ_IO_SVG_STACK),
      svg("SVG in files", MSQ_IO_SVG_FILES),
      layers("3MF slices", 1,
             [](const World& world, const char* path, const msq_io_writer_def& common,
                msq_io_writer** writer) {
               return msq_io_slices_create(world.slicer.get(), path, &common, nullptr, writer);
             }),
      {"beams",
       [](const World& world, const char* path) {
         return msq_io_beams_save(world.graph.get(), nullptr, path, 0);
       }},
      {"a mesh", write_mesh},
      {"a picture",
       [](const World&, const char* path) {
         static const std::vector<uint8_t> pixels(60 * 60, 77);
         return msq_io_picture_save(path, 60, 60, 1, pixels.data(), 0, 0);
       }},
      {"a text", write_text},
  };
}

/// minizip uses what malloc returns without a look at it.
bool is_zip(const Way& way) {
  const std::string name = way.name;
  return name == "SL1" || name == "3MF slices" || name == "beams";
}

/// The files of a folder and of those in it, with their bytes.
using Files = std::map<std::string, std::string>;
Files files_of(const fs::path& folder) {
  Files found;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    std::string& bytes = found[entry.path().lexically_relative(folder).string()];
    if (!entry.is_regular_file()) continue;
    std::ifstream in(entry.path(), std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(in), {});
  }
  return found;
}

/// A folder that is removed at the end.
class Folder {
 public:
  Folder() {
    char name[] = "io_faults.XXXXXX";
    assert_non_null(mkdtemp(name));
    path_ = name;
  }
  ~Folder() { fs::remove_all(path_); }
  const fs::path& path() const { return path_; }
  std::string file() const { return (path_ / "out").string(); }
  Files take() const {
    Files found = files_of(path_);
    for (const auto& entry : fs::directory_iterator(path_)) fs::remove_all(entry.path());
    return found;
  }

 private:
  fs::path path_;
};

/// k = 1, 2, ... up to count, not more than a few of them.
std::vector<uint64_t> some_of(uint64_t count) {
  constexpr uint64_t most = 60;
  std::vector<uint64_t> chosen;
  for (uint64_t k = 1; k <= count; k += k < most / 2 ? 1 : std::max<uint64_t>(count / 30, 1))
    chosen.push_back(k);
  return chosen;
}

void memory(void**) {
  const World world;
  const Folder folder;
  const std::string path = folder.file();
  for (const Way& way : ways()) {
    if (is_zip(way)) continue;
    check(way.write(world, path.c_str()));  // what is made once, in msq and in libraries
    const Files first = folder.take();
    assert_true(!first.empty());
    msq::test::arm(0, Failing::once);
    const msq_status counted = way.write(world, path.c_str());
    const uint64_t count = msq::test::disarm();
    check(counted);
    assert_true(folder.take() == first);
    assert_true(count > 3);
    uint64_t refused = 0;
    for (const Failing failing : {Failing::once, Failing::from_then_on})
      for (const uint64_t k : some_of(count)) {
        msq::test::arm(k, failing);
        const msq_status status = way.write(world, path.c_str());
        msq::test::disarm();
        const Files left = folder.take();
        if (status == MSQ_OK) {  // a thing that was not needed
          if (left != first) fail_msg("%s: other bytes without allocation %d", way.name, int(k));
          continue;
        }
        ++refused;
        if (status != MSQ_E_MEMORY)
          fail_msg("%s: allocation %d: %s: %s", way.name, int(k), msq_status_name(status),
                   msq_io_error_message());
        // Without any memory a folder of temporary files cannot be listed, and stays.
        for (const auto& [name, bytes] : left)
          if (failing == Failing::once || name.rfind("out", 0) == 0)
            fail_msg("%s: allocation %d: %s is left", way.name, int(k), name.c_str());
      }
    if (refused < 3) fail_msg("%s: %d failures", way.name, int(refused));
    check(way.write(world, path.c_str()));
    assert_true(folder.take() == first);
  }
}

/// A limit of the size of files stands for a full disk: writes end short, then fail.
void disk(void**) {
  const World world;
  const Folder folder;
  const std::string path = folder.file();
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before;
  assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
  for (const Way& way : ways()) {
    check(way.write(world, path.c_str()));
    const Files first = folder.take();
    uint64_t largest = 0;
    for (const auto& [name, bytes] : first) largest = std::max<uint64_t>(largest, bytes.size());
    for (const uint64_t room : {uint64_t{0}, uint64_t{1}, largest / 2, largest - 1}) {
      rlimit limit = before;
      limit.rlim_cur = room;
      assert_int_equal(setrlimit(RLIMIT_FSIZE, &limit), 0);
      const msq_status status = way.write(world, path.c_str());
      const std::string message = msq_io_error_message();
      assert_int_equal(setrlimit(RLIMIT_FSIZE, &before), 0);
      if (status != MSQ_E_IO || message.find("out") == std::string::npos)
        fail_msg("%s: %d bytes of %d: %s: %s", way.name, int(room), int(largest),
                 msq_status_name(status), message.c_str());
      const Files left = folder.take();
      if (!left.empty()) fail_msg("%s: %s is left", way.name, left.begin()->first.c_str());
    }
    check(way.write(world, path.c_str()));
    assert_true(folder.take() == first);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(memory), cmocka_unit_test(disk)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
