// Puts the WebAssembly modules beside the compiled code: content/web/bake, which ROWLAND_BAKE names when it is elsewhere.
import { copyFileSync, existsSync } from "node:fs";
import { fileURLToPath } from "node:url";

const bake = process.env.ROWLAND_BAKE ?? fileURLToPath(new URL("../../../../build/web/bake", import.meta.url));
const dist = fileURLToPath(new URL("../dist/", import.meta.url));
for (const name of ["bake.wasm", "arc.wasm"]) {
    if (!existsSync(`${bake}/${name}`)) throw new Error(`${bake}/${name}: missing; build content/web/bake first (./rowland web)`);
    copyFileSync(`${bake}/${name}`, dist + name);
}
