import { existsSync } from "node:fs";
import { dirname } from "node:path";
import { fileURLToPath } from "node:url";

/** The package's folder. */
export const here = fileURLToPath(new URL("..", import.meta.url));

/** The source tree that the package, or a copy of it, lies in. */
export const top = (() => {
    let folder = here;
    while (!existsSync(folder + "/engine/gpu/shaders/dialect.glsl")) {
        if (folder === dirname(folder)) throw new Error(`${here}: not within the source tree of Rowland`);
        folder = dirname(folder);
    }
    return folder + "/";
})();
