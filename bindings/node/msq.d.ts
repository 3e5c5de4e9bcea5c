// SPDX-License-Identifier: Apache-2.0
// Types of msq.js, which documents what each part does.
import type { Definitions, Functions, Reports, msq_param, msq_slicer_report } from './abi.js';

export * as abi from './abi.js';
/** They refuse integers, texts and structs that do not fit. What an address points to, and how much memory C writes,
 * is not checked. */
export declare const C: Functions;
export declare const types: Record<string, unknown>;

export declare class MsqError extends Error {
  readonly status: number;
  readonly hostCode: number;
}
export declare function check(status: number): void;

/** A graded period: as many cell sizes as positions. */
export interface Period {
  axis?: number;
  positions: ArrayLike<number>;
  cell_sizes: ArrayLike<number>;
}
/** Values for some members of a definition. A number or a field may stand for a parameter, an object of
 * msq for its address, and values for a definition that a member points to. */
export type Values<T> = {
  [K in keyof T]?: K extends 'period' ? T[K] | Period
    : K extends 'warp' ? T[K] | Values<Definitions['warp_def']>
    : T[K] extends msq_param ? number | Field | msq_param
    : T[K] extends ArrayLike<number> ? ArrayLike<number>
    : T[K] extends object ? Values<T[K]> | Extract<T[K], ArrayBufferView | ArrayBuffer>
    : T[K] | Handle;
};
export declare function definition<N extends keyof Definitions>(
  name: N, values?: Values<Definitions[N]>): Definitions[N];
export declare function report<N extends keyof Reports>(
  name: N, call: (...args: any[]) => number, ...before: unknown[]): Reports[N];

export type Vector = readonly [number, number, number];

/** An argument of another kind, or a closed one, is refused with a TypeError. */
export declare class Handle {
  readonly kind: string;
  get pointer(): bigint;
  close(): void;
}
export declare class Context extends Handle {
  readonly kind: 'context';
  constructor(values?: Values<Definitions['context_def']>);
}
export declare class Job extends Handle {
  readonly kind: 'job';
  constructor();
  cancel(): void;
  get progress(): number;
}
export declare class Shape extends Handle {
  readonly kind: 'shape';
  private constructor();
  static box(context: Context, min: Vector, max: Vector): Shape;
  static sphere(context: Context, center: Vector, radius: number): Shape;
  static fromFile(context: Context, path: string): Shape;
}
export declare class Field extends Handle {
  readonly kind: 'field';
  private constructor();
  static gradient(context: Context, from: Vector, fromValue: number, to: Vector, toValue: number): Field;
  static grid(context: Context, values: ArrayLike<number>, size: Vector,
              grid?: { origin?: Vector; cell_size?: Vector; rotation?: ArrayLike<number> }): Field;
}
export declare class Structure extends Handle {
  readonly kind: 'structure';
  private constructor();
  static lattice(context: Context, values: Values<Definitions['lattice_def']>): Structure;
  static foam(context: Context, values: Values<Definitions['foam_def']>): Structure;
  static functional(context: Context, values: Values<Definitions['functional_def']>): Structure;
  static plateLattice(context: Context, values: Values<Definitions['plate_lattice_def']>): Structure;
  static boolean(operation: number, structures: readonly Structure[]): Structure;
  static smoothBoolean(operation: number, a: Structure, b: Structure, radius: number | Field): Structure;
  static blend(a: Structure, b: Structure, fraction: number | Field): Structure;
}
export declare class Model extends Handle {
  readonly kind: 'model';
  private constructor();
  static of(context: Context, shape: Shape,
            structures?: readonly (Structure | { structure: Structure; skin?: number | Field })[]): Model;
  get hash(): string;
  get bounds(): [number[], number[]];
  membership(triples: Float64Array): Uint8Array;
  distance(triples: Float64Array): Float64Array;
  slicer(values: Values<Definitions['slicer_def']>): Slicer;
}
export declare class Document extends Handle {
  readonly kind: 'document';
  private constructor();
  static fromJson(context: Context, text: string): Document;
  static fromFile(context: Context, path: string): Document;
  get title(): string;
  model(): Model;
  slicer(): Slicer;
}

export interface Layer {
  index: number;
  z: number;
  /** In pixels. */
  width: number;
  height: number;
  /** Bytes from one row to the next. */
  stride: number;
  insideCount: number;
  /** height rows of stride bytes. */
  data: Uint8Array;
}
export declare class Slicer extends Handle {
  readonly kind: 'slicer';
  private constructor();
  readonly info: msq_slicer_report;
  readonly layerCount: number;
  /** Throws a RangeError if a number is out of range; ahead is at least 1. Call return() on an iterator that is not
   * finished: its thread waits for it. */
  layers(first?: number, count?: number, options?: { ahead?: number }): AsyncGenerator<Layer, void, void>;
}
