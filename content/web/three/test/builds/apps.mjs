// The README's page as apps: the package as npm packs it, and what each bundler makes of the page.
import { execFileSync } from "node:child_process";
import { cpSync, mkdirSync, readFileSync, symlinkSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { packageFolder, resultOf } from "../browser.mjs";

/** Packs the package: the path of the file. */
export function pack(folder) {
    const [{ filename }] = JSON.parse(execFileSync("npm", ["pack", "--json", "--ignore-scripts", "--pack-destination", folder],
        { cwd: packageFolder, encoding: "utf8", stdio: ["ignore", "pipe", "ignore"] }));
    return join(folder, filename);
}

/** A folder with the packed package, and three and its types as they lie beside the package: no network is needed. */
export function unpack(file, folder) {
    const into = join(folder, "node_modules/@rowland/three");
    mkdirSync(into, { recursive: true });
    execFileSync("tar", ["-xzf", file, "--strip-components=1", "-C", into]);
    mkdirSync(join(folder, "node_modules/@types"));
    for (const name of ["three", "@types/three"]) symlinkSync(packageFolder + "node_modules/" + name, join(folder, "node_modules", name));
    return into;
}

/** The page of a script that a bundler has written. */
export const pageOf = (script) => `<!doctype html>\n<title>A disc</title>\n<script type="module" src="${script}"></script>\n`;

/** Files that lie beside a bundle which names them, but has not moved them. */
export const WORKER_FILES = ["worker.js", "bake.wasm", "arc.wasm", "reference.wasm", "solve.wasm"];

export function copyWorker(from, to) {
    for (const name of WORKER_FILES) cpSync(join(from, "dist", name), join(to, name));
}

export function example(folder) {
    mkdirSync(folder, { recursive: true });
    cpSync(packageFolder + "examples/disc.js", join(folder, "disc.js"));
}

/** What a page without a bundler needs; content/web/three/examples/disc.html beside its node_modules. */
export function withoutBundler(folder) {
    example(join(folder, "plain"));
    cpSync(packageFolder + "examples/disc.html", join(folder, "plain/index.html"));
}

/**
 * Opens pages of `folder` one after the other, as small frames of one page: their final pictures and errors. `pages`: paths,
 * each of an index.html; `headers`: of a path.
 */
export async function pictures(folder, pages, headers, seconds) {
    const drivers = ["picture_driver.js", "builds/frame_driver.js"];
    const files = { "/frames.html": packageFolder + "test/builds/frames.html" };
    for (const name of drivers) files["/drivers/" + name] = packageFolder + "test/" + name;
    const tags = drivers.map((name) => `<script src="/drivers/${name}"></script>\n`).join("");
    for (const path of pages) {
        const text = readFileSync(join(folder, path), "utf8");
        const at = Math.max(text.search(/<script/), 0); // before all of the app's
        const watched = join(folder, path + ".watched.html");
        writeFileSync(watched, text.slice(0, at) + tags + text.slice(at));
        files["/" + path] = watched;
    }
    return resultOf("frames.html", pages.map((path) => "/" + path), { folder, files, headers, seconds });
}
