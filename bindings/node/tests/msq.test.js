// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import test from 'node:test';
import koffi from 'koffi';
import * as msq from '../msq.js';

const { abi, C } = msq;
const context = new msq.Context({ threads: 2 });
const box = msq.Shape.box(context, [0, 0, 0], [8, 6, 4]);

function foamModel(radius = 0.3) {
  return msq.Model.of(context, box,
                      [msq.Structure.foam(context, { grid: { cell_size: [2, 2, 2] }, radius })]);
}

test('structs have the layout of abi.json, and constants its values', () => {
  const description = JSON.parse(readFileSync(new URL('../../abi.json', import.meta.url), 'utf8'));
  assert.ok(description.structs.length > 15);
  for (const struct of description.structs) {
    assert.equal(koffi.sizeof(msq.types[struct.name]), struct.size, struct.name);
    for (const field of struct.fields)
      assert.equal(koffi.offsetof(msq.types[struct.name], field.name), field.offset,
                   `${struct.name}.${field.name}`);
  }
  for (const one of description.enums)
    for (const { name, value } of one.values) assert.equal(abi[name], value, name);
  assert.deepEqual(Object.keys(C), description.functions.map((one) => one.name));
});

test('all functions are in the library', () => {
  assert.equal(C.msq_version(), abi.MSQ_VERSION);
});

test('layers come in order, with the bytes of msq_slice_layer', async () => {
  const slicer = foamModel().slicer({ pitch: [0.1, 0.1], layer_height: 0.25 });
  let expected = 3;
  for await (const layer of slicer.layers(3, 10, { ahead: 2 })) {
    assert.equal(layer.index, expected++);
    assert.equal(layer.z, 0.125 + 0.25 * layer.index);
    const bytes = new Uint8Array(Number(slicer.info.layer_bytes));
    msq.check(C.msq_slice_layer(slicer.pointer, layer.index, bytes, bytes.length, null));
    assert.deepEqual(layer.data, bytes);
    assert.ok(layer.insideCount > 0);
  }
  assert.equal(expected, 13);
});

test('the event loop is free while layers are computed', async () => {
  const layers = foamModel().slicer({ pitch: [0.02, 0.02], layer_height: 0.02 }).layers();
  let turns = 0, isRunning = true;
  const turn = () => { ++turns; if (isRunning) setImmediate(turn); };
  setImmediate(turn);
  await layers.next();
  isRunning = false;
  assert.ok(turns > 10, `${turns} turns before the first layer`);
  await layers.return();
});

test('a loop that is left stops the thread', async () => {
  const slicer = foamModel().slicer({ pitch: [0.05, 0.05], layer_height: 0.001 });
  let count = 0;
  for await (const layer of slicer.layers()) if (layer.index === 5 && ++count) break;
  assert.equal(count, 1);
});

test('errors of the thread are thrown by the loop', async () => {
  const slicer = foamModel().slicer({ pitch: [0.5, 0.5], layer_height: 0.5 });
  await assert.rejects(slicer.layers(7, 100).next(),
                       (error) => error.status === abi.MSQ_E_ARGUMENT && /8/.test(error.message));
});

test('parameters are numbers or fields, and points are evaluated', () => {
  const field = msq.Field.gradient(context, [0, 0, 0], 0.01, [8, 0, 0], 0.5);
  const graded = foamModel(field);
  const points = Float64Array.from({ length: 3000 }, (_, i) => [8, 6, 4][i % 3] * ((i * 0.618034) % 1));
  const inside = graded.membership(points);
  const halves = [0, 0];
  inside.forEach((one, i) => { halves[points[3 * i] < 4 ? 0 : 1] += one; });
  assert.ok(halves[1] > 2 * halves[0], `${halves}`);
  graded.distance(points).forEach((distance, i) => assert.equal(distance <= 0, inside[i] === 1));
  assert.deepEqual(graded.bounds, [[0, 0, 0], [8, 6, 4]]);
});

test('a skin is left', () => {
  const structure = msq.Structure.lattice(context, { grid: { cell_size: [2, 2, 2] }, radius: 0.1 });
  const at = Float64Array.of(1, 0.3, 1.2);
  assert.equal(msq.Model.of(context, box, [structure]).membership(at)[0], 0);
  assert.equal(msq.Model.of(context, box, [{ structure, skin: 0.5 }]).membership(at)[0], 1);
});

test('what is wrong is refused with the value', () => {
  assert.throws(() => msq.Shape.sphere(context, [0, 0, 0], -1),
                (error) => error instanceof msq.MsqError && error.status === abi.MSQ_E_ARGUMENT
                  && /MSQ_E_ARGUMENT: .*-1/.test(error.message));
  assert.throws(() => msq.Structure.foam(context, { radios: 1 }), /foam_def has no member radios/);
  assert.throws(() => foamModel().membership([1, 2, 3]), TypeError);
  assert.throws(() => msq.Document.fromJson(context, '{"msq_model": 2}'), msq.MsqError);
});

test('closed objects are refused', () => {
  const job = new msq.Job();
  assert.equal(job.progress, 0);
  job.close();
  job.close();
  assert.throws(() => job.cancel(), /this job is closed/);
});
