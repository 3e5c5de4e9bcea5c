# SPDX-License-Identifier: Apache-2.0
"""The declarations of msq.h. Made from it by make_bindings.py: change those."""
from ctypes import (CFUNCTYPE, POINTER, Structure, c_char_p, c_double, c_float, c_int32, c_int64,
                    c_size_t, c_uint32, c_uint64, c_uint8, c_void_p)

MSQ_VERSION_MAJOR = 0
MSQ_VERSION_MINOR = 2
MSQ_VERSION_PATCH = 0
MSQ_VERSION = 200
MSQ_OK = 0
MSQ_E_ARGUMENT = -1
MSQ_E_MEMORY = -2
MSQ_E_CANCELLED = -3
MSQ_E_HOST = -4
MSQ_E_IO = -5
MSQ_E_UNSUPPORTED = -6
MSQ_E_MESH = -7
MSQ_E_LIMIT = -8
MSQ_E_INTERNAL = -9
MSQ_CACHE_FIFO = 0
MSQ_CACHE_SEGMENTED = 1
MSQ_WARNING_OPEN_MESH = 1
MSQ_WARNING_COARSE_PITCH = 2
MSQ_WARNING_SMALL_CACHE = 3
MSQ_WARNING_UNMATCHED_CELLS = 4
MSQ_WINDING_NONZERO = 0
MSQ_WINDING_EVEN_ODD = 1
MSQ_WINDING_POSITIVE = 2
MSQ_WINDING_AUTO = 3
MSQ_FLOAT32 = 1
MSQ_FLOAT64 = 2
MSQ_UINT8 = 3
MSQ_INT16 = 4
MSQ_UINT16 = 5
MSQ_INT32 = 6
MSQ_INT64 = 7
MSQ_FORMAT_AUTO = 0
MSQ_FORMAT_STL = 1
MSQ_FORMAT_OBJ = 2
MSQ_FORMAT_PLY = 3
MSQ_FORMAT_OFF = 4
MSQ_FORMAT_3MF = 5
MSQ_FORMAT_AMF = 6
MSQ_FORMAT_GLTF = 7
MSQ_WARP_CYLINDRICAL = 1
MSQ_WARP_SPHERICAL = 2
MSQ_WARP_SAMPLED = 3
MSQ_SOLID_ABOVE = 0
MSQ_SOLID_BELOW = 1
MSQ_BOOLEAN_UNION = 1
MSQ_BOOLEAN_INTERSECTION = 2
MSQ_BOOLEAN_DIFFERENCE = 3
MSQ_UNIT_CELL_CUSTOM = 0
MSQ_UNIT_CELL_CUBIC = 1
MSQ_UNIT_CELL_BCC = 2
MSQ_UNIT_CELL_OCTET = 3
MSQ_UNIT_CELL_FCC = 4
MSQ_UNIT_CELL_KELVIN = 5
MSQ_UNIT_CELL_DIAMOND = 6
MSQ_UNIT_CELL_RHOMBIC_DODECAHEDRON = 7
MSQ_UNIT_CELL_REENTRANT = 8
MSQ_PLATE_CELL_CUSTOM = 0
MSQ_PLATE_CELL_CUBIC = 1
MSQ_PLATE_CELL_BCC = 2
MSQ_PLATE_CELL_FCC = 3
MSQ_PLATE_CELL_CUBIC_OCTET = 4
MSQ_PLATE_CELL_KELVIN = 5
MSQ_FOAM_AUTO = 0
MSQ_FOAM_POINT = 1
MSQ_FOAM_METHOD_2 = 2
MSQ_FOAM_DIRECT = 3
MSQ_FOAM_METHOD_1 = 4
MSQ_FUNCTION_EXPRESSION = 0
MSQ_FUNCTION_GYROID = 1
MSQ_FUNCTION_SCHWARZ_P = 2
MSQ_FUNCTION_DIAMOND = 3
MSQ_FUNCTION_I_WP = 4
MSQ_FUNCTION_NEOVIUS = 5
MSQ_FUNCTION_F_RD = 6
MSQ_FUNCTION_LIDINOID = 7
MSQ_FUNCTION_SPLIT_P = 8
MSQ_FUNCTION_FISCHER_KOCH_S = 9
MSQ_FUNCTION_C_Y = 10
MSQ_FUNCTION_C_PLUS_MINUS_Y = 11
MSQ_FUNCTION_KARCHER_K = 12
MSQ_FUNCTION_G_PRIME = 13
MSQ_FUNCTION_DOUBLE_GYROID = 14
MSQ_FUNCTION_DOUBLE_DIAMOND = 15
MSQ_FUNCTION_DOUBLE_P = 16
MSQ_FUNCTION_HONEYCOMB = 17
MSQ_FUNCTION_RODS = 18
MSQ_FUNCTIONAL_NETWORK = 1
MSQ_FUNCTIONAL_SHEET = 2
MSQ_CAP_SPHERE = 0
MSQ_CAP_HEMISPHERE = 1
MSQ_CAP_BUTT = 2
MSQ_CLIPPING_NONE = 0
MSQ_CLIPPING_INSIDE = 1
MSQ_CLIPPING_OUTSIDE = 2
MSQ_BEAM_FILE_SOLID = 0
MSQ_BEAM_FILE_CLIPPING = 1
MSQ_BOX_MIXED = 0
MSQ_BOX_OUTSIDE = 1
MSQ_BOX_INSIDE = 2
MSQ_STRUTS_OWNED = 0
MSQ_STRUTS_NEAR = 1
MSQ_MATERIAL_VOID = 0
MSQ_QUERY_AUTO = 0
MSQ_QUERY_POINT = 1
MSQ_QUERY_SET = 2
MSQ_POINTS_ARRAY = 1
MSQ_POINTS_GRID = 2
MSQ_POINTS_STRATIFIED = 3
MSQ_ONSET_PLAIN = 0
MSQ_ONSET_SIGNED = 1
MSQ_PHASE_SOLID = 1
MSQ_PHASE_VOID = 2
MSQ_LAYER_BITS = 1
MSQ_LAYER_BYTES = 2
MSQ_LAYER_GREY = 3
MSQ_LAYER_DISTANCE = 4
MSQ_LAYER_MATERIAL = 5
MSQ_LAYER_ONSET = 6
MSQ_LAYER_CONTOURS = 7
MSQ_LAYER_CHANNEL = 8
MSQ_LAYER_MIRROR_X = 1
MSQ_LAYER_MIRROR_Y = 2
MSQ_LAYER_TRANSPOSE = 4
MSQ_FINDING_ISLAND = 1
MSQ_FINDING_LOOSE = 2
MSQ_FINDING_VOID = 4
MSQ_FINDING_THIN = 8
MSQ_FINDING_CUP = 16
MSQ_FINDING_OVERHANG = 32
MSQ_SURFACE_STL = 1
MSQ_SURFACE_PLY = 2
MSQ_CAMERA_ORTHOGRAPHIC = 0
MSQ_CAMERA_PERSPECTIVE = 1
MSQ_COLOUR_PLAIN = 0
MSQ_COLOUR_SCALE = 1
MSQ_COLOUR_MATERIAL = 2
MSQ_COLOUR_NORMAL = 3
MSQ_DOCUMENT_FILES_BELOW = 0
MSQ_DOCUMENT_FILES_NONE = 1
MSQ_DOCUMENT_FILES_ANY = 2


class msq_context(Structure):
    """Opaque."""


class msq_job(Structure):
    """Opaque."""


class msq_shape(Structure):
    """Opaque."""


class msq_field(Structure):
    """Opaque."""


class msq_structure(Structure):
    """Opaque."""


class msq_beam_file(Structure):
    """Opaque."""


class msq_strut_graph(Structure):
    """Opaque."""


class msq_material(Structure):
    """Opaque."""


class msq_model(Structure):
    """Opaque."""


class msq_slicer(Structure):
    """Opaque."""


class msq_contours(Structure):
    """Opaque."""


class msq_fill(Structure):
    """Opaque."""


class msq_document(Structure):
    """Opaque."""


class msq_build_report(Structure):
    _fields_ = [("struct_size", c_uint32), ("version", c_uint32), ("with_assimp", c_int32),
                ("with_cgal", c_int32), ("licence", c_char_p), ("simd", c_char_p),
                ("with_xxhash", c_int32), ("with_json", c_int32), ("with_tiff", c_int32),
                ("reserved", c_uint32)]


msq_warning_fn = CFUNCTYPE(None, c_void_p, c_int32, c_char_p)


msq_release_fn = CFUNCTYPE(None, c_void_p)


msq_task_fn = CFUNCTYPE(None, c_void_p, c_uint64)


msq_parallel_for_fn = CFUNCTYPE(c_int32, c_void_p, c_uint64, msq_task_fn, c_void_p)


class msq_context_def(Structure):
    _fields_ = [("struct_size", c_uint32), ("threads", c_uint32), ("cache_bytes", c_uint64),
                ("memory_limit", c_uint64), ("cache_policy", c_int32), ("beyond_cores", c_uint32),
                ("warning", msq_warning_fn), ("warning_user", c_void_p),
                ("parallel_for", msq_parallel_for_fn), ("parallel_for_user", c_void_p),
                ("parallel_for_release", msq_release_fn), ("warning_release", msq_release_fn)]


class msq_memory_report(Structure):
    _fields_ = [("struct_size", c_uint32), ("reserved", c_uint32), ("bytes", c_uint64),
                ("peak_bytes", c_uint64), ("limit_bytes", c_uint64)]


class msq_cache_report(Structure):
    _fields_ = [("struct_size", c_uint32), ("reserved", c_uint32), ("hits", c_uint64),
                ("misses", c_uint64), ("evictions", c_uint64), ("bytes", c_uint64),
                ("peak_bytes", c_uint64), ("limit_bytes", c_uint64), ("building_bytes", c_uint64),
                ("cells", c_uint64), ("duplicates", c_uint64), ("unkept", c_uint64)]


class msq_job_report(Structure):
    _fields_ = [("struct_size", c_uint32), ("reserved", c_uint32), ("points", c_uint64),
                ("by_shape", c_uint64), ("by_point", c_uint64), ("by_set", c_uint64),
                ("groups", c_uint64)]


class msq_window(Structure):
    _fields_ = [("first", c_uint64 * 3), ("count", c_uint64 * 3)]


msq_values_fn = CFUNCTYPE(c_int32, c_void_p, POINTER(c_double), c_uint64, POINTER(c_double))


msq_range_fn = CFUNCTYPE(c_int32, c_void_p, POINTER(c_double), POINTER(c_double), POINTER(c_double),
                         POINTER(c_double))


class msq_neighbourhood(Structure):
    _fields_ = [("origin", c_double * 3), ("cell_size", c_double * 3), ("rotation", c_double * 9)]


class msq_period_def(Structure):
    _fields_ = [("struct_size", c_uint32), ("axis", c_int32), ("positions", POINTER(c_double)),
                ("cell_sizes", POINTER(c_double)), ("count", c_uint64)]


class msq_warp_def(Structure):
    _fields_ = [("struct_size", c_uint32), ("kind", c_int32), ("count", c_uint32),
                ("count_polar", c_uint32), ("inner_radius", c_double), ("outer_radius", c_double),
                ("u", POINTER(msq_field)), ("v", POINTER(msq_field)), ("w", POINTER(msq_field)),
                ("shear_outwards", c_double), ("shear_along", c_double)]


class msq_image(Structure):
    _fields_ = [("values", c_void_p), ("value_type", c_int32), ("reserved", c_uint32),
                ("size", c_uint64 * 3), ("row_stride", c_uint64), ("layer_stride", c_uint64),
                ("grid", msq_neighbourhood)]


class msq_file_def(Structure):
    _fields_ = [("struct_size", c_uint32), ("format", c_int32), ("winding_rule", c_int32),
                ("reserved", c_uint32), ("unit_mm", c_double), ("max_bytes", c_uint64),
                ("max_triangles", c_uint64)]


class msq_mesh_def(Structure):
    _fields_ = [("struct_size", c_uint32), ("coordinate_type", c_int32), ("winding_rule", c_int32),
                ("reserved", c_uint32), ("vertices", c_void_p), ("vertex_count", c_uint64),
                ("vertex_stride", c_uint64), ("triangles", POINTER(c_uint32)),
                ("triangle_count", c_uint64)]


msq_inside_fn = CFUNCTYPE(c_int32, c_void_p, POINTER(c_double), c_uint64, POINTER(c_uint8))


class msq_host_shape_def(Structure):
    _fields_ = [("struct_size", c_uint32), ("concurrent", c_int32), ("inside", msq_inside_fn),
                ("distance", msq_values_fn), ("user", c_void_p), ("release", msq_release_fn),
                ("min", c_double * 3), ("max", c_double * 3), ("hash_key", c_uint64 * 2)]


class msq_voxels_def(Structure):
    _fields_ = [("struct_size", c_uint32), ("solid", c_int32), ("image", msq_image),
                ("threshold", c_double)]


class msq_shape_report(Structure):
    _fields_ = [("struct_size", c_uint32), ("is_mesh", c_int32), ("min", c_double * 3),
                ("max", c_double * 3), ("volume", c_double), ("area", c_double),
                ("vertices", c_uint64), ("triangles", c_uint64), ("degenerate_triangles", c_uint64),
                ("duplicate_triangles", c_uint64), ("open_edges", c_uint64),
                ("non_manifold_edges", c_uint64), ("flipped_edges", c_uint64), ("closed", c_int32),
                ("reserved", c_int32)]


class msq_radial_field_def(Structure):
    _fields_ = [("struct_size", c_uint32), ("reserved", c_uint32), ("center", c_double * 3),
                ("axis", c_double * 3), ("from_radius", c_double), ("from_value", c_double),
                ("to_radius", c_double), ("to_value", c_double)]


class msq_host_field_def(Structure):
    _fields_ = [("struct_size", c_uint32), ("concurrent", c_int32), ("evaluate", msq_values_fn),
                ("range", msq_range_fn), ("user", c_void_p), ("release", msq_release_fn),
                ("low", c_double), ("high", c_double), ("lipschitz", c_double),
                ("hash_key", c_uint64 * 2)]


class msq_grid_field_def(Structure):
    _fields_ = [("struct_size", c_uint32), ("reserved", c_uint32), ("image", msq_image)]


class msq_named_value(Structure):
    _fields_ = [("name", c_char_p), ("value", c_double)]


class msq_expression_field_def(Structure):
    _fields_ = [("struct_size", c_uint32), ("reserved", c_uint32), ("expression", c_char_p),
                ("parameters", POINTER(msq_named_value)), ("parameter_count", c_uint64),
                ("low", c_double), ("high", c_double)]


class msq_shape_distance_field_def(Structure):
    _fields_ = [("struct_size", c_uint32), ("reserved", c_uint32), ("shape", POINTER(msq_shape)),
                ("curve", POINTER(c_double)), ("curve_count", c_uint64), ("step", c_double)]


class msq_param(Structure):
    _fields_ = [("value", c_double), ("field", POINTER(msq_field))]


class msq_unit_cell_def(Structure):
    _fields_ = [("struct_size", c_uint32), ("unit_cell", c_int32), ("nodes", POINTER(c_double)),
                ("node_count", c_uint64), ("struts", POINTER(c_uint32)), ("strut_count", c_uint64),
                ("strut_factors", POINTER(c_double))]


class msq_unit_cell_report(Structure):
    _fields_ = [("struct_size", c_uint32), ("is_periodic", c_int32), ("node_count", c_uint64),
                ("strut_count", c_uint64), ("tiled_strut_count", c_uint64),
                ("tiled_length", c_double), ("low_nodes", c_uint64 * 3),
                ("high_nodes", c_uint64 * 3), ("unmatched_nodes", c_uint64 * 3),
                ("unmatched_count", c_uint64)]


class msq_lattice_def(Structure):
    _fields_ = [("struct_size", c_uint32), ("unit_cell", c_int32), ("grid", msq_neighbourhood),
                ("radius", msq_param), ("nodes", POINTER(c_double)), ("node_count", c_uint64),
                ("struts", POINTER(c_uint32)), ("strut_count", c_uint64),
                ("strut_factors", POINTER(c_double)), ("cells", POINTER(msq_unit_cell_def)),
                ("cell_count", c_uint32), ("clusters", c_uint32), ("cell_choice", msq_param),
                ("period", POINTER(msq_period_def)), ("warp", POINTER(msq_warp_def))]


class msq_lattice_faces_report(Structure):
    _fields_ = [("struct_size", c_uint32), ("axis", c_int32), ("cells", c_uint64),
                ("faces", c_uint64), ("unmatched", c_uint64), ("cell", c_int32 * 3),
                ("reserved", c_uint32), ("types", c_uint32 * 2), ("point", c_double * 3)]


class msq_plate_lattice_def(Structure):
    _fields_ = [("struct_size", c_uint32), ("plate_cell", c_int32), ("grid", msq_neighbourhood),
                ("thickness", msq_param), ("nodes", POINTER(c_double)), ("node_count", c_uint64),
                ("faces", POINTER(c_uint32)), ("face_count", c_uint64),
                ("face_factors", POINTER(c_double)), ("radius", msq_param), ("unit_cell", c_int32),
                ("reserved", c_uint32), ("struts", POINTER(c_uint32)), ("strut_count", c_uint64),
                ("strut_factors", POINTER(c_double))]


class msq_foam_def(Structure):
    _fields_ = [("struct_size", c_uint32), ("method", c_int32), ("grid", msq_neighbourhood),
                ("radius", msq_param), ("jitter", c_double), ("seed", c_uint64),
                ("density", msq_param), ("wall_thickness", msq_param), ("vent_radius", msq_param),
                ("stretch", c_double * 3), ("weight", c_double),
                ("period", POINTER(msq_period_def)), ("warp", POINTER(msq_warp_def))]


class msq_functional_def(Structure):
    _fields_ = [("struct_size", c_uint32), ("function", c_int32), ("kind", c_int32),
                ("clusters", c_uint32), ("grid", msq_neighbourhood), ("level", msq_param),
                ("expression", c_char_p), ("parameters", POINTER(msq_named_value)),
                ("parameter_count", c_uint64), ("thickness", msq_param),
                ("period", POINTER(msq_period_def)), ("warp", POINTER(msq_warp_def))]


class msq_waves_def(Structure):
    _fields_ = [("struct_size", c_uint32), ("kind", c_int32), ("seed", c_uint64),
                ("count", c_uint32), ("tile", c_uint32 * 3), ("cone_angles", c_double * 3),
                ("grid", msq_neighbourhood), ("level", msq_param), ("volume_fraction", c_double)]


class msq_beams_def(Structure):
    _fields_ = [("struct_size", c_uint32), ("cap", c_int32), ("coordinate_type", c_int32),
                ("reserved", c_uint32), ("nodes", c_void_p), ("node_count", c_uint64),
                ("node_stride", c_uint64), ("beams", POINTER(c_uint32)), ("beam_count", c_uint64),
                ("beam_stride", c_uint64), ("radii", c_void_p), ("radius_stride", c_uint64),
                ("caps", POINTER(c_uint8)), ("cap_stride", c_uint64), ("balls", POINTER(c_uint32)),
                ("ball_count", c_uint64), ("ball_stride", c_uint64), ("ball_radii", c_void_p),
                ("ball_radius_stride", c_uint64), ("radius", c_double), ("ball_radius", c_double),
                ("min_length", c_double), ("length_scale", c_double)]


class msq_beam_file_report(Structure):
    _fields_ = [("struct_size", c_uint32), ("clipping", c_int32), ("lattice_count", c_uint64),
                ("mesh_triangle_count", c_uint64), ("node_count", c_uint64),
                ("beam_count", c_uint64), ("ball_count", c_uint64),
                ("clipping_triangle_count", c_uint64), ("min", c_double * 3), ("max", c_double * 3)]


class msq_host_points(Structure):
    _fields_ = [("struct_size", c_uint32), ("reserved", c_uint32), ("count", c_uint64),
                ("points", POINTER(c_double)), ("positions", POINTER(c_double)),
                ("cells", POINTER(c_int32))]


msq_points_inside_fn = CFUNCTYPE(c_int32, c_void_p, POINTER(msq_host_points), POINTER(c_uint8))


msq_points_distance_fn = CFUNCTYPE(c_int32, c_void_p, POINTER(msq_host_points), POINTER(c_double))


msq_build_cell_fn = CFUNCTYPE(c_int32, c_void_p, POINTER(c_int32), POINTER(c_void_p),
                              POINTER(c_uint64))


msq_evaluate_cell_fn = CFUNCTYPE(c_int32, c_void_p, c_void_p, POINTER(msq_host_points),
                                 POINTER(c_uint8))


msq_free_cell_fn = CFUNCTYPE(None, c_void_p, c_void_p)


msq_box_fn = CFUNCTYPE(c_int32, c_void_p, POINTER(c_double), POINTER(c_double), POINTER(c_int32))


class msq_host_structure_def(Structure):
    _fields_ = [("struct_size", c_uint32), ("concurrent", c_int32), ("grid", msq_neighbourhood),
                ("inside", msq_points_inside_fn), ("build_cell", msq_build_cell_fn),
                ("evaluate_cell", msq_evaluate_cell_fn), ("free_cell", msq_free_cell_fn),
                ("box", msq_box_fn), ("distance", msq_points_distance_fn), ("user", c_void_p),
                ("release", msq_release_fn), ("hash_key", c_uint64 * 2)]


class msq_host_function_def(Structure):
    _fields_ = [("struct_size", c_uint32), ("concurrent", c_int32), ("kind", c_int32),
                ("clusters", c_uint32), ("grid", msq_neighbourhood), ("level", msq_param),
                ("evaluate", msq_values_fn), ("range", msq_range_fn), ("user", c_void_p),
                ("release", msq_release_fn), ("lipschitz", c_double), ("hash_key", c_uint64 * 2)]


class msq_strut(Structure):
    _fields_ = [("id", c_uint64 * 2), ("node_a", c_uint64 * 2), ("node_b", c_uint64 * 2),
                ("a", c_double * 3), ("b", c_double * 3), ("radii", c_double * 2),
                ("cell", c_int32 * 3), ("caps", c_uint8 * 2), ("cut", c_uint8 * 2)]


msq_struts_fn = CFUNCTYPE(c_int32, c_void_p, POINTER(msq_strut), c_uint64)


class msq_struts_def(Structure):
    _fields_ = [("struct_size", c_uint32), ("selection", c_int32), ("min", c_double * 3),
                ("max", c_double * 3), ("shape", POINTER(msq_shape))]


class msq_strut_graph_report(Structure):
    _fields_ = [("struct_size", c_uint32), ("reserved", c_uint32), ("node_count", c_uint64),
                ("strut_count", c_uint64), ("nodes", POINTER(c_double)),
                ("node_ids", POINTER(c_uint64)), ("struts", POINTER(c_uint32)),
                ("radii", POINTER(c_double)), ("strut_ids", POINTER(c_uint64)),
                ("cells", POINTER(c_int32)), ("caps", POINTER(c_uint8)), ("cuts", POINTER(c_uint8))]


class msq_channel(Structure):
    _fields_ = [("name", c_char_p), ("value", msq_param)]


class msq_material_def(Structure):
    _fields_ = [("struct_size", c_uint32), ("id", c_uint32), ("channels", POINTER(msq_channel)),
                ("channel_count", c_uint64)]


class msq_scale_def(Structure):
    _fields_ = [("shape", POINTER(msq_shape)), ("structure", POINTER(msq_structure)),
                ("skin", msq_param), ("material", POINTER(msq_material)),
                ("skin_material", POINTER(msq_material))]


class msq_model_def(Structure):
    _fields_ = [("struct_size", c_uint32), ("scale_count", c_uint32),
                ("scales", POINTER(msq_scale_def)), ("scale_size", c_uint32),
                ("reserved", c_uint32)]


class msq_query_def(Structure):
    _fields_ = [("struct_size", c_uint32), ("method", c_int32), ("length_scale", c_double),
                ("critical_count", c_uint64), ("group_parts", c_uint32), ("reserved", c_uint32)]


class msq_points_def(Structure):
    _fields_ = [("struct_size", c_uint32), ("kind", c_int32), ("coordinates", c_void_p),
                ("count", c_uint64), ("stride", c_uint64), ("coordinate_type", c_int32),
                ("reserved", c_uint32), ("origin", c_double * 3), ("spacing", c_double * 3),
                ("counts", c_uint64 * 3), ("seed", c_uint64), ("per_cell", c_uint32),
                ("reserved2", c_uint32), ("rotation", c_double * 9), ("window", msq_window)]


class msq_estimate(Structure):
    _fields_ = [("value", c_double), ("standard_error", c_double), ("low", c_double),
                ("high", c_double)]


class msq_segments_def(Structure):
    _fields_ = [("struct_size", c_uint32), ("phase", c_int32), ("direction", c_double * 3),
                ("lengths", POINTER(c_double)), ("length_count", c_uint64), ("step", c_double)]


class msq_calibration_report(Structure):
    _fields_ = [("struct_size", c_uint32), ("reserved", c_uint32), ("samples", c_uint64),
                ("parameter", c_double), ("fraction", msq_estimate), ("max_fraction", c_double)]


class msq_contours_def(Structure):
    _fields_ = [("struct_size", c_uint32), ("type", c_int32), ("axis", c_int32),
                ("has_window", c_int32), ("window_min", c_double * 2), ("window_max", c_double * 2),
                ("tolerance", c_double), ("pitch", c_double), ("units", c_double),
                ("length_scale", c_double), ("topology_samples", c_uint32)]


class msq_output_def(Structure):
    _fields_ = [("struct_size", c_uint32), ("output", c_int32), ("grey_samples", c_uint32),
                ("grey_threshold", c_uint32), ("grey_gamma", c_double), ("onset_scale", c_uint32),
                ("onset_value", c_int32), ("contours", POINTER(msq_contours_def)),
                ("channel", c_char_p)]


class msq_slicer_def(Structure):
    _fields_ = [("struct_size", c_uint32), ("output", c_int32), ("pitch", c_double * 2),
                ("resolution", c_uint32 * 2), ("layer_height", c_double), ("layer_count", c_uint64),
                ("has_region", c_int32), ("slab_layers", c_uint32), ("region_min", c_double * 3),
                ("region_max", c_double * 3), ("layer_z", POINTER(c_double)),
                ("layer_z_count", c_uint64), ("length_scale", c_double), ("window", msq_window),
                ("grey_samples", c_uint32), ("grey_threshold", c_uint32), ("grey_gamma", c_double),
                ("orientation", c_uint32), ("output_count", c_uint32),
                ("outputs", POINTER(msq_output_def)), ("frame_origin", c_double * 3),
                ("frame_axes", c_double * 9)]


class msq_slicer_report(Structure):
    _fields_ = [("struct_size", c_uint32), ("slab_layers", c_uint32), ("width", c_uint32),
                ("height", c_uint32), ("layer_count", c_uint64), ("stride", c_uint64),
                ("layer_bytes", c_uint64), ("origin", c_double * 2), ("pitch", c_double * 2),
                ("window", msq_window), ("whole", c_uint64 * 3)]


class msq_output(Structure):
    _fields_ = [("struct_size", c_uint32), ("output", c_int32), ("data", POINTER(c_uint8)),
                ("stride", c_uint64), ("inside_count", c_uint64),
                ("contours", POINTER(msq_contours))]


class msq_layer(Structure):
    _fields_ = [("struct_size", c_uint32), ("output", c_int32), ("index", c_uint64),
                ("z", c_double), ("data", POINTER(c_uint8)), ("stride", c_uint64),
                ("width", c_uint32), ("height", c_uint32), ("inside_count", c_uint64),
                ("output_count", c_uint64), ("outputs", POINTER(POINTER(msq_output)))]


msq_layer_fn = CFUNCTYPE(c_int32, c_void_p, POINTER(msq_layer))


class msq_contours_report(Structure):
    _fields_ = [("struct_size", c_uint32), ("type", c_int32), ("ring_count", c_uint64),
                ("point_count", c_uint64), ("points", c_void_p), ("starts", POINTER(c_uint64)),
                ("parents", POINTER(c_int64)), ("holes", POINTER(c_uint8)),
                ("unresolved_count", c_uint64), ("pitch", c_double), ("topology_count", c_uint64),
                ("topology_samples", c_uint32)]


class msq_printability_def(Structure):
    _fields_ = [("struct_size", c_uint32), ("kinds", c_uint32), ("has_plate", c_int32),
                ("reserved", c_uint32), ("width", c_double), ("min_volume", c_double),
                ("overhang", c_double)]


class msq_finding(Structure):
    _fields_ = [("kind", c_int32), ("reserved", c_uint32), ("first_layer", c_uint64),
                ("last_layer", c_uint64), ("sample_count", c_uint64), ("volume", c_double),
                ("point", c_double * 3), ("min", c_double * 3), ("max", c_double * 3)]


msq_findings_fn = CFUNCTYPE(c_int32, c_void_p, POINTER(msq_finding), c_uint64)


class msq_printability_report(Structure):
    _fields_ = [("struct_size", c_uint32), ("reserved", c_uint32), ("layer_count", c_uint64),
                ("solid_count", c_uint64), ("solid_volume", c_double), ("island_count", c_uint64),
                ("loose_count", c_uint64), ("void_count", c_uint64), ("thin_count", c_uint64),
                ("island_volume", c_double), ("loose_volume", c_double), ("void_volume", c_double),
                ("thin_volume", c_double), ("cup_count", c_uint64), ("overhang_count", c_uint64),
                ("cup_volume", c_double), ("overhang_volume", c_double)]


class msq_ring(Structure):
    _fields_ = [("points", c_void_p), ("count", c_uint64)]


class msq_fill_def(Structure):
    _fields_ = [("struct_size", c_uint32), ("coordinate_type", c_int32),
                ("rings", POINTER(msq_ring)), ("ring_count", c_uint64), ("point_stride", c_uint64),
                ("scale", c_double), ("origin", c_double * 2), ("z", c_double),
                ("tolerance", c_double), ("min_length", c_double), ("pair_distance", c_double),
                ("corner_distance", c_double)]


class msq_fill_report(Structure):
    _fields_ = [("struct_size", c_uint32), ("coordinate_type", c_int32), ("points", c_void_p),
                ("point_count", c_uint64), ("path_starts", POINTER(c_uint64)),
                ("closed", POINTER(c_uint8)), ("path_count", c_uint64), ("length", c_double),
                ("travel", c_double)]


class msq_surface_def(Structure):
    _fields_ = [("struct_size", c_uint32), ("has_box", c_int32), ("min", c_double * 3),
                ("max", c_double * 3), ("pitch", c_double), ("length_scale", c_double),
                ("slab_layers", c_uint32), ("reserved", c_uint32)]


class msq_surface_slab(Structure):
    _fields_ = [("struct_size", c_uint32), ("reserved", c_uint32), ("first_vertex", c_uint64),
                ("vertex_count", c_uint64), ("vertices", POINTER(c_double)),
                ("normals", POINTER(c_float)), ("first_triangle", c_uint64),
                ("triangle_count", c_uint64), ("triangles", POINTER(c_uint32))]


msq_surface_fn = CFUNCTYPE(c_int32, c_void_p, POINTER(msq_surface_slab))


class msq_file_part(Structure):
    _fields_ = [("struct_size", c_uint32), ("reserved", c_uint32), ("offset", c_uint64),
                ("size", c_uint64), ("total", c_uint64), ("bytes", POINTER(c_uint8))]


msq_file_fn = CFUNCTYPE(c_int32, c_void_p, POINTER(msq_file_part))


class msq_rays_def(Structure):
    _fields_ = [("struct_size", c_uint32), ("coordinate_type", c_int32), ("count", c_uint64),
                ("origins", c_void_p), ("directions", c_void_p), ("origin_stride", c_uint64),
                ("direction_stride", c_uint64), ("t_min", POINTER(c_double)),
                ("t_max", POINTER(c_double))]


class msq_ray_hit(Structure):
    _fields_ = [("t", c_double), ("normal", c_double * 3), ("scale", c_int32),
                ("starts_inside", c_int32), ("cell", c_int32 * 3), ("material", c_uint32)]


class msq_camera(Structure):
    _fields_ = [("struct_size", c_uint32), ("projection", c_int32), ("eye", c_double * 3),
                ("target", c_double * 3), ("up", c_double * 3), ("height", c_double),
                ("field_of_view", c_double), ("clip_near", c_double), ("clip_far", c_double)]


class msq_render_def(Structure):
    _fields_ = [("struct_size", c_uint32), ("width", c_uint32), ("height", c_uint32),
                ("tile_x", c_uint32), ("tile_y", c_uint32), ("tile_width", c_uint32),
                ("tile_height", c_uint32), ("samples", c_uint32), ("first_step", c_uint32),
                ("colour_by", c_int32), ("colours", POINTER(c_double)), ("colour_count", c_uint64),
                ("background", c_double * 4), ("light", c_double * 3), ("ambient", c_double),
                ("shadows", c_int32), ("occlusion_rays", c_uint32),
                ("occlusion_distance", c_double)]


class msq_frame(Structure):
    _fields_ = [("struct_size", c_uint32), ("row_pixels", c_uint32), ("depth", POINTER(c_float)),
                ("normal", POINTER(c_float)), ("scale", POINTER(c_int32)),
                ("material", POINTER(c_uint32)), ("rgba", POINTER(c_uint8))]


class msq_render_pass(Structure):
    _fields_ = [("struct_size", c_uint32), ("step", c_uint32), ("samples", c_uint32),
                ("is_last", c_int32)]


msq_render_fn = CFUNCTYPE(c_int32, c_void_p, POINTER(msq_render_pass))


class msq_document_def(Structure):
    _fields_ = [("struct_size", c_uint32), ("files", c_int32), ("base_directory", c_char_p),
                ("max_bytes", c_uint64), ("max_values", c_uint64), ("max_depth", c_uint32),
                ("max_files", c_uint32), ("max_file_bytes", c_uint64), ("max_triangles", c_uint64)]


class msq_document_report(Structure):
    _fields_ = [("struct_size", c_uint32), ("version", c_uint32), ("has_slicing", c_int32),
                ("has_view", c_int32), ("files", c_uint32), ("reserved", c_uint32),
                ("title", c_char_p)]


class msq_json_def(Structure):
    _fields_ = [("struct_size", c_uint32), ("reserved", c_uint32), ("base_directory", c_char_p),
                ("title", c_char_p), ("slicing", POINTER(msq_slicer_def)),
                ("camera", POINTER(msq_camera)), ("render", POINTER(msq_render_def)),
                ("max_numbers", c_uint64)]


# name: [result, arguments ...]
FUNCTIONS = {
    "msq_version": [c_uint32],
    "msq_status_name": [c_char_p, c_int32],
    "msq_error_message": [c_char_p],
    "msq_error_host_code": [c_int32],
    "msq_build_info": [c_int32, POINTER(msq_build_report)],
    "msq_context_def_init": [c_int32, POINTER(msq_context_def), c_size_t],
    "msq_context_create": [c_int32, POINTER(msq_context_def), POINTER(POINTER(msq_context))],
    "msq_context_retain": [None, POINTER(msq_context)],
    "msq_context_release": [None, POINTER(msq_context)],
    "msq_context_memory": [c_int32, POINTER(msq_context), POINTER(msq_memory_report)],
    "msq_cache_stats": [c_int32, POINTER(msq_context), POINTER(msq_cache_report)],
    "msq_cache_clear": [c_int32, POINTER(msq_context)],
    "msq_job_create": [c_int32, POINTER(POINTER(msq_job))],
    "msq_job_retain": [None, POINTER(msq_job)],
    "msq_job_release": [None, POINTER(msq_job)],
    "msq_job_cancel": [c_int32, POINTER(msq_job)],
    "msq_job_progress": [c_int32, POINTER(msq_job), POINTER(c_double)],
    "msq_job_info": [c_int32, POINTER(msq_job), POINTER(msq_job_report)],
    "msq_neighbourhood_placed": [c_int32, POINTER(msq_neighbourhood), POINTER(c_double),
                                 POINTER(msq_neighbourhood)],
    "msq_period_def_init": [c_int32, POINTER(msq_period_def), c_size_t],
    "msq_warp_def_init": [c_int32, POINTER(msq_warp_def), c_size_t],
    "msq_file_def_init": [c_int32, POINTER(msq_file_def), c_size_t],
    "msq_shape_from_file": [c_int32, POINTER(msq_context), c_char_p, POINTER(msq_file_def),
                            POINTER(POINTER(msq_shape)), POINTER(msq_job)],
    "msq_shape_from_memory": [c_int32, POINTER(msq_context), c_void_p, c_uint64,
                              POINTER(msq_file_def), POINTER(POINTER(msq_shape)), POINTER(msq_job)],
    "msq_mesh_def_init": [c_int32, POINTER(msq_mesh_def), c_size_t],
    "msq_shape_from_mesh": [c_int32, POINTER(msq_context), POINTER(msq_mesh_def),
                            POINTER(POINTER(msq_shape))],
    "msq_shape_from_box": [c_int32, POINTER(msq_context), POINTER(c_double), POINTER(c_double),
                           POINTER(POINTER(msq_shape))],
    "msq_shape_from_sphere": [c_int32, POINTER(msq_context), POINTER(c_double), c_double,
                              POINTER(POINTER(msq_shape))],
    "msq_shape_from_cylinder": [c_int32, POINTER(msq_context), POINTER(c_double), POINTER(c_double),
                                c_double, POINTER(POINTER(msq_shape))],
    "msq_shape_all_space": [c_int32, POINTER(msq_context), POINTER(POINTER(msq_shape))],
    "msq_host_shape_def_init": [c_int32, POINTER(msq_host_shape_def), c_size_t],
    "msq_shape_from_host": [c_int32, POINTER(msq_context), POINTER(msq_host_shape_def),
                            POINTER(POINTER(msq_shape))],
    "msq_voxels_def_init": [c_int32, POINTER(msq_voxels_def), c_size_t],
    "msq_shape_from_voxels": [c_int32, POINTER(msq_context), POINTER(msq_voxels_def),
                              POINTER(POINTER(msq_shape))],
    "msq_shape_placed": [c_int32, POINTER(msq_shape), POINTER(c_double),
                         POINTER(POINTER(msq_shape))],
    "msq_shape_boolean": [c_int32, c_int32, POINTER(POINTER(msq_shape)), c_uint64,
                          POINTER(POINTER(msq_shape))],
    "msq_shape_offset": [c_int32, POINTER(msq_shape), c_double, POINTER(POINTER(msq_shape))],
    "msq_shape_retain": [None, POINTER(msq_shape)],
    "msq_shape_release": [None, POINTER(msq_shape)],
    "msq_shape_info": [c_int32, POINTER(msq_shape), POINTER(msq_shape_report)],
    "msq_shape_hash": [c_int32, POINTER(msq_shape), POINTER(c_uint8)],
    "msq_shape_self_intersections": [c_int32, POINTER(msq_shape), POINTER(c_uint64),
                                     POINTER(msq_job)],
    "msq_field_gradient": [c_int32, POINTER(msq_context), POINTER(c_double), c_double,
                           POINTER(c_double), c_double, POINTER(POINTER(msq_field))],
    "msq_radial_field_def_init": [c_int32, POINTER(msq_radial_field_def), c_size_t],
    "msq_field_radial": [c_int32, POINTER(msq_context), POINTER(msq_radial_field_def),
                         POINTER(POINTER(msq_field))],
    "msq_field_map": [c_int32, POINTER(msq_context), POINTER(msq_field), POINTER(c_double),
                      c_uint64, POINTER(POINTER(msq_field))],
    "msq_host_field_def_init": [c_int32, POINTER(msq_host_field_def), c_size_t],
    "msq_field_host": [c_int32, POINTER(msq_context), POINTER(msq_host_field_def),
                       POINTER(POINTER(msq_field))],
    "msq_grid_field_def_init": [c_int32, POINTER(msq_grid_field_def), c_size_t],
    "msq_field_grid": [c_int32, POINTER(msq_context), POINTER(msq_grid_field_def),
                       POINTER(POINTER(msq_field))],
    "msq_expression_field_def_init": [c_int32, POINTER(msq_expression_field_def), c_size_t],
    "msq_field_expression": [c_int32, POINTER(msq_context), POINTER(msq_expression_field_def),
                             POINTER(POINTER(msq_field))],
    "msq_shape_distance_field_def_init": [c_int32, POINTER(msq_shape_distance_field_def), c_size_t],
    "msq_field_shape_distance": [c_int32, POINTER(msq_context),
                                 POINTER(msq_shape_distance_field_def), POINTER(POINTER(msq_field)),
                                 POINTER(msq_job)],
    "msq_field_hash": [c_int32, POINTER(msq_field), POINTER(c_uint8)],
    "msq_field_retain": [None, POINTER(msq_field)],
    "msq_field_release": [None, POINTER(msq_field)],
    "msq_unit_cell_def_init": [c_int32, POINTER(msq_unit_cell_def), c_size_t],
    "msq_unit_cell_info": [c_int32, POINTER(msq_unit_cell_def), POINTER(msq_unit_cell_report),
                           POINTER(c_uint32), c_uint64],
    "msq_unit_cell_geometry": [c_int32, POINTER(msq_unit_cell_def), POINTER(c_double), c_uint64,
                               POINTER(c_uint32), c_uint64],
    "msq_lattice_def_init": [c_int32, POINTER(msq_lattice_def), c_size_t],
    "msq_structure_lattice": [c_int32, POINTER(msq_context), POINTER(msq_lattice_def),
                              POINTER(POINTER(msq_structure))],
    "msq_lattice_faces": [c_int32, POINTER(msq_structure), POINTER(c_double), POINTER(c_double),
                          POINTER(msq_lattice_faces_report), POINTER(msq_job)],
    "msq_plate_lattice_def_init": [c_int32, POINTER(msq_plate_lattice_def), c_size_t],
    "msq_structure_plate_lattice": [c_int32, POINTER(msq_context), POINTER(msq_plate_lattice_def),
                                    POINTER(POINTER(msq_structure))],
    "msq_foam_def_init": [c_int32, POINTER(msq_foam_def), c_size_t],
    "msq_structure_foam": [c_int32, POINTER(msq_context), POINTER(msq_foam_def),
                           POINTER(POINTER(msq_structure))],
    "msq_functional_def_init": [c_int32, POINTER(msq_functional_def), c_size_t],
    "msq_structure_functional": [c_int32, POINTER(msq_context), POINTER(msq_functional_def),
                                 POINTER(POINTER(msq_structure))],
    "msq_waves_def_init": [c_int32, POINTER(msq_waves_def), c_size_t],
    "msq_structure_waves": [c_int32, POINTER(msq_context), POINTER(msq_waves_def),
                            POINTER(POINTER(msq_structure))],
    "msq_beams_def_init": [c_int32, POINTER(msq_beams_def), c_size_t],
    "msq_structure_beams": [c_int32, POINTER(msq_context), POINTER(msq_beams_def),
                            POINTER(POINTER(msq_structure)), POINTER(msq_job)],
    "msq_beam_file_open": [c_int32, POINTER(msq_context), c_char_p, POINTER(msq_file_def),
                           POINTER(POINTER(msq_beam_file)), POINTER(msq_job)],
    "msq_beam_file_open_memory": [c_int32, POINTER(msq_context), c_void_p, c_uint64,
                                  POINTER(msq_file_def), POINTER(POINTER(msq_beam_file)),
                                  POINTER(msq_job)],
    "msq_beam_file_retain": [None, POINTER(msq_beam_file)],
    "msq_beam_file_release": [None, POINTER(msq_beam_file)],
    "msq_beam_file_info": [c_int32, POINTER(msq_beam_file), c_uint64,
                           POINTER(msq_beam_file_report)],
    "msq_beam_file_beams": [c_int32, POINTER(msq_beam_file), c_uint64, POINTER(msq_beams_def)],
    "msq_beam_file_shape": [c_int32, POINTER(msq_context), POINTER(msq_beam_file), c_uint64,
                            c_int32, c_int32, POINTER(POINTER(msq_shape))],
    "msq_host_structure_def_init": [c_int32, POINTER(msq_host_structure_def), c_size_t],
    "msq_structure_host": [c_int32, POINTER(msq_context), POINTER(msq_host_structure_def),
                           POINTER(POINTER(msq_structure))],
    "msq_host_function_def_init": [c_int32, POINTER(msq_host_function_def), c_size_t],
    "msq_structure_host_function": [c_int32, POINTER(msq_context), POINTER(msq_host_function_def),
                                    POINTER(POINTER(msq_structure))],
    "msq_structure_boolean": [c_int32, c_int32, POINTER(POINTER(msq_structure)), c_uint64,
                              POINTER(POINTER(msq_structure))],
    "msq_structure_blend": [c_int32, POINTER(msq_structure), POINTER(msq_structure),
                            POINTER(msq_param), POINTER(POINTER(msq_structure))],
    "msq_structure_smooth_boolean": [c_int32, c_int32, POINTER(msq_structure),
                                     POINTER(msq_structure), POINTER(msq_param),
                                     POINTER(POINTER(msq_structure))],
    "msq_structure_hash": [c_int32, POINTER(msq_structure), POINTER(c_uint8)],
    "msq_structure_retain": [None, POINTER(msq_structure)],
    "msq_structure_release": [None, POINTER(msq_structure)],
    "msq_struts_def_init": [c_int32, POINTER(msq_struts_def), c_size_t],
    "msq_structure_struts": [c_int32, POINTER(msq_context), POINTER(msq_structure),
                             POINTER(msq_struts_def), msq_struts_fn, c_void_p, POINTER(msq_job)],
    "msq_structure_strut_graph": [c_int32, POINTER(msq_context), POINTER(msq_structure),
                                  POINTER(msq_struts_def), POINTER(POINTER(msq_strut_graph)),
                                  POINTER(msq_job)],
    "msq_strut_graph_retain": [None, POINTER(msq_strut_graph)],
    "msq_strut_graph_release": [None, POINTER(msq_strut_graph)],
    "msq_strut_graph_info": [c_int32, POINTER(msq_strut_graph), POINTER(msq_strut_graph_report)],
    "msq_material_def_init": [c_int32, POINTER(msq_material_def), c_size_t],
    "msq_material_create": [c_int32, POINTER(msq_context), POINTER(msq_material_def),
                            POINTER(POINTER(msq_material))],
    "msq_material_blend": [c_int32, POINTER(msq_context), c_uint32, POINTER(msq_material),
                           POINTER(msq_material), POINTER(msq_param),
                           POINTER(POINTER(msq_material))],
    "msq_material_hash": [c_int32, POINTER(msq_material), POINTER(c_uint8)],
    "msq_material_retain": [None, POINTER(msq_material)],
    "msq_material_release": [None, POINTER(msq_material)],
    "msq_model_def_init": [c_int32, POINTER(msq_model_def), c_size_t],
    "msq_model_create": [c_int32, POINTER(msq_context), POINTER(msq_model_def),
                         POINTER(POINTER(msq_model))],
    "msq_model_regions": [c_int32, POINTER(msq_context), POINTER(POINTER(msq_model)), c_uint64,
                          POINTER(POINTER(msq_model))],
    "msq_model_hash": [c_int32, POINTER(msq_model), POINTER(c_uint8)],
    "msq_model_retain": [None, POINTER(msq_model)],
    "msq_model_release": [None, POINTER(msq_model)],
    "msq_model_bounds": [c_int32, POINTER(msq_model), POINTER(c_double), POINTER(c_double)],
    "msq_model_scale_length": [c_int32, POINTER(msq_model), c_uint32, POINTER(c_double)],
    "msq_model_scale": [c_int32, POINTER(msq_model), c_uint32, c_uint32,
                        POINTER(POINTER(msq_shape)), POINTER(POINTER(msq_structure))],
    "msq_query_def_init": [c_int32, POINTER(msq_query_def), c_size_t],
    "msq_points_def_init": [c_int32, POINTER(msq_points_def), c_size_t],
    "msq_points_generate": [c_int32, POINTER(msq_points_def), c_uint64, c_uint64,
                            POINTER(c_double)],
    "msq_point_membership": [c_int32, POINTER(msq_model), POINTER(c_double), POINTER(msq_query_def),
                             POINTER(c_int32)],
    "msq_set_membership": [c_int32, POINTER(msq_model), POINTER(msq_points_def),
                           POINTER(msq_query_def), POINTER(c_uint8), c_uint64, POINTER(msq_job)],
    "msq_point_region": [c_int32, POINTER(msq_model), POINTER(c_double), POINTER(c_int32)],
    "msq_set_region": [c_int32, POINTER(msq_model), POINTER(msq_points_def), POINTER(c_int32),
                       c_uint64, POINTER(msq_job)],
    "msq_point_material": [c_int32, POINTER(msq_model), POINTER(c_double), POINTER(msq_query_def),
                           POINTER(c_char_p), c_uint64, POINTER(c_uint32), POINTER(c_double)],
    "msq_set_material": [c_int32, POINTER(msq_model), POINTER(msq_points_def),
                         POINTER(msq_query_def), POINTER(c_char_p), c_uint64, POINTER(c_uint32),
                         c_uint64, POINTER(c_double), c_uint64, POINTER(msq_job)],
    "msq_point_distance": [c_int32, POINTER(msq_model), POINTER(c_double), POINTER(msq_query_def),
                           POINTER(c_double)],
    "msq_set_distance": [c_int32, POINTER(msq_model), POINTER(msq_points_def),
                         POINTER(msq_query_def), POINTER(c_double), c_uint64, POINTER(msq_job)],
    "msq_set_onset": [c_int32, POINTER(msq_context), POINTER(msq_structure),
                      POINTER(msq_points_def), c_int32, POINTER(c_double), c_uint64,
                      POINTER(c_double), c_uint64, POINTER(msq_job)],
    "msq_field_evaluate": [c_int32, POINTER(msq_context), POINTER(msq_field),
                           POINTER(msq_points_def), POINTER(c_double), c_uint64, POINTER(msq_job)],
    "msq_volume_fraction": [c_int32, POINTER(msq_model), POINTER(msq_points_def),
                            POINTER(msq_query_def), c_int32, POINTER(msq_estimate),
                            POINTER(msq_job)],
    "msq_segments_def_init": [c_int32, POINTER(msq_segments_def), c_size_t],
    "msq_two_point_correlation": [c_int32, POINTER(msq_model), POINTER(msq_points_def),
                                  POINTER(msq_query_def), POINTER(msq_segments_def),
                                  POINTER(msq_estimate), c_uint64, POINTER(msq_job)],
    "msq_lineal_path": [c_int32, POINTER(msq_model), POINTER(msq_points_def),
                        POINTER(msq_query_def), POINTER(msq_segments_def), POINTER(msq_estimate),
                        c_uint64, POINTER(msq_job)],
    "msq_structure_calibrate": [c_int32, POINTER(msq_context), POINTER(msq_structure),
                                POINTER(msq_points_def), c_double, POINTER(c_double),
                                POINTER(c_double), c_uint64, POINTER(msq_calibration_report),
                                POINTER(msq_job)],
    "msq_contours_def_init": [c_int32, POINTER(msq_contours_def), c_size_t],
    "msq_output_def_init": [c_int32, POINTER(msq_output_def), c_size_t],
    "msq_slicer_def_init": [c_int32, POINTER(msq_slicer_def), c_size_t],
    "msq_slicer_create": [c_int32, POINTER(msq_model), POINTER(msq_slicer_def),
                          POINTER(POINTER(msq_slicer))],
    "msq_slicer_retain": [None, POINTER(msq_slicer)],
    "msq_slicer_release": [None, POINTER(msq_slicer)],
    "msq_slicer_info": [c_int32, POINTER(msq_slicer), POINTER(msq_slicer_report)],
    "msq_slicer_layer_z": [c_int32, POINTER(msq_slicer), c_uint64, POINTER(c_double)],
    "msq_slicer_run": [c_int32, POINTER(msq_slicer), c_uint64, c_uint64, msq_layer_fn, c_void_p,
                       POINTER(msq_job)],
    "msq_slice_layer": [c_int32, POINTER(msq_slicer), c_uint64, POINTER(c_uint8), c_uint64,
                        POINTER(msq_job)],
    "msq_layer_contours": [c_int32, POINTER(msq_model), c_double, POINTER(msq_contours_def),
                           POINTER(POINTER(msq_contours)), POINTER(msq_job)],
    "msq_slicer_contours": [c_int32, POINTER(msq_slicer), c_uint64, POINTER(msq_contours_def),
                            POINTER(POINTER(msq_contours)), POINTER(msq_job)],
    "msq_contours_retain": [None, POINTER(msq_contours)],
    "msq_contours_release": [None, POINTER(msq_contours)],
    "msq_contours_info": [c_int32, POINTER(msq_contours), POINTER(msq_contours_report)],
    "msq_printability_def_init": [c_int32, POINTER(msq_printability_def), c_size_t],
    "msq_printability": [c_int32, POINTER(msq_slicer), POINTER(msq_printability_def),
                         msq_findings_fn, c_void_p, POINTER(msq_printability_report),
                         POINTER(msq_job)],
    "msq_fill_def_init": [c_int32, POINTER(msq_fill_def), c_size_t],
    "msq_fill_lines": [c_int32, POINTER(msq_context), POINTER(msq_structure), POINTER(msq_fill_def),
                       POINTER(POINTER(msq_fill)), POINTER(msq_job)],
    "msq_fill_retain": [None, POINTER(msq_fill)],
    "msq_fill_release": [None, POINTER(msq_fill)],
    "msq_fill_info": [c_int32, POINTER(msq_fill), POINTER(msq_fill_report)],
    "msq_fill_calibrate": [c_int32, POINTER(msq_context), POINTER(msq_structure), c_double,
                           c_double, POINTER(c_double), POINTER(msq_job)],
    "msq_surface_def_init": [c_int32, POINTER(msq_surface_def), c_size_t],
    "msq_surface_mesh": [c_int32, POINTER(msq_model), POINTER(msq_surface_def), msq_surface_fn,
                         c_void_p, POINTER(msq_job)],
    "msq_surface_file": [c_int32, POINTER(msq_model), POINTER(msq_surface_def), c_int32,
                         msq_file_fn, c_void_p, POINTER(msq_job)],
    "msq_rays_def_init": [c_int32, POINTER(msq_rays_def), c_size_t],
    "msq_ray_cast": [c_int32, POINTER(msq_model), POINTER(msq_rays_def), POINTER(msq_query_def),
                     POINTER(msq_ray_hit), c_uint64, POINTER(msq_job)],
    "msq_camera_init": [c_int32, POINTER(msq_camera), c_size_t],
    "msq_camera_fit": [c_int32, POINTER(msq_model), POINTER(c_double), POINTER(c_double), c_uint32,
                       c_uint32, POINTER(msq_camera)],
    "msq_camera_ray": [c_int32, POINTER(msq_camera), c_uint32, c_uint32, POINTER(c_double),
                       POINTER(c_double), POINTER(c_double)],
    "msq_render_def_init": [c_int32, POINTER(msq_render_def), c_size_t],
    "msq_frame_init": [c_int32, POINTER(msq_frame), c_size_t],
    "msq_render": [c_int32, POINTER(msq_model), POINTER(msq_camera), POINTER(msq_render_def),
                   POINTER(msq_query_def), POINTER(msq_frame), msq_render_fn, c_void_p,
                   POINTER(msq_job)],
    "msq_document_def_init": [c_int32, POINTER(msq_document_def), c_size_t],
    "msq_document_from_json": [c_int32, POINTER(msq_context), c_char_p, c_uint64,
                               POINTER(msq_document_def), POINTER(POINTER(msq_document)),
                               POINTER(msq_job)],
    "msq_document_from_file": [c_int32, POINTER(msq_context), c_char_p, POINTER(msq_document_def),
                               POINTER(POINTER(msq_document)), POINTER(msq_job)],
    "msq_document_retain": [None, POINTER(msq_document)],
    "msq_document_release": [None, POINTER(msq_document)],
    "msq_document_info": [c_int32, POINTER(msq_document), POINTER(msq_document_report)],
    "msq_document_model": [c_int32, POINTER(msq_document), POINTER(POINTER(msq_model))],
    "msq_document_slicing": [c_int32, POINTER(msq_document), POINTER(msq_slicer_def)],
    "msq_document_view": [c_int32, POINTER(msq_document), POINTER(msq_camera),
                          POINTER(msq_render_def)],
    "msq_json_def_init": [c_int32, POINTER(msq_json_def), c_size_t],
    "msq_model_to_json": [c_int32, POINTER(msq_model), POINTER(msq_json_def), c_char_p, c_uint64,
                          POINTER(c_uint64)],
}
