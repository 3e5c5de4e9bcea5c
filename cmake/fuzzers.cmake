# What MSQ_BUILD_FUZZERS needs: libFuzzer, which is a part of Clang.
if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang" OR MSVC)
  message(FATAL_ERROR "msq: MSQ_BUILD_FUZZERS needs Clang, but the compiler is ${CMAKE_CXX_COMPILER_ID}. "
                      "cmake --preset fuzz names Clang 14.")
endif()
if(BUILD_SHARED_LIBS)
  message(FATAL_ERROR "msq: MSQ_BUILD_FUZZERS needs BUILD_SHARED_LIBS=OFF: the parts of libFuzzer and of the "
                      "sanitizers are in the program that the library is linked into.")
endif()
include(CheckCXXSourceCompiles)
set(CMAKE_REQUIRED_FLAGS -fsanitize=fuzzer,address)
check_cxx_source_compiles("#include <cstddef>
#include <cstdint>
extern \"C\" int LLVMFuzzerTestOneInput(const uint8_t*, size_t) { return 0; }" MSQ_HAS_LIBFUZZER)
unset(CMAKE_REQUIRED_FLAGS)
if(NOT MSQ_HAS_LIBFUZZER)
  unset(MSQ_HAS_LIBFUZZER CACHE)  # looks again once the package is installed
  message(FATAL_ERROR "msq: MSQ_BUILD_FUZZERS needs libFuzzer and AddressSanitizer of Clang, and a program with "
                      "-fsanitize=fuzzer,address cannot be built (Debian: libclang-rt-14-dev).")
endif()
