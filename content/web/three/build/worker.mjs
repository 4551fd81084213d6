// The worker as one file, which pages can copy without a bundler.
import { buildSync } from "esbuild";
import { here } from "./places.mjs";

buildSync({
    entryPoints: [here + "dist/worker.js"], outfile: here + "dist/worker.js", allowOverwrite: true,
    bundle: true, format: "esm", target: "es2022", sourcemap: true, logLevel: "warning",
});
