// The README's page as apps: the package as npm packs it, and what each bundler makes of the page.
import { execFileSync } from "node:child_process";
import { cpSync, mkdirSync, readdirSync, readFileSync, rmSync, symlinkSync, writeFileSync } from "node:fs";
import { basename, join } from "node:path";
import { packageFolder, resultOf } from "../browser.mjs";

/** Packs the package: the path of the file. */
export function pack(folder) {
    const [{ filename }] = JSON.parse(execFileSync("npm", ["pack", "--json", "--ignore-scripts", "--pack-destination", folder],
        { cwd: packageFolder, encoding: "utf8", stdio: ["ignore", "pipe", "ignore"] }));
    return join(folder, filename);
}

/** Lays the packed package into the node_modules of a folder: where it lies. */
export function unpack(file, folder) {
    const into = join(folder, "node_modules/@rowland/three");
    rmSync(into, { recursive: true, force: true });
    mkdirSync(into, { recursive: true });
    execFileSync("tar", ["-xzf", file, "--strip-components=1", "-C", into]);
    return into;
}

/** Puts the three and its types that lie beside the package into a folder: no network is needed. */
export function linkThree(folder) {
    mkdirSync(join(folder, "node_modules/@types"), { recursive: true });
    for (const name of ["three", "@types/three"]) symlinkSync(packageFolder + "node_modules/" + name, join(folder, "node_modules", name));
}

/** The page of a script that a bundler has written. */
export const pageOf = (script) => `<!doctype html>\n<title>A disc</title>\n<script type="module" src="${script}"></script>\n`;

/** Files that lie beside a bundle which names them, but has not moved them. */
export const WORKER_FILES = ["worker.js", ...readdirSync(packageFolder + "dist").filter((name) => name.endsWith(".wasm"))];

export function copyWorker(from, to) {
    for (const name of WORKER_FILES) cpSync(join(from, "dist", name), join(to, name));
}

export function example(folder) {
    mkdirSync(folder, { recursive: true });
    cpSync(packageFolder + "examples/disc.js", join(folder, "disc.js"));
}

/** A page without a bundler: its path in `folder`, the node_modules beside it. `three`: the name that it lies there by. */
export function withoutBundler(folder, three = "three") {
    example(join(folder, `plain_${three}`));
    const text = readFileSync(packageFolder + "examples/disc.html", "utf8").replaceAll("/node_modules/three/", `/node_modules/${three}/`);
    writeFileSync(join(folder, `plain_${three}/index.html`), text);
    return `plain_${three}/index.html`;
}

/** The README's page of WebGPURenderer, likewise. */
export function webgpuExample(folder) {
    mkdirSync(join(folder, "webgpu"), { recursive: true });
    cpSync(packageFolder + "examples/webgpu.js", join(folder, "webgpu/webgpu.js"));
    cpSync(packageFolder + "examples/webgpu.html", join(folder, "webgpu/index.html"));
    return "webgpu/index.html";
}

const DRIVERS = ["picture_driver.js", "builds/frame_driver.js"].map((name) => packageFolder + "test/" + name);

/** A page's text with the drivers before its own scripts. `tag`: of the path of one. */
export function watched(text, tag) {
    const at = Math.max(text.search(/<script/), 0);
    return text.slice(0, at) + DRIVERS.map(tag).join("") + text.slice(at);
}

/** For pages that are served from elsewhere. */
export const inline = (driver) => `<script>${readFileSync(driver, "utf8")}</script>\n`;

/**
 * Opens pages one after the other, as small frames of one page: their final pictures and errors, by the name of each.
 * `pages`: paths in `folder`, or addresses of watched() pages; `headers`: of a path.
 */
export async function pictures(folder, pages, { headers, seconds = 240 } = {}) {
    const files = { "/frames.html": packageFolder + "test/builds/frames.html" };
    for (const driver of DRIVERS) files["/drivers/" + basename(driver)] = driver;
    const sources = {};
    for (const [name, path] of Object.entries(pages)) {
        sources[name] = path.startsWith("http") ? path : "/" + path;
        if (path.startsWith("http")) continue;
        files["/" + path] = join(folder, path + ".watched.html");
        const text = readFileSync(join(folder, path), "utf8");
        writeFileSync(files["/" + path], watched(text, (driver) => `<script src="/drivers/${basename(driver)}"></script>\n`));
    }
    return resultOf("frames.html", sources, { folder, files, headers, seconds });
}
