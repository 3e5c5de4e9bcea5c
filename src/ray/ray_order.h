// SPDX-License-Identifier: Apache-2.0
// An order of rays in which neighbours lie close together. Rays are sorted by the position where
// they enter the model and by their direction from there, with the bits of both interleaved
// (Morton's order in six dimensions).
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

/// Writes the rays with the given numbers to searches[0, rays.size()): ray, from and to. A ray with
/// from > to meets nothing. Several threads call this at once.
using FillRays = std::function<void(std::span<const uint64_t> rays, RaySearch* searches)>;

class RayOrder {
 public:
  /// Maximum number of rays sorted at once, and the memory per ray.
  static constexpr unsigned max_bits = 20;
  static constexpr uint64_t most = uint64_t{1} << max_bits, bytes_of_ray = 16;

  /// For rays through a box filled with cells of the given size.
  RayOrder(const Box3& bounds, double cell_size) : bounds_(bounds), cell_size_(cell_size) {}

  /// Sorts the rays [first, first + count), at most `most`. Returns false and does nothing if most
  /// rays lie within a cell of their predecessors. Stops early, by Error(cancelled), with the job.
  bool sort(const Executor& executor, uint64_t first, uint64_t count, const FillRays& fill,
            const Job* job);
  /// The numbers of the sorted rays at positions [begin, begin + numbers.size()).
  void take(uint64_t begin, std::span<uint64_t> numbers) const {
    for (size_t i = 0; i < numbers.size(); ++i)
      numbers[i] = first_ + (keys_[begin + i] & (most - 1));
  }

 private:
  static constexpr size_t axes = 6;
  /// Where a ray enters, and its direction times the length that counts.
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
  /// The positions of the bits of a step's number, by axis and byte.
  std::array<std::array<std::array<uint64_t, 256>, 2>, axes> spread_{};
  /// The key of a ray in the high bits, its number minus `first` in the low bits.
  std::vector<uint64_t> keys_, by_block_;
};

}  // namespace msq
