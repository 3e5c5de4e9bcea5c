// SPDX-License-Identifier: Apache-2.0
// Rows of bits, cut with other rows.
#pragma once

#include <cstddef>
#include <cstdint>

namespace msq {

/// words[i] &= kept[i]. The two do not overlap.
void restrict_words(uint64_t* words, const uint64_t* kept, size_t count);
/// words[i] &= kept[i % period].
void restrict_words(uint64_t* words, const uint64_t* kept, size_t period, size_t count);

}  // namespace msq
