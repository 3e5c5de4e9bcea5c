// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/foam_data.h"

#include "structure/foam/graded_graph.h"
#include "structure/foam/stretched_graph.h"
#include "structure/foam/uniform_graph.h"
#include "structure/foam/weighted_graph.h"

namespace msq {

namespace {

std::shared_ptr<const GradedSeeds> grade(const FoamSeeds& seeds, const Neighbourhood& grid,
                                         Parameter density,
                                         std::shared_ptr<const PlacedSeeds> placed) {
  if (placed) return std::make_shared<const GradedSeeds>(seeds, std::move(placed));
  if (!(density.range().high > 1)) return nullptr;
  return std::make_shared<const GradedSeeds>(seeds, grid, std::move(density));
}

std::unique_ptr<const FoamGraph> make_graph(const FoamSeeds& seeds,
                                            const std::shared_ptr<const GradedSeeds>& graded,
                                            const Stretch* stretch) {
  if (graded) return std::make_unique<const GradedGraph>(graded);
  if (stretch) return std::make_unique<const StretchedGraph>(*stretch);
  if (seeds.is_weighted()) return std::make_unique<const WeightedGraph>(seeds);
  return std::make_unique<const UniformGraph>(seeds);
}

}  // namespace

FoamData::FoamData(Ref<Context> context, const Neighbourhood& neighbourhood, Parameter radius,
                   double jitter, uint64_t seed, Parameter density, Vec3 stretch, double weight,
                   std::shared_ptr<const PlacedSeeds> placed)
    : Structure(neighbourhood, placed ? placed->largest() : max_component(neighbourhood.cell_size)),
      context_(std::move(context)),
      id_(context_->new_structure_id()),
      brick_parts_id_(context_->new_structure_id()),
      ray_bricks_id_(context_->new_structure_id()),
      cell_lists_id_(context_->new_structure_id()),
      ray_demand_id_(context_->new_structure_id()),
      paper_cells_id_(context_->new_structure_id()),
      radius_(std::move(radius)),
      unit_(max_component(neighbourhood.cell_size)),
      seeds_(seed, jitter, neighbourhood.cell_size * (1 / unit_), weight / unit_),
      placed_(std::move(placed)),
      graded_(grade(seeds_, neighbourhood, std::move(density), placed_)),
      stretch_(Stretch::is_any(stretch)
                   ? std::make_unique<const Stretch>(neighbourhood, jitter, seed, stretch)
                   : nullptr),
      graph_(make_graph(seeds_, graded_, stretch_.get())) {}

FoamData::~FoamData() {
  for (const uint64_t id :
       {id_, brick_parts_id_, ray_bricks_id_, cell_lists_id_, ray_demand_id_, paper_cells_id_})
    context_->cache.drop(id);
}

CellIndex FoamData::cell_of(Vec3 p) const {
  return placed_ ? placed_->cell_of(neighbourhood().to_grid(p)) : Structure::cell_of(p);
}

double FoamData::owner_distance() const {
  return stretch_ ? 0 : seeds_.empty_radius() * unit_ * (1 + 1e-9);
}

Vec3 FoamData::owner_reach() const {
  return stretch_ ? stretch_->reach() * unit_ : Vec3{};
}

double FoamData::max_radius(CellIndex cell, double margin) const {
  if (radius_.is_constant()) return max_radius();
  const Neighbourhood& grid = neighbourhood();
  const Vec3 low = Vec3{double(cell.x), double(cell.y), double(cell.z)} * grid.cell_size;
  const Box3 box = Box3{low, low + grid.cell_size}.grown(margin * unit_);
  return radius_.range(grid.from_grid(box)).high / unit_;
}

}  // namespace msq
