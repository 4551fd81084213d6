// Copies what @rowland/three shares with this package into src/shared, where Babylon takes three's part.
import { copyFileSync, mkdirSync, writeFileSync } from "node:fs";

mkdirSync("src/shared/generated", { recursive: true });
for (const name of ["generated/shaders", "generated/sparkle", "film_table", "grating_state", "groove_map", "groove_moments", "half", "module", "rowland",
    "surface", "task_worker", "tasks", "worker"])
    copyFileSync(`../three/src/${name}.ts`, `src/shared/${name}.ts`);
writeFileSync("src/shared/engine.ts", 'export * from "../engine.js";\n');
