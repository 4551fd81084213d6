// The package as npm packs it, in a fresh folder: the README's lines show a disc.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { copyFileSync, existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import test from "node:test";
import { chromium, packageFolder, resultOf, withDrivers } from "./browser.mjs";

const missing = !chromium() ? "needs Chromium" : !existsSync(packageFolder + "dist/bake.wasm") ? "needs dist: npm run build" : false;

test("the example is the README's", () => {
    const [, lines] = /```js\n(.*?)```/s.exec(readFileSync(packageFolder + "README.md", "utf8"));
    assert.equal(readFileSync(packageFolder + "examples/disc.js", "utf8"), lines);
});

test("the packed file, installed in a fresh folder, shows a disc", { skip: missing }, async (t) => {
    const folder = mkdtempSync(join(tmpdir(), "rowland-install-"));
    const npm = (from, ...words) => execFileSync("npm", words, { cwd: from, encoding: "utf8", stdio: ["ignore", "pipe", "ignore"] });
    try {
        const [{ filename, size }] = JSON.parse(npm(packageFolder, "pack", "--json", "--ignore-scripts", "--pack-destination", folder));
        npm(folder, "init", "--yes");
        // three is the copy beside the package, so that no network is needed.
        npm(folder, "install", "--offline", "--no-audit", "--install-links", packageFolder + "node_modules/three", "./" + filename);
        for (const name of ["disc.html", "disc.js"]) copyFileSync(packageFolder + "examples/" + name, join(folder, name));
        const { text, files } = withDrivers(readFileSync(join(folder, "disc.html"), "utf8"), "picture_driver.js", "disc_driver.js");
        writeFileSync(join(folder, "watched.html"), text);
        const result = await resultOf("watched.html", {}, { folder, files });
        if (process.env.PICTURES) writeFileSync(join(process.env.PICTURES, "disc.png"), Buffer.from(result.url.split(",")[1], "base64"));
        t.diagnostic(`${size} bytes packed; colours of ${result.colour}`);
        assert.deepEqual(result.errors, []);
    } finally {
        rmSync(folder, { recursive: true });
    }
});
