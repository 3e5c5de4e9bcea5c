// SPDX-License-Identifier: Apache-2.0
// The part of XML that 3MF and AMF use: elements, attributes and plain text. Entities are not
// expanded, and no other file is read.
#pragma once

#include <new>
#include <pugixml.hpp>
#include <string>
#include <string_view>

#include "base/status.h"

namespace msq {

class XmlDocument {
 public:
  XmlDocument(std::string content, const char* what) : content_(std::move(content)) {
    // Parsed in place: the tree points into content_.
    const pugi::xml_parse_result result = document_.load_buffer_inplace(
        content_.data(), content_.size(), pugi::parse_minimal, pugi::encoding_auto);
    if (result.status == pugi::status_out_of_memory) throw std::bad_alloc();
    if (!result)
      fail(Status::io, "%s: malformed XML at byte %lld: %s", what,
           static_cast<long long>(result.offset), result.description());
  }

  pugi::xml_node root() const { return document_.document_element(); }

 private:
  std::string content_;
  pugi::xml_document document_;
};

/// Name of an element or attribute without its namespace prefix.
inline std::string_view local_name(std::string_view name) {
  const size_t colon = name.rfind(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

}  // namespace msq
