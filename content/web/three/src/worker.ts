/** Runs the tasks beside the page. */

import { Tasks } from "./tasks.js";

// Bundlers find a file by these words alone: a name that is put together they do not.
const FILES = {
    bake: new URL("./bake.wasm", import.meta.url),
    keys: new URL("./keys.wasm", import.meta.url),
    arc: new URL("./arc.wasm", import.meta.url),
    reference: new URL("./reference.wasm", import.meta.url),
    solve: new URL("./solve.wasm", import.meta.url),
    film: new URL("./film.wasm", import.meta.url),
    sparkle: new URL("./sparkle.wasm", import.meta.url),
};

const tasks = new Tasks(async (name) => {
    const response = await fetch(FILES[name]);
    if (!response.ok) throw new Error(`${FILES[name]}: ${response.status} ${response.statusText}; expected ${name}.wasm of @rowland/three`);
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
