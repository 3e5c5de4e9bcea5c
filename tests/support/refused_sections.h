// SPDX-License-Identifier: Apache-2.0
// Sections whose walls are too far away, or too many.
#pragma once

#include "base/status.h"
#include "msq_test.h"
#include "structure/structure.h"

namespace msq::test {

/// wall_lines() fails with Status::limit and a message that contains the text.
inline void check_section_is_refused(const Structure& structure, const WallSection& section,
                                     const char* text) {
  try {
    structure.wall_lines(section);
  } catch (const Error& error) {
    assert_int_equal(error.status, Status::limit);
    if (!strstr(error.what(), text)) fail_msg("%s", error.what());
    return;
  }
  fail_msg("not refused: %s", text);
}

/// Of a structure with cells of size 1. `cells`: what the message calls those of too wide a window.
inline void check_limits_of_sections(const Structure& structure, const char* cells) {
  check_section_is_refused(structure, {0, {{0, 0}, {3e7, 1}}, 1}, "the limit is 1.67772e+07 cells");
  check_section_is_refused(structure, {2e7, {{0, 0}, {1, 1}}, 1}, "axis 2");
  check_section_is_refused(structure, {0, {{0, 0}, {1e5, 1e5}}, 1}, cells);
}

}  // namespace msq::test
