// SPDX-License-Identifier: Apache-2.0
// Rows along which a function is a single wave are drawn by the ends of its intervals. They have
// the bits of the predicate, also where the level is the function's largest or smallest value in a
// row, where all samples lie on the surface, and in rows of several windows.
#include <algorithm>
#include <cmath>
#include <vector>

#include "expression/parser.h"
#include "field/gradient.h"
#include "msq_test.h"
#include "structure/functional/presets.h"
#include "structure/functional/single_wave.h"
#include "structure/functional/single_wave_rows.h"

using namespace msq;

namespace {

constexpr double cell = 0.3;

Ref<Functional> make(const char* expression, FunctionalKind kind, Parameter level,
                     const Rotation& rotation = {}) {
  return make_ref<Functional>(Neighbourhood{{0.1, 0.7, 0.4}, {cell, cell, cell}, rotation},
                              parse_expression(expression, {}), kind, std::move(level), 1);
}

void expect_points(const Functional& structure, const SampleGrid& grid, uint64_t dead_from) {
  RowBlock block;
  block.grid = &grid;
  block.y1 = grid.ny;
  block.z1 = grid.nz;
  block.row_stride = block.row_words();
  block.layer_stride = block.row_stride * block.rows();
  std::vector<uint64_t> words(block.layer_stride * grid.nz);
  block.words = words.data();
  const uint64_t alive = std::min(dead_from, grid.nx);
  for (uint64_t k = 0; k < grid.nz; ++k)
    for (uint64_t j = 0; j < grid.ny; ++j)
      if (j % 7 != 3) set_bits(block.row(j, k), 0, alive - 1);
  assert_true(SingleWaveRows::serves(structure, block));
  structure.keep_rows(block, nullptr);
  for (uint64_t k = 0; k < grid.nz; ++k)
    for (uint64_t j = 0; j < grid.ny; ++j)
      for (uint64_t i = 0; i < block.row_words() * bits_per_word; ++i) {
        const bool is_alive = j % 7 != 3 && i < alive;
        if ((block.row(j, k)[i / bits_per_word] >> (i % bits_per_word) & 1) !=
            (is_alive && structure.inside(grid.at(i, j, k))))
          fail_msg("row %d of layer %d: sample %d is wrong", int(j), int(k), int(i));
      }
}

constexpr const char* functions[] = {
    preset_expressions[0],  // gyroid
    preset_expressions[1],  // Schwarz P
    preset_expressions[2],  // diamond
    preset_expressions[4],  // Neovius
    "sin(x)-0.5*cos(y)",         "cos(y)*sin(z)",
    "1e-9*cos(x)+cos(y)*cos(z)", "1e6*(cos(x)*sin(y)-cos(z))",
};

struct Spacing {
  double samples_per_cell, shift;  // of the first sample, in cells
};

void rows_have_the_bits_of_points(void**) {
  // Samples on the surface; rows that repeat; rows that do not; few samples in a cell.
  const Spacing spacings[] = {{24, 0}, {32, 0}, {16.3187, 0.37}, {2, 0}, {4, 0.125}, {0.77, 0.1}};
  const double levels[] = {0, 0.3, 1.5, 3, -3, 5, -5, -0.2, 1e6};
  const Rotation turns[] = {{}, {{0, -1, 0, 1, 0, 0, 0, 0, 1}}, {{0, 0, 1, 0, 1, 0, -1, 0, 0}}};
  size_t turn = 0;
  for (const char* function : functions)
    for (const FunctionalKind kind : {FunctionalKind::network, FunctionalKind::sheet})
      for (const double level : levels)
        for (const Spacing& spacing : spacings) {
          const double step = cell / spacing.samples_per_cell;
          SampleGrid grid;
          grid.origin = Vec3{0.1, 0.7, 0.4} + Vec3{1, 1, 1} * (spacing.shift * cell);
          grid.spacing = {step, step, step * 1.01};
          grid.nx = 190;
          grid.ny = 11;
          grid.nz = 3;
          expect_points(*make(function, kind, Parameter(level), turns[turn++ % 3]), grid, 170);
        }
}

void rows_have_several_windows(void**) {
  SampleGrid grid;
  grid.origin = {0.11, 0.72, 0.45};
  grid.spacing = {cell / 33.3, cell / 7, cell / 5};
  grid.nx = 2 * WaveColumns::window_words * bits_per_word + 100;
  grid.ny = 300;  // more than a batch of rows
  grid.nz = 1;
  expect_points(*make(functions[0], FunctionalKind::sheet, Parameter(0.4)), grid, grid.nx);
  expect_points(*make(functions[3], FunctionalKind::network, Parameter(0.4)), grid, grid.nx);
}

void levels_may_differ_between_rows(void**) {
  SampleGrid grid;
  grid.origin = {0.11, 0.72, 0.45};
  grid.spacing = {cell / 33.3, cell / 7, cell / 5};
  grid.nx = 200;
  grid.ny = 20;
  grid.nz = 5;
  // Along z; along z and very little along x; none of the two fields is below 0.05.
  for (const Vec3 to : {Vec3{0.11, 0.72, 0.8}, Vec3{0.1100001, 0.72, 0.8}})
    for (const FunctionalKind kind : {FunctionalKind::network, FunctionalKind::sheet})
      for (const size_t function : {0, 3})
        expect_points(*make(functions[function], kind,
                            Parameter(make_ref<GradientField>(grid.origin, 0.05, to, 0.9))),
                      grid, grid.nx);
}

void intervals_end_where_the_value_is_the_threshold(void**) {
  WaveEnds ends;
  const double sine[] = {0.3, -0.3, 0, 0, 1, 0, 0, 0}, cosine[] = {0.4, 0.4, 1, -1, 0, 0, 0, 0},
               constant[] = {0.1, 0.1, 0, 0, 0, 0.2, 0.3, 5};
  double padded[3][8 + batch_padding] = {};
  std::copy_n(sine, 8, padded[0]);
  std::copy_n(cosine, 8, padded[1]);
  std::copy_n(constant, 8, padded[2]);
  const double threshold = 0.25;
  const std::vector<double> thresholds(8 + batch_padding, threshold);
  find_wave_ends({padded[0], padded[1], {padded[2], false}, 8}, thresholds.data(), ends);
  constexpr double step = 2 * M_PI / ColumnSets::buckets;
  for (size_t row = 0; row < 5; ++row)
    for (const int32_t end : {ends.low[row], ends.high[row]}) {
      const auto beyond = [&](int32_t bucket) {
        const double angle = bucket * step;
        return constant[row] + sine[row] * std::sin(angle) + cosine[row] * std::cos(angle) -
               threshold;
      };
      assert_true(beyond(end) * beyond(end + 1) <= 0);
    }
  // No wave: all of the cell, or nothing.
  assert_true(ends.high[5] - (ends.low[5] + 1) >= ColumnSets::buckets);
  for (const size_t row : {6, 7}) assert_true(ends.high[row] + 1 <= ends.low[row]);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(rows_have_the_bits_of_points),
                              cmocka_unit_test(rows_have_several_windows),
                              cmocka_unit_test(levels_may_differ_between_rows),
                              cmocka_unit_test(intervals_end_where_the_value_is_the_threshold)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
