// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "scenarios.h"
#include "world.h"

namespace msq::test {

namespace {

const char* const channels[] = {"density"};

/// Models of every kind of structure in a box, and of some in other shapes and with skins.
struct Subject {
  std::string name;
  std::function<msq_model*(World&)> make;
  const Kind* kind;
};

/// A tetrahedron without a side.
msq_shape* open_mesh(World& w) {
  static const double corners[4][3] = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}};
  static const uint32_t triangles[3][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}};
  msq_mesh_def def = make_def(msq_mesh_def_init);
  def.vertices = corners;
  def.vertex_count = 4;
  def.triangles = triangles[0];
  def.triangle_count = 3;
  msq_shape* shape;
  require_ok(msq_shape_from_mesh(w.context, &def, &shape));
  return w.keep(shape);
}

/// A turned mesh and a box, as deep within shapes made of shapes as there may be.
msq_shape* nested(World& w, int depth) {
  static const double turned[12] = {0.8, -0.6, 0, 1.5, 0.6, 0.8, 0, -0.5, 0, 0, 1, 0.25};
  msq_shape* shape;
  require_ok(msq_shape_placed(w.mesh(), turned, &shape));
  w.keep(shape);
  for (int i = 1; i < depth; ++i) {
    const double moved[12] = {1, 0, 0, i % 4 < 2 ? 0.01 : -0.01, 0, 1, 0, 0, 0, 0, 1, 0};
    const msq_shape* const both[2] = {shape, w.box()};
    require_ok(i % 2 ? msq_shape_boolean(MSQ_BOOLEAN_INTERSECTION, both, 2, &shape)
                     : msq_shape_placed(both[0], moved, &shape));
    w.keep(shape);
  }
  return shape;
}

msq_model* regions(World& w, msq_structure* inside) {
  const msq_model* const parts[2] = {w.model(open_mesh(w), inside, 0.2),
                                     w.model(nested(w, 2), nullptr)};
  msq_model* model;
  require_ok(msq_model_regions(w.context, parts, 2, &model));
  return w.keep(model);
}

std::vector<Subject> subjects() {
  std::vector<Subject> all;
  for (const Kind& kind : kinds())
    all.push_back({kind.name, [&kind](World& w) { return w.model(w.box(), kind.make(w)); }, &kind});
  const Kind& lattice = kinds()[0];
  const auto add = [&](const char* name, auto make) {
    all.push_back(
        {name, [&lattice, make](World& w) { return make(w, lattice.make(w)); }, &lattice});
  };
  add("lattice with a skin",
      [](World& w, msq_structure* inside) { return w.model(w.mesh(), inside, 0.3); });
  add("lattice in a mesh",
      [](World& w, msq_structure* inside) { return w.model(w.mesh(), inside); });
  add("lattice in voxels",
      [](World& w, msq_structure* inside) { return w.model(w.voxels(), inside); });
  add("lattice in the host's shape",
      [](World& w, msq_structure* inside) { return w.model(w.host_shape(), inside); });
  add("mesh alone", [](World& w, msq_structure*) { return w.model(w.mesh(), nullptr); });
  add("voxels alone", [](World& w, msq_structure*) { return w.model(w.voxels(), nullptr); });
  add("open mesh alone", [](World& w, msq_structure*) { return w.model(open_mesh(w), nullptr); });
  add("lattice in nested shapes",
      [](World& w, msq_structure* inside) { return w.model(nested(w, 64), inside); });
  add("offset alone", [](World& w, msq_structure*) {
    msq_shape* shape;
    require_ok(msq_shape_offset(nested(w, 2), -0.1, &shape));
    return w.model(w.keep(shape), nullptr);
  });
  add("regions", regions);
  return all;
}

/// One scenario for each subject: play(stage, world, model, is_slow).
template <class Play>
void add_for_each(std::vector<Scenario>& scenarios, const std::string& what, Play play) {
  for (const Subject& subject : subjects())
    scenarios.push_back({what + ": " + subject.name, [subject, play](Stage& stage) {
                           World world(stage);
                           stage.needs_stack = subject.kind->is_cgal;
                           play(stage, world, subject.make(world), subject.kind->is_slow);
                         }});
}

using MakePoints = msq_points_def (*)();

msq_points_def small_array() {
  static const std::vector<double> coordinates = some_points(50);
  return array_of(coordinates);
}
msq_points_def small_grid() {
  return grid_of(5);
}
msq_points_def small_strata() {
  return strata_of(3, 2);
}

uint64_t count_of(const msq_points_def& points) {
  if (points.kind == MSQ_POINTS_ARRAY) return points.count;
  const uint64_t cells = points.counts[0] * points.counts[1] * points.counts[2];
  return points.kind == MSQ_POINTS_GRID ? cells : cells * points.per_cell;
}

}  // namespace

std::vector<Scenario> point_scenarios() {
  std::vector<Scenario> scenarios;
  static const double point[3] = {1.3, 2.21, 0.47};
  add_for_each(scenarios, "msq_point_membership", [](Stage& stage, World&, msq_model* model, bool) {
    int32_t inside;
    stage.watch(inside);
    stage.call([&] { return msq_point_membership(model, point, nullptr, &inside); });
  });
  add_for_each(scenarios, "msq_point_region", [](Stage& stage, World&, msq_model* model, bool) {
    int32_t region;
    stage.watch(region);
    stage.call([&] { return msq_point_region(model, point, &region); });
  });
  add_for_each(scenarios, "msq_point_distance", [](Stage& stage, World&, msq_model* model, bool) {
    double distance;
    stage.watch(distance);
    stage.call([&] { return msq_point_distance(model, point, nullptr, &distance); });
  });
  add_for_each(scenarios, "msq_point_material", [](Stage& stage, World&, msq_model* model, bool) {
    uint32_t id;
    double value;
    stage.watch(id);
    stage.watch(value);
    stage.call([&] { return msq_point_material(model, point, nullptr, channels, 1, &id, &value); });
  });
  return scenarios;
}

std::vector<Scenario> set_scenarios() {
  std::vector<Scenario> scenarios;
  const std::pair<const char*, MakePoints> sets[] = {
      {"array", small_array}, {"grid", small_grid}, {"strata", small_strata}};
  for (const auto& [name, make] : sets) {
    const std::string of_set = std::string(" of ") + name;
    add_for_each(scenarios, "msq_set_membership" + of_set,
                 [make = make](Stage& stage, World&, msq_model* model, bool) {
                   const msq_points_def points = make();
                   std::vector<uint8_t> inside(count_of(points));
                   stage.watch_part(inside);
                   stage.call([&] {
                     return msq_set_membership(model, &points, nullptr, inside.data(),
                                               inside.size(), nullptr);
                   });
                 });
    add_for_each(scenarios, "msq_set_distance" + of_set,
                 [make = make](Stage& stage, World&, msq_model* model, bool) {
                   const msq_points_def points = make();
                   std::vector<double> distances(count_of(points));
                   stage.watch_part(distances);
                   stage.call([&] {
                     return msq_set_distance(model, &points, nullptr, distances.data(),
                                             distances.size(), nullptr);
                   });
                 });
  }
  add_for_each(scenarios, "msq_set_region", [](Stage& stage, World&, msq_model* model, bool) {
    const msq_points_def points = small_grid();
    std::vector<int32_t> regions(count_of(points));
    stage.watch_part(regions);
    stage.call(
        [&] { return msq_set_region(model, &points, regions.data(), regions.size(), nullptr); });
  });
  add_for_each(scenarios, "msq_set_material", [](Stage& stage, World&, msq_model* model, bool) {
    const msq_points_def points = small_grid();
    std::vector<uint32_t> ids(count_of(points));
    std::vector<double> values(ids.size());
    stage.watch_part(ids);
    stage.watch_part(values);
    stage.call([&] {
      return msq_set_material(model, &points, nullptr, channels, 1, ids.data(), ids.size(),
                              values.data(), values.size(), nullptr);
    });
  });
  for (const Kind& kind : kinds())
    if (kind.has_onset && !kind.is_cgal)
      scenarios.push_back({"msq_set_onset of " + kind.name, [&kind](Stage& stage) {
                             World world(stage);
                             msq_structure* const structure = kind.make(world);
                             const msq_points_def points = small_grid();
                             std::vector<double> onsets(count_of(points));
                             std::vector<double> gradients(3 * onsets.size());
                             stage.watch_part(onsets);
                             stage.watch_part(gradients);
                             stage.call([&] {
                               return msq_set_onset(world.context, structure, &points,
                                                    MSQ_ONSET_SIGNED, onsets.data(), onsets.size(),
                                                    gradients.data(), gradients.size(), nullptr);
                             });
                           }});
  scenarios.push_back({"msq_field_evaluate", [](Stage& stage) {
                         World world(stage);
                         msq_field* const field = world.host_field();
                         const msq_points_def points = small_array();
                         std::vector<double> values(count_of(points));
                         stage.watch_part(values);
                         stage.call([&] {
                           return msq_field_evaluate(world.context, field, &points, values.data(),
                                                     values.size(), nullptr);
                         });
                       }});
  scenarios.push_back({"msq_points_generate", [](Stage& stage) {
                         const msq_points_def points = small_strata();
                         std::vector<double> coordinates(3 * count_of(points));
                         stage.watch(coordinates);
                         stage.call([&] {
                           return msq_points_generate(&points, 0, count_of(points),
                                                      coordinates.data());
                         });
                       }});
  return scenarios;
}

std::vector<Scenario> statistic_scenarios() {
  std::vector<Scenario> scenarios;
  static const double lengths[2] = {0.3, 0.7};
  static const auto segments = [] {
    msq_segments_def def = make_def(msq_segments_def_init);
    def.lengths = lengths;
    def.length_count = 2;
    def.step = 0.02;
    return def;
  };
  add_for_each(scenarios, "msq_volume_fraction", [](Stage& stage, World&, msq_model* model, bool) {
    const msq_points_def sample = small_strata();
    msq_estimate estimate;
    stage.watch(estimate);
    stage.call([&] {
      return msq_volume_fraction(model, &sample, nullptr, MSQ_PHASE_SOLID, &estimate, nullptr);
    });
  });
  add_for_each(scenarios, "msq_two_point_correlation",
               [](Stage& stage, World&, msq_model* model, bool) {
                 const msq_points_def sample = small_strata();
                 const msq_segments_def def = segments();
                 std::vector<msq_estimate> estimates(2);
                 stage.watch(estimates);
                 stage.call([&] {
                   return msq_two_point_correlation(model, &sample, nullptr, &def, estimates.data(),
                                                    2, nullptr);
                 });
               });
  add_for_each(scenarios, "msq_lineal_path", [](Stage& stage, World&, msq_model* model, bool) {
    const msq_points_def sample = strata_of(2, 2);
    const msq_segments_def def = segments();
    std::vector<msq_estimate> estimates(2);
    stage.watch(estimates);
    stage.call([&] {
      return msq_lineal_path(model, &sample, nullptr, &def, estimates.data(), 2, nullptr);
    });
  });
  for (const Kind& kind : kinds())
    if (kind.has_onset)
      scenarios.push_back({"msq_structure_calibrate: " + kind.name, [&kind](Stage& stage) {
                             World world(stage);
                             stage.needs_stack = kind.is_cgal;
                             const msq_structure* structure = kind.make(world);
                             const msq_points_def sample = strata_of(4, 2);
                             std::vector<double> parameters(3), fractions(3);
                             msq_calibration_report report;
                             stage.watch(parameters);
                             stage.watch(fractions);
                             stage.call([&] {
                               report = {};
                               report.struct_size = sizeof report;
                               return msq_structure_calibrate(
                                   world.context, structure, &sample, 0.02, parameters.data(),
                                   fractions.data(), 3, &report, nullptr);
                             });
                           }});
  return scenarios;
}

std::vector<Scenario> slice_scenarios() {
  std::vector<Scenario> scenarios;
  add_for_each(
      scenarios, "msq_slice_layer", [](Stage& stage, World& world, msq_model* model, bool is_slow) {
        const msq_slicer* slicer = world.slicer(model, is_slow);
        std::vector<uint8_t> layer(plan_of(slicer).layer_bytes);
        stage.watch(layer);
        stage.call([&] { return msq_slice_layer(slicer, 1, layer.data(), layer.size(), nullptr); });
      });
  add_for_each(
      scenarios, "msq_slicer_run", [](Stage& stage, World& world, msq_model* model, bool is_slow) {
        const msq_slicer* slicer = world.slicer(model, is_slow);
        const msq_slicer_report plan = plan_of(slicer);
        std::vector<uint8_t> layers(plan.layer_count * plan.layer_bytes);
        stage.watch_part(layers);
        stage.call([&] {
          return msq_slicer_run(
              slicer, 0, UINT64_MAX,
              [](void* user, const msq_layer* layer) -> int32_t {
                const uint64_t bytes = layer->stride * layer->height;
                std::copy_n(layer->data, bytes, static_cast<uint8_t*>(user) + bytes * layer->index);
                return 0;
              },
              layers.data(), nullptr);
        });
      });
  scenarios.push_back({"msq_slicer_create", [](Stage& stage) {
                         World world(stage);
                         msq_model* model = world.model(world.box(), kinds()[0].make(world));
                         const double z[3] = {0.5, 1, 3};
                         msq_slicer_def def = make_def(msq_slicer_def_init);
                         def.pitch[0] = def.pitch[1] = 0.5;
                         def.layer_z = z;
                         def.layer_z_count = 3;
                         msq_slicer* slicer;
                         msq_slicer_report plan;
                         std::vector<double> at(1);
                         stage.watch_handle(slicer);
                         stage.watch_probe(at);
                         stage.call([&] { return msq_slicer_create(model, &def, &slicer); },
                                    [&] {
                                      plan = {};
                                      plan.struct_size = sizeof plan;
                                      require_ok(msq_slicer_info(slicer, &plan));
                                      require_ok(msq_slicer_layer_z(slicer, 2, at.data()));
                                      require(plan.layer_count == 3, "layers are lost");
                                      msq_slicer_retain(slicer);
                                      msq_slicer_release(slicer);
                                      msq_slicer_release(slicer);
                                    });
                       }});
  return scenarios;
}

std::vector<Scenario> ray_scenarios() {
  std::vector<Scenario> scenarios;
  add_for_each(scenarios, "msq_ray_cast", [](Stage& stage, World&, msq_model* model, bool) {
    // Rays side by side, as of a picture, and some that are not.
    constexpr uint64_t count = 48;
    std::vector<double> origins(3 * count), directions(3 * count);
    const std::vector<double> any = some_points(count);
    for (uint64_t i = 0; i < count; ++i)
      for (uint64_t axis = 0; axis < 3; ++axis) {
        const bool is_alone = i >= 32;
        const double beside[3] = {1.7 + 0.01 * double(i % 8), 2.1 + 0.01 * double(i / 8), -1};
        const double along[3] = {0.1, 0.05, 1};
        origins[3 * i + axis] = is_alone ? any[3 * i + axis] : beside[axis];
        directions[3 * i + axis] = is_alone ? 2.1 - any[3 * i + axis] : along[axis];
      }
    msq_rays_def rays = make_def(msq_rays_def_init);
    rays.count = count;
    rays.origins = origins.data();
    rays.directions = directions.data();
    std::vector<msq_ray_hit> hits(count);
    stage.watch_part(hits);
    stage.call([&] { return msq_ray_cast(model, &rays, nullptr, hits.data(), count, nullptr); });
  });
  add_for_each(scenarios, "msq_render", [](Stage& stage, World&, msq_model* model, bool) {
    msq_camera camera = make_def(msq_camera_init);
    const double direction[3] = {-1, -0.4, -0.7};
    require_ok(msq_camera_fit(model, direction, nullptr, 12, 8, &camera));
    msq_render_def def = make_def(msq_render_def_init);
    def.width = 12;
    def.height = 8;
    def.shadows = 1;
    def.occlusion_rays = 2;
    def.first_step = 2;
    def.samples = 2;
    msq_frame frame = make_def(msq_frame_init);
    std::vector<float> depth(12 * 8), normal(3 * 12 * 8);
    std::vector<uint8_t> rgba(4 * 12 * 8);
    std::vector<uint32_t> material(12 * 8);
    frame.depth = depth.data();
    frame.normal = normal.data();
    frame.rgba = rgba.data();
    frame.material = material.data();
    stage.watch_part(depth);
    stage.watch_part(normal);
    stage.watch_part(rgba);
    stage.watch_part(material);
    stage.call([&] {
      return msq_render(
          model, &camera, &def, nullptr, &frame,
          [](void*, const msq_render_pass*) -> int32_t { return 0; }, nullptr, nullptr);
    });
  });
  return scenarios;
}

}  // namespace msq::test
