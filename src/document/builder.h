// SPDX-License-Identifier: Apache-2.0
// Makes the objects of a document, by the functions of msq.h.
#pragma once

#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "api/guard.h"
#include "document/arena.h"
#include "io/json_text.h"

namespace msq::document {

/// Files that a document may name, and how large they may be.
struct FileRules {
  int32_t allowed = MSQ_DOCUMENT_FILES_BELOW;
  std::string base;  ///< directory of relative paths; "": none
  bool has_base = false;
  uint32_t max_files;
  uint64_t max_bytes, max_triangles;
};

/// A kind of object, by its key in the document.
template <class Handle>
struct KindOf;

class Builder {
 public:
  Builder(const JsonTree& tree, msq_context* context, const FileRules& rules, msq_job* job)
      : tree_(tree), context_(context), rules_(rules), job_(job) {}
  ~Builder();
  Builder(const Builder&) = delete;
  Builder& operator=(const Builder&) = delete;

  const JsonTree& tree() const { return tree_; }
  msq_context* context() const { return context_; }
  msq_job* job() const { return job_; }

  /// Builds all named definitions, also those that nothing uses, so that their errors show.
  void build_named();
  /// The handle of a value: an object with the name of a kind as its key, or the name of a
  /// definition. The builder owns it.
  const msq_shape* shape(uint32_t value);
  const msq_field* field(uint32_t value);
  const msq_structure* structure(uint32_t value);
  const msq_material* material(uint32_t value);
  /// A model of scales or regions. `others`: keys of the same object that are not of the model.
  const msq_model* model(uint32_t value, const std::vector<std::string>& others = {});

  /// The path of a file that the document names, once the rules allow it.
  std::string path_of_file(uint32_t value);
  /// What may still be read from files.
  uint64_t bytes_left() const { return rules_.max_bytes - bytes_; }
  uint64_t max_triangles() const { return rules_.max_triangles; }
  /// Counts a file that was read.
  void count_bytes(uint64_t bytes) { bytes_ += std::min(bytes, bytes_left()); }
  uint32_t files() const { return files_; }

  /// Throws Error with line, column and path of a value.
  [[noreturn]] void refuse(uint32_t value, Status status, const std::string& why) const;
  /// The same for a function of msq that failed on an object: at the member that its message begins
  /// with, if it is one.
  [[noreturn]] void refuse_call(uint32_t object, msq_status status) const;

 private:
  template <class Handle>
  const Handle* handle(uint32_t value, const char* section, std::span<const KindOf<Handle>> kinds);
  /// The definition of a name in a section; 0: none.
  uint32_t definition(const char* section, const std::string& name);
  template <class Handle>
  const Handle* make(uint32_t value, std::span<const KindOf<Handle>> kinds);
  template <class Handle>
  const Handle* hold(Handle* handle);

  const JsonTree& tree_;
  msq_context* context_;
  const FileRules& rules_;
  msq_job* job_;
  uint64_t bytes_ = 0;
  uint32_t files_ = 0;
  unsigned depth_ = 0;  ///< definitions within each other
  /// The names of each section in which a name was looked up, so that many names are found quickly.
  std::unordered_map<std::string_view, std::unordered_map<std::string_view, uint32_t>> names_;
  /// Named definitions by their values; null: under construction.
  std::unordered_map<uint32_t, const void*> named_;
  std::vector<std::pair<void*, void (*)(void*)>> held_;  ///< with what releases them
};

}  // namespace msq::document
