// SPDX-License-Identifier: Apache-2.0
// Rows that repeat along y: a period of them and the samples that differ make all rows, as the
// definition says. Runs of layers, which copy rows and grey pixels, have the bytes of single
// layers, which do not.
#include "query/repeating_rows.h"

#include <cstring>

#include "bit_rows.h"
#include "expression/parser.h"
#include "msq_test.h"
#include "random.h"
#include "shape/all_space.h"
#include "shape/primitive.h"
#include "slice/slicer.h"
#include "structure/functional/functional.h"
#include "structure/lattice/lattice.h"
#include "structure/lattice/plates/plate_lattice.h"

using namespace msq;
using namespace msq::test;

namespace {

constexpr double cell = 0.3;

Ref<Lattice> lattice(const UnitCell& unit_cell, double radius) {
  return make_ref<Lattice>(Neighbourhood{{0.1, 0.7, 0.4}, {cell, cell, cell}, {}}, unit_cell,
                           Parameter(radius));
}

Ref<Functional> gyroid(double size) {
  const Tape tape = parse_expression("sin(x)*cos(y)+sin(y)*cos(z)+sin(z)*cos(x)", {});
  return make_ref<Functional>(Neighbourhood{{0, 0, 0}, {size, size, size}, {}}, tape,
                              FunctionalKind::sheet, Parameter(0.3), 0);
}

/// `across` samples to a cell along y and z, the middle of one at a distance of half a pitch from
/// the corner of a cell.
SampleGrid grid_of(uint64_t across) {
  const double pitch = cell / static_cast<double>(across);
  SampleGrid grid;
  grid.origin = {0.11, 0.7 + 0.5 * pitch, 0.4 + 0.5 * pitch};
  grid.spacing = {0.017, pitch, pitch};
  grid.nx = 150;
  grid.ny = 5 * across + 3;
  grid.nz = across;
  return grid;
}

/// Compares all rows of a grid with the definition. Returns the number of flips.
template <class Kind>
size_t check_period(const Kind& structure, const SampleGrid& grid, uint64_t period) {
  const uint64_t begin = 2, end = grid.ny - 1;
  assert_int_equal(structure.row_period(grid, begin, end), period);
  size_t count = 0;
  for (uint64_t k = 0; k < grid.nz; ++k) {
    BitRows rows(grid, begin, begin + period, k, k + 1);
    for (uint64_t j = begin; j < begin + period; ++j)
      set_bits(rows.block().row(j, k), 3, grid.nx - 2);
    RowFlips flips;
    flips.begin(UINT64_MAX);
    structure.keep_repeated_rows(rows.block(), end, flips, nullptr);
    assert_int_equal(rows.damage(), 0);
    count += flips.all().size();
    for (uint64_t j = begin; j < end; ++j)
      for (uint64_t i = 0; i < grid.nx; ++i) {
        bool held = rows.get(i, begin + (j - begin) % period, k);
        for (const RowFlip& flip : flips.all())
          if (flip.i == i && flip.j == j) held = !held;
        const bool expected = i >= 3 && i + 1 < grid.nx && structure.inside(grid.at(i, j, k));
        if (held != expected) fail_msg("sample %d, %d, %d is wrong", int(i), int(j), int(k));
      }
  }
  return count;
}

void a_period_stands_for_all_rows(void**) {
  const SampleGrid grid = grid_of(24);
  const double half = cell / 48;
  size_t flips = 0;
  for (const UnitCell& unit_cell : {cubic_unit_cell(), bcc_unit_cell(), octet_unit_cell()})
    // The last two put samples on the surfaces of struts along x, where rounding decides.
    for (const double radius : {0.03, 0.0412, std::sqrt(10.0) * half, std::sqrt(50.0) * half})
      flips += check_period(*lattice(unit_cell, radius), grid, 24);
  assert_in_range(flips, 1, 100000);
  for (const double thickness : {0.03, 6 * half})
    flips +=
        check_period(*make_ref<PlateLattice>(Neighbourhood{{0.1, 0.7, 0.4}, {cell, cell, cell}, {}},
                                             cubic_octet_plate_cell(), Parameter(thickness)),
                     grid, 24);
  // Angles are equal to the last bit only if cells and pitches are.
  SampleGrid exact = grid;
  exact.spacing.y = 0x1p-8;
  exact.origin.y = 0x1p-9;
  assert_int_equal(check_period(*gyroid(0x1p-4), exact, 16), 0);
}

void rows_that_do_not_repeat_have_no_period(void**) {
  const SampleGrid grid = grid_of(24);
  assert_int_equal(lattice(bcc_unit_cell(), 0.03)->row_period(grid, 0, 47), 0);
  assert_int_equal(lattice(bcc_unit_cell(), 0.03)->row_period(grid, 0, 48), 24);
  SampleGrid other = grid;
  other.spacing.y *= 1.01;
  assert_int_equal(lattice(bcc_unit_cell(), 0.03)->row_period(other, 0, grid.ny), 0);
  // Nor are there positions of more rows than memory holds.
  SampleGrid huge = grid;
  huge.ny = INT32_MAX;
  const Model model(make_ref<Context>(1u, uint64_t{0}, uint64_t{0}), make_ref<AllSpace>(),
                    std::vector<Ref<const Structure>>{lattice(bcc_unit_cell(), 0.03)});
  assert_true(find_row_repeats(model, model.resolved(0), grid).any());
  assert_false(find_row_repeats(model, model.resolved(0), huge).any());
  const Ref<Lattice> turned = make_ref<Lattice>(
      Neighbourhood{{}, {cell, cell, cell}, Rotation{{0.8, -0.6, 0, 0.6, 0.8, 0, 0, 0, 1}}},
      bcc_unit_cell(), Parameter(0.03));
  assert_int_equal(turned->row_period(grid, 0, grid.ny), 0);
}

/// Samples of repeated rows that are unlike those they repeat, and layers that have too many of
/// them for a list. All samples are those that are computed row by row.
size_t count_flips(const Model& model, const SampleGrid& grid, size_t* full_count = nullptr) {
  const Scales scales = model.resolved(0);
  const uint64_t layer_words = words_for(grid.nx) * grid.ny;
  const RowRepeats repeats = find_row_repeats(model, scales, grid);
  if (!repeats.any()) return 0;
  std::vector<uint64_t> words(words_for(grid.nx) * grid.ny * grid.nz), alone(words.size());
  fill_repeating_slab(model, scales, grid, repeats, 0, grid.nz, words.data(), nullptr, {}, nullptr);
  fill_slab(model, scales, grid, 0, grid.nz, alone.data(), nullptr);
  assert_true(words == alone);
  std::vector<RowFlips> flips(grid.nz);
  fill_repeating_slab(model, scales, grid, repeats, 0, grid.nz, words.data(), nullptr, {}, &flips);
  size_t count = 0;
  for (uint64_t k = 0; k < grid.nz; ++k)
    if (flips[k].is_full()) {  // then all rows are there
      if (full_count) ++*full_count;
      assert_true(std::equal(words.begin() + static_cast<ptrdiff_t>(k * layer_words),
                             words.begin() + static_cast<ptrdiff_t>((k + 1) * layer_words),
                             alone.begin() + static_cast<ptrdiff_t>(k * layer_words)));
      assert_true(flips[k].all().empty());
    }
  for (const RowFlips& of_layer : flips) count += of_layer.all().size();
  return count;
}

/// Layers that lie on faces of plates: rounding decides about all of their samples.
void layers_of_many_flips_have_all_rows(void**) {
  SampleGrid grid = grid_of(24);
  grid.nx = 700;
  const auto context = make_ref<Context>(2u, uint64_t{0}, uint64_t{0});
  const Model model(context, make_ref<AllSpace>(),
                    {make_ref<PlateLattice>(Neighbourhood{{0.1, 0.7, 0.4}, {cell, cell, cell}, {}},
                                            cubic_octet_plate_cell(), Parameter(cell / 8))});
  size_t full = 0;
  assert_true(count_flips(model, grid, &full) > 0);
  assert_in_range(full, 1, grid.nz - 1);
}

/// Runs against single layers. Returns the number of flips of bits and of grey.
std::array<size_t, 2> check_runs(const Ref<const Model>& model, SlicePlan plan, bool repeats) {
  std::array<size_t, 2> flips{};
  for (const LayerFormat format : {LayerFormat::bits, LayerFormat::grey, LayerFormat::bytes})
    for (const unsigned samples : {2u, 4u, 8u}) {
      if (format != LayerFormat::grey && samples > 2) continue;
      OutputPlan output;
      output.format = format;
      output.grey.samples = samples;
      plan.outputs = {output};
      const Ref<const Slicer> slicer = make_ref<Slicer>(model, plan);
      const SampleGrid grid = divided(slicer->grid(), format == LayerFormat::grey ? samples : 1);
      assert_int_equal(find_row_repeats(*model, model->resolved(0), grid).any(), repeats);
      flips[format == LayerFormat::grey] += count_flips(*model, grid);
      std::vector<uint8_t> expected(slicer->layer_bytes());
      slicer->run(
          0, slicer->grid().nz,
          [&](const Layer& layer) {
            slicer->slice_layer(layer.index, expected.data(), nullptr);
            const int differs = std::memcmp(layer.main().data, expected.data(), expected.size());
            uint64_t inside = 0;
            for (size_t i = 0; i < expected.size(); ++i)
              inside += format == LayerFormat::bits
                            ? static_cast<uint64_t>(std::popcount(unsigned{expected[i]}))
                            : expected[i] != 0;
            if (differs) fail_msg("layer %d of format %d", int(layer.index), int(format));
            if (format == LayerFormat::grey)
              assert_true(layer.main().inside_count >= inside);
            else
              assert_int_equal(layer.main().inside_count, inside);
          },
          nullptr);
    }
  return flips;
}

void runs_have_the_bytes_of_single_layers(void**) {
  const double half = cell / 48;
  for (const unsigned threads : {1u, 2u})
    for (const uint64_t limit : {uint64_t{0}, uint64_t{700000}}) {
      const auto context = make_ref<Context>(threads, uint64_t{1} << 20, limit);
      // The box ends within the rows; of all space all rows are alike.
      const Ref<const Shape> box = make_ref<BoxShape>(Box3{{0.15, 0.75, 0.3}, {1.9, 2.51, 2}});
      SlicePlan plan;
      plan.has_region = true;
      plan.region = {{0.1, 0.7, 0.4}, {1.0, 2.7, 0.4 + 12 * half}};
      plan.pitch[0] = 0.0171;
      plan.pitch[1] = 2 * half;
      plan.layer_height = 2 * half;
      size_t of_bits = 0, of_grey = 0;
      // Struts whose surfaces samples lie on: of pixels, and of pixels' halves and quarters.
      for (const double radius :
           {0.03, std::sqrt(10.0) * half, std::sqrt(1.25) * half, std::sqrt(97.0) / 4 * half})
        for (const Ref<const Shape>& shape : {box, Ref<const Shape>(make_ref<AllSpace>())}) {
          const auto model = make_ref<Model>(
              context, shape,
              std::vector<Ref<const Structure>>{lattice(cubic_unit_cell(), radius)});
          for (const SampleWindow& window :
               {SampleWindow{}, SampleWindow{{3, 5, 1}, {40, 60, 3}}}) {
            plan.window = window;
            const auto [bits, grey] = check_runs(model, plan, true);
            of_bits += bits;
            of_grey += grey;
          }
        }
      assert_true(of_bits > 0 && of_grey > 0);
      plan.window = {};
      check_runs(make_ref<Model>(context, box, std::vector<Ref<const Structure>>{}), plan, true);
      plan.pitch[1] = 0x1p-6;
      plan.region = {{0, 0, 0}, {1.0, 2.0, 12 * half}};
      const Ref<const Structure> function = gyroid(0x1p-2);
      check_runs(make_ref<Model>(context, box, std::vector<Ref<const Structure>>{function}), plan,
                 true);
      // Two structures, and a shape whose rows differ.
      check_runs(
          make_ref<Model>(context, box,
                          std::vector<Ref<const Structure>>{
                              function, Ref<const Structure>(lattice(bcc_unit_cell(), 0.05))}),
          plan, false);
      check_runs(make_ref<Model>(context, make_ref<SphereShape>(Vec3{0.5, 1, 0}, 0.9),
                                 std::vector<Ref<const Structure>>{function}),
                 plan, false);
    }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_period_stands_for_all_rows),
      cmocka_unit_test(rows_that_do_not_repeat_have_no_period),
      cmocka_unit_test(layers_of_many_flips_have_all_rows),
      cmocka_unit_test(runs_have_the_bytes_of_single_layers),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
