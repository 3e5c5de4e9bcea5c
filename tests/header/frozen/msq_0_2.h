/* SPDX-License-Identifier: Apache-2.0
 * What msq.h declared when its version was frozen, without the comments. Written by
 * tests/header/check_abi.py --freeze, and not edited: programs were compiled with this. */
/* clang-format off */
#ifndef MSQ_H
#define MSQ_H

#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32) && defined(MSQ_SHARED)
#ifdef MSQ_BUILDING
#define MSQ_API __declspec(dllexport)
#else
#define MSQ_API __declspec(dllimport)
#endif
#elif defined(__GNUC__) && !defined(_WIN32)
#define MSQ_API __attribute__((visibility("default")))
#else
#define MSQ_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

#define MSQ_VERSION_MAJOR 0
#define MSQ_VERSION_MINOR 2
#define MSQ_VERSION_PATCH 0

#define MSQ_VERSION 200

typedef int32_t msq_status;

enum msq_status_code {
  MSQ_OK = 0,
  MSQ_E_ARGUMENT = -1,
  MSQ_E_MEMORY = -2,
  MSQ_E_CANCELLED = -3,
  MSQ_E_HOST = -4,
  MSQ_E_IO = -5,
  MSQ_E_UNSUPPORTED = -6,
  MSQ_E_MESH = -7,
  MSQ_E_LIMIT = -8,
  MSQ_E_INTERNAL = -9
};

MSQ_API uint32_t msq_version(void);

MSQ_API const char* msq_status_name(msq_status status);

MSQ_API const char* msq_error_message(void);

MSQ_API int32_t msq_error_host_code(void);

typedef struct msq_build_report {
  uint32_t struct_size;
  uint32_t version;
  int32_t with_assimp;
  int32_t with_cgal;
  const char* licence;
  const char* simd;
  int32_t with_xxhash;
  int32_t with_json;
} msq_build_report;

MSQ_API msq_status msq_build_info(msq_build_report* report);

typedef struct msq_context msq_context;

typedef struct msq_job msq_job;

enum msq_cache_policy {
  MSQ_CACHE_FIFO = 0,
  MSQ_CACHE_SEGMENTED = 1
};

enum msq_warning_code {
  MSQ_WARNING_OPEN_MESH = 1,
  MSQ_WARNING_COARSE_PITCH = 2,
  MSQ_WARNING_SMALL_CACHE = 3,
  MSQ_WARNING_UNMATCHED_CELLS = 4
};

typedef void (*msq_warning_fn)(void* user, int32_t code, const char* message);

typedef void (*msq_release_fn)(void* user);

typedef void (*msq_task_fn)(void* task, uint64_t i);

typedef int32_t (*msq_parallel_for_fn)(void* user, uint64_t count, msq_task_fn body, void* task);

typedef struct msq_context_def {
  uint32_t struct_size;
  uint32_t threads;
  uint64_t cache_bytes;
  uint64_t memory_limit;
  int32_t cache_policy;
  uint32_t reserved;
  msq_warning_fn warning;
  void* warning_user;
  msq_parallel_for_fn parallel_for;
  void* parallel_for_user;
  msq_release_fn parallel_for_release;
  msq_release_fn warning_release;
} msq_context_def;

MSQ_API msq_status msq_context_def_init(msq_context_def* def, size_t size);

MSQ_API msq_status msq_context_create(const msq_context_def* def, msq_context** context);

MSQ_API void msq_context_retain(msq_context* context);

MSQ_API void msq_context_release(msq_context* context);

typedef struct msq_memory_report {
  uint32_t struct_size;
  uint32_t reserved;
  uint64_t bytes;
  uint64_t peak_bytes;
  uint64_t limit_bytes;
} msq_memory_report;

MSQ_API msq_status msq_context_memory(const msq_context* context, msq_memory_report* report);

typedef struct msq_cache_report {
  uint32_t struct_size;
  uint32_t reserved;
  uint64_t hits, misses, evictions;
  uint64_t bytes;
  uint64_t peak_bytes, limit_bytes;
  uint64_t building_bytes;
  uint64_t cells;
  uint64_t duplicates;
  uint64_t unkept;
} msq_cache_report;

MSQ_API msq_status msq_cache_stats(const msq_context* context, msq_cache_report* report);

MSQ_API msq_status msq_cache_clear(msq_context* context);

MSQ_API msq_status msq_job_create(msq_job** job);

MSQ_API void msq_job_retain(msq_job* job);

MSQ_API void msq_job_release(msq_job* job);

MSQ_API msq_status msq_job_cancel(msq_job* job);

MSQ_API msq_status msq_job_progress(const msq_job* job, double* fraction);

typedef struct msq_job_report {
  uint32_t struct_size;
  uint32_t reserved;
  uint64_t points;
  uint64_t by_shape;
  uint64_t by_point;
  uint64_t by_set;
  uint64_t groups;
} msq_job_report;

MSQ_API msq_status msq_job_info(const msq_job* job, msq_job_report* report);

typedef struct msq_window {
  uint64_t first[3];
  uint64_t count[3];
} msq_window;

typedef int32_t (*msq_values_fn)(void* user, const double* points, uint64_t count, double* values);

typedef int32_t (*msq_range_fn)(void* user, const double min[3], const double max[3], double* low,
                                double* high);

typedef struct msq_shape msq_shape;

enum msq_winding {
  MSQ_WINDING_NONZERO = 0,
  MSQ_WINDING_EVEN_ODD = 1,
  MSQ_WINDING_POSITIVE = 2,
  MSQ_WINDING_AUTO = 3
};

enum msq_number_type {
  MSQ_FLOAT32 = 1,
  MSQ_FLOAT64 = 2,
  MSQ_UINT8 = 3,
  MSQ_INT16 = 4,
  MSQ_UINT16 = 5,
  MSQ_INT32 = 6,
  MSQ_INT64 = 7
};

enum msq_format {
  MSQ_FORMAT_AUTO = 0,
  MSQ_FORMAT_STL = 1,
  MSQ_FORMAT_OBJ = 2,
  MSQ_FORMAT_PLY = 3,
  MSQ_FORMAT_OFF = 4,
  MSQ_FORMAT_3MF = 5,
  MSQ_FORMAT_AMF = 6,
  MSQ_FORMAT_GLTF = 7
};

typedef struct msq_neighbourhood {
  double origin[3];
  double cell_size[3];
  double rotation[9];
} msq_neighbourhood;

MSQ_API msq_status msq_neighbourhood_placed(const msq_neighbourhood* grid, const double matrix[12],
                                            msq_neighbourhood* placed);

typedef struct msq_period_def {
  uint32_t struct_size;
  int32_t axis;
  const double* positions;
  const double* cell_sizes;
  uint64_t count;
} msq_period_def;

MSQ_API msq_status msq_period_def_init(msq_period_def* def, size_t size);

typedef struct msq_image {
  const void* values;
  int32_t value_type;
  uint32_t reserved;
  uint64_t size[3];
  uint64_t row_stride;
  uint64_t layer_stride;
  msq_neighbourhood grid;
} msq_image;

typedef struct msq_file_def {
  uint32_t struct_size;
  int32_t format;
  int32_t winding_rule;
  uint32_t reserved;
  double unit_mm;
  uint64_t max_bytes;
  uint64_t max_triangles;
} msq_file_def;

MSQ_API msq_status msq_file_def_init(msq_file_def* def, size_t size);

MSQ_API msq_status msq_shape_from_file(msq_context* context, const char* path,
                                       const msq_file_def* def, msq_shape** shape, msq_job* job);

MSQ_API msq_status msq_shape_from_memory(msq_context* context, const void* data, uint64_t bytes,
                                         const msq_file_def* def, msq_shape** shape, msq_job* job);

typedef struct msq_mesh_def {
  uint32_t struct_size;
  int32_t coordinate_type;
  int32_t winding_rule;
  uint32_t reserved;
  const void* vertices;
  uint64_t vertex_count;
  uint64_t vertex_stride;
  const uint32_t* triangles;
  uint64_t triangle_count;
} msq_mesh_def;

MSQ_API msq_status msq_mesh_def_init(msq_mesh_def* def, size_t size);

MSQ_API msq_status msq_shape_from_mesh(msq_context* context, const msq_mesh_def* def,
                                       msq_shape** shape);

MSQ_API msq_status msq_shape_from_box(msq_context* context, const double min[3],
                                      const double max[3], msq_shape** shape);

MSQ_API msq_status msq_shape_from_sphere(msq_context* context, const double center[3],
                                         double radius, msq_shape** shape);

MSQ_API msq_status msq_shape_from_cylinder(msq_context* context, const double from[3],
                                           const double to[3], double radius, msq_shape** shape);

MSQ_API msq_status msq_shape_all_space(msq_context* context, msq_shape** shape);

typedef int32_t (*msq_inside_fn)(void* user, const double* points, uint64_t count, uint8_t* inside);

typedef struct msq_host_shape_def {
  uint32_t struct_size;
  int32_t concurrent;
  msq_inside_fn inside;
  msq_values_fn distance;
  void* user;
  msq_release_fn release;
  double min[3], max[3];
  uint64_t hash_key[2];
} msq_host_shape_def;

MSQ_API msq_status msq_host_shape_def_init(msq_host_shape_def* def, size_t size);

MSQ_API msq_status msq_shape_from_host(msq_context* context, const msq_host_shape_def* def,
                                       msq_shape** shape);

enum msq_solid_side { MSQ_SOLID_ABOVE = 0, MSQ_SOLID_BELOW = 1 };

typedef struct msq_voxels_def {
  uint32_t struct_size;
  int32_t solid;
  msq_image image;
  double threshold;
} msq_voxels_def;

MSQ_API msq_status msq_voxels_def_init(msq_voxels_def* def, size_t size);

MSQ_API msq_status msq_shape_from_voxels(msq_context* context, const msq_voxels_def* def,
                                         msq_shape** shape);

MSQ_API msq_status msq_shape_placed(const msq_shape* original, const double matrix[12],
                                    msq_shape** shape);

enum msq_boolean_operation {
  MSQ_BOOLEAN_UNION = 1,
  MSQ_BOOLEAN_INTERSECTION = 2,
  MSQ_BOOLEAN_DIFFERENCE = 3
};

MSQ_API msq_status msq_shape_boolean(int32_t operation, const msq_shape* const* shapes,
                                     uint64_t count, msq_shape** shape);

MSQ_API msq_status msq_shape_offset(const msq_shape* original, double distance, msq_shape** shape);

MSQ_API void msq_shape_retain(msq_shape* shape);

MSQ_API void msq_shape_release(msq_shape* shape);

typedef struct msq_shape_report {
  uint32_t struct_size;
  int32_t is_mesh;
  double min[3];
  double max[3];
  double volume;
  double area;
  uint64_t vertices;
  uint64_t triangles;
  uint64_t degenerate_triangles;
  uint64_t duplicate_triangles;
  uint64_t open_edges;
  uint64_t non_manifold_edges;
  uint64_t flipped_edges;
  int32_t closed;
  int32_t reserved;
} msq_shape_report;

MSQ_API msq_status msq_shape_info(const msq_shape* shape, msq_shape_report* report);

MSQ_API msq_status msq_shape_hash(const msq_shape* shape, uint8_t hash[16]);

MSQ_API msq_status msq_shape_self_intersections(const msq_shape* shape, uint64_t* pairs,
                                                msq_job* job);

typedef struct msq_field msq_field;

MSQ_API msq_status msq_field_gradient(msq_context* context, const double from[3], double from_value,
                                      const double to[3], double to_value, msq_field** field);

typedef struct msq_radial_field_def {
  uint32_t struct_size;
  uint32_t reserved;
  double center[3];
  double axis[3];
  double from_radius;
  double from_value;
  double to_radius;
  double to_value;
} msq_radial_field_def;

MSQ_API msq_status msq_radial_field_def_init(msq_radial_field_def* def, size_t size);

MSQ_API msq_status msq_field_radial(msq_context* context, const msq_radial_field_def* def,
                                    msq_field** field);

MSQ_API msq_status msq_field_map(msq_context* context, const msq_field* argument,
                                 const double* curve, uint64_t curve_count, msq_field** field);

typedef struct msq_host_field_def {
  uint32_t struct_size;
  int32_t concurrent;
  msq_values_fn evaluate;
  msq_range_fn range;
  void* user;
  msq_release_fn release;
  double low, high;
  double lipschitz;
  uint64_t hash_key[2];
} msq_host_field_def;

MSQ_API msq_status msq_host_field_def_init(msq_host_field_def* def, size_t size);

MSQ_API msq_status msq_field_host(msq_context* context, const msq_host_field_def* def,
                                  msq_field** field);

typedef struct msq_grid_field_def {
  uint32_t struct_size;
  uint32_t reserved;
  msq_image image;
} msq_grid_field_def;

MSQ_API msq_status msq_grid_field_def_init(msq_grid_field_def* def, size_t size);

MSQ_API msq_status msq_field_grid(msq_context* context, const msq_grid_field_def* def,
                                  msq_field** field);

typedef struct msq_named_value {
  const char* name;
  double value;
} msq_named_value;

typedef struct msq_expression_field_def {
  uint32_t struct_size;
  uint32_t reserved;
  const char* expression;
  const msq_named_value* parameters;
  uint64_t parameter_count;
  double low, high;
} msq_expression_field_def;

MSQ_API msq_status msq_expression_field_def_init(msq_expression_field_def* def, size_t size);

MSQ_API msq_status msq_field_expression(msq_context* context, const msq_expression_field_def* def,
                                        msq_field** field);

typedef struct msq_shape_distance_field_def {
  uint32_t struct_size;
  uint32_t reserved;
  const msq_shape* shape;
  const double* curve;
  uint64_t curve_count;
  double step;
} msq_shape_distance_field_def;

MSQ_API msq_status msq_shape_distance_field_def_init(msq_shape_distance_field_def* def,
                                                     size_t size);

MSQ_API msq_status msq_field_shape_distance(msq_context* context,
                                            const msq_shape_distance_field_def* def,
                                            msq_field** field, msq_job* job);

MSQ_API msq_status msq_field_hash(const msq_field* field, uint8_t hash[16]);

MSQ_API void msq_field_retain(msq_field* field);

MSQ_API void msq_field_release(msq_field* field);

typedef struct msq_param {
  double value;
  const msq_field* field;
} msq_param;

typedef struct msq_structure msq_structure;

enum msq_unit_cell {
  MSQ_UNIT_CELL_CUSTOM = 0,
  MSQ_UNIT_CELL_CUBIC = 1,
  MSQ_UNIT_CELL_BCC = 2,
  MSQ_UNIT_CELL_OCTET = 3,
  MSQ_UNIT_CELL_FCC = 4,
  MSQ_UNIT_CELL_KELVIN = 5,
  MSQ_UNIT_CELL_DIAMOND = 6,
  MSQ_UNIT_CELL_RHOMBIC_DODECAHEDRON = 7,
  MSQ_UNIT_CELL_REENTRANT = 8
};

typedef struct msq_unit_cell_def {
  uint32_t struct_size;
  int32_t unit_cell;
  const double* nodes;
  uint64_t node_count;
  const uint32_t* struts;
  uint64_t strut_count;
  const double* strut_factors;
} msq_unit_cell_def;

MSQ_API msq_status msq_unit_cell_def_init(msq_unit_cell_def* def, size_t size);

typedef struct msq_unit_cell_report {
  uint32_t struct_size;
  int32_t is_periodic;
  uint64_t node_count;
  uint64_t strut_count;
  uint64_t tiled_strut_count;
  double tiled_length;
  uint64_t low_nodes[3];
  uint64_t high_nodes[3];
  uint64_t unmatched_nodes[3];
  uint64_t unmatched_count;
} msq_unit_cell_report;

MSQ_API msq_status msq_unit_cell_info(const msq_unit_cell_def* cell, msq_unit_cell_report* report,
                                      uint32_t* unmatched, uint64_t unmatched_room);

MSQ_API msq_status msq_unit_cell_geometry(const msq_unit_cell_def* cell, double* nodes,
                                          uint64_t node_count, uint32_t* struts,
                                          uint64_t strut_count);

typedef struct msq_lattice_def {
  uint32_t struct_size;
  int32_t unit_cell;
  msq_neighbourhood grid;
  msq_param radius;
  const double* nodes;
  uint64_t node_count;
  const uint32_t* struts;
  uint64_t strut_count;
  const double* strut_factors;
  const msq_unit_cell_def* cells;
  uint32_t cell_count;
  uint32_t clusters;
  msq_param cell_choice;
} msq_lattice_def;

MSQ_API msq_status msq_lattice_def_init(msq_lattice_def* def, size_t size);

MSQ_API msq_status msq_structure_lattice(msq_context* context, const msq_lattice_def* def,
                                         msq_structure** structure);

typedef struct msq_lattice_faces_report {
  uint32_t struct_size;
  int32_t axis;
  uint64_t cells;
  uint64_t faces;
  uint64_t unmatched;
  int32_t cell[3];
  uint32_t reserved;
  uint32_t types[2];
  double point[3];
} msq_lattice_faces_report;

MSQ_API msq_status msq_lattice_faces(const msq_structure* lattice, const double min[3],
                                     const double max[3], msq_lattice_faces_report* report,
                                     msq_job* job);

enum msq_foam_method {
  MSQ_FOAM_AUTO = 0,
  MSQ_FOAM_POINT = 1,
  MSQ_FOAM_METHOD_2 = 2,
  MSQ_FOAM_DIRECT = 3,
  MSQ_FOAM_METHOD_1 = 4
};

typedef struct msq_foam_def {
  uint32_t struct_size;
  int32_t method;
  msq_neighbourhood grid;
  msq_param radius;
  double jitter;
  uint64_t seed;
  msq_param density;
  msq_param wall_thickness;
  msq_param vent_radius;
} msq_foam_def;

MSQ_API msq_status msq_foam_def_init(msq_foam_def* def, size_t size);

MSQ_API msq_status msq_structure_foam(msq_context* context, const msq_foam_def* def,
                                      msq_structure** structure);

enum msq_function {
  MSQ_FUNCTION_EXPRESSION = 0,
  MSQ_FUNCTION_GYROID = 1,
  MSQ_FUNCTION_SCHWARZ_P = 2,
  MSQ_FUNCTION_DIAMOND = 3,
  MSQ_FUNCTION_I_WP = 4,
  MSQ_FUNCTION_NEOVIUS = 5,
  MSQ_FUNCTION_F_RD = 6,
  MSQ_FUNCTION_LIDINOID = 7,
  MSQ_FUNCTION_SPLIT_P = 8,
  MSQ_FUNCTION_FISCHER_KOCH_S = 9,
  MSQ_FUNCTION_C_Y = 10,
  MSQ_FUNCTION_C_PLUS_MINUS_Y = 11,
  MSQ_FUNCTION_KARCHER_K = 12,
  MSQ_FUNCTION_G_PRIME = 13,
  MSQ_FUNCTION_DOUBLE_GYROID = 14,
  MSQ_FUNCTION_DOUBLE_DIAMOND = 15,
  MSQ_FUNCTION_DOUBLE_P = 16,
  MSQ_FUNCTION_HONEYCOMB = 17,
  MSQ_FUNCTION_RODS = 18
};

enum msq_functional_kind {
  MSQ_FUNCTIONAL_NETWORK = 1,
  MSQ_FUNCTIONAL_SHEET = 2
};

typedef struct msq_functional_def {
  uint32_t struct_size;
  int32_t function;
  int32_t kind;
  uint32_t clusters;
  msq_neighbourhood grid;
  msq_param level;
  const char* expression;
  const msq_named_value* parameters;
  uint64_t parameter_count;
  msq_param thickness;
  const msq_period_def* period;
} msq_functional_def;

MSQ_API msq_status msq_functional_def_init(msq_functional_def* def, size_t size);

MSQ_API msq_status msq_structure_functional(msq_context* context, const msq_functional_def* def,
                                            msq_structure** structure);

enum msq_cap {
  MSQ_CAP_SPHERE = 0,
  MSQ_CAP_HEMISPHERE = 1,
  MSQ_CAP_BUTT = 2
};

typedef struct msq_beams_def {
  uint32_t struct_size;
  int32_t cap;
  int32_t coordinate_type;
  uint32_t reserved;
  const void* nodes;
  uint64_t node_count;
  uint64_t node_stride;
  const uint32_t* beams;
  uint64_t beam_count;
  uint64_t beam_stride;
  const void* radii;
  uint64_t radius_stride;
  const uint8_t* caps;
  uint64_t cap_stride;
  const uint32_t* balls;
  uint64_t ball_count;
  uint64_t ball_stride;
  const void* ball_radii;
  uint64_t ball_radius_stride;
  double radius;
  double ball_radius;
  double min_length;
  double length_scale;
} msq_beams_def;

MSQ_API msq_status msq_beams_def_init(msq_beams_def* def, size_t size);

MSQ_API msq_status msq_structure_beams(msq_context* context, const msq_beams_def* def,
                                       msq_structure** structure, msq_job* job);

typedef struct msq_beam_file msq_beam_file;

MSQ_API msq_status msq_beam_file_open(msq_context* context, const char* path,
                                      const msq_file_def* def, msq_beam_file** file, msq_job* job);

MSQ_API msq_status msq_beam_file_open_memory(msq_context* context, const void* data, uint64_t bytes,
                                             const msq_file_def* def, msq_beam_file** file,
                                             msq_job* job);

MSQ_API void msq_beam_file_retain(msq_beam_file* file);

MSQ_API void msq_beam_file_release(msq_beam_file* file);

enum msq_clipping {
  MSQ_CLIPPING_NONE = 0,
  MSQ_CLIPPING_INSIDE = 1,
  MSQ_CLIPPING_OUTSIDE = 2
};

typedef struct msq_beam_file_report {
  uint32_t struct_size;
  int32_t clipping;
  uint64_t lattice_count;
  uint64_t mesh_triangle_count;
  uint64_t node_count;
  uint64_t beam_count;
  uint64_t ball_count;
  uint64_t clipping_triangle_count;
  double min[3];
  double max[3];
} msq_beam_file_report;

MSQ_API msq_status msq_beam_file_info(const msq_beam_file* file, uint64_t lattice,
                                      msq_beam_file_report* report);

MSQ_API msq_status msq_beam_file_beams(const msq_beam_file* file, uint64_t lattice,
                                       msq_beams_def* def);

enum msq_beam_file_mesh {
  MSQ_BEAM_FILE_SOLID = 0,
  MSQ_BEAM_FILE_CLIPPING = 1
};

MSQ_API msq_status msq_beam_file_shape(msq_context* context, const msq_beam_file* file,
                                       uint64_t lattice, int32_t mesh, int32_t winding_rule,
                                       msq_shape** shape);

typedef struct msq_host_points {
  uint32_t struct_size;
  uint32_t reserved;
  uint64_t count;
  const double* points;
  const double* positions;
  const int32_t* cells;
} msq_host_points;

typedef int32_t (*msq_points_inside_fn)(void* user, const msq_host_points* points, uint8_t* inside);

typedef int32_t (*msq_points_distance_fn)(void* user, const msq_host_points* points,
                                          double* distances);

typedef int32_t (*msq_build_cell_fn)(void* user, const int32_t cell[3], void** data,
                                     uint64_t* bytes);

typedef int32_t (*msq_evaluate_cell_fn)(void* user, const void* data, const msq_host_points* points,
                                        uint8_t* inside);

typedef void (*msq_free_cell_fn)(void* user, void* data);

enum msq_box_answer {
  MSQ_BOX_MIXED = 0,
  MSQ_BOX_OUTSIDE = 1,
  MSQ_BOX_INSIDE = 2
};

typedef int32_t (*msq_box_fn)(void* user, const double min[3], const double max[3],
                              int32_t* answer);

typedef struct msq_host_structure_def {
  uint32_t struct_size;
  int32_t concurrent;
  msq_neighbourhood grid;
  msq_points_inside_fn inside;
  msq_build_cell_fn build_cell;
  msq_evaluate_cell_fn evaluate_cell;
  msq_free_cell_fn free_cell;
  msq_box_fn box;
  msq_points_distance_fn distance;
  void* user;
  msq_release_fn release;
  uint64_t hash_key[2];
} msq_host_structure_def;

MSQ_API msq_status msq_host_structure_def_init(msq_host_structure_def* def, size_t size);

MSQ_API msq_status msq_structure_host(msq_context* context, const msq_host_structure_def* def,
                                      msq_structure** structure);

typedef struct msq_host_function_def {
  uint32_t struct_size;
  int32_t concurrent;
  int32_t kind;
  uint32_t clusters;
  msq_neighbourhood grid;
  msq_param level;
  msq_values_fn evaluate;
  msq_range_fn range;
  void* user;
  msq_release_fn release;
  double lipschitz;
  uint64_t hash_key[2];
} msq_host_function_def;

MSQ_API msq_status msq_host_function_def_init(msq_host_function_def* def, size_t size);

MSQ_API msq_status msq_structure_host_function(msq_context* context,
                                               const msq_host_function_def* def,
                                               msq_structure** structure);

MSQ_API msq_status msq_structure_hash(const msq_structure* structure, uint8_t hash[16]);

MSQ_API void msq_structure_retain(msq_structure* structure);

MSQ_API void msq_structure_release(msq_structure* structure);

enum msq_struts_selection {
  MSQ_STRUTS_OWNED = 0,
  MSQ_STRUTS_NEAR = 1
};

typedef struct msq_strut {
  uint64_t id[2];
  uint64_t node_a[2];
  uint64_t node_b[2];
  double a[3];
  double b[3];
  double radii[2];
  int32_t cell[3];
  uint8_t caps[2];
  uint8_t cut[2];
} msq_strut;

typedef int32_t (*msq_struts_fn)(void* user, const msq_strut* struts, uint64_t count);

typedef struct msq_struts_def {
  uint32_t struct_size;
  int32_t selection;
  double min[3];
  double max[3];
  const msq_shape* shape;
} msq_struts_def;

MSQ_API msq_status msq_struts_def_init(msq_struts_def* def, size_t size);

MSQ_API msq_status msq_structure_struts(msq_context* context, const msq_structure* structure,
                                        const msq_struts_def* def, msq_struts_fn callback,
                                        void* user, msq_job* job);

typedef struct msq_strut_graph msq_strut_graph;

MSQ_API msq_status msq_structure_strut_graph(msq_context* context, const msq_structure* structure,
                                             const msq_struts_def* def, msq_strut_graph** graph,
                                             msq_job* job);

MSQ_API void msq_strut_graph_retain(msq_strut_graph* graph);

MSQ_API void msq_strut_graph_release(msq_strut_graph* graph);

typedef struct msq_strut_graph_report {
  uint32_t struct_size;
  uint32_t reserved;
  uint64_t node_count;
  uint64_t strut_count;
  const double* nodes;
  const uint64_t* node_ids;
  const uint32_t* struts;
  const double* radii;
  const uint64_t* strut_ids;
  const int32_t* cells;
  const uint8_t* caps;
  const uint8_t* cuts;
} msq_strut_graph_report;

MSQ_API msq_status msq_strut_graph_info(const msq_strut_graph* graph,
                                        msq_strut_graph_report* report);

typedef struct msq_material msq_material;

enum msq_material_id { MSQ_MATERIAL_VOID = 0 };

typedef struct msq_channel {
  const char* name;
  msq_param value;
} msq_channel;

typedef struct msq_material_def {
  uint32_t struct_size;
  uint32_t id;
  const msq_channel* channels;
  uint64_t channel_count;
} msq_material_def;

MSQ_API msq_status msq_material_def_init(msq_material_def* def, size_t size);

MSQ_API msq_status msq_material_create(msq_context* context, const msq_material_def* def,
                                       msq_material** material);

MSQ_API msq_status msq_material_blend(msq_context* context, uint32_t id, const msq_material* a,
                                      const msq_material* b, const msq_param* fraction,
                                      msq_material** material);

MSQ_API msq_status msq_material_hash(const msq_material* material, uint8_t hash[16]);

MSQ_API void msq_material_retain(msq_material* material);

MSQ_API void msq_material_release(msq_material* material);

typedef struct msq_model msq_model;

typedef struct msq_scale_def {
  const msq_shape* shape;
  const msq_structure* structure;
  msq_param skin;
  const msq_material* material;
  const msq_material* skin_material;
} msq_scale_def;

typedef struct msq_model_def {
  uint32_t struct_size;
  uint32_t scale_count;
  const msq_scale_def* scales;
  uint32_t scale_size;
  uint32_t reserved;
} msq_model_def;

MSQ_API msq_status msq_model_def_init(msq_model_def* def, size_t size);

MSQ_API msq_status msq_model_create(msq_context* context, const msq_model_def* def,
                                    msq_model** model);

MSQ_API msq_status msq_model_regions(msq_context* context, const msq_model* const* regions,
                                     uint64_t count, msq_model** model);

MSQ_API msq_status msq_model_hash(const msq_model* model, uint8_t hash[16]);

MSQ_API void msq_model_retain(msq_model* model);

MSQ_API void msq_model_release(msq_model* model);

MSQ_API msq_status msq_model_bounds(const msq_model* model, double min[3], double max[3]);

MSQ_API msq_status msq_model_scale_length(const msq_model* model, uint32_t scale, double* length);

MSQ_API msq_status msq_model_scale(const msq_model* model, uint32_t region, uint32_t scale,
                                   msq_shape** shape, msq_structure** structure);

enum msq_query_method {
  MSQ_QUERY_AUTO = 0,
  MSQ_QUERY_POINT = 1,
  MSQ_QUERY_SET = 2
};

typedef struct msq_query_def {
  uint32_t struct_size;
  int32_t method;
  double length_scale;
  uint64_t critical_count;
  uint32_t group_parts;
  uint32_t reserved;
} msq_query_def;

MSQ_API msq_status msq_query_def_init(msq_query_def* def, size_t size);

enum msq_points_kind { MSQ_POINTS_ARRAY = 1, MSQ_POINTS_GRID = 2, MSQ_POINTS_STRATIFIED = 3 };

typedef struct msq_points_def {
  uint32_t struct_size;
  int32_t kind;
  const void* coordinates;
  uint64_t count;
  uint64_t stride;
  int32_t coordinate_type;
  uint32_t reserved;
  double origin[3];
  double spacing[3];
  uint64_t counts[3];
  uint64_t seed;
  uint32_t per_cell;
  uint32_t reserved2;
  double rotation[9];
  msq_window window;
} msq_points_def;

MSQ_API msq_status msq_points_def_init(msq_points_def* def, size_t size);

MSQ_API msq_status msq_points_generate(const msq_points_def* points, uint64_t first, uint64_t count,
                                       double* coordinates);

MSQ_API msq_status msq_point_membership(const msq_model* model, const double point[3],
                                        const msq_query_def* query, int32_t* inside);

MSQ_API msq_status msq_set_membership(const msq_model* model, const msq_points_def* points,
                                      const msq_query_def* query, uint8_t* inside,
                                      uint64_t inside_count, msq_job* job);

MSQ_API msq_status msq_point_region(const msq_model* model, const double point[3], int32_t* region);

MSQ_API msq_status msq_set_region(const msq_model* model, const msq_points_def* points,
                                  int32_t* regions, uint64_t region_count, msq_job* job);

MSQ_API msq_status msq_point_material(const msq_model* model, const double point[3],
                                      const msq_query_def* query, const char* const* channels,
                                      uint64_t channel_count, uint32_t* id, double* values);

MSQ_API msq_status msq_set_material(const msq_model* model, const msq_points_def* points,
                                    const msq_query_def* query, const char* const* channels,
                                    uint64_t channel_count, uint32_t* ids, uint64_t id_count,
                                    double* values, uint64_t value_count, msq_job* job);

MSQ_API msq_status msq_point_distance(const msq_model* model, const double point[3],
                                      const msq_query_def* query, double* distance);

MSQ_API msq_status msq_set_distance(const msq_model* model, const msq_points_def* points,
                                    const msq_query_def* query, double* distance,
                                    uint64_t distance_count, msq_job* job);

enum msq_onset_value {
  MSQ_ONSET_PLAIN = 0,
  MSQ_ONSET_SIGNED = 1
};

MSQ_API msq_status msq_set_onset(msq_context* context, const msq_structure* structure,
                                 const msq_points_def* points, int32_t value, double* onsets,
                                 uint64_t onset_count, double* gradients, uint64_t gradient_count,
                                 msq_job* job);

MSQ_API msq_status msq_field_evaluate(msq_context* context, const msq_field* field,
                                      const msq_points_def* points, double* values,
                                      uint64_t value_count, msq_job* job);

typedef struct msq_estimate {
  double value;
  double standard_error;
  double low, high;
} msq_estimate;

enum msq_phase { MSQ_PHASE_SOLID = 1, MSQ_PHASE_VOID = 2 };

MSQ_API msq_status msq_volume_fraction(const msq_model* model, const msq_points_def* sample,
                                       const msq_query_def* query, int32_t phase,
                                       msq_estimate* estimate, msq_job* job);

typedef struct msq_segments_def {
  uint32_t struct_size;
  int32_t phase;
  double direction[3];
  const double* lengths;
  uint64_t length_count;
  double step;
} msq_segments_def;

MSQ_API msq_status msq_segments_def_init(msq_segments_def* def, size_t size);

MSQ_API msq_status msq_two_point_correlation(const msq_model* model, const msq_points_def* sample,
                                             const msq_query_def* query,
                                             const msq_segments_def* def, msq_estimate* estimates,
                                             uint64_t estimate_count, msq_job* job);

MSQ_API msq_status msq_lineal_path(const msq_model* model, const msq_points_def* sample,
                                   const msq_query_def* query, const msq_segments_def* def,
                                   msq_estimate* estimates, uint64_t estimate_count, msq_job* job);

typedef struct msq_calibration_report {
  uint32_t struct_size;
  uint32_t reserved;
  uint64_t samples;
  double parameter;
  msq_estimate fraction;
  double max_fraction;
} msq_calibration_report;

MSQ_API msq_status msq_structure_calibrate(msq_context* context, const msq_structure* structure,
                                           const msq_points_def* sample, double target,
                                           double* parameters, double* fractions,
                                           uint64_t pair_count, msq_calibration_report* report,
                                           msq_job* job);

typedef struct msq_slicer msq_slicer;

enum msq_layer_output {
  MSQ_LAYER_BITS = 1,
  MSQ_LAYER_BYTES = 2,
  MSQ_LAYER_GREY = 3,
  MSQ_LAYER_DISTANCE = 4,
  MSQ_LAYER_MATERIAL = 5,
  MSQ_LAYER_ONSET = 6,
  MSQ_LAYER_CONTOURS = 7,
  MSQ_LAYER_CHANNEL = 8
};

enum msq_layer_orientation {
  MSQ_LAYER_MIRROR_X = 1,
  MSQ_LAYER_MIRROR_Y = 2,
  MSQ_LAYER_TRANSPOSE = 4
};

typedef struct msq_contours msq_contours;

typedef struct msq_contours_def {
  uint32_t struct_size;
  int32_t type;
  int32_t axis;
  int32_t has_window;
  double window_min[2];
  double window_max[2];
  double tolerance;
  double pitch;
  double units;
  double length_scale;
} msq_contours_def;

MSQ_API msq_status msq_contours_def_init(msq_contours_def* def, size_t size);

typedef struct msq_output_def {
  uint32_t struct_size;
  int32_t output;
  uint32_t grey_samples;
  uint32_t grey_threshold;
  double grey_gamma;
  uint32_t onset_scale;
  int32_t onset_value;
  const msq_contours_def* contours;
  const char* channel;
} msq_output_def;

MSQ_API msq_status msq_output_def_init(msq_output_def* def, size_t size);

typedef struct msq_slicer_def {
  uint32_t struct_size;
  int32_t output;
  double pitch[2];
  uint32_t resolution[2];
  double layer_height;
  uint64_t layer_count;
  int32_t has_region;
  uint32_t slab_layers;
  double region_min[3];
  double region_max[3];
  const double* layer_z;
  uint64_t layer_z_count;
  double length_scale;
  msq_window window;
  uint32_t grey_samples;
  uint32_t grey_threshold;
  double grey_gamma;
  uint32_t orientation;
  uint32_t output_count;
  const msq_output_def* outputs;
  double frame_origin[3];
  double frame_axes[9];
} msq_slicer_def;

MSQ_API msq_status msq_slicer_def_init(msq_slicer_def* def, size_t size);

MSQ_API msq_status msq_slicer_create(const msq_model* model, const msq_slicer_def* def,
                                     msq_slicer** slicer);

MSQ_API void msq_slicer_retain(msq_slicer* slicer);

MSQ_API void msq_slicer_release(msq_slicer* slicer);

typedef struct msq_slicer_report {
  uint32_t struct_size;
  uint32_t slab_layers;
  uint32_t width, height;
  uint64_t layer_count;
  uint64_t stride;
  uint64_t layer_bytes;
  double origin[2];
  double pitch[2];
  msq_window window;
  uint64_t whole[3];
} msq_slicer_report;

MSQ_API msq_status msq_slicer_info(const msq_slicer* slicer, msq_slicer_report* report);

MSQ_API msq_status msq_slicer_layer_z(const msq_slicer* slicer, uint64_t index, double* z);

typedef struct msq_output {
  uint32_t struct_size;
  int32_t output;
  const uint8_t* data;
  uint64_t stride;
  uint64_t inside_count;
  msq_contours* contours;
} msq_output;

typedef struct msq_layer {
  uint32_t struct_size;
  int32_t output;
  uint64_t index;
  double z;
  const uint8_t* data;
  uint64_t stride;
  uint32_t width, height;
  uint64_t inside_count;
  uint64_t output_count;
  const msq_output* const* outputs;
} msq_layer;

typedef int32_t (*msq_layer_fn)(void* user, const msq_layer* layer);

MSQ_API msq_status msq_slicer_run(const msq_slicer* slicer, uint64_t first, uint64_t count,
                                  msq_layer_fn fn, void* user, msq_job* job);

MSQ_API msq_status msq_slice_layer(const msq_slicer* slicer, uint64_t index, uint8_t* buffer,
                                   uint64_t buffer_bytes, msq_job* job);

MSQ_API msq_status msq_layer_contours(const msq_model* model, double height,
                                      const msq_contours_def* def, msq_contours** contours,
                                      msq_job* job);

MSQ_API msq_status msq_slicer_contours(const msq_slicer* slicer, uint64_t index,
                                       const msq_contours_def* def, msq_contours** contours,
                                       msq_job* job);

MSQ_API void msq_contours_retain(msq_contours* contours);

MSQ_API void msq_contours_release(msq_contours* contours);

typedef struct msq_contours_report {
  uint32_t struct_size;
  int32_t type;
  uint64_t ring_count;
  uint64_t point_count;
  const void* points;
  const uint64_t* starts;
  const int64_t* parents;
  const uint8_t* holes;
  uint64_t unresolved_count;
  double pitch;
} msq_contours_report;

MSQ_API msq_status msq_contours_info(const msq_contours* contours, msq_contours_report* report);

enum msq_finding_kind {
  MSQ_FINDING_ISLAND = 1,
  MSQ_FINDING_LOOSE = 2,
  MSQ_FINDING_VOID = 4,
  MSQ_FINDING_THIN = 8,
  MSQ_FINDING_CUP = 16,
  MSQ_FINDING_OVERHANG = 32
};

typedef struct msq_printability_def {
  uint32_t struct_size;
  uint32_t kinds;
  int32_t has_plate;
  uint32_t reserved;
  double width;
  double min_volume;
  double overhang;
} msq_printability_def;

MSQ_API msq_status msq_printability_def_init(msq_printability_def* def, size_t size);

typedef struct msq_finding {
  int32_t kind;
  uint32_t reserved;
  uint64_t first_layer;
  uint64_t last_layer;
  uint64_t sample_count;
  double volume;
  double point[3];
  double min[3], max[3];
} msq_finding;

typedef int32_t (*msq_findings_fn)(void* user, const msq_finding* findings, uint64_t count);

typedef struct msq_printability_report {
  uint32_t struct_size;
  uint32_t reserved;
  uint64_t layer_count;
  uint64_t solid_count;
  double solid_volume;
  uint64_t island_count, loose_count, void_count, thin_count;
  double island_volume, loose_volume, void_volume, thin_volume;
  uint64_t cup_count, overhang_count;
  double cup_volume, overhang_volume;
} msq_printability_report;

MSQ_API msq_status msq_printability(const msq_slicer* slicer, const msq_printability_def* def,
                                    msq_findings_fn fn, void* user, msq_printability_report* report,
                                    msq_job* job);

typedef struct msq_fill msq_fill;

typedef struct msq_ring {
  const void* points;
  uint64_t count;
} msq_ring;

typedef struct msq_fill_def {
  uint32_t struct_size;
  int32_t coordinate_type;
  const msq_ring* rings;
  uint64_t ring_count;
  uint64_t point_stride;
  double scale;
  double origin[2];
  double z;
  double tolerance;
  double min_length;
  double pair_distance;
} msq_fill_def;

MSQ_API msq_status msq_fill_def_init(msq_fill_def* def, size_t size);

MSQ_API msq_status msq_fill_lines(msq_context* context, const msq_structure* structure,
                                  const msq_fill_def* def, msq_fill** fill, msq_job* job);

MSQ_API void msq_fill_retain(msq_fill* fill);

MSQ_API void msq_fill_release(msq_fill* fill);

typedef struct msq_fill_report {
  uint32_t struct_size;
  int32_t coordinate_type;
  const void* points;
  uint64_t point_count;
  const uint64_t* path_starts;
  const uint8_t* closed;
  uint64_t path_count;
  double length;
  double travel;
} msq_fill_report;

MSQ_API msq_status msq_fill_info(const msq_fill* fill, msq_fill_report* report);

MSQ_API msq_status msq_fill_calibrate(msq_context* context, const msq_structure* structure,
                                      double line_width, double density, double cell_size[3],
                                      msq_job* job);

typedef struct msq_surface_def {
  uint32_t struct_size;
  int32_t has_box;
  double min[3];
  double max[3];
  double pitch;
  double length_scale;
  uint32_t slab_layers;
  uint32_t reserved;
} msq_surface_def;

MSQ_API msq_status msq_surface_def_init(msq_surface_def* def, size_t size);

typedef struct msq_surface_slab {
  uint32_t struct_size;
  uint32_t reserved;
  uint64_t first_vertex;
  uint64_t vertex_count;
  const double* vertices;
  const float* normals;
  uint64_t first_triangle;
  uint64_t triangle_count;
  const uint32_t* triangles;
} msq_surface_slab;

typedef int32_t (*msq_surface_fn)(void* user, const msq_surface_slab* slab);

MSQ_API msq_status msq_surface_mesh(const msq_model* model, const msq_surface_def* def,
                                    msq_surface_fn fn, void* user, msq_job* job);

enum msq_surface_format {
  MSQ_SURFACE_STL = 1,
  MSQ_SURFACE_PLY = 2
};

typedef struct msq_file_part {
  uint32_t struct_size;
  uint32_t reserved;
  uint64_t offset;
  uint64_t size;
  uint64_t total;
  const uint8_t* bytes;
} msq_file_part;

typedef int32_t (*msq_file_fn)(void* user, const msq_file_part* part);

MSQ_API msq_status msq_surface_file(const msq_model* model, const msq_surface_def* def,
                                    int32_t format, msq_file_fn fn, void* user, msq_job* job);

typedef struct msq_rays_def {
  uint32_t struct_size;
  int32_t coordinate_type;
  uint64_t count;
  const void* origins;
  const void* directions;
  uint64_t origin_stride;
  uint64_t direction_stride;
  const double* t_min;
  const double* t_max;
} msq_rays_def;

MSQ_API msq_status msq_rays_def_init(msq_rays_def* def, size_t size);

typedef struct msq_ray_hit {
  double t;
  double normal[3];
  int32_t scale;
  int32_t starts_inside;
  int32_t cell[3];
  uint32_t material;
} msq_ray_hit;

MSQ_API msq_status msq_ray_cast(const msq_model* model, const msq_rays_def* rays,
                                const msq_query_def* query, msq_ray_hit* hits, uint64_t hit_count,
                                msq_job* job);

enum msq_projection { MSQ_CAMERA_ORTHOGRAPHIC = 0, MSQ_CAMERA_PERSPECTIVE = 1 };

typedef struct msq_camera {
  uint32_t struct_size;
  int32_t projection;
  double eye[3];
  double target[3];
  double up[3];
  double height;
  double field_of_view;
  double clip_near, clip_far;
} msq_camera;

MSQ_API msq_status msq_camera_init(msq_camera* camera, size_t size);

MSQ_API msq_status msq_camera_fit(const msq_model* model, const double direction[3],
                                  const double up[3], uint32_t width, uint32_t height,
                                  msq_camera* camera);

MSQ_API msq_status msq_camera_ray(const msq_camera* camera, uint32_t width, uint32_t height,
                                  const double position[2], double origin[3], double direction[3]);

enum msq_colour_by {
  MSQ_COLOUR_PLAIN = 0,
  MSQ_COLOUR_SCALE = 1,
  MSQ_COLOUR_MATERIAL = 2,
  MSQ_COLOUR_NORMAL = 3
};

typedef struct msq_render_def {
  uint32_t struct_size;
  uint32_t width, height;
  uint32_t tile_x, tile_y;
  uint32_t tile_width, tile_height;
  uint32_t samples;
  uint32_t first_step;
  int32_t colour_by;
  const double* colours;
  uint64_t colour_count;
  double background[4];
  double light[3];
  double ambient;
  int32_t shadows;
  uint32_t occlusion_rays;
  double occlusion_distance;
} msq_render_def;

MSQ_API msq_status msq_render_def_init(msq_render_def* def, size_t size);

typedef struct msq_frame {
  uint32_t struct_size;
  uint32_t row_pixels;
  float* depth;
  float* normal;
  int32_t* scale;
  uint32_t* material;
  uint8_t* rgba;
} msq_frame;

MSQ_API msq_status msq_frame_init(msq_frame* frame, size_t size);

typedef struct msq_render_pass {
  uint32_t struct_size;
  uint32_t step;
  uint32_t samples;
  int32_t is_last;
} msq_render_pass;

typedef int32_t (*msq_render_fn)(void* user, const msq_render_pass* pass);

MSQ_API msq_status msq_render(const msq_model* model, const msq_camera* camera,
                              const msq_render_def* def, const msq_query_def* query,
                              const msq_frame* frame, msq_render_fn fn, void* user, msq_job* job);

typedef struct msq_document msq_document;

enum msq_document_files {
  MSQ_DOCUMENT_FILES_BELOW = 0,
  MSQ_DOCUMENT_FILES_NONE = 1,
  MSQ_DOCUMENT_FILES_ANY = 2
};

typedef struct msq_document_def {
  uint32_t struct_size;
  int32_t files;
  const char* base_directory;
  uint64_t max_bytes;
  uint64_t max_values;
  uint32_t max_depth;
  uint32_t max_files;
  uint64_t max_file_bytes;
  uint64_t max_triangles;
} msq_document_def;

MSQ_API msq_status msq_document_def_init(msq_document_def* def, size_t size);

MSQ_API msq_status msq_document_from_json(msq_context* context, const char* text, uint64_t bytes,
                                          const msq_document_def* def, msq_document** document,
                                          msq_job* job);

MSQ_API msq_status msq_document_from_file(msq_context* context, const char* path,
                                          const msq_document_def* def, msq_document** document,
                                          msq_job* job);

MSQ_API void msq_document_retain(msq_document* document);

MSQ_API void msq_document_release(msq_document* document);

typedef struct msq_document_report {
  uint32_t struct_size;
  uint32_t version;
  int32_t has_slicing, has_view;
  uint32_t files;
  uint32_t reserved;
  const char* title;
} msq_document_report;

MSQ_API msq_status msq_document_info(const msq_document* document, msq_document_report* report);

MSQ_API msq_status msq_document_model(const msq_document* document, msq_model** model);

MSQ_API msq_status msq_document_slicing(const msq_document* document, msq_slicer_def* def);

MSQ_API msq_status msq_document_view(const msq_document* document, msq_camera* camera,
                                     msq_render_def* render);

typedef struct msq_json_def {
  uint32_t struct_size;
  uint32_t reserved;
  const char* base_directory;
  const char* title;
  const msq_slicer_def* slicing;
  const msq_camera* camera;
  const msq_render_def* render;
  uint64_t max_numbers;
} msq_json_def;

MSQ_API msq_status msq_json_def_init(msq_json_def* def, size_t size);

MSQ_API msq_status msq_model_to_json(const msq_model* model, const msq_json_def* def, char* text,
                                     uint64_t room, uint64_t* bytes);

#ifdef __cplusplus
}
#endif

#endif
