// SPDX-License-Identifier: Apache-2.0
// Memory that fails while a file is read, in msq and in the libraries that it reads with, is an
// error of memory and no other, and what was read so far is given back.
#include <errno.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <new>

#include "io/zip_package.h"
#include "mesh_file_fixtures.h"

#if defined(__SANITIZE_ADDRESS__) || !defined(__GLIBC__)

int main() {
  return 0;  // this allocator, or none that can be replaced so
}

#else

namespace {

// Which allocation fails, counted from 1; 0: none.
long failing = 0;
bool all_after = false;
long allocations = 0, living = 0;

bool fails() {
  ++allocations;
  if (!failing || (all_after ? allocations < failing : allocations != failing)) return false;
  errno = ENOMEM;
  return true;
}

template <class T>
T* count(T* made) {
  if (made) ++living;
  return made;
}

}  // namespace

extern "C" {
void* __libc_malloc(size_t);
void* __libc_calloc(size_t, size_t);
void* __libc_realloc(void*, size_t);
void __libc_free(void*);

void* malloc(size_t bytes) {
  return fails() ? nullptr : count(__libc_malloc(bytes));
}
void* calloc(size_t n, size_t bytes) {
  return fails() ? nullptr : count(__libc_calloc(n, bytes));
}
void* realloc(void* old, size_t bytes) {
  if (!old) return malloc(bytes);
  return fails() ? nullptr : __libc_realloc(old, bytes);
}
void free(void* memory) {
  if (memory) --living;
  __libc_free(memory);
}
}

namespace {

using namespace mesh_file_fixtures;
using msq::ZipPackage;

enum class Outcome { read, out_of_memory };

/// Reads with that allocation failing, and says how many were not given back.
Outcome read_failing(const std::function<TriangleSoup()>& read, long which, bool and_all_after,
                     size_t triangles, long& lost) {
  Outcome outcome = Outcome::read;
  std::string wrong;  // told when memory is there again
  wrong.reserve(1000);
  const long before = living;
  allocations = 0;
  failing = which;
  all_after = and_all_after;
  try {
    const size_t got = read().triangles.size();
    failing = 0;
    if (got != triangles) wrong = text("%zu triangles", got);
  } catch (const std::bad_alloc&) {
    outcome = Outcome::out_of_memory;
  } catch (const msq::Error& error) {
    failing = 0;
    if (error.status == Status::memory)
      outcome = Outcome::out_of_memory;
    else
      wrong = text("status %d: %s", static_cast<int>(error.status), error.what());
  }
  failing = 0;
  lost = living - before;
  if (!wrong.empty())
    fail_msg("allocation %ld%s failed: %s", which, and_all_after ? " on" : "", wrong.c_str());
  return outcome;
}

void assert_memory_errors(const Sample& sample, const std::function<TriangleSoup()>& read) {
  const char* const name = sample.name;
  // minizip 1.1 loses its buffer where zlib gets no memory to begin with.
  const long may_lose = ZipPackage::is_zip(sample.content);
  const size_t triangles = read().triangles.size();  // what libraries keep for good is there now
  allocations = 0;
  read();
  const long all = allocations;
  for (const bool and_all_after : {false, true})
    for (long which = 1; which <= all; ++which) {
      long lost = 0;
      const Outcome outcome = read_failing(read, which, and_all_after, triangles, lost);
      if (and_all_after && outcome != Outcome::out_of_memory)
        fail_msg("%s: allocations %ld on are not needed", name, which);
      if (lost > may_lose) fail_msg("%s: allocation %ld failed, %ld were lost", name, which, lost);
    }
}

/// Assimp 5.2.5 frees what it has not set, or loses it, where one of its own allocations fails.
bool is_read_by_assimp(const Sample& sample) {
  return sample.name == std::string("binary.STL");
}

void failing_memory_is_told_as_such(void**) {
  for (const Sample& sample : samples()) {
    if (is_read_by_assimp(sample)) continue;
    const MeshFileOptions options = options_for(sample.format);
    assert_memory_errors(sample, [&] { return read(sample.content, options); });
  }
}

void failing_memory_of_files_is_told_as_such(void**) {
  for (const Sample& sample : samples()) {
    if (is_read_by_assimp(sample)) continue;
    const std::string path = folder().write(sample.name, sample.content);
    assert_memory_errors(sample, [&] { return msq::read_mesh_file(path, {}); });
  }
}

/// Bytes of address space that this process has.
rlim_t address_space() {
  std::FILE* file = fopen("/proc/self/statm", "r");
  assert_non_null(file);
  unsigned long pages = 0;
  assert_int_equal(fscanf(file, "%lu", &pages), 1);
  fclose(file);
  return pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}

/// Takes all memory that this process may still have, and gives back about that much.
bool leave_memory(size_t bytes) {
  struct Block {
    Block* next;
    char rest[248];
  };
  const rlimit limit = {address_space(), RLIM_INFINITY};
  if (setrlimit(RLIMIT_AS, &limit) != 0) return false;
  Block* taken = nullptr;
  while (auto* block = static_cast<Block*>(malloc(sizeof(Block)))) {
    std::memset(block->rest, 0x55, sizeof block->rest);
    block->next = taken;
    taken = block;
  }
  for (size_t given = 0; given < bytes && taken; given += sizeof(Block)) {
    Block* const block = taken;
    taken = block->next;
    free(block);
  }
  return true;
}

/// So Assimp is shown a file only where there is room for what it takes.
void assimp_is_not_left_without_memory(void**) {
  const std::string file = stl_binary();
  const MeshFileOptions options = options_for(MeshFormat::stl);
  read(file, options);  // what libraries keep for good is there now
  int refused = 0, read_all = 0;
  const auto try_with = [&](size_t room, bool is_limited) {
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
      if (is_limited && !leave_memory(room)) _exit(3);
      try {
        _exit(read(file, options).triangles.size() == 12 ? 0 : 2);
      } catch (const std::bad_alloc&) {
        _exit(1);
      } catch (...) {
        _exit(2);
      }
    }
    int status = 0;
    assert_int_equal(waitpid(child, &status, 0), child);
    if (!WIFEXITED(status) || WEXITSTATUS(status) > 1)
      fail_msg("with room for %zu bytes: status %x", room, static_cast<unsigned>(status));
    ++(WEXITSTATUS(status) ? refused : read_all);
  };
  for (size_t room = 0; room <= 200000; room += 500) try_with(room, true);
  try_with(0, false);
  printf("%d refused, %d read\n", refused, read_all);
  assert_true(refused > 0 && read_all > 0);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(assimp_is_not_left_without_memory),
      cmocka_unit_test(failing_memory_is_told_as_such),
      cmocka_unit_test(failing_memory_of_files_is_told_as_such),
  };
  return cmocka_run_group_tests_name("mesh_file_memory", tests, nullptr, nullptr);
}

#endif
