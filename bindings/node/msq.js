// SPDX-License-Identifier: Apache-2.0
// msq for Node: the C ABI through koffi, with handles that release themselves, statuses as errors, and
// layers by asynchronous iteration. What does not fit the types of C is refused before the call.
import koffi from 'koffi';
import * as abi from './abi.js';
import { checkInteger, checkText, numbers, vector3 } from './checks.js';
import { definition, encode, param, report, set } from './definition.js';
import { Handle, pointerOf } from './handle.js';
import { LayerThread } from './layer_thread.js';
import { C, check } from './native.js';
import { types } from './types.js';

export * as abi from './abi.js';
export { definition, report } from './definition.js';
export { Handle } from './handle.js';
export { C, MsqError, check } from './native.js';
/** Structs and callbacks as types of koffi, for koffi.sizeof, koffi.decode and the like. */
export { types } from './types.js';

/** Threads, cell cache and memory limit. */
export class Context extends Handle {
  constructor(values = {}) {
    super('context', (made) => C.msq_context_create(definition('context_def', values), made));
  }
}

/** Progress and cancellation of one long call. */
export class Job extends Handle {
  constructor() {
    super('job', (made) => C.msq_job_create(made));
  }
  cancel() {
    check(C.msq_job_cancel(this.pointer));
  }
  /** 0 to 1. */
  get progress() {
    const fraction = new Float64Array(1);
    check(C.msq_job_progress(this.pointer, fraction));
    return fraction[0];
  }
}

/** A coarse solid. */
export class Shape extends Handle {
  static box(context, min, max) {
    return new Shape('shape', (made) => C.msq_shape_from_box(
      pointerOf(context, 'context'), vector3(min, 'min'), vector3(max, 'max'), made));
  }
  static sphere(context, center, radius) {
    return new Shape('shape', (made) => C.msq_shape_from_sphere(
      pointerOf(context, 'context'), vector3(center, 'center'), radius, made));
  }
  /** Reads a mesh file in millimetres. */
  static fromFile(context, path) {
    checkText(path, 'path');
    return new Shape('shape', (made) => C.msq_shape_from_file(pointerOf(context, 'context'), path, null, made, null));
  }
}

/** A field: a number at each point. */
export class Field extends Handle {
  static gradient(context, from, fromValue, to, toValue) {
    return new Field('field', (made) => C.msq_field_gradient(
      pointerOf(context, 'context'), vector3(from, 'from'), fromValue, vector3(to, 'to'), toValue, made));
  }
  /** Samples, x fastest, at the origin of the grid + (i, j, k) cell_size. They are copied. */
  static grid(context, values, size, grid = {}) {
    const samples = numbers(values, 'values');
    const [columns, rows, layers] = vector3(size, 'size');
    if (samples.length !== columns * rows * layers)
      throw new TypeError(`there are ${samples.length} values; size has ${columns} x ${rows} x ${layers}`);
    const image = { values: samples, value_type: abi.MSQ_FLOAT64, size, grid };
    return new Field('field', (made) => C.msq_field_grid(
      pointerOf(context, 'context'), definition('grid_field_def', { image }), made));
  }
}

/** A fine structure. The values are members of its definition in msq.h. */
export class Structure extends Handle {
  static #of(kind, context, values) {
    return new Structure('structure', (made) => C[`msq_structure_${kind}`](
      pointerOf(context, 'context'), definition(`${kind}_def`, values), made));
  }
  static lattice(context, values) {
    return Structure.#of('lattice', context, values);
  }
  static foam(context, values) {
    return Structure.#of('foam', context, values);
  }
  static functional(context, values) {
    return Structure.#of('functional', context, values);
  }
  static plateLattice(context, values) {
    return Structure.#of('plate_lattice', context, values);
  }
  /** operation: an MSQ_BOOLEAN_*. */
  static boolean(operation, structures) {
    const pointers = BigUint64Array.from(
      structures, (structure, index) => pointerOf(structure, 'structure', `structures[${index}]`));
    return new Structure('structure', (made) => C.msq_structure_boolean(
      operation, pointers, pointers.length, made));
  }
  /** With fillets of a radius. operation: an MSQ_BOOLEAN_*. */
  static smoothBoolean(operation, a, b, radius) {
    return new Structure('structure', (made) => C.msq_structure_smooth_boolean(
      operation, pointerOf(a, 'structure', 'a'), pointerOf(b, 'structure', 'b'), param(radius, 'radius'),
      made));
  }
  /** Becomes b as the fraction goes from 0 to 1. */
  static blend(a, b, fraction) {
    return new Structure('structure', (made) => C.msq_structure_blend(
      pointerOf(a, 'structure', 'a'), pointerOf(b, 'structure', 'b'), param(fraction, 'fraction'), made));
  }
}

/** A shape, filled with structures from coarse to fine. */
export class Model extends Handle {
  /** A structure, or { structure, skin } with the thickness of the skin that it leaves. */
  static of(context, shape, structures = []) {
    const parts = [{ shape }, ...structures.map((one) => (one instanceof Handle ? { structure: one } : one))];
    const size = koffi.sizeof(types.msq_scale_def);
    const scales = Buffer.alloc(size * parts.length);
    parts.forEach((part, index) => {
      const scale = koffi.decode(scales, size * index, types.msq_scale_def);
      encode(scales, size * index, 'scale_def', set(scale, part, 'scale_def'));
    });
    return new Model('model', (made) => C.msq_model_create(
      pointerOf(context, 'context'),
      definition('model_def', { scales, scale_count: parts.length, scale_size: size }),
      made));
  }
  /** 32 hexadecimal digits, equal for equal models. */
  get hash() {
    const hash = Buffer.alloc(16);
    check(C.msq_model_hash(this.pointer, hash));
    return hash.toString('hex');
  }
  /** Smallest and largest corner. */
  get bounds() {
    const [min, max] = [new Float64Array(3), new Float64Array(3)];
    check(C.msq_model_bounds(this.pointer, min, max));
    return [Array.from(min), Array.from(max)];
  }
  #points(triples) {
    if (!(triples instanceof Float64Array) || triples.length % 3 !== 0)
      throw new TypeError('points are a Float64Array of x, y, z, x, y, z ...');
    return definition('points_def', {
      kind: abi.MSQ_POINTS_ARRAY, coordinate_type: abi.MSQ_FLOAT64, coordinates: triples, count: triples.length / 3,
    });
  }
  /** A byte for each point: 1 inside, 0 outside. */
  membership(triples) {
    const points = this.#points(triples);
    const inside = new Uint8Array(triples.length / 3);
    check(C.msq_set_membership(this.pointer, points, null, inside, inside.length, null));
    return inside;
  }
  /** Signed distances, positive outside, never too large in magnitude. */
  distance(triples) {
    const points = this.#points(triples);
    const distances = new Float64Array(triples.length / 3);
    check(C.msq_set_distance(this.pointer, points, null, distances, distances.length, null));
    return distances;
  }
  /** Layers; the values are members of msq_slicer_def. */
  slicer(values) {
    return new Slicer(this, definition('slicer_def', values));
  }
}

/** A model with settings for slices, from JSON. */
export class Document extends Handle {
  static fromJson(context, text) {
    checkText(text, 'text');
    const bytes = Buffer.byteLength(text);
    return new Document('document', (made) => C.msq_document_from_json(
      pointerOf(context, 'context'), text, bytes, null, made, null));
  }
  static fromFile(context, path) {
    checkText(path, 'path');
    return new Document('document', (made) => C.msq_document_from_file(
      pointerOf(context, 'context'), path, null, made, null));
  }
  get title() {
    return report('document_report', C.msq_document_info, this.pointer).title;
  }
  model() {
    return new Model('model', (made) => C.msq_document_model(this.pointer, made));
  }
  slicer() {
    const values = definition('slicer_def');
    check(C.msq_document_slicing(this.pointer, values));
    return new Slicer(this.model(), values);
  }
}

/** Layers of a model. */
export class Slicer extends Handle {
  constructor(model, values) {
    super('slicer', (made) => C.msq_slicer_create(pointerOf(model, 'model'), values, made));
    this.info = report('slicer_report', C.msq_slicer_info, this.pointer);
    this.layerCount = Number(this.info.layer_count);
  }
  /** Layers in order, each { index, z, width, height, stride, insideCount, data }. Another thread computes
   * them, at most `ahead` layers (1 or more) ahead of the loop; the event loop is free meanwhile. A loop that is
   * left stops it. The slicer may be closed meanwhile. An iterator keeps the program alive only while it waits for
   * a layer. Call return() on one that is not finished: its thread waits for it. */
  layers(first = 0, count = undefined, { ahead = 16 } = {}) {
    checkInteger(first, 'first', 0, this.layerCount);
    const rest = this.layerCount - Number(first);
    checkInteger(count ?? rest, 'count', 0, 2n ** 64n - 1n);
    checkInteger(ahead, 'ahead', 1, 2 ** 31 - 1);
    return this.#run(first, count ?? rest, Number(ahead));
  }
  async *#run(first, count, ahead) {
    const thread = new LayerThread(this, first, count, ahead);
    try {
      for (let layer = await thread.next(); layer; layer = await thread.next()) yield layer;
    } finally {
      await thread.stop();
    }
  }
}
