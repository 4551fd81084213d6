// What pages do with three, each beside a slow and obvious equivalent. Posts a row for each.
import * as THREE from "three";
import { meshes } from "./pages_meshes.js";
import { pictures } from "./pages_pictures.js";
import { errors, renderer, rowland, sky, task, told, url } from "./pages_stage.js";

/** Rows of WebGPURenderer: kinds of meshes, and those of the pictures that three's two renderers draw by the same calls. */
const NODE_PICTURES = ["an orthographic camera", "two eyes of an ArrayCamera", "fog", "vertex colours", "shadows", "more than sixteen lights"];
const { "a page's own onBeforeCompile": _, ...nodeMeshes } = meshes;
const nodeRows = { ...nodeMeshes, ...Object.fromEntries(NODE_PICTURES.map((name) => [name, pictures[name]])) };

try {
    const { only, keep } = task;
    if (task.renderer.endsWith("on WebGPU") && !renderer.backend.isWebGPUBackend) throw new Error("this Chromium offers no WebGPU adapter");
    await rowland.setProbe(sky(), { keyLights: 2 });
    const rows = [];
    for (const [name, run] of Object.entries(task.renderer === "WebGLRenderer" ? { ...meshes, ...pictures } : nodeRows)) {
        if (only && !only.some((word) => name.includes(word))) continue;
        const begun = performance.now();
        const { found, expected, ...row } = await run();
        const drawn = keep && found ? { found: url(found), expected: url(expected) } : {};
        rows.push({ name, ...row, ...drawn, milliseconds: Math.round(performance.now() - begun), told: told.splice(0), errors: errors.splice(0) });
    }
    await fetch("/result", { method: "POST", body: JSON.stringify({ rows, three: THREE.REVISION, programs: renderer.info.programs?.length }) });
} catch (error) {
    await fetch("/result", { method: "POST", body: JSON.stringify({ error: `${error.message}\n${error.stack}`, errors, told }) });
}
