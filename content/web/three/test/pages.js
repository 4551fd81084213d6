// What pages do with three, each beside a slow and obvious equivalent. Posts a row for each.
import * as THREE from "three";
import { meshes } from "./pages_meshes.js";
import { beginPictures, pictures } from "./pages_pictures.js";
import { drawBy, errors, renderer, rowland, sky, told, url } from "./pages_stage.js";

/** Rows of WebGPURenderer: kinds of meshes, and those of the pictures that three's two renderers draw by the same calls. */
const NODE_PICTURES = ["an orthographic camera", "two eyes of an ArrayCamera", "fog", "vertex colours", "shadows", "more than sixteen lights"];
const { "a page's own onBeforeCompile": _, ...nodeMeshes } = meshes;
const nodeRows = { ...nodeMeshes, ...Object.fromEntries(NODE_PICTURES.map((name) => [name, pictures[name]])) };

async function rowsOf(name, { only, keep }) {
    await drawBy(name);
    beginPictures();
    const rows = [];
    for (const [name, run] of Object.entries(renderer.isWebGLRenderer ? { ...meshes, ...pictures } : nodeRows)) {
        if (only && !only.some((word) => name.includes(word))) continue;
        const begun = performance.now();
        const { found, expected, ...row } = await run();
        const drawn = keep && found ? { found: url(found), expected: url(expected) } : {};
        rows.push({ name, ...row, ...drawn, milliseconds: Math.round(performance.now() - begun), told: told.splice(0), errors: errors.splice(0) });
    }
    return { rows, three: THREE.REVISION, programs: renderer.info.programs?.length };
}

// One page for all renderers, whose maps and tables are the same.
const task = await (await fetch("/task")).json();
const results = {};
for (const name of task.renderers)
    try {
        if (rowland.lightVersion === 0) await rowland.setProbe(sky(), { keyLights: 2 });
        results[name] = await rowsOf(name, task);
    } catch (error) {
        results[name] = { error: `${error.message}\n${error.stack}`, errors: errors.splice(0), told: told.splice(0) };
    }
await fetch("/result", { method: "POST", body: JSON.stringify(results) });
