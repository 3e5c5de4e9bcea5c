// SPDX-License-Identifier: Apache-2.0
// msq for Node: the C ABI through koffi, with handles that release themselves, statuses as errors, and
// layers by asynchronous iteration. MSQ_LIBRARY names the library if the loader does not find it.
import { Worker } from 'node:worker_threads';
import koffi from 'koffi';
import * as abi from './abi.js';

export * as abi from './abi.js';

const types = abi.types(koffi);
/** The functions of msq.h. */
export const C = abi.functions(koffi, koffi.load(process.env.MSQ_LIBRARY ?? 'libmsq.so.0'), types);
/** Structs and callbacks as types of koffi, for koffi.sizeof, koffi.decode and the like. */
export { types };

/** A call of msq failed. */
export class MsqError extends Error {
  constructor(status, message, hostCode = 0) {
    super(`${C.msq_status_name(status)}: ${message}`);
    this.name = 'MsqError';
    this.status = status;
    this.hostCode = hostCode;
  }
}

/** Throws what a status says. */
export function check(status) {
  if (status === abi.MSQ_OK) return;
  const code = status === abi.MSQ_E_HOST ? C.msq_error_host_code() : 0;
  throw new MsqError(status, C.msq_error_message(), code);
}

// Members that point to another definition.
const pointees = { period: 'period_def', warp: 'warp_def' };

// The definition that a member points to. Its bytes keep the arrays that it points to itself.
function pointee(name, values) {
  const struct = definition(name, name === 'period_def' ? graded(values) : values);
  const type = types[`msq_${name}`];
  const bytes = Buffer.alloc(koffi.sizeof(type));
  koffi.encode(bytes, type, struct);
  bytes.keeps = struct;
  return bytes;
}

// The positions and cell sizes of a period as memory, and how many there are.
function graded({ positions = [], cell_sizes = [], ...rest }) {
  const count = positions.length;
  if (cell_sizes.length !== count)
    throw new TypeError(`period has ${count} positions and ${cell_sizes.length} cell_sizes`);
  return { ...rest, count, positions: Float64Array.from(positions), cell_sizes: Float64Array.from(cell_sizes) };
}

function set(struct, values, name) {
  for (const [key, value] of Object.entries(values)) {
    if (!(key in struct)) throw new TypeError(`${name} has no member ${key}`);
    const old = struct[key];
    const isParam = old !== null && typeof old === 'object' && 'field' in old && 'value' in old;
    if (isParam && typeof value === 'number') old.value = value;
    else if (isParam && value instanceof Handle) old.field = value.pointer;
    else if (value instanceof Handle) struct[key] = value.pointer;
    else if (Object.getPrototypeOf(value ?? 0) !== Object.prototype) struct[key] = value;
    else if (key in pointees) struct[key] = pointee(pointees[key], value);
    else set(old, value, `${name}.${key}`);
  }
  return struct;
}

/** A definition with its defaults, changed by the values: definition('foam_def', { radius: 0.2 }). */
export function definition(name, values = {}) {
  const struct = {};
  check(C[`msq_${name}_init`](struct, koffi.sizeof(types[`msq_${name}`])));
  return set(struct, values, name);
}

// A number or a field, as a parameter beside a definition.
function param(value) {
  return value instanceof Handle ? { value: 0, field: value.pointer } : { value, field: null };
}

/** A report that msq has filled in: report('slicer_report', C.msq_slicer_info, slicer.pointer). */
export function report(name, call, ...before) {
  const type = types[`msq_${name}`];
  const struct = koffi.decode(Buffer.alloc(koffi.sizeof(type)), type);
  struct.struct_size = koffi.sizeof(type);
  check(call(...before, struct));
  return struct;
}

const forgotten = new FinalizationRegistry(({ kind, pointer }) => C[`msq_${kind}_release`](pointer));

/** An object of msq. It is released by close(), or when it is collected. */
export class Handle {
  #pointer;
  /** create(handle) makes the object: it writes its address to handle[0] and returns a status. */
  constructor(kind, create) {
    const handle = [null];
    check(create(handle));
    this.#pointer = handle[0];
    this.kind = kind;
    forgotten.register(this, { kind, pointer: this.#pointer }, this);
  }
  /** The address, for calls of C. */
  get pointer() {
    if (this.#pointer === null) throw new TypeError(`this ${this.kind} is closed`);
    return this.#pointer;
  }
  close() {
    if (this.#pointer === null) return;
    forgotten.unregister(this);
    C[`msq_${this.kind}_release`](this.#pointer);
    this.#pointer = null;
  }
}

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
      context.pointer, Float64Array.from(min), Float64Array.from(max), made));
  }
  static sphere(context, center, radius) {
    return new Shape('shape', (made) => C.msq_shape_from_sphere(
      context.pointer, Float64Array.from(center), radius, made));
  }
  /** Reads a mesh file in millimetres. */
  static fromFile(context, path) {
    return new Shape('shape', (made) => C.msq_shape_from_file(context.pointer, path, null, made, null));
  }
}

/** A field: a number at each point. */
export class Field extends Handle {
  static gradient(context, from, fromValue, to, toValue) {
    return new Field('field', (made) => C.msq_field_gradient(
      context.pointer, Float64Array.from(from), fromValue, Float64Array.from(to), toValue, made));
  }
  /** Samples, x fastest, at the origin of the grid + (i, j, k) cell_size. They are copied. */
  static grid(context, values, size, grid = {}) {
    if (values.length !== size[0] * size[1] * size[2])
      throw new TypeError(`there are ${values.length} values; size has ${size.join(' x ')}`);
    const image = { values: Float64Array.from(values), value_type: abi.MSQ_FLOAT64, size, grid };
    return new Field('field', (made) => C.msq_field_grid(context.pointer, definition('grid_field_def', { image }), made));
  }
}

/** A fine structure. The values are members of its definition in msq.h. */
export class Structure extends Handle {
  static #of(kind, context, values) {
    return new Structure('structure', (made) => C[`msq_structure_${kind}`](
      context.pointer, definition(`${kind}_def`, values), made));
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
    const pointers = BigUint64Array.from(structures, (structure) => structure.pointer);
    return new Structure('structure', (made) => C.msq_structure_boolean(
      operation, pointers, pointers.length, made));
  }
  /** With fillets of a radius. operation: an MSQ_BOOLEAN_*. */
  static smoothBoolean(operation, a, b, radius) {
    return new Structure('structure', (made) => C.msq_structure_smooth_boolean(
      operation, a.pointer, b.pointer, param(radius), made));
  }
  /** Becomes b as the fraction goes from 0 to 1. */
  static blend(a, b, fraction) {
    return new Structure('structure', (made) => C.msq_structure_blend(a.pointer, b.pointer, param(fraction), made));
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
      koffi.encode(scales, size * index, types.msq_scale_def, set(scale, part, 'scale_def'));
    });
    return new Model('model', (made) => C.msq_model_create(
      context.pointer,
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
    const inside = new Uint8Array(triples.length / 3);
    check(C.msq_set_membership(this.pointer, this.#points(triples), null, inside, inside.length, null));
    return inside;
  }
  /** Signed distances, positive outside, never too large in magnitude. */
  distance(triples) {
    const distances = new Float64Array(triples.length / 3);
    check(C.msq_set_distance(this.pointer, this.#points(triples), null, distances, distances.length, null));
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
    const bytes = Buffer.byteLength(text);
    return new Document('document', (made) => C.msq_document_from_json(
      context.pointer, text, bytes, null, made, null));
  }
  static fromFile(context, path) {
    return new Document('document', (made) => C.msq_document_from_file(
      context.pointer, path, null, made, null));
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
    super('slicer', (made) => C.msq_slicer_create(model.pointer, values, made));
    this.info = report('slicer_report', C.msq_slicer_info, this.pointer);
    this.layerCount = Number(this.info.layer_count);
  }
  /** Layers in order, each { index, z, width, height, stride, insideCount, data }. Another thread computes
   * them, at most `ahead` layers ahead of the loop; the event loop is free meanwhile. A loop that is left stops it. */
  async *layers(first = 0, count = this.layerCount - first, { ahead = 16 } = {}) {
    const job = new Job();
    const taken = new Int32Array(new SharedArrayBuffer(4)); // layers that the loop has taken
    const arrived = [];
    let wake = () => {};
    let failure, over = false;
    const worker = new Worker(new URL('./layers.js', import.meta.url), {
      workerData: { slicer: this.pointer, job: job.pointer, first, count, ahead, taken },
    });
    worker.on('message', (message) => { arrived.push(message); wake(); });
    worker.on('error', (error) => { failure = error; wake(); });
    const ended = new Promise((resolve) => {
      worker.on('exit', () => { over = true; wake(); resolve(); });
    });
    try {
      for (;;) {
        while (arrived.length === 0 && !over && !failure)
          await new Promise((resolve) => { wake = resolve; });
        if (failure) throw failure;
        if (arrived.length === 0) return;
        const { layer, status, text } = arrived.shift();
        if (status !== undefined) throw new MsqError(status, text);
        Atomics.add(taken, 0, 1);
        Atomics.notify(taken, 0);
        yield layer;
      }
    } finally {
      if (!over) {
        job.cancel();
        Atomics.store(taken, 0, 0x7fffffff); // the thread waits for nobody any more
        Atomics.notify(taken, 0);
      }
      await ended; // this slicer and the job live until then
      job.close();
    }
  }
}
