// SPDX-License-Identifier: Apache-2.0
// Structs of msq.h: definitions with defaults, and reports.
import koffi from 'koffi';
import { checkValue, numbers } from './checks.js';
import { Handle, pointerOf } from './handle.js';
import { definitions, objects } from './members.js';
import { C, check } from './native.js';
import { types } from './types.js';

/** Writes a struct to memory for C. */
export function encode(bytes, offset, name, struct) {
  const type = types[`msq_${name}`];
  checkValue(struct, name, type);
  koffi.encode(bytes, offset, type, struct);
}

// The definition that a member points to. Its bytes keep the arrays that it points to itself.
function pointee(name, values) {
  const struct = definition(name, name === 'period_def' ? graded(values) : values);
  const bytes = Buffer.alloc(koffi.sizeof(types[`msq_${name}`]));
  encode(bytes, 0, name, struct);
  bytes.keeps = struct;
  return bytes;
}

// The positions and cell sizes of a period as memory, and how many there are.
function graded({ positions = [], cell_sizes = [], ...rest }) {
  const known = { positions: numbers(positions, 'positions'), cell_sizes: numbers(cell_sizes, 'cell_sizes') };
  const count = positions.length;
  if (cell_sizes.length !== count)
    throw new TypeError(`period has ${count} positions and ${cell_sizes.length} cell_sizes`);
  return { ...rest, ...known, count };
}

function isValues(value) {
  return typeof value === 'object' && value !== null && Object.getPrototypeOf(value) === Object.prototype;
}

// What C gets for the value of a member.
function converted(struct, key, value, name, owner) {
  const { type } = owner.members[key];
  if (type.name === 'msq_param' && !isValues(value)) return param(value, name);
  if (value instanceof Handle) return pointerOf(value, objects[owner.name]?.[key] ?? 'plain value', name);
  if (type.primitive === 'Record' && isValues(value)) return set(struct[key], value, name, type);
  if (key in definitions && isValues(value)) return pointee(definitions[key], value);
  // koffi would copy the bytes of a typed array, whatever its type.
  return type.primitive === 'Array' && ArrayBuffer.isView(value) ? Array.from(value) : value;
}

/** Changes members of a struct by values. undefined leaves a member as it is. */
export function set(struct, values, name, type = types[`msq_${name}`]) {
  if (!isValues(values)) throw new TypeError(`${name} needs an object of values`);
  for (const [key, value] of Object.entries(values)) {
    if (!Object.hasOwn(type.members, key)) throw new TypeError(`${name} has no member ${key}`);
    if (value !== undefined) struct[key] = converted(struct, key, value, `${name}.${key}`, type);
  }
  return struct;
}

/** A definition with its defaults, changed by the values: definition('foam_def', { radius: 0.2 }). */
export function definition(name, values = {}) {
  const struct = {};
  const type = types[`msq_${name}`];
  check(C[`msq_${name}_init`](struct, koffi.sizeof(type)));
  set(struct, values, name);
  checkValue(struct, name, type);
  return struct;
}

/** A number or a field, as a parameter. */
export function param(value, name) {
  if (typeof value === 'number') return { value, field: null };
  if (value instanceof Handle) return { value: 0, field: pointerOf(value, 'field', name) };
  throw new TypeError(`${name} is ${String(value)}; it must be a number or a field`);
}

/** A report that msq has filled in: report('slicer_report', C.msq_slicer_info, slicer.pointer). */
export function report(name, call, ...before) {
  const type = types[`msq_${name}`];
  const struct = koffi.decode(Buffer.alloc(koffi.sizeof(type)), type);
  struct.struct_size = koffi.sizeof(type);
  check(call(...before, struct));
  return struct;
}
