// What pages do with three, each beside a slow and obvious equivalent. Posts a row for each.
import * as THREE from "three";
import { meshes } from "./pages_meshes.js";
import { pictures } from "./pages_pictures.js";
import { errors, renderer, rowland, sky, told, url } from "./pages_stage.js";

try {
    const { only, keep } = await (await fetch("/task")).json();
    await rowland.setProbe(sky(), { keyLights: 2 });
    const rows = [];
    for (const [name, run] of Object.entries({ ...meshes, ...pictures })) {
        if (only && !only.some((word) => name.includes(word))) continue;
        const begun = performance.now();
        const { found, expected, ...row } = await run();
        const drawn = keep && found ? { found: url(found), expected: url(expected) } : {};
        rows.push({ name, ...row, ...drawn, milliseconds: Math.round(performance.now() - begun), told: told.splice(0), errors: errors.splice(0) });
    }
    await fetch("/result", { method: "POST", body: JSON.stringify({ rows, three: THREE.REVISION, programs: renderer.info.programs.length }) });
} catch (error) {
    await fetch("/result", { method: "POST", body: JSON.stringify({ error: `${error.message}\n${error.stack}`, errors, told }) });
}
