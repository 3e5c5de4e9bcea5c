// SPDX-License-Identifier: Apache-2.0
// Structs and callbacks of msq.h as types of koffi.
import koffi from 'koffi';
import * as abi from './abi.js';

export const types = abi.types(koffi);
