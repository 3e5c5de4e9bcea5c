// SPDX-License-Identifier: Apache-2.0
#include "agree.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace msq::fuzz {

namespace {

bool is_bound(double number) {
  return std::isfinite(number) && std::abs(number) < 1e70;
}

class Checker {
 public:
  Checker(Input& input, msq_context* context, const msq_model* model, const Sight& sight,
          const Job& job)
      : input_(input),
        context_(context),
        model_(model),
        sight_(sight),
        job_(job),
        random_(input.word(4)) {
    query_.struct_size = 0;
    query_ = make_def(msq_query_def_init);
    if (input.chance(32)) query_.length_scale = input.number(0, 2 * sight.unit);
  }

  void check() {
    if (!MSQ_FUZZ(msq_model_bounds, model_, min_, max_)) return;
    for (int axis = 0; axis < 3; ++axis) {
      if (std::isnan(min_[axis]) || std::isnan(max_[axis]) || min_[axis] > max_[axis])
        wrong("bounds %g to %g along axis %d", min_[axis], max_[axis], axis);
      is_bounded_ = is_bounded_ && is_bound(min_[axis]) && is_bound(max_[axis]);
    }
    for (int axis = 0; axis < 3; ++axis) {
      if (is_bounded_) {
        const double side = max_[axis] - min_[axis];
        low_[axis] = min_[axis] - 0.05 * side;
        high_[axis] = max_[axis] + 0.05 * side;
      } else {
        low_[axis] = sight_.at[axis] - 3 * sight_.unit;
        high_[axis] = sight_.at[axis] + 3 * sight_.unit;
      }
      // Of large models a part with some cells, so that points of a set are in common cells.
      const double middle = sight_.at[axis];
      if (high_[axis] - low_[axis] > 64 * sight_.unit && middle > low_[axis] &&
          middle < high_[axis]) {
        low_[axis] = middle - 4 * sight_.unit;
        high_[axis] = middle + 4 * sight_.unit;
      }
    }
    check_points() && check_grid() && check_layers() && check_strata() && check_rays() &&
        check_onsets();
  }

 private:
  bool goes_on(bool succeeded) const { return succeeded && !job_.is_cancelled(); }

  bool inside_of(const double point[3], uint8_t* inside) const {
    int32_t value = -7;
    if (!MSQ_FUZZ(msq_point_membership, model_, point, &query_, &value)) return false;
    if (value != 0 && value != 1) wrong("membership is %d", value);
    *inside = static_cast<uint8_t>(value);
    return true;
  }

  /// Membership by point. False if a point is refused.
  bool truth_of(const std::vector<double>& points, std::vector<uint8_t>* truth) const {
    truth->assign(points.size() / 3, 0);
    for (size_t i = 0; i < truth->size(); ++i)
      if (!inside_of(&points[3 * i], &(*truth)[i])) return false;
    return true;
  }

  void compare(const std::vector<uint8_t>& truth, const std::vector<uint8_t>& other,
               const std::vector<double>& points, const char* what) const {
    for (size_t i = 0; i < truth.size(); ++i)
      if (truth[i] != other[i])
        wrong("%s: point %zu (%.17g, %.17g, %.17g) is %d, by itself %d", what, i, points[3 * i],
              points[3 * i + 1], points[3 * i + 2], other[i], truth[i]);
  }

  std::vector<double> some_points(size_t count) {
    std::vector<double> points;
    for (size_t i = 0; i < 3 * count; ++i) {
      const size_t axis = i % 3;
      const bool is_even = (i / 3) % 4 == 3;  // on borders of cells and of parts of cells
      double x = random_.between(low_[axis], high_[axis]);
      if (is_even) {
        const double step = 0.25 * sight_.unit;
        x = sight_.at[axis] + std::round((x - sight_.at[axis]) / step) * step;
      }
      points.push_back(x);
    }
    return points;
  }

  msq_points_def array_of(const std::vector<double>& points) const {
    msq_points_def def = make_def(msq_points_def_init);
    def.kind = MSQ_POINTS_ARRAY;
    def.coordinates = points.data();
    def.count = points.size() / 3;
    return def;
  }

  bool check_points() {
    const std::vector<double> points = some_points(64);
    std::vector<uint8_t> truth;
    if (!truth_of(points, &truth)) return false;
    const msq_points_def array = array_of(points);
    for (const int32_t method : {MSQ_QUERY_AUTO, MSQ_QUERY_POINT, MSQ_QUERY_SET}) {
      msq_query_def query = query_;
      query.method = method;
      query.group_parts = input_.below(4) * 3;
      std::vector<uint8_t> inside(truth.size(), 9);
      if (!goes_on(MSQ_FUZZ(msq_set_membership, model_, &array, &query, inside.data(),
                            inside.size(), job_)))
        return false;
      compare(truth, inside, points, "array");
    }
    std::vector<double> distances(truth.size(), 7);
    if (!goes_on(MSQ_FUZZ(msq_set_distance, model_, &array, &query_, distances.data(),
                          distances.size(), job_)))
      return false;
    for (size_t i = 0; i < truth.size(); ++i) {
      double distance;
      if (!MSQ_FUZZ(msq_point_distance, model_, &points[3 * i], &query_, &distance)) return false;
      if (std::memcmp(&distance, &distances[i], sizeof distance) != 0)
        wrong("distance %zu of an array is %.17g, by itself %.17g", i, distances[i], distance);
      if (!std::isfinite(distance) || (distance <= 0) != (truth[i] == 1))
        wrong("distance %.17g at (%.17g, %.17g, %.17g), which is %s", distance, points[3 * i],
              points[3 * i + 1], points[3 * i + 2], truth[i] ? "inside" : "outside");
    }
    if (sight_.has_distance) check_distances(points, truth, distances);
    return check_materials(array, points, truth);
  }

  /// No point of the other side is nearer than the distance.
  void check_distances(const std::vector<double>& points, const std::vector<uint8_t>& truth,
                       const std::vector<double>& distances) const {
    for (size_t i = 0; i < truth.size(); ++i)
      for (size_t j = 0; j < truth.size(); ++j) {
        if (truth[i] == truth[j]) continue;
        const double* p = &points[3 * i];
        const double* q = &points[3 * j];
        const double apart = std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
        double size = sight_.unit;
        for (int axis = 0; axis < 3; ++axis) size = std::max(size, std::abs(p[axis]));
        if (std::abs(distances[i]) > apart + 1e-9 * size)
          wrong(
              "distance %.17g at (%.17g, %.17g, %.17g); the other side, (%.17g, %.17g, %.17g), is "
              "%.17g away",
              distances[i], p[0], p[1], p[2], q[0], q[1], q[2], apart);
      }
  }

  bool check_materials(const msq_points_def& array, const std::vector<double>& points,
                       const std::vector<uint8_t>& truth) const {
    std::vector<uint32_t> ids(truth.size(), 77);
    if (msq_set_material(model_, &array, &query_, nullptr, 0, ids.data(), ids.size(), nullptr, 0,
                         job_) != MSQ_OK)
      return !job_.is_cancelled();
    for (size_t i = 0; i < ids.size(); ++i) {
      uint32_t id;
      if (!MSQ_FUZZ(msq_point_material, model_, &points[3 * i], &query_, nullptr, 0, &id, nullptr))
        return false;
      if (id != ids[i]) wrong("material %zu of an array is %u, by itself %u", i, ids[i], id);
      if (id != MSQ_MATERIAL_VOID && !truth[i]) wrong("a point outside has material %u", id);
    }
    return true;
  }

  bool check_grid() {
    msq_points_def grid = make_def(msq_points_def_init);
    grid.kind = MSQ_POINTS_GRID;
    const bool is_even = input_.chance(100);  // in step with cells
    uint64_t count = 1;
    for (int axis = 0; axis < 3; ++axis) {
      grid.counts[axis] = 1 + input_.below(12);
      count *= grid.counts[axis];
      grid.spacing[axis] =
          is_even ? sight_.unit / (1 + input_.below(8))
                  : (high_[axis] - low_[axis]) / static_cast<double>(grid.counts[axis]);
      grid.origin[axis] = is_even ? sight_.at[axis] : low_[axis] + 0.5 * grid.spacing[axis];
    }
    std::vector<double> points(3 * count);
    if (!MSQ_FUZZ(msq_points_generate, &grid, 0, count, points.data())) return true;
    std::vector<uint8_t> truth, inside(count, 9);
    if (!truth_of(points, &truth)) return false;
    if (!goes_on(MSQ_FUZZ(msq_set_membership, model_, &grid, &query_, inside.data(), count, job_)))
      return false;
    compare(truth, inside, points, "grid");
    std::vector<double> distances(count), by_array(count);
    const msq_points_def array = array_of(points);
    if (!goes_on(
            MSQ_FUZZ(msq_set_distance, model_, &grid, &query_, distances.data(), count, job_)) ||
        !goes_on(MSQ_FUZZ(msq_set_distance, model_, &array, &query_, by_array.data(), count, job_)))
      return false;
    if (std::memcmp(distances.data(), by_array.data(), count * sizeof(double)) != 0)
      wrong("distances of a grid and of the array of its points differ");

    // A part of it, as a window.
    std::vector<uint8_t> expected;
    for (int axis = 0; axis < 3; ++axis) {
      const uint32_t whole = static_cast<uint32_t>(grid.counts[axis]);
      grid.window.first[axis] = input_.below(whole);
      grid.window.count[axis] =
          1 + input_.below(whole - static_cast<uint32_t>(grid.window.first[axis]));
    }
    const uint64_t* first = grid.window.first;
    const uint64_t* size = grid.window.count;
    for (uint64_t k = first[2]; k < first[2] + size[2]; ++k)
      for (uint64_t j = first[1]; j < first[1] + size[1]; ++j)
        for (uint64_t i = first[0]; i < first[0] + size[0]; ++i)
          expected.push_back(truth[i + grid.counts[0] * (j + grid.counts[1] * k)]);
    inside.assign(expected.size(), 9);
    if (!goes_on(MSQ_FUZZ(msq_set_membership, model_, &grid, &query_, inside.data(), inside.size(),
                          job_)))
      return false;
    if (inside != expected) wrong("the window of a grid differs from the grid");
    return true;
  }

  struct Taken {
    std::vector<uint8_t> bytes;
    uint64_t layers = 0;
    bool is_odd = false;
  };

  bool check_layers() {
    msq_slicer_def def = make_def(msq_slicer_def_init);
    def.has_region = 1;
    def.resolution[0] = 1 + input_.below(70);
    def.resolution[1] = 1 + input_.below(12);
    def.layer_count = 1 + input_.below(6);
    def.length_scale = query_.length_scale;
    def.slab_layers = input_.below(4);
    if (input_.chance(40)) {
      // Another direction of layers.
      static constexpr double frames[][9] = {{0, 1, 0, 0, 0, 1, 1, 0, 0},
                                             {1, 0, 0, 0, 0, 1, 0, 1, 0},
                                             {0.6, 0.8, 0, -0.8, 0.6, 0, 0, 0, 1}};
      std::memcpy(def.frame_axes, frames[input_.below(3)], sizeof def.frame_axes);
    }
    for (int row = 0; row < 3; ++row) {
      int along = row;
      for (int axis = 0; axis < 3; ++axis)
        if (def.frame_axes[3 * row + axis] == 1) along = axis;
      def.region_min[row] = low_[along];
      def.region_max[row] = high_[along];
    }
    def.layer_height =
        (def.region_max[2] - def.region_min[2]) / static_cast<double>(def.layer_count);
    msq_slicer* handle;
    const Call create("msq_slicer_create");
    if (!create.returned(msq_slicer_create(model_, &def, &handle))) return true;
    const Owner<msq_slicer> slicer(handle);
    msq_slicer_report plan{};
    plan.struct_size = sizeof plan;
    if (!MSQ_FUZZ(msq_slicer_info, slicer.get(), &plan)) return false;
    Taken taken;
    const auto take = [](void* user, const msq_layer* layer) -> int32_t {
      auto* into = static_cast<Taken*>(user);
      into->is_odd = into->is_odd || layer->index != into->layers;
      ++into->layers;
      into->bytes.insert(into->bytes.end(), layer->data,
                         layer->data + layer->stride * layer->height);
      return 0;
    };
    if (!goes_on(MSQ_FUZZ(msq_slicer_run, slicer.get(), 0, UINT64_MAX, take, &taken, job_)))
      return false;
    if (taken.is_odd || taken.layers != plan.layer_count ||
        taken.bytes.size() != taken.layers * plan.layer_bytes)
      wrong("a run gave %zu bytes in %zu layers", taken.bytes.size(),
            static_cast<size_t>(taken.layers));
    const uint64_t one = input_.below(static_cast<uint32_t>(plan.layer_count));
    std::vector<uint8_t> layer(plan.layer_bytes, 0xa5);
    if (!goes_on(MSQ_FUZZ(msq_slice_layer, slicer.get(), one, layer.data(), layer.size(), job_)))
      return false;
    if (std::memcmp(layer.data(), taken.bytes.data() + one * plan.layer_bytes, layer.size()) != 0)
      wrong("layer %zu by itself differs from the run", static_cast<size_t>(one));
    for (uint64_t k = 0; k < plan.layer_count; ++k) {
      double z;
      if (!MSQ_FUZZ(msq_slicer_layer_z, slicer.get(), k, &z)) return false;
      for (uint32_t j = 0; j < plan.height; ++j)
        for (uint32_t i = 0; i < plan.width; ++i) {
          if ((i + j + k) % 3 != 0 && i > 9) continue;  // points take most of the time
          const double uvw[3] = {plan.origin[0] + i * plan.pitch[0],
                                 plan.origin[1] + j * plan.pitch[1], z};
          if (def.frame_axes[0] == 0.6) continue;  // rounded as the library does it
          double p[3];
          for (int axis = 0; axis < 3; ++axis) {
            p[axis] = 0;
            for (int row = 0; row < 3; ++row) p[axis] += uvw[row] * def.frame_axes[3 * row + axis];
            if (!has_frame(def)) p[axis] = uvw[axis];
          }
          uint8_t inside;
          if (!inside_of(p, &inside)) return false;
          const uint8_t byte = taken.bytes[k * plan.layer_bytes + j * plan.stride + i / 8];
          if ((byte >> (7 - i % 8) & 1) != inside)
            wrong("pixel (%u, %u) of layer %zu is %d; its point (%.17g, %.17g, %.17g) is %d", i, j,
                  static_cast<size_t>(k), !inside, p[0], p[1], p[2], inside);
        }
    }
    return true;
  }

  static bool has_frame(const msq_slicer_def& def) {
    return std::any_of(def.frame_axes, def.frame_axes + 9, [](double x) { return x != 0; });
  }

  bool check_strata() {
    msq_points_def strata = make_def(msq_points_def_init);
    strata.kind = MSQ_POINTS_STRATIFIED;
    strata.seed = random_.word();
    strata.per_cell = 2;
    for (int axis = 0; axis < 3; ++axis) {
      strata.counts[axis] = 3;
      strata.origin[axis] = low_[axis];
      strata.spacing[axis] = (high_[axis] - low_[axis]) / 3;
    }
    std::vector<double> points(3 * 54);
    if (!MSQ_FUZZ(msq_points_generate, &strata, 0, 54, points.data())) return true;
    std::vector<uint8_t> truth, inside(54, 9);
    if (!truth_of(points, &truth)) return false;
    if (!goes_on(MSQ_FUZZ(msq_set_membership, model_, &strata, &query_, inside.data(),
                          inside.size(), job_)))
      return false;
    compare(truth, inside, points, "strata");
    return true;
  }

  bool check_rays() {
    constexpr size_t count = 12;
    double origins[3 * count], directions[3 * count], ends[count];
    const std::vector<double> from = some_points(count), to = some_points(count);
    for (size_t i = 0; i < count; ++i) {
      double size = 0;
      for (size_t axis = 0; axis < 3; ++axis) {
        double along = to[3 * i + axis] - from[3 * i + axis];
        if (i % 3 == 0 && axis != i / 3 % 3) along = 0;  // along an axis
        directions[3 * i + axis] = along;
        origins[3 * i + axis] = from[3 * i + axis];
        size = std::max(size, std::abs(along));
      }
      if (size == 0) directions[3 * i] = sight_.unit;
      ends[i] = is_bounded_ && i % 2 ? 2 : 1;
    }
    msq_rays_def rays = make_def(msq_rays_def_init);
    rays.count = count;
    rays.origins = origins;
    rays.directions = directions;
    rays.t_max = ends;
    msq_ray_hit hits[count];
    if (!goes_on(MSQ_FUZZ(msq_ray_cast, model_, &rays, &query_, hits, count, job_))) return false;
    for (size_t i = 0; i < count; ++i)
      if (!check_ray(&origins[3 * i], &directions[3 * i], ends[i], hits[i])) return false;
    // Alone, a ray hits what it hits among others.
    const size_t one = input_.below(count);
    rays.count = 1;
    rays.origins = origins + 3 * one;
    rays.directions = directions + 3 * one;
    rays.t_max = ends + one;
    msq_ray_hit alone;
    if (!goes_on(MSQ_FUZZ(msq_ray_cast, model_, &rays, &query_, &alone, 1, job_))) return false;
    if (std::memcmp(&alone.t, &hits[one].t, sizeof(double)) != 0 ||
        alone.scale != hits[one].scale || alone.starts_inside != hits[one].starts_inside)
      wrong("ray %zu by itself hits at %.17g, among others at %.17g", one, alone.t, hits[one].t);
    return true;
  }

  /// All points from t - away to t + away are inside, or none is asked for.
  bool is_inside_about(const double* origin, const double* direction, double t, double away,
                       int samples, bool* all, bool* any) const {
    *all = true;
    *any = false;
    for (int i = -samples; i <= samples; ++i) {
      const double s = t + away * i / samples;
      double p[3];
      for (int axis = 0; axis < 3; ++axis) p[axis] = origin[axis] + s * direction[axis];
      uint8_t inside;
      if (!inside_of(p, &inside)) return false;
      *all = *all && inside;
      *any = *any || inside;
    }
    return true;
  }

  /// Any point is inside whose coordinates are up to `away` from those at t.
  bool is_inside_beside(const double* origin, const double* direction, double t, double away,
                        bool* any) const {
    constexpr int steps = 9;
    for (int i = 0; i < steps * steps * steps && !*any; ++i) {
      const int step[3] = {i % steps, i / steps % steps, i / (steps * steps)};
      double p[3];
      for (int axis = 0; axis < 3; ++axis)
        p[axis] = origin[axis] + t * direction[axis] + away * (2.0 * step[axis] / (steps - 1) - 1);
      uint8_t inside;
      if (!inside_of(p, &inside)) return false;
      *any = inside;
    }
    return true;
  }

  bool check_ray(const double* origin, const double* direction, double end,
                 const msq_ray_hit& hit) const {
    const double speed = std::hypot(direction[0], direction[1], direction[2]);
    double size = sight_.unit;
    for (int axis = 0; axis < 3; ++axis) {
      size =
          std::max({size, std::abs(origin[axis]), std::abs(origin[axis] + end * direction[axis])});
      size = std::max({size, std::abs(origin[axis] - sight_.at[axis]), std::abs(sight_.at[axis])});
      if (is_bounded_) size = std::max(size, max_[axis] - min_[axis]);
    }
    // The tolerance is a part of the longest cell, also where the others are far shorter.
    double length = 0;
    for (uint32_t scale = 1; msq_model_scale_length(model_, scale, &length) == MSQ_OK; ++scale)
      if (is_bound(length)) size = std::max(size, length);
    const double tolerance = 0x1p-34 * size / speed;
    const double part = std::max(tolerance, sight_.part * sight_.unit / speed);
    const bool is_hit = std::isfinite(hit.t);
    uint8_t inside;
    if (!inside_of(origin, &inside)) return false;
    // A single point, as of a strut with a radius below rounding, may be lost.
    bool is_alone = inside == 1;
    for (const double t : {-2 * tolerance, -tolerance, tolerance, 2 * tolerance}) {
      double p[3];
      uint8_t beside;
      for (int axis = 0; axis < 3; ++axis) p[axis] = origin[axis] + t * direction[axis];
      if (!inside_of(p, &beside)) return false;
      is_alone = is_alone && !beside;
    }
    if (hit.starts_inside != inside && !is_alone)
      wrong("a ray from (%.17g, %.17g, %.17g) starts_inside %d; membership is %d", origin[0],
            origin[1], origin[2], hit.starts_inside, inside);
    if (hit.starts_inside && hit.t != 0) wrong("a ray that starts inside hits at %.17g", hit.t);
    if (is_hit != (hit.scale >= 0)) wrong("t is %.17g and the scale %d", hit.t, hit.scale);
    const double normal_length = std::hypot(hit.normal[0], hit.normal[1], hit.normal[2]);
    if (!(std::abs(normal_length - is_hit) < 1e-6))
      wrong("a normal of length %.17g, t %.17g", normal_length, hit.t);
    if (is_hit && !(hit.t >= 0 && hit.t <= end)) wrong("t is %.17g; it ends at %.17g", hit.t, end);
    bool all, any;
    // In a shape so large that the tolerance is more than cells, nothing is known.
    if (is_hit && !hit.starts_inside && tolerance * speed < 0.01 * sight_.unit) {
      if (!is_inside_about(origin, direction, hit.t, 2 * tolerance, 8, &all, &any)) return false;
      // A part no deeper than rounding may be seen, too: within some roundings of the ray's point.
      const double rounding = 0x1p-50 * size;
      if (!any && !is_inside_about(origin, direction, hit.t, rounding / speed, 64, &all, &any))
        return false;
      // As where a ray leaves a structure at the point where it enters the shape.
      if (!any && !is_inside_beside(origin, direction, hit.t, rounding, &any)) return false;
      if (!any)
        wrong(
            "nothing is inside about a hit at t = %.17g of (%.17g, %.17g, %.17g) + t (%.17g, "
            "%.17g, %.17g)",
            hit.t, origin[0], origin[1], origin[2], direction[0], direction[1], direction[2]);
    }
    // Before the hit there is no part that is longer than those that may be lost.
    const double until = is_hit ? hit.t : end;
    constexpr int samples = 48;
    for (int i = 0; i < samples; ++i) {
      const double t = until * (i + 0.5) / samples;
      if (t - part < 0 || t + part > until - part) continue;
      double p[3];
      for (int axis = 0; axis < 3; ++axis) p[axis] = origin[axis] + t * direction[axis];
      if (!inside_of(p, &inside)) return false;
      if (!inside) continue;
      if (!is_inside_about(origin, direction, t, part, 16, &all, &any)) return false;
      if (all)
        wrong(
            "t = %.17g is inside, and the hit is at %.17g of (%.17g, %.17g, %.17g) + t (%.17g, "
            "%.17g, %.17g)",
            t, hit.t, origin[0], origin[1], origin[2], direction[0], direction[1], direction[2]);
    }
    return true;
  }

  /// Where the onset of the first structure is at most the parameter, the structure is solid.
  bool check_onsets() {
    msq_structure* raw = nullptr;
    if (msq_model_scale(model_, 0, 1, nullptr, &raw) != MSQ_OK) return true;
    const Owner<msq_structure> structure(raw);
    const Owner<msq_model> alone = in_all_space(structure.get());
    if (!alone) return true;
    const std::vector<double> points = some_points(48);
    const msq_points_def array = array_of(points);
    std::vector<double> onsets(points.size() / 3, 7);
    if (!goes_on(MSQ_FUZZ(msq_set_onset, context_, structure.get(), &array, MSQ_ONSET_SIGNED,
                          onsets.data(), onsets.size(), nullptr, 0, job_)))
      return true;
    for (size_t i = 0; i < onsets.size(); ++i) {
      int32_t inside = -7;
      if (!MSQ_FUZZ(msq_point_membership, alone.get(), &points[3 * i], nullptr, &inside))
        return true;
      // Distances are rounded: within 1e-9 of a cell either is right.
      double rounding = 1e-9 * sight_.unit;
      for (int axis = 0; axis < 3; ++axis)
        rounding =
            std::max(rounding, 0x1p-46 * std::abs(points[3 * i + static_cast<size_t>(axis)]));
      if (std::abs(onsets[i]) > rounding && (onsets[i] <= 0) != (inside == 1))
        wrong("onset %.17g at (%.17g, %.17g, %.17g), which is %s", onsets[i], points[3 * i],
              points[3 * i + 1], points[3 * i + 2], inside == 1 ? "inside" : "outside");
    }
    return true;
  }

  Owner<msq_model> in_all_space(msq_structure* structure) const {
    const auto shape = make<msq_shape>("msq_shape_all_space", [&](msq_shape** handle) {
      return msq_shape_all_space(context_, handle);
    });
    if (!shape) return nullptr;
    msq_scale_def scales[2] = {};
    scales[0].shape = shape.get();
    scales[1].structure = structure;
    msq_model_def def = make_def(msq_model_def_init);
    def.scales = scales;
    def.scale_count = 2;
    def.scale_size = sizeof scales[0];
    return make<msq_model>("msq_model_create", [&](msq_model** handle) {
      return msq_model_create(context_, &def, handle);
    });
  }

  Input& input_;
  msq_context* context_;
  const msq_model* model_;
  const Sight sight_;
  const Job& job_;
  Random random_;
  msq_query_def query_{};
  double min_[3], max_[3], low_[3], high_[3];
  bool is_bounded_ = true;
};

}  // namespace

void check_model(Input& input, msq_context* context, const msq_model* model, const Sight& sight,
                 const Job& job) {
  Checker(input, context, model, sight, job).check();
}

}  // namespace msq::fuzz
