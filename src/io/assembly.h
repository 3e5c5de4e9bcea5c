// SPDX-License-Identifier: Apache-2.0
// Meshes that contain instances of one another, like the objects of 3MF and AMF.
#pragma once

#include <cstdint>
#include <vector>

#include "io/soup_builder.h"

namespace msq {

struct Assembly;

struct Instance {
  Assembly* assembly;
  Transform transform;
};

struct Assembly {
  TriangleSoup mesh;
  std::vector<Instance> instances;
  // Set by count_triangles():
  uint64_t triangles = 0;  ///< with all instances, at most 2^63
  int height = 0;          ///< levels of instances below
  enum class State { unseen, open, done } state = State::unseen;
};

/// Counts the triangles of an assembly with all its instances, each assembly once. Drops instances
/// without triangles, so that placing costs no more than the resulting triangles. Throws Error(io)
/// if an assembly contains itself, Error(limit) if assemblies nest over 100 deep.
uint64_t count_triangles(Assembly& assembly, int depth = 0);

/// A sum that is clamped to 2^63.
uint64_t saturating_sum(uint64_t a, uint64_t b);

/// Adds a counted assembly and all that it contains.
void place(const Assembly& assembly, const Transform& transform, SoupBuilder& soup);

}  // namespace msq
