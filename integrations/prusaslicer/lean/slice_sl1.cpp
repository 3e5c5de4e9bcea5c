// SPDX-License-Identifier: Apache-2.0
// Slices an STL file to an SL1 archive with libslic3r, as PrusaSlicer does with --export-sla, reads
// an archive by its importer, and compares the pixels of two. Prints what came out as JSON:
//
//   slice_sl1 part.stl part.sl1 [option=value ...]
//   slice_sl1 --import part.sl1 [part.stl]
//   slice_sl1 --compare part.sl1 other.sl1
#include "libslic3r/Format/SL1.hpp"
#include "libslic3r/Format/STL.hpp"
#include "libslic3r/Model.hpp"
#include "libslic3r/PNGReadWrite.hpp"
#include "libslic3r/SLAPrint.hpp"
#include "libslic3r/TriangleMesh.hpp"
#include "libslic3r/miniz_extension.hpp"

#include <chrono>
#include <cstdio>
#include <cstring>

using namespace Slic3r;

namespace {

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void print_box(const BoundingBoxf3& box) {
  printf("\"min\": [%.4f, %.4f, %.4f], \"max\": [%.4f, %.4f, %.4f]", box.min.x(), box.min.y(),
         box.min.z(), box.max.x(), box.max.y(), box.max.z());
}

// Area of the walls and number of polygons of what is exposed.
void print_sections(const SLAPrint& print) {
  double walls = 0, volume = 0;
  size_t polygons = 0;
  const double height = print.default_object_config().layer_height.value;
  for (const SLAPrint::PrintLayer& layer : print.print_layers())
    for (const ExPolygon& polygon : layer.transformed_slices()) {
      ++polygons;
      volume += polygon.area() * SCALING_FACTOR * SCALING_FACTOR * height;
      for (size_t i = 0; i < polygon.num_contours(); ++i)
        walls += polygon.contour_or_hole(i).length() * SCALING_FACTOR * height;
    }
  printf("\"layers\": %zu, \"polygons\": %zu, \"volume_mm3\": %.3f, \"walls_mm2\": %.3f",
         print.print_layers().size(), polygons, volume, walls);
}

void slice(const char* stl, const std::string& sl1, char** options, int option_count) {
  TriangleMesh mesh;
  if (!mesh.ReadSTLFile(stl) || mesh.facets_count() == 0)
    throw RuntimeError(std::string("cannot read ") + stl);
  DynamicPrintConfig config;
  config.apply(SLAFullPrintConfig::defaults());
  for (int i = 0; i < option_count; ++i) {
    const char* is = strchr(options[i], '=');
    if (is == nullptr) throw RuntimeError(std::string(options[i]) + " is not option=value");
    config.set_deserialize_strict(std::string(options[i], size_t(is - options[i])), is + 1);
  }

  // In the middle of the display, whose x and y are those of the part also if images are portrait.
  const BoundingBoxf3 box = mesh.bounding_box();
  const double width = config.opt_float("display_width"),
               height = config.opt_float("display_height");
  Model model;
  ModelObject* object = model.add_object("part", "", mesh);
  object->add_instance();
  object->ensure_on_bed();
  object->instances.front()->set_offset(Vec3d(0.5 * width - box.center().x(),
                                              0.5 * height - box.center().y(),
                                              object->instances.front()->get_offset().z()));

  SLAPrint print;
  SL1Archive archive(print.printer_config());
  print.set_printer(&archive);
  print.set_status_silent();
  print.apply(model, config);
  if (const std::string error = print.validate(); !error.empty()) throw RuntimeError(error);
  const double start = seconds();
  print.process();
  const double process = seconds() - start;
  archive.export_print(sl1, print);
  printf("{");
  print_sections(print);
  printf(", \"process_s\": %.2f}\n", process);
}

void import_archive(const char* sl1, const char* stl) {
  indexed_triangle_set mesh;
  DynamicPrintConfig profile;
  const double start = seconds();
  import_sla_archive(sl1, Vec2i(2, 2), mesh, profile);
  const double process = seconds() - start;
  printf("{\"triangles\": %zu, \"volume_mm3\": %.3f, ", mesh.indices.size(),
         double(its_volume(mesh)));
  print_box(bounding_box(mesh));
  printf(", \"layer_height\": %g, \"settings\": %zu, \"process_s\": %.2f}\n",
         profile.opt_float("layer_height"), profile.keys().size(), process);
  if (stl != nullptr && !its_write_stl_binary(stl, "part", mesh.indices, mesh.vertices))
    throw RuntimeError(std::string("cannot write ") + stl);
}

// The images of an archive, in the order of their names, thumbnails left out.
class Images {
 public:
  explicit Images(const std::string& sl1) : name_(sl1) {
    if (!open_zip_reader(&zip_.arch, sl1)) throw RuntimeError("cannot read " + sl1);
    for (mz_uint i = 0; i < mz_zip_reader_get_num_files(&zip_.arch); ++i) {
      mz_zip_archive_file_stat entry;
      if (!mz_zip_reader_file_stat(&zip_.arch, i, &entry)) continue;
      const std::string name = entry.m_filename;
      if (name.find("thumbnail") == std::string::npos && name.size() > 4 &&
          name.compare(name.size() - 4, 4, ".png") == 0)
        places_.emplace(name, i);
    }
    for (const auto& [name, place] : places_) order_.push_back(place);
  }
  ~Images() { close_zip_reader(&zip_.arch); }
  size_t size() const { return order_.size(); }
  png::ImageGreyscale operator[](size_t i) {
    size_t bytes = 0;
    void* data = mz_zip_reader_extract_to_heap(&zip_.arch, order_[i], &bytes, 0);
    png::ImageGreyscale image;
    const bool is_read = data != nullptr && png::decode_png(png::ReadBuf{data, bytes}, image);
    mz_free(data);
    if (!is_read) throw RuntimeError("cannot read image " + std::to_string(i) + " of " + name_);
    return image;
  }

 private:
  std::string name_;
  MZ_Archive zip_;
  std::map<std::string, mz_uint> places_;
  std::vector<mz_uint> order_;
};

void compare(const char* first, const char* second) {
  Images a(first), b(second);
  if (a.size() != b.size())
    throw RuntimeError("archives of " + std::to_string(a.size()) + " and " +
                       std::to_string(b.size()) + " layers");
  std::array<size_t, 256> histogram{};
  double sums[2] = {0, 0};
  size_t grey = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    const png::ImageGreyscale p = a[i], q = b[i];
    if (p.rows != q.rows || p.cols != q.cols) throw RuntimeError("images of different sizes");
    for (size_t k = 0; k < p.buf.size(); ++k) {
      const int x = p.buf[k], y = q.buf[k];
      ++histogram[size_t(std::abs(x - y))];
      grey += (x > 0 && x < 255) || (y > 0 && y < 255);
      sums[0] += x;
      sums[1] += y;
    }
  }
  size_t greatest = 255, beyond = 0;
  while (greatest > 0 && histogram[greatest] == 0) --greatest;
  for (size_t d = 16; d < 256; ++d) beyond += histogram[d];  // 16/255 > 1/16
  printf(
      "{\"layers\": %zu, \"grey_pixels\": %zu, \"greatest\": %zu, \"beyond\": %zu, "
      "\"coverage\": [%.3f, %.3f], \"histogram\": [",
      a.size(), grey, greatest, beyond, sums[0] / 255, sums[1] / 255);
  for (size_t d = 0; d <= greatest; ++d) printf("%s%zu", d ? ", " : "", histogram[d]);
  puts("]}");
}

}  // namespace

int main(int argc, char** argv) {
  try {
    set_resources_dir(".");
    set_data_dir(".");
    const std::string first = argc > 1 ? argv[1] : "";
    if (first == "--import" && (argc == 3 || argc == 4))
      import_archive(argv[2], argc == 4 ? argv[3] : nullptr);
    else if (first == "--compare" && argc == 4)
      compare(argv[2], argv[3]);
    else if (argc >= 3 && first.compare(0, 2, "--") != 0)
      slice(argv[1], argv[2], argv + 3, argc - 3);
    else {
      fputs(
          "slice_sl1 part.stl part.sl1 [option=value ...]\n"
          "slice_sl1 --import part.sl1 [part.stl]\n"
          "slice_sl1 --compare part.sl1 other.sl1\n",
          stderr);
      return 2;
    }
  } catch (const std::exception& error) {
    fprintf(stderr, "slice_sl1: %s\n", error.what());
    return 1;
  }
  return 0;
}
