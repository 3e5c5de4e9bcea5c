// SPDX-License-Identifier: Apache-2.0
// Memory of the whole process that fails when told to: malloc and its kin are replaced in the
// test's program, and all libraries use them. Sanitizers have replacements of their own; there
// operator new and delete are replaced alone, so that what C libraries and Highway allocate does
// not fail. Not reached: what oneTBB takes from its own allocator, and stacks of threads.
#pragma once

#include <cstdint>

namespace msq::test {

enum class Failing { once, from_then_on };

/// Counts allocations of all threads from now on, from 1, and has number k fail, alone or with all
/// that follow. k = 0: none fails.
void arm(uint64_t k, Failing failing);
/// No allocation fails any more. Returns how many there were.
uint64_t disarm();

/// Blocks that are held, and the bytes that they have room for.
int64_t live_blocks();
int64_t live_bytes();
/// The most bytes that were held at once since forget_peak().
int64_t peak_bytes();
void forget_peak();

/// Whether all allocations can fail.
extern const bool replaces_malloc;

}  // namespace msq::test
