// SPDX-License-Identifier: Apache-2.0
// Attributes that compilers spell in different ways.
#pragma once

// After a declaration: argument n is a format as of printf, and what it formats begins with
// argument `first`. Arguments count from 1, a method's object included.
#if defined(__MINGW32__)  // where "printf" means Microsoft's
#define MSQ_PRINTF_FORMAT(n, first) __attribute__((format(gnu_printf, n, first)))
#elif defined(__GNUC__)
#define MSQ_PRINTF_FORMAT(n, first) __attribute__((format(printf, n, first)))
#else
#define MSQ_PRINTF_FORMAT(n, first)
#endif

// Before a thread_local: it exists from the start of the thread, and not from its first touch,
// which may fail. Windows and macOS have no such models.
#if defined(__GNUC__) && defined(__ELF__)
#define MSQ_INITIAL_EXEC [[gnu::tls_model("initial-exec")]]
#else
#define MSQ_INITIAL_EXEC
#endif

// Before a function that is not inlined.
#if defined(__GNUC__)
#define MSQ_NOINLINE [[gnu::noinline]]
#elif defined(_MSC_VER)
#define MSQ_NOINLINE __declspec(noinline)
#else
#define MSQ_NOINLINE
#endif
