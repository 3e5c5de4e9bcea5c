// SPDX-License-Identifier: Apache-2.0
// Checks of values before C gets them. koffi wraps and truncates integers, and C reads beyond short arrays.
import { inspect, types as are } from 'node:util';
import { arrays } from './members.js';
import { types } from './types.js';

const signed = (bits) => [-(2n ** (bits - 1n)), 2n ** (bits - 1n) - 1n];
const unsigned = (bits) => [0n, 2n ** bits - 1n];
const limits = {
  Int8: signed(8n), Int16: signed(16n), Int32: signed(32n), Int64: signed(64n),
  UInt8: unsigned(8n), UInt16: unsigned(16n), UInt32: unsigned(32n), UInt64: unsigned(64n),
};
// koffi copies the bytes of typed arrays.
const views = {
  Int32: Int32Array, Int64: BigInt64Array, UInt8: Uint8Array, UInt32: Uint32Array, UInt64: BigUint64Array,
  Float64: Float64Array,
};

function shown(value) {
  return inspect(value, { depth: 0, maxArrayLength: 4, maxStringLength: 60, breakLength: Infinity });
}

function refuse(value, name, wanted, Refusal = TypeError) {
  throw new Refusal(`${name} is ${shown(value)}; it must be ${wanted}`);
}

/** Refuses what is no integer from min to max. A Number beyond 2^53 may have been rounded, so it is none. */
export function checkInteger(value, name, min, max) {
  const isInteger = typeof value === 'bigint' || Number.isSafeInteger(value);
  if (isInteger && value >= min && value <= max) return;
  const wide = max > Number.MAX_SAFE_INTEGER ? ', a BigInt beyond 2^53 - 1' : '';
  const isNumeric = typeof value === 'number' || typeof value === 'bigint';
  refuse(value, name, `an integer from ${min} to ${max}${wide}`, isNumeric ? RangeError : TypeError);
}

function checkNumber(value, name) {
  if (typeof value !== 'number') refuse(value, name, 'a number');
}

/** Refuses a text with a zero byte, where C would end it. */
export function checkText(value, name) {
  if (typeof value !== 'string') refuse(value, name, 'a text');
  const end = value.indexOf('\0');
  if (end >= 0) throw new TypeError(`${name} has \\0 at position ${end}, where C would end the text`);
}

function checkLength(values, name, length) {
  if (typeof values !== 'object' || typeof values?.length !== 'number') refuse(values, name, 'an array');
  if (values.length !== length) throw new TypeError(`${name} has ${values.length} elements; it must have ${length}`);
}

/** A copy of an array of numbers for C. */
export function numbers(values, name, length = values?.length) {
  checkLength(values, name, length);
  const wrong = Array.prototype.findIndex.call(values, (value) => typeof value !== 'number');
  if (wrong >= 0) refuse(values[wrong], `${name}[${wrong}]`, 'a number');
  return Float64Array.from(values);
}

/** A copy of x, y and z for C. */
export function vector3(values, name) {
  return numbers(values, name, 3);
}

// Memory of JavaScript, of which C gets the address.
function isMemory(value) {
  return ArrayBuffer.isView(value) || are.isAnyArrayBuffer(value);
}

// The memory of an array member holds what C reads. How much an address holds is not known.
function checkMemory(struct, value, name, { element, struct: structName, extent }) {
  if (!isMemory(value)) return;
  const View = element ? element(struct) : Uint8Array;
  if (!View) return; // msq refuses the type of the scalars
  const isBytes = !are.isTypedArray(value) || value instanceof Uint8Array;
  if (!isBytes && !(value instanceof View)) refuse(value, name, `a ${View.name}, or bytes`);
  const bytes = extent(struct, structName ? types[structName].size : View.BYTES_PER_ELEMENT);
  if (value.byteLength < bytes) throw new RangeError(`${name} has ${value.byteLength} bytes; C reads ${bytes}`);
}

function checkRecord(value, name, type) {
  if (typeof value !== 'object' || value === null) refuse(value, name, `the values of ${type.name}`);
  for (const [key, member] of Object.entries(type.members))
    if (value[key] !== undefined) checkValue(value[key], `${name}.${key}`, member.type); // C gets 0 for undefined
  for (const [key, array] of Object.entries(arrays[type.name] ?? {}))
    checkMemory(value, value[key], `${name}.${key}`, array);
}

function checkArray(values, name, type) {
  checkLength(values, name, type.length);
  const View = views[type.ref.primitive];
  if (are.isTypedArray(values) && !(values instanceof View)) refuse(values, name, `an array, or a ${View.name}`);
  Array.from(values).forEach((value, index) => checkValue(value, `${name}[${index}]`, type.ref));
}

// An address, memory, what koffi.as() makes, or the values of a struct.
function checkPointer(value, name, { ref }) {
  const isAddress = (value ?? null) === null || typeof value === 'bigint' || are.isExternal(value);
  if (isAddress || isMemory(value)) return;
  if (ref.primitive === 'Record') checkRecord(value, name, ref);
  else refuse(value, name, 'a typed array, bytes or an address');
}

/** Refuses a value that does not fit a type of koffi. */
export function checkValue(value, name, type) {
  if (type.primitive in limits) checkInteger(value, name, ...limits[type.primitive]);
  else if (type.primitive.startsWith('Float')) checkNumber(value, name);
  else if (type.primitive === 'String' && value !== null) checkText(value, name);
  else if (type.primitive === 'Record') checkRecord(value, name, type);
  else if (type.primitive === 'Array') checkArray(value, name, type);
  else if (type.primitive === 'Pointer') checkPointer(value, name, type);
}
