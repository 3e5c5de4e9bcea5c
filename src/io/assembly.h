// SPDX-License-Identifier: Apache-2.0
// Meshes and lattices that contain instances of one another, like the objects of 3MF and AMF.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "io/beam_lattice.h"
#include "io/soup_builder.h"

namespace msq {

struct Assembly;

struct Instance {
  Assembly* assembly;
  Transform transform;
};

struct Assembly {
  TriangleSoup mesh;
  std::unique_ptr<BeamLattice> lattice;  ///< null: none
  const TriangleSoup* clip = nullptr;    ///< what clips the lattice
  std::vector<Instance> instances;
  // Set by count_parts(), with all instances, at most 2^63:
  uint64_t triangles = 0;
  uint64_t beams = 0;           ///< and balls
  uint64_t clip_triangles = 0;  ///< of all lattices
  int height = 0;               ///< levels of instances below
  enum class State { unseen, open, done } state = State::unseen;
};

/// Counts the triangles and beams of an assembly with all its instances, each assembly once. Drops
/// instances without any, so that placing costs no more than the resulting parts. Throws Error(io)
/// if an assembly contains itself, Error(limit) if assemblies nest over 100 deep.
void count_parts(Assembly& assembly, int depth = 0);

/// A sum that is clamped to 2^63.
uint64_t saturating_sum(uint64_t a, uint64_t b);

/// Adds the triangles of a counted assembly and of all that it contains.
void place(const Assembly& assembly, const Transform& transform, SoupBuilder& soup);

/// Calls act(assembly, transform) for a counted assembly and all that it contains.
template <class Act>
void for_each_placed(const Assembly& assembly, const Transform& transform, const Act& act) {
  act(assembly, transform);
  for (const Instance& instance : assembly.instances)
    for_each_placed(*instance.assembly, transform.after(instance.transform), act);
}

}  // namespace msq
