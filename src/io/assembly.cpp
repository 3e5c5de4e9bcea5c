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

void count_parts(Assembly& assembly, int depth) {
  if (depth > max_height) fail_for_depth();
  if (assembly.state == Assembly::State::open) fail(Status::io, "an object contains itself");
  if (assembly.state == Assembly::State::done) return;
  assembly.state = Assembly::State::open;
  assembly.triangles = assembly.mesh.triangles.size();
  if (assembly.lattice) assembly.beams = assembly.lattice->size();
  if (assembly.clip && assembly.beams) assembly.clip_triangles = assembly.clip->triangles.size();
  std::erase_if(assembly.instances, [&](const Instance& instance) {
    Assembly& part = *instance.assembly;
    count_parts(part, depth + 1);
    assembly.triangles = saturating_sum(assembly.triangles, part.triangles);
    assembly.beams = saturating_sum(assembly.beams, part.beams);
    assembly.clip_triangles = saturating_sum(assembly.clip_triangles, part.clip_triangles);
    assembly.height = std::max(assembly.height, part.height + 1);
    return part.triangles == 0 && part.beams == 0;
  });
  // The path to here may have been short, as parts of it were counted before.
  if (assembly.height > max_height) fail_for_depth();
  assembly.state = Assembly::State::done;
}

void place(const Assembly& assembly, const Transform& transform, SoupBuilder& soup) {
  for_each_placed(assembly, transform, [&](const Assembly& part, const Transform& placed) {
    if (!part.mesh.triangles.empty()) soup.add_instance(part.mesh, placed);
  });
}

}  // namespace msq
