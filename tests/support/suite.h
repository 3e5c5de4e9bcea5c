// SPDX-License-Identifier: Apache-2.0
// One CMocka test for each row of a table, named after it.
#pragma once

#include <string>
#include <vector>

#include "msq_test.h"

namespace msq::test {

/// Runs test(state) with *state pointing to each row in turn. Row has a string member `name`.
template <class Row>
int run_for_each(const char* group, std::vector<Row>& rows, CMUnitTestFunction test) {
  std::vector<CMUnitTest> tests;
  for (Row& row : rows) tests.push_back({row.name.c_str(), test, nullptr, nullptr, &row});
  return _cmocka_run_group_tests(group, tests.data(), tests.size(), nullptr, nullptr);
}

}  // namespace msq::test
