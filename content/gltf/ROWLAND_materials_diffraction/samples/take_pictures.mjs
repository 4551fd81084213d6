// Draws the samples with @rowland/three, into pictures/ beside this file: node take_pictures.mjs PACKAGE [NAME…], the package
// built. In a dim room with five lamps, three of them in front of the sample.
import { existsSync, mkdirSync, readdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

const here = fileURLToPath(new URL(".", import.meta.url));
const [from, ...chosen] = process.argv.slice(2);
if (!from) throw new Error("expected: node take_pictures.mjs PACKAGE [NAME…]");
const { resultOf } = await import(pathToFileURL(join(from, "test/browser.mjs")));

const files = { "/pictures.html": here + "pictures.html" };
for (const name of readdirSync(here)) if (existsSync(here + name)) files["/samples/" + name] = here + name;
mkdirSync(here + "pictures", { recursive: true });
for (const name of readdirSync(here).filter((one) => /\.(gltf|glb)$/.test(one))) {
    const [stem] = name.split(".");
    if (chosen.length > 0 && !chosen.includes(stem)) continue;
    const { url, errors } = await resultOf("pictures.html", { name }, { folder: from, files, seconds: 600 });
    if (errors.length > 0) throw new Error(errors.join("\n"));
    writeFileSync(`${here}pictures/${stem}.jpg`, Buffer.from(url.split(",")[1], "base64"));
}
