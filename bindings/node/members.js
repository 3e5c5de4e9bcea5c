// SPDX-License-Identifier: Apache-2.0
// What the members of definitions point to, which msq.h says in words: objects, definitions, and arrays.
import * as abi from './abi.js';

/** Kinds of the objects that members point to. */
export const objects = {
  msq_param: { field: 'field' },
  msq_scale_def: { shape: 'shape', structure: 'structure', material: 'material', skin_material: 'material' },
  msq_shape_distance_field_def: { shape: 'shape' },
  msq_struts_def: { shape: 'shape' },
  msq_warp_def: { u: 'field', v: 'field', w: 'field' },
};

/** Definitions that members point to, which may be given as values. */
export const definitions = { period: 'period_def', warp: 'warp_def' };

const scalars = {
  [abi.MSQ_FLOAT32]: Float32Array, [abi.MSQ_FLOAT64]: Float64Array, [abi.MSQ_UINT8]: Uint8Array,
  [abi.MSQ_INT16]: Int16Array, [abi.MSQ_UINT16]: Uint16Array, [abi.MSQ_INT32]: Int32Array,
  [abi.MSQ_INT64]: BigInt64Array,
};
const byMember = (member) => (struct) => scalars[struct[member]];
const coordinates = byMember('coordinate_type');
const doubles = () => Float64Array;
const indices = () => Uint32Array;
const bytes = () => Uint8Array;

// The bytes that C reads of `count` elements of `each` scalars. A stride of 0 means tightly packed.
function span(struct, count, stride, size) {
  const elements = Number(struct[count]);
  return elements === 0 ? 0 : (elements - 1) * (Number(struct[stride] ?? 0) || size) + size;
}
function scalarArray(element, count, each = 1, stride = '') {
  return { element, extent: (struct, size) => span(struct, count, stride, each * size) };
}
function structArray(name, count, stride = '') {
  return { struct: name, extent: (struct, size) => span(struct, count, stride, size) };
}

// The bytes that C reads of an image.
function imageExtent({ size, row_stride, layer_stride }, scalar) {
  const [columns, rows, layers] = Array.from(size, Number);
  if (columns * rows * layers === 0) return 0;
  const row = Number(row_stride) || columns * scalar;
  const layer = Number(layer_stride) || rows * row;
  return (layers - 1) * layer + (rows - 1) * row + columns * scalar;
}

const cell = {
  nodes: scalarArray(doubles, 'node_count', 3),
  struts: scalarArray(indices, 'strut_count', 2),
  strut_factors: scalarArray(doubles, 'strut_count'),
};

/** Arrays that members point to: element(struct) is the typed array of their scalars, or `struct` the name of
 * their structs, and extent(struct, size) the bytes that C reads with elements of that size. */
export const arrays = {
  msq_beams_def: {
    nodes: scalarArray(coordinates, 'node_count', 3, 'node_stride'),
    beams: scalarArray(indices, 'beam_count', 2, 'beam_stride'),
    radii: scalarArray(coordinates, 'beam_count', 2, 'radius_stride'),
    caps: scalarArray(bytes, 'beam_count', 2, 'cap_stride'),
    balls: scalarArray(indices, 'ball_count', 1, 'ball_stride'),
    ball_radii: scalarArray(coordinates, 'ball_count', 1, 'ball_radius_stride'),
  },
  msq_expression_field_def: { parameters: structArray('msq_named_value', 'parameter_count') },
  msq_fill_def: { rings: structArray('msq_ring', 'ring_count') },
  msq_functional_def: { parameters: structArray('msq_named_value', 'parameter_count') },
  msq_image: { values: { element: byMember('value_type'), extent: imageExtent } },
  msq_lattice_def: { ...cell, cells: structArray('msq_unit_cell_def', 'cell_count') },
  msq_material_def: { channels: structArray('msq_channel', 'channel_count') },
  msq_mesh_def: {
    vertices: scalarArray(coordinates, 'vertex_count', 3, 'vertex_stride'),
    triangles: scalarArray(indices, 'triangle_count', 3),
  },
  msq_model_def: { scales: structArray('msq_scale_def', 'scale_count', 'scale_size') },
  msq_period_def: { positions: scalarArray(doubles, 'count'), cell_sizes: scalarArray(doubles, 'count') },
  msq_plate_lattice_def: {
    ...cell,
    faces: scalarArray(indices, 'face_count', 3),
    face_factors: scalarArray(doubles, 'face_count'),
  },
  msq_points_def: { coordinates: scalarArray(coordinates, 'count', 3, 'stride') },
  msq_rays_def: {
    origins: scalarArray(coordinates, 'count', 3, 'origin_stride'),
    directions: scalarArray(coordinates, 'count', 3, 'direction_stride'),
    t_min: scalarArray(doubles, 'count'),
    t_max: scalarArray(doubles, 'count'),
  },
  msq_render_def: { colours: scalarArray(doubles, 'colour_count', 3) },
  msq_segments_def: { lengths: scalarArray(doubles, 'length_count') },
  msq_shape_distance_field_def: { curve: scalarArray(doubles, 'curve_count', 2) },
  msq_slicer_def: {
    layer_z: scalarArray(doubles, 'layer_z_count'),
    outputs: structArray('msq_output_def', 'output_count'),
  },
  msq_unit_cell_def: cell,
};
