// SPDX-License-Identifier: Apache-2.0
#include "structure/lattice/mixed/mixed_part_lists.h"

#include "base/job.h"

namespace msq {

namespace {

/// Number along an axis of the cell; coarser for libraries with long lists.
constexpr int fine_parts = 4, coarse_parts = 2;
constexpr size_t few_types = 16;
constexpr uint32_t known_cells = 8;  // along an axis

}  // namespace

MixedParts::MixedParts(const std::vector<Neighbour>& neighbours, Vec3 cell_size, double most)
    : parts_(neighbours[0].near.size() <= few_types ? fine_parts : coarse_parts) {
  const Vec3 size = cell_size * (1.0 / parts_);
  const double slack = 1e-6 * (max_component(cell_size) + most);
  for (int z = 0; z < parts_; ++z)
    for (int y = 0; y < parts_; ++y)
      for (int x = 0; x < parts_; ++x) {
        const Vec3 low = Vec3{double(x), double(y), double(z)} * size;
        const Box3 box = Box3{low, low + size}.grown(slack);
        sources_.emplace_back();
        check_cancelled();
        for (const Neighbour& neighbour : neighbours) {
          const size_t first_run = runs_.size();
          bool is_reached = false;
          for (const std::span<const LatticeStrut> near : neighbour.near) {
            const auto begin = static_cast<uint32_t>(struts_.size());
            for (const LatticeStrut& s : near) {
              const Vec3 b = s.axis.a + s.axis.ab;
              if (box.grown(s.factor * most).overlaps({min(s.axis.a, b), max(s.axis.a, b)}))
                struts_.add(s.axis, s.factor);
            }
            runs_.push_back({begin, static_cast<uint32_t>(struts_.size())});
            is_reached |= begin < struts_.size();
          }
          if (is_reached)
            sources_.back().push_back({neighbour.offset, first_run});
          else
            runs_.resize(first_run);
        }
      }
  struts_.finish();
}

MixedPartLists::MixedPartLists(const MixedParts& parts, TypeOf type_of)
    : parts_(parts), ask_(std::move(type_of)), known_(known_cells * known_cells * known_cells) {}

size_t MixedPartLists::type_of(CellIndex cell) {
  const auto low = [](int32_t i) { return static_cast<uint32_t>(i) % known_cells; };
  Known& known = known_[(low(cell.z) * known_cells + low(cell.y)) * known_cells + low(cell.x)];
  if (!known.is_known || !(known.cell == cell)) known = {cell, true, ask_(cell)};
  return known.type;
}

void MixedPartLists::find(CellIndex cell, const int (&part)[3], std::vector<Run>& runs) {
  const int n = parts_.parts_;
  for (const MixedParts::Source& source :
       parts_.sources_[static_cast<size_t>((part[2] * n + part[1]) * n + part[0])]) {
    const size_t type =
        type_of({cell.x + source.offset[0], cell.y + source.offset[1], cell.z + source.offset[2]});
    const Run run = parts_.runs_[source.first_run + type];
    if (run.begin < run.end) runs.push_back(run);
  }
}

}  // namespace msq
