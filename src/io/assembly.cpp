// SPDX-License-Identifier: Apache-2.0
#include "io/assembly.h"

#include <algorithm>

#include "base/status.h"

namespace msq {
namespace {

constexpr int max_height = 100;

[[noreturn]] void fail_for_depth() {
  fail(Status::limit, "objects are nested more than %d deep", max_height);
}

}  // namespace

uint64_t saturating_sum(uint64_t a, uint64_t b) {
  constexpr uint64_t most = uint64_t{1} << 63;
  return a > most - b ? most : a + b;
}

uint64_t count_triangles(Assembly& assembly, int depth) {
  if (depth > max_height) fail_for_depth();
  if (assembly.state == Assembly::State::open) fail(Status::io, "an object contains itself");
  if (assembly.state == Assembly::State::unseen) {
    assembly.state = Assembly::State::open;
    assembly.triangles = assembly.mesh.triangles.size();
    std::erase_if(assembly.instances, [&](const Instance& instance) {
      const uint64_t triangles = count_triangles(*instance.assembly, depth + 1);
      assembly.triangles = saturating_sum(assembly.triangles, triangles);
      assembly.height = std::max(assembly.height, instance.assembly->height + 1);
      return triangles == 0;
    });
    // The path to here may have been short, as parts of it were counted before.
    if (assembly.height > max_height) fail_for_depth();
    assembly.state = Assembly::State::done;
  }
  return assembly.triangles;
}

void place(const Assembly& assembly, const Transform& transform, SoupBuilder& soup) {
  if (!assembly.mesh.triangles.empty()) soup.add_instance(assembly.mesh, transform);
  for (const Instance& instance : assembly.instances)
    place(*instance.assembly, transform.after(instance.transform), soup);
}

}  // namespace msq
