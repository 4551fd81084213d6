// The package as npm packs it, in pages without a bundler and with the light ones; test/builds has the others.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import test from "node:test";
import { chromium, packageFolder } from "./browser.mjs";
import { copyWorker, example, linkThree, pack, pageOf, pictures, unpack, webgpuExample, withoutBundler } from "./builds/apps.mjs";

const missing = !existsSync(packageFolder + "dist/bake.wasm") ? "needs dist: npm run build" : false;

test("the examples are the README's", () => {
    const lines = [...readFileSync(packageFolder + "README.md", "utf8").matchAll(/```js\n(.*?)```/gs)].map(([, text]) => text);
    for (const name of ["disc.js", "webgpu.js"]) assert.ok(lines.includes(readFileSync(packageFolder + "examples/" + name, "utf8")), name);
});

/** The policy of the README. */
const POLICY = /`(default-src 'none';[^`]*)`/.exec(readFileSync(packageFolder + "README.md", "utf8"))[1];

const BUNDLERS = {
    async esbuild(folder, from) {
        const { build } = await import("esbuild");
        const [input, outfile] = [folder + "/disc.js", folder + "/out/app.js"];
        await build({ entryPoints: [input], bundle: true, format: "esm", outfile, logLevel: "error" });
        copyWorker(from, folder + "/out");
        writeFileSync(folder + "/out/index.html", pageOf("app.js"));
        return "out/index.html";
    },
    async rollup(folder, from) {
        const { rollup } = await import("rollup");
        const { nodeResolve } = await import("@rollup/plugin-node-resolve");
        const bundle = await rollup({ input: folder + "/disc.js", plugins: [nodeResolve()], treeshake: false });
        await bundle.write({ dir: folder + "/out", entryFileNames: "app.js" });
        copyWorker(from, folder + "/out");
        writeFileSync(folder + "/out/index.html", pageOf("app.js"));
        return "out/index.html";
    },
    async vite(folder) {
        writeFileSync(folder + "/index.html", pageOf("./disc.js"));
        const { build } = await import("vite");
        await build({ root: folder, base: "./", configFile: false, logLevel: "error", build: { outDir: "out", minify: false } });
        return "out/index.html";
    },
    /** The files of the worker forgotten. */
    async without_worker(folder) {
        mkdirSync(folder + "/out");
        writeFileSync(folder + "/out/app.js", readFileSync(folder + "/../esbuild/out/app.js"));
        writeFileSync(folder + "/out/index.html", pageOf("app.js"));
        return "out/index.html";
    },
};

const USE = `import "./disc.js";
import { GratingMaterial } from "@rowland/three";
export const material: GratingMaterial = new GratingMaterial({ representation: "planar" });
// @ts-expect-error: no such representation
new GratingMaterial({ representation: "spheres" });
`;

/** What the compiler says of the README's page and of USE, in a folder with the package. */
function compilerSays(folder, options) {
    example(folder);
    writeFileSync(join(folder, "use.mts"), USE);
    writeFileSync(join(folder, "package.json"), '{ "type": "module" }');
    const compilerOptions = { strict: true, noEmit: true, allowJs: true, checkJs: true, target: "ES2022", lib: ["ES2022", "DOM"],
        types: [], skipLibCheck: true, ...options };
    writeFileSync(join(folder, "tsconfig.json"), JSON.stringify({ compilerOptions, include: ["use.mts"] }));
    try {
        return execFileSync(process.execPath, [packageFolder + "node_modules/typescript/bin/tsc", "-p", folder], { encoding: "utf8" });
    } catch (error) {
        return error.stdout;
    }
}

test("the packed package", { skip: missing }, async (t) => {
    const folder = mkdtempSync(join(tmpdir(), "rowland-builds-"));
    const from = unpack(pack(folder), folder);
    linkThree(folder);
    try {
        await t.test("holds its licence, its changes, and sources for its maps", () => {
            for (const name of ["LICENSE", "CHANGELOG.md", "README.md"]) assert.ok(existsSync(join(from, name)), name);
            const { version } = JSON.parse(readFileSync(join(from, "package.json"), "utf8"));
            assert.ok(readFileSync(join(from, "CHANGELOG.md"), "utf8").includes(`## ${version}`));
            for (const name of ["index.js", "material.js", "worker.js"]) {
                const { sourcesContent } = JSON.parse(readFileSync(join(from, `dist/${name}.map`), "utf8"));
                assert.ok(sourcesContent.length > 0 && sourcesContent.every((text) => text.length > 0), name);
            }
            assert.doesNotMatch(readFileSync(join(from, "dist/worker.js"), "utf8"), /^import /m);
        });
        await t.test("has no faults that publint finds", async () => {
            const { publint } = await import("publint");
            const { messages } = await publint({ pkgDir: from, strict: true, pack: false });
            assert.deepEqual(messages, []);
        });
        await t.test("can be imported and constructed without a browser", () => {
            const script = `import { GratingMaterial, Rowland } from "@rowland/three";
                new Rowland(); new GratingMaterial(); console.log(Rowland.name)`;
            const words = ["--input-type=module", "-e", script];
            assert.equal(execFileSync(process.execPath, words, { cwd: folder, encoding: "utf8" }), "Rowland\n");
        });
        await t.test("has types for every way in which modules are found", () => {
            for (const [module, moduleResolution] of [["ES2022", "bundler"], ["nodenext", "nodenext"]])
                assert.equal(compilerSays(folder, { module, moduleResolution }), "", moduleResolution);
        });
        const same = "shows the same disc by import maps, esbuild under a strict policy, Rollup and Vite";
        await t.test(same, { skip: chromium() ? false : "needs Chromium" }, async (t) => {
            const pages = { plain: withoutBundler(folder), webgpu: webgpuExample(folder) };
            for (const [name, build] of Object.entries(BUNDLERS)) {
                example(join(folder, name));
                const start = performance.now();
                pages[name] = `${name}/${await build(join(folder, name), from)}`;
                t.diagnostic(`${name}: built in ${((performance.now() - start) / 1000).toFixed(1)} s`);
            }
            const headers = (path) => (path.startsWith("/esbuild/") ? { "content-security-policy": POLICY } : {});
            const { without_worker, webgpu, ...shown } = await pictures(folder, pages, { headers });
            const { colour, pixels, url } = shown.plain;
            const { PICTURES } = process.env;
            if (PICTURES) writeFileSync(join(PICTURES, "disc.png"), Buffer.from(url.split(",")[1], "base64"));
            assert.ok(colour > 3 && pixels.length === 4 * 64 * 36, `colours of ${colour}`); // without grooves it is grey
            for (const [name, one] of Object.entries(shown)) {
                assert.deepEqual(one.errors, [], name);
                assert.deepEqual(one.pixels, pixels, name);
            }
            // On WebGL 2, which WebGPURenderer takes here: no canvas of WebGPU can be read without a GPU.
            assert.deepEqual(webgpu.errors, []);
            assert.ok(webgpu.colour > 3, `colours of ${webgpu.colour}`);
            assert.match(without_worker.errors[0], /worker\.js did not start/);
        });
    } finally {
        rmSync(folder, { recursive: true });
    }
});
