// SPDX-License-Identifier: Apache-2.0
// The thread of Slicer.layers(): runs the slicer and sends each layer to layer_thread.js.
import { parentPort, workerData } from 'node:worker_threads';
import koffi from 'koffi';
import { MSQ_OK } from './abi.js';
import { C } from './native.js';
import { types } from './types.js';

const { slicer, job, first, count, ahead, taken, over } = workerData;
let sent = 0;

function take(_user, address) {
  const layer = koffi.decode(address, types.msq_layer);
  const size = Number(layer.stride) * layer.height;
  const data = new Uint8Array(size ? koffi.view(layer.data, size) : 0).slice();
  parentPort.postMessage({
    layer: {
      index: Number(layer.index), z: layer.z, width: layer.width, height: layer.height,
      stride: Number(layer.stride), insideCount: Number(layer.inside_count), data,
    },
  }, [data.buffer]);
  ++sent;
  for (;;) {
    const now = Atomics.load(taken, 0);
    if (sent - now < ahead) return 0;
    Atomics.wait(taken, 0, now);
  }
}

try {
  const status = C.msq_slicer_run(slicer, first, count, take, null, job);
  if (status !== MSQ_OK) parentPort.postMessage({ status, text: C.msq_error_message() });
} finally {
  Atomics.store(over, 0, 1);
  Atomics.notify(over, 0);
}
