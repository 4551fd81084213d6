// What a page loads of the package for its renderer: no shader in the other's language, and none of three's other renderer.
import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import test from "node:test";
import { gzipSync } from "node:zlib";
import { packageFolder } from "./browser.mjs";

const { buildSync } = createRequire(import.meta.url)("esbuild");
const skip = existsSync(packageFolder + "dist/webgpu.js") ? false : "needs dist: npm run build";

/** Its text, bytes of the sources whose path contains a word, and the packages that it imports. */
function bundle(entry, external) {
    const { metafile, outputFiles } = buildSync({ entryPoints: [packageFolder + entry], bundle: true, minify: true, format: "esm", external,
        splitting: true, metafile: true, write: false, outdir: packageFolder + "dist" });
    const { inputs, imports } = Object.values(metafile.outputs).find(({ entryPoint }) => entryPoint?.endsWith(entry));
    return {
        text: outputFiles.find(({ path }) => path === packageFolder + entry).text,
        bytesOf: (word) => Object.entries(inputs).reduce((sum, [path, { bytesInOutput }]) => sum + (path.includes(word) ? bytesInOutput : 0), 0),
        imports: [...new Set(imports.filter(({ external }) => external).map(({ path }) => path))].sort(),
    };
}

test("a page of WebGLRenderer loads no TSL, a page of WebGPURenderer no GLSL", { skip }, (t) => {
    const [index, webgpu] = ["dist/index.js", "dist/webgpu.js"].map((entry) => bundle(entry, ["three", "three/*"]));
    t.diagnostic(`zipped: ${gzipSync(index.text).length} and ${gzipSync(webgpu.text).length} bytes`);
    assert.deepEqual(index.imports, ["three"]);
    assert.equal(index.bytesOf("dist/node/"), 0);
    assert.ok(index.bytesOf("dist/generated/shaders.js") > 10000);
    assert.deepEqual(webgpu.imports, ["three", "three/tsl", "three/webgpu"]);
    assert.equal(webgpu.bytesOf("dist/generated/"), 0);
    assert.ok(webgpu.bytesOf("dist/node/") > 10000);
});

// What only the class says.
const WEBGL_RENDERER = "WebGLRenderer: Context Lost";

test("a bundle with three holds no renderer of the other kind", { skip }, () => {
    assert.ok(readFileSync(packageFolder + "node_modules/three/build/three.module.js", "utf8").includes(WEBGL_RENDERER));
    const index = bundle("dist/index.js", []);
    assert.equal(index.bytesOf("build/three.webgpu.js") + index.bytesOf("build/three.tsl.js"), 0);
    const webgpu = bundle("dist/webgpu.js", []);
    assert.ok(webgpu.bytesOf("build/three.webgpu.js") > 0);
    assert.ok(!webgpu.text.includes(WEBGL_RENDERER));
});
