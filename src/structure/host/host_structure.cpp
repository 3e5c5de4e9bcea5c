// SPDX-License-Identifier: Apache-2.0
#include "structure/host/host_structure.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/march_together.h"
#include "base/ray_normal.h"

namespace msq {

namespace {

// Cells are passed to the host without conversion.
static_assert(sizeof(CellIndex) == 3 * sizeof(int32_t));

/// Points gathered for a callback.
class Batch {
 public:
  /// For up to `count` points, limited to the size of a callback.
  Batch(const Neighbourhood& grid, size_t count)
      : cell_size_(grid.cell_size), most_(std::min(count, host_batch)) {
    points_.reserve(most_);
    positions_.reserve(most_);
    cells_.reserve(most_);
    index_.reserve(most_);
    inside_.resize(most_);
  }

  void add(Vec3 p, const Neighbourhood::Located& located, size_t index) {
    points_.push_back(p);
    positions_.push_back(located.fraction * cell_size_);
    cells_.push_back(located.cell);
    index_.push_back(index);
  }
  bool is_full() const { return points_.size() == most_; }

  /// Calls ask(points, inside), sets alive[i] to 0 where point i is outside, and empties the batch.
  template <class Ask>
  void keep(uint8_t* alive, Ask&& ask) {
    if (points_.empty()) return;
    ask(HostPoints{points_.data(), positions_.data(), cells_.data(), points_.size()},
        inside_.data());
    for (size_t i = 0; i < points_.size(); ++i)
      if (!inside_[i]) alive[index_[i]] = 0;
    points_.clear();
    positions_.clear();
    cells_.clear();
    index_.clear();
  }

 private:
  const Vec3 cell_size_;
  const size_t most_;
  std::vector<Vec3> points_, positions_;
  std::vector<CellIndex> cells_;
  std::vector<size_t> index_;
  std::vector<uint8_t> inside_;
};

/// One point in the form that the host gets.
struct SinglePoint {
  SinglePoint(const Neighbourhood& grid, Vec3 p) : point(p) {
    const Neighbourhood::Located located = grid.locate(p);
    position = located.fraction * grid.cell_size;
    cell = located.cell;
  }
  HostPoints view() const { return {&point, &position, &cell, 1}; }

  Vec3 point, position;
  CellIndex cell;
};

}  // namespace

class HostStructure::Cell final : public CellData {
 public:
  explicit Cell(std::shared_ptr<RetiredCells> retired)
      : retired_(std::move(retired)), cell_(std::make_unique<RetiredCells::Cell>()) {}
  ~Cell() override {
    if (cell_->data) retired_->add(std::move(cell_));
  }

  void build(const HostStructureCalls& calls, CellIndex index) {
    cell_->data = calls.build_cell(index, bytes_);
  }
  const void* data() const { return cell_->data; }
  uint64_t bytes() const override {
    constexpr uint64_t most = uint64_t{1} << 60;  // sums with it do not overflow
    return std::min(bytes_, most) + sizeof *this + sizeof *cell_;
  }

 private:
  std::shared_ptr<RetiredCells> retired_;
  std::unique_ptr<RetiredCells::Cell> cell_;
  uint64_t bytes_ = 0;
};

HostStructure::HostStructure(Ref<Context> context, const Neighbourhood& neighbourhood,
                             HostStructureCalls calls, bool is_concurrent)
    : Structure(neighbourhood),
      context_(std::move(context)),
      id_(context_->new_structure_id()),
      calls_(std::move(calls)),
      is_concurrent_(is_concurrent),
      retired_(std::make_shared<RetiredCells>()) {}

HostStructure::~HostStructure() {
  context_->cache.drop(id_);
  free_retired();
}

void HostStructure::free_retired() const {
  retired_->free_all([this](void* data) {
    if (calls_.free_cell) calls_.free_cell(data);
  });
}

std::shared_ptr<const CellData> HostStructure::cell(CellIndex index) const {
  return context_->cache.fetch(id_, index, [&] {
    free_retired();
    auto cell = std::make_shared<Cell>(retired_);
    cell->build(calls_, index);
    return cell;
  });
}

bool HostStructure::inside(Vec3 p) const {
  const SinglePoint point(neighbourhood(), p);
  uint8_t inside = 0;
  if (calls_.inside) {
    calls_.inside(point.view(), &inside);
  } else {
    const auto data = cell(point.cell);
    calls_.evaluate_cell(static_cast<const Cell&>(*data).data(), point.view(), &inside);
  }
  return inside != 0;
}

double HostStructure::distance_bound(Vec3 p) const {
  if (!calls_.distance) return 0;
  double bound;
  find_distance_bounds(&p, 1, &bound);
  return bound;
}

void HostStructure::find_distance_bounds(const Vec3* points, size_t count, double* bounds) const {
  std::vector<Vec3> positions;
  std::vector<CellIndex> cells;
  for (size_t first = 0; first < count; first += host_batch) {
    const size_t size = std::min(host_batch, count - first);
    positions.clear();
    cells.clear();
    for (size_t i = first; i < first + size; ++i) {
      const Neighbourhood::Located located = neighbourhood().locate(points[i]);
      positions.push_back(located.fraction * neighbourhood().cell_size);
      cells.push_back(located.cell);
    }
    calls_.distance({points + first, positions.data(), cells.data(), size}, bounds + first);
  }
  for (size_t i = 0; i < count; ++i) {
    if (!std::isfinite(bounds[i]))
      fail(Status::host,
           "the host's structure has the distance %g at (%g, %g, %g); it must be finite", bounds[i],
           points[i].x, points[i].y, points[i].z);
    bounds[i] = std::abs(bounds[i]);
  }
}

void HostStructure::enter(RaySearch* searches, size_t count, const Job* job) const {
  const double least = min_ray_step();
  const auto keep = [this](const Vec3* points, uint8_t* inside, size_t n) {
    keep_points(points, inside, n);
  };
  const auto bound = [&](const std::vector<MarchPoint>& queried, const Vec3* points,
                         double* bounds) {
    if (calls_.distance) return find_distance_bounds(points, queried.size(), bounds);
    if (!calls_.classify) return;
    for (size_t i = 0; i < queried.size(); ++i) {
      const Vec3 q = searches[queried[i].search].ray.at(queried[i].t + 8 * least);
      if (calls_.classify({min(points[i], q), max(points[i], q)}) == BoxClass::outside)
        bounds[i] = 8 * least;
    }
  };
  const auto tolerance_of = [this](const RaySearch& s) { return ray_tolerance(s.ray, s.to); };
  march_by_bounds(searches, count, least, tolerance_of, job, keep, bound);
  normals_by_membership(keep, searches, count, normal_distance(),
                        [](const RaySearch& s) { return s.found && s.t != s.from; });
}

void HostStructure::keep_points(const Vec3* points, uint8_t* alive, size_t count) const {
  if (count == 0) return;
  Batch batch(neighbourhood(), count);
  if (calls_.build_cell) {
    const std::vector<LocatedPoint> grouped = group_by_cell(neighbourhood(), points, alive, count);
    for_each_cell(grouped, [&](CellIndex index, std::span<const LocatedPoint> of_cell) {
      const auto data = cell(index);
      const auto ask = [&](const HostPoints& queried, uint8_t* inside) {
        calls_.evaluate_cell(static_cast<const Cell&>(*data).data(), queried, inside);
      };
      for (const LocatedPoint& point : of_cell) {
        batch.add(points[point.index], point.located, point.index);
        if (batch.is_full()) batch.keep(alive, ask);
      }
      batch.keep(alive, ask);
    });
    return;
  }
  for (size_t i = 0; i < count; ++i) {
    if (alive[i]) batch.add(points[i], neighbourhood().locate(points[i]), i);
    if (batch.is_full()) batch.keep(alive, calls_.inside);
  }
  batch.keep(alive, calls_.inside);
}

void HostStructure::describe(HashInput& input) const {
  input.kind("structure: host");
  user_.describe(input, "structure");
  neighbourhood().describe(input);
  input.integer(calls_.distance ? 1 : 0);
}

}  // namespace msq
