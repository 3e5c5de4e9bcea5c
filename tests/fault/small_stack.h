// SPDX-License-Identifier: Apache-2.0
// Work on a thread with a stack of a given size.
#pragma once

#include <cstddef>
#include <functional>

namespace msq::test {

/// Runs work() on a thread whose stack has so many bytes, a multiple of the page size, the thread's
/// own part (TLS) included. Returns how many of them were written to. Throws Failure if the thread
/// cannot be started. What overflows the stack ends the process.
size_t run_on_stack(size_t bytes, const std::function<void()>& work);

}  // namespace msq::test
