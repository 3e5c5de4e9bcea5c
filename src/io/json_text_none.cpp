// SPDX-License-Identifier: Apache-2.0
// Stands in for json_text_nlohmann.cpp.
#include "base/status.h"
#include "io/json_text.h"

namespace msq {

namespace {

[[noreturn]] void refuse() {
  fail(Status::unsupported, "this build of msq has no documents (MSQ_WITH_JSON is off)");
}

}  // namespace

bool can_read_json() {
  return false;
}

JsonTree::JsonTree(std::string_view, const JsonLimits&, const Job*) {
  refuse();
}

std::string json_quoted(std::string_view) {
  refuse();
}

}  // namespace msq
