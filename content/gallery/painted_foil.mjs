// painted_foil.mjs PROBE.hdr: the gallery's sheets of foil beside painted rainbows, and the README's table of them on the
// standard output. PROBE.hdr is an angular map, such as Paul Debevec's Grace Cathedral. Needs Chromium, the cards that the
// build makes and the package that content/web/web.sh builds.
import { existsSync, writeFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { chromium, resultOf } from "../web/three/test/browser.mjs";

const path = (relative) => fileURLToPath(new URL(relative, import.meta.url));
const [probe] = process.argv.slice(2);
const folder = path("../../build/web/three/");
const files = { "/painted_foil_page.js": path("painted_foil_page.js"), "/probe.hdr": probe };
const CARDS = ["mountain", "crystal", "heavens"];
for (const name of CARDS) files[`/${name}.glb`] = path(`../../build/release/cooked/foil/${name}.glb`);

const needed = [[probe, "PROBE.hdr", "give the path of an angular map"], [chromium(), "Chromium", "install it"],
    [folder + "dist/bake.wasm", folder + "dist", "run content/web/web.sh"],
    ...CARDS.map((name) => [files[`/${name}.glb`], files[`/${name}.glb`], "build the preset release"])];
for (const [file, name, advice] of needed)
    if (!file || !existsSync(file)) {
        console.error(`painted_foil.mjs: found no ${file ?? name}; ${advice}`);
        process.exit(2);
    }

const { error, sheets, rows } = await resultOf("test/module.html?../painted_foil_page.js", { cards: CARDS }, { folder, files, seconds: 1500 });
if (error) {
    console.error(`painted_foil.mjs: ${error}`);
    process.exit(1);
}
for (const [name, url] of Object.entries(sheets)) writeFileSync(path(`painted_foil_${name}.jpg`), Buffer.from(url.split(",")[1], "base64"));
console.log(rows.map((row) => `| ${row.join(" | ")} |`).join("\n"));
