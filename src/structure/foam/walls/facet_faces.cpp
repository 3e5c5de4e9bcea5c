// SPDX-License-Identifier: Apache-2.0
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "structure/foam/walls/facet_faces.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/borrowed.h"
#include "base/job.h"
#include "structure/foam/walls/facet_faces.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

/// Half-way to each neighbour. A plane d . x = |d|^2 / 2 of the diagram is (d / factor) . X =
/// |d|^2 / 2 where X = factor x.
void make_faces(const FacetCells::Cell& cell, Vec3 scale, Vec3 factor, FaceBrick::Face* faces) {
  const hn::CappedTag<double, FacetCells::padding> d;
  const hn::Rebind<float, decltype(d)> df;
  const auto half = hn::Set(d, 0.5), one = hn::Set(d, 1);
  const auto sx = hn::Set(d, scale.x), sy = hn::Set(d, scale.y), sz = hn::Set(d, scale.z);
  const auto fx = hn::Set(d, 1 / factor.x), fy = hn::Set(d, 1 / factor.y),
             fz = hn::Set(d, 1 / factor.z);
  for (size_t i = 0; i < cell.count; i += hn::Lanes(d)) {
    const auto x = hn::Mul(hn::PromoteTo(d, hn::LoadU(df, cell.x + i)), sx),
               y = hn::Mul(hn::PromoteTo(d, hn::LoadU(df, cell.y + i)), sy),
               z = hn::Mul(hn::PromoteTo(d, hn::LoadU(df, cell.z + i)), sz);
    const auto squared = hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z));
    const auto nx = hn::Mul(x, fx), ny = hn::Mul(y, fy), nz = hn::Mul(z, fz);
    const auto size = hn::Sqrt(hn::Add(hn::Add(hn::Mul(nx, nx), hn::Mul(ny, ny)), hn::Mul(nz, nz)));
    const auto inverse = hn::Div(one, size);
    hn::StoreInterleaved4(
        hn::DemoteTo(df, hn::Mul(nx, inverse)), hn::DemoteTo(df, hn::Mul(ny, inverse)),
        hn::DemoteTo(df, hn::Mul(nz, inverse)),
        hn::DemoteTo(df, hn::Mul(hn::Mul(squared, half), inverse)), df, faces[i].normal);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

HWY_EXPORT(make_faces);

bool FacetFaces::build(const FoamSeeds& seeds, CellIndex corner, Vec3 factor,
                       std::vector<FaceBrick::Cell>& cells, std::vector<FaceBrick::Face>& faces) {
  constexpr int side = FaceBrick::side;
  static_assert(side == FacetWalk::side);
  static_assert(sizeof(FaceBrick::Face) == 4 * sizeof(float));
  if (!FacetWalk::suits(seeds)) return false;
  const Borrowed<FacetWalk> walk;
  if (!walk->build(seeds, corner)) return false;
  const FacetState& state = walk->state();
  cells_.find(state);
  const Vec3 scale = seeds.scale(), middle = scale * (0.5 * side);
  for (int z = 0; z < side; ++z)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        cells_.read(state, x, y, z, cell_);
        HWY_DYNAMIC_DISPATCH(make_faces)(cell_, scale, factor, faces_);
        const Vec3 seed = Vec3{cell_.own[0], cell_.own[1], cell_.own[2]} * scale;
        FaceBrick::Cell cell{(seed + middle) * factor,
                             {},
                             {},
                             static_cast<uint32_t>(faces.size()),
                             static_cast<uint32_t>(cell_.count)};
        const Box3 box{{cell_.low[0], cell_.low[1], cell_.low[2]},
                       {cell_.high[0], cell_.high[1], cell_.high[2]}};
        cell.set_box({(box.min - seed) * factor, (box.max - seed) * factor});
        cells.push_back(cell);
        faces.insert(faces.end(), faces_, faces_ + cell_.count);
      }
  return true;
}

}  // namespace msq
#endif  // HWY_ONCE
