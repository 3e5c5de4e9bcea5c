// SPDX-License-Identifier: Apache-2.0
// Voxel images that documents name: TIFF in one file or two, NRRD, and raw values, whose bytes the
// fuzzer reads itself. The first byte selects which, the second is the threshold.
#include <unistd.h>

#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <utility>

#include "agree.h"

namespace msq::fuzz {

namespace {

/// A folder for the files of all inputs of the process.
class Folder {
 public:
  Folder() {
    const char* parent = std::getenv("TMPDIR");
    path_ = std::string(parent && *parent ? parent : "/tmp") + "/msq-fuzz-XXXXXX";
    if (!mkdtemp(path_.data())) wrong("no folder for files");
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() {
    for (const char* name : {"a.tif", "b.tif", "a.nrrd", "a.raw"})
      std::remove((path_ + "/" + name).c_str());
    rmdir(path_.c_str());
  }
  const std::string& path() const { return path_; }
  void write(const char* name, std::string_view bytes) const {
    std::FILE* file = std::fopen((path_ + "/" + name).c_str(), "wb");
    if (!file || std::fwrite(bytes.data(), 1, bytes.size(), file) != bytes.size() ||
        std::fclose(file) != 0)
      wrong("no file %s", name);
  }

 private:
  std::string path_;
};

/// Raw values and what a document says of them.
struct Raw {
  struct Type {
    int32_t value;
    size_t bytes;
    const char* name;
  };
  static constexpr Type types[] = {{MSQ_UINT8, 1, "uint8"},
                                   {MSQ_INT16, 2, "int16"},
                                   {MSQ_UINT16, 2, "uint16"},
                                   {MSQ_FLOAT32, 4, "float32"},
                                   {MSQ_FLOAT64, 8, "float64"}};
  const Type* type;
  uint64_t size[3];
  uint64_t skipped;
  bool is_big_endian;

  explicit Raw(Input& input)
      : type(&types[input.below(std::size(types))]),
        size{1 + input.below(6), 1 + input.below(6), 1 + input.below(6)},
        skipped(input.below(4)),
        is_big_endian(input.below(2) == 1) {}

  std::string json() const {
    char text[200];
    std::snprintf(text, sizeof text,
                  "\"file\": \"a.raw\", \"value_type\": \"%s\", \"size\": [%u, %u, %u], "
                  "\"skip_bytes\": %u, \"byte_order\": \"%s\"",
                  type->name, static_cast<unsigned>(size[0]), static_cast<unsigned>(size[1]),
                  static_cast<unsigned>(size[2]), static_cast<unsigned>(skipped),
                  is_big_endian ? "big" : "little");
    return text;
  }
  /// The shape of the values, as this program reads them; NULL where msq refuses it.
  Owner<msq_shape> shape(msq_context* context, std::string_view bytes, double threshold) const {
    const size_t count = size[0] * size[1] * size[2], width = type->bytes;
    if (bytes.size() != skipped + count * width) return nullptr;
    std::vector<unsigned char> values(
        bytes.begin() + static_cast<ptrdiff_t>(skipped),
        bytes.begin() + static_cast<ptrdiff_t>(skipped + count * width));
    if (is_big_endian != (std::endian::native == std::endian::big))
      for (size_t i = 0; i < count; ++i)
        for (size_t b = 0; b < width / 2; ++b)
          std::swap(values[i * width + b], values[(i + 1) * width - 1 - b]);
    msq_voxels_def def = make_def(msq_voxels_def_init);
    def.image.values = values.data();
    def.image.value_type = type->value;
    for (int axis = 0; axis < 3; ++axis) def.image.size[axis] = size[axis];
    def.threshold = threshold;
    return make<msq_shape>("msq_shape_from_voxels",
                           [&](msq_shape** s) { return msq_shape_from_voxels(context, &def, s); });
  }
};

Owner<msq_model> model_of(const msq_document* document) {
  return make<msq_model>("msq_document_model",
                         [&](msq_model** m) { return msq_document_model(document, m); });
}

/// False in builds without hashes.
bool hash_of(const msq_model* model, uint8_t hash[16]) {
  return MSQ_FUZZ(msq_model_hash, model, hash);
}

/// Written and read again, the model is the same.
void check_copy(const Owner<msq_context>& context, const msq_model* model, const Folder& folder,
                const Job& job) {
  uint64_t bytes = 0;
  uint8_t hash[16], again[16];
  if (!hash_of(model, hash) || !MSQ_FUZZ(msq_model_to_json, model, nullptr, nullptr, 0, &bytes) ||
      bytes > 1 << 18)
    return;
  std::string text(bytes, ' ');
  if (!MSQ_FUZZ(msq_model_to_json, model, nullptr, text.data(), bytes, &bytes) ||
      bytes != text.size())
    wrong("a model was written in %zu bytes and not again", text.size());
  msq_document_def def = make_def(msq_document_def_init);
  def.files = MSQ_DOCUMENT_FILES_ANY;  // it names them by their whole paths
  def.base_directory = folder.path().c_str();
  const Owner<msq_document> document =
      make<msq_document>("msq_document_from_json", [&](msq_document** d) {
        return msq_document_from_json(context.get(), text.data(), text.size(), &def, d, job);
      });
  if (job.is_cancelled()) return;
  if (!document) {
    if (std::strstr(msq_error_message(), "memory_limit")) return;
    wrong("what msq wrote is refused: %s\n%s", msq_error_message(), text.c_str());
  }
  const Owner<msq_model> copy = model_of(document.get());
  if (!copy || !hash_of(copy.get(), again) || std::memcmp(hash, again, 16) != 0)
    wrong("a model that was written and read has another hash: %s", text.c_str());
}

}  // namespace

void run_image_file(const uint8_t* data, size_t size) {
  static const Folder folder;
  Input input(data, size);
  const uint32_t kind = input.below(4);
  const double threshold = input.byte();
  const Owner<msq_context> context = make_context();
  const Job job;
  std::string image;
  Owner<msq_shape> wanted;
  if (kind == 0) {
    folder.write("a.tif", input.rest());
    image = "\"file\": \"a.tif\"";
  } else if (kind == 1) {
    const uint64_t split = input.word(2);
    const std::string_view bytes = input.rest();
    folder.write("a.tif", bytes.substr(0, split));
    folder.write("b.tif", bytes.substr(split < bytes.size() ? split : 0));
    image = "\"files\": [\"a.tif\", \"b.tif\"]";
  } else if (kind == 2) {
    folder.write("a.nrrd", input.rest());
    image = "\"file\": \"a.nrrd\"";
  } else {
    const Raw raw(input);
    const std::string_view bytes = input.rest();
    folder.write("a.raw", bytes);
    image = raw.json();
    wanted = raw.shape(context.get(), bytes, threshold);
  }
  const std::string text =
      "{\"msq_model\": 1, \"scales\": [{\"shape\": {\"voxels\": {\"image\": {" + image +
      "}, \"threshold\": " + std::to_string(static_cast<int>(threshold)) + "}}}]}";
  msq_document_def def = make_def(msq_document_def_init);
  def.base_directory = folder.path().c_str();
  def.max_file_bytes = 1 << 20;
  const Owner<msq_document> document =
      make<msq_document>("msq_document_from_json", [&](msq_document** d) {
        return msq_document_from_json(context.get(), text.data(), text.size(), &def, d, job);
      });
  if (job.is_cancelled()) return;
  if (!document) {
    if (wanted) wrong("a raw file is refused: %s\n%s", msq_error_message(), text.c_str());
    return;
  }
  const Owner<msq_model> model = model_of(document.get());
  if (!model) wrong("a document has no model");
  if (kind == 3) {
    if (!wanted) wrong("a raw file is read whose values are refused: %s", text.c_str());
    msq_scale_def scale = {};
    scale.shape = wanted.get();
    msq_model_def model_def = make_def(msq_model_def_init);
    model_def.scales = &scale;
    model_def.scale_count = 1;
    const Owner<msq_model> other = make<msq_model>("msq_model_create", [&](msq_model** m) {
      return msq_model_create(context.get(), &model_def, m);
    });
    uint8_t hash[16], again[16];
    if (other && hash_of(model.get(), hash) &&
        (!hash_of(other.get(), again) || std::memcmp(hash, again, 16) != 0))
      wrong("a raw file has other values: %s", text.c_str());
  }
  check_copy(context, model.get(), folder, job);

  double low[3], high[3];
  if (!MSQ_FUZZ(msq_model_bounds, model.get(), low, high)) wrong("a model has no bounds");
  Sight sight;
  double side = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(low[axis]) || !(low[axis] <= high[axis]))
      wrong("bounds %g to %g", low[axis], high[axis]);
    sight.at[axis] = 0.5 * low[axis] + 0.5 * high[axis];
    side = std::fmax(side, high[axis] - low[axis]);
  }
  sight.unit = side > 1e-60 && side < 1e60 ? 0.25 * side : 1;
  sight.part = 0.25;
  Input numbers(data, size < 64 ? size : 64);
  check_model(numbers, context.get(), model.get(), sight, job);
}

}  // namespace msq::fuzz
