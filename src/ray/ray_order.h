// SPDX-License-Identifier: Apache-2.0
// An order of rays in which those that follow each other lie close together: sorted by where they
// come into the model and where they go from there, bit by bit of both in turn (Morton's order in
// six dimensions).
// Sources: Aila and Karras, "Architecture considerations for tracing incoherent rays", 2010;
// Meister, Boksansky, Guthe and Bittner, "On ray reordering techniques for faster GPU ray tracing",
// 2020.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "base/ray.h"

namespace msq {

/// Writes rays, by their numbers, to searches[0, rays.size()): their ray, from and to. One with
/// from > to meets nothing. Called by several threads at once.
using FillRays = std::function<void(std::span<const uint64_t> rays, RaySearch* searches)>;

class RayOrder {
 public:
  /// Most rays that are sorted at once, and the memory that one of them takes.
  static constexpr unsigned most_bits = 20;
  static constexpr uint64_t most = uint64_t{1} << most_bits, bytes_of_ray = 16;

  /// Rays through a box that is filled with cells of such a size.
  RayOrder(const Box3& bounds, double cell_size) : bounds_(bounds), cell_size_(cell_size) {}

  /// Sorts the rays [first, first + count), at most `most`. False, with nothing done, where most
  /// lie within a cell of those that they follow.
  bool sort(const Executor& executor, uint64_t first, uint64_t count, const FillRays& fill);
  /// Of the sorted rays, those in places [begin, begin + numbers.size()).
  void take(uint64_t begin, std::span<uint64_t> numbers) const {
    for (size_t i = 0; i < numbers.size(); ++i)
      numbers[i] = first_ + (keys_[begin + i] & (most - 1));
  }

 private:
  static constexpr size_t axes = 6;
  /// Where a ray comes in, and its direction, as long as the way for which it counts.
  using Place = std::array<double, axes>;

  bool place(const RaySearch& search, Place& place) const;
  bool looks_ordered(uint64_t first, uint64_t count, const FillRays& fill);
  void spread_bits(const Place& low, const Place& high);
  uint64_t key_of(const Place& place) const;

  const Box3 bounds_;
  const double cell_size_;
  uint64_t first_ = 0;
  Place low_{};  // of most rays' places
  double per_step_ = 0;
  std::array<double, axes> top_{};  // number of the last step along each axis
  /// Where the bits of the number of a step go, by axis and byte.
  std::array<std::array<std::array<uint64_t, 256>, 2>, axes> spread_{};
  /// The key of a ray above, its number less `first` below.
  std::vector<uint64_t> keys_, by_block_;
};

}  // namespace msq
