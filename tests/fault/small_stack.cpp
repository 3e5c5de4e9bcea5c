// SPDX-License-Identifier: Apache-2.0
#include "small_stack.h"

#include <pthread.h>
#include <sys/mman.h>

#include <cstring>
#include <string>

#include "stage.h"

namespace msq::test {

namespace {

constexpr size_t guard = size_t{1} << 20;
constexpr unsigned char pattern = 0xa5;

void* run(void* work) {
  (*static_cast<const std::function<void()>*>(work))();
  return nullptr;
}

}  // namespace

size_t run_on_stack(size_t bytes, const std::function<void()>& work) {
  void* mapped = mmap(nullptr, guard + bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  require(mapped != MAP_FAILED, "no memory for a stack");
  auto* const stack = static_cast<unsigned char*>(mapped) + guard;
  mprotect(stack, bytes, PROT_READ | PROT_WRITE);
  std::memset(stack, pattern, bytes);
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_t thread;
  int error = pthread_attr_setstack(&attributes, stack, bytes);
  if (error == 0)
    error = pthread_create(&thread, &attributes, run, const_cast<std::function<void()>*>(&work));
  if (error == 0) pthread_join(thread, nullptr);
  pthread_attr_destroy(&attributes);
  size_t untouched = 0;
  while (untouched < bytes && stack[untouched] == pattern) ++untouched;
  munmap(mapped, guard + bytes);
  require(error == 0, std::string("the thread cannot be started: ") + std::strerror(error));
  return bytes - untouched;
}

}  // namespace msq::test
