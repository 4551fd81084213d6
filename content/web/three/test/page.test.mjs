// The static site, as a visitor meets it. SITE is the folder that `./rowland web --out` wrote.
import assert from "node:assert/strict";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import test from "node:test";
import { gzipSync } from "node:zlib";
import { chromium, packageFolder, resultOf, withDrivers } from "./browser.mjs";

const site = process.env.SITE ?? packageFolder + "../site";
const missing = !chromium() ? "needs Chromium" : existsSync(join(site, "index.html")) ? false : `needs the page in ${site}`;

const LOADED = ["index.html", "page.css", "page.js", "worker.js", "environment.js", "bake.wasm", "arc.wasm", "cabinet.glb", "draco/draco_decoder.wasm",
    "draco/draco_wasm_wrapper.js"]; // before anything is asked

// Small, as software draws it.
async function visit(query, address = "scene=samples", size = "400,540") {
    const folder = mkdtempSync(join(tmpdir(), "rowland-page-"));
    try {
        const page = join(folder, "index.html");
        const { text, files } = withDrivers(readFileSync(join(site, "index.html"), "utf8"), "picture_driver.js", "page_driver.js");
        writeFileSync(page, text);
        files["/index.html"] = page;
        files["/axe.js"] = packageFolder + "node_modules/axe-core/axe.min.js";
        const requests = [];
        const result = await resultOf(`index.html?${query}#${address}`, {}, { folder: site, files, seconds: 400, size, requests });
        assert.ok(!requests.includes("/solve.wasm"), "the page's gratings are solved when it is built");
        assert.deepEqual(result.errors, []);
        if (process.env.PICTURES)
            for (const [name, { url }] of Object.entries(result.pictures))
                writeFileSync(join(process.env.PICTURES, `${query.replace(/\W/g, "_")}_${name}.png`), Buffer.from(url.split(",")[1], "base64"));
        return result;
    } finally {
        rmSync(folder, { recursive: true });
    }
}

test("the page with the cabinet needs at most 2 MB", { skip: missing }, (t) => {
    const bytes = LOADED.reduce((sum, name) => sum + gzipSync(readFileSync(join(site, name))).length, 0);
    t.diagnostic(`${bytes} bytes, zipped`);
    assert.ok(bytes <= 2e6, String(bytes));
});

test("the cabinet is shown, turns, compares with the reference and outlives a lost context", { skip: missing }, async (t) => {
    const result = await visit("cabinet", "scene=cabinet");
    // Of a process: all since the browser began, at the first diffraction.
    t.diagnostic(`${JSON.stringify(result.marks)} ms, in software; processor seconds ${JSON.stringify(result.seconds)}`);
    assert.deepEqual(result.pieces, ["record", "CD", "DVD", "foil card", "grating rule", "beetle"]);
    const { before, after } = result;
    assert.ok(Math.abs(after.turns[0] - before.turns[0] - 0.5) < 0.01, "a piece turns .01 rad for each pixel");
    assert.equal(after.azimuth, before.azimuth);
    t.diagnostic(`${result.pixel} | of the whole picture ${JSON.stringify(result.wipe)} | ${result.lost}`);
    assert.match(result.pixel, /Difference: \d/);
    const { part, drawn, reference } = result.wipe;
    assert.ok(part > 0.005, "the reference is not black");
    assert.ok(Math.abs(drawn - reference) < 0.5 * reference, `a mean of ${drawn}, of the reference ${reference}`);
    assert.match(result.lost, /context was lost/);
    const { first, restored } = result.pictures;
    assert.ok(first.colour > 4, `colours of ${first.colour}`);
    assert.ok(Math.abs(restored.colour - first.colour) < 0.1 * first.colour, `${restored.colour} after ${first.colour}`);
});

// One visit with a phone, 390 x 844, for all that these tests ask.
let onPhone;
const phone = () => (onPhone ??= visit("phone"));

test("the page draws on demand and names a broken file", { skip: missing }, async (t) => {
    const { marks, settled, framesAtRest, pictures, broken } = await phone();
    t.diagnostic(`${JSON.stringify(marks)}, settled ${Math.round(settled)} ms, in software; ${broken}`);
    assert.equal(framesAtRest, 0);
    assert.ok(pictures.first.colour > 3, `colours of ${pictures.first.colour}`);
    assert.match(broken, /broken\.hdr/);
});

test("on a phone all controls are 44 pixels high, in the lower half, and nothing scrolls sideways", { skip: missing }, async () => {
    const { boxes, wider, width, height } = (await phone()).layout;
    assert.ok(boxes.length > 6, String(boxes.length));
    for (const { id, left, top, right, bottom } of boxes)
        assert.ok(left >= 0 && right <= width && top >= height / 2 && bottom <= height && bottom - top >= 44 && right - left >= 44, `${id}: ${[left, top, right, bottom]}`);
    assert.deepEqual(wider, [0, 0, 0]);
});

test("Tab reaches every control, focus is seen, and keys orbit and compare a pixel", { skip: missing }, async () => {
    const { tabbed, keys } = await phone();
    assert.ok(tabbed.length > 6 && tabbed.every(({ expected, seen }) => expected && seen), JSON.stringify(tabbed));
    assert.ok(Math.abs(keys.after.azimuth - keys.before.azimuth - 0.06) < 1e-6);
    assert.match(keys.pixel, /Difference: \d/);
});

test("axe-core finds nothing serious", { skip: missing }, async () => {
    const { passed, found } = (await phone()).violations;
    assert.ok(passed > 10, String(passed));
    assert.deepEqual(found, []);
});

test("fingers turn a disc, orbit and zoom", { skip: missing }, async (t) => {
    const { turn, orbit, pinch } = (await phone()).touches;
    t.diagnostic(JSON.stringify({ turn, orbit, pinch }));
    assert.ok(Math.abs(Math.max(...turn.after.turns) - 0.8) < 0.05, "a sample turns .01 rad for each pixel");
    assert.ok(Math.abs(turn.after.azimuth - turn.before.azimuth) < 1e-6);
    assert.ok(Math.abs(orbit.after.azimuth - orbit.before.azimuth) > 0.1);
    assert.deepEqual(orbit.after.turns, orbit.before.turns);
    assert.ok(pinch.after.distance < 0.7 * pinch.before.distance, "fingers that part come nearer");
});

test("the page shows the same with halves filtered alone and textures of 2048 texels", { skip: missing }, async () => {
    const { colour } = (await phone()).pictures.first;
    const found = (await visit("halves&small&phone")).pictures.first.colour;
    assert.ok(Math.abs(found - colour) < 0.02 * colour, `colours of ${found}, without the limits ${colour}`);
});

test("films are shown, and a slider makes the bubble thinner", { skip: missing }, async (t) => {
    const { pieces, pictures, changed } = await visit("films", "scene=films");
    assert.deepEqual(pieces, ["bubble", "ring", "lens 1", "bare lens 1", "oil on water"]);
    assert.ok(pictures.first.colour > 2, `colours of ${pictures.first.colour}`);
    t.diagnostic(`${changed} of the picture changed`);
    assert.ok(changed > 0.003 && changed < 0.05, "the bubble alone has other colours");
});

test("without WebGL 2 there is a picture, and a sentence that says what to do", { skip: missing }, async () => {
    const { said, size, alt } = await visit("without", "scene=cabinet");
    assert.match(said, /no WebGL 2.*update the browser/);
    assert.ok(size[0] >= 640 && alt.includes("CD"), `${size} ${alt}`);
});
