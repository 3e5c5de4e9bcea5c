// SPDX-License-Identifier: Apache-2.0
// Lattices along their grid draw rows that repeat along y once for the tiles of a layer. Each tile
// has the bits of the predicate, whichever lattice drew the tile before it.
#include <vector>

#include "msq_test.h"
#include "structure/lattice/lattice.h"

using namespace msq;

namespace {

/// Of 24 samples along a side, whose positions in the cell are equal except for rounding.
constexpr double cell = 0.3;
constexpr uint64_t samples_per_cell = 24;

Ref<Lattice> make_lattice(const UnitCell& unit_cell, double radius, double side = cell) {
  return make_ref<Lattice>(Neighbourhood{{0.1, 0.7, 0.4}, {side, side, side}, {}}, unit_cell,
                           Parameter(radius));
}

void expect_points(const Lattice& lattice, const RowBlock& block) {
  const SampleGrid& grid = *block.grid;
  lattice.keep_rows(block, nullptr);
  for (uint64_t k = block.z0; k < block.z1; ++k)
    for (uint64_t j = block.y0; j < block.y1; ++j)
      for (uint64_t i = 0; i < grid.nx; ++i)
        if ((block.row(j, k)[i / bits_per_word] >> (i % bits_per_word) & 1) !=
            lattice.inside(grid.at(i, j, k)))
          fail_msg("row %d of layer %d: sample %d is wrong", int(j), int(k), int(i));
}

void tiles_have_the_bits_of_points(void**) {
  // Alike in all but one: the struts, the radius, the cells' size.
  const Ref<Lattice> lattices[] = {
      make_lattice(bcc_unit_cell(), 0.03), make_lattice(octet_unit_cell(), 0.03),
      make_lattice(bcc_unit_cell(), 0.02), make_lattice(bcc_unit_cell(), 0.03, 0.301)};
  SampleGrid grid;
  grid.origin = {0.1, 0.7 + cell / 48, 0.4 + cell / 37};
  grid.spacing = {cell / samples_per_cell, cell / samples_per_cell, cell / 10};
  grid.nx = 190;
  grid.ny = 211;
  grid.nz = 4;
  std::vector<uint64_t> words;
  for (const uint64_t rows : {uint64_t{48}, uint64_t{53}, uint64_t{100}})
    for (const uint64_t layers : {uint64_t{1}, uint64_t{4}})
      for (uint64_t z = 0; z < grid.nz; z += layers)
        for (uint64_t y = 0; y < grid.ny; y += rows)
          for (const Ref<Lattice>& lattice : lattices) {
            RowBlock block;
            block.grid = &grid;
            block.y0 = y;
            block.y1 = std::min(grid.ny, y + rows);
            block.z0 = z;
            block.z1 = z + layers;
            block.row_stride = block.row_words();
            block.layer_stride = block.row_stride * block.rows();
            words.assign(block.layer_stride * layers, 0);
            block.words = words.data();
            for (uint64_t k = block.z0; k < block.z1; ++k)
              for (uint64_t j = block.y0; j < block.y1; ++j)
                set_bits(block.row(j, k), 0, grid.nx - 1);
            expect_points(*lattice, block);
          }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(tiles_have_the_bits_of_points)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
