// SPDX-License-Identifier: Apache-2.0
// Made from msq.h by bindings/make_bindings.py: change those.
export const MSQ_VERSION_MAJOR = 0;
export const MSQ_VERSION_MINOR = 2;
export const MSQ_VERSION_PATCH = 0;
export const MSQ_VERSION = 200;
export const MSQ_OK = 0;
export const MSQ_E_ARGUMENT = -1;
export const MSQ_E_MEMORY = -2;
export const MSQ_E_CANCELLED = -3;
export const MSQ_E_HOST = -4;
export const MSQ_E_IO = -5;
export const MSQ_E_UNSUPPORTED = -6;
export const MSQ_E_MESH = -7;
export const MSQ_E_LIMIT = -8;
export const MSQ_E_INTERNAL = -9;
export const MSQ_CACHE_FIFO = 0;
export const MSQ_CACHE_SEGMENTED = 1;
export const MSQ_WARNING_OPEN_MESH = 1;
export const MSQ_WARNING_COARSE_PITCH = 2;
export const MSQ_WARNING_SMALL_CACHE = 3;
export const MSQ_WARNING_UNMATCHED_CELLS = 4;
export const MSQ_WINDING_NONZERO = 0;
export const MSQ_WINDING_EVEN_ODD = 1;
export const MSQ_WINDING_POSITIVE = 2;
export const MSQ_WINDING_AUTO = 3;
export const MSQ_FLOAT32 = 1;
export const MSQ_FLOAT64 = 2;
export const MSQ_UINT8 = 3;
export const MSQ_INT16 = 4;
export const MSQ_UINT16 = 5;
export const MSQ_INT32 = 6;
export const MSQ_INT64 = 7;
export const MSQ_FORMAT_AUTO = 0;
export const MSQ_FORMAT_STL = 1;
export const MSQ_FORMAT_OBJ = 2;
export const MSQ_FORMAT_PLY = 3;
export const MSQ_FORMAT_OFF = 4;
export const MSQ_FORMAT_3MF = 5;
export const MSQ_FORMAT_AMF = 6;
export const MSQ_FORMAT_GLTF = 7;
export const MSQ_WARP_CYLINDRICAL = 1;
export const MSQ_WARP_SPHERICAL = 2;
export const MSQ_WARP_SAMPLED = 3;
export const MSQ_SOLID_ABOVE = 0;
export const MSQ_SOLID_BELOW = 1;
export const MSQ_BOOLEAN_UNION = 1;
export const MSQ_BOOLEAN_INTERSECTION = 2;
export const MSQ_BOOLEAN_DIFFERENCE = 3;
export const MSQ_UNIT_CELL_CUSTOM = 0;
export const MSQ_UNIT_CELL_CUBIC = 1;
export const MSQ_UNIT_CELL_BCC = 2;
export const MSQ_UNIT_CELL_OCTET = 3;
export const MSQ_UNIT_CELL_FCC = 4;
export const MSQ_UNIT_CELL_KELVIN = 5;
export const MSQ_UNIT_CELL_DIAMOND = 6;
export const MSQ_UNIT_CELL_RHOMBIC_DODECAHEDRON = 7;
export const MSQ_UNIT_CELL_REENTRANT = 8;
export const MSQ_PLATE_CELL_CUSTOM = 0;
export const MSQ_PLATE_CELL_CUBIC = 1;
export const MSQ_PLATE_CELL_BCC = 2;
export const MSQ_PLATE_CELL_FCC = 3;
export const MSQ_PLATE_CELL_CUBIC_OCTET = 4;
export const MSQ_PLATE_CELL_KELVIN = 5;
export const MSQ_FOAM_AUTO = 0;
export const MSQ_FOAM_POINT = 1;
export const MSQ_FOAM_METHOD_2 = 2;
export const MSQ_FOAM_DIRECT = 3;
export const MSQ_FOAM_METHOD_1 = 4;
export const MSQ_FUNCTION_EXPRESSION = 0;
export const MSQ_FUNCTION_GYROID = 1;
export const MSQ_FUNCTION_SCHWARZ_P = 2;
export const MSQ_FUNCTION_DIAMOND = 3;
export const MSQ_FUNCTION_I_WP = 4;
export const MSQ_FUNCTION_NEOVIUS = 5;
export const MSQ_FUNCTION_F_RD = 6;
export const MSQ_FUNCTION_LIDINOID = 7;
export const MSQ_FUNCTION_SPLIT_P = 8;
export const MSQ_FUNCTION_FISCHER_KOCH_S = 9;
export const MSQ_FUNCTION_C_Y = 10;
export const MSQ_FUNCTION_C_PLUS_MINUS_Y = 11;
export const MSQ_FUNCTION_KARCHER_K = 12;
export const MSQ_FUNCTION_G_PRIME = 13;
export const MSQ_FUNCTION_DOUBLE_GYROID = 14;
export const MSQ_FUNCTION_DOUBLE_DIAMOND = 15;
export const MSQ_FUNCTION_DOUBLE_P = 16;
export const MSQ_FUNCTION_HONEYCOMB = 17;
export const MSQ_FUNCTION_RODS = 18;
export const MSQ_FUNCTIONAL_NETWORK = 1;
export const MSQ_FUNCTIONAL_SHEET = 2;
export const MSQ_CAP_SPHERE = 0;
export const MSQ_CAP_HEMISPHERE = 1;
export const MSQ_CAP_BUTT = 2;
export const MSQ_CLIPPING_NONE = 0;
export const MSQ_CLIPPING_INSIDE = 1;
export const MSQ_CLIPPING_OUTSIDE = 2;
export const MSQ_BEAM_FILE_SOLID = 0;
export const MSQ_BEAM_FILE_CLIPPING = 1;
export const MSQ_BOX_MIXED = 0;
export const MSQ_BOX_OUTSIDE = 1;
export const MSQ_BOX_INSIDE = 2;
export const MSQ_STRUTS_OWNED = 0;
export const MSQ_STRUTS_NEAR = 1;
export const MSQ_MATERIAL_VOID = 0;
export const MSQ_QUERY_AUTO = 0;
export const MSQ_QUERY_POINT = 1;
export const MSQ_QUERY_SET = 2;
export const MSQ_POINTS_ARRAY = 1;
export const MSQ_POINTS_GRID = 2;
export const MSQ_POINTS_STRATIFIED = 3;
export const MSQ_ONSET_PLAIN = 0;
export const MSQ_ONSET_SIGNED = 1;
export const MSQ_PHASE_SOLID = 1;
export const MSQ_PHASE_VOID = 2;
export const MSQ_LAYER_BITS = 1;
export const MSQ_LAYER_BYTES = 2;
export const MSQ_LAYER_GREY = 3;
export const MSQ_LAYER_DISTANCE = 4;
export const MSQ_LAYER_MATERIAL = 5;
export const MSQ_LAYER_ONSET = 6;
export const MSQ_LAYER_CONTOURS = 7;
export const MSQ_LAYER_CHANNEL = 8;
export const MSQ_LAYER_MIRROR_X = 1;
export const MSQ_LAYER_MIRROR_Y = 2;
export const MSQ_LAYER_TRANSPOSE = 4;
export const MSQ_FINDING_ISLAND = 1;
export const MSQ_FINDING_LOOSE = 2;
export const MSQ_FINDING_VOID = 4;
export const MSQ_FINDING_THIN = 8;
export const MSQ_FINDING_CUP = 16;
export const MSQ_FINDING_OVERHANG = 32;
export const MSQ_SURFACE_STL = 1;
export const MSQ_SURFACE_PLY = 2;
export const MSQ_CAMERA_ORTHOGRAPHIC = 0;
export const MSQ_CAMERA_PERSPECTIVE = 1;
export const MSQ_COLOUR_PLAIN = 0;
export const MSQ_COLOUR_SCALE = 1;
export const MSQ_COLOUR_MATERIAL = 2;
export const MSQ_COLOUR_NORMAL = 3;
export const MSQ_DOCUMENT_FILES_BELOW = 0;
export const MSQ_DOCUMENT_FILES_NONE = 1;
export const MSQ_DOCUMENT_FILES_ANY = 2;

// Structs and callbacks as types of koffi.
export function types(koffi) {
  const T = {};
  T.msq_build_report = koffi.struct('msq_build_report', {
    struct_size: 'uint32_t',
    version: 'uint32_t',
    with_assimp: 'int32_t',
    with_cgal: 'int32_t',
    licence: 'str',
    simd: 'str',
    with_xxhash: 'int32_t',
    with_json: 'int32_t',
    with_tiff: 'int32_t',
    reserved: 'uint32_t',
  });
  T.msq_warning_fn = koffi.proto('msq_warning_fn', 'void', ['void *', 'int32_t', 'str']);
  T.msq_release_fn = koffi.proto('msq_release_fn', 'void', ['void *']);
  T.msq_task_fn = koffi.proto('msq_task_fn', 'void', ['void *', 'uint64_t']);
  T.msq_parallel_for_fn = koffi.proto('msq_parallel_for_fn', 'int32_t', ['void *', 'uint64_t', koffi.pointer(T.msq_task_fn), 'void *']);
  T.msq_context_def = koffi.struct('msq_context_def', {
    struct_size: 'uint32_t',
    threads: 'uint32_t',
    cache_bytes: 'uint64_t',
    memory_limit: 'uint64_t',
    cache_policy: 'int32_t',
    beyond_cores: 'uint32_t',
    warning: koffi.pointer(T.msq_warning_fn),
    warning_user: 'void *',
    parallel_for: koffi.pointer(T.msq_parallel_for_fn),
    parallel_for_user: 'void *',
    parallel_for_release: koffi.pointer(T.msq_release_fn),
    warning_release: koffi.pointer(T.msq_release_fn),
  });
  T.msq_memory_report = koffi.struct('msq_memory_report', {
    struct_size: 'uint32_t',
    reserved: 'uint32_t',
    bytes: 'uint64_t',
    peak_bytes: 'uint64_t',
    limit_bytes: 'uint64_t',
  });
  T.msq_cache_report = koffi.struct('msq_cache_report', {
    struct_size: 'uint32_t',
    reserved: 'uint32_t',
    hits: 'uint64_t',
    misses: 'uint64_t',
    evictions: 'uint64_t',
    bytes: 'uint64_t',
    peak_bytes: 'uint64_t',
    limit_bytes: 'uint64_t',
    building_bytes: 'uint64_t',
    cells: 'uint64_t',
    duplicates: 'uint64_t',
    unkept: 'uint64_t',
  });
  T.msq_job_report = koffi.struct('msq_job_report', {
    struct_size: 'uint32_t',
    reserved: 'uint32_t',
    points: 'uint64_t',
    by_shape: 'uint64_t',
    by_point: 'uint64_t',
    by_set: 'uint64_t',
    groups: 'uint64_t',
  });
  T.msq_window = koffi.struct('msq_window', {
    first: koffi.array('uint64_t', 3),
    count: koffi.array('uint64_t', 3),
  });
  T.msq_values_fn = koffi.proto('msq_values_fn', 'int32_t', ['void *', 'void *', 'uint64_t', 'void *']);
  T.msq_range_fn = koffi.proto('msq_range_fn', 'int32_t', ['void *', 'void *', 'void *', 'void *', 'void *']);
  T.msq_neighbourhood = koffi.struct('msq_neighbourhood', {
    origin: koffi.array('double', 3),
    cell_size: koffi.array('double', 3),
    rotation: koffi.array('double', 9),
  });
  T.msq_period_def = koffi.struct('msq_period_def', {
    struct_size: 'uint32_t',
    axis: 'int32_t',
    positions: 'void *',
    cell_sizes: 'void *',
    count: 'uint64_t',
  });
  T.msq_warp_def = koffi.struct('msq_warp_def', {
    struct_size: 'uint32_t',
    kind: 'int32_t',
    count: 'uint32_t',
    count_polar: 'uint32_t',
    inner_radius: 'double',
    outer_radius: 'double',
    u: 'void *',
    v: 'void *',
    w: 'void *',
    shear_outwards: 'double',
    shear_along: 'double',
  });
  T.msq_image = koffi.struct('msq_image', {
    values: 'void *',
    value_type: 'int32_t',
    reserved: 'uint32_t',
    size: koffi.array('uint64_t', 3),
    row_stride: 'uint64_t',
    layer_stride: 'uint64_t',
    grid: T.msq_neighbourhood,
  });
  T.msq_file_def = koffi.struct('msq_file_def', {
    struct_size: 'uint32_t',
    format: 'int32_t',
    winding_rule: 'int32_t',
    reserved: 'uint32_t',
    unit_mm: 'double',
    max_bytes: 'uint64_t',
    max_triangles: 'uint64_t',
  });
  T.msq_mesh_def = koffi.struct('msq_mesh_def', {
    struct_size: 'uint32_t',
    coordinate_type: 'int32_t',
    winding_rule: 'int32_t',
    reserved: 'uint32_t',
    vertices: 'void *',
    vertex_count: 'uint64_t',
    vertex_stride: 'uint64_t',
    triangles: 'void *',
    triangle_count: 'uint64_t',
  });
  T.msq_inside_fn = koffi.proto('msq_inside_fn', 'int32_t', ['void *', 'void *', 'uint64_t', 'void *']);
  T.msq_host_shape_def = koffi.struct('msq_host_shape_def', {
    struct_size: 'uint32_t',
    concurrent: 'int32_t',
    inside: koffi.pointer(T.msq_inside_fn),
    distance: koffi.pointer(T.msq_values_fn),
    user: 'void *',
    release: koffi.pointer(T.msq_release_fn),
    min: koffi.array('double', 3),
    max: koffi.array('double', 3),
    hash_key: koffi.array('uint64_t', 2),
  });
  T.msq_voxels_def = koffi.struct('msq_voxels_def', {
    struct_size: 'uint32_t',
    solid: 'int32_t',
    image: T.msq_image,
    threshold: 'double',
  });
  T.msq_shape_report = koffi.struct('msq_shape_report', {
    struct_size: 'uint32_t',
    is_mesh: 'int32_t',
    min: koffi.array('double', 3),
    max: koffi.array('double', 3),
    volume: 'double',
    area: 'double',
    vertices: 'uint64_t',
    triangles: 'uint64_t',
    degenerate_triangles: 'uint64_t',
    duplicate_triangles: 'uint64_t',
    open_edges: 'uint64_t',
    non_manifold_edges: 'uint64_t',
    flipped_edges: 'uint64_t',
    closed: 'int32_t',
    reserved: 'int32_t',
  });
  T.msq_radial_field_def = koffi.struct('msq_radial_field_def', {
    struct_size: 'uint32_t',
    reserved: 'uint32_t',
    center: koffi.array('double', 3),
    axis: koffi.array('double', 3),
    from_radius: 'double',
    from_value: 'double',
    to_radius: 'double',
    to_value: 'double',
  });
  T.msq_host_field_def = koffi.struct('msq_host_field_def', {
    struct_size: 'uint32_t',
    concurrent: 'int32_t',
    evaluate: koffi.pointer(T.msq_values_fn),
    range: koffi.pointer(T.msq_range_fn),
    user: 'void *',
    release: koffi.pointer(T.msq_release_fn),
    low: 'double',
    high: 'double',
    lipschitz: 'double',
    hash_key: koffi.array('uint64_t', 2),
  });
  T.msq_grid_field_def = koffi.struct('msq_grid_field_def', {
    struct_size: 'uint32_t',
    reserved: 'uint32_t',
    image: T.msq_image,
  });
  T.msq_named_value = koffi.struct('msq_named_value', {
    name: 'str',
    value: 'double',
  });
  T.msq_expression_field_def = koffi.struct('msq_expression_field_def', {
    struct_size: 'uint32_t',
    reserved: 'uint32_t',
    expression: 'str',
    parameters: 'void *',
    parameter_count: 'uint64_t',
    low: 'double',
    high: 'double',
  });
  T.msq_shape_distance_field_def = koffi.struct('msq_shape_distance_field_def', {
    struct_size: 'uint32_t',
    reserved: 'uint32_t',
    shape: 'void *',
    curve: 'void *',
    curve_count: 'uint64_t',
    step: 'double',
  });
  T.msq_param = koffi.struct('msq_param', {
    value: 'double',
    field: 'void *',
  });
  T.msq_unit_cell_def = koffi.struct('msq_unit_cell_def', {
    struct_size: 'uint32_t',
    unit_cell: 'int32_t',
    nodes: 'void *',
    node_count: 'uint64_t',
    struts: 'void *',
    strut_count: 'uint64_t',
    strut_factors: 'void *',
  });
  T.msq_unit_cell_report = koffi.struct('msq_unit_cell_report', {
    struct_size: 'uint32_t',
    is_periodic: 'int32_t',
    node_count: 'uint64_t',
    strut_count: 'uint64_t',
    tiled_strut_count: 'uint64_t',
    tiled_length: 'double',
    low_nodes: koffi.array('uint64_t', 3),
    high_nodes: koffi.array('uint64_t', 3),
    unmatched_nodes: koffi.array('uint64_t', 3),
    unmatched_count: 'uint64_t',
  });
  T.msq_lattice_def = koffi.struct('msq_lattice_def', {
    struct_size: 'uint32_t',
    unit_cell: 'int32_t',
    grid: T.msq_neighbourhood,
    radius: T.msq_param,
    nodes: 'void *',
    node_count: 'uint64_t',
    struts: 'void *',
    strut_count: 'uint64_t',
    strut_factors: 'void *',
    cells: 'void *',
    cell_count: 'uint32_t',
    clusters: 'uint32_t',
    cell_choice: T.msq_param,
    period: 'void *',
    warp: 'void *',
  });
  T.msq_lattice_faces_report = koffi.struct('msq_lattice_faces_report', {
    struct_size: 'uint32_t',
    axis: 'int32_t',
    cells: 'uint64_t',
    faces: 'uint64_t',
    unmatched: 'uint64_t',
    cell: koffi.array('int32_t', 3),
    reserved: 'uint32_t',
    types: koffi.array('uint32_t', 2),
    point: koffi.array('double', 3),
  });
  T.msq_plate_lattice_def = koffi.struct('msq_plate_lattice_def', {
    struct_size: 'uint32_t',
    plate_cell: 'int32_t',
    grid: T.msq_neighbourhood,
    thickness: T.msq_param,
    nodes: 'void *',
    node_count: 'uint64_t',
    faces: 'void *',
    face_count: 'uint64_t',
    face_factors: 'void *',
    radius: T.msq_param,
    unit_cell: 'int32_t',
    reserved: 'uint32_t',
    struts: 'void *',
    strut_count: 'uint64_t',
    strut_factors: 'void *',
  });
  T.msq_foam_def = koffi.struct('msq_foam_def', {
    struct_size: 'uint32_t',
    method: 'int32_t',
    grid: T.msq_neighbourhood,
    radius: T.msq_param,
    jitter: 'double',
    seed: 'uint64_t',
    density: T.msq_param,
    wall_thickness: T.msq_param,
    vent_radius: T.msq_param,
    stretch: koffi.array('double', 3),
    weight: 'double',
    period: 'void *',
    warp: 'void *',
  });
  T.msq_functional_def = koffi.struct('msq_functional_def', {
    struct_size: 'uint32_t',
    function: 'int32_t',
    kind: 'int32_t',
    clusters: 'uint32_t',
    grid: T.msq_neighbourhood,
    level: T.msq_param,
    expression: 'str',
    parameters: 'void *',
    parameter_count: 'uint64_t',
    thickness: T.msq_param,
    period: 'void *',
    warp: 'void *',
  });
  T.msq_waves_def = koffi.struct('msq_waves_def', {
    struct_size: 'uint32_t',
    kind: 'int32_t',
    seed: 'uint64_t',
    count: 'uint32_t',
    tile: koffi.array('uint32_t', 3),
    cone_angles: koffi.array('double', 3),
    grid: T.msq_neighbourhood,
    level: T.msq_param,
    volume_fraction: 'double',
  });
  T.msq_beams_def = koffi.struct('msq_beams_def', {
    struct_size: 'uint32_t',
    cap: 'int32_t',
    coordinate_type: 'int32_t',
    reserved: 'uint32_t',
    nodes: 'void *',
    node_count: 'uint64_t',
    node_stride: 'uint64_t',
    beams: 'void *',
    beam_count: 'uint64_t',
    beam_stride: 'uint64_t',
    radii: 'void *',
    radius_stride: 'uint64_t',
    caps: 'void *',
    cap_stride: 'uint64_t',
    balls: 'void *',
    ball_count: 'uint64_t',
    ball_stride: 'uint64_t',
    ball_radii: 'void *',
    ball_radius_stride: 'uint64_t',
    radius: 'double',
    ball_radius: 'double',
    min_length: 'double',
    length_scale: 'double',
  });
  T.msq_beam_file_report = koffi.struct('msq_beam_file_report', {
    struct_size: 'uint32_t',
    clipping: 'int32_t',
    lattice_count: 'uint64_t',
    mesh_triangle_count: 'uint64_t',
    node_count: 'uint64_t',
    beam_count: 'uint64_t',
    ball_count: 'uint64_t',
    clipping_triangle_count: 'uint64_t',
    min: koffi.array('double', 3),
    max: koffi.array('double', 3),
  });
  T.msq_host_points = koffi.struct('msq_host_points', {
    struct_size: 'uint32_t',
    reserved: 'uint32_t',
    count: 'uint64_t',
    points: 'void *',
    positions: 'void *',
    cells: 'void *',
  });
  T.msq_points_inside_fn = koffi.proto('msq_points_inside_fn', 'int32_t', ['void *', 'void *', 'void *']);
  T.msq_points_distance_fn = koffi.proto('msq_points_distance_fn', 'int32_t', ['void *', 'void *', 'void *']);
  T.msq_build_cell_fn = koffi.proto('msq_build_cell_fn', 'int32_t', ['void *', 'void *', 'void *', 'void *']);
  T.msq_evaluate_cell_fn = koffi.proto('msq_evaluate_cell_fn', 'int32_t', ['void *', 'void *', 'void *', 'void *']);
  T.msq_free_cell_fn = koffi.proto('msq_free_cell_fn', 'void', ['void *', 'void *']);
  T.msq_box_fn = koffi.proto('msq_box_fn', 'int32_t', ['void *', 'void *', 'void *', 'void *']);
  T.msq_host_structure_def = koffi.struct('msq_host_structure_def', {
    struct_size: 'uint32_t',
    concurrent: 'int32_t',
    grid: T.msq_neighbourhood,
    inside: koffi.pointer(T.msq_points_inside_fn),
    build_cell: koffi.pointer(T.msq_build_cell_fn),
    evaluate_cell: koffi.pointer(T.msq_evaluate_cell_fn),
    free_cell: koffi.pointer(T.msq_free_cell_fn),
    box: koffi.pointer(T.msq_box_fn),
    distance: koffi.pointer(T.msq_points_distance_fn),
    user: 'void *',
    release: koffi.pointer(T.msq_release_fn),
    hash_key: koffi.array('uint64_t', 2),
  });
  T.msq_host_function_def = koffi.struct('msq_host_function_def', {
    struct_size: 'uint32_t',
    concurrent: 'int32_t',
    kind: 'int32_t',
    clusters: 'uint32_t',
    grid: T.msq_neighbourhood,
    level: T.msq_param,
    evaluate: koffi.pointer(T.msq_values_fn),
    range: koffi.pointer(T.msq_range_fn),
    user: 'void *',
    release: koffi.pointer(T.msq_release_fn),
    lipschitz: 'double',
    hash_key: koffi.array('uint64_t', 2),
  });
  T.msq_strut = koffi.struct('msq_strut', {
    id: koffi.array('uint64_t', 2),
    node_a: koffi.array('uint64_t', 2),
    node_b: koffi.array('uint64_t', 2),
    a: koffi.array('double', 3),
    b: koffi.array('double', 3),
    radii: koffi.array('double', 2),
    cell: koffi.array('int32_t', 3),
    caps: koffi.array('uint8_t', 2),
    cut: koffi.array('uint8_t', 2),
  });
  T.msq_struts_fn = koffi.proto('msq_struts_fn', 'int32_t', ['void *', 'void *', 'uint64_t']);
  T.msq_struts_def = koffi.struct('msq_struts_def', {
    struct_size: 'uint32_t',
    selection: 'int32_t',
    min: koffi.array('double', 3),
    max: koffi.array('double', 3),
    shape: 'void *',
  });
  T.msq_strut_graph_report = koffi.struct('msq_strut_graph_report', {
    struct_size: 'uint32_t',
    reserved: 'uint32_t',
    node_count: 'uint64_t',
    strut_count: 'uint64_t',
    nodes: 'void *',
    node_ids: 'void *',
    struts: 'void *',
    radii: 'void *',
    strut_ids: 'void *',
    cells: 'void *',
    caps: 'void *',
    cuts: 'void *',
  });
  T.msq_channel = koffi.struct('msq_channel', {
    name: 'str',
    value: T.msq_param,
  });
  T.msq_material_def = koffi.struct('msq_material_def', {
    struct_size: 'uint32_t',
    id: 'uint32_t',
    channels: 'void *',
    channel_count: 'uint64_t',
  });
  T.msq_scale_def = koffi.struct('msq_scale_def', {
    shape: 'void *',
    structure: 'void *',
    skin: T.msq_param,
    material: 'void *',
    skin_material: 'void *',
  });
  T.msq_model_def = koffi.struct('msq_model_def', {
    struct_size: 'uint32_t',
    scale_count: 'uint32_t',
    scales: 'void *',
    scale_size: 'uint32_t',
    reserved: 'uint32_t',
  });
  T.msq_query_def = koffi.struct('msq_query_def', {
    struct_size: 'uint32_t',
    method: 'int32_t',
    length_scale: 'double',
    critical_count: 'uint64_t',
    group_parts: 'uint32_t',
    reserved: 'uint32_t',
  });
  T.msq_points_def = koffi.struct('msq_points_def', {
    struct_size: 'uint32_t',
    kind: 'int32_t',
    coordinates: 'void *',
    count: 'uint64_t',
    stride: 'uint64_t',
    coordinate_type: 'int32_t',
    reserved: 'uint32_t',
    origin: koffi.array('double', 3),
    spacing: koffi.array('double', 3),
    counts: koffi.array('uint64_t', 3),
    seed: 'uint64_t',
    per_cell: 'uint32_t',
    reserved2: 'uint32_t',
    rotation: koffi.array('double', 9),
    window: T.msq_window,
  });
  T.msq_estimate = koffi.struct('msq_estimate', {
    value: 'double',
    standard_error: 'double',
    low: 'double',
    high: 'double',
  });
  T.msq_segments_def = koffi.struct('msq_segments_def', {
    struct_size: 'uint32_t',
    phase: 'int32_t',
    direction: koffi.array('double', 3),
    lengths: 'void *',
    length_count: 'uint64_t',
    step: 'double',
  });
  T.msq_calibration_report = koffi.struct('msq_calibration_report', {
    struct_size: 'uint32_t',
    reserved: 'uint32_t',
    samples: 'uint64_t',
    parameter: 'double',
    fraction: T.msq_estimate,
    max_fraction: 'double',
  });
  T.msq_contours_def = koffi.struct('msq_contours_def', {
    struct_size: 'uint32_t',
    type: 'int32_t',
    axis: 'int32_t',
    has_window: 'int32_t',
    window_min: koffi.array('double', 2),
    window_max: koffi.array('double', 2),
    tolerance: 'double',
    pitch: 'double',
    units: 'double',
    length_scale: 'double',
    topology_samples: 'uint32_t',
  });
  T.msq_output_def = koffi.struct('msq_output_def', {
    struct_size: 'uint32_t',
    output: 'int32_t',
    grey_samples: 'uint32_t',
    grey_threshold: 'uint32_t',
    grey_gamma: 'double',
    onset_scale: 'uint32_t',
    onset_value: 'int32_t',
    contours: 'void *',
    channel: 'str',
  });
  T.msq_slicer_def = koffi.struct('msq_slicer_def', {
    struct_size: 'uint32_t',
    output: 'int32_t',
    pitch: koffi.array('double', 2),
    resolution: koffi.array('uint32_t', 2),
    layer_height: 'double',
    layer_count: 'uint64_t',
    has_region: 'int32_t',
    slab_layers: 'uint32_t',
    region_min: koffi.array('double', 3),
    region_max: koffi.array('double', 3),
    layer_z: 'void *',
    layer_z_count: 'uint64_t',
    length_scale: 'double',
    window: T.msq_window,
    grey_samples: 'uint32_t',
    grey_threshold: 'uint32_t',
    grey_gamma: 'double',
    orientation: 'uint32_t',
    output_count: 'uint32_t',
    outputs: 'void *',
    frame_origin: koffi.array('double', 3),
    frame_axes: koffi.array('double', 9),
  });
  T.msq_slicer_report = koffi.struct('msq_slicer_report', {
    struct_size: 'uint32_t',
    slab_layers: 'uint32_t',
    width: 'uint32_t',
    height: 'uint32_t',
    layer_count: 'uint64_t',
    stride: 'uint64_t',
    layer_bytes: 'uint64_t',
    origin: koffi.array('double', 2),
    pitch: koffi.array('double', 2),
    window: T.msq_window,
    whole: koffi.array('uint64_t', 3),
  });
  T.msq_output = koffi.struct('msq_output', {
    struct_size: 'uint32_t',
    output: 'int32_t',
    data: 'void *',
    stride: 'uint64_t',
    inside_count: 'uint64_t',
    contours: 'void *',
  });
  T.msq_layer = koffi.struct('msq_layer', {
    struct_size: 'uint32_t',
    output: 'int32_t',
    index: 'uint64_t',
    z: 'double',
    data: 'void *',
    stride: 'uint64_t',
    width: 'uint32_t',
    height: 'uint32_t',
    inside_count: 'uint64_t',
    output_count: 'uint64_t',
    outputs: 'void *',
  });
  T.msq_layer_fn = koffi.proto('msq_layer_fn', 'int32_t', ['void *', 'void *']);
  T.msq_contours_report = koffi.struct('msq_contours_report', {
    struct_size: 'uint32_t',
    type: 'int32_t',
    ring_count: 'uint64_t',
    point_count: 'uint64_t',
    points: 'void *',
    starts: 'void *',
    parents: 'void *',
    holes: 'void *',
    unresolved_count: 'uint64_t',
    pitch: 'double',
    topology_count: 'uint64_t',
    topology_samples: 'uint32_t',
  });
  T.msq_printability_def = koffi.struct('msq_printability_def', {
    struct_size: 'uint32_t',
    kinds: 'uint32_t',
    has_plate: 'int32_t',
    reserved: 'uint32_t',
    width: 'double',
    min_volume: 'double',
    overhang: 'double',
  });
  T.msq_finding = koffi.struct('msq_finding', {
    kind: 'int32_t',
    reserved: 'uint32_t',
    first_layer: 'uint64_t',
    last_layer: 'uint64_t',
    sample_count: 'uint64_t',
    volume: 'double',
    point: koffi.array('double', 3),
    min: koffi.array('double', 3),
    max: koffi.array('double', 3),
  });
  T.msq_findings_fn = koffi.proto('msq_findings_fn', 'int32_t', ['void *', 'void *', 'uint64_t']);
  T.msq_printability_report = koffi.struct('msq_printability_report', {
    struct_size: 'uint32_t',
    reserved: 'uint32_t',
    layer_count: 'uint64_t',
    solid_count: 'uint64_t',
    solid_volume: 'double',
    island_count: 'uint64_t',
    loose_count: 'uint64_t',
    void_count: 'uint64_t',
    thin_count: 'uint64_t',
    island_volume: 'double',
    loose_volume: 'double',
    void_volume: 'double',
    thin_volume: 'double',
    cup_count: 'uint64_t',
    overhang_count: 'uint64_t',
    cup_volume: 'double',
    overhang_volume: 'double',
  });
  T.msq_ring = koffi.struct('msq_ring', {
    points: 'void *',
    count: 'uint64_t',
  });
  T.msq_fill_def = koffi.struct('msq_fill_def', {
    struct_size: 'uint32_t',
    coordinate_type: 'int32_t',
    rings: 'void *',
    ring_count: 'uint64_t',
    point_stride: 'uint64_t',
    scale: 'double',
    origin: koffi.array('double', 2),
    z: 'double',
    tolerance: 'double',
    min_length: 'double',
    pair_distance: 'double',
    corner_distance: 'double',
  });
  T.msq_fill_report = koffi.struct('msq_fill_report', {
    struct_size: 'uint32_t',
    coordinate_type: 'int32_t',
    points: 'void *',
    point_count: 'uint64_t',
    path_starts: 'void *',
    closed: 'void *',
    path_count: 'uint64_t',
    length: 'double',
    travel: 'double',
  });
  T.msq_surface_def = koffi.struct('msq_surface_def', {
    struct_size: 'uint32_t',
    has_box: 'int32_t',
    min: koffi.array('double', 3),
    max: koffi.array('double', 3),
    pitch: 'double',
    length_scale: 'double',
    slab_layers: 'uint32_t',
    reserved: 'uint32_t',
  });
  T.msq_surface_slab = koffi.struct('msq_surface_slab', {
    struct_size: 'uint32_t',
    reserved: 'uint32_t',
    first_vertex: 'uint64_t',
    vertex_count: 'uint64_t',
    vertices: 'void *',
    normals: 'void *',
    first_triangle: 'uint64_t',
    triangle_count: 'uint64_t',
    triangles: 'void *',
  });
  T.msq_surface_fn = koffi.proto('msq_surface_fn', 'int32_t', ['void *', 'void *']);
  T.msq_file_part = koffi.struct('msq_file_part', {
    struct_size: 'uint32_t',
    reserved: 'uint32_t',
    offset: 'uint64_t',
    size: 'uint64_t',
    total: 'uint64_t',
    bytes: 'void *',
  });
  T.msq_file_fn = koffi.proto('msq_file_fn', 'int32_t', ['void *', 'void *']);
  T.msq_rays_def = koffi.struct('msq_rays_def', {
    struct_size: 'uint32_t',
    coordinate_type: 'int32_t',
    count: 'uint64_t',
    origins: 'void *',
    directions: 'void *',
    origin_stride: 'uint64_t',
    direction_stride: 'uint64_t',
    t_min: 'void *',
    t_max: 'void *',
  });
  T.msq_ray_hit = koffi.struct('msq_ray_hit', {
    t: 'double',
    normal: koffi.array('double', 3),
    scale: 'int32_t',
    starts_inside: 'int32_t',
    cell: koffi.array('int32_t', 3),
    material: 'uint32_t',
  });
  T.msq_camera = koffi.struct('msq_camera', {
    struct_size: 'uint32_t',
    projection: 'int32_t',
    eye: koffi.array('double', 3),
    target: koffi.array('double', 3),
    up: koffi.array('double', 3),
    height: 'double',
    field_of_view: 'double',
    clip_near: 'double',
    clip_far: 'double',
  });
  T.msq_render_def = koffi.struct('msq_render_def', {
    struct_size: 'uint32_t',
    width: 'uint32_t',
    height: 'uint32_t',
    tile_x: 'uint32_t',
    tile_y: 'uint32_t',
    tile_width: 'uint32_t',
    tile_height: 'uint32_t',
    samples: 'uint32_t',
    first_step: 'uint32_t',
    colour_by: 'int32_t',
    colours: 'void *',
    colour_count: 'uint64_t',
    background: koffi.array('double', 4),
    light: koffi.array('double', 3),
    ambient: 'double',
    shadows: 'int32_t',
    occlusion_rays: 'uint32_t',
    occlusion_distance: 'double',
  });
  T.msq_frame = koffi.struct('msq_frame', {
    struct_size: 'uint32_t',
    row_pixels: 'uint32_t',
    depth: 'void *',
    normal: 'void *',
    scale: 'void *',
    material: 'void *',
    rgba: 'void *',
  });
  T.msq_render_pass = koffi.struct('msq_render_pass', {
    struct_size: 'uint32_t',
    step: 'uint32_t',
    samples: 'uint32_t',
    is_last: 'int32_t',
  });
  T.msq_render_fn = koffi.proto('msq_render_fn', 'int32_t', ['void *', 'void *']);
  T.msq_document_def = koffi.struct('msq_document_def', {
    struct_size: 'uint32_t',
    files: 'int32_t',
    base_directory: 'str',
    max_bytes: 'uint64_t',
    max_values: 'uint64_t',
    max_depth: 'uint32_t',
    max_files: 'uint32_t',
    max_file_bytes: 'uint64_t',
    max_triangles: 'uint64_t',
  });
  T.msq_document_report = koffi.struct('msq_document_report', {
    struct_size: 'uint32_t',
    version: 'uint32_t',
    has_slicing: 'int32_t',
    has_view: 'int32_t',
    files: 'uint32_t',
    reserved: 'uint32_t',
    title: 'str',
  });
  T.msq_json_def = koffi.struct('msq_json_def', {
    struct_size: 'uint32_t',
    reserved: 'uint32_t',
    base_directory: 'str',
    title: 'str',
    slicing: 'void *',
    camera: 'void *',
    render: 'void *',
    max_numbers: 'uint64_t',
  });
  return T;
}

// Functions of a library that koffi has loaded.
export function functions(koffi, library, T) {
  return {
    msq_version: library.func('msq_version', 'uint32_t', []),
    msq_status_name: library.func('msq_status_name', 'str', ['int32_t']),
    msq_error_message: library.func('msq_error_message', 'str', []),
    msq_error_host_code: library.func('msq_error_host_code', 'int32_t', []),
    msq_build_info: library.func('msq_build_info', 'int32_t', [koffi.inout(koffi.pointer(T.msq_build_report))]),
    msq_context_def_init: library.func('msq_context_def_init', 'int32_t', [koffi.out(koffi.pointer(T.msq_context_def)), 'size_t']),
    msq_context_create: library.func('msq_context_create', 'int32_t', [koffi.pointer(T.msq_context_def), koffi.out(koffi.pointer('void *'))]),
    msq_context_retain: library.func('msq_context_retain', 'void', ['void *']),
    msq_context_release: library.func('msq_context_release', 'void', ['void *']),
    msq_context_memory: library.func('msq_context_memory', 'int32_t', ['void *', koffi.inout(koffi.pointer(T.msq_memory_report))]),
    msq_cache_stats: library.func('msq_cache_stats', 'int32_t', ['void *', koffi.inout(koffi.pointer(T.msq_cache_report))]),
    msq_cache_clear: library.func('msq_cache_clear', 'int32_t', ['void *']),
    msq_job_create: library.func('msq_job_create', 'int32_t', [koffi.out(koffi.pointer('void *'))]),
    msq_job_retain: library.func('msq_job_retain', 'void', ['void *']),
    msq_job_release: library.func('msq_job_release', 'void', ['void *']),
    msq_job_cancel: library.func('msq_job_cancel', 'int32_t', ['void *']),
    msq_job_progress: library.func('msq_job_progress', 'int32_t', ['void *', 'void *']),
    msq_job_info: library.func('msq_job_info', 'int32_t', ['void *', koffi.inout(koffi.pointer(T.msq_job_report))]),
    msq_neighbourhood_placed: library.func('msq_neighbourhood_placed', 'int32_t', [koffi.pointer(T.msq_neighbourhood), 'void *', koffi.out(koffi.pointer(T.msq_neighbourhood))]),
    msq_period_def_init: library.func('msq_period_def_init', 'int32_t', [koffi.out(koffi.pointer(T.msq_period_def)), 'size_t']),
    msq_warp_def_init: library.func('msq_warp_def_init', 'int32_t', [koffi.out(koffi.pointer(T.msq_warp_def)), 'size_t']),
    msq_file_def_init: library.func('msq_file_def_init', 'int32_t', [koffi.out(koffi.pointer(T.msq_file_def)), 'size_t']),
    msq_shape_from_file: library.func('msq_shape_from_file', 'int32_t', ['void *', 'str', koffi.pointer(T.msq_file_def), koffi.out(koffi.pointer('void *')), 'void *']),
    msq_shape_from_memory: library.func('msq_shape_from_memory', 'int32_t', ['void *', 'void *', 'uint64_t', koffi.pointer(T.msq_file_def), koffi.out(koffi.pointer('void *')), 'void *']),
    msq_mesh_def_init: library.func('msq_mesh_def_init', 'int32_t', [koffi.out(koffi.pointer(T.msq_mesh_def)), 'size_t']),
    msq_shape_from_mesh: library.func('msq_shape_from_mesh', 'int32_t', ['void *', koffi.pointer(T.msq_mesh_def), koffi.out(koffi.pointer('void *'))]),
    msq_shape_from_box: library.func('msq_shape_from_box', 'int32_t', ['void *', 'void *', 'void *', koffi.out(koffi.pointer('void *'))]),
    msq_shape_from_sphere: library.func('msq_shape_from_sphere', 'int32_t', ['void *', 'void *', 'double', koffi.out(koffi.pointer('void *'))]),
    msq_shape_from_cylinder: library.func('msq_shape_from_cylinder', 'int32_t', ['void *', 'void *', 'void *', 'double', koffi.out(koffi.pointer('void *'))]),
    msq_shape_all_space: library.func('msq_shape_all_space', 'int32_t', ['void *', koffi.out(koffi.pointer('void *'))]),
    msq_host_shape_def_init: library.func('msq_host_shape_def_init', 'int32_t', [koffi.out(koffi.pointer(T.msq_host_shape_def)), 'size_t']),
    msq_shape_from_host: library.func('msq_shape_from_host', 'int32_t', ['void *', koffi.pointer(T.msq_host_shape_def), koffi.out(koffi.pointer('void *'))]),
    msq_voxels_def_init: library.func('msq_voxels_def_init', 'int32_t', [koffi.out(koffi.pointer(T.msq_voxels_def)), 'size_t']),
    msq_shape_from_voxels: library.func('msq_shape_from_voxels', 'int32_t', ['void *', koffi.pointer(T.msq_voxels_def), koffi.out(koffi.pointer('void *'))]),
    msq_shape_placed: library.func('msq_shape_placed', 'int32_t', ['void *', 'void *', koffi.out(koffi.pointer('void *'))]),
    msq_shape_boolean: library.func('msq_shape_boolean', 'int32_t', ['int32_t', 'void *', 'uint64_t', koffi.out(koffi.pointer('void *'))]),
    msq_shape_offset: library.func('msq_shape_offset', 'int32_t', ['void *', 'double', koffi.out(koffi.pointer('void *'))]),
    msq_shape_retain: library.func('msq_shape_retain', 'void', ['void *']),
    msq_shape_release: library.func('msq_shape_release', 'void', ['void *']),
    msq_shape_info: library.func('msq_shape_info', 'int32_t', ['void *', koffi.inout(koffi.pointer(T.msq_shape_report))]),
    msq_shape_hash: library.func('msq_shape_hash', 'int32_t', ['void *', 'void *']),
    msq_shape_self_intersections: library.func('msq_shape_self_intersections', 'int32_t', ['void *', 'void *', 'void *']),
    msq_field_gradient: library.func('msq_field_gradient', 'int32_t', ['void *', 'void *', 'double', 'void *', 'double', koffi.out(koffi.pointer('void *'))]),
    msq_radial_field_def_init: library.func('msq_radial_field_def_init', 'int32_t', [koffi.out(koffi.pointer(T.msq_radial_field_def)), 'size_t']),
    msq_field_radial: library.func('msq_field_radial', 'int32_t', ['void *', koffi.pointer(T.msq_radial_field_def), koffi.out(koffi.pointer('void *'))]),
    msq_field_map: library.func('msq_field_map', 'int32_t', ['void *', 'void *', 'void *', 'uint64_t', koffi.out(koffi.pointer('void *'))]),
    msq_host_field_def_init: library.func('msq_host_field_def_init', 'int32_t', [koffi.out(koffi.pointer(T.msq_host_field_def)), 'size_t']),
    msq_field_host: library.func('msq_field_host', 'int32_t', ['void *', koffi.pointer(T.msq_host_field_def), koffi.out(koffi.pointer('void *'))]),
    msq_grid_field_def_init: library.func('msq_grid_field_def_init', 'int32_t', [koffi.out(koffi.pointer(T.msq_grid_field_def)), 'size_t']),
    msq_field_grid: library.func('msq_field_grid', 'int32_t', ['void *', koffi.pointer(T.msq_grid_field_def), koffi.out(koffi.pointer('void *'))]),
    msq_expression_field_def_init: library.func('msq_expression_field_def_init', 'int32_t', [koffi.out(koffi.pointer(T.msq_expression_field_def)), 'size_t']),
    msq_field_expression: library.func('msq_field_expression', 'int32_t', ['void *', koffi.pointer(T.msq_expression_field_def), koffi.out(koffi.pointer('void *'))]),
    msq_shape_distance_field_def_init: library.func('msq_shape_distance_field_def_init', 'int32_t', [koffi.out(koffi.pointer(T.msq_shape_distance_field_def)), 'size_t']),
    msq_field_shape_distance: library.func('msq_field_shape_distance', 'int32_t', ['void *', koffi.pointer(T.msq_shape_distance_field_def), koffi.out(koffi.pointer('void *')), 'void *']),
    msq_field_hash: library.func('msq_field_hash', 'int32_t', ['void *', 'void *']),
    msq_field_retain: library.func('msq_field_retain', 'void', ['void *']),
    msq_field_release: library.func('msq_field_release', 'void', ['void *']),
    msq_unit_cell_def_init: library.func('msq_unit_cell_def_init', 'int32_t', [koffi.out(koffi.pointer(T.msq_unit_cell_def)), 'size_t']),
    msq_unit_cell_info: library.func('msq_unit_cell_info', 'int32_t', [koffi.pointer(T.msq_unit_cell_def), koffi.inout(koffi.pointer(T.msq_unit_cell_report)), 'void *', 'uint64_t']),
    msq_unit_cell_geometry: library.func('msq_unit_cell_geometry', 'int32_t', [koffi.pointer(T.msq_unit_cell_def), 'void *', 'uint64_t', 'void *', 'uint64_t']),
    msq_lattice_def_init: library.func('msq_lattice_def_init', 'int32_t', [koffi.out(koffi.pointer(T.msq_lattice_def)), 'size_t']),
    msq_structure_lattice: library.func('msq_structure_lattice', 'int32_t', ['void *', koffi.pointer(T.msq_lattice_def), koffi.out(koffi.pointer('void *'))]),
    msq_lattice_faces: library.func('msq_lattice_faces', 'int32_t', ['void *', 'void *', 'void *', koffi.inout(koffi.pointer(T.msq_lattice_faces_report)), 'void *']),
    msq_plate_lattice_def_init: library.func('msq_plate_lattice_def_init', 'int32_t', [koffi.out(koffi.pointer(T.msq_plate_lattice_def)), 'size_t']),
    msq_structure_plate_lattice: library.func('msq_structure_plate_lattice', 'int32_t', ['void *', koffi.pointer(T.msq_plate_lattice_def), koffi.out(koffi.pointer('void *'))]),
    msq_foam_def_init: library.func('msq_foam_def_init', 'int32_t', [koffi.out(koffi.pointer(T.msq_foam_def)), 'size_t']),
    msq_structure_foam: library.func('msq_structure_foam', 'int32_t', ['void *', koffi.pointer(T.msq_foam_def), koffi.out(koffi.pointer('void *'))]),
    msq_functional_def_init: library.func('msq_functional_def_init', 'int32_t', [koffi.out(koffi.pointer(T.msq_functional_def)), 'size_t']),
    msq_structure_functional: library.func('msq_structure_functional', 'int32_t', ['void *', koffi.pointer(T.msq_functional_def), koffi.out(koffi.pointer('void *'))]),
    msq_waves_def_init: library.func('msq_waves_def_init', 'int32_t', [koffi.out(koffi.pointer(T.msq_waves_def)), 'size_t']),
    msq_structure_waves: library.func('msq_structure_waves', 'int32_t', ['void *', koffi.pointer(T.msq_waves_def), koffi.out(koffi.pointer('void *'))]),
    msq_beams_def_init: library.func('msq_beams_def_init', 'int32_t', [koffi.out(koffi.pointer(T.msq_beams_def)), 'size_t']),
    msq_structure_beams: library.func('msq_structure_beams', 'int32_t', ['void *', koffi.pointer(T.msq_beams_def), koffi.out(koffi.pointer('void *')), 'void *']),
    msq_beam_file_open: library.func('msq_beam_file_open', 'int32_t', ['void *', 'str', koffi.pointer(T.msq_file_def), koffi.out(koffi.pointer('void *')), 'void *']),
    msq_beam_file_open_memory: library.func('msq_beam_file_open_memory', 'int32_t', ['void *', 'void *', 'uint64_t', koffi.pointer(T.msq_file_def), koffi.out(koffi.pointer('void *')), 'void *']),
    msq_beam_file_retain: library.func('msq_beam_file_retain', 'void', ['void *']),
    msq_beam_file_release: library.func('msq_beam_file_release', 'void', ['void *']),
    msq_beam_file_info: library.func('msq_beam_file_info', 'int32_t', ['void *', 'uint64_t', koffi.inout(koffi.pointer(T.msq_beam_file_report))]),
    msq_beam_file_beams: library.func('msq_beam_file_beams', 'int32_t', ['void *', 'uint64_t', koffi.inout(koffi.pointer(T.msq_beams_def))]),
    msq_beam_file_shape: library.func('msq_beam_file_shape', 'int32_t', ['void *', 'void *', 'uint64_t', 'int32_t', 'int32_t', koffi.out(koffi.pointer('void *'))]),
    msq_host_structure_def_init: library.func('msq_host_structure_def_init', 'int32_t', [koffi.out(koffi.pointer(T.msq_host_structure_def)), 'size_t']),
    msq_structure_host: library.func('msq_structure_host', 'int32_t', ['void *', koffi.pointer(T.msq_host_structure_def), koffi.out(koffi.pointer('void *'))]),
    msq_host_function_def_init: library.func('msq_host_function_def_init', 'int32_t', [koffi.out(koffi.pointer(T.msq_host_function_def)), 'size_t']),
    msq_structure_host_function: library.func('msq_structure_host_function', 'int32_t', ['void *', koffi.pointer(T.msq_host_function_def), koffi.out(koffi.pointer('void *'))]),
    msq_structure_boolean: library.func('msq_structure_boolean', 'int32_t', ['int32_t', 'void *', 'uint64_t', koffi.out(koffi.pointer('void *'))]),
    msq_structure_blend: library.func('msq_structure_blend', 'int32_t', ['void *', 'void *', koffi.pointer(T.msq_param), koffi.out(koffi.pointer('void *'))]),
    msq_structure_smooth_boolean: library.func('msq_structure_smooth_boolean', 'int32_t', ['int32_t', 'void *', 'void *', koffi.pointer(T.msq_param), koffi.out(koffi.pointer('void *'))]),
    msq_structure_hash: library.func('msq_structure_hash', 'int32_t', ['void *', 'void *']),
    msq_structure_retain: library.func('msq_structure_retain', 'void', ['void *']),
    msq_structure_release: library.func('msq_structure_release', 'void', ['void *']),
    msq_struts_def_init: library.func('msq_struts_def_init', 'int32_t', [koffi.out(koffi.pointer(T.msq_struts_def)), 'size_t']),
    msq_structure_struts: library.func('msq_structure_struts', 'int32_t', ['void *', 'void *', koffi.pointer(T.msq_struts_def), koffi.pointer(T.msq_struts_fn), 'void *', 'void *']),
    msq_structure_strut_graph: library.func('msq_structure_strut_graph', 'int32_t', ['void *', 'void *', koffi.pointer(T.msq_struts_def), koffi.out(koffi.pointer('void *')), 'void *']),
    msq_strut_graph_retain: library.func('msq_strut_graph_retain', 'void', ['void *']),
    msq_strut_graph_release: library.func('msq_strut_graph_release', 'void', ['void *']),
    msq_strut_graph_info: library.func('msq_strut_graph_info', 'int32_t', ['void *', koffi.inout(koffi.pointer(T.msq_strut_graph_report))]),
    msq_material_def_init: library.func('msq_material_def_init', 'int32_t', [koffi.out(koffi.pointer(T.msq_material_def)), 'size_t']),
    msq_material_create: library.func('msq_material_create', 'int32_t', ['void *', koffi.pointer(T.msq_material_def), koffi.out(koffi.pointer('void *'))]),
    msq_material_blend: library.func('msq_material_blend', 'int32_t', ['void *', 'uint32_t', 'void *', 'void *', koffi.pointer(T.msq_param), koffi.out(koffi.pointer('void *'))]),
    msq_material_hash: library.func('msq_material_hash', 'int32_t', ['void *', 'void *']),
    msq_material_retain: library.func('msq_material_retain', 'void', ['void *']),
    msq_material_release: library.func('msq_material_release', 'void', ['void *']),
    msq_model_def_init: library.func('msq_model_def_init', 'int32_t', [koffi.out(koffi.pointer(T.msq_model_def)), 'size_t']),
    msq_model_create: library.func('msq_model_create', 'int32_t', ['void *', koffi.pointer(T.msq_model_def), koffi.out(koffi.pointer('void *'))]),
    msq_model_regions: library.func('msq_model_regions', 'int32_t', ['void *', 'void *', 'uint64_t', koffi.out(koffi.pointer('void *'))]),
    msq_model_hash: library.func('msq_model_hash', 'int32_t', ['void *', 'void *']),
    msq_model_retain: library.func('msq_model_retain', 'void', ['void *']),
    msq_model_release: library.func('msq_model_release', 'void', ['void *']),
    msq_model_bounds: library.func('msq_model_bounds', 'int32_t', ['void *', 'void *', 'void *']),
    msq_model_scale_length: library.func('msq_model_scale_length', 'int32_t', ['void *', 'uint32_t', 'void *']),
    msq_model_scale: library.func('msq_model_scale', 'int32_t', ['void *', 'uint32_t', 'uint32_t', koffi.out(koffi.pointer('void *')), koffi.out(koffi.pointer('void *'))]),
    msq_query_def_init: library.func('msq_query_def_init', 'int32_t', [koffi.out(koffi.pointer(T.msq_query_def)), 'size_t']),
    msq_points_def_init: library.func('msq_points_def_init', 'int32_t', [koffi.out(koffi.pointer(T.msq_points_def)), 'size_t']),
    msq_points_generate: library.func('msq_points_generate', 'int32_t', [koffi.pointer(T.msq_points_def), 'uint64_t', 'uint64_t', 'void *']),
    msq_point_membership: library.func('msq_point_membership', 'int32_t', ['void *', 'void *', koffi.pointer(T.msq_query_def), 'void *']),
    msq_set_membership: library.func('msq_set_membership', 'int32_t', ['void *', koffi.pointer(T.msq_points_def), koffi.pointer(T.msq_query_def), 'void *', 'uint64_t', 'void *']),
    msq_point_region: library.func('msq_point_region', 'int32_t', ['void *', 'void *', 'void *']),
    msq_set_region: library.func('msq_set_region', 'int32_t', ['void *', koffi.pointer(T.msq_points_def), 'void *', 'uint64_t', 'void *']),
    msq_point_material: library.func('msq_point_material', 'int32_t', ['void *', 'void *', koffi.pointer(T.msq_query_def), 'void *', 'uint64_t', 'void *', 'void *']),
    msq_set_material: library.func('msq_set_material', 'int32_t', ['void *', koffi.pointer(T.msq_points_def), koffi.pointer(T.msq_query_def), 'void *', 'uint64_t', 'void *', 'uint64_t', 'void *', 'uint64_t', 'void *']),
    msq_point_distance: library.func('msq_point_distance', 'int32_t', ['void *', 'void *', koffi.pointer(T.msq_query_def), 'void *']),
    msq_set_distance: library.func('msq_set_distance', 'int32_t', ['void *', koffi.pointer(T.msq_points_def), koffi.pointer(T.msq_query_def), 'void *', 'uint64_t', 'void *']),
    msq_set_onset: library.func('msq_set_onset', 'int32_t', ['void *', 'void *', koffi.pointer(T.msq_points_def), 'int32_t', 'void *', 'uint64_t', 'void *', 'uint64_t', 'void *']),
    msq_field_evaluate: library.func('msq_field_evaluate', 'int32_t', ['void *', 'void *', koffi.pointer(T.msq_points_def), 'void *', 'uint64_t', 'void *']),
    msq_volume_fraction: library.func('msq_volume_fraction', 'int32_t', ['void *', koffi.pointer(T.msq_points_def), koffi.pointer(T.msq_query_def), 'int32_t', koffi.out(koffi.pointer(T.msq_estimate)), 'void *']),
    msq_segments_def_init: library.func('msq_segments_def_init', 'int32_t', [koffi.out(koffi.pointer(T.msq_segments_def)), 'size_t']),
    msq_two_point_correlation: library.func('msq_two_point_correlation', 'int32_t', ['void *', koffi.pointer(T.msq_points_def), koffi.pointer(T.msq_query_def), koffi.pointer(T.msq_segments_def), 'void *', 'uint64_t', 'void *']),
    msq_lineal_path: library.func('msq_lineal_path', 'int32_t', ['void *', koffi.pointer(T.msq_points_def), koffi.pointer(T.msq_query_def), koffi.pointer(T.msq_segments_def), 'void *', 'uint64_t', 'void *']),
    msq_structure_calibrate: library.func('msq_structure_calibrate', 'int32_t', ['void *', 'void *', koffi.pointer(T.msq_points_def), 'double', 'void *', 'void *', 'uint64_t', koffi.inout(koffi.pointer(T.msq_calibration_report)), 'void *']),
    msq_contours_def_init: library.func('msq_contours_def_init', 'int32_t', [koffi.out(koffi.pointer(T.msq_contours_def)), 'size_t']),
    msq_output_def_init: library.func('msq_output_def_init', 'int32_t', [koffi.out(koffi.pointer(T.msq_output_def)), 'size_t']),
    msq_slicer_def_init: library.func('msq_slicer_def_init', 'int32_t', [koffi.out(koffi.pointer(T.msq_slicer_def)), 'size_t']),
    msq_slicer_create: library.func('msq_slicer_create', 'int32_t', ['void *', koffi.pointer(T.msq_slicer_def), koffi.out(koffi.pointer('void *'))]),
    msq_slicer_retain: library.func('msq_slicer_retain', 'void', ['void *']),
    msq_slicer_release: library.func('msq_slicer_release', 'void', ['void *']),
    msq_slicer_info: library.func('msq_slicer_info', 'int32_t', ['void *', koffi.inout(koffi.pointer(T.msq_slicer_report))]),
    msq_slicer_layer_z: library.func('msq_slicer_layer_z', 'int32_t', ['void *', 'uint64_t', 'void *']),
    msq_slicer_run: library.func('msq_slicer_run', 'int32_t', ['void *', 'uint64_t', 'uint64_t', koffi.pointer(T.msq_layer_fn), 'void *', 'void *']),
    msq_slice_layer: library.func('msq_slice_layer', 'int32_t', ['void *', 'uint64_t', 'void *', 'uint64_t', 'void *']),
    msq_layer_contours: library.func('msq_layer_contours', 'int32_t', ['void *', 'double', koffi.pointer(T.msq_contours_def), koffi.out(koffi.pointer('void *')), 'void *']),
    msq_slicer_contours: library.func('msq_slicer_contours', 'int32_t', ['void *', 'uint64_t', koffi.pointer(T.msq_contours_def), koffi.out(koffi.pointer('void *')), 'void *']),
    msq_contours_retain: library.func('msq_contours_retain', 'void', ['void *']),
    msq_contours_release: library.func('msq_contours_release', 'void', ['void *']),
    msq_contours_info: library.func('msq_contours_info', 'int32_t', ['void *', koffi.inout(koffi.pointer(T.msq_contours_report))]),
    msq_printability_def_init: library.func('msq_printability_def_init', 'int32_t', [koffi.out(koffi.pointer(T.msq_printability_def)), 'size_t']),
    msq_printability: library.func('msq_printability', 'int32_t', ['void *', koffi.pointer(T.msq_printability_def), koffi.pointer(T.msq_findings_fn), 'void *', koffi.inout(koffi.pointer(T.msq_printability_report)), 'void *']),
    msq_fill_def_init: library.func('msq_fill_def_init', 'int32_t', [koffi.out(koffi.pointer(T.msq_fill_def)), 'size_t']),
    msq_fill_lines: library.func('msq_fill_lines', 'int32_t', ['void *', 'void *', koffi.pointer(T.msq_fill_def), koffi.out(koffi.pointer('void *')), 'void *']),
    msq_fill_retain: library.func('msq_fill_retain', 'void', ['void *']),
    msq_fill_release: library.func('msq_fill_release', 'void', ['void *']),
    msq_fill_info: library.func('msq_fill_info', 'int32_t', ['void *', koffi.inout(koffi.pointer(T.msq_fill_report))]),
    msq_fill_calibrate: library.func('msq_fill_calibrate', 'int32_t', ['void *', 'void *', 'double', 'double', 'void *', 'void *']),
    msq_surface_def_init: library.func('msq_surface_def_init', 'int32_t', [koffi.out(koffi.pointer(T.msq_surface_def)), 'size_t']),
    msq_surface_mesh: library.func('msq_surface_mesh', 'int32_t', ['void *', koffi.pointer(T.msq_surface_def), koffi.pointer(T.msq_surface_fn), 'void *', 'void *']),
    msq_surface_file: library.func('msq_surface_file', 'int32_t', ['void *', koffi.pointer(T.msq_surface_def), 'int32_t', koffi.pointer(T.msq_file_fn), 'void *', 'void *']),
    msq_rays_def_init: library.func('msq_rays_def_init', 'int32_t', [koffi.out(koffi.pointer(T.msq_rays_def)), 'size_t']),
    msq_ray_cast: library.func('msq_ray_cast', 'int32_t', ['void *', koffi.pointer(T.msq_rays_def), koffi.pointer(T.msq_query_def), 'void *', 'uint64_t', 'void *']),
    msq_camera_init: library.func('msq_camera_init', 'int32_t', [koffi.out(koffi.pointer(T.msq_camera)), 'size_t']),
    msq_camera_fit: library.func('msq_camera_fit', 'int32_t', ['void *', 'void *', 'void *', 'uint32_t', 'uint32_t', koffi.inout(koffi.pointer(T.msq_camera))]),
    msq_camera_ray: library.func('msq_camera_ray', 'int32_t', [koffi.pointer(T.msq_camera), 'uint32_t', 'uint32_t', 'void *', 'void *', 'void *']),
    msq_render_def_init: library.func('msq_render_def_init', 'int32_t', [koffi.out(koffi.pointer(T.msq_render_def)), 'size_t']),
    msq_frame_init: library.func('msq_frame_init', 'int32_t', [koffi.out(koffi.pointer(T.msq_frame)), 'size_t']),
    msq_render: library.func('msq_render', 'int32_t', ['void *', koffi.pointer(T.msq_camera), koffi.pointer(T.msq_render_def), koffi.pointer(T.msq_query_def), koffi.pointer(T.msq_frame), koffi.pointer(T.msq_render_fn), 'void *', 'void *']),
    msq_document_def_init: library.func('msq_document_def_init', 'int32_t', [koffi.out(koffi.pointer(T.msq_document_def)), 'size_t']),
    msq_document_from_json: library.func('msq_document_from_json', 'int32_t', ['void *', 'str', 'uint64_t', koffi.pointer(T.msq_document_def), koffi.out(koffi.pointer('void *')), 'void *']),
    msq_document_from_file: library.func('msq_document_from_file', 'int32_t', ['void *', 'str', koffi.pointer(T.msq_document_def), koffi.out(koffi.pointer('void *')), 'void *']),
    msq_document_retain: library.func('msq_document_retain', 'void', ['void *']),
    msq_document_release: library.func('msq_document_release', 'void', ['void *']),
    msq_document_info: library.func('msq_document_info', 'int32_t', ['void *', koffi.inout(koffi.pointer(T.msq_document_report))]),
    msq_document_model: library.func('msq_document_model', 'int32_t', ['void *', koffi.out(koffi.pointer('void *'))]),
    msq_document_slicing: library.func('msq_document_slicing', 'int32_t', ['void *', koffi.inout(koffi.pointer(T.msq_slicer_def))]),
    msq_document_view: library.func('msq_document_view', 'int32_t', ['void *', koffi.inout(koffi.pointer(T.msq_camera)), koffi.inout(koffi.pointer(T.msq_render_def))]),
    msq_json_def_init: library.func('msq_json_def_init', 'int32_t', [koffi.out(koffi.pointer(T.msq_json_def)), 'size_t']),
    msq_model_to_json: library.func('msq_model_to_json', 'int32_t', ['void *', koffi.pointer(T.msq_json_def), 'void *', 'uint64_t', 'void *']),
  };
}
