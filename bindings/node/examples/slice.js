// SPDX-License-Identifier: Apache-2.0
// @ts-check
// Slices a box filled with a graded foam. A clock ticks meanwhile: the event loop is free.
import { Context, Field, Model, MsqError, Shape, Structure } from '../msq.js';

const context = new Context();
const box = Shape.box(context, [0, 0, 0], [20, 20, 10]);
const radius = Field.gradient(context, [0, 0, 0], 0.1, [0, 0, 10], 0.4);
const foam = Structure.foam(context, { grid: { cell_size: [2, 2, 2] }, radius });
const slicer = Model.of(context, box, [foam]).slicer({ pitch: [0.05, 0.05], layer_height: 0.5 });

let ticks = 0;
const clock = setInterval(() => ++ticks, 1);
let count = 0;
for await (const layer of slicer.layers()) {
  const share = (100 * layer.insideCount) / (layer.width * layer.height);
  if (layer.index % 5 === 0) console.log(`z = ${layer.z}: ${share.toFixed(1)} % solid`);
  ++count;
}
clearInterval(clock);
console.log(`${count} layers; the clock ${ticks > 0 ? 'ticked' : 'stood still'}`);

try {
  Shape.sphere(context, [0, 0, 0], -1);
} catch (error) {
  if (error instanceof MsqError) console.log(`refused: ${error.message}`);
}
