// copy.mjs [FOLDER]: puts the WebAssembly modules beside the compiled code, by default this package's.
import { copyFileSync, existsSync } from "node:fs";
import { here, top } from "./places.mjs";

for (const name of ["bake.wasm", "keys.wasm", "arc.wasm", "reference.wasm", "solve.wasm", "film.wasm", "sparkle.wasm"]) {
    const module = `${top}build/web/bake/${name}`;
    if (!existsSync(module)) throw new Error(`${module}: missing; ./rowland web builds it`);
    copyFileSync(module, `${process.argv[2] ?? here + "dist/"}${name}`);
}
