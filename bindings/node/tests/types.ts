// SPDX-License-Identifier: Apache-2.0
// Is compiled, not run: what the types allow, and what they do not.
import { abi, C, Context, definition, Model, report, Shape, Structure } from '../msq.js';

const context = new Context({ threads: 2 });
const box = Shape.box(context, [0, 0, 0], [1, 1, 1]);
const foam = Structure.foam(context, { grid: { cell_size: [1, 1, 1] }, radius: 0.2, seed: 1n });
const model = Model.of(context, box, [{ structure: foam, skin: 0.1 }]);
const kind: number = definition('points_def', { kind: abi.MSQ_POINTS_GRID }).kind;
const cells: number | bigint = report('cache_report', C.msq_cache_stats, context.pointer).cells;
for await (const layer of model.slicer({ layer_height: 0.1 }).layers()) console.log(layer.z + kind, cells);

Structure.lattice(context, { radius: 0.1, warp: { count: 9, inner_radius: 1 } });
Structure.functional(context, { period: { axis: 0, positions: [0, 1], cell_sizes: Float64Array.of(1, 2) } });
Structure.smoothBoolean(abi.MSQ_BOOLEAN_UNION, foam, Structure.plateLattice(context, { thickness: 0.1 }), 0.2);

// @ts-expect-error: no such member
Structure.lattice(context, { warp: { counts: 9 } });
// @ts-expect-error: no sizes
Structure.lattice(context, { period: { positions: [0, 1] } });
// @ts-expect-error: no such member
Structure.foam(context, { radios: 0.2 });
// @ts-expect-error: a parameter is no text
Structure.foam(context, { radius: 'thin' });
// @ts-expect-error: three numbers
Shape.box(context, [0, 0], [1, 1, 1]);
// @ts-expect-error: a model is no shape
Model.of(context, model);
// @ts-expect-error: no such report
report('cash_report', C.msq_cache_stats, context.pointer);
