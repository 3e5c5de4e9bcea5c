// SPDX-License-Identifier: Apache-2.0
// Model files: any text is refused with a message or makes a model that answers, and that is the
// same model when it is written and read again.
#include <cstring>

#include "agree.h"

namespace msq::fuzz {

namespace {

Owner<msq_document> read(msq_context* context, std::string_view text, const Job& job) {
  msq_document_def def = make_def(msq_document_def_init);
  def.files = MSQ_DOCUMENT_FILES_NONE;
  def.max_bytes = 1 << 16;
  def.max_values = 4096;
  return make<msq_document>("msq_document_from_json", [&](msq_document** d) {
    return msq_document_from_json(context, text.data(), text.size(), &def, d, job);
  });
}

Owner<msq_model> model_of(const msq_document* document) {
  return make<msq_model>("msq_document_model",
                         [&](msq_model** m) { return msq_document_model(document, m); });
}

}  // namespace

void run_document(const uint8_t* data, size_t size) {
  const Owner<msq_context> context = make_context();
  const Job job;
  const Owner<msq_document> document =
      read(context.get(), {reinterpret_cast<const char*>(data), size}, job);
  if (!document) return;
  const Owner<msq_model> model = model_of(document.get());
  if (!model) wrong("a document has no model");

  msq_document_report report{};
  report.struct_size = sizeof report;
  if (!MSQ_FUZZ(msq_document_info, document.get(), &report)) wrong("a document has no report");
  msq_slicer_def slicing = make_def(msq_slicer_def_init);
  if (report.has_slicing) {
    if (!MSQ_FUZZ(msq_document_slicing, document.get(), &slicing))
      wrong("the slicing of a document is gone");
    (void)make<msq_slicer>("msq_slicer_create", [&](msq_slicer** s) {
      return msq_slicer_create(model.get(), &slicing, s);
    });
  }

  // Written and read again.
  msq_json_def json = make_def(msq_json_def_init);
  json.title = report.title;
  if (report.has_slicing) json.slicing = &slicing;
  uint64_t bytes = 0;
  uint8_t hash[16], again[16];
  if (MSQ_FUZZ(msq_model_to_json, model.get(), &json, nullptr, 0, &bytes) && bytes < 1 << 16) {
    std::string text(bytes, ' ');
    if (!MSQ_FUZZ(msq_model_to_json, model.get(), &json, text.data(), bytes, &bytes) ||
        bytes != text.size())
      wrong("a model was written in %zu bytes and not again", text.size());
    const Owner<msq_document> copy = read(context.get(), text, job);
    if (job.is_cancelled()) return;
    if (!copy) {
      // A definition of 4096 values may be written with more.
      if (!std::strstr(msq_error_message(), "limit"))
        wrong("what msq wrote is refused: %s\n%s", msq_error_message(), text.c_str());
      return;
    }
    const Owner<msq_model> other = model_of(copy.get());
    const bool has_hash = MSQ_FUZZ(msq_model_hash, model.get(), hash);
    if (has_hash != MSQ_FUZZ(msq_model_hash, other.get(), again) ||
        (has_hash && std::memcmp(hash, again, 16) != 0))
      wrong("a model that was written and read has another hash: %s", text.c_str());
  }

  // What it answers. Callbacks and files are not in it, so nothing is known but by the kinds of
  // objects.
  double length = 1;
  if (msq_model_scale_length(model.get(), 1, &length) != MSQ_OK) length = 1;
  Sight sight;
  sight.unit = length > 1e-60 && length < 1e60 ? length : 1;
  sight.part = 4;
  Input numbers(data, size < 64 ? size : 64);
  check_model(numbers, context.get(), model.get(), sight, job);
}

}  // namespace msq::fuzz
