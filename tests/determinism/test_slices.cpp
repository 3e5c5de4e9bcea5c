// SPDX-License-Identifier: Apache-2.0
// The layers of a model are the same bytes whatever the threads, the slab height, the cache, and
// however the plan is split, by layers or by windows; and they are what set queries and point
// queries answer.
#include <bit>
#include <functional>

#include "base/random.h"
#include "beam_lists.h"
#include "expression/parser.h"
#include "field/gradient.h"
#include "meshes.h"
#include "query/array_points.h"
#include "query/grid_points.h"
#include "query/membership.h"
#include "random.h"
#include "shape/mesh.h"
#include "shape/primitive.h"
#include "slice/slicer.h"
#include "structure/beams/beams.h"
#include "structure/combined/blended_structure.h"
#include "structure/combined/boolean_structure.h"
#include "structure/combined/smooth_boolean.h"
#include "structure/common/warp_shell.h"
#include "structure/foam/foam.h"
#include "structure/foam/paper/delaunay.h"
#include "structure/foam/seeds/period_seeds.h"
#include "structure/foam/seeds/warp_seeds.h"
#include "structure/foam/shell/shelled_foam.h"
#include "structure/foam/walled_foam.h"
#include "structure/functional/functional.h"
#include "structure/functional/presets.h"
#include "structure/lattice/lattice.h"
#include "structure/lattice/plated_lattice.h"
#include "structure/lattice/warped/graded_places.h"
#include "structure/lattice/warped/round_places.h"
#include "structure/lattice/warped/warped_lattice.h"
#include "structure/waves/waves.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

using Structures = std::vector<Ref<const Structure>>;

struct ModelRow {
  std::string name;
  uint32_t cell_layers;  ///< layers in a cell of the finest scale
  std::function<Ref<Model>(Ref<Context>)> make;
  double unit = 1;  ///< pitch and layers are multiples of it
};

Ref<const Shape> mesh(const TriangleSoup& soup) {
  return make_ref<Mesh>(soup, WindingRule::nonzero, std::make_shared<MemoryBudget>(uint64_t{0}));
}

Neighbourhood cells_of(double size, double turn) {
  const double c = std::cos(turn), s = std::sin(turn);
  return {{0.1, 0.2, 0.3}, {size, size, size}, {{c, -s, 0, s, c, 0, 0, 0, 1}}};
}

Ref<const Structure> foam(Ref<Context> context, double size, double radius, FoamMethod method) {
  return make_ref<Foam>(std::move(context), cells_of(size, 0.3), Parameter(radius), 1.0,
                        uint64_t{6}, method);
}

Ref<const Structure> gyroid(const Neighbourhood& grid, FunctionalKind kind, double level,
                            CellShape cells = {}) {
  return make_ref<Functional>(grid, parse_expression(preset_expressions[0], {}), kind,
                              Parameter(level), 0, std::move(cells));
}

Ref<const Structure> waves(const Neighbourhood& grid, uint32_t count) {
  WaveDirections directions;
  directions.count = count;
  directions.half_angles = {0.9, 0.5, 0};
  return make_ref<Waves>(grid, directions, WavesKind::sheet, Parameter(0.25));
}

Ref<const Structure> random_beams(const Context& context) {
  Random random(3);
  std::vector<Beam> beams(300, Beam{});
  for (Beam& beam : beams) {
    beam.a = random.in_box({{-0.6, -0.5, -0.3}, {0.6, 0.5, 0.3}});
    beam.b = beam.a + random.in_box({{-0.2, -0.2, -0.2}, {0.2, 0.2, 0.2}});
    beam.radius_a = random.between(0.005, 0.03);
    beam.radius_b = random.between(0.005, 0.03);
  }
  return Beams::make(source_of(beams), 0, context.executor, context.budget, nullptr);
}

/// Cells whose size varies along an axis.
GradedPeriod period_of(int axis, double size) {
  return GradedPeriod(axis, {{-0.5, size}, {-0.1, 0.5 * size}, {0.3, 1.3 * size}});
}

Ref<const Structure> graded_lattice(Ref<Context> context, const Neighbourhood& grid) {
  return make_ref<WarpedLattice>(
      std::move(context),
      std::make_unique<const GradedPlaces>(grid, period_of(0, grid.cell_size.x)), bcc_unit_cell(),
      Parameter(0.03));
}

Neighbourhood round_cells(double size) {
  return {{-0.2, 0.1, 0.05}, {size, size, size}, {}};
}

constexpr double layer_height = 0.05;

Ref<const Shape> flat_box() {
  return make_ref<BoxShape>(Box3{{-0.5, -0.4, -0.2}, {0.5, 0.4, 0.2}});
}

/// Pairs of kinds.
void add_pairs(std::vector<ModelRow>& rows) {
  rows.push_back({"waves in a vented wall foam", 8, [](Ref<Context> c) {
                    return make_ref<Model>(
                        c, flat_box(),
                        Structures{make_ref<FoamWalls>(c, cells_of(0.4, 0.3), Parameter(0.12), 1.0,
                                                       uint64_t{2}, Parameter(1), Parameter(0.06)),
                                   waves(cells_of(0.1, 0.2), 30)});
                  }});
  rows.push_back(
      {"plates, struts and a graded period", 8, [](Ref<Context> c) {
         const Neighbourhood grid = cells_of(0.5, 0.2);
         return make_ref<Model>(
             c, flat_box(),
             Structures{
                 make_ref<PlatedLattice>(
                     make_ref<Lattice>(grid, bcc_unit_cell(), Parameter(0.06)),
                     make_ref<PlateLattice>(grid, cubic_octet_plate_cell(), Parameter(0.12))),
                 gyroid(cells_of(0.2, 0), FunctionalKind::sheet, 0.4, period_of(1, 0.2))});
       }});
  rows.push_back(
      {"beams or warped cells", 6, [](Ref<Context> c) {
         const Neighbourhood round = round_cells(0.3);
         const Warp around(Warp::Kind::cylindrical, round, {9, 0, 0.2, 0.7});
         const Warp shells(Warp::Kind::spherical, {{}, round.cell_size, {}}, {8, 5, 0.1, 0});
         return make_ref<Model>(
             c, flat_box(),
             Structures{make_ref<BooleanStructure>(
                 BooleanStructure::Operation::united,
                 StructureList{
                     random_beams(*c), gyroid(round, FunctionalKind::network, -0.6, around),
                     make_ref<WarpedLattice>(c, std::make_unique<const RoundPlaces>(shells),
                                             cubic_unit_cell(), Parameter(0.03))})});
       }});
  rows.push_back(
      {"blend of a graded lattice to a gyroid", 6, [](Ref<Context> c) {
         const Ref<const Field> fraction =
             make_ref<GradientField>(Vec3{-0.4, 0, 0}, 0, Vec3{0.4, 0.2, 0.1}, 1);
         return make_ref<Model>(
             c, flat_box(),
             Structures{make_ref<BlendedStructure>(
                 graded_lattice(c, cells_of(0.3, 0.2)),
                 gyroid(cells_of(0.25, 0), FunctionalKind::sheet, 0.3), Parameter(fraction))});
       }});
  rows.push_back({"skin and smooth foam in two regions", 8, [](Ref<Context> c) {
                    const Ref<const Structure> smooth = make_ref<SmoothBoolean>(
                        BooleanStructure::Operation::united, foam(c, 0.4, 0.05, FoamMethod::direct),
                        make_ref<Lattice>(cells_of(0.3, 0), octet_unit_cell(), Parameter(0.02)),
                        Parameter(0.05));
                    const Ref<const Structure> fine =
                        make_ref<Lattice>(cells_of(0.2, 0.1), kelvin_unit_cell(), Parameter(0.015));
                    const Ref<const Model> ball =
                        make_ref<Model>(c, make_ref<SphereShape>(Vec3{0.1, 0, 0}, 0.3),
                                        std::vector<Model::ScaleParts>{{smooth, Parameter(0.04)}});
                    const Ref<const Model> rest = make_ref<Model>(c, flat_box(), Structures{fine});
                    return make_ref<Model>(c, std::vector<Ref<const Model>>{ball, rest});
                  }});
}

/// A foam in a sheet of a function, `cells` cells away from the origin of their grids.
ModelRow placed(const std::string& name, double unit, double cells) {
  return {name, 8,
          [unit, cells](Ref<Context> c) {
            const double size = 0.4 * unit, away = cells * size;
            const Vec3 middle{away, -0.5 * away, 0.25 * away}, half = Vec3{0.5, 0.4, 0.2} * unit;
            const Neighbourhood grid{{0.1 * unit, 0.2 * unit, 0}, {size, size, size}, {}};
            return make_ref<Model>(c, make_ref<BoxShape>(Box3{middle - half, middle + half}),
                                   Structures{gyroid(grid, FunctionalKind::sheet, 0.6),
                                              make_ref<Foam>(c, grid, Parameter(0.12 * unit), 1.0,
                                                             uint64_t{6}, FoamMethod::direct)});
          },
          unit};
}

std::vector<ModelRow> models() {
  std::vector<ModelRow> rows;
  rows.push_back(placed("1e7 cells away", 1, 1e7));
  rows.push_back(placed("a millionth as large", 1e-6, 3));
  rows.push_back(placed("a million times as large, 1e6 cells away", 1e6, 1e6));
  rows.push_back({"mesh and foam", 8, [](Ref<Context> c) {
                    return make_ref<Model>(c, mesh(torus_mesh(1.2, 0.5, 30, 20)),
                                           Structures{foam(c, 0.4, 0.05, FoamMethod::direct)});
                  }});
  rows.push_back(
      {"mesh and graded lattice", 6, [](Ref<Context> c) {
         const Ref<const Field> field =
             make_ref<GradientField>(Vec3{-1, 0, 0}, 0.01, Vec3{1, 0.5, 0.2}, 0.06);
         return make_ref<Model>(
             c, mesh(icosphere(1, 3)),
             Structures{make_ref<Lattice>(cells_of(0.3, 0), octet_unit_cell(), Parameter(field))});
       }});
  rows.push_back(
      {"three scales", 5, [](Ref<Context> c) {
         return make_ref<Model>(
             c, make_ref<SphereShape>(Vec3{0, 0, 0}, 1.1),
             Structures{make_ref<Lattice>(cells_of(0.8, 0.2), bcc_unit_cell(), Parameter(0.15)),
                        foam(c, 0.25, 0.03, FoamMethod::direct)});
       }});
  rows.push_back({"foam without jitter, turned", 5, [](Ref<Context> c) {
                    Neighbourhood grid = cells_of(0.25, 0.3);
                    grid.cell_size.y = 0.35;
                    return make_ref<Model>(
                        c, make_ref<BoxShape>(Box3{{-1, -0.4, -0.3}, {1, 0.4, 0.3}}),
                        Structures{make_ref<Foam>(c, grid, Parameter(0.03), 0.0, uint64_t{6},
                                                  FoamMethod::direct)});
                  }});
  rows.push_back(
      {"foam of graded density", 8, [](Ref<Context> c) {
         const Ref<const Field> density =
             make_ref<GradientField>(Vec3{-0.4, 0, 0}, 1, Vec3{0.4, 0.2, 0.1}, 30);
         return make_ref<Model>(
             c, make_ref<BoxShape>(Box3{{-0.5, -0.4, -0.2}, {0.5, 0.4, 0.2}}),
             Structures{make_ref<Foam>(c, cells_of(0.4, 0.3), Parameter(0.02), 1.0, uint64_t{6},
                                       FoamMethod::direct, Parameter(density))});
       }});
  rows.push_back(
      {"stretched walls in a stretched foam", 8, [](Ref<Context> c) {
         return make_ref<Model>(
             c, make_ref<BoxShape>(Box3{{-0.5, -0.4, -0.2}, {0.5, 0.4, 0.2}}),
             Structures{
                 make_ref<Foam>(c, cells_of(0.6, 0.2), Parameter(0.1), 1.0, uint64_t{6},
                                FoamMethod::direct, Parameter(1), Vec3{1, 2.5, 1}),
                 make_ref<FoamWalls>(c, cells_of(0.4, 0.3), Parameter(0.04), 1.0, uint64_t{2},
                                     Parameter(1), Parameter(0), Vec3{3, 1, 0.8})});
       }});
  rows.push_back(
      {"walls in a foam, both with periods", 8, [](Ref<Context> c) {
         const auto places = [](int axis, double size, double origin) {
           return std::make_shared<const PeriodSeeds>(cells_of(size, origin), period_of(axis, size),
                                                      1.0, uint64_t{6});
         };
         const std::shared_ptr<const PlacedSeeds> coarse = places(0, 0.6, 0.2),
                                                  fine = places(2, 0.4, 0.3);
         return make_ref<Model>(
             c, make_ref<BoxShape>(Box3{{-0.5, -0.4, -0.2}, {0.5, 0.4, 0.2}}),
             Structures{
                 make_ref<Foam>(c, coarse->grid(), Parameter(0.1), 1.0, uint64_t{6},
                                FoamMethod::direct, Parameter(1), Vec3{1, 1, 1}, 0.0, coarse),
                 make_ref<FoamWalls>(c, fine->grid(), Parameter(0.04), 1.0, uint64_t{6},
                                     Parameter(1), Parameter(0), Vec3{1, 1, 1}, 0.0, fine)});
       }});
  rows.push_back(
      {"walls in a foam, both around an axis", 8, [](Ref<Context> c) {
         const auto warp = [](double size, double origin, double outer) {
           return Warp(Warp::Kind::cylindrical, cells_of(size, origin), {12, 0, 0.25, outer});
         };
         const auto places = [&c](const Warp& shell) {
           return std::make_shared<const WarpSeeds>(c, shell, 1.0, uint64_t{6});
         };
         const Warp wide = warp(0.4, 0.2, 0.7), narrow = warp(0.3, 0.15, 0.6);
         const std::shared_ptr<const PlacedSeeds> coarse = places(wide), fine = places(narrow);
         return make_ref<Model>(
             c, make_ref<BoxShape>(Box3{{-0.5, -0.4, -0.2}, {0.5, 0.4, 0.2}}),
             Structures{
                 make_ref<ShelledFoam>(
                     make_ref<Foam>(c, coarse->grid(), Parameter(0.08), 1.0, uint64_t{6},
                                    FoamMethod::direct, Parameter(1), Vec3{1, 1, 1}, 0.0, coarse),
                     std::make_shared<const WarpShell>(wide)),
                 make_ref<ShelledFoam>(
                     make_ref<FoamWalls>(c, fine->grid(), Parameter(0.04), 1.0, uint64_t{6},
                                         Parameter(1), Parameter(0), Vec3{1, 1, 1}, 0.0, fine),
                     std::make_shared<const WarpShell>(narrow))});
       }});
  rows.push_back(
      {"weighted walls in a weighted foam", 8, [](Ref<Context> c) {
         return make_ref<Model>(
             c, make_ref<BoxShape>(Box3{{-0.5, -0.4, -0.2}, {0.5, 0.4, 0.2}}),
             Structures{
                 make_ref<Foam>(c, cells_of(0.6, 0.2), Parameter(0.1), 1.0, uint64_t{6},
                                FoamMethod::direct, Parameter(1), Vec3{1, 1, 1}, 0.6),
                 make_ref<FoamWalls>(c, cells_of(0.4, 0.3), Parameter(0.04), 1.0, uint64_t{2},
                                     Parameter(1), Parameter(0), Vec3{1, 1, 1}, 0.2)});
       }});
  rows.push_back(
      {"walls in a foam with struts and walls", 8, [](Ref<Context> c) {
         const Ref<const Field> field =
             make_ref<GradientField>(Vec3{-1, 0, 0}, 0.01, Vec3{1, 0.5, 0.2}, 0.09);
         const Neighbourhood coarse = cells_of(0.8, 0.2);
         return make_ref<Model>(
             c, make_ref<SphereShape>(Vec3{0, 0, 0}, 1.1),
             Structures{
                 make_ref<WalledFoam>(
                     make_ref<Foam>(c, coarse, Parameter(0.2), 1.0, uint64_t{6},
                                    FoamMethod::direct),
                     make_ref<FoamWalls>(c, coarse, Parameter(0.2), 1.0, uint64_t{6})),
                 make_ref<FoamWalls>(c, cells_of(0.3, 0.3), Parameter(field), 1.0, uint64_t{2})});
       }});
  rows.push_back(
      {"graded expression in a gyroid", 8, [](Ref<Context> c) {
         const Ref<const Field> field =
             make_ref<GradientField>(Vec3{-1, 0, 0}, 0.1, Vec3{1, 0.5, 0.2}, 0.6);
         const Tape gyroid = parse_expression("sin(x)*cos(y)+sin(y)*cos(z)+sin(z)*cos(x)", {});
         const Tape choice = parse_expression("max(cos(x)+cos(y)*cos(z),sqrt(x)-exp(sin(y)))", {});
         return make_ref<Model>(
             c, make_ref<SphereShape>(Vec3{0, 0, 0}, 1.1),
             Structures{make_ref<Functional>(cells_of(0.8, 0.2), gyroid, FunctionalKind::network,
                                             Parameter(0.3), 0),
                        make_ref<Functional>(cells_of(0.4, 0), choice, FunctionalKind::sheet,
                                             Parameter(field), 0)});
       }});
  add_pairs(rows);
  if (can_triangulate())
    rows.push_back({"foam by METHOD_2", 8, [](Ref<Context> c) {
                      return make_ref<Model>(
                          c, make_ref<BoxShape>(Box3{{-0.6, -0.6, -0.3}, {0.6, 0.6, 0.3}}),
                          Structures{foam(c, 0.4, 0.05, FoamMethod::method_2)});
                    }});
  return rows;
}

SlicePlan plan_of(const ModelRow& row, uint32_t slab_layers) {
  SlicePlan plan;
  plan.pitch[0] = 0.02 * row.unit;
  plan.pitch[1] = 0.025 * row.unit;
  plan.layer_height = layer_height * row.unit;
  plan.slab_layers = slab_layers;
  return plan;
}

/// Bytes of all layers, their order and their counts in one number.
class Hash {
 public:
  void add(const Layer& layer, uint64_t bytes) {
    add(layer.index);
    add(layer.main().inside_count);
    for (uint64_t i = 0; i < bytes; i += sizeof(uint64_t)) {
      uint64_t word;
      std::memcpy(&word, layer.main().data + i, sizeof word);
      add(word);
    }
  }
  void add(uint64_t word) { value_ = splitmix_finalise(value_ ^ splitmix_output(word, ++count_)); }
  uint64_t value() const { return value_; }

 private:
  uint64_t value_ = 0, count_ = 0;
};

uint64_t hash_of(const ModelRow& row, unsigned threads, uint32_t slab_layers, uint64_t cache) {
  const bool beyond_cores = true;  // that many threads, on any machine
  const Ref<Context> context = make_ref<Context>(threads, cache, uint64_t{0}, beyond_cores);
  assert_int_equal(context->executor.threads(), threads);
  const Ref<Model> model = row.make(context);
  const Slicer slicer(Ref<const Model>(model.get()), plan_of(row, slab_layers));
  Hash hash;
  slicer.run(
      0, slicer.grid().nz, [&](const Layer& layer) { hash.add(layer, slicer.layer_bytes()); },
      nullptr);
  return hash.value();
}

void test_settings(void** state) {
  const ModelRow& row = *static_cast<const ModelRow*>(*state);
  const uint64_t expected = hash_of(row, 1, 0, uint64_t{1} << 30);
  size_t count = 0;
  for (uint64_t cache : {uint64_t{0}, uint64_t{64} << 10, uint64_t{1} << 30})
    for (unsigned threads : {1u, 2u, 3u, 8u})
      for (uint32_t slab : {1u, 2u, 7u, row.cell_layers, 1000000u}) {
        // Slow builds take each setting once; so do small caches, where every tile builds its
        // cells.
        if ((test_scale() < 0.5 || cache < 1 << 20) && (threads + slab + cache / 65536) % 3 != 1)
          continue;
        ++count;
        if (hash_of(row, threads, slab, cache) == expected) continue;
        fail_msg("other layers with %u threads, slabs of %u layers, a cache of %llu bytes", threads,
                 slab, static_cast<unsigned long long>(cache));
      }
  print_message("%zu settings, the same layers\n", count);
}

/// All that layers may hold at once, by many threads: the bytes of contours and of coverage.
uint64_t hash_of_outputs(const ModelRow& row, unsigned threads, uint32_t slab_layers,
                         uint64_t cache) {
  const Ref<Context> context = make_ref<Context>(threads, cache, uint64_t{0}, true);
  const Ref<Model> model = row.make(context);
  SlicePlan plan = plan_of(row, slab_layers);
  plan.layer_height *= 3;
  plan.outputs.resize(3);
  plan.outputs[0].format = LayerFormat::grey;
  plan.outputs[1].format = LayerFormat::contours;
  plan.outputs[1].contours.tolerance = 0.02 * row.unit;
  const Slicer slicer(Ref<const Model>(model.get()), plan);
  Hash hash;
  slicer.run(
      0, slicer.grid().nz,
      [&](const Layer& layer) {
        hash.add(layer, slicer.layer_bytes());
        const LayerPart &rings = layer.parts[1], &bits = layer.parts[2];
        hash.add(bits.inside_count);
        hash.add(rings.contours->ring_count());
        const auto* points = static_cast<const double*>(rings.contours->points());
        for (uint64_t i = 0; i < 2 * rings.contours->point_count(); ++i)
          hash.add(std::bit_cast<uint64_t>(points[i]));
      },
      nullptr);
  return hash.value();
}

void test_outputs(void** state) {
  const ModelRow& row = *static_cast<const ModelRow*>(*state);
  const uint64_t expected = hash_of_outputs(row, 1, 0, uint64_t{1} << 30);
  for (unsigned threads : {2u, 3u, 8u}) {
    if (test_scale() < 0.5 && threads == 3) continue;
    if (hash_of_outputs(row, threads, threads, uint64_t{1} << 30) != expected)
      fail_msg("other layers with %u threads", threads);
  }
}

void test_split(void** state) {
  const ModelRow& row = *static_cast<const ModelRow*>(*state);
  const Ref<Model> model = row.make(make_ref<Context>(2u, uint64_t{1} << 30, uint64_t{0}));
  const Slicer slicer(Ref<const Model>(model.get()), plan_of(row, 0));
  const uint64_t layers = slicer.grid().nz, bytes = slicer.layer_bytes();
  std::vector<uint8_t> whole(layers * bytes), split(layers * bytes), single(bytes);
  const auto into = [&](std::vector<uint8_t>& out) {
    return [&](const Layer& layer) {
      std::memcpy(out.data() + layer.index * bytes, layer.main().data, bytes);
    };
  };
  slicer.run(0, layers, into(whole), nullptr);
  for (uint64_t part : {uint64_t{1}, uint64_t{3}, uint64_t{8}, layers - 1}) {
    std::fill(split.begin(), split.end(), uint8_t{0x55});
    for (uint64_t first = 0; first < layers; first += part)
      slicer.run(first, std::min(layers, first + part), into(split), nullptr);
    assert_memory_equal(whole.data(), split.data(), whole.size());
  }
  for (uint64_t k = 0; k < layers; k += 3) {
    slicer.slice_layer(k, single.data(), nullptr);
    assert_memory_equal(whole.data() + k * bytes, single.data(), bytes);
  }
}

/// Layers, and a grid of points, in windows cut at random.
void test_windows(void** state) {
  const ModelRow& row = *static_cast<const ModelRow*>(*state);
  SlicePlan plan = plan_of(row, 0);
  plan.outputs[0].format = LayerFormat::bytes;
  const Ref<const Model> whole_model(row.make(make_ref<Context>(1u, uint64_t{1} << 30, 0u)).get());
  const Slicer whole(whole_model, plan);
  const SampleGrid& grid = whole.grid();
  std::vector<uint8_t> wanted(grid.nz * grid.ny * grid.nx);
  const auto copy = [&](const Slicer& slicer, const uint8_t* layer, uint64_t k, uint8_t* to) {
    const SampleGrid& part = slicer.grid();
    for (uint64_t j = 0; j < part.ny; ++j)
      std::memcpy(to + part.first[0] + grid.nx * (part.first[1] + j + grid.ny * k),
                  layer + j * slicer.stride(), part.nx);
  };
  whole.run(
      0, grid.nz,
      [&](const Layer& layer) { copy(whole, layer.main().data, layer.index, wanted.data()); },
      nullptr);
  Random random(1);
  const auto cuts = [&](uint64_t count) {
    std::vector<uint64_t> at = {0, count};
    for (uint64_t n = random.below(4); n > 0; --n) at.push_back(random.below(count));
    std::sort(at.begin(), at.end());
    at.erase(std::unique(at.begin(), at.end()), at.end());
    return at;
  };
  size_t count = 0;
  for (size_t n = test_count(4); n > 0; --n) {
    const auto x = cuts(grid.nx), y = cuts(grid.ny), z = cuts(grid.nz);
    const auto threads = static_cast<unsigned>(1 + random.below(3));
    const Ref<const Model> model(
        row.make(make_ref<Context>(threads, uint64_t{random.below(2)} << 26, 0u)).get());
    std::vector<uint8_t> got(wanted.size(), 0x55), asked(wanted.size());
    plan.slab_layers = static_cast<uint32_t>(random.below(5));
    for (size_t c = 0; c + 1 < z.size(); ++c)
      for (size_t b = 0; b + 1 < y.size(); ++b)
        for (size_t a = 0; a + 1 < x.size(); ++a, ++count) {
          plan.window = {{x[a], y[b], z[c]}, {x[a + 1] - x[a], y[b + 1] - y[b], z[c + 1] - z[c]}};
          const Slicer slicer(model, plan);
          const SampleGrid& part = slicer.grid();
          if (random.below(3)) {
            slicer.run(
                0, part.nz,
                [&](const Layer& layer) {
                  assert_true(layer.z == grid.z(z[c] + layer.index));
                  copy(slicer, layer.main().data, z[c] + layer.index, got.data());
                },
                nullptr);
          } else {
            std::vector<uint8_t> single(slicer.layer_bytes());
            for (uint64_t k = 0; k < part.nz; ++k) {
              slicer.slice_layer(k, single.data(), nullptr);
              copy(slicer, single.data(), z[c] + k, got.data());
            }
          }
          asked.resize(part.nx * part.ny * part.nz);
          set_membership(*model, model->resolved(0), GridPoints(part), {}, asked.data(), nullptr);
          for (uint64_t i = 0; i < asked.size(); ++i) {
            const uint64_t at =
                x[a] + i % part.nx +
                grid.nx * (y[b] + i / part.nx % part.ny + grid.ny * (z[c] + i / part.nx / part.ny));
            if ((asked[i] != 0) != (wanted[at] != 0)) fail_msg("point %d of a window", int(i));
          }
        }
    assert_memory_equal(wanted.data(), got.data(), wanted.size());
  }
  print_message("%zu windows, the same bytes\n", count);
}

void test_queries(void** state) {
  const ModelRow& row = *static_cast<const ModelRow*>(*state);
  const Ref<Model> model = row.make(make_ref<Context>(2u, uint64_t{1} << 30, uint64_t{0}));
  const Slicer slicer(Ref<const Model>(model.get()), plan_of(row, 3));
  const SampleGrid& grid = slicer.grid();
  const auto resolved = model->resolved(0);
  const uint64_t layer = grid.nx * grid.ny;
  std::vector<uint8_t> sliced, asked(layer * grid.nz), alone(layer);
  slicer.run(
      0, grid.nz,
      [&](const Layer& l) {
        for (uint64_t j = 0; j < grid.ny; ++j)
          for (uint64_t i = 0; i < grid.nx; ++i)
            sliced.push_back(l.main().data[j * slicer.stride() + i / 8] >> (7 - i % 8) & 1);
      },
      nullptr);
  grid_membership(*model, resolved, grid, asked.data(), nullptr);
  assert_memory_equal(sliced.data(), asked.data(), asked.size());
  // Some layers by the array query, in an order of its own, and by the definition.
  uint64_t held = 0;
  for (uint64_t k = 1; k < grid.nz; k += test_scale() < 0.5 ? 12 : 4) {
    std::vector<Vec3> points(layer);
    const auto other = [&](uint64_t i) { return (i * 7919 + 13) % layer; };
    if (layer % 7919 == 0) fail_msg("the order repeats points");
    for (uint64_t i = 0; i < layer; ++i)
      points[i] = grid.at(other(i) % grid.nx, other(i) / grid.nx, k);
    const PointArray array{reinterpret_cast<const unsigned char*>(points.data()), layer,
                           sizeof(Vec3), false};
    set_membership(*model, resolved, ArrayPoints(array), {}, alone.data(), nullptr);
    for (uint64_t i = 0; i < layer; ++i) {
      held += alone[i];
      assert_int_equal(alone[i], sliced[k * layer + other(i)]);
      if (i % 5 == 0) assert_int_equal(alone[i], model->inside(points[i], resolved));
    }
  }
  assert_true(held > 0);
}

}  // namespace

int main() {
  std::vector<ModelRow> rows = models();
  int failed = run_for_each("settings", rows, test_settings);
  failed += run_for_each("outputs", rows, test_outputs);
  failed += run_for_each("split plans", rows, test_split);
  failed += run_for_each("windows", rows, test_windows);
  failed += run_for_each("slices and queries", rows, test_queries);
  return failed;
}
