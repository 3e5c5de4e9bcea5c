// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/rays/graded_lists.h"

#include <algorithm>
#include <cmath>

#include "structure/foam/rays/graded_line.h"
#include "strut/segment.h"

namespace msq {

uint64_t GradedLists::Cell::bytes() const {
  return sizeof *this + ends.capacity() * sizeof ends[0] + edges.capacity() * sizeof edges[0] +
         bricks.capacity() * sizeof bricks[0] + origins.capacity() * sizeof origins[0];
}

void GradedLists::move_to(const FoamData& foam) {
  forget();
  foam_ = &foam;
}

void GradedLists::forget() {
  ++era_;
  lists_.clear();
  numbers_.clear();
  bricks_.clear();
  recent_ = {};
  recent_count_ = 0;
}

std::shared_ptr<const GradedEdges> GradedLists::brick(CellIndex corner) {
  std::shared_ptr<const GradedEdges>& held = bricks_[corner];
  if (!held)
    held = std::static_pointer_cast<const GradedEdges>(foam_->context().cache.fetch(
        foam_->ray_bricks_id(), corner, [&] { return graded_edges(foam_->graded(), corner); }));
  return held;
}

const CapsuleView& GradedLists::list(CellIndex cell) {
  List& list = lists_[cell];
  if (!list.data) {
    list.cell = cell;
    list.data = std::static_pointer_cast<const Cell>(foam_->context().cache.fetch(
        foam_->cell_lists_id(), cell, [&] { return make_cell(cell); }));
    const Cell& data = *list.data;
    std::vector<uint32_t> numbers;
    for (const CellIndex corner : data.bricks)
      numbers.push_back(
          numbers_.try_emplace(corner, static_cast<uint32_t>(numbers_.size())).first->second);
    list.ids.reserve(data.origins.size() + capsule_padding);
    for (const Cell::Origin& origin : data.origins)
      list.ids.push_back(numbers[origin.brick] << edge_bits | origin.number);
    const size_t stride = data.ends.size() / 6;
    for (size_t axis = 0; axis < 3; ++axis) {
      list.view.a[axis] = data.ends.data() + axis * stride;
      list.view.ab[axis] = data.ends.data() + (axis + 3) * stride;
    }
    list.view.count = list.ids.size();
    list.ids.resize(list.view.count + capsule_padding);
    list.view.ids = list.ids.data();
  }
  recent_[recent_count_++ % recent_.size()] = &list;
  return list.view;
}

StrutLine GradedLists::line(const StrutEntries& entries, uint32_t id) const {
  for (size_t back = 1; back <= recent_.size(); ++back) {
    const List* const list = recent_[(recent_count_ - back) % recent_.size()];
    if (!list) break;
    const uint32_t *const ids = list->view.ids, *const end = ids + list->view.count;
    const uint32_t* const found = std::find(ids, end, id);
    if (found == end) continue;
    const Cell& data = *list->data;
    const auto i = static_cast<size_t>(found - ids);
    const GradedEdge& edge = data.edges[i];
    const CellIndex corner = data.bricks[data.origins[i].brick];
    StrutLine strut;
    if (edge.knows_seeds) strut = graded_line(*foam_->graded(), corner, edge.seeds);
    entries.set_ends(edge.a, edge.b, corner, strut);
    // For seeds on one sphere, the ends may be those of other seeds.
    const auto is_on_line = [&](Vec3 end) {
      const Vec3 w = end + strut.corner - strut.home - strut.line.seed - strut.line.offset;
      const Vec3 d = w - strut.along * dot(w, strut.along);
      return dot(d, d) <= end_error * end_error;
    };
    if (strut.has_line && !(is_on_line(strut.a) && is_on_line(strut.a + strut.ab))) {
      strut = {};
      entries.set_ends(edge.a, edge.b, corner, strut);
    }
    return strut;
  }
  return {};
}

std::shared_ptr<const GradedLists::Cell> GradedLists::make_cell(CellIndex cell) {
  // As in keep_brick_rows(): owners of edges that come into the reach are within the empty radius.
  const Neighbourhood& grid = foam_->neighbourhood();
  const GradedSeeds& seeds = *foam_->graded();
  const double unit = foam_->unit();
  const double reach = foam_->max_radius(cell, ray_list_margin) + 2 * ray_list_margin;
  const double owner_distance = seeds.cells().empty_radius() * unit * (1 + 1e-9);
  const int side = seeds.brick_side();
  auto made = std::make_shared<Cell>();
  if (reach < 0) return made;
  const Vec3 low = Vec3{double(cell.x), double(cell.y), double(cell.z)} * grid.cell_size;
  const Box3 box = Box3{low, low + grid.cell_size}.grown(reach * unit);
  int32_t first[3], last[3];
  for (int axis = 0; axis < 3; ++axis) {
    const auto brick_of = [&](double g) {
      return static_cast<int32_t>(std::floor(g / grid.cell_size[axis] / side));
    };
    first[axis] = brick_of(box.min[axis] - owner_distance);
    last[axis] = brick_of(box.max[axis] + owner_distance);
  }
  const Vec3 scale = seeds.scale(), middle = scale * 0.5;
  const double most = 0.5 * length(scale) + reach;
  for (int32_t k = first[2]; k <= last[2]; ++k)
    for (int32_t j = first[1]; j <= last[1]; ++j)
      for (int32_t i = first[0]; i <= last[0]; ++i) {
        const CellIndex corner{i * side, j * side, k * side};
        if (!seeds.may_own_edges(corner, box)) continue;
        check_cancelled();
        const auto edges = brick(corner);
        const Vec3 shift =
            Vec3{double(corner.x - cell.x), double(corner.y - cell.y), double(corner.z - cell.z)} *
            scale;
        const size_t before = made->edges.size();
        for (size_t e = 0; e < edges->edges().size(); ++e) {
          const GradedEdge& edge = edges->edges()[e];
          Vec3 a, b;
          bool is_near = true;
          for (int axis = 0; axis < 3; ++axis) {
            a[axis] = static_cast<double>(edge.a[static_cast<size_t>(axis)]) + shift[axis];
            b[axis] = static_cast<double>(edge.b[static_cast<size_t>(axis)]) + shift[axis];
            is_near &= std::min(a[axis], b[axis]) <= scale[axis] + reach &&
                       std::max(a[axis], b[axis]) >= -reach;
          }
          if (!is_near || Segment(a, b).distance_squared(middle) > most * most) continue;
          made->edges.push_back(edge);
          made->origins.push_back(
              {static_cast<uint32_t>(made->bricks.size()), static_cast<uint32_t>(e)});
        }
        if (made->edges.size() > before) made->bricks.push_back(corner);
      }
  const size_t count = made->edges.size(), stride = count + capsule_padding;
  made->ends.resize(6 * stride);
  for (size_t n = 0; n < count; ++n) {
    const CellIndex corner = made->bricks[made->origins[n].brick];
    const Vec3 shift =
        Vec3{double(corner.x - cell.x), double(corner.y - cell.y), double(corner.z - cell.z)} *
        scale;
    for (size_t axis = 0; axis < 3; ++axis) {
      const GradedEdge& edge = made->edges[n];
      made->ends[axis * stride + n] =
          static_cast<float>(static_cast<double>(edge.a[axis]) + shift[static_cast<int>(axis)]);
      made->ends[(axis + 3) * stride + n] = edge.b[axis] - edge.a[axis];
    }
  }
  made->edges.shrink_to_fit();
  made->origins.shrink_to_fit();
  return made;
}

}  // namespace msq
