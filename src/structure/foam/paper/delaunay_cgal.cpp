// SPDX-License-Identifier: Apache-2.0
// Delaunay triangulation by CGAL, in place of the paper's own Bowyer-Watson. It has exact
// predicates, and it stores adjacency, so no search for the pairs of tetrahedra that share a face
// is needed. The paper rescales the seeds to the unit cube against rounding; exact predicates need
// no such scaling. Source: paper, section "Preprocessing for Voronoi Foams".
//
// CGAL's triangulations are under the GPL. So a build with this file is, too.
#include <cstddef>
#include <new>

#include "base/borrowed.h"

namespace msq {

namespace {

/// Blocks of memory that this frees at its end, unless they were given back before. BlockAllocator
/// uses the innermost one of a thread.
class Blocks {
 public:
  Blocks() : outer_(innermost) {
    list_.previous = list_.next = &list_;
    innermost = this;
  }
  ~Blocks() {
    while (list_.next != &list_) give_back(list_.next + 1);
    innermost = outer_;
  }
  Blocks(const Blocks&) = delete;
  Blocks& operator=(const Blocks&) = delete;

  static void* take(size_t bytes) {
    Block* const block = new (::operator new(sizeof(Block) + bytes)) Block;
    Block* const list = &innermost->list_;
    *block = {list, list->next};
    list->next->previous = block;
    list->next = block;
    return block + 1;
  }
  static void give_back(void* memory) {
    Block* const block = static_cast<Block*>(memory) - 1;
    block->previous->next = block->next;
    block->next->previous = block->previous;
    ::operator delete(block);
  }

 private:
  // What is before the memory of a block.
  struct alignas(std::max_align_t) Block {
    Block *previous, *next;
  };

  // TLS that is there from the thread's start: it cannot fail (borrowed.h).
  MSQ_INITIAL_EXEC static constinit thread_local Blocks* innermost;

  Block list_;
  Blocks* const outer_;
};
constinit thread_local Blocks* Blocks::innermost = nullptr;

template <class T>
struct BlockAllocator {
  using value_type = T;

  BlockAllocator() = default;
  template <class Other>
  BlockAllocator(const BlockAllocator<Other>&) {}

  T* allocate(size_t n) {
    static_assert(alignof(T) <= alignof(std::max_align_t));
    return static_cast<T*>(Blocks::take(n * sizeof(T)));
  }
  void deallocate(T* memory, size_t) { Blocks::give_back(memory); }
  bool operator==(const BlockAllocator&) const = default;
};

}  // namespace

}  // namespace msq

// Of CGAL, as it is, where memory fails: a triangulation keeps a table of 32 KB in the TLS of each
// thread, and half filled; here it is borrowed instead. Its containers lose a block that they have
// no room to list; here all blocks have one owner.
// clang-format off: the order matters
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/memory.h>
#include <CGAL/tss.h>
#pragma push_macro("CGAL_ALLOCATOR")
#undef CGAL_ALLOCATOR
#define CGAL_ALLOCATOR(T) ::msq::BlockAllocator<T>
#include <CGAL/Compact_container.h>
#pragma pop_macro("CGAL_ALLOCATOR")
#pragma push_macro("CGAL_STATIC_THREAD_LOCAL_VARIABLE_0")
#undef CGAL_STATIC_THREAD_LOCAL_VARIABLE_0
#define CGAL_STATIC_THREAD_LOCAL_VARIABLE_0(TYPE, VAR) \
  const ::msq::Borrowed<TYPE> borrowed_##VAR;          \
  TYPE& VAR = *borrowed_##VAR
#include <CGAL/Triangulation_data_structure_3.h>
#pragma pop_macro("CGAL_STATIC_THREAD_LOCAL_VARIABLE_0")
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
// clang-format on

#include <algorithm>
#include <utility>

#include "structure/foam/paper/delaunay.h"

namespace msq {

namespace {
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
/// A type of our own, so that all types that CGAL makes with it are ours, too.
struct SeedNumber {
  uint32_t value = 0;
};
using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<SeedNumber, Kernel>;
using Triangulation =
    CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<VertexBase>>;
}  // namespace

bool can_triangulate() {
  return true;
}

std::vector<DelaunayFacet> delaunay_facets(const std::vector<Vec3>& seeds) {
  std::vector<std::pair<Kernel::Point_3, SeedNumber>> points;
  points.reserve(seeds.size());
  for (uint32_t i = 0; i < seeds.size(); ++i)
    points.emplace_back(Kernel::Point_3(seeds[i].x, seeds[i].y, seeds[i].z), SeedNumber{i});
  const Blocks blocks;
  const Triangulation triangulation(points.begin(), points.end());

  std::vector<DelaunayFacet> facets;
  facets.reserve(triangulation.number_of_finite_facets());
  for (const auto& [cell, corner] : triangulation.finite_facets()) {
    DelaunayFacet facet;
    for (int i = 0, n = 0; i < 4; ++i)
      if (i != corner) facet.seeds[n++] = cell->vertex(i)->info().value;
    std::sort(facet.seeds.begin(), facet.seeds.end());
    const auto far_side = triangulation.mirror_vertex(cell, corner);
    const auto opposite = [&](const auto& vertex) {
      return triangulation.is_infinite(vertex) ? int64_t{-1} : int64_t{vertex->info().value};
    };
    facet.opposite = {opposite(cell->vertex(corner)), opposite(far_side)};
    facets.push_back(facet);
  }
  return facets;
}

}  // namespace msq
