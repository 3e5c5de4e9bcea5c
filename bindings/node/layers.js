// SPDX-License-Identifier: Apache-2.0
// The thread of Slicer.layers(): runs the slicer and sends each layer to the loop.
import { parentPort, workerData } from 'node:worker_threads';
import koffi from 'koffi';
import { C, abi, types } from './msq.js';

const { slicer, job, first, count, ahead, taken } = workerData;
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

const status = C.msq_slicer_run(slicer, first, count, take, null, job);
if (status !== abi.MSQ_OK) parentPort.postMessage({ status, text: C.msq_error_message() });
