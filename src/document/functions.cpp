// SPDX-License-Identifier: Apache-2.0
// The functions of msq.h for documents.
#include "document/document.h"
#include "document/writer.h"
#include "io/whole_file.h"

using namespace msq;
using namespace msq::api;
using namespace msq::document;

namespace {

constexpr uint64_t default_bytes = uint64_t{64} << 20, default_file_bytes = uint64_t{4} << 30,
                   default_values = 8000000, default_triangles = 200000000,
                   default_numbers = 1000000;
constexpr uint32_t default_depth = 64, max_depth = 1024, default_files = 256;

msq_document_def document_defaults() {
  msq_document_def def{};
  def.max_bytes = default_bytes;
  def.max_values = default_values;
  def.max_depth = default_depth;
  def.max_files = default_files;
  def.max_file_bytes = default_file_bytes;
  def.max_triangles = default_triangles;
  return def;
}

msq_json_def json_defaults() {
  msq_json_def def{};
  def.max_numbers = default_numbers;
  return def;
}

template <class T>
T or_default(T value, T otherwise) {
  return value ? value : otherwise;
}

void require_json() {
  if (!can_read_json())
    fail(Status::unsupported, "this build of msq has no documents (MSQ_WITH_JSON is off)");
}

/// A definition with 0 replaced by the defaults, and its limits.
struct Request {
  explicit Request(const msq_document_def* given) {
    const msq_document_def def =
        given ? read_def(given, document_defaults(), "def") : document_defaults();
    rules.allowed =
        require_range(def.files, MSQ_DOCUMENT_FILES_BELOW, MSQ_DOCUMENT_FILES_ANY, "files");
    if (def.max_depth > max_depth)
      fail(Status::argument, "max_depth is %u; it must be at most %u", def.max_depth, max_depth);
    rules.has_base = def.base_directory;
    if (def.base_directory) rules.base = def.base_directory;
    rules.max_files = or_default(def.max_files, default_files);
    rules.max_bytes = or_default(def.max_file_bytes, default_file_bytes);
    rules.max_triangles = or_default(def.max_triangles, default_triangles);
    limits.max_values = or_default(def.max_values, default_values);
    limits.max_depth = or_default(def.max_depth, default_depth);
    max_bytes = or_default(def.max_bytes, default_bytes);
  }
  void check_size(uint64_t bytes) const {
    if (bytes > max_bytes)
      fail(Status::limit, "the document has %llu bytes; max_bytes is %llu",
           static_cast<unsigned long long>(bytes), static_cast<unsigned long long>(max_bytes));
  }

  FileRules rules;
  JsonLimits limits;
  uint64_t max_bytes;
};

msq_document* make_document(std::string_view text, msq_context* context, const Request& request,
                            msq_job* job) {
  return new_handle<msq_document>(
      make_ref<Document>(text, context, request.rules, request.limits, job));
}

/// The outputs of a host's definition, as this version knows them.
void read_outputs(msq_slicer_def& def, std::vector<msq_output_def>& outputs,
                  std::vector<msq_contours_def>& contours) {
  if (!def.outputs) return;
  msq_output_def defaults;
  msq_output_def_init(&defaults, sizeof defaults);
  msq_contours_def of_contours;
  msq_contours_def_init(&of_contours, sizeof of_contours);
  constexpr uint32_t max_outputs = 64;
  if (def.output_count > max_outputs)
    fail(Status::argument, "slicing.output_count is %u; it must be at most %u", def.output_count,
         max_outputs);
  contours.reserve(def.output_count);
  const size_t stride = def.outputs->struct_size;
  for (uint32_t i = 0; i < def.output_count; ++i) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(def.outputs) + i * stride;
    outputs.push_back(
        read_def(reinterpret_cast<const msq_output_def*>(bytes), defaults, "slicing.outputs"));
    msq_output_def& output = outputs.back();
    if (!output.contours) continue;
    contours.push_back(read_def(output.contours, of_contours, "slicing.outputs.contours"));
    output.contours = &contours.back();
  }
  def.outputs = outputs.data();
}

Output write_slicing(ModelWriter& writer, const msq_slicer_def& given) {
  msq_slicer_def def = read_def(&given, defaults_of<msq_slicer_def>(), "slicing");
  std::vector<msq_output_def> outputs;
  std::vector<msq_contours_def> contours;
  read_outputs(def, outputs, contours);
  const ModelWriter::Within within(writer, "slicing");
  return writer.members_of(def);
}

Output write_view(ModelWriter& writer, const msq_camera* camera, const msq_render_def* render) {
  if (!camera || !render)
    fail(Status::argument, "%s is NULL, but %s is given", camera ? "render" : "camera",
         camera ? "camera" : "render");
  ViewDef def = defaults_of<ViewDef>();
  def.camera = read_def(camera, def.camera, "camera");
  def.render = read_def(render, def.render, "render");
  const ModelWriter::Within within(writer, "view");
  return writer.members_of(def);
}

std::string json_of(const Model& model, const msq_json_def& def) {
  const WriterOptions options{def.base_directory ? def.base_directory : "",
                              or_default(def.max_numbers, default_numbers)};
  ModelWriter writer(options);
  Output document;
  document.add("msq_model", Output::of_raw(std::to_string(document_version)));
  if (def.title) document.add("title", Output::of_raw(writer.text("title", def.title)));
  writer.write(model, document);
  if (def.slicing) document.add("slicing", write_slicing(writer, *def.slicing));
  if (def.camera || def.render) document.add("view", write_view(writer, def.camera, def.render));
  return document.print();
}

}  // namespace

msq_status msq_document_def_init(msq_document_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, document_defaults(), "msq_document_def"); });
}

msq_status msq_document_from_json(msq_context* context, const char* text, uint64_t bytes,
                                  const msq_document_def* def, msq_document** document,
                                  msq_job* job) {
  return guard([&] {
    const Ref<const Context> keep(&object(context, "context"));
    require(text, "text");
    require(document, "document");
    const Request request(def);
    require_json();
    request.check_size(bytes);
    Job* work = job ? &object(job, "job") : nullptr;
    JobScope scope(work);
    msq_document* made = make_document({text, bytes}, context, request, job);
    scope.done();
    *document = made;
  });
}

msq_status msq_document_from_file(msq_context* context, const char* path,
                                  const msq_document_def* def, msq_document** document,
                                  msq_job* job) {
  return guard([&] {
    const Ref<const Context> keep(&object(context, "context"));
    require(path, "path");
    require(document, "document");
    Request request(def);
    require_json();
    Job* work = job ? &object(job, "job") : nullptr;
    JobScope scope(work);
    if (!request.rules.has_base) {
      const std::string whole(path);
      const size_t slash = whole.find_last_of(
#ifdef _WIN32
          "/\\"
#else
          '/'
#endif
      );
      request.rules.has_base = true;
      request.rules.base = slash == std::string::npos ? "" : whole.substr(0, slash + 1);
    }
    const FileContent content =
        read_whole_file(path, work, [&](uint64_t bytes) { request.check_size(bytes); });
    msq_document* made = nullptr;
    try {
      made = make_document(content.view(), context, request, job);
    } catch (const Error& error) {
      if (error.status == Status::cancelled) throw;
      throw Error(error.status, shown(path) + ":" + error.what());
    }
    scope.done();
    *document = made;
  });
}

void msq_document_retain(msq_document* document) {
  retain(document);
}
void msq_document_release(msq_document* document) {
  release(document);
}

msq_status msq_document_info(const msq_document* document, msq_document_report* report) {
  return guard([&] {
    const Document& known = object(document, "document");
    msq_document_report found{};
    found.version = document_version;
    found.has_slicing = known.slicing() != nullptr;
    found.has_view = known.view() != nullptr;
    found.files = known.files();
    found.title = known.title().c_str();
    write_report(report, found, "report");
  });
}

msq_status msq_document_model(const msq_document* document, msq_model** model) {
  return guard([&] {
    const Document& known = object(document, "document");
    require(model, "model");
    known.model().retain();
    *model = reinterpret_cast<msq_model*>(const_cast<Model*>(&known.model()));
  });
}

msq_status msq_document_slicing(const msq_document* document, msq_slicer_def* def) {
  return guard([&] {
    const Document& known = object(document, "document");
    require(def, "def");
    check_struct_size<msq_slicer_def>(def->struct_size, "def");
    if (!known.slicing()) fail(Status::argument, "the document has no slicing");
    set_defaults(def, def->struct_size, *known.slicing(), "def");
  });
}

msq_status msq_document_view(const msq_document* document, msq_camera* camera,
                             msq_render_def* render) {
  return guard([&] {
    const Document& known = object(document, "document");
    check_struct_size<msq_camera>(require(camera, "camera").struct_size, "camera");
    check_struct_size<msq_render_def>(require(render, "render").struct_size, "render");
    if (!known.view()) fail(Status::argument, "the document has no view");
    set_defaults(camera, camera->struct_size, known.view()->camera, "camera");
    set_defaults(render, render->struct_size, known.view()->render, "render");
  });
}

msq_status msq_json_def_init(msq_json_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, json_defaults(), "msq_json_def"); });
}

msq_status msq_model_to_json(const msq_model* model, const msq_json_def* def, char* text,
                             uint64_t room, uint64_t* bytes) {
  return guard([&] {
    const Model& known = object(model, "model");
    const msq_json_def options = def ? read_def(def, json_defaults(), "def") : json_defaults();
    require_reserved(options.reserved, "reserved");
    require(bytes, "bytes");
    if (room > 0) require(text, "text");
    require_json();
    const std::string json = json_of(known, options);
    if (room > 0 && room < json.size())
      fail(Status::argument, "room is %llu; the text has %zu bytes",
           static_cast<unsigned long long>(room), json.size());
    if (room > 0) std::copy(json.begin(), json.end(), text);
    if (room > json.size()) text[json.size()] = '\0';
    *bytes = json.size();
  });
}
