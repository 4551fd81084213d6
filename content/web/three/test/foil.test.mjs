// The foil studio of the page: from a dropped picture to a card. SITE is the folder of the page.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import test from "node:test";
import { top } from "../build/places.mjs";
import { chromium, packageFolder, resultOf, withDrivers } from "./browser.mjs";

const site = process.env.SITE ?? packageFolder + "../site";
const missing = !chromium() ? "needs Chromium" : existsSync(join(site, "foil.wasm")) ? false : `needs the page in ${site}`;
const cook = process.env.ROWLAND_COOK ?? top + "build/release/bin/rowland-cook";
const validator = packageFolder + "../gltf-transform/node_modules/gltf-validator/index.js";

async function opened(address, size) {
    const folder = mkdtempSync(join(tmpdir(), "rowland-foil-"));
    try {
        const page = join(folder, "index.html");
        const { text, files } = withDrivers(readFileSync(join(site, "index.html"), "utf8"), "picture_driver.js", "foil_driver.js", "page_driver.js");
        writeFileSync(page, text);
        files["/index.html"] = page;
        files["/axe.js"] = packageFolder + "node_modules/axe-core/axe.min.js";
        const result = await resultOf("index.html?" + address, {}, { folder: site, files, seconds: 580, size, flags: ["--force-prefers-reduced-motion"] });
        assert.deepEqual(result.errors, []);
        if (process.env.PICTURES)
            for (const [name, { url }] of Object.entries(result.pictures))
                writeFileSync(join(process.env.PICTURES, `foil_${name}.png`), Buffer.from(url.split(",")[1], "base64"));
        return result;
    } finally {
        rmSync(folder, { recursive: true });
    }
}

let visited;
function visit() {
    return (visited ??= opened("foil&phone#scene=foil", "390,844").then((result) =>
        ({ ...result, glb: Buffer.from(result.glb, "base64"), art: Buffer.from(result.art, "base64") })));
}

/** The JSON of a binary glTF, and the texels of its groove texture. */
async function cardOf(glb) {
    const { decodePng16 } = await import("../dist/png16.js");
    const size = glb.readUInt32LE(12);
    const json = JSON.parse(glb.subarray(20, 20 + size));
    const grating = json.materials[0].extensions.ROWLAND_materials_diffraction;
    const { byteOffset = 0, byteLength } = json.bufferViews[json.images[json.textures[grating.grooveTexture.index].source].bufferView];
    const begin = 28 + size + byteOffset;
    return { json, grating, grooves: await decodePng16(Uint8Array.from(glb.subarray(begin, begin + byteLength))) };
}

test("a dropped picture becomes a card, whose type and tilt change what is seen", { skip: missing }, async (t) => {
    const { changed, framesAtRest, tilts: { held, dragged, neutral, tilted }, broken, times } = await visit();
    t.diagnostic(`${JSON.stringify(changed)}; ${broken}; seconds ${JSON.stringify(times)}`);
    assert.ok(changed.type > 0.01 && changed.tilt > 0.01, JSON.stringify(changed));
    assert.equal(framesAtRest, 0);
    // .006 radians for each pixel: down brings the top nearer, right the left.
    dragged.forEach((angle, i) => assert.ok(Math.abs(angle - held[i] - [0.06, 0.12][i]) < 0.005, `${held} dragged to ${dragged}`));
    assert.deepEqual(neutral, dragged);
    tilted.forEach((angle, i) => assert.ok(Math.abs(angle - neutral[i] - (Math.PI / 180) * [12, -6][i]) < 1e-6, `${neutral} tilted to ${tilted}`));
    assert.match(broken, /broken\.png: no picture.*expected a PNG/);
});

test("the file is valid, and its grooves are those of rowland-cook", { skip: missing || (existsSync(cook) ? false : `needs ${cook}`) }, async (t) => {
    const { glb, art, link } = await visit();
    if (existsSync(validator)) {
        const { default: { validateBytes } } = await import(validator);
        const { issues } = await validateBytes(new Uint8Array(glb));
        assert.deepEqual(issues.messages.filter(({ severity }) => severity <= 1), []);
    }
    const folder = mkdtempSync(join(tmpdir(), "rowland-foil-"));
    try {
        const recipe = JSON.parse(new URLSearchParams(new URL(link).hash.slice(1)).get("foil"));
        writeFileSync(join(folder, "mine.png"), art);
        writeFileSync(join(folder, "card.json"), JSON.stringify({ ...recipe, artwork: "mine.png" }));
        execFileSync(cook, ["foil", join(folder, "card.json"), "-o", join(folder, "card.glb")]);
        const [page, cooked] = [await cardOf(glb), await cardOf(readFileSync(join(folder, "card.glb")))];
        assert.deepEqual(page.grating, cooked.grating);
        assert.deepEqual([page.json.nodes, page.json.accessors, page.json.textures], [cooked.json.nodes, cooked.json.accessors, cooked.json.textures]);
        assert.deepEqual([page.grooves.width, page.grooves.height], [1466, 2048]);
        // Sines of the browser and of the C library differ in their last bit, which may round to the next texel value.
        const differences = page.grooves.data.filter((value, i) => value !== cooked.grooves.data[i]).length;
        t.diagnostic(`${differences} of ${page.grooves.data.length} values differ`);
        assert.ok(page.grooves.data.every((value, i) => Math.abs(value - cooked.grooves.data[i]) <= 1));
        assert.ok(differences < 1e-4 * page.grooves.data.length);
    } finally {
        rmSync(folder, { recursive: true });
    }
});

test("the link holds the recipe, and the visitor's artwork only after a tick", { skip: missing }, async () => {
    const { link, linkWithArt } = await visit();
    const [plain, full] = [link, linkWithArt].map((address) => new URLSearchParams(new URL(address).hash.slice(1)));
    assert.equal(plain.get("scene"), "foil");
    assert.deepEqual(JSON.parse(plain.get("foil")), { artwork: "Moon", foil: { type: "hexagons" } });
    assert.equal(plain.get("art"), null);
    assert.notEqual(JSON.parse(full.get("foil")).artwork, "Moon");
    assert.equal(Buffer.from(full.get("art"), "base64").toString("latin1", 8, 12), "WEBP");
});

test("a link opens with the artwork that is in it, and a mask can be removed", { skip: missing }, async (t) => {
    const { linkWithArt } = await visit();
    const { opened: shown, link, shown: removable, focused, changed } = await opened("link" + new URL(linkWithArt).hash, "640,480");
    assert.deepEqual(shown, { artwork: "artwork of the link", label: "Yours", type: "hexagons", withArt: true, said: "" });
    assert.equal(new URL(link).hash, new URL(linkWithArt).hash);
    assert.deepEqual(removable, [false, true, false]);
    assert.equal(focused, "foil-mask");
    t.diagnostic(JSON.stringify(changed));
    assert.ok(changed.by > 0.01 && changed.back < 0.1 * changed.by, JSON.stringify(changed));
});

test("on a phone the studio's controls are 44 pixels high, nothing scrolls sideways, and axe-core finds nothing serious", { skip: missing }, async () => {
    const { layout: { boxes, wider, width, height }, violations: { passed, found } } = await visit();
    assert.ok(boxes.length > 30, String(boxes.length));
    // Scrolling is by whole pixels.
    for (const { id, left, top, right, bottom } of boxes)
        assert.ok(left >= 0 && right <= width && top >= height / 2 - 1 && bottom <= height + 1 && bottom - top >= 44 && right - left >= 44, `${id}: ${[left, top, right, bottom]}`);
    assert.deepEqual(wider, [0, 0, 0]);
    assert.ok(passed > 10, String(passed));
    assert.deepEqual(found, []);
});
