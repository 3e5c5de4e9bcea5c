// SPDX-License-Identifier: Apache-2.0
// Images of a document: values in the text, files in NRRD and TIFF and raw files.
#include <cmath>
#include <limits>
#include <string_view>

#include "api/definitions.h"
#include "document/reader.h"
#include "io/image_file.h"

namespace msq::document {

namespace {

constexpr api::Choice byte_orders[] = {{"little", 0}, {"big", 1}};

constexpr struct {
  int32_t type;
  ValueType value_type;
} value_types[] = {{MSQ_UINT8, ValueType::uint8},
                   {MSQ_INT16, ValueType::int16},
                   {MSQ_UINT16, ValueType::uint16},
                   {MSQ_FLOAT32, ValueType::float32},
                   {MSQ_FLOAT64, ValueType::float64}};

bool is_tiff(std::string_view path) {
  for (const char* ending : {".tif", ".tiff", ".TIF", ".TIFF"})
    if (path.ends_with(ending)) return true;
  return false;
}

}  // namespace

void Reader::image(const char* key, msq_image& image, api::ImageSource& source) {
  const uint32_t found = find(key);
  if (!found) builder_.refuse(object_, Status::argument, std::string("has no key ") + key);
  Reader within(builder_, found, arena_);
  const uint32_t file = within.find("file");
  const uint32_t files = within.find("files");
  const uint32_t values = within.find("values");
  if (!file && !files && !values)
    builder_.refuse(found, Status::argument, "has neither file nor values, nor files");
  if ((file && values) || (files && (file || values)))
    builder_.refuse(found, Status::argument,
                    std::string("has both ") + (files ? "files" : "file") + " and " +
                        (values ? "values" : "file") + "; it must have one of them");
  within.choice("value_type", image.value_type, api::image_types);
  within.wholes("size", image.size, uint64_t{1} << 20);
  within.whole("skip_bytes", source.skip_bytes);
  within.choice("byte_order", source.is_big_endian, byte_orders);
  source.has_grid = within.section(
      "grid", false, [&](DefinitionWalk& of) { api::walk(of, image.grid); },
      [](DefinitionWalk&) {});
  within.finish();
  for (const char* of_raw : {"value_type", "size"})
    if (values && !tree_.member(found, of_raw))
      builder_.refuse(found, Status::argument, std::string("has no key ") + of_raw);
  for (const char* of_file : {"skip_bytes", "byte_order"})
    if (const uint32_t needless = tree_.member(found, of_file); values && needless)
      builder_.refuse(needless, Status::argument, "is for files; the values are in the document");
  if (values)
    within.read_values(values, image);
  else
    within.read_file(found, files ? files : file, image, source,
                     tree_.member(found, "value_type") || tree_.member(found, "size"));
}

/// Of a file or of each file of a list. Sets where the image comes from.
std::vector<std::string> Reader::image_paths(uint32_t value, api::ImageSource& source) {
  std::vector<std::string> paths;
  if (tree_[value].kind != JsonValue::Kind::list) {
    paths.push_back(builder_.path_of_file(value));
    source.file = arena_.keep(std::string(paths[0])).c_str();
    source.is_nrrd = paths[0].ends_with(".nrrd");
    source.is_tiff = is_tiff(paths[0]);
    return paths;
  }
  if (tree_[value].count == 0) builder_.refuse(value, Status::argument, "is an empty list");
  each(value, [&](uint32_t one) {
    paths.push_back(builder_.path_of_file(one));
    if (!is_tiff(paths.back()))
      builder_.refuse(one, Status::argument,
                      "is no TIFF file; the names in files end with .tif or .tiff");
  });
  const char** kept = arena_.take_array<const char*>(paths.size());
  for (size_t i = 0; i < paths.size(); ++i) kept[i] = arena_.keep(std::string(paths[i])).c_str();
  source.files = kept;
  source.file_count = paths.size();
  source.is_tiff = true;
  return paths;
}

void Reader::read_file(uint32_t object, uint32_t file, msq_image& image, api::ImageSource& source,
                       bool has_layout) {
  const std::vector<std::string> paths = image_paths(file, source);
  const bool says_layout = source.is_nrrd || source.is_tiff;
  ImageFileOptions options{builder_.bytes_left(), api::object(builder_.context(), "context").budget,
                           builder_.job() ? &api::object(builder_.job(), "job") : nullptr};
  if (says_layout && (has_layout || source.skip_bytes || source.is_big_endian))
    builder_.refuse(object, Status::argument,
                    "has value_type, size, skip_bytes or byte_order, which the file says itself");
  if (!says_layout && !(tree_.member(object, "value_type") && tree_.member(object, "size")))
    builder_.refuse(object, Status::argument,
                    "names a raw file without value_type and size; files in NRRD end with .nrrd, "
                    "TIFF with .tif or .tiff");
  try {
    ImageLayout layout;
    layout.skip_bytes = source.skip_bytes;
    layout.is_big_endian = source.is_big_endian != 0;
    for (const auto& known : value_types)
      if (known.type == image.value_type) layout.type = known.value_type;
    std::copy_n(image.size, 3, layout.size);
    const ImageFile& read =
        arena_.keep(source.is_nrrd   ? read_nrrd_file(paths[0], options)
                    : source.is_tiff ? read_tiff_files(paths, options)
                                     : read_raw_file(paths[0], layout, options));
    builder_.count_bytes(read.read_bytes);
    image.values = read.values();
    if (!says_layout) return;
    for (const auto& known : value_types)
      if (known.value_type == read.layout.type) image.value_type = known.type;
    std::copy_n(read.layout.size, 3, image.size);
    if (source.has_grid || source.is_tiff) return;
    std::copy_n(read.origin, 3, image.grid.origin);
    std::copy_n(read.spacing, 3, image.grid.cell_size);
    std::copy_n(read.rotation, 9, image.grid.rotation);
  } catch (const Error& error) {
    if (error.status == Status::cancelled) throw;
    builder_.refuse(file, error.status, error.what());
  }
}

void Reader::read_values(uint32_t list, msq_image& image) {
  uint64_t count = 1;
  for (uint64_t size : image.size) count = checked_product(count, size, "image.size");
  expect(list, JsonValue::Kind::list);
  if (tree_[list].count != count)
    builder_.refuse(list, Status::argument,
                    "has " + std::to_string(tree_[list].count) + " elements; the size asks for " +
                        std::to_string(count));
  const auto fill = [&]<class T>(T* values) {
    image.values = values;
    each(list, [&](uint32_t value) {
      const double number = number_of(value);
      if constexpr (std::is_integral_v<T>) {
        if (number != std::floor(number) || !(number >= double{std::numeric_limits<T>::lowest()} &&
                                              number <= double{std::numeric_limits<T>::max()}))
          builder_.refuse(value, Status::argument,
                          "must be a whole number from " +
                              std::to_string(std::numeric_limits<T>::lowest()) + " to " +
                              std::to_string(std::numeric_limits<T>::max()));
      }
      if constexpr (std::is_same_v<T, float>) {
        if (!(std::abs(number) <= double{std::numeric_limits<float>::max()}))
          builder_.refuse(value, Status::argument, "is beyond the numbers of float32");
      }
      *values++ = static_cast<T>(number);
    });
  };
  switch (image.value_type) {
    case MSQ_UINT8:
      return fill(arena_.take_array<uint8_t>(count));
    case MSQ_INT16:
      return fill(arena_.take_array<int16_t>(count));
    case MSQ_UINT16:
      return fill(arena_.take_array<uint16_t>(count));
    case MSQ_FLOAT32:
      return fill(arena_.take_array<float>(count));
    default:
      return fill(arena_.take_array<double>(count));
  }
}

}  // namespace msq::document
