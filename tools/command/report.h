// SPDX-License-Identifier: Apache-2.0
// Results as lines for people or as JSON.
#ifndef MSQ_COMMAND_REPORT_H
#define MSQ_COMMAND_REPORT_H

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "arguments.h"

namespace command {

// Names with values, in the order in which they are added. Names have underscores for spaces. A
// number that is not finite is unknown: null in JSON.
class Report {
 public:
  Report();
  ~Report();
  Report(Report&&) noexcept;
  Report& operator=(Report&&) noexcept;

  void add(std::string_view name, double value);
  void add(std::string_view name, uint64_t value);
  void add(std::string_view name, bool value);
  void add(std::string_view name, std::string_view value);
  void add(std::string_view name, const char* value) { add(name, std::string_view(value)); }
  void add(std::string_view name, const double* values, size_t count);
  void add(std::string_view name, Report&& part);
  void add(std::string_view name, std::vector<Report>&& parts);

  // Prints to the file of --output, as --json says.
  void print(const Arguments& arguments) const;

 private:
  struct Values;
  std::unique_ptr<Values> values_;
};

}  // namespace command

#endif
