/** Runs the tasks beside the page. */

import { Tasks } from "./tasks.js";

const tasks = new Tasks(async (name) => {
    const response = await fetch(new URL(`./${name}.wasm`, import.meta.url));
    if (!response.ok) throw new Error(`${name}.wasm: ${response.status} ${response.statusText}; expected beside worker.js`);
    return response.arrayBuffer();
});

function buffers(value: unknown): Transferable[] {
    if (ArrayBuffer.isView(value)) return [value.buffer as ArrayBuffer];
    if (value === null || typeof value !== "object") return [];
    return Object.values(value).flatMap(buffers);
}

// One task after the other: they share the modules' memory.
let last: Promise<unknown> = Promise.resolve();

addEventListener("message", (event: MessageEvent) => {
    const { id, task, args } = event.data;
    last = last.then(async () => {
        try {
            const run = tasks[task as keyof Tasks] as (...all: unknown[]) => Promise<unknown>;
            const result = await run.apply(tasks, args);
            postMessage({ id, result }, { transfer: [...new Set(buffers(result))] });
        } catch (error) {
            postMessage({ id, error: (error as Error).message });
        }
    });
});
