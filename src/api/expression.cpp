// SPDX-License-Identifier: Apache-2.0
#include "api/expression.h"

#include "api/guard.h"

namespace msq::api {

Tape read_expression(const char* text, const msq_named_value* parameters,
                     uint64_t parameter_count) {
  constexpr uint64_t max_parameters = 1024;
  require(text, "expression");
  if (parameter_count > max_parameters)
    fail(Status::argument, "parameter_count is %llu; the limit is %llu",
         static_cast<unsigned long long>(parameter_count),
         static_cast<unsigned long long>(max_parameters));
  if (parameter_count) require(parameters, "parameters");
  std::vector<NamedValue> named;
  for (uint64_t i = 0; i < parameter_count; ++i) {
    const char* name = parameters[i].name;
    if (!name)
      fail(Status::argument, "the name of parameter %llu is NULL",
           static_cast<unsigned long long>(i));
    // No more of a name is looked at than could stand in an expression.
    named.push_back({std::string(name, strnlen(name, max_expression_bytes)),
                     require_finite(parameters[i].value, "the value of a parameter")});
  }
  // One byte more, so that a text that is too long is refused.
  return parse_expression({text, strnlen(text, max_expression_bytes + 1)}, named);
}

}  // namespace msq::api
