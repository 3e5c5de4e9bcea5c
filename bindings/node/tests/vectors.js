// SPDX-License-Identifier: Apache-2.0
// Runs the vectors through the package: see tests/vectors/protocol.py. usage: vectors.js MODEL POINTS ...
import { readFileSync } from 'node:fs';
import * as msq from '../msq.js';

function bits(value) {
  const bytes = Buffer.alloc(8);
  bytes.writeDoubleBE(value);
  return bytes.toString('hex');
}

function hash(model) {
  try {
    return model.hash;
  } catch (error) {
    if (error.status !== msq.abi.MSQ_E_UNSUPPORTED) throw error;
    return '-';
  }
}

const context = new msq.Context();
for (let i = 2; i + 1 < process.argv.length; i += 2) {
  console.log('case');
  let document;
  try {
    document = msq.Document.fromJson(context, readFileSync(process.argv[i], 'utf8'));
  } catch (error) {
    console.log(`refused ${error.message}`);
    continue;
  }
  const bytes = readFileSync(process.argv[i + 1]);
  const triples = new Float64Array(new Uint8Array(bytes).buffer);
  const model = document.model();
  console.log(`title ${document.title}`);
  console.log(`hash ${hash(model)}`);
  console.log(`inside ${model.membership(triples).join('')}`);
  console.log(`distance ${Array.from(model.distance(triples), bits).join(' ')}`);
  const slicer = document.slicer();
  console.log(`plan ${slicer.info.width} ${slicer.info.height} ${slicer.layerCount}`);
  for await (const layer of slicer.layers())
    console.log(`layer ${layer.index} ${bits(layer.z)} ${Buffer.from(layer.data).toString('hex')}`);
}
