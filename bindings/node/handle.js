// SPDX-License-Identifier: Apache-2.0
// Objects of msq, which release themselves.
import { inspect } from 'node:util';
import * as abi from './abi.js';
import { C, check } from './native.js';

const forgotten = new FinalizationRegistry(({ kind, pointer }) => C[`msq_${kind}_release`](pointer));

/** An object of msq. It is released by close(), or when it is collected. */
export class Handle {
  #kind;
  #pointer;
  /** create(handle) makes the object: it writes its address to handle[0] and returns a status. */
  constructor(kind, create) {
    const handle = [null];
    check(create(handle));
    this.#kind = kind;
    this.#pointer = handle[0];
    forgotten.register(this, { kind, pointer: this.#pointer }, this);
  }
  /** The name of its type in msq.h, without msq_. */
  get kind() {
    return this.#kind;
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

/** The address of an object, which must be of that kind and open. */
export function pointerOf(value, kind, name = kind) {
  if (!(value instanceof Handle))
    throw new TypeError(`${name} is ${inspect(value, { depth: 0, breakLength: Infinity })}; it must be a ${kind}`);
  if (value.kind !== kind) throw new TypeError(`${name} is a ${value.kind}; it must be a ${kind}`);
  return value.pointer;
}

/** Another handle of the same object. The object lives until both are closed. */
export function retained(handle) {
  const { kind, pointer } = handle;
  return new Handle(kind, (made) => {
    C[`msq_${kind}_retain`](pointer);
    made[0] = pointer;
    return abi.MSQ_OK;
  });
}
