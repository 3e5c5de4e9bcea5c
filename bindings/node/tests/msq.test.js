// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import test from 'node:test';
import koffi from 'koffi';
import * as members from '../members.js';
import * as msq from '../msq.js';

const { abi, C } = msq;
const description = JSON.parse(readFileSync(new URL('../../abi.json', import.meta.url), 'utf8'));
const context = new msq.Context({ threads: 2 });
const box = msq.Shape.box(context, [0, 0, 0], [8, 6, 4]);

function foamModel(radius = 0.3) {
  return msq.Model.of(context, box,
                      [msq.Structure.foam(context, { grid: { cell_size: [2, 2, 2] }, radius })]);
}

test('structs have the layout of abi.json, and constants its values', () => {
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
  const shape = msq.Shape.sphere(context, [0, 0, 0], 1);
  shape.close();
  assert.throws(() => msq.Model.of(context, shape), /this shape is closed/);
});

test('a slicer that is closed lives until its layers are computed', async () => {
  const slicer = foamModel().slicer({ pitch: [0.05, 0.05], layer_height: 0.1 });
  const bytes = new Uint8Array(Number(slicer.info.layer_bytes));
  msq.check(C.msq_slice_layer(slicer.pointer, 5, bytes, bytes.length, null));
  const layers = slicer.layers(5, 3);
  const first = layers.next();
  slicer.close();
  for (let i = 0; i < 200; ++i) msq.Shape.sphere(context, [i, 0, 0], 1); // takes the memory of what was freed
  assert.deepEqual((await first).value.data, bytes);
  assert.equal((await layers.next()).value.index, 6);
  await layers.return();
  await assert.rejects(slicer.layers().next(), /this slicer is closed/);
});

/** Runs a program that begins with a slicer of many layers. */
function runProgram(lines) {
  const program = `
    import * as msq from '${new URL('../msq.js', import.meta.url)}';
    const context = new msq.Context();
    const model = msq.Model.of(context, msq.Shape.box(context, [0, 0, 0], [8, 6, 4]));
    const slicer = model.slicer({ pitch: [0.1, 0.1], layer_height: 0.001 });
    ${lines}`;
  return spawnSync(process.execPath, ['--input-type=module', '-e', program], { timeout: 20000, encoding: 'utf8' });
}

test('an iterator keeps the program alive only while it waits', () => {
  const left = runProgram('console.log((await slicer.layers().next()).value.index);');
  assert.deepEqual([left.status, left.stdout, left.stderr], [0, '0\n', '']);
  const waits = runProgram('slicer.layers(7).next().then(({ value }) => console.log(value.index));');
  assert.deepEqual([waits.status, waits.stdout], [0, '7\n']);
  const stopped = runProgram(`const all = slicer.layers(); await all.next(); await all.return();
    console.log('stopped');`);
  assert.deepEqual([stopped.status, stopped.stdout], [0, 'stopped\n']);
});

test('a program may exit whatever the thread does', () => {
  for (let delay = 20; delay <= 60; delay += 5) { // milliseconds; the thread starts, and computes
    const { status, stderr } = runProgram(`slicer.layers().next(); setTimeout(() => process.exit(3), ${delay});`);
    assert.deepEqual([status, stderr], [3, '']);
  }
});

function throwsA(Class, call, message) {
  assert.throws(call, (error) => error instanceof Class && message.test(error.message), `${call}: ${message}`);
}

test('layers that cannot be are refused', () => {
  const slicer = foamModel().slicer({ pitch: [0.5, 0.5], layer_height: 0.5 });
  const refused = (message, ...args) => throwsA(RangeError, () => slicer.layers(...args), message);
  for (const ahead of [0, -1, 0.5, Infinity, NaN])
    refused(/ahead is .*; it must be an integer from 1 to 2147483647/, 0, 3, { ahead });
  refused(/first is -1; it must be an integer from 0 to 8/, -1);
  refused(/first is 9; /, 9);
  refused(/first is 1.5; /, 1.5);
  refused(/count is -1; /, 0, -1);
});

test('arrays that are too short are refused', () => {
  const refused = (call, message) => assert.throws(call, message);
  refused(() => msq.Shape.box(context, [0, 0], [1, 1, 1]), /min has 2 elements; it must have 3/);
  refused(() => msq.Shape.box(context, [0, 0, 0], [1, 1]), /max has 2 elements/);
  refused(() => msq.Shape.box(context, [0, 0, 'a'], [1, 1, 1]), /min\[2\] is 'a'; it must be a number/);
  refused(() => msq.Shape.box(context, undefined, [1, 1, 1]), /min is undefined; it must be an array/);
  refused(() => msq.Shape.sphere(context, [0], 1), /center has 1 elements/);
  refused(() => msq.Field.gradient(context, [0], 0, [1, 0, 0], 1), /from has 1 elements/);
  refused(() => msq.Field.gradient(context, [0, 0, 0], 0, [1, 0, 0, 0], 1), /to has 4 elements/);
  refused(() => msq.Field.grid(context, [1, 2, 3, 4], [2, 2]), /size has 2 elements/);
  const foam = (grid) => msq.Structure.foam(context, { grid, radius: 0.3 });
  refused(() => foam({ cell_size: [2] }), /foam_def.grid.cell_size has 1 elements; it must have 3/);
  refused(() => foam({ cell_size: [2, 2, 2], rotation: [1, 0, 0] }), /rotation has 3 elements; it must have 9/);
  refused(() => msq.Structure.lattice(context, { period: { positions: 5, cell_sizes: [1] } }), /positions is 5/);
});

test('memory that is too short for its count is refused', () => {
  const refused = (name, values, message) => assert.throws(() => msq.definition(name, values), message);
  const points = { kind: abi.MSQ_POINTS_ARRAY, coordinates: new Float64Array(5), count: 2 };
  refused('points_def', points, /points_def.coordinates has 40 bytes; C reads 48/);
  refused('points_def', { ...points, stride: 32 }, /C reads 56/);
  assert.equal(msq.definition('points_def', { ...points, stride: 16 }).count, 2);
  refused('points_def', { ...points, coordinate_type: abi.MSQ_FLOAT32 }, /Float64Array.*; it must be a Float32Array/);
  refused('slicer_def', { layer_z: Float64Array.of(1, 2), layer_z_count: 3n }, /layer_z has 16 bytes; C reads 24/);
  refused('slicer_def', { layer_z: [1, 2], layer_z_count: 2 }, /layer_z is \[ 1, 2 \]; it must be a typed array/);
  refused('slicer_def', { outputs: Buffer.alloc(60), output_count: 2 }, /outputs has 60 bytes; C reads/);
  refused('lattice_def', { nodes: new Float64Array(3), node_count: 1, struts: new Uint32Array(2), strut_count: 2 },
          /struts has 8 bytes; C reads 16/);
  const strides = { row_stride: 4, layer_stride: 15 };
  const image = { values: new Uint8Array(40), value_type: abi.MSQ_UINT8, size: [3, 3, 3], ...strides };
  refused('voxels_def', { image }, /image.values has 40 bytes; C reads 41/);
  refused('voxels_def', { image: { ...image, value_type: abi.MSQ_UINT16 } }, /image.values has 40 bytes; C reads 44/);
  const struct = msq.definition('points_def', { ...points, count: 1 });
  struct.count = 2;
  const inside = new Uint8Array(2);
  assert.throws(() => C.msq_set_membership(foamModel().pointer, struct, null, inside, 2, null),
                /argument 2 of msq_set_membership.coordinates has 40 bytes/);
});

test('typed arrays are converted to the numbers of C', () => {
  const grid = (cell_size) => insideBox(msq.Structure.foam(context, { grid: { cell_size }, radius: 0.3 }));
  assert.deepEqual(grid(Float32Array.of(2, 2, 2)), grid([2, 2, 2]));
  assert.deepEqual(grid(Int8Array.of(2, 2, 2)), grid([2, 2, 2]));
  const struct = msq.definition('radial_field_def');
  struct.axis = Float32Array.of(0, 0, 1);
  assert.throws(() => C.msq_field_radial(context.pointer, struct, [null]), /axis is .*; it must be .* a Float64Array/);
});

test('all arrays and objects of definitions are known', () => {
  const { structs, functions, handles } = description;
  const parts = ['msq_image', 'msq_param', 'msq_scale_def'];
  const made = structs.filter((struct) => parts.includes(struct.name)
    || functions.some((one) => one.name === `${struct.name}_init`));
  const own = new Set(['user', 'warning_user', 'parallel_for_user']);
  for (const struct of made.filter(({ name }) => name !== 'msq_frame')) // msq writes to it
    for (const { name, type, count } of struct.fields.filter((field) => field.type.pointers && !own.has(field.name))) {
      const isStruct = structs.some((one) => one.name === type.name);
      if (handles.some((one) => one.name === type.name))
        assert.equal(`msq_${members.objects[struct.name]?.[name]}`, type.name, `${struct.name}.${name}`);
      else if (count || (!isStruct && type.name !== 'char'))
        assert.ok(members.arrays[struct.name]?.[name], `${struct.name}.${name}`);
    }
});

test('objects of the wrong kind are refused', () => {
  const refused = (call, message) => throwsA(TypeError, call, message);
  const foam = msq.Structure.foam(context, { grid: { cell_size: [2, 2, 2] }, radius: 0.3 });
  refused(() => msq.Model.of(context, context), /scale_def.shape is a context; it must be a shape/);
  refused(() => msq.Model.of(context, box, [box]), /scale_def.structure is a shape; it must be a structure/);
  refused(() => msq.Model.of(box, box), /context is a shape; it must be a context/);
  refused(() => msq.Shape.sphere({ pointer: null }, [0, 0, 0], 1), /context is .*pointer: null.*; it must be/);
  refused(() => msq.Structure.boolean(abi.MSQ_BOOLEAN_UNION, [foam, box]), /structures\[1\] is a shape/);
  refused(() => msq.Structure.blend(foam, box, 0.5), /b is a shape/);
  refused(() => msq.Structure.blend(foam, foam, box), /fraction is a shape; it must be a field/);
  refused(() => msq.Structure.foam(context, { radius: foam }), /foam_def.radius is a structure; it must be a field/);
  refused(() => msq.Structure.foam(context, { radius: { field: foam } }), /radius.field is a structure/);
  refused(() => msq.Structure.lattice(context, { warp: { u: box } }), /warp_def.u is a shape; it must be a field/);
  refused(() => msq.definition('context_def', { threads: foam }), /context_def.threads is a structure/);
  refused(() => { foam.kind = 'shape'; }, /kind/);
});

test('integers that do not fit are refused with the limits', () => {
  const refused = (call, message) => throwsA(RangeError, call, message);
  for (const threads of [-1, 2 ** 32, 1.5, NaN, -1n, 2n ** 32n])
    refused(() => new msq.Context({ threads }), /threads is .*; it must be an integer from 0 to 4294967295$/);
  for (const threads of ['2', true, null]) assert.throws(() => new msq.Context({ threads }), TypeError);
  assert.equal(msq.definition('context_def', { threads: 3n, cache_bytes: undefined }).threads, 3n);
  const foam = (seed) => msq.Structure.foam(context, { grid: { cell_size: [2, 2, 2] }, radius: 0.3, seed });
  for (const seed of [-1, 2n ** 64n, 2 ** 60])
    refused(() => foam(seed), /foam_def.seed is .* to 18446744073709551615, a BigInt/);
  foam(2n ** 64n - 1n);
  refused(() => msq.definition('period_def', { axis: 2 ** 31 }), /axis is 2147483648; .*-2147483648 to 2147483647/);
  refused(() => msq.Field.grid(context, [1, 2, 3], [1.5, 1, 2]), /size\[0\] is 1.5/);
  refused(() => C.msq_slicer_layer_z(1n, -1, new Float64Array(1)), /argument 2 of msq_slicer_layer_z is -1/);
  refused(() => msq.Structure.boolean(1.5, [foam(1)]), /argument 1 of msq_structure_boolean is 1.5/);
});

test('texts with a zero byte are refused', () => {
  const refused = (call, message) => throwsA(TypeError, call, message);
  refused(() => msq.Shape.fromFile(context, 'part.stl\0.txt'), /path has \\0 at position 8, where C would end/);
  refused(() => msq.Document.fromFile(context, 'a\0'), /path has \\0 at position 1/);
  refused(() => msq.Document.fromJson(context, '{}\0'), /text has \\0 at position 2/);
  refused(() => msq.Document.fromJson(context, 5), /text is 5; it must be a text/);
  refused(() => msq.definition('functional_def', { expression: 'x\0' }), /def.expression has \\0 at position 1/);
});
