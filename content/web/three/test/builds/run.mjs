// npm run test:builds [NAME…]: the packed package in the heavy bundlers and in each of three's versions: every app's picture
// must have the pixels of the page without a bundler. Installs what package.json beside this file asks for; minutes.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, rmSync, symlinkSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { packageFolder } from "../browser.mjs";
import { copyWorker, example, inline, pack, pageOf, pictures, unpack, watched, withoutBundler, WORKER_FILES } from "./apps.mjs";

const here = fileURLToPath(new URL(".", import.meta.url));
const work = here + "work/"; // below node_modules of this folder
const of = createRequire(here);
const program = (name) => here + "node_modules/.bin/" + name;
const run = (folder, name, ...words) => execFileSync(program(name), words, {
    cwd: folder, stdio: ["ignore", "pipe", "pipe"], env: { ...process.env, NEXT_TELEMETRY_DISABLED: "1" },
});

const servers = [];
async function viteServer(folder, version, config) {
    writeFileSync(folder + "index.html", watched(pageOf("/disc.js"), inline));
    const { createServer } = await import(version);
    const server = await createServer({ root: folder, configFile: false, logLevel: "error", cacheDir: folder + "cache",
        server: { port: 0, host: "127.0.0.1", fs: { strict: false } }, ...config });
    await server.listen();
    servers.push(server);
    return server.resolvedUrls.local[0];
}

const APPS = {
    async webpack(folder) {
        const webpack = of("webpack");
        const stats = await new Promise((resolve, reject) => webpack({
            context: folder, entry: "./disc.js", mode: "production", output: { path: folder + "out" },
            optimization: { minimize: false }, performance: false,
        }, (error, result) => (error ? reject(error) : resolve(result))));
        assert.ok(!stats.hasErrors(), stats.toString({ all: false, errors: true }));
        assert.deepEqual(stats.toJson({ all: false, warnings: true }).warnings.map(({ message }) => message), []);
        writeFileSync(folder + "out/index.html", pageOf("main.js"));
        return "out/index.html";
    },
    async parcel(folder) {
        writeFileSync(folder + "index.html", pageOf("./disc.js"));
        writeFileSync(folder + "package.json", '{ "private": true }');
        run(folder, "parcel", "build", "index.html", "--dist-dir", "out", "--public-url", "./", "--no-optimize", "--no-cache",
            "--no-autoinstall");
        return "out/index.html";
    },
    async next(folder) {
        mkdirSync(folder + "app");
        writeFileSync(folder + "package.json", '{ "private": true }');
        const config = { output: "export", basePath: "/next/out", turbopack: { root: here } };
        writeFileSync(folder + "next.config.mjs", `export default ${JSON.stringify(config)};\n`);
        writeFileSync(folder + "app/layout.jsx", "export default ({ children }) => <html><body>{children}</body></html>;\n");
        // The component is drawn on the server as well, where the package is imported and a Rowland constructed.
        writeFileSync(folder + "app/page.jsx", `"use client";
import { useEffect } from "react";
import { Rowland } from "@rowland/three";
if (typeof window === "undefined") new Rowland();
export default function Page() {
    useEffect(() => void import("../disc.js"), []);
    return <p hidden />;
}
`);
        run(folder, "next", "build");
        return "out/index.html";
    },
    /** From a service worker's cache alone, which has the bundle and the worker's files. */
    async offline(folder) {
        const { build } = await import("esbuild");
        await build({ entryPoints: [folder + "disc.js"], bundle: true, format: "esm", outfile: folder + "app.js", logLevel: "error" });
        copyWorker(here + "node_modules/@rowland/three", folder);
        const files = ["index.html", "app.js", ...WORKER_FILES, "/drivers/picture_driver.js", "/drivers/frame_driver.js"];
        writeFileSync(folder + "index.html", `<!doctype html>\n<script type="module">
if (navigator.serviceWorker.controller) await import("./app.js");
else {
    navigator.serviceWorker.addEventListener("controllerchange", () => location.reload());
    await navigator.serviceWorker.register("service.js");
}
</script>\n`);
        writeFileSync(folder + "service.js", `const files = ${JSON.stringify(files)};
addEventListener("install", (event) => event.waitUntil(caches.open("disc").then((cache) => cache.addAll(files))));
addEventListener("activate", (event) => event.waitUntil(clients.claim()));
addEventListener("fetch", (event) => event.respondWith(caches.match(event.request).then((found) => found ?? Response.error())));
`);
        return "index.html";
    },
    vite_dev: (folder) => viteServer(folder, "vite", {}),
    vite_7_dev: (folder) => viteServer(folder, "vite_7", { optimizeDeps: { exclude: ["@rowland/three"] } }),
};

const VERSIONS = ["three_185", "three_186"]; // beside "three", the newest
/** Levels of 255 that versions of three may differ by, in the mean. */
const VERSIONS_DIFFER = 0.5;

/** What attw says of the packed file, by the resolutions that a package of ES modules has. */
function checkTypes(file) {
    execFileSync(program("attw"), [file, "--profile", "esm-only", "--exclude-entrypoints", "./worker.js"], { stdio: "inherit" });
}

const chosen = process.argv.slice(2);
const wanted = (name) => chosen.length === 0 || chosen.includes(name);

if (!existsSync(here + "node_modules/webpack")) execFileSync("npm", ["ci", "--ignore-scripts"], { cwd: here, stdio: "inherit" });
rmSync(work, { recursive: true, force: true });
mkdirSync(work);
symlinkSync("../node_modules", work + "node_modules");
const file = pack(work);
unpack(file, here);
try {
    if (wanted("attw")) checkTypes(file);
    const pages = { plain: withoutBundler(work) };
    for (const name of VERSIONS) if (wanted(name)) pages[name] = withoutBundler(work, name);
    for (const [name, build] of Object.entries(APPS)) {
        if (!wanted(name)) continue;
        example(work + name);
        const start = performance.now();
        const path = await build(work + name + "/");
        pages[name] = path.startsWith("http") ? path : `${name}/${path}`;
        console.log(`${name}: built in ${((performance.now() - start) / 1000).toFixed(1)} s`);
    }
    const results = await pictures(work, pages, { seconds: 900 });
    const { plain } = results;
    assert.ok(plain.colour > 3, `colours of ${plain.colour}`);
    for (const [name, { errors, pixels }] of Object.entries(results)) {
        assert.deepEqual(errors, [], name);
        assert.equal(pixels.length, plain.pixels.length, name);
        const difference = pixels.reduce((sum, x, i) => sum + Math.abs(x - plain.pixels[i]), 0) / pixels.length;
        console.log(`${name}: ${difference} of 255 off the page without a bundler`);
        assert.ok(difference <= (VERSIONS.includes(name) ? VERSIONS_DIFFER : 0), name);
    }
} finally {
    for (const server of servers) await server.close();
    rmSync(work, { recursive: true, force: true });
}
