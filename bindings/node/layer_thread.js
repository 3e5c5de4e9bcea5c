// SPDX-License-Identifier: Apache-2.0
// A thread that computes layers, as the loop over them sees it. layers.js runs in the thread.
import { Worker } from 'node:worker_threads';
import { Handle, retained } from './handle.js';
import { C, MsqError } from './native.js';

// At the end of the program Node ends threads wherever they are. koffi aborts the program if that is in its code, so
// the threads leave it first.
const running = new Set();
const maxWait = 10000; // milliseconds, for a thread that does not start
function endAll() {
  for (const thread of running) thread.cancel();
  for (const thread of running) thread.waitUntilOver();
}

export class LayerThread {
  #slicer; // open until the thread has ended, like the job
  #job = new Handle('job', (made) => C.msq_job_create(made));
  #taken = new Int32Array(new SharedArrayBuffer(4)); // layers that the loop has taken
  #over = new Int32Array(new SharedArrayBuffer(4)); // 1: the thread calls koffi no more
  #arrived = [];
  #failure = null;
  #wake = () => {};
  #worker;
  #ended;

  constructor(slicer, first, count, ahead) {
    this.#slicer = retained(slicer);
    this.#worker = new Worker(new URL('./layers.js', import.meta.url), {
      execArgv: [], // options of the program, such as --input-type, are not for this file
      workerData: {
        slicer: this.#slicer.pointer, job: this.#job.pointer, first, count, ahead, taken: this.#taken, over: this.#over,
      },
    });
    this.#worker.unref();
    this.#worker.on('message', (message) => { this.#arrived.push(message); this.#wake(); });
    this.#worker.on('error', (error) => { this.#failure = error; this.#wake(); });
    this.#ended = new Promise((resolve) => {
      this.#worker.on('exit', () => { this.#end(); resolve(); });
    });
    if (running.size === 0) process.on('exit', endAll);
    running.add(this);
  }

  #end() {
    running.delete(this);
    if (running.size === 0) process.off('exit', endAll);
    this.#slicer.close();
    this.#job.close();
    this.#wake();
  }

  get #isOver() {
    return !running.has(this);
  }

  /** The next layer, or null at the end. Only a call that waits keeps the program alive. */
  async next() {
    this.#worker.ref();
    while (this.#arrived.length === 0 && !this.#isOver && !this.#failure)
      await new Promise((resolve) => { this.#wake = resolve; });
    this.#worker.unref();
    if (this.#failure) throw this.#failure;
    if (this.#arrived.length === 0) return null;
    const { layer, status, text } = this.#arrived.shift();
    if (status !== undefined) throw new MsqError(status, text);
    Atomics.add(this.#taken, 0, 1);
    Atomics.notify(this.#taken, 0);
    return layer;
  }

  /** The thread ends soon. */
  cancel() {
    if (this.#isOver) return;
    C.msq_job_cancel(this.#job.pointer);
    Atomics.store(this.#taken, 0, 0x7fffffff); // the thread waits for nobody any more
    Atomics.notify(this.#taken, 0);
  }

  /** Blocks until the thread has left C and koffi. */
  waitUntilOver() {
    Atomics.wait(this.#over, 0, 0, maxWait);
  }

  /** Resolves when the thread has ended. */
  async stop() {
    this.cancel();
    this.#worker.ref();
    await this.#ended;
  }
}
