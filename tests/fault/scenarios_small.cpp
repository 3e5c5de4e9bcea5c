// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "scenarios.h"
#include "world.h"

namespace msq::test {

namespace {

/// Sets defaults in a definition.
template <class Def>
Scenario definition(const std::string& name, msq_status (*init)(Def*, size_t)) {
  return {name, [init](Stage& stage) {
            Def def;
            stage.watch(def);
            stage.call([&] { return init(&def, sizeof def); });
          }};
}

}  // namespace

std::vector<Scenario> small_scenarios() {
  std::vector<Scenario> scenarios = {
      definition("msq_context_def_init", msq_context_def_init),
      definition("msq_file_def_init", msq_file_def_init),
      definition("msq_mesh_def_init", msq_mesh_def_init),
      definition("msq_host_shape_def_init", msq_host_shape_def_init),
      definition("msq_voxels_def_init", msq_voxels_def_init),
      definition("msq_radial_field_def_init", msq_radial_field_def_init),
      definition("msq_host_field_def_init", msq_host_field_def_init),
      definition("msq_grid_field_def_init", msq_grid_field_def_init),
      definition("msq_expression_field_def_init", msq_expression_field_def_init),
      definition("msq_shape_distance_field_def_init", msq_shape_distance_field_def_init),
      definition("msq_unit_cell_def_init", msq_unit_cell_def_init),
      definition("msq_lattice_def_init", msq_lattice_def_init),
      definition("msq_plate_lattice_def_init", msq_plate_lattice_def_init),
      definition("msq_beams_def_init", msq_beams_def_init),
      definition("msq_foam_def_init", msq_foam_def_init),
      definition("msq_functional_def_init", msq_functional_def_init),
      definition("msq_period_def_init", msq_period_def_init),
      definition("msq_warp_def_init", msq_warp_def_init),
      definition("msq_waves_def_init", msq_waves_def_init),
      definition("msq_host_structure_def_init", msq_host_structure_def_init),
      definition("msq_host_function_def_init", msq_host_function_def_init),
      definition("msq_material_def_init", msq_material_def_init),
      definition("msq_model_def_init", msq_model_def_init),
      definition("msq_query_def_init", msq_query_def_init),
      definition("msq_points_def_init", msq_points_def_init),
      definition("msq_segments_def_init", msq_segments_def_init),
      definition("msq_slicer_def_init", msq_slicer_def_init),
      definition("msq_contours_def_init", msq_contours_def_init),
      definition("msq_fill_def_init", msq_fill_def_init),
      definition("msq_struts_def_init", msq_struts_def_init),
      definition("msq_rays_def_init", msq_rays_def_init),
      definition("msq_camera_init", msq_camera_init),
      definition("msq_render_def_init", msq_render_def_init),
      definition("msq_frame_init", msq_frame_init),
  };
  scenarios.push_back({"msq_version, msq_status_name, msq_build_info", [](Stage& stage) {
                         msq_build_report report;
                         stage.call([&] {
                           report = {};
                           report.struct_size = sizeof report;
                           return msq_build_info(&report);
                         });
                         require(report.version == msq_version(), "other versions");
                         require(msq_status_name(MSQ_OK)[0] != 0, "no name");
                       }});
  scenarios.push_back(
      {"msq_neighbourhood_placed", [](Stage& stage) {
         static const double matrix[12] = {0, -1, 0, 4, 1, 0, 0, 0, 0, 0, 1, 0};
         const msq_neighbourhood grid = {{1, 2, 3}, {1, 2, 1}, {1, 0, 0, 0, 1, 0, 0, 0, 1}};
         msq_neighbourhood placed;
         stage.watch(placed);
         stage.call([&] { return msq_neighbourhood_placed(&grid, matrix, &placed); });
       }});
  scenarios.push_back({"msq_error_message, msq_error_host_code", [](Stage& stage) {
                         // A failure is told also where there is no memory for its message.
                         msq_status status;
                         stage.call([&] {
                           status = msq_context_create(nullptr, nullptr);
                           return status == MSQ_E_ARGUMENT ? MSQ_OK : status;
                         });
                         require(msq_error_message()[0] != 0, "there is no message");
                         msq_error_host_code();
                       }});
  scenarios.push_back({"msq_context_create", [](Stage& stage) {
                         msq_context_def def = make_def(msq_context_def_init);
                         def.threads = stage.threads;
                         def.cache_policy = MSQ_CACHE_SEGMENTED;
                         msq_context* context;
                         stage.watch_handle(context);
                         stage.call([&] { return msq_context_create(&def, &context); },
                                    [&] {
                                      msq_context_retain(context);
                                      msq_context_release(context);
                                      msq_context_release(context);
                                    });
                       }});
  scenarios.push_back({"msq_context_memory, msq_cache_stats, msq_cache_clear", [](Stage& stage) {
                         World world(stage);
                         msq_memory_report memory;
                         msq_cache_report cache;
                         stage.call([&] {
                           memory = {};
                           memory.struct_size = sizeof memory;
                           cache = {};
                           cache.struct_size = sizeof cache;
                           msq_status status = msq_context_memory(world.context, &memory);
                           if (status == MSQ_OK) status = msq_cache_stats(world.context, &cache);
                           if (status == MSQ_OK) status = msq_cache_clear(world.context);
                           return status;
                         });
                       }});
  scenarios.push_back({"msq_job_create", [](Stage& stage) {
                         msq_job* job;
                         stage.watch_handle(job);
                         stage.call([&] { return msq_job_create(&job); },
                                    [&] {
                                      msq_job_retain(job);
                                      msq_job_release(job);
                                      msq_job_release(job);
                                    });
                       }});
  scenarios.push_back({"msq_job_progress, msq_job_info, msq_job_cancel", [](Stage& stage) {
                         msq_job* job;
                         require_ok(msq_job_create(&job));
                         double fraction;
                         msq_job_report report;
                         stage.watch(fraction);
                         stage.call([&] {
                           report = {};
                           report.struct_size = sizeof report;
                           msq_status status = msq_job_progress(job, &fraction);
                           if (status == MSQ_OK) status = msq_job_info(job, &report);
                           if (status == MSQ_OK) status = msq_job_cancel(job);
                           return status;
                         });
                         msq_job_release(job);
                       }});
  scenarios.push_back({"msq_unit_cell_info", [](Stage& stage) {
                         const msq_unit_cell_def cell = make_def(msq_unit_cell_def_init);
                         msq_unit_cell_report report;
                         std::vector<uint32_t> unmatched(4);
                         stage.watch(unmatched);
                         stage.call([&] {
                           report = {};
                           report.struct_size = sizeof report;
                           return msq_unit_cell_info(&cell, &report, unmatched.data(), 4);
                         });
                       }});
  scenarios.push_back({"msq_unit_cell_geometry", [](Stage& stage) {
                         const msq_unit_cell_def cell = make_def(msq_unit_cell_def_init);
                         msq_unit_cell_report report = {};
                         report.struct_size = sizeof report;
                         require_ok(msq_unit_cell_info(&cell, &report, nullptr, 0));
                         std::vector<double> nodes(3 * report.node_count);
                         std::vector<uint32_t> struts(2 * report.strut_count);
                         stage.watch(nodes);
                         stage.watch(struts);
                         stage.call([&] {
                           return msq_unit_cell_geometry(&cell, nodes.data(), report.node_count,
                                                         struts.data(), report.strut_count);
                         });
                       }});
  scenarios.push_back({"msq_lattice_faces", [](Stage& stage) {
                         World world(stage);
                         const auto& all = kinds();
                         const auto mixed = std::find_if(all.begin(), all.end(), [](const Kind& k) {
                           return k.name == "mixed lattice";
                         });
                         const msq_structure* lattice = mixed->make(world);
                         const double min[3] = {0, 0, 0}, max[3] = {4, 4, 4};
                         msq_lattice_faces_report report;
                         stage.call([&] {
                           report = {};
                           report.struct_size = sizeof report;
                           return msq_lattice_faces(lattice, min, max, &report, nullptr);
                         });
                       }});
  scenarios.push_back({"msq_shape_info", [](Stage& stage) {
                         World world(stage);
                         const msq_shape* shape = world.mesh();
                         msq_shape_report report;
                         stage.call([&] {
                           report = {};
                           report.struct_size = sizeof report;
                           return msq_shape_info(shape, &report);
                         });
                       }});
#if MSQ_WITH_XXHASH
  scenarios.push_back(
      {"msq_shape_hash, msq_field_hash, msq_structure_hash, msq_material_hash, "
       "msq_model_hash",
       [](Stage& stage) {
         World world(stage);
         msq_shape* shape = world.mesh();
         const msq_field* field = world.gradient();
         const msq_material* material = world.material(3);
         const auto& all = kinds();
         const auto beams =
             std::find_if(all.begin(), all.end(), [](const Kind& k) { return k.name == "beams"; });
         msq_structure* structure = beams->make(world);
         const msq_model* model = world.model(shape, structure);
         std::vector<uint8_t> hashes(5 * 16);
         stage.watch_part(hashes);
         stage.call([&] {
           uint8_t* hash = hashes.data();
           msq_status status = msq_shape_hash(shape, hash);
           if (status == MSQ_OK) status = msq_field_hash(field, hash + 16);
           if (status == MSQ_OK) status = msq_structure_hash(structure, hash + 32);
           if (status == MSQ_OK) status = msq_material_hash(material, hash + 48);
           if (status == MSQ_OK) status = msq_model_hash(model, hash + 64);
           return status;
         });
       }});
  // The depth that constructors allow: 64 blends of a field that is 64 maps over 64 placed shapes.
  scenarios.push_back(
      {"msq_material_hash of objects within each other", [](Stage& stage) {
         World world(stage);
         const double matrix[12] = {1, 0, 0, 0.5, 0, 1, 0, 0, 0, 0, 1, 0};
         msq_shape* shape = world.box();
         for (int depth = 0; depth < 64; ++depth) {
           require_ok(msq_shape_placed(shape, matrix, &shape));
           world.keep(shape);
         }
         const double curve[4] = {-1, 0, 1, 1};
         msq_shape_distance_field_def def = make_def(msq_shape_distance_field_def_init);
         def.shape = shape;
         def.curve = curve;
         def.curve_count = 2;
         msq_field* field;
         require_ok(msq_field_shape_distance(world.context, &def, &field, nullptr));
         world.keep(field);
         for (int depth = 1; depth < 64; ++depth) {
           require_ok(msq_field_map(world.context, field, curve, 2, &field));
           world.keep(field);
         }
         msq_material* material = world.material(3);
         const msq_material* plain = material;
         const msq_param fraction = {0, field};
         for (uint32_t depth = 0; depth < 64; ++depth) {
           require_ok(msq_material_blend(world.context, 4, plain, material, &fraction, &material));
           world.keep(material);
         }
         std::vector<uint8_t> hash(16);
         stage.watch(hash);
         stage.call([&] { return msq_material_hash(material, hash.data()); });
       }});
#endif
#if MSQ_WITH_CGAL
  scenarios.push_back({"msq_shape_self_intersections", [](Stage& stage) {
                         stage.needs_stack = true;
                         World world(stage);
                         const msq_shape* shape = world.mesh();
                         uint64_t pairs;
                         stage.watch(pairs);
                         stage.call(
                             [&] { return msq_shape_self_intersections(shape, &pairs, nullptr); });
                       }});
#endif
  scenarios.push_back({"msq_camera_fit, msq_camera_ray", [](Stage& stage) {
                         World world(stage);
                         const msq_model* model = world.model(world.box(), nullptr);
                         const double direction[3] = {-1, -2, -1}, position[2] = {3.5, 4.5};
                         std::vector<double> ray(6);
                         stage.watch(ray);
                         stage.call([&] {
                           msq_camera camera;
                           msq_status status = msq_camera_init(&camera, sizeof camera);
                           if (status == MSQ_OK)
                             status = msq_camera_fit(model, direction, nullptr, 20, 10, &camera);
                           if (status == MSQ_OK)
                             status = msq_camera_ray(&camera, 20, 10, position, &ray[0], &ray[3]);
                           return status;
                         });
                       }});
  return scenarios;
}

}  // namespace msq::test
