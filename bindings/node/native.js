// SPDX-License-Identifier: Apache-2.0
// The functions of msq.h through koffi. MSQ_LIBRARY names the library if the loader does not find it.
import koffi from 'koffi';
import * as abi from './abi.js';
import { checkValue } from './checks.js';
import { types } from './types.js';

// A function that checks its arguments first. Only C knows what memory and addresses of arguments hold.
function checked(call) {
  const { name, arguments: parameters } = call.info;
  const check = (values) => parameters.forEach(({ type, direction }, index) => {
    if (direction !== 'Output') checkValue(values[index], `argument ${index + 1} of ${name}`, type);
  });
  const run = (...values) => {
    check(values);
    return call(...values);
  };
  run.async = (...values) => {
    check(values);
    return call.async(...values);
  };
  run.info = call.info;
  return run;
}

const functions = abi.functions(koffi, koffi.load(process.env.MSQ_LIBRARY ?? 'libmsq.so.0'), types);
/** The functions of msq.h. They refuse integers, texts and structs that do not fit. What an address points to, and
 * how much memory C writes, is not checked. */
export const C = Object.fromEntries(Object.entries(functions).map(([name, call]) => [name, checked(call)]));

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
