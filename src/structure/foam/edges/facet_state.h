// SPDX-License-Identifier: Apache-2.0
// What the kernels of the walk over tetrahedra (facet_walk.h) work on, and the margins of its
// proof.
#pragma once

#include <cstdint>

#include "structure/foam/edges/owners.h"

namespace msq {

/// Seeds are named by their cells: (z * stride + y) * stride + x, from the first of the halo.
struct FacetState {
  static constexpr int max_side = 8;  // cells of the brick along each axis: this or 4
  /// Cells on either side of the brick whose seeds are known.
  static constexpr int halo = 3;
  static constexpr int max_width = max_side + 2 * halo;  // cells along each axis
  static constexpr int stride = 16;                      // of rows of cells
  static constexpr uint32_t seeds_in_brick = max_side * max_side * max_side;
  static constexpr uint32_t max_tetrahedra = 12 * seeds_in_brick;
  static constexpr uint32_t buckets = 3 * seeds_in_brick;
  static constexpr uint32_t bucket_room = 64;
  static constexpr int batch = 16;  // facets handled together, at any width of vectors
  static constexpr int patch = 4;   // cells along each axis that are searched first
  static constexpr int half_patch = patch / 2;
  static constexpr int patches_in_row = max_width - patch + 1;

  // Positions of seeds in cells, from the middle of the brick: multiples of 2^-21 below 8.
  alignas(64) float points[max_width * stride * stride][4];
  // For each 4 x 4 cells along x and y, and each z: x, y and z of their seeds in foam units. The
  // four layers of a patch follow each other.
  alignas(64) float layers[patches_in_row * patches_in_row * max_width][3 * patch * patch];
  // Centres of tetrahedra, foam units.
  alignas(64) float centres[max_tetrahedra + batch][4];
  // A facet is in a bucket of its first seed in the brick. Each seed has three: for facets of which
  // it is the first, the second or the third seed. The key names the other two seeds, and the ends
  // are the facet's tetrahedra.
  alignas(64) uint16_t keys[buckets][bucket_room];
  alignas(64) uint16_t ends[buckets][bucket_room][2];
  uint64_t done[buckets];  // facets with both ends
  uint8_t count[buckets];
  uint8_t reached[max_width * stride * stride];
  // Duplicates within a batch: the last batch that used a bucket, or a tetrahedron's hash.
  uint32_t bucket_used[buckets], hash_used[2048];
  uint64_t queue[buckets * bucket_room + 1];
  uint32_t head, last, tetrahedra, stamp, random, resolved;
  // Results.
  alignas(64) uint16_t firsts[seeds_in_brick * bucket_room], seconds[seeds_in_brick * bucket_room];
  float bounds[6][max_side * max_side];
  uint32_t starts[max_side * max_side + 1];

  Owners owners;   // of the edges that are wanted
  int width;       // cells along each axis, with the halo
  int half_width;  // cells before the brick's middle
  double scale[3];
  float unit;  // size of a cube of a cell's volume

  /// A cell's place along an axis.
  static int cell(uint32_t seed, int axis) {
    return static_cast<int>(seed >> (4 * axis) & (stride - 1));
  }
};

/// Roundings in single precision. A seed's coordinates are rounded to 2^-22, and those of the
/// centre as well, since both are below 8. So d, their difference, has errors below 6e-7 along each
/// axis, and d^2, for |d| <= 1.5, has errors below 2 sqrt(3) 1.5 * 6e-7 + 5 * 2^-24 d^2 < 4e-6. A
/// larger sphere does not fit in four cells.
constexpr float walk_margin = 1e-5f;
/// With a fourth power of the sphere's radius: the least determinant, six times the tetrahedron's
/// volume. The centre, relative to a seed, is a sum of 3 products of 4 lengths up to 2 r, divided
/// by twice the determinant: its error is below 15 * 2^-53 (2 r)^4 / det < 3e-8. So ends of edges
/// are within edge_error (edge_brick.h).
constexpr double walk_min_volume = 1e-6;
/// Spheres are empty if all other squared distances exceed the squared radius by this; roundings of
/// both are below 1e-12.
constexpr double walk_tie = 1e-10;
/// Steps in double precision take about 1 us; with more of them per brick, the walk is too slow.
constexpr uint32_t walk_max_resolved = 400;

}  // namespace msq
