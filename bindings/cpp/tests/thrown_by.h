// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <exception>
#include <string>

#include "msq_test.h"

/// The message of what a call throws.
template <class Call>
std::string thrown_by(Call&& call) {
  try {
    call();
  } catch (const std::exception& error) {
    return error.what();
  }
  fail_msg("nothing was thrown");
  return "";
}
