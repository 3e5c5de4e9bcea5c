// SPDX-License-Identifier: Apache-2.0
// A document: a model with settings for slices and pictures.
#pragma once

#include <string>
#include <string_view>

#include "api/definitions.h"
#include "api/guard.h"
#include "document/arena.h"
#include "document/builder.h"

namespace msq::document {

class Document final : public RefCounted {
 public:
  /// Throws Error with line, column and path.
  Document(std::string_view text, msq_context* context, const FileRules& rules,
           const JsonLimits& limits, msq_job* job);

  const Model& model() const { return *model_; }
  const std::string& title() const { return title_; }
  uint32_t files() const { return files_; }
  /// Null: none.
  const msq_slicer_def* slicing() const { return has_slicing_ ? &slicing_ : nullptr; }
  const api::ViewDef* view() const { return has_view_ ? &view_ : nullptr; }

 private:
  void read_view(Builder& builder, uint32_t value, const msq_model* model);

  Arena arena_;
  Ref<const Model> model_;
  std::string title_;
  uint32_t files_ = 0;
  bool has_slicing_ = false, has_view_ = false;
  msq_slicer_def slicing_;
  api::ViewDef view_;
};

/// Version of the format that this library reads and writes.
constexpr uint32_t document_version = 1;

}  // namespace msq::document

namespace msq::api {

template <>
struct ObjectOf<msq_document> {
  using type = document::Document;
};

}  // namespace msq::api
