// SPDX-License-Identifier: Apache-2.0
// The layers of a model, bits and greys, are the same bytes whichever vector instructions draw
// them.
#include <hwy/highway.h>
#include <cstring>

#include "base/random.h"
#include "expression/parser.h"
#include "field/gradient.h"
#include "shape/primitive.h"
#include "slice/slicer.h"
#include "structure/foam/foam.h"
#include "structure/foam/walls/foam_walls.h"
#include "structure/functional/functional.h"
#include "structure/functional/presets.h"
#include "structure/lattice/lattice.h"
#include "structure/lattice/plates/plate_lattice.h"
#include "structure/waves/waves.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

Neighbourhood turned() {
  const double c = std::cos(0.3), s = std::sin(0.3);
  return {{0.1, 0.2, 0.3}, {0.4, 0.4, 0.3}, {{c, -s, 0, s, c, 0, 0, 0, 1}}};
}

/// Cells so small that foams answer point by point.
Neighbourhood few_samples() {
  Neighbourhood grid = turned();
  grid.cell_size = grid.cell_size * 0.05;
  return grid;
}

WaveDirections waves_of(uint32_t count) {
  WaveDirections directions;
  directions.count = count;
  directions.half_angles = {1.2, 0.5, 0};
  return directions;
}

/// Bent cells in the unit cube, by samples 1/8 apart along these axes.
CellShape cells_by_samples(const Rotation& rotation) {
  constexpr uint64_t n = 13;
  const ImageFrame frame{rotation.apply({-0.25, -0.25, -0.25}), {0.125, 0.125, 0.125}, rotation};
  std::vector<double> values[3];
  for (uint64_t i = 0; i < n * n * n; ++i) {
    const double x = static_cast<double>(i % n), y = static_cast<double>(i / n % n),
                 z = static_cast<double>(i / n / n);
    values[0].push_back(0.6 * x + 0.05 * y);
    values[1].push_back(0.5 * y + 0.01 * x * z);
    values[2].push_back(0.7 * z - 0.002 * x * x);
  }
  const auto field = [&](int axis) {
    const Image::Source source{
        values[axis].data(), Image::Type::float64, {n, n, n}, n * 8, n * n * 8};
    return Ref<const GridField>(
        make_ref<GridField>(Image(source, frame, std::make_shared<MemoryBudget>(0))));
  };
  CellShape cells;
  cells.sampled =
      std::make_shared<const SampledMap>(SampledMap::Fields{field(0), field(1), field(2)});
  return cells;
}

using Make = std::function<Ref<const Structure>(Ref<Context>)>;

/// Of a sphere of a structure. `grey`: samples of a pixel along an axis; 0: bits.
uint64_t hash_of(const Make& make, unsigned grey = 0) {
  const Ref<Context> context = make_ref<Context>(2u, uint64_t{1} << 28, uint64_t{0});
  const Ref<Model> model = make_ref<Model>(context, make_ref<SphereShape>(Vec3{0.5, 0.5, 0.5}, 1.0),
                                           std::vector<Ref<const Structure>>{make(context)});
  SlicePlan plan;
  plan.pitch[0] = plan.pitch[1] = 0.011;
  plan.layer_height = 0.02;
  if (grey > 0) {  // several vectors of pixels, and a part of one
    plan.outputs[0].format = LayerFormat::grey;
    plan.outputs[0].grey = {grey, 0.7, 20};
    plan.pitch[0] = plan.pitch[1] = 2.0 / 1237;
    plan.window = {{17, 600, 40}, {1203, 9, 12}};
  }
  const Slicer slicer(Ref<const Model>(model.get()), plan);
  uint64_t hash = 0, count = 0;
  const auto take = [&](const Layer& layer) {
    hash = splitmix_output(hash, layer.main().inside_count);
    for (uint64_t i = 0; i < slicer.layer_bytes(); i += sizeof(uint64_t)) {
      uint64_t word;
      std::memcpy(&word, layer.main().data + i, sizeof word);
      hash = splitmix_finalise(hash ^ splitmix_output(word, ++count));
    }
  };
  slicer.run(0, test_scale() < 0.5 ? slicer.grid().nz / 4 : slicer.grid().nz / 2, take, nullptr);
  return hash;
}

std::vector<int64_t> all_targets() {
  std::vector<int64_t> targets;
  for (int64_t all = hwy::SupportedTargets() & HWY_TARGETS; all; all &= all - 1)
    targets.push_back(all & -all);
  return targets;
}

void all_instruction_sets_give_the_same_greys(void**) {
  const Make gyroid = [](Ref<Context>) {
    return make_ref<Functional>(turned(), parse_expression(preset_expressions[0], {}),
                                FunctionalKind::sheet, Parameter(0.2), 0);
  };
  for (const unsigned samples : {2u, 4u, 8u, 16u}) {
    const uint64_t expected = hash_of(gyroid, samples);
    for (const int64_t target : all_targets()) {
      hwy::SetSupportedTargetsForTest(target);
      const uint64_t hash = hash_of(gyroid, samples);
      hwy::SetSupportedTargetsForTest(0);
      if (hash != expected)
        fail_msg("other greys of %u x %u samples with %s", samples, samples,
                 hwy::TargetName(target));
    }
  }
}

void all_instruction_sets_give_the_same_layers(void**) {
  const Make structures[] = {
      [](Ref<Context>) { return make_ref<Lattice>(turned(), octet_unit_cell(), Parameter(0.02)); },
      [](Ref<Context>) {
        const Ref<const Field> field =
            make_ref<GradientField>(Vec3{0, 0, 0}, 0.01, Vec3{1, 0.5, 0.2}, 0.05);
        return make_ref<Lattice>(Neighbourhood{}, bcc_unit_cell(), Parameter(field));
      },
      [](Ref<Context>) {
        return make_ref<Lattice>(Neighbourhood{{0.1, 0.2, 0.3}, {0.037, 0.21, 0.1}, {}},
                                 kelvin_unit_cell(), Parameter(0.004));
      },
      [](Ref<Context>) {  // steep along the rows
        const Ref<const Field> field =
            make_ref<GradientField>(Vec3{0, 0, 0}, 0.0, Vec3{1, 0.1, 0.2}, 0.02);
        return make_ref<Lattice>(Neighbourhood{{}, {0.1, 0.1, 0.1}, {}}, octet_unit_cell(),
                                 Parameter(field));
      },
      [](Ref<Context> c) {
        return make_ref<Foam>(c, turned(), Parameter(0.03), 1.0, uint64_t{3}, FoamMethod::direct);
      },
      [](Ref<Context> c) {
        return make_ref<Foam>(c, few_samples(), Parameter(0.002), 0.7, uint64_t{3},
                              FoamMethod::direct);
      },
      [](Ref<Context> c) {
        const Ref<const Field> field =
            make_ref<GradientField>(Vec3{0, 0, 0}, 0.0, Vec3{1, 0.5, 0.2}, 0.01);
        return make_ref<Foam>(c, Neighbourhood{{}, {0.03, 0.03, 0.02}, {}}, Parameter(field), 0.9,
                              uint64_t{3}, FoamMethod::direct);
      },
      [](Ref<Context> c) {
        const Ref<const Field> density =
            make_ref<GradientField>(Vec3{0.2, 0, 0}, 1, Vec3{0.5, 0.1, 0}, 60);
        return make_ref<Foam>(c, Neighbourhood{}, Parameter(0.03), 1.0, uint64_t{3},
                              FoamMethod::direct, Parameter(density));
      },
      [](Ref<Context> c) {
        return make_ref<Foam>(c, turned(), Parameter(0.02), 1.0, uint64_t{3}, FoamMethod::direct,
                              Parameter(1), Vec3{1, 3, 1});
      },
      [](Ref<Context> c) {
        return make_ref<FoamWalls>(c, turned(), Parameter(0.03), 1.0, uint64_t{3});
      },
      [](Ref<Context> c) {
        return make_ref<FoamWalls>(c, turned(), Parameter(0.02), 1.0, uint64_t{3}, Parameter(1),
                                   Parameter(0), Vec3{2, 1, 1});
      },
      [](Ref<Context> c) {
        const Ref<const Field> field =
            make_ref<GradientField>(Vec3{0, 0, 0}, 0.0, Vec3{1, 0.5, 0.2}, 0.02);
        return make_ref<FoamWalls>(c, Neighbourhood{{}, {0.1, 0.1, 0.07}, {}}, Parameter(field),
                                   0.9, uint64_t{3});
      },
      [](Ref<Context>) {
        return make_ref<Functional>(turned(), parse_expression(preset_expressions[0], {}),
                                    FunctionalKind::network, Parameter(0.2), 0);
      },
      [](Ref<Context>) {
        const Ref<const Field> field =
            make_ref<GradientField>(Vec3{0, 0, 0}, -0.5, Vec3{1, 0.5, 0.2}, 0.5);
        return make_ref<Functional>(Neighbourhood{}, parse_expression(preset_expressions[6], {}),
                                    FunctionalKind::network, Parameter(field), 0);
      },
      [](Ref<Context>) {
        const char* const text = "min(exp(sin(x)*cos(y))-1,max(log(2+cos(z)),sqrt(x+y)-2))";
        return make_ref<Functional>(Neighbourhood{}, parse_expression(text, {}),
                                    FunctionalKind::sheet, Parameter(0.2), 0);
      },
      [](Ref<Context>) {
        const Neighbourhood grid{{0.5, 0.4, 0}, {0.1, 0.1, 0.13}, {}};
        return make_ref<Functional>(grid, parse_expression(preset_expressions[0], {}),
                                    FunctionalKind::sheet, Parameter(0.3), 0,
                                    Warp(Warp::Kind::cylindrical, grid, {23, 0, 0.1, 0.6}));
      },
      [](Ref<Context>) {
        return make_ref<Functional>(turned(), parse_expression(preset_expressions[6], {}),
                                    FunctionalKind::network, Parameter(0.1), 0,
                                    Warp(Warp::Kind::spherical, turned(), {19, 8, 0, 0}));
      },
      [](Ref<Context>) {
        return make_ref<Functional>(Neighbourhood{}, parse_expression(preset_expressions[6], {}),
                                    FunctionalKind::sheet, Parameter(0.2), 0, cells_by_samples({}));
      },
      [](Ref<Context>) {
        return make_ref<Functional>(Neighbourhood{}, parse_expression(preset_expressions[0], {}),
                                    FunctionalKind::network, Parameter(0.1), 0,
                                    cells_by_samples(turned().rotation));
      },
      [](Ref<Context>) {
        return make_ref<PlateLattice>(Neighbourhood{{}, {0.21, 0.2, 0.23}, {}}, kelvin_plate_cell(),
                                      Parameter(0.02));
      },
      [](Ref<Context>) {
        const Ref<const Field> field =
            make_ref<GradientField>(Vec3{0, 0, 0}, 0.0, Vec3{1, 0.5, 0.2}, 0.1);
        return make_ref<PlateLattice>(Neighbourhood{{}, {0.3, 0.5, 0.4}, {}},
                                      cubic_octet_plate_cell(), Parameter(field));
      },
      [](Ref<Context>) {
        return make_ref<Waves>(turned(), waves_of(50), WavesKind::network, Parameter(0.2));
      },
      [](Ref<Context>) {  // of few samples
        const Ref<const Field> field =
            make_ref<GradientField>(Vec3{0, 0, 0}, 0.1, Vec3{1, 0.5, 0.2}, 0.9);
        return make_ref<Waves>(Neighbourhood{{}, {0.05, 0.04, 0.06}, {}}, waves_of(20),
                               WavesKind::sheet, Parameter(field));
      },
  };
  const std::vector<int64_t> targets = all_targets();
  for (const Make& make : structures) {
    const uint64_t expected = hash_of(make);
    for (const int64_t target : targets) {
      hwy::SetSupportedTargetsForTest(target);
      const uint64_t hash = hash_of(make);
      hwy::SetSupportedTargetsForTest(0);
      if (hash != expected) fail_msg("other layers with %s", hwy::TargetName(target));
    }
  }
  for (const int64_t target : targets) print_message("%s ", hwy::TargetName(target));
  print_message("give the same layers\n");
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(all_instruction_sets_give_the_same_layers),
                              cmocka_unit_test(all_instruction_sets_give_the_same_greys)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
