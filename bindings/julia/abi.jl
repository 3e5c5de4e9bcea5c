# SPDX-License-Identifier: Apache-2.0
# The declarations of msq.h. Made from it by bindings/make_bindings.py: change those.

const MSQ_VERSION_MAJOR = 0
const MSQ_VERSION_MINOR = 2
const MSQ_VERSION_PATCH = 0
const MSQ_VERSION = 200
const MSQ_OK = 0
const MSQ_E_ARGUMENT = -1
const MSQ_E_MEMORY = -2
const MSQ_E_CANCELLED = -3
const MSQ_E_HOST = -4
const MSQ_E_IO = -5
const MSQ_E_UNSUPPORTED = -6
const MSQ_E_MESH = -7
const MSQ_E_LIMIT = -8
const MSQ_E_INTERNAL = -9
const MSQ_CACHE_FIFO = 0
const MSQ_CACHE_SEGMENTED = 1
const MSQ_WARNING_OPEN_MESH = 1
const MSQ_WARNING_COARSE_PITCH = 2
const MSQ_WARNING_SMALL_CACHE = 3
const MSQ_WARNING_UNMATCHED_CELLS = 4
const MSQ_WINDING_NONZERO = 0
const MSQ_WINDING_EVEN_ODD = 1
const MSQ_WINDING_POSITIVE = 2
const MSQ_WINDING_AUTO = 3
const MSQ_FLOAT32 = 1
const MSQ_FLOAT64 = 2
const MSQ_UINT8 = 3
const MSQ_INT16 = 4
const MSQ_UINT16 = 5
const MSQ_INT32 = 6
const MSQ_INT64 = 7
const MSQ_FORMAT_AUTO = 0
const MSQ_FORMAT_STL = 1
const MSQ_FORMAT_OBJ = 2
const MSQ_FORMAT_PLY = 3
const MSQ_FORMAT_OFF = 4
const MSQ_FORMAT_3MF = 5
const MSQ_FORMAT_AMF = 6
const MSQ_FORMAT_GLTF = 7
const MSQ_WARP_CYLINDRICAL = 1
const MSQ_WARP_SPHERICAL = 2
const MSQ_WARP_SAMPLED = 3
const MSQ_SOLID_ABOVE = 0
const MSQ_SOLID_BELOW = 1
const MSQ_BOOLEAN_UNION = 1
const MSQ_BOOLEAN_INTERSECTION = 2
const MSQ_BOOLEAN_DIFFERENCE = 3
const MSQ_UNIT_CELL_CUSTOM = 0
const MSQ_UNIT_CELL_CUBIC = 1
const MSQ_UNIT_CELL_BCC = 2
const MSQ_UNIT_CELL_OCTET = 3
const MSQ_UNIT_CELL_FCC = 4
const MSQ_UNIT_CELL_KELVIN = 5
const MSQ_UNIT_CELL_DIAMOND = 6
const MSQ_UNIT_CELL_RHOMBIC_DODECAHEDRON = 7
const MSQ_UNIT_CELL_REENTRANT = 8
const MSQ_PLATE_CELL_CUSTOM = 0
const MSQ_PLATE_CELL_CUBIC = 1
const MSQ_PLATE_CELL_BCC = 2
const MSQ_PLATE_CELL_FCC = 3
const MSQ_PLATE_CELL_CUBIC_OCTET = 4
const MSQ_PLATE_CELL_KELVIN = 5
const MSQ_FOAM_AUTO = 0
const MSQ_FOAM_POINT = 1
const MSQ_FOAM_METHOD_2 = 2
const MSQ_FOAM_DIRECT = 3
const MSQ_FOAM_METHOD_1 = 4
const MSQ_FUNCTION_EXPRESSION = 0
const MSQ_FUNCTION_GYROID = 1
const MSQ_FUNCTION_SCHWARZ_P = 2
const MSQ_FUNCTION_DIAMOND = 3
const MSQ_FUNCTION_I_WP = 4
const MSQ_FUNCTION_NEOVIUS = 5
const MSQ_FUNCTION_F_RD = 6
const MSQ_FUNCTION_LIDINOID = 7
const MSQ_FUNCTION_SPLIT_P = 8
const MSQ_FUNCTION_FISCHER_KOCH_S = 9
const MSQ_FUNCTION_C_Y = 10
const MSQ_FUNCTION_C_PLUS_MINUS_Y = 11
const MSQ_FUNCTION_KARCHER_K = 12
const MSQ_FUNCTION_G_PRIME = 13
const MSQ_FUNCTION_DOUBLE_GYROID = 14
const MSQ_FUNCTION_DOUBLE_DIAMOND = 15
const MSQ_FUNCTION_DOUBLE_P = 16
const MSQ_FUNCTION_HONEYCOMB = 17
const MSQ_FUNCTION_RODS = 18
const MSQ_FUNCTIONAL_NETWORK = 1
const MSQ_FUNCTIONAL_SHEET = 2
const MSQ_CAP_SPHERE = 0
const MSQ_CAP_HEMISPHERE = 1
const MSQ_CAP_BUTT = 2
const MSQ_CLIPPING_NONE = 0
const MSQ_CLIPPING_INSIDE = 1
const MSQ_CLIPPING_OUTSIDE = 2
const MSQ_BEAM_FILE_SOLID = 0
const MSQ_BEAM_FILE_CLIPPING = 1
const MSQ_BOX_MIXED = 0
const MSQ_BOX_OUTSIDE = 1
const MSQ_BOX_INSIDE = 2
const MSQ_STRUTS_OWNED = 0
const MSQ_STRUTS_NEAR = 1
const MSQ_MATERIAL_VOID = 0
const MSQ_QUERY_AUTO = 0
const MSQ_QUERY_POINT = 1
const MSQ_QUERY_SET = 2
const MSQ_POINTS_ARRAY = 1
const MSQ_POINTS_GRID = 2
const MSQ_POINTS_STRATIFIED = 3
const MSQ_ONSET_PLAIN = 0
const MSQ_ONSET_SIGNED = 1
const MSQ_PHASE_SOLID = 1
const MSQ_PHASE_VOID = 2
const MSQ_LAYER_BITS = 1
const MSQ_LAYER_BYTES = 2
const MSQ_LAYER_GREY = 3
const MSQ_LAYER_DISTANCE = 4
const MSQ_LAYER_MATERIAL = 5
const MSQ_LAYER_ONSET = 6
const MSQ_LAYER_CONTOURS = 7
const MSQ_LAYER_CHANNEL = 8
const MSQ_LAYER_MIRROR_X = 1
const MSQ_LAYER_MIRROR_Y = 2
const MSQ_LAYER_TRANSPOSE = 4
const MSQ_FINDING_ISLAND = 1
const MSQ_FINDING_LOOSE = 2
const MSQ_FINDING_VOID = 4
const MSQ_FINDING_THIN = 8
const MSQ_FINDING_CUP = 16
const MSQ_FINDING_OVERHANG = 32
const MSQ_SURFACE_STL = 1
const MSQ_SURFACE_PLY = 2
const MSQ_CAMERA_ORTHOGRAPHIC = 0
const MSQ_CAMERA_PERSPECTIVE = 1
const MSQ_COLOUR_PLAIN = 0
const MSQ_COLOUR_SCALE = 1
const MSQ_COLOUR_MATERIAL = 2
const MSQ_COLOUR_NORMAL = 3
const MSQ_DOCUMENT_FILES_BELOW = 0
const MSQ_DOCUMENT_FILES_NONE = 1
const MSQ_DOCUMENT_FILES_ANY = 2

mutable struct msq_context end
mutable struct msq_job end
mutable struct msq_shape end
mutable struct msq_field end
mutable struct msq_structure end
mutable struct msq_beam_file end
mutable struct msq_strut_graph end
mutable struct msq_material end
mutable struct msq_model end
mutable struct msq_slicer end
mutable struct msq_contours end
mutable struct msq_fill end
mutable struct msq_document end

struct msq_build_report; struct_size::UInt32; version::UInt32; with_assimp::Int32; with_cgal::Int32; licence::Cstring; simd::Cstring; with_xxhash::Int32; with_json::Int32; with_tiff::Int32; reserved::UInt32; end
struct msq_context_def; struct_size::UInt32; threads::UInt32; cache_bytes::UInt64; memory_limit::UInt64; cache_policy::Int32; beyond_cores::UInt32; warning::Ptr{Cvoid}; warning_user::Ptr{Cvoid}; parallel_for::Ptr{Cvoid}; parallel_for_user::Ptr{Cvoid}; parallel_for_release::Ptr{Cvoid}; warning_release::Ptr{Cvoid}; end
struct msq_memory_report; struct_size::UInt32; reserved::UInt32; bytes::UInt64; peak_bytes::UInt64; limit_bytes::UInt64; end
struct msq_cache_report; struct_size::UInt32; reserved::UInt32; hits::UInt64; misses::UInt64; evictions::UInt64; bytes::UInt64; peak_bytes::UInt64; limit_bytes::UInt64; building_bytes::UInt64; cells::UInt64; duplicates::UInt64; unkept::UInt64; end
struct msq_job_report; struct_size::UInt32; reserved::UInt32; points::UInt64; by_shape::UInt64; by_point::UInt64; by_set::UInt64; groups::UInt64; end
struct msq_window; first::NTuple{3,UInt64}; count::NTuple{3,UInt64}; end
struct msq_neighbourhood; origin::NTuple{3,Cdouble}; cell_size::NTuple{3,Cdouble}; rotation::NTuple{9,Cdouble}; end
struct msq_period_def; struct_size::UInt32; axis::Int32; positions::Ptr{Cdouble}; cell_sizes::Ptr{Cdouble}; count::UInt64; end
struct msq_warp_def; struct_size::UInt32; kind::Int32; count::UInt32; count_polar::UInt32; inner_radius::Cdouble; outer_radius::Cdouble; u::Ptr{msq_field}; v::Ptr{msq_field}; w::Ptr{msq_field}; shear_outwards::Cdouble; shear_along::Cdouble; end
struct msq_image; values::Ptr{Cvoid}; value_type::Int32; reserved::UInt32; size::NTuple{3,UInt64}; row_stride::UInt64; layer_stride::UInt64; grid::msq_neighbourhood; end
struct msq_file_def; struct_size::UInt32; format::Int32; winding_rule::Int32; reserved::UInt32; unit_mm::Cdouble; max_bytes::UInt64; max_triangles::UInt64; end
struct msq_mesh_def; struct_size::UInt32; coordinate_type::Int32; winding_rule::Int32; reserved::UInt32; vertices::Ptr{Cvoid}; vertex_count::UInt64; vertex_stride::UInt64; triangles::Ptr{UInt32}; triangle_count::UInt64; end
struct msq_host_shape_def; struct_size::UInt32; concurrent::Int32; inside::Ptr{Cvoid}; distance::Ptr{Cvoid}; user::Ptr{Cvoid}; release::Ptr{Cvoid}; min::NTuple{3,Cdouble}; max::NTuple{3,Cdouble}; hash_key::NTuple{2,UInt64}; end
struct msq_voxels_def; struct_size::UInt32; solid::Int32; image::msq_image; threshold::Cdouble; end
struct msq_shape_report; struct_size::UInt32; is_mesh::Int32; min::NTuple{3,Cdouble}; max::NTuple{3,Cdouble}; volume::Cdouble; area::Cdouble; vertices::UInt64; triangles::UInt64; degenerate_triangles::UInt64; duplicate_triangles::UInt64; open_edges::UInt64; non_manifold_edges::UInt64; flipped_edges::UInt64; closed::Int32; reserved::Int32; end
struct msq_radial_field_def; struct_size::UInt32; reserved::UInt32; center::NTuple{3,Cdouble}; axis::NTuple{3,Cdouble}; from_radius::Cdouble; from_value::Cdouble; to_radius::Cdouble; to_value::Cdouble; end
struct msq_host_field_def; struct_size::UInt32; concurrent::Int32; evaluate::Ptr{Cvoid}; range::Ptr{Cvoid}; user::Ptr{Cvoid}; release::Ptr{Cvoid}; low::Cdouble; high::Cdouble; lipschitz::Cdouble; hash_key::NTuple{2,UInt64}; end
struct msq_grid_field_def; struct_size::UInt32; reserved::UInt32; image::msq_image; end
struct msq_named_value; name::Cstring; value::Cdouble; end
struct msq_expression_field_def; struct_size::UInt32; reserved::UInt32; expression::Cstring; parameters::Ptr{msq_named_value}; parameter_count::UInt64; low::Cdouble; high::Cdouble; end
struct msq_shape_distance_field_def; struct_size::UInt32; reserved::UInt32; shape::Ptr{msq_shape}; curve::Ptr{Cdouble}; curve_count::UInt64; step::Cdouble; end
struct msq_param; value::Cdouble; field::Ptr{msq_field}; end
struct msq_unit_cell_def; struct_size::UInt32; unit_cell::Int32; nodes::Ptr{Cdouble}; node_count::UInt64; struts::Ptr{UInt32}; strut_count::UInt64; strut_factors::Ptr{Cdouble}; end
struct msq_unit_cell_report; struct_size::UInt32; is_periodic::Int32; node_count::UInt64; strut_count::UInt64; tiled_strut_count::UInt64; tiled_length::Cdouble; low_nodes::NTuple{3,UInt64}; high_nodes::NTuple{3,UInt64}; unmatched_nodes::NTuple{3,UInt64}; unmatched_count::UInt64; end
struct msq_lattice_def; struct_size::UInt32; unit_cell::Int32; grid::msq_neighbourhood; radius::msq_param; nodes::Ptr{Cdouble}; node_count::UInt64; struts::Ptr{UInt32}; strut_count::UInt64; strut_factors::Ptr{Cdouble}; cells::Ptr{msq_unit_cell_def}; cell_count::UInt32; clusters::UInt32; cell_choice::msq_param; period::Ptr{msq_period_def}; warp::Ptr{msq_warp_def}; end
struct msq_lattice_faces_report; struct_size::UInt32; axis::Int32; cells::UInt64; faces::UInt64; unmatched::UInt64; cell::NTuple{3,Int32}; reserved::UInt32; types::NTuple{2,UInt32}; point::NTuple{3,Cdouble}; end
struct msq_plate_lattice_def; struct_size::UInt32; plate_cell::Int32; grid::msq_neighbourhood; thickness::msq_param; nodes::Ptr{Cdouble}; node_count::UInt64; faces::Ptr{UInt32}; face_count::UInt64; face_factors::Ptr{Cdouble}; radius::msq_param; unit_cell::Int32; reserved::UInt32; struts::Ptr{UInt32}; strut_count::UInt64; strut_factors::Ptr{Cdouble}; end
struct msq_foam_def; struct_size::UInt32; method::Int32; grid::msq_neighbourhood; radius::msq_param; jitter::Cdouble; seed::UInt64; density::msq_param; wall_thickness::msq_param; vent_radius::msq_param; stretch::NTuple{3,Cdouble}; weight::Cdouble; period::Ptr{msq_period_def}; warp::Ptr{msq_warp_def}; end
struct msq_functional_def; struct_size::UInt32; var"function"::Int32; kind::Int32; clusters::UInt32; grid::msq_neighbourhood; level::msq_param; expression::Cstring; parameters::Ptr{msq_named_value}; parameter_count::UInt64; thickness::msq_param; period::Ptr{msq_period_def}; warp::Ptr{msq_warp_def}; end
struct msq_waves_def; struct_size::UInt32; kind::Int32; seed::UInt64; count::UInt32; tile::NTuple{3,UInt32}; cone_angles::NTuple{3,Cdouble}; grid::msq_neighbourhood; level::msq_param; volume_fraction::Cdouble; end
struct msq_beams_def; struct_size::UInt32; cap::Int32; coordinate_type::Int32; reserved::UInt32; nodes::Ptr{Cvoid}; node_count::UInt64; node_stride::UInt64; beams::Ptr{UInt32}; beam_count::UInt64; beam_stride::UInt64; radii::Ptr{Cvoid}; radius_stride::UInt64; caps::Ptr{UInt8}; cap_stride::UInt64; balls::Ptr{UInt32}; ball_count::UInt64; ball_stride::UInt64; ball_radii::Ptr{Cvoid}; ball_radius_stride::UInt64; radius::Cdouble; ball_radius::Cdouble; min_length::Cdouble; length_scale::Cdouble; end
struct msq_beam_file_report; struct_size::UInt32; clipping::Int32; lattice_count::UInt64; mesh_triangle_count::UInt64; node_count::UInt64; beam_count::UInt64; ball_count::UInt64; clipping_triangle_count::UInt64; min::NTuple{3,Cdouble}; max::NTuple{3,Cdouble}; end
struct msq_host_points; struct_size::UInt32; reserved::UInt32; count::UInt64; points::Ptr{Cdouble}; positions::Ptr{Cdouble}; cells::Ptr{Int32}; end
struct msq_host_structure_def; struct_size::UInt32; concurrent::Int32; grid::msq_neighbourhood; inside::Ptr{Cvoid}; build_cell::Ptr{Cvoid}; evaluate_cell::Ptr{Cvoid}; free_cell::Ptr{Cvoid}; box::Ptr{Cvoid}; distance::Ptr{Cvoid}; user::Ptr{Cvoid}; release::Ptr{Cvoid}; hash_key::NTuple{2,UInt64}; end
struct msq_host_function_def; struct_size::UInt32; concurrent::Int32; kind::Int32; clusters::UInt32; grid::msq_neighbourhood; level::msq_param; evaluate::Ptr{Cvoid}; range::Ptr{Cvoid}; user::Ptr{Cvoid}; release::Ptr{Cvoid}; lipschitz::Cdouble; hash_key::NTuple{2,UInt64}; end
struct msq_strut; id::NTuple{2,UInt64}; node_a::NTuple{2,UInt64}; node_b::NTuple{2,UInt64}; a::NTuple{3,Cdouble}; b::NTuple{3,Cdouble}; radii::NTuple{2,Cdouble}; cell::NTuple{3,Int32}; caps::NTuple{2,UInt8}; cut::NTuple{2,UInt8}; end
struct msq_struts_def; struct_size::UInt32; selection::Int32; min::NTuple{3,Cdouble}; max::NTuple{3,Cdouble}; shape::Ptr{msq_shape}; end
struct msq_strut_graph_report; struct_size::UInt32; reserved::UInt32; node_count::UInt64; strut_count::UInt64; nodes::Ptr{Cdouble}; node_ids::Ptr{UInt64}; struts::Ptr{UInt32}; radii::Ptr{Cdouble}; strut_ids::Ptr{UInt64}; cells::Ptr{Int32}; caps::Ptr{UInt8}; cuts::Ptr{UInt8}; end
struct msq_channel; name::Cstring; value::msq_param; end
struct msq_material_def; struct_size::UInt32; id::UInt32; channels::Ptr{msq_channel}; channel_count::UInt64; end
struct msq_scale_def; shape::Ptr{msq_shape}; structure::Ptr{msq_structure}; skin::msq_param; material::Ptr{msq_material}; skin_material::Ptr{msq_material}; end
struct msq_model_def; struct_size::UInt32; scale_count::UInt32; scales::Ptr{msq_scale_def}; scale_size::UInt32; reserved::UInt32; end
struct msq_query_def; struct_size::UInt32; method::Int32; length_scale::Cdouble; critical_count::UInt64; group_parts::UInt32; reserved::UInt32; end
struct msq_points_def; struct_size::UInt32; kind::Int32; coordinates::Ptr{Cvoid}; count::UInt64; stride::UInt64; coordinate_type::Int32; reserved::UInt32; origin::NTuple{3,Cdouble}; spacing::NTuple{3,Cdouble}; counts::NTuple{3,UInt64}; seed::UInt64; per_cell::UInt32; reserved2::UInt32; rotation::NTuple{9,Cdouble}; window::msq_window; end
struct msq_estimate; value::Cdouble; standard_error::Cdouble; low::Cdouble; high::Cdouble; end
struct msq_segments_def; struct_size::UInt32; phase::Int32; direction::NTuple{3,Cdouble}; lengths::Ptr{Cdouble}; length_count::UInt64; step::Cdouble; end
struct msq_calibration_report; struct_size::UInt32; reserved::UInt32; samples::UInt64; parameter::Cdouble; fraction::msq_estimate; max_fraction::Cdouble; end
struct msq_contours_def; struct_size::UInt32; type::Int32; axis::Int32; has_window::Int32; window_min::NTuple{2,Cdouble}; window_max::NTuple{2,Cdouble}; tolerance::Cdouble; pitch::Cdouble; units::Cdouble; length_scale::Cdouble; topology_samples::UInt32; end
struct msq_output_def; struct_size::UInt32; output::Int32; grey_samples::UInt32; grey_threshold::UInt32; grey_gamma::Cdouble; onset_scale::UInt32; onset_value::Int32; contours::Ptr{msq_contours_def}; channel::Cstring; end
struct msq_slicer_def; struct_size::UInt32; output::Int32; pitch::NTuple{2,Cdouble}; resolution::NTuple{2,UInt32}; layer_height::Cdouble; layer_count::UInt64; has_region::Int32; slab_layers::UInt32; region_min::NTuple{3,Cdouble}; region_max::NTuple{3,Cdouble}; layer_z::Ptr{Cdouble}; layer_z_count::UInt64; length_scale::Cdouble; window::msq_window; grey_samples::UInt32; grey_threshold::UInt32; grey_gamma::Cdouble; orientation::UInt32; output_count::UInt32; outputs::Ptr{msq_output_def}; frame_origin::NTuple{3,Cdouble}; frame_axes::NTuple{9,Cdouble}; end
struct msq_slicer_report; struct_size::UInt32; slab_layers::UInt32; width::UInt32; height::UInt32; layer_count::UInt64; stride::UInt64; layer_bytes::UInt64; origin::NTuple{2,Cdouble}; pitch::NTuple{2,Cdouble}; window::msq_window; whole::NTuple{3,UInt64}; end
struct msq_output; struct_size::UInt32; output::Int32; data::Ptr{UInt8}; stride::UInt64; inside_count::UInt64; contours::Ptr{msq_contours}; end
struct msq_layer; struct_size::UInt32; output::Int32; index::UInt64; z::Cdouble; data::Ptr{UInt8}; stride::UInt64; width::UInt32; height::UInt32; inside_count::UInt64; output_count::UInt64; outputs::Ptr{Ptr{msq_output}}; end
struct msq_contours_report; struct_size::UInt32; type::Int32; ring_count::UInt64; point_count::UInt64; points::Ptr{Cvoid}; starts::Ptr{UInt64}; parents::Ptr{Int64}; holes::Ptr{UInt8}; unresolved_count::UInt64; pitch::Cdouble; topology_count::UInt64; topology_samples::UInt32; end
struct msq_printability_def; struct_size::UInt32; kinds::UInt32; has_plate::Int32; reserved::UInt32; width::Cdouble; min_volume::Cdouble; overhang::Cdouble; end
struct msq_finding; kind::Int32; reserved::UInt32; first_layer::UInt64; last_layer::UInt64; sample_count::UInt64; volume::Cdouble; point::NTuple{3,Cdouble}; min::NTuple{3,Cdouble}; max::NTuple{3,Cdouble}; end
struct msq_printability_report; struct_size::UInt32; reserved::UInt32; layer_count::UInt64; solid_count::UInt64; solid_volume::Cdouble; island_count::UInt64; loose_count::UInt64; void_count::UInt64; thin_count::UInt64; island_volume::Cdouble; loose_volume::Cdouble; void_volume::Cdouble; thin_volume::Cdouble; cup_count::UInt64; overhang_count::UInt64; cup_volume::Cdouble; overhang_volume::Cdouble; end
struct msq_ring; points::Ptr{Cvoid}; count::UInt64; end
struct msq_fill_def; struct_size::UInt32; coordinate_type::Int32; rings::Ptr{msq_ring}; ring_count::UInt64; point_stride::UInt64; scale::Cdouble; origin::NTuple{2,Cdouble}; z::Cdouble; tolerance::Cdouble; min_length::Cdouble; pair_distance::Cdouble; corner_distance::Cdouble; end
struct msq_fill_report; struct_size::UInt32; coordinate_type::Int32; points::Ptr{Cvoid}; point_count::UInt64; path_starts::Ptr{UInt64}; closed::Ptr{UInt8}; path_count::UInt64; length::Cdouble; travel::Cdouble; end
struct msq_surface_def; struct_size::UInt32; has_box::Int32; min::NTuple{3,Cdouble}; max::NTuple{3,Cdouble}; pitch::Cdouble; length_scale::Cdouble; slab_layers::UInt32; reserved::UInt32; end
struct msq_surface_slab; struct_size::UInt32; reserved::UInt32; first_vertex::UInt64; vertex_count::UInt64; vertices::Ptr{Cdouble}; normals::Ptr{Cfloat}; first_triangle::UInt64; triangle_count::UInt64; triangles::Ptr{UInt32}; end
struct msq_file_part; struct_size::UInt32; reserved::UInt32; offset::UInt64; size::UInt64; total::UInt64; bytes::Ptr{UInt8}; end
struct msq_rays_def; struct_size::UInt32; coordinate_type::Int32; count::UInt64; origins::Ptr{Cvoid}; directions::Ptr{Cvoid}; origin_stride::UInt64; direction_stride::UInt64; t_min::Ptr{Cdouble}; t_max::Ptr{Cdouble}; end
struct msq_ray_hit; t::Cdouble; normal::NTuple{3,Cdouble}; scale::Int32; starts_inside::Int32; cell::NTuple{3,Int32}; material::UInt32; end
struct msq_camera; struct_size::UInt32; projection::Int32; eye::NTuple{3,Cdouble}; target::NTuple{3,Cdouble}; up::NTuple{3,Cdouble}; height::Cdouble; field_of_view::Cdouble; clip_near::Cdouble; clip_far::Cdouble; end
struct msq_render_def; struct_size::UInt32; width::UInt32; height::UInt32; tile_x::UInt32; tile_y::UInt32; tile_width::UInt32; tile_height::UInt32; samples::UInt32; first_step::UInt32; colour_by::Int32; colours::Ptr{Cdouble}; colour_count::UInt64; background::NTuple{4,Cdouble}; light::NTuple{3,Cdouble}; ambient::Cdouble; shadows::Int32; occlusion_rays::UInt32; occlusion_distance::Cdouble; end
struct msq_frame; struct_size::UInt32; row_pixels::UInt32; depth::Ptr{Cfloat}; normal::Ptr{Cfloat}; scale::Ptr{Int32}; material::Ptr{UInt32}; rgba::Ptr{UInt8}; end
struct msq_render_pass; struct_size::UInt32; step::UInt32; samples::UInt32; is_last::Int32; end
struct msq_document_def; struct_size::UInt32; files::Int32; base_directory::Cstring; max_bytes::UInt64; max_values::UInt64; max_depth::UInt32; max_files::UInt32; max_file_bytes::UInt64; max_triangles::UInt64; end
struct msq_document_report; struct_size::UInt32; version::UInt32; has_slicing::Int32; has_view::Int32; files::UInt32; reserved::UInt32; title::Cstring; end
struct msq_json_def; struct_size::UInt32; reserved::UInt32; base_directory::Cstring; title::Cstring; slicing::Ptr{msq_slicer_def}; camera::Ptr{msq_camera}; render::Ptr{msq_render_def}; max_numbers::UInt64; end

msq_version() = ccall((:msq_version, library), UInt32, ())
msq_status_name(status) = ccall((:msq_status_name, library), Cstring, (Int32,), status)
msq_error_message() = ccall((:msq_error_message, library), Cstring, ())
msq_error_host_code() = ccall((:msq_error_host_code, library), Int32, ())
msq_build_info(report) = ccall((:msq_build_info, library), Int32, (Ptr{msq_build_report},), report)
msq_context_def_init(def, size) = ccall((:msq_context_def_init, library), Int32, (Ptr{msq_context_def}, Csize_t), def, size)
msq_context_create(def, context) = ccall((:msq_context_create, library), Int32, (Ptr{msq_context_def}, Ptr{Ptr{msq_context}}), def, context)
msq_context_retain(context) = ccall((:msq_context_retain, library), Cvoid, (Ptr{msq_context},), context)
msq_context_release(context) = ccall((:msq_context_release, library), Cvoid, (Ptr{msq_context},), context)
msq_context_memory(context, report) = ccall((:msq_context_memory, library), Int32, (Ptr{msq_context}, Ptr{msq_memory_report}), context, report)
msq_cache_stats(context, report) = ccall((:msq_cache_stats, library), Int32, (Ptr{msq_context}, Ptr{msq_cache_report}), context, report)
msq_cache_clear(context) = ccall((:msq_cache_clear, library), Int32, (Ptr{msq_context},), context)
msq_job_create(job) = ccall((:msq_job_create, library), Int32, (Ptr{Ptr{msq_job}},), job)
msq_job_retain(job) = ccall((:msq_job_retain, library), Cvoid, (Ptr{msq_job},), job)
msq_job_release(job) = ccall((:msq_job_release, library), Cvoid, (Ptr{msq_job},), job)
msq_job_cancel(job) = ccall((:msq_job_cancel, library), Int32, (Ptr{msq_job},), job)
msq_job_progress(job, fraction) = ccall((:msq_job_progress, library), Int32, (Ptr{msq_job}, Ptr{Cdouble}), job, fraction)
msq_job_info(job, report) = ccall((:msq_job_info, library), Int32, (Ptr{msq_job}, Ptr{msq_job_report}), job, report)
msq_neighbourhood_placed(grid, matrix, placed) = ccall((:msq_neighbourhood_placed, library), Int32, (Ptr{msq_neighbourhood}, Ptr{Cdouble}, Ptr{msq_neighbourhood}), grid, matrix, placed)
msq_period_def_init(def, size) = ccall((:msq_period_def_init, library), Int32, (Ptr{msq_period_def}, Csize_t), def, size)
msq_warp_def_init(def, size) = ccall((:msq_warp_def_init, library), Int32, (Ptr{msq_warp_def}, Csize_t), def, size)
msq_file_def_init(def, size) = ccall((:msq_file_def_init, library), Int32, (Ptr{msq_file_def}, Csize_t), def, size)
msq_shape_from_file(context, path, def, shape, job) = ccall((:msq_shape_from_file, library), Int32, (Ptr{msq_context}, Cstring, Ptr{msq_file_def}, Ptr{Ptr{msq_shape}}, Ptr{msq_job}), context, path, def, shape, job)
msq_shape_from_memory(context, data, bytes, def, shape, job) = ccall((:msq_shape_from_memory, library), Int32, (Ptr{msq_context}, Ptr{Cvoid}, UInt64, Ptr{msq_file_def}, Ptr{Ptr{msq_shape}}, Ptr{msq_job}), context, data, bytes, def, shape, job)
msq_mesh_def_init(def, size) = ccall((:msq_mesh_def_init, library), Int32, (Ptr{msq_mesh_def}, Csize_t), def, size)
msq_shape_from_mesh(context, def, shape) = ccall((:msq_shape_from_mesh, library), Int32, (Ptr{msq_context}, Ptr{msq_mesh_def}, Ptr{Ptr{msq_shape}}), context, def, shape)
msq_shape_from_box(context, min, max, shape) = ccall((:msq_shape_from_box, library), Int32, (Ptr{msq_context}, Ptr{Cdouble}, Ptr{Cdouble}, Ptr{Ptr{msq_shape}}), context, min, max, shape)
msq_shape_from_sphere(context, center, radius, shape) = ccall((:msq_shape_from_sphere, library), Int32, (Ptr{msq_context}, Ptr{Cdouble}, Cdouble, Ptr{Ptr{msq_shape}}), context, center, radius, shape)
msq_shape_from_cylinder(context, from, to, radius, shape) = ccall((:msq_shape_from_cylinder, library), Int32, (Ptr{msq_context}, Ptr{Cdouble}, Ptr{Cdouble}, Cdouble, Ptr{Ptr{msq_shape}}), context, from, to, radius, shape)
msq_shape_all_space(context, shape) = ccall((:msq_shape_all_space, library), Int32, (Ptr{msq_context}, Ptr{Ptr{msq_shape}}), context, shape)
msq_host_shape_def_init(def, size) = ccall((:msq_host_shape_def_init, library), Int32, (Ptr{msq_host_shape_def}, Csize_t), def, size)
msq_shape_from_host(context, def, shape) = ccall((:msq_shape_from_host, library), Int32, (Ptr{msq_context}, Ptr{msq_host_shape_def}, Ptr{Ptr{msq_shape}}), context, def, shape)
msq_voxels_def_init(def, size) = ccall((:msq_voxels_def_init, library), Int32, (Ptr{msq_voxels_def}, Csize_t), def, size)
msq_shape_from_voxels(context, def, shape) = ccall((:msq_shape_from_voxels, library), Int32, (Ptr{msq_context}, Ptr{msq_voxels_def}, Ptr{Ptr{msq_shape}}), context, def, shape)
msq_shape_placed(original, matrix, shape) = ccall((:msq_shape_placed, library), Int32, (Ptr{msq_shape}, Ptr{Cdouble}, Ptr{Ptr{msq_shape}}), original, matrix, shape)
msq_shape_boolean(operation, shapes, count, shape) = ccall((:msq_shape_boolean, library), Int32, (Int32, Ptr{Ptr{msq_shape}}, UInt64, Ptr{Ptr{msq_shape}}), operation, shapes, count, shape)
msq_shape_offset(original, distance, shape) = ccall((:msq_shape_offset, library), Int32, (Ptr{msq_shape}, Cdouble, Ptr{Ptr{msq_shape}}), original, distance, shape)
msq_shape_retain(shape) = ccall((:msq_shape_retain, library), Cvoid, (Ptr{msq_shape},), shape)
msq_shape_release(shape) = ccall((:msq_shape_release, library), Cvoid, (Ptr{msq_shape},), shape)
msq_shape_info(shape, report) = ccall((:msq_shape_info, library), Int32, (Ptr{msq_shape}, Ptr{msq_shape_report}), shape, report)
msq_shape_hash(shape, hash) = ccall((:msq_shape_hash, library), Int32, (Ptr{msq_shape}, Ptr{UInt8}), shape, hash)
msq_shape_self_intersections(shape, pairs, job) = ccall((:msq_shape_self_intersections, library), Int32, (Ptr{msq_shape}, Ptr{UInt64}, Ptr{msq_job}), shape, pairs, job)
msq_field_gradient(context, from, from_value, to, to_value, field) = ccall((:msq_field_gradient, library), Int32, (Ptr{msq_context}, Ptr{Cdouble}, Cdouble, Ptr{Cdouble}, Cdouble, Ptr{Ptr{msq_field}}), context, from, from_value, to, to_value, field)
msq_radial_field_def_init(def, size) = ccall((:msq_radial_field_def_init, library), Int32, (Ptr{msq_radial_field_def}, Csize_t), def, size)
msq_field_radial(context, def, field) = ccall((:msq_field_radial, library), Int32, (Ptr{msq_context}, Ptr{msq_radial_field_def}, Ptr{Ptr{msq_field}}), context, def, field)
msq_field_map(context, argument, curve, curve_count, field) = ccall((:msq_field_map, library), Int32, (Ptr{msq_context}, Ptr{msq_field}, Ptr{Cdouble}, UInt64, Ptr{Ptr{msq_field}}), context, argument, curve, curve_count, field)
msq_host_field_def_init(def, size) = ccall((:msq_host_field_def_init, library), Int32, (Ptr{msq_host_field_def}, Csize_t), def, size)
msq_field_host(context, def, field) = ccall((:msq_field_host, library), Int32, (Ptr{msq_context}, Ptr{msq_host_field_def}, Ptr{Ptr{msq_field}}), context, def, field)
msq_grid_field_def_init(def, size) = ccall((:msq_grid_field_def_init, library), Int32, (Ptr{msq_grid_field_def}, Csize_t), def, size)
msq_field_grid(context, def, field) = ccall((:msq_field_grid, library), Int32, (Ptr{msq_context}, Ptr{msq_grid_field_def}, Ptr{Ptr{msq_field}}), context, def, field)
msq_expression_field_def_init(def, size) = ccall((:msq_expression_field_def_init, library), Int32, (Ptr{msq_expression_field_def}, Csize_t), def, size)
msq_field_expression(context, def, field) = ccall((:msq_field_expression, library), Int32, (Ptr{msq_context}, Ptr{msq_expression_field_def}, Ptr{Ptr{msq_field}}), context, def, field)
msq_shape_distance_field_def_init(def, size) = ccall((:msq_shape_distance_field_def_init, library), Int32, (Ptr{msq_shape_distance_field_def}, Csize_t), def, size)
msq_field_shape_distance(context, def, field, job) = ccall((:msq_field_shape_distance, library), Int32, (Ptr{msq_context}, Ptr{msq_shape_distance_field_def}, Ptr{Ptr{msq_field}}, Ptr{msq_job}), context, def, field, job)
msq_field_hash(field, hash) = ccall((:msq_field_hash, library), Int32, (Ptr{msq_field}, Ptr{UInt8}), field, hash)
msq_field_retain(field) = ccall((:msq_field_retain, library), Cvoid, (Ptr{msq_field},), field)
msq_field_release(field) = ccall((:msq_field_release, library), Cvoid, (Ptr{msq_field},), field)
msq_unit_cell_def_init(def, size) = ccall((:msq_unit_cell_def_init, library), Int32, (Ptr{msq_unit_cell_def}, Csize_t), def, size)
msq_unit_cell_info(cell, report, unmatched, unmatched_room) = ccall((:msq_unit_cell_info, library), Int32, (Ptr{msq_unit_cell_def}, Ptr{msq_unit_cell_report}, Ptr{UInt32}, UInt64), cell, report, unmatched, unmatched_room)
msq_unit_cell_geometry(cell, nodes, node_count, struts, strut_count) = ccall((:msq_unit_cell_geometry, library), Int32, (Ptr{msq_unit_cell_def}, Ptr{Cdouble}, UInt64, Ptr{UInt32}, UInt64), cell, nodes, node_count, struts, strut_count)
msq_lattice_def_init(def, size) = ccall((:msq_lattice_def_init, library), Int32, (Ptr{msq_lattice_def}, Csize_t), def, size)
msq_structure_lattice(context, def, structure) = ccall((:msq_structure_lattice, library), Int32, (Ptr{msq_context}, Ptr{msq_lattice_def}, Ptr{Ptr{msq_structure}}), context, def, structure)
msq_lattice_faces(lattice, min, max, report, job) = ccall((:msq_lattice_faces, library), Int32, (Ptr{msq_structure}, Ptr{Cdouble}, Ptr{Cdouble}, Ptr{msq_lattice_faces_report}, Ptr{msq_job}), lattice, min, max, report, job)
msq_plate_lattice_def_init(def, size) = ccall((:msq_plate_lattice_def_init, library), Int32, (Ptr{msq_plate_lattice_def}, Csize_t), def, size)
msq_structure_plate_lattice(context, def, structure) = ccall((:msq_structure_plate_lattice, library), Int32, (Ptr{msq_context}, Ptr{msq_plate_lattice_def}, Ptr{Ptr{msq_structure}}), context, def, structure)
msq_foam_def_init(def, size) = ccall((:msq_foam_def_init, library), Int32, (Ptr{msq_foam_def}, Csize_t), def, size)
msq_structure_foam(context, def, structure) = ccall((:msq_structure_foam, library), Int32, (Ptr{msq_context}, Ptr{msq_foam_def}, Ptr{Ptr{msq_structure}}), context, def, structure)
msq_functional_def_init(def, size) = ccall((:msq_functional_def_init, library), Int32, (Ptr{msq_functional_def}, Csize_t), def, size)
msq_structure_functional(context, def, structure) = ccall((:msq_structure_functional, library), Int32, (Ptr{msq_context}, Ptr{msq_functional_def}, Ptr{Ptr{msq_structure}}), context, def, structure)
msq_waves_def_init(def, size) = ccall((:msq_waves_def_init, library), Int32, (Ptr{msq_waves_def}, Csize_t), def, size)
msq_structure_waves(context, def, structure) = ccall((:msq_structure_waves, library), Int32, (Ptr{msq_context}, Ptr{msq_waves_def}, Ptr{Ptr{msq_structure}}), context, def, structure)
msq_beams_def_init(def, size) = ccall((:msq_beams_def_init, library), Int32, (Ptr{msq_beams_def}, Csize_t), def, size)
msq_structure_beams(context, def, structure, job) = ccall((:msq_structure_beams, library), Int32, (Ptr{msq_context}, Ptr{msq_beams_def}, Ptr{Ptr{msq_structure}}, Ptr{msq_job}), context, def, structure, job)
msq_beam_file_open(context, path, def, file, job) = ccall((:msq_beam_file_open, library), Int32, (Ptr{msq_context}, Cstring, Ptr{msq_file_def}, Ptr{Ptr{msq_beam_file}}, Ptr{msq_job}), context, path, def, file, job)
msq_beam_file_open_memory(context, data, bytes, def, file, job) = ccall((:msq_beam_file_open_memory, library), Int32, (Ptr{msq_context}, Ptr{Cvoid}, UInt64, Ptr{msq_file_def}, Ptr{Ptr{msq_beam_file}}, Ptr{msq_job}), context, data, bytes, def, file, job)
msq_beam_file_retain(file) = ccall((:msq_beam_file_retain, library), Cvoid, (Ptr{msq_beam_file},), file)
msq_beam_file_release(file) = ccall((:msq_beam_file_release, library), Cvoid, (Ptr{msq_beam_file},), file)
msq_beam_file_info(file, lattice, report) = ccall((:msq_beam_file_info, library), Int32, (Ptr{msq_beam_file}, UInt64, Ptr{msq_beam_file_report}), file, lattice, report)
msq_beam_file_beams(file, lattice, def) = ccall((:msq_beam_file_beams, library), Int32, (Ptr{msq_beam_file}, UInt64, Ptr{msq_beams_def}), file, lattice, def)
msq_beam_file_shape(context, file, lattice, mesh, winding_rule, shape) = ccall((:msq_beam_file_shape, library), Int32, (Ptr{msq_context}, Ptr{msq_beam_file}, UInt64, Int32, Int32, Ptr{Ptr{msq_shape}}), context, file, lattice, mesh, winding_rule, shape)
msq_host_structure_def_init(def, size) = ccall((:msq_host_structure_def_init, library), Int32, (Ptr{msq_host_structure_def}, Csize_t), def, size)
msq_structure_host(context, def, structure) = ccall((:msq_structure_host, library), Int32, (Ptr{msq_context}, Ptr{msq_host_structure_def}, Ptr{Ptr{msq_structure}}), context, def, structure)
msq_host_function_def_init(def, size) = ccall((:msq_host_function_def_init, library), Int32, (Ptr{msq_host_function_def}, Csize_t), def, size)
msq_structure_host_function(context, def, structure) = ccall((:msq_structure_host_function, library), Int32, (Ptr{msq_context}, Ptr{msq_host_function_def}, Ptr{Ptr{msq_structure}}), context, def, structure)
msq_structure_boolean(operation, structures, count, structure) = ccall((:msq_structure_boolean, library), Int32, (Int32, Ptr{Ptr{msq_structure}}, UInt64, Ptr{Ptr{msq_structure}}), operation, structures, count, structure)
msq_structure_blend(a, b, fraction, structure) = ccall((:msq_structure_blend, library), Int32, (Ptr{msq_structure}, Ptr{msq_structure}, Ptr{msq_param}, Ptr{Ptr{msq_structure}}), a, b, fraction, structure)
msq_structure_smooth_boolean(operation, a, b, radius, structure) = ccall((:msq_structure_smooth_boolean, library), Int32, (Int32, Ptr{msq_structure}, Ptr{msq_structure}, Ptr{msq_param}, Ptr{Ptr{msq_structure}}), operation, a, b, radius, structure)
msq_structure_hash(structure, hash) = ccall((:msq_structure_hash, library), Int32, (Ptr{msq_structure}, Ptr{UInt8}), structure, hash)
msq_structure_retain(structure) = ccall((:msq_structure_retain, library), Cvoid, (Ptr{msq_structure},), structure)
msq_structure_release(structure) = ccall((:msq_structure_release, library), Cvoid, (Ptr{msq_structure},), structure)
msq_struts_def_init(def, size) = ccall((:msq_struts_def_init, library), Int32, (Ptr{msq_struts_def}, Csize_t), def, size)
msq_structure_struts(context, structure, def, callback, user, job) = ccall((:msq_structure_struts, library), Int32, (Ptr{msq_context}, Ptr{msq_structure}, Ptr{msq_struts_def}, Ptr{Cvoid}, Ptr{Cvoid}, Ptr{msq_job}), context, structure, def, callback, user, job)
msq_structure_strut_graph(context, structure, def, graph, job) = ccall((:msq_structure_strut_graph, library), Int32, (Ptr{msq_context}, Ptr{msq_structure}, Ptr{msq_struts_def}, Ptr{Ptr{msq_strut_graph}}, Ptr{msq_job}), context, structure, def, graph, job)
msq_strut_graph_retain(graph) = ccall((:msq_strut_graph_retain, library), Cvoid, (Ptr{msq_strut_graph},), graph)
msq_strut_graph_release(graph) = ccall((:msq_strut_graph_release, library), Cvoid, (Ptr{msq_strut_graph},), graph)
msq_strut_graph_info(graph, report) = ccall((:msq_strut_graph_info, library), Int32, (Ptr{msq_strut_graph}, Ptr{msq_strut_graph_report}), graph, report)
msq_material_def_init(def, size) = ccall((:msq_material_def_init, library), Int32, (Ptr{msq_material_def}, Csize_t), def, size)
msq_material_create(context, def, material) = ccall((:msq_material_create, library), Int32, (Ptr{msq_context}, Ptr{msq_material_def}, Ptr{Ptr{msq_material}}), context, def, material)
msq_material_blend(context, id, a, b, fraction, material) = ccall((:msq_material_blend, library), Int32, (Ptr{msq_context}, UInt32, Ptr{msq_material}, Ptr{msq_material}, Ptr{msq_param}, Ptr{Ptr{msq_material}}), context, id, a, b, fraction, material)
msq_material_hash(material, hash) = ccall((:msq_material_hash, library), Int32, (Ptr{msq_material}, Ptr{UInt8}), material, hash)
msq_material_retain(material) = ccall((:msq_material_retain, library), Cvoid, (Ptr{msq_material},), material)
msq_material_release(material) = ccall((:msq_material_release, library), Cvoid, (Ptr{msq_material},), material)
msq_model_def_init(def, size) = ccall((:msq_model_def_init, library), Int32, (Ptr{msq_model_def}, Csize_t), def, size)
msq_model_create(context, def, model) = ccall((:msq_model_create, library), Int32, (Ptr{msq_context}, Ptr{msq_model_def}, Ptr{Ptr{msq_model}}), context, def, model)
msq_model_regions(context, regions, count, model) = ccall((:msq_model_regions, library), Int32, (Ptr{msq_context}, Ptr{Ptr{msq_model}}, UInt64, Ptr{Ptr{msq_model}}), context, regions, count, model)
msq_model_hash(model, hash) = ccall((:msq_model_hash, library), Int32, (Ptr{msq_model}, Ptr{UInt8}), model, hash)
msq_model_retain(model) = ccall((:msq_model_retain, library), Cvoid, (Ptr{msq_model},), model)
msq_model_release(model) = ccall((:msq_model_release, library), Cvoid, (Ptr{msq_model},), model)
msq_model_bounds(model, min, max) = ccall((:msq_model_bounds, library), Int32, (Ptr{msq_model}, Ptr{Cdouble}, Ptr{Cdouble}), model, min, max)
msq_model_scale_length(model, scale, length) = ccall((:msq_model_scale_length, library), Int32, (Ptr{msq_model}, UInt32, Ptr{Cdouble}), model, scale, length)
msq_model_scale(model, region, scale, shape, structure) = ccall((:msq_model_scale, library), Int32, (Ptr{msq_model}, UInt32, UInt32, Ptr{Ptr{msq_shape}}, Ptr{Ptr{msq_structure}}), model, region, scale, shape, structure)
msq_query_def_init(def, size) = ccall((:msq_query_def_init, library), Int32, (Ptr{msq_query_def}, Csize_t), def, size)
msq_points_def_init(def, size) = ccall((:msq_points_def_init, library), Int32, (Ptr{msq_points_def}, Csize_t), def, size)
msq_points_generate(points, first, count, coordinates) = ccall((:msq_points_generate, library), Int32, (Ptr{msq_points_def}, UInt64, UInt64, Ptr{Cdouble}), points, first, count, coordinates)
msq_point_membership(model, point, query, inside) = ccall((:msq_point_membership, library), Int32, (Ptr{msq_model}, Ptr{Cdouble}, Ptr{msq_query_def}, Ptr{Int32}), model, point, query, inside)
msq_set_membership(model, points, query, inside, inside_count, job) = ccall((:msq_set_membership, library), Int32, (Ptr{msq_model}, Ptr{msq_points_def}, Ptr{msq_query_def}, Ptr{UInt8}, UInt64, Ptr{msq_job}), model, points, query, inside, inside_count, job)
msq_point_region(model, point, region) = ccall((:msq_point_region, library), Int32, (Ptr{msq_model}, Ptr{Cdouble}, Ptr{Int32}), model, point, region)
msq_set_region(model, points, regions, region_count, job) = ccall((:msq_set_region, library), Int32, (Ptr{msq_model}, Ptr{msq_points_def}, Ptr{Int32}, UInt64, Ptr{msq_job}), model, points, regions, region_count, job)
msq_point_material(model, point, query, channels, channel_count, id, values) = ccall((:msq_point_material, library), Int32, (Ptr{msq_model}, Ptr{Cdouble}, Ptr{msq_query_def}, Ptr{Cstring}, UInt64, Ptr{UInt32}, Ptr{Cdouble}), model, point, query, channels, channel_count, id, values)
msq_set_material(model, points, query, channels, channel_count, ids, id_count, values, value_count, job) = ccall((:msq_set_material, library), Int32, (Ptr{msq_model}, Ptr{msq_points_def}, Ptr{msq_query_def}, Ptr{Cstring}, UInt64, Ptr{UInt32}, UInt64, Ptr{Cdouble}, UInt64, Ptr{msq_job}), model, points, query, channels, channel_count, ids, id_count, values, value_count, job)
msq_point_distance(model, point, query, distance) = ccall((:msq_point_distance, library), Int32, (Ptr{msq_model}, Ptr{Cdouble}, Ptr{msq_query_def}, Ptr{Cdouble}), model, point, query, distance)
msq_set_distance(model, points, query, distance, distance_count, job) = ccall((:msq_set_distance, library), Int32, (Ptr{msq_model}, Ptr{msq_points_def}, Ptr{msq_query_def}, Ptr{Cdouble}, UInt64, Ptr{msq_job}), model, points, query, distance, distance_count, job)
msq_set_onset(context, structure, points, value, onsets, onset_count, gradients, gradient_count, job) = ccall((:msq_set_onset, library), Int32, (Ptr{msq_context}, Ptr{msq_structure}, Ptr{msq_points_def}, Int32, Ptr{Cdouble}, UInt64, Ptr{Cdouble}, UInt64, Ptr{msq_job}), context, structure, points, value, onsets, onset_count, gradients, gradient_count, job)
msq_field_evaluate(context, field, points, values, value_count, job) = ccall((:msq_field_evaluate, library), Int32, (Ptr{msq_context}, Ptr{msq_field}, Ptr{msq_points_def}, Ptr{Cdouble}, UInt64, Ptr{msq_job}), context, field, points, values, value_count, job)
msq_volume_fraction(model, sample, query, phase, estimate, job) = ccall((:msq_volume_fraction, library), Int32, (Ptr{msq_model}, Ptr{msq_points_def}, Ptr{msq_query_def}, Int32, Ptr{msq_estimate}, Ptr{msq_job}), model, sample, query, phase, estimate, job)
msq_segments_def_init(def, size) = ccall((:msq_segments_def_init, library), Int32, (Ptr{msq_segments_def}, Csize_t), def, size)
msq_two_point_correlation(model, sample, query, def, estimates, estimate_count, job) = ccall((:msq_two_point_correlation, library), Int32, (Ptr{msq_model}, Ptr{msq_points_def}, Ptr{msq_query_def}, Ptr{msq_segments_def}, Ptr{msq_estimate}, UInt64, Ptr{msq_job}), model, sample, query, def, estimates, estimate_count, job)
msq_lineal_path(model, sample, query, def, estimates, estimate_count, job) = ccall((:msq_lineal_path, library), Int32, (Ptr{msq_model}, Ptr{msq_points_def}, Ptr{msq_query_def}, Ptr{msq_segments_def}, Ptr{msq_estimate}, UInt64, Ptr{msq_job}), model, sample, query, def, estimates, estimate_count, job)
msq_structure_calibrate(context, structure, sample, target, parameters, fractions, pair_count, report, job) = ccall((:msq_structure_calibrate, library), Int32, (Ptr{msq_context}, Ptr{msq_structure}, Ptr{msq_points_def}, Cdouble, Ptr{Cdouble}, Ptr{Cdouble}, UInt64, Ptr{msq_calibration_report}, Ptr{msq_job}), context, structure, sample, target, parameters, fractions, pair_count, report, job)
msq_contours_def_init(def, size) = ccall((:msq_contours_def_init, library), Int32, (Ptr{msq_contours_def}, Csize_t), def, size)
msq_output_def_init(def, size) = ccall((:msq_output_def_init, library), Int32, (Ptr{msq_output_def}, Csize_t), def, size)
msq_slicer_def_init(def, size) = ccall((:msq_slicer_def_init, library), Int32, (Ptr{msq_slicer_def}, Csize_t), def, size)
msq_slicer_create(model, def, slicer) = ccall((:msq_slicer_create, library), Int32, (Ptr{msq_model}, Ptr{msq_slicer_def}, Ptr{Ptr{msq_slicer}}), model, def, slicer)
msq_slicer_retain(slicer) = ccall((:msq_slicer_retain, library), Cvoid, (Ptr{msq_slicer},), slicer)
msq_slicer_release(slicer) = ccall((:msq_slicer_release, library), Cvoid, (Ptr{msq_slicer},), slicer)
msq_slicer_info(slicer, report) = ccall((:msq_slicer_info, library), Int32, (Ptr{msq_slicer}, Ptr{msq_slicer_report}), slicer, report)
msq_slicer_layer_z(slicer, index, z) = ccall((:msq_slicer_layer_z, library), Int32, (Ptr{msq_slicer}, UInt64, Ptr{Cdouble}), slicer, index, z)
msq_slicer_run(slicer, first, count, fn, user, job) = ccall((:msq_slicer_run, library), Int32, (Ptr{msq_slicer}, UInt64, UInt64, Ptr{Cvoid}, Ptr{Cvoid}, Ptr{msq_job}), slicer, first, count, fn, user, job)
msq_slice_layer(slicer, index, buffer, buffer_bytes, job) = ccall((:msq_slice_layer, library), Int32, (Ptr{msq_slicer}, UInt64, Ptr{UInt8}, UInt64, Ptr{msq_job}), slicer, index, buffer, buffer_bytes, job)
msq_layer_contours(model, height, def, contours, job) = ccall((:msq_layer_contours, library), Int32, (Ptr{msq_model}, Cdouble, Ptr{msq_contours_def}, Ptr{Ptr{msq_contours}}, Ptr{msq_job}), model, height, def, contours, job)
msq_slicer_contours(slicer, index, def, contours, job) = ccall((:msq_slicer_contours, library), Int32, (Ptr{msq_slicer}, UInt64, Ptr{msq_contours_def}, Ptr{Ptr{msq_contours}}, Ptr{msq_job}), slicer, index, def, contours, job)
msq_contours_retain(contours) = ccall((:msq_contours_retain, library), Cvoid, (Ptr{msq_contours},), contours)
msq_contours_release(contours) = ccall((:msq_contours_release, library), Cvoid, (Ptr{msq_contours},), contours)
msq_contours_info(contours, report) = ccall((:msq_contours_info, library), Int32, (Ptr{msq_contours}, Ptr{msq_contours_report}), contours, report)
msq_printability_def_init(def, size) = ccall((:msq_printability_def_init, library), Int32, (Ptr{msq_printability_def}, Csize_t), def, size)
msq_printability(slicer, def, fn, user, report, job) = ccall((:msq_printability, library), Int32, (Ptr{msq_slicer}, Ptr{msq_printability_def}, Ptr{Cvoid}, Ptr{Cvoid}, Ptr{msq_printability_report}, Ptr{msq_job}), slicer, def, fn, user, report, job)
msq_fill_def_init(def, size) = ccall((:msq_fill_def_init, library), Int32, (Ptr{msq_fill_def}, Csize_t), def, size)
msq_fill_lines(context, structure, def, fill, job) = ccall((:msq_fill_lines, library), Int32, (Ptr{msq_context}, Ptr{msq_structure}, Ptr{msq_fill_def}, Ptr{Ptr{msq_fill}}, Ptr{msq_job}), context, structure, def, fill, job)
msq_fill_retain(fill) = ccall((:msq_fill_retain, library), Cvoid, (Ptr{msq_fill},), fill)
msq_fill_release(fill) = ccall((:msq_fill_release, library), Cvoid, (Ptr{msq_fill},), fill)
msq_fill_info(fill, report) = ccall((:msq_fill_info, library), Int32, (Ptr{msq_fill}, Ptr{msq_fill_report}), fill, report)
msq_fill_calibrate(context, structure, line_width, density, cell_size, job) = ccall((:msq_fill_calibrate, library), Int32, (Ptr{msq_context}, Ptr{msq_structure}, Cdouble, Cdouble, Ptr{Cdouble}, Ptr{msq_job}), context, structure, line_width, density, cell_size, job)
msq_surface_def_init(def, size) = ccall((:msq_surface_def_init, library), Int32, (Ptr{msq_surface_def}, Csize_t), def, size)
msq_surface_mesh(model, def, fn, user, job) = ccall((:msq_surface_mesh, library), Int32, (Ptr{msq_model}, Ptr{msq_surface_def}, Ptr{Cvoid}, Ptr{Cvoid}, Ptr{msq_job}), model, def, fn, user, job)
msq_surface_file(model, def, format, fn, user, job) = ccall((:msq_surface_file, library), Int32, (Ptr{msq_model}, Ptr{msq_surface_def}, Int32, Ptr{Cvoid}, Ptr{Cvoid}, Ptr{msq_job}), model, def, format, fn, user, job)
msq_rays_def_init(def, size) = ccall((:msq_rays_def_init, library), Int32, (Ptr{msq_rays_def}, Csize_t), def, size)
msq_ray_cast(model, rays, query, hits, hit_count, job) = ccall((:msq_ray_cast, library), Int32, (Ptr{msq_model}, Ptr{msq_rays_def}, Ptr{msq_query_def}, Ptr{msq_ray_hit}, UInt64, Ptr{msq_job}), model, rays, query, hits, hit_count, job)
msq_camera_init(camera, size) = ccall((:msq_camera_init, library), Int32, (Ptr{msq_camera}, Csize_t), camera, size)
msq_camera_fit(model, direction, up, width, height, camera) = ccall((:msq_camera_fit, library), Int32, (Ptr{msq_model}, Ptr{Cdouble}, Ptr{Cdouble}, UInt32, UInt32, Ptr{msq_camera}), model, direction, up, width, height, camera)
msq_camera_ray(camera, width, height, position, origin, direction) = ccall((:msq_camera_ray, library), Int32, (Ptr{msq_camera}, UInt32, UInt32, Ptr{Cdouble}, Ptr{Cdouble}, Ptr{Cdouble}), camera, width, height, position, origin, direction)
msq_render_def_init(def, size) = ccall((:msq_render_def_init, library), Int32, (Ptr{msq_render_def}, Csize_t), def, size)
msq_frame_init(frame, size) = ccall((:msq_frame_init, library), Int32, (Ptr{msq_frame}, Csize_t), frame, size)
msq_render(model, camera, def, query, frame, fn, user, job) = ccall((:msq_render, library), Int32, (Ptr{msq_model}, Ptr{msq_camera}, Ptr{msq_render_def}, Ptr{msq_query_def}, Ptr{msq_frame}, Ptr{Cvoid}, Ptr{Cvoid}, Ptr{msq_job}), model, camera, def, query, frame, fn, user, job)
msq_document_def_init(def, size) = ccall((:msq_document_def_init, library), Int32, (Ptr{msq_document_def}, Csize_t), def, size)
msq_document_from_json(context, text, bytes, def, document, job) = ccall((:msq_document_from_json, library), Int32, (Ptr{msq_context}, Cstring, UInt64, Ptr{msq_document_def}, Ptr{Ptr{msq_document}}, Ptr{msq_job}), context, text, bytes, def, document, job)
msq_document_from_file(context, path, def, document, job) = ccall((:msq_document_from_file, library), Int32, (Ptr{msq_context}, Cstring, Ptr{msq_document_def}, Ptr{Ptr{msq_document}}, Ptr{msq_job}), context, path, def, document, job)
msq_document_retain(document) = ccall((:msq_document_retain, library), Cvoid, (Ptr{msq_document},), document)
msq_document_release(document) = ccall((:msq_document_release, library), Cvoid, (Ptr{msq_document},), document)
msq_document_info(document, report) = ccall((:msq_document_info, library), Int32, (Ptr{msq_document}, Ptr{msq_document_report}), document, report)
msq_document_model(document, model) = ccall((:msq_document_model, library), Int32, (Ptr{msq_document}, Ptr{Ptr{msq_model}}), document, model)
msq_document_slicing(document, def) = ccall((:msq_document_slicing, library), Int32, (Ptr{msq_document}, Ptr{msq_slicer_def}), document, def)
msq_document_view(document, camera, render) = ccall((:msq_document_view, library), Int32, (Ptr{msq_document}, Ptr{msq_camera}, Ptr{msq_render_def}), document, camera, render)
msq_json_def_init(def, size) = ccall((:msq_json_def_init, library), Int32, (Ptr{msq_json_def}, Csize_t), def, size)
msq_model_to_json(model, def, text, room, bytes) = ccall((:msq_model_to_json, library), Int32, (Ptr{msq_model}, Ptr{msq_json_def}, Cstring, UInt64, Ptr{UInt64}), model, def, text, room, bytes)
