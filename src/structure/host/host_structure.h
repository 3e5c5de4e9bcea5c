// SPDX-License-Identifier: Apache-2.0
// A structure that the host computes: membership of points; or membership of points of one cell at
// a time, from cell data that the host builds and the cache keeps.
#pragma once

#include <functional>
#include <memory>

#include "base/host.h"
#include "cell/context.h"
#include "structure/common/group_by_cell.h"
#include "structure/host/retired_cells.h"
#include "structure/structure.h"

namespace msq {

/// Points in the form that the host gets.
struct HostPoints {
  const Vec3* points;      ///< model coordinates
  const Vec3* positions;   ///< from the corner of their cell, in model units along the grid's axes
  const CellIndex* cells;  ///< the cells that contain them
  size_t count;            ///< at most host_batch
};

struct HostStructureCalls {
  /// Sets inside[i] to nonzero if point i is inside; may be empty if cells are built.
  std::function<void(const HostPoints& points, uint8_t* inside)> inside;
  /// Returns the data of a cell, which may be null, and sets its size in memory; may be empty.
  std::function<void*(CellIndex cell, uint64_t& bytes)> build_cell;
  /// As inside(), for points of one cell.
  std::function<void(const void* data, const HostPoints& points, uint8_t* inside)> evaluate_cell;
  /// May be empty. Not called for null.
  std::function<void(void* data)> free_cell;
  /// May be empty.
  std::function<BoxClass(const Box3& box)> classify;
  /// Lower bounds on the distance to the boundary, of either sign; may be empty.
  std::function<void(const HostPoints& points, double* bounds)> distance;
};

class HostStructure final : public Structure {
 public:
  HostStructure(Ref<Context> context, const Neighbourhood& neighbourhood, HostStructureCalls calls,
                bool is_concurrent);
  ~HostStructure() override;

  bool inside(Vec3 p) const override;
  double distance_bound(Vec3 p) const override;
  bool has_steady_distance() const override { return static_cast<bool>(calls_.distance); }
  bool is_concurrent() const override { return is_concurrent_; }
  bool gains_by_layers() const override { return true; }
  void keep_points(const Vec3* points, uint8_t* alive, size_t count) const override;
  bool gains_by_groups() const override { return static_cast<bool>(calls_.build_cell); }
  BoxClass classify(const Box3& box) const override {
    return calls_.classify ? calls_.classify(box) : BoxClass::mixed;
  }
  bool knows_boxes() const override { return static_cast<bool>(calls_.classify); }
  /// Rays march together, by the host's distances and its coverage of boxes.
  void enter(RaySearch* searches, size_t count, const Job* job) const override;

  HostUser& user() { return user_; }

 private:
  void describe(HashInput& input) const override;
  class Cell;

  std::shared_ptr<const CellData> cell(CellIndex index) const;
  /// Sets bounds[i] to distance_bound(points[i]).
  void find_distance_bounds(const Vec3* points, size_t count, double* bounds) const;
  void free_retired() const;

  HostUser user_;
  Ref<Context> context_;
  uint64_t id_;
  HostStructureCalls calls_;
  bool is_concurrent_;
  std::shared_ptr<RetiredCells> retired_;
};

}  // namespace msq
