// SPDX-License-Identifier: Apache-2.0
// Messages as one line of UTF-8. msq_io includes this file too, so it includes nothing of msq.
#pragma once

#include <cstddef>
#include <cstring>

namespace msq {

/// Bytes of the UTF-8 character that begins here; 0 if it is not one.
inline size_t character_length(const unsigned char* s) {
  const size_t length = s[0] < 0x80                   ? 1
                        : s[0] >= 0xc2 && s[0] < 0xe0 ? 2
                        : (s[0] & 0xf0) == 0xe0       ? 3
                        : s[0] >= 0xf0 && s[0] < 0xf5 ? 4
                                                      : 0;
  for (size_t i = 1; i < length; ++i)
    if ((s[i] & 0xc0) != 0x80) return 0;
  if ((s[0] == 0xe0 && s[1] < 0xa0) || (s[0] == 0xed && s[1] > 0x9f) ||
      (s[0] == 0xf0 && s[1] < 0x90) || (s[0] == 0xf4 && s[1] > 0x8f))
    return 0;  // overlong, a surrogate, or beyond Unicode
  return length;
}

/// Copies whole characters as far as they fit. Bytes that are none, as paths may have, become '?',
/// and so do control characters, which names in files may have: a message is one line in any log or
/// terminal.
inline void copy_one_line(const char* from, char* to, size_t room) {
  const auto* s = reinterpret_cast<const unsigned char*>(from);
  size_t used = 0;
  while (*s) {
    const size_t length = character_length(s), taken = length ? length : 1;
    if (used + taken >= room) break;
    if (length && *s >= ' ' && *s != 0x7f)
      std::memcpy(to + used, s, length);
    else
      to[used] = '?';
    used += taken;
    s += taken;
  }
  to[used] = 0;
}

}  // namespace msq
