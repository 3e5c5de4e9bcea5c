// SPDX-License-Identifier: Apache-2.0
// Integers of 128 bits, for exact products of 64-bit integers.
#pragma once

#if defined(__SIZEOF_INT128__)
namespace msq {
__extension__ using Int128 = __int128;
}
#else  // Visual C++
#include <__msvc_int128.hpp>
namespace msq {
using Int128 = std::_Signed128;
}
#endif
