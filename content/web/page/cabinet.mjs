// The demo's cabinet with fewer vertices, as a page loads it over a network: node cabinet.mjs RECIPE, which rowland-cook
// takes. Maps are per pixel, so that a disc needs the vertices of its outline alone.
import { readFileSync, writeFileSync } from "node:fs";
import { dirname, relative, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const scenes = fileURLToPath(new URL("../../scenes/", import.meta.url));
const out = process.argv[2];
const recipe = JSON.parse(readFileSync(scenes + "cabinet.json", "utf8"));
for (const texture of recipe.scene.textures)
    if (texture.picture) texture.picture = relative(dirname(resolve(out)), scenes + texture.picture);
const most = { disc: { rings: 4 }, sphere: { rings: 32, segments: 64 }, lathe: { segments: 128 } };
for (const { shape } of recipe.scene.meshes.flatMap(({ parts }) => parts))
    for (const [key, count] of Object.entries(most[shape.type] ?? {}))
        if (shape[key] === undefined || shape[key] > count) shape[key] = count;
writeFileSync(out, JSON.stringify(recipe));
