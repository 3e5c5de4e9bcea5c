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

/** Points near the origin, and the same after a ninth of a turn about the z axis. */
function turnedPoints() {
  const points = Float64Array.from({ length: 3000 }, (_, i) => 8 * ((i * 0.618034) % 1) - 4);
  const [sin, cos] = [Math.sin(2 * Math.PI / 9), Math.cos(2 * Math.PI / 9)];
  const turned = points.map((value, i) => [
    () => cos * value - sin * points[i + 1], () => sin * points[i - 1] + cos * value, () => value][i % 3]());
  return [points, turned];
}

function differing(a, b) {
  return a.reduce((count, one, i) => count + (one !== b[i] ? 1 : 0), 0);
}

test('cells are warped', () => {
  const ball = msq.Shape.sphere(context, [0, 0, 0], 8);
  const [points, turned] = turnedPoints();
  const values = { grid: { cell_size: [1.5, 1.5, 1.5] } };
  for (const extra of [{ shear_along: 0.5 }, { kind: abi.MSQ_WARP_SPHERICAL, count_polar: 5 }]) {
    const warp = { count: 9, inner_radius: 1, outer_radius: 4, ...extra };
    for (const structure of [
      msq.Structure.functional(context, { ...values, function: abi.MSQ_FUNCTION_GYROID, warp }),
      msq.Structure.lattice(context, { ...values, radius: 0.2, warp })]) {
      const model = msq.Model.of(context, ball, [structure]);
      const here = model.membership(points);
      assert.ok(differing(here, model.membership(turned)) < 4);
      assert.ok(here.includes(0) && here.includes(1));
    }
  }
  assert.throws(() => msq.Structure.lattice(context, { ...values, radius: 0.2, warp: {} }), /warp.count is 0/);
  assert.throws(() => msq.Structure.lattice(context, { warp: { counts: 9 } }), /warp_def has no member counts/);
});

function insideBox(structure) {
  const points = Float64Array.from({ length: 9000 }, (_, i) => [8, 6, 4][i % 3] * ((i * 0.618034) % 1));
  return msq.Model.of(context, box, [structure]).membership(points);
}

test('cells are mapped by samples', () => {
  const coordinate = (axis, size) => {
    const values = Array.from({ length: 216 }, (_, i) => (4 * (Math.floor(i / 6 ** axis) % 6) - 5) / size);
    return msq.Field.grid(context, values, [6, 6, 6], { origin: [-5, -5, -5], cell_size: [4, 4, 4] });
  };
  const lattice = (warp) => insideBox(msq.Structure.lattice(
    context, { grid: { cell_size: [2.5, 2.5, 2.5] }, radius: 0.4, ...(warp && { warp }) }));
  const map = (w) => ({ kind: abi.MSQ_WARP_SAMPLED, u: coordinate(0, 2.5), v: coordinate(1, 2.5), w });
  const plain = lattice();
  assert.ok(differing(plain, lattice(map(coordinate(2, 2.5)))) < 8);
  assert.ok(differing(plain, lattice(map(coordinate(2, 4)))) > 100);
  assert.throws(() => lattice(map(coordinate(1, 2.5))), /folds/);
  assert.throws(() => msq.Field.grid(context, [0], [2, 2, 2]), /there are 1 values/);
});

test('periods and stretches change the cells', () => {
  const grid = { cell_size: [7, 2.5, 2.5] }; // the period has its own size along x
  const period = (cell_sizes) => ({ axis: 0, positions: cell_sizes.map((_, i) => 5 * i), cell_sizes });
  const bcc = (sizes) => insideBox(msq.Structure.lattice(context, { grid, radius: 0.4, period: period(sizes) }));
  const sheet = (sizes) => insideBox(msq.Structure.functional(context, {
    grid, function: abi.MSQ_FUNCTION_GYROID, kind: abi.MSQ_FUNCTIONAL_SHEET, thickness: 0.4, period: period(sizes) }));
  const plain = insideBox(msq.Structure.lattice(context, { grid: { cell_size: [2.5, 2.5, 2.5] }, radius: 0.4 }));
  assert.ok(differing(bcc([2.5]), plain) < 4);
  assert.ok(differing(bcc([2.5, 1.5]), plain) > 50);
  assert.ok(differing(sheet([2.5]), sheet([2.5, 1.5])) > 50);
  assert.throws(() => bcc([]), /period.count is 0/);
  assert.throws(() => msq.Structure.lattice(context, { period: { positions: [1, 2], cell_sizes: [1] } }),
                /2 positions and 1 cell_sizes/);
  const foam = (stretch) => insideBox(msq.Structure.foam(
    context, { grid: { cell_size: [2, 2, 2] }, radius: 0.3, stretch }));
  assert.deepEqual(foam([2, 2, 2]), foam([1, 1, 1])); // only the proportions count
  assert.ok(differing(foam([1, 1, 3]), foam([1, 1, 1])) > 50);
  const weighted = (weight) => insideBox(msq.Structure.foam(
    context, { grid: { cell_size: [2, 2, 2] }, radius: 0.3, weight }));
  assert.deepEqual(weighted(0), foam([1, 1, 1]));
  assert.ok(differing(weighted(2), foam([1, 1, 1])) > 50);
  const around = (outer_radius) => insideBox(msq.Structure.foam(
    context, { grid: { cell_size: [2, 2, 2] }, radius: 0.3, warp: { count: 12, inner_radius: 3, outer_radius } }));
  assert.ok(differing(around(6), foam([1, 1, 1])) > 50);
  assert.throws(() => around(0), /warp.outer_radius is 0/);
});

test('plates, booleans with fillets, and blends', () => {
  const plates = msq.Structure.plateLattice(context, { grid: { cell_size: [2, 2, 2] }, thickness: 0.4 });
  const two = msq.Model.of(context, box, [plates]).membership(Float64Array.of(1, 1, 1.7, 1, 1, 1.9));
  assert.deepEqual([...two], [0, 1]); // 0.3 and 0.1 from a plate
  const bcc = msq.Structure.lattice(context, { grid: { cell_size: [2.5, 2.5, 2.5] }, radius: 0.3 });
  const [a, b] = [insideBox(bcc), insideBox(plates)];
  const either = insideBox(msq.Structure.boolean(abi.MSQ_BOOLEAN_UNION, [bcc, plates]));
  assert.deepEqual(either, a.map((one, i) => one | b[i]));
  const smooth = insideBox(msq.Structure.smoothBoolean(abi.MSQ_BOOLEAN_UNION, bcc, plates, 0.4));
  assert.ok(differing(smooth, either) > 0 && smooth.every((one, i) => one >= either[i]));
  assert.deepEqual(insideBox(msq.Structure.blend(bcc, plates, 1)), b);
  const field = msq.Field.gradient(context, [0, 0, 0], 0, [8, 0, 0], 1);
  assert.ok(differing(insideBox(msq.Structure.blend(bcc, plates, field)), a) > 0);
  assert.throws(() => msq.Structure.smoothBoolean(abi.MSQ_BOOLEAN_UNION, bcc, plates, -1), /radius is .*-1/);
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
