// SPDX-License-Identifier: Apache-2.0
#include "slice/framed_model.h"

#include <vector>

#include "base/hash_input.h"
#include "shape/placed_rows.h"
#include "slice/frame_rows.h"

namespace msq {

namespace {

std::vector<Vec3> mapped(const LayerFrame& frame, const Vec3* points, size_t count) {
  std::vector<Vec3> out(count);
  for (size_t i = 0; i < count; ++i) out[i] = frame.to_model(points[i]);
  return out;
}

void describe_frame(const LayerFrame& frame, HashInput& input) {
  input.point(frame.origin);
  for (const Vec3& axis : frame.axes) input.point(axis);
}

class FramedField final : public Field {
 public:
  FramedField(Parameter original, const LayerFrame& frame)
      : original_(std::move(original)), frame_(frame) {}
  double at(Vec3 p) const override { return original_.at(frame_.to_model(p)); }
  void values(const Vec3* points, size_t count, double* values) const override {
    original_.values(mapped(frame_, points, count).data(), count, values);
  }
  bool is_concurrent() const override { return original_.is_concurrent(); }
  Interval range() const override { return original_.range(); }
  Interval range(const Box3& box) const override { return original_.range(frame_.to_model(box)); }

 protected:
  void describe(HashInput& input) const override {
    input.kind("field: framed");
    original_.describe(input);
    describe_frame(frame_, input);
  }

 private:
  const Parameter original_;
  const LayerFrame frame_;
};

class FramedShape final : public Shape {
 public:
  FramedShape(Ref<const Shape> shape, const LayerFrame& frame)
      : shape_(std::move(shape)), frame_(frame), model_axes_(frame.model_axes()) {
    facts_ = shape_->facts();
    if (is_bounded()) facts_.bounds = frame_.from_model(facts_.bounds);
  }
  bool inside(Vec3 p) const override { return shape_->inside(frame_.to_model(p)); }
  void find_inside(const Vec3* points, size_t count, uint8_t* inside) const override {
    shape_->find_inside(mapped(frame_, points, count).data(), count, inside);
  }
  bool is_concurrent() const override { return shape_->is_concurrent(); }
  /// Points and vertices are rounded as LayerFrame::rounding() says, and axes are orthonormal
  /// except for rounding.
  MeshMap mesh_map() const override {
    MeshMap map = shape_->mesh_map();
    if (!map.mesh) return map;
    map.place = [this, place = std::move(map.place)](Vec3 v) {
      return frame_.from_model(place ? place(v) : v);
    };
    const auto& [u, v, w] = frame_.axes;
    map.is_mirrored ^= dot(msq::cross(u, v), w) < 0;
    const auto magnitude = [](const Box3& box) {
      return max_magnitude(box.min) + max_magnitude(box.max);
    };
    map.error += 0x1p-46 *
                 (magnitude(bounds()) + magnitude(shape_->bounds()) + max_magnitude(frame_.origin));
    map.bounds = bounds();
    return map;
  }
  unsigned nesting() const override { return shape_->nesting(); }
  void prepare_distance(const Job* job) const override { shape_->prepare_distance(job); }
  void prepare_rows(const Job* job) const override {
    if (model_axes_[0] >= 0) return shape_->prepare_rows(job);
    rows_.prepare(*this, job);
  }
  double depth(Vec3 p) const override { return shape_->depth(frame_.to_model(p)); }
  double depth(Vec3 p, double) const override { return depth(p); }
  bool knows_depth() const override { return shape_->knows_depth(); }
  double depth_error() const override {
    return shape_->depth_error() + frame_.rounding(bounds().min) + frame_.rounding(bounds().max);
  }
  void fill_rows(const RowBlock& block) const override {
    if (model_axes_[0] < 0) return rows_.fill(*this, block);
    FrameRows(block, model_axes_).for_each_part([this](const RowBlock& turned) {
      RowBlock layer = turned;
      for (uint64_t k = turned.z0; k < turned.z1; ++k) {
        layer.z0 = k;
        layer.z1 = k + 1;
        layer.words = turned.row(0, k);
        shape_->fill_rows(layer);
      }
    });
  }

 protected:
  double distance_bound(Vec3 p) const override {
    const double bound = std::abs(shape_->distance(frame_.to_model(p)));
    return std::max(0.0, bound * (1 - 0x1p-50) - 2 * frame_.rounding(p));
  }
  void describe(HashInput& input) const override {
    input.kind("shape: framed");
    input.object(*shape_);
    describe_frame(frame_, input);
  }

 private:
  Ref<const Shape> shape_;
  const LayerFrame frame_;
  const std::array<int, 3> model_axes_;
  PlacedRows rows_;
};

/// The grid of a structure, by whose cells sets of points are grouped.
Neighbourhood framed(const Neighbourhood& grid, const LayerFrame& frame) {
  Neighbourhood out = grid;
  out.origin = frame.from_model(grid.origin);
  const auto& m = grid.rotation.m;
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j)
      out.rotation.m[3 * i + j] = dot(frame.axes[i], {m[j], m[3 + j], m[6 + j]});
  return out;
}

class FramedStructure final : public Structure {
 public:
  FramedStructure(Ref<const Structure> structure, const LayerFrame& frame)
      : Structure(framed(structure->neighbourhood(), frame), structure->characteristic_length()),
        structure_(std::move(structure)),
        frame_(frame),
        model_axes_(frame.model_axes()) {}
  /// Of a kind without a grid.
  FramedStructure(Ref<const Structure> structure, const LayerFrame& frame, double side)
      : Structure(frame.from_model(structure->neighbourhood().origin), side,
                  structure->characteristic_length()),
        structure_(std::move(structure)),
        frame_(frame),
        model_axes_(frame.model_axes()) {}

  void for_each_grid(const TakeGrid& take) const override {
    structure_->for_each_grid([&](const Neighbourhood& grid) { take(framed(grid, frame_)); });
  }
  unsigned nesting() const override { return structure_->nesting(); }
  bool inside(Vec3 p) const override { return structure_->inside(frame_.to_model(p)); }
  bool is_concurrent() const override { return structure_->is_concurrent(); }
  void keep_points(const Vec3* points, uint8_t* alive, size_t count) const override {
    structure_->keep_points(mapped(frame_, points, count).data(), alive, count);
  }
  bool gains_by_groups() const override { return structure_->gains_by_groups(); }
  uint32_t group_parts() const override { return structure_->group_parts(); }
  uint64_t critical_count() const override { return structure_->critical_count(); }
  BoxClass classify(const Box3& box) const override {
    return structure_->classify(frame_.to_model(box));
  }
  bool knows_boxes() const override { return structure_->knows_boxes(); }
  bool gains_by_layers() const override { return structure_->gains_by_layers(); }
  void keep_rows(const RowBlock& block, const Job* job) const override {
    if (model_axes_[0] < 0) return Structure::keep_rows(block, job);
    FrameRows(block, model_axes_).for_each_part([&](const RowBlock& turned) {
      check_cancelled(job);
      structure_->keep_rows(turned, job);
    });
  }

 protected:
  void describe(HashInput& input) const override {
    input.kind("structure: framed");
    input.object(*structure_);
    describe_frame(frame_, input);
  }

 private:
  Ref<const Structure> structure_;
  const LayerFrame frame_;
  const std::array<int, 3> model_axes_;
};

Ref<const Structure> make_framed(const Ref<const Structure>& structure, const LayerFrame& frame) {
  if (structure->is_on_grid()) return make_ref<FramedStructure>(structure, frame);
  return make_ref<FramedStructure>(structure, frame, structure->cell_length());
}

}  // namespace

Ref<const Model> make_framed_model(const Model& model, const LayerFrame& frame) {
  const Ref<Context> context(&model.context());
  if (!model.regions().empty()) {
    std::vector<Ref<const Model>> regions;
    for (const Ref<const Model>& region : model.regions())
      regions.push_back(make_framed_model(*region, frame));
    return make_ref<Model>(context, regions);
  }
  std::vector<Model::ScaleParts> scales;
  for (const Scale* scale : model.resolved(0)) {
    Parameter skin = scale->skin.thickness();
    if (!skin.is_constant())
      skin = Parameter(Ref<const Field>(make_ref<FramedField>(std::move(skin), frame)));
    scales.emplace_back(make_framed(scale->structure, frame), std::move(skin));
  }
  Ref<const Shape> shape = make_ref<FramedShape>(Ref<const Shape>(&model.shape()), frame);
  return make_ref<Model>(context, std::move(shape), std::move(scales));
}

}  // namespace msq
