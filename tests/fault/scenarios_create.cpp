// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstring>

#include "scenarios.h"
#include "world.h"

namespace msq::test {

namespace {

/// A handle that make(&handle) makes: probed, retained and released where it is made.
template <class Handle>
void make_handle(Stage& stage, const std::function<msq_status(Handle**)>& make,
                 void (*retain)(Handle*),
                 const std::function<void(Handle*, std::vector<double>&)>& look) {
  Handle* made;
  std::vector<double> probe(8);
  stage.watch_handle(made);
  stage.watch_probe(probe);
  stage.call([&] { return make(&made); },
             [&] {
               retain(made);
               release(made);
               std::fill(probe.begin(), probe.end(), 0.0);
               look(made, probe);
               release(made);
             });
}

/// Shape, field and structure, seen by the memberships of a model.
void look_at_model(const msq_model* model, std::vector<double>& probe) {
  for (size_t i = 0; i < probe.size(); ++i) {
    const double at = static_cast<double>(i);
    const double point[3] = {0.3 + 0.41 * at, 0.2 + 0.37 * at, 3.6 - 0.43 * at};
    int32_t inside;
    require_ok(msq_point_membership(model, point, nullptr, &inside));
    probe[i] = inside;
  }
}

Scenario shape(const std::string& name,
               const std::function<msq_status(World&, msq_shape**)>& make) {
  return {name, [make](Stage& stage) {
            World world(stage);
            make_handle<msq_shape>(
                stage, [&](msq_shape** made) { return make(world, made); }, msq_shape_retain,
                [&](msq_shape* made, std::vector<double>& probe) {
                  World inner(stage);
                  msq_shape_retain(made);
                  look_at_model(inner.model(inner.keep(made), nullptr), probe);
                });
          }};
}

/// Made of a box and a mesh.
Scenario shape_of_shapes(
    const std::string& name,
    const std::function<msq_status(const msq_shape*, const msq_shape*, msq_shape**)>& make) {
  return {name, [make](Stage& stage) {
            World world(stage);
            const msq_shape *box = world.box(), *mesh = world.mesh();
            make_handle<msq_shape>(
                stage, [&](msq_shape** made) { return make(box, mesh, made); }, msq_shape_retain,
                [&](msq_shape* made, std::vector<double>& probe) {
                  World inner(stage);
                  msq_shape_retain(made);
                  look_at_model(inner.model(inner.keep(made), nullptr), probe);
                });
          }};
}

Scenario field(const std::string& name,
               const std::function<msq_status(World&, msq_field**)>& make) {
  return {name, [make](Stage& stage) {
            World world(stage);
            make_handle<msq_field>(
                stage, [&](msq_field** made) { return make(world, made); }, msq_field_retain,
                [&](msq_field* made, std::vector<double>& probe) {
                  World inner(stage);
                  msq_lattice_def def = make_def(msq_lattice_def_init);
                  def.radius.field = made;
                  msq_structure* structure;
                  require_ok(msq_structure_lattice(inner.context, &def, &structure));
                  look_at_model(inner.model(inner.box(), inner.keep(structure)), probe);
                });
          }};
}

}  // namespace

std::vector<Scenario> create_scenarios() {
  static const double origin[3] = {0, 0, 0}, end[3] = {4, 4, 4}, middle[3] = {2, 2, 2};
  std::vector<Scenario> scenarios = {
      shape("msq_shape_from_box",
            [](World& w, msq_shape** made) {
              return msq_shape_from_box(w.context, origin, end, made);
            }),
      shape("msq_shape_from_sphere",
            [](World& w, msq_shape** made) {
              return msq_shape_from_sphere(w.context, middle, 1.9, made);
            }),
      shape("msq_shape_from_cylinder",
            [](World& w, msq_shape** made) {
              return msq_shape_from_cylinder(w.context, origin, end, 1, made);
            }),
      shape("msq_shape_all_space",
            [](World& w, msq_shape** made) { return msq_shape_all_space(w.context, made); }),
      shape("msq_shape_from_mesh",
            [](World& w, msq_shape** made) {
              static const float corners[4][3] = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}};
              static const uint32_t sides[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
              msq_mesh_def def = make_def(msq_mesh_def_init);
              def.coordinate_type = MSQ_FLOAT32;
              def.vertices = corners;
              def.vertex_count = 4;
              def.triangles = sides[0];
              def.triangle_count = 4;
              return msq_shape_from_mesh(w.context, &def, made);
            }),
      shape("msq_shape_from_voxels",
            [](World& w, msq_shape** made) {
              int16_t values[5 * 5 * 5];
              for (int i = 0; i < 125; ++i) values[i] = static_cast<int16_t>(i % 7);
              msq_voxels_def def = make_def(msq_voxels_def_init);
              def.image.values = values;
              def.image.value_type = MSQ_INT16;
              def.threshold = 2.5;
              for (uint64_t& size : def.image.size) size = 5;
              return msq_shape_from_voxels(w.context, &def, made);
            }),
      shape("msq_shape_from_host",
            [](World& w, msq_shape** made) {
              msq_host_shape_def def = make_def(msq_host_shape_def_init);
              def.inside = host_inside;
              std::copy_n(origin, 3, def.min);
              std::copy_n(end, 3, def.max);
              return msq_shape_from_host(w.context, &def, made);
            }),
      shape_of_shapes("msq_shape_placed",
                      [](const msq_shape* box, const msq_shape*, msq_shape** made) {
                        static const double matrix[12] = {0, -1, 0, 4, 1, 0.1, 0, 0, 0, 0, 1, 0};
                        return msq_shape_placed(box, matrix, made);
                      }),
      shape_of_shapes("msq_shape_boolean",
                      [](const msq_shape* box, const msq_shape* mesh, msq_shape** made) {
                        const msq_shape* const both[2] = {box, mesh};
                        return msq_shape_boolean(MSQ_BOOLEAN_DIFFERENCE, both, 2, made);
                      }),
      shape_of_shapes("msq_shape_offset",
                      [](const msq_shape*, const msq_shape* mesh, msq_shape** made) {
                        return msq_shape_offset(mesh, 0.2, made);
                      }),
      field("msq_field_gradient",
            [](World& w, msq_field** made) {
              return msq_field_gradient(w.context, origin, 0.1, end, 0.3, made);
            }),
      field("msq_field_radial",
            [](World& w, msq_field** made) {
              msq_radial_field_def def = make_def(msq_radial_field_def_init);
              def.from_value = 0.1;
              def.to_value = 0.3;
              return msq_field_radial(w.context, &def, made);
            }),
      field("msq_field_host",
            [](World& w, msq_field** made) {
              msq_host_field_def def = make_def(msq_host_field_def_init);
              def.evaluate = host_values;
              def.low = 0.1;
              def.high = 0.2;
              return msq_field_host(w.context, &def, made);
            }),
      field("msq_field_grid",
            [](World& w, msq_field** made) {
              const float values[8] = {0.1f, 0.2f, 0.3f, 0.1f, 0.2f, 0.3f, 0.1f, 0.2f};
              msq_grid_field_def def = make_def(msq_grid_field_def_init);
              def.image.values = values;
              def.image.value_type = MSQ_FLOAT32;
              for (uint64_t& size : def.image.size) size = 2;
              return msq_field_grid(w.context, &def, made);
            }),
      field("msq_field_expression",
            [](World& w, msq_field** made) {
              const msq_named_value parameter = {"width", 0.05};
              msq_expression_field_def def = make_def(msq_expression_field_def_init);
              def.expression = "0.15 + width * sin(x) * max(cos(y), sqrt(abs(z)))^3 - log(2) / 40";
              def.parameters = &parameter;
              def.parameter_count = 1;
              def.low = 0.1;
              def.high = 0.3;
              return msq_field_expression(w.context, &def, made);
            }),
  };
  scenarios.push_back({"msq_field_map", [](Stage& stage) {
                         World world(stage);
                         const msq_field* argument = world.gradient();
                         const double curve[6] = {0.1, 0.2, 0.15, 0.1, 0.25, 0.3};
                         make_handle<msq_field>(
                             stage,
                             [&](msq_field** made) {
                               return msq_field_map(world.context, argument, curve, 3, made);
                             },
                             msq_field_retain, [](msq_field*, std::vector<double>&) {});
                       }});
  for (const double step : {0.0, 1.0})
    scenarios.push_back(
        {step == 0 ? "msq_field_shape_distance" : "msq_field_shape_distance of samples",
         [step](Stage& stage) {
           World world(stage);
           msq_shape_distance_field_def def = make_def(msq_shape_distance_field_def_init);
           const double curve[4] = {-1, 0.3, 0, 0.1};
           def.shape = world.mesh();
           def.curve = curve;
           def.curve_count = 2;
           def.step = step;
           make_handle<msq_field>(
               stage,
               [&](msq_field** made) {
                 return msq_field_shape_distance(world.context, &def, made, nullptr);
               },
               msq_field_retain, [](msq_field*, std::vector<double>&) {});
         }});
  for (const Kind& kind : kinds())
    scenarios.push_back({"msq_structure_*: " + kind.name, [&kind](Stage& stage) {
                           World world(stage);
                           stage.needs_stack = kind.is_cgal;
                           make_handle<msq_structure>(
                               stage, kind.prepare(world), msq_structure_retain,
                               [&](msq_structure* made, std::vector<double>& probe) {
                                 World inner(stage);
                                 look_at_model(inner.model(inner.box(), made), probe);
                               });
                         }});
  scenarios.push_back(
      {"msq_material_create", [](Stage& stage) {
         World world(stage);
         const msq_channel channels[2] = {{"density", {0, world.gradient()}},
                                          {"stiffness", {2, 0}}};
         msq_material_def def = make_def(msq_material_def_init);
         def.id = 3;
         def.channels = channels;
         def.channel_count = 2;
         make_handle<msq_material>(
             stage,
             [&](msq_material** made) { return msq_material_create(world.context, &def, made); },
             msq_material_retain, [](msq_material*, std::vector<double>&) {});
       }});
  scenarios.push_back({"msq_material_blend", [](Stage& stage) {
                         World world(stage);
                         const msq_material *a = world.material(1), *b = world.material(2);
                         const msq_param fraction = {0, world.gradient()};
                         make_handle<msq_material>(
                             stage,
                             [&](msq_material** made) {
                               return msq_material_blend(world.context, 3, a, b, &fraction, made);
                             },
                             msq_material_retain, [](msq_material*, std::vector<double>&) {});
                       }});
  scenarios.push_back(
      {"msq_model_create, msq_model_bounds, msq_model_scale_length, msq_model_scale",
       [](Stage& stage) {
         World world(stage);
         msq_scale_def scales[3];
         std::memset(scales, 0, sizeof scales);
         scales[0].shape = world.mesh();
         scales[1].structure = kinds()[0].make(world);
         scales[1].skin.field = world.gradient();
         scales[1].material = world.material(1);
         scales[2].structure = kinds()[4].make(world);
         msq_model_def def = make_def(msq_model_def_init);
         def.scales = scales;
         def.scale_count = 3;
         make_handle<msq_model>(
             stage, [&](msq_model** made) { return msq_model_create(world.context, &def, made); },
             msq_model_retain,
             [](msq_model* made, std::vector<double>& probe) {
               require_ok(msq_model_bounds(made, &probe[0], &probe[3]));
               require_ok(msq_model_scale_length(made, 1, &probe[6]));
               msq_structure* structure;
               require_ok(msq_model_scale(made, 0, 1, nullptr, &structure));
               msq_structure_release(structure);
             });
       }});
  scenarios.push_back(
      {"msq_model_regions", [](Stage& stage) {
         World world(stage);
         const msq_model* const regions[2] = {world.model(world.mesh(), kinds()[0].make(world)),
                                              world.model(world.box(), nullptr)};
         make_handle<msq_model>(
             stage,
             [&](msq_model** made) { return msq_model_regions(world.context, regions, 2, made); },
             msq_model_retain,
             [](msq_model* made, std::vector<double>& probe) { look_at_model(made, probe); });
       }});
  return scenarios;
}

}  // namespace msq::test
