// SPDX-License-Identifier: Apache-2.0
#include "objects.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>

namespace msq::fuzz {

namespace {

/// Axes at an angle about x, then about z.
void turn(double angle, double other, double rotation[9]) {
  const double c = std::cos(angle), s = std::sin(angle), d = std::cos(other), t = std::sin(other);
  const double turned[9] = {d, -t * c, t * s, t, d * c, -d * s, 0, s, c};
  std::memcpy(rotation, turned, sizeof turned);
}

// What the host computes. It depends on the arguments alone; `user` points to a unit and a place.
struct Place {
  double unit;
  double at[3];
};
/// Freed with the object that uses it.
Place* place_of(const Sight& sight) {
  return new Place{sight.unit, {sight.at[0], sight.at[1], sight.at[2]}};
}
void free_place(void* user) {
  delete static_cast<Place*>(user);
}

int32_t ball_inside(void* user, const double* points, uint64_t count, uint8_t* inside) {
  const auto* place = static_cast<const Place*>(user);
  for (uint64_t i = 0; i < count; ++i, points += 3) {
    double square = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double d = (points[axis] - place->at[axis]) / place->unit;
      square += d * d;
    }
    inside[i] = square <= 4;
  }
  return 0;
}
int32_t ball_distance(void* user, const double* points, uint64_t count, double* values) {
  const auto* place = static_cast<const Place*>(user);
  for (uint64_t i = 0; i < count; ++i, points += 3) {
    double square = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double d = (points[axis] - place->at[axis]) / place->unit;
      square += d * d;
    }
    values[i] = 0.999 * place->unit * std::abs(std::sqrt(square) - 2);
    if (!std::isfinite(values[i])) values[i] = 0;
  }
  return 0;
}
/// A wave between 0 and 1.
int32_t wave_values(void* user, const double* points, uint64_t count, double* values) {
  const auto* place = static_cast<const Place*>(user);
  for (uint64_t i = 0; i < count; ++i, points += 3) {
    const double x = (points[0] - place->at[0]) / place->unit;
    values[i] = std::isfinite(x) ? 0.5 + 0.5 * std::sin(x) : 0.5;
  }
  return 0;
}
}  // namespace

Maker::Maker(Input& input, msq_context* context, const Job& job)
    : input_(input), context_(context), job_(job) {
  sight_.part = 0;
  static constexpr double units[] = {1, 1, 1, 1, 1, 0.37, 1e-6, 1e6};
  sight_.unit = units[input_.below(8)];
  const uint32_t away = input_.below(8);
  for (double& at : sight_.at)
    at = away < 5
             ? 0
             : sight_.unit * (away == 5 ? 1000.25 : input_.between(-1, 1) * (away == 6 ? 10 : 1e6));
}

msq_neighbourhood Maker::grid() {
  msq_neighbourhood grid = make_def(msq_lattice_def_init).grid;
  const uint32_t kind = input_.below(8);
  for (int axis = 0; axis < 3; ++axis) {
    grid.origin[axis] = kind & 1 ? coordinate(axis, 1) : sight_.at[axis];
    grid.cell_size[axis] = kind & 2 ? sight_.unit * input_.number(0.3, 3) : sight_.unit;
  }
  if (kind & 4) {
    turn(input_.between(-3.2, 3.2), input_.between(-3.2, 3.2), grid.rotation);
    if (input_.chance(4)) grid.rotation[input_.below(9)] = input_.number(-1, 1);
  }
  return grid;
}

msq_image Maker::image(std::vector<double>* values, double low, double high) {
  msq_image image = make_def(msq_voxels_def_init).image;
  image.value_type = MSQ_FLOAT64;
  uint64_t count = 1;
  for (uint64_t& size : image.size) {
    size = 2 + input_.below(4);
    count *= size;
  }
  for (uint64_t i = 0; i < count; ++i) values->push_back(input_.between(low, high));
  if (input_.chance(8))
    (*values)[input_.below(static_cast<uint32_t>(count))] = input_.number(low, high);
  image.values = values->data();
  image.grid = grid();
  for (int axis = 0; axis < 3; ++axis) image.grid.origin[axis] -= 2 * sight_.unit;
  return image;
}

Owner<msq_field> Maker::field(double low, double high, int depth) {
  const uint32_t kind = input_.below(depth < 3 ? 8 : 5);
  switch (kind) {
    case 0:
    case 1: {
      double from[3], to[3];
      for (int axis = 0; axis < 3; ++axis) {
        from[axis] = coordinate(axis, 3);
        to[axis] = coordinate(axis, 3);
      }
      const double a = input_.number(low, high), b = input_.number(low, high);
      return make<msq_field>("msq_field_gradient", [&](msq_field** f) {
        return msq_field_gradient(context_, from, a, to, b, f);
      });
    }
    case 2: {
      is_rough();
      msq_radial_field_def def = make_def(msq_radial_field_def_init);
      for (int axis = 0; axis < 3; ++axis) {
        def.center[axis] = coordinate(axis, 2);
        if (input_.chance(100)) def.axis[axis] = input_.number(-1, 1);
      }
      def.from_radius = sight_.unit * input_.number(0, 1);
      def.to_radius = sight_.unit * input_.number(1, 3);
      def.from_value = input_.number(low, high);
      def.to_value = input_.number(low, high);
      return make<msq_field>("msq_field_radial",
                             [&](msq_field** f) { return msq_field_radial(context_, &def, f); });
    }
    case 3: {
      is_rough();
      msq_expression_field_def def = make_def(msq_expression_field_def_init);
      const msq_named_value parameter = {"a", input_.number(-2, 2)};
      def.expression = formula();
      def.parameters = &parameter;
      def.parameter_count = 1;
      def.low = low;
      def.high = input_.number(low, high);
      return make<msq_field>("msq_field_expression", [&](msq_field** f) {
        return msq_field_expression(context_, &def, f);
      });
    }
    case 4: {
      is_rough();
      msq_host_field_def def = make_def(msq_host_field_def_init);
      def.evaluate = wave_values;
      def.low = 0;
      def.high = 1;
      def.concurrent = static_cast<int32_t>(input_.below(2));
      if (input_.chance(128)) def.lipschitz = 0.5001 / sight_.unit;
      def.hash_key[0] = 1;
      def.user = place_of(sight_);
      def.release = free_place;
      Owner<msq_field> wave = make<msq_field>(
          "msq_field_host", [&](msq_field** f) { return msq_field_host(context_, &def, f); });
      if (!wave) {
        free_place(def.user);
        return nullptr;
      }
      const double curve[4] = {0, low, 1, high};
      return make<msq_field>("msq_field_map", [&](msq_field** f) {
        return msq_field_map(context_, wave.get(), curve, 2, f);
      });
    }
    case 5: {
      is_rough();
      msq_grid_field_def def = make_def(msq_grid_field_def_init);
      std::vector<double> values;
      def.image = image(&values, low, high);
      return make<msq_field>("msq_field_grid",
                             [&](msq_field** f) { return msq_field_grid(context_, &def, f); });
    }
    case 6: {
      is_rough();
      const Owner<msq_field> argument = field(0, 1, depth + 1);
      if (!argument) return nullptr;
      std::vector<double> curve;
      const uint32_t count = 1 + input_.below(5);
      double at = input_.number(-0.2, 0.2);
      for (uint32_t i = 0; i < count; ++i) {
        curve.push_back(at);
        curve.push_back(input_.number(low, high));
        at += input_.number(0.01, 0.6);
      }
      return make<msq_field>("msq_field_map", [&](msq_field** f) {
        return msq_field_map(context_, argument.get(), curve.data(), count, f);
      });
    }
    default: {
      is_rough();
      const Owner<msq_shape> of = shape(depth + 2);
      if (!of) return nullptr;
      msq_shape_distance_field_def def = make_def(msq_shape_distance_field_def_init);
      const double curve[6] = {-sight_.unit, input_.number(low, high), 0, input_.number(low, high),
                               sight_.unit,  input_.number(low, high)};
      def.shape = of.get();
      def.curve = curve;
      def.curve_count = 3;
      if (input_.chance(64)) def.step = sight_.unit * input_.between(0.3, 1);
      return make<msq_field>("msq_field_shape_distance", [&](msq_field** f) {
        return msq_field_shape_distance(context_, &def, f, job_);
      });
    }
  }
}

msq_param Maker::param(double low, double high) {
  msq_param param = {input_.number(low, high), nullptr};
  if (input_.chance(80)) {
    if (Owner<msq_field> varying = field(low, high)) {
      param.field = varying.get();
      fields_.push_back(std::move(varying));
    }
  }
  return param;
}

Owner<msq_shape> Maker::shape(int depth) {
  return shape_of_kind(input_.below(depth < 3 ? 16 : 8), depth);
}

Owner<msq_shape> Maker::shape_of_kind(uint32_t kind, int depth) {
  double a[3], b[3];
  switch (kind) {
    case 0:
    case 1:
    case 2:
      for (int axis = 0; axis < 3; ++axis) {
        a[axis] = coordinate(axis, 2.5);
        b[axis] = a[axis] + sight_.unit * input_.number(0.5, 4);
      }
      return make<msq_shape>("msq_shape_from_box",
                             [&](msq_shape** s) { return msq_shape_from_box(context_, a, b, s); });
    case 3: {
      for (int axis = 0; axis < 3; ++axis) a[axis] = coordinate(axis, 2);
      const double radius = sight_.unit * input_.number(0.5, 3);
      return make<msq_shape>("msq_shape_from_sphere", [&](msq_shape** s) {
        return msq_shape_from_sphere(context_, a, radius, s);
      });
    }
    case 4: {
      for (int axis = 0; axis < 3; ++axis) {
        a[axis] = coordinate(axis, 2);
        b[axis] = input_.chance(80) ? a[axis] : coordinate(axis, 3);
      }
      const double radius = sight_.unit * input_.number(0.3, 2);
      return make<msq_shape>("msq_shape_from_cylinder", [&](msq_shape** s) {
        return msq_shape_from_cylinder(context_, a, b, radius, s);
      });
    }
    case 5:
    case 6: {
      // A tetrahedron or an octahedron, with other triangles now and then.
      std::vector<double> vertices;
      const uint32_t count = 4 + input_.below(5);
      for (uint32_t i = 0; i < 3 * count; ++i)
        vertices.push_back(coordinate(static_cast<int>(i % 3), 2.5));
      std::vector<uint32_t> triangles = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
      if (kind == 6) is_rough();  // the winding number of open meshes
      if (kind == 6)
        for (uint32_t extra = input_.below(8) * 3; extra > 0; --extra)
          triangles.push_back(input_.below(input_.chance(2) ? 250 : count));
      msq_mesh_def def = make_def(msq_mesh_def_init);
      def.vertices = vertices.data();
      def.vertex_count = count;
      def.triangles = triangles.data();
      def.triangle_count = triangles.size() / 3;
      def.winding_rule = static_cast<int32_t>(input_.below(4));
      return make<msq_shape>("msq_shape_from_mesh",
                             [&](msq_shape** s) { return msq_shape_from_mesh(context_, &def, s); });
    }
    case 7: {
      is_rough();
      msq_voxels_def def = make_def(msq_voxels_def_init);
      std::vector<double> values;
      def.image = image(&values, -1, 1);
      def.solid = static_cast<int32_t>(input_.below(2));
      def.threshold = input_.number(-0.5, 0.5);
      return make<msq_shape>("msq_shape_from_voxels", [&](msq_shape** s) {
        return msq_shape_from_voxels(context_, &def, s);
      });
    }
    case 8:
    case 9:
      return make<msq_shape>("msq_shape_all_space",
                             [&](msq_shape** s) { return msq_shape_all_space(context_, s); });
    case 10: {
      is_rough();
      msq_host_shape_def def = make_def(msq_host_shape_def_init);
      def.inside = ball_inside;
      if (input_.chance(128)) def.distance = ball_distance;
      if (!def.distance) sight_.part = 4;
      for (int axis = 0; axis < 3; ++axis) {
        def.min[axis] = sight_.at[axis] - 2.5 * sight_.unit;
        def.max[axis] =
            sight_.at[axis] + 2.5 * sight_.unit;  // all of the ball: distances are its own
      }
      def.concurrent = static_cast<int32_t>(input_.below(2));
      def.hash_key[1] = 7;
      def.user = place_of(sight_);
      def.release = free_place;
      Owner<msq_shape> made = make<msq_shape>("msq_shape_from_host", [&](msq_shape** s) {
        return msq_shape_from_host(context_, &def, s);
      });
      if (!made) free_place(def.user);
      return made;
    }
    case 11:
    case 12: {
      const Owner<msq_shape> original = shape(depth + 1);
      if (!original) return nullptr;
      double turned[9];
      turn(input_.between(-3.2, 3.2), input_.chance(128) ? input_.between(-3.2, 3.2) : 0, turned);
      const double growth = input_.number(0.5, 1.5);
      double matrix[12];
      for (int row = 0; row < 3; ++row) {
        matrix[4 * row + 3] = sight_.at[row];
        for (int column = 0; column < 3; ++column) {
          matrix[4 * row + column] = growth * turned[3 * row + column];
          if (input_.chance(10)) {
            matrix[4 * row + column] += input_.number(-0.3, 0.3);
            is_rough();
          }
        }
        // About the place itself.
        for (int column = 0; column < 3; ++column)
          matrix[4 * row + 3] -= matrix[4 * row + column] * sight_.at[column];
      }
      return make<msq_shape>("msq_shape_placed", [&](msq_shape** s) {
        return msq_shape_placed(original.get(), matrix, s);
      });
    }
    case 13:
    case 14: {
      std::vector<Owner<msq_shape>> owners;
      std::vector<const msq_shape*> shapes;
      for (uint32_t count = 1 + input_.below(3); count > 0; --count) {
        owners.push_back(shape(depth + 1));
        if (!owners.back()) return nullptr;
        shapes.push_back(owners.back().get());
      }
      const int32_t operation = 1 + static_cast<int32_t>(input_.below(3));
      return make<msq_shape>("msq_shape_boolean", [&](msq_shape** s) {
        return msq_shape_boolean(operation, shapes.data(), shapes.size(), s);
      });
    }
    default: {
      is_rough();
      const Owner<msq_shape> original = shape(depth + 1);
      if (!original) return nullptr;
      const double distance = sight_.unit * input_.number(-0.5, 0.5);
      return make<msq_shape>("msq_shape_offset", [&](msq_shape** s) {
        return msq_shape_offset(original.get(), distance, s);
      });
    }
  }
}

Owner<msq_material> Maker::material(int depth) {
  const uint32_t id = 1 + input_.below(5);
  if (depth < 2 && input_.chance(60)) {
    const Owner<msq_material> a = material(depth + 1), b = material(depth + 1);
    if (!a || !b) return nullptr;
    const msq_param fraction = param(0, 1);
    return make<msq_material>("msq_material_blend", [&](msq_material** m) {
      return msq_material_blend(context_, id, a.get(), b.get(), &fraction, m);
    });
  }
  msq_material_def def = make_def(msq_material_def_init);
  const msq_channel channel = {"density", param(0, 1)};
  def.id = id;
  def.channels = &channel;
  def.channel_count = 1;
  return make<msq_material>("msq_material_create", [&](msq_material** m) {
    return msq_material_create(context_, &def, m);
  });
}

Owner<msq_model> Maker::model_of(const msq_structure* structure, double cells) {
  double low[3], high[3];
  for (int axis = 0; axis < 3; ++axis) {
    low[axis] = sight_.at[axis] - cells * sight_.unit;
    high[axis] = sight_.at[axis] + cells * sight_.unit;
  }
  const Owner<msq_shape> box = make<msq_shape>("msq_shape_from_box", [&](msq_shape** s) {
    return msq_shape_from_box(context_, low, high, s);
  });
  if (!box) return nullptr;
  msq_scale_def scales[2] = {};
  scales[0].shape = box.get();
  scales[1].structure = structure;
  msq_model_def def = make_def(msq_model_def_init);
  def.scales = scales;
  def.scale_count = 2;
  return make<msq_model>("msq_model_create",
                         [&](msq_model** m) { return msq_model_create(context_, &def, m); });
}

Owner<msq_model> Maker::model() {
  std::vector<Owner<msq_model>> owners;
  std::vector<const msq_model*> regions;
  const uint32_t count = input_.chance(40) ? 2 + input_.below(2) : 1;
  for (uint32_t region = 0; region < count; ++region) {
    const Owner<msq_shape> coarse = shape();
    if (!coarse) return nullptr;
    std::vector<Owner<msq_structure>> structures;
    std::vector<Owner<msq_material>> materials;
    std::vector<msq_scale_def> scales(1);
    scales[0].shape = coarse.get();
    const uint32_t scale_count = input_.chance(60) ? 2 : 1;
    for (uint32_t i = 0; i < scale_count; ++i) {
      structures.push_back(structure());
      if (!structures.back()) return nullptr;
      msq_scale_def scale = {};
      scale.structure = structures.back().get();
      if (input_.chance(40)) {
        scale.skin = param(0, 0.4 * sight_.unit);
        is_rough();
      }
      scales.push_back(scale);
    }
    for (msq_scale_def& scale : scales)
      if (input_.chance(60)) {
        materials.push_back(material());
        scale.material = materials.back().get();
      }
    msq_model_def def = make_def(msq_model_def_init);
    def.scales = scales.data();
    def.scale_count = static_cast<uint32_t>(scales.size());
    owners.push_back(make<msq_model>(
        "msq_model_create", [&](msq_model** m) { return msq_model_create(context_, &def, m); }));
    if (!owners.back()) return nullptr;
    regions.push_back(owners.back().get());
  }
  if (count == 1) return std::move(owners[0]);
  is_rough();
  return make<msq_model>("msq_model_regions", [&](msq_model** m) {
    return msq_model_regions(context_, regions.data(), regions.size(), m);
  });
}

}  // namespace msq::fuzz
