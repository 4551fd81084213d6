// The compiler's word on the page and the examples, beside the package. In the source tree, or a copy of the package in it.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import test from "node:test";
import { here, top } from "../build/places.mjs";

const compiler = here + "node_modules/typescript/bin/tsc";
const missing = !existsSync(compiler) ? "needs TypeScript: npm ci" : !existsSync(here + "dist/index.d.ts") ? "needs dist: npm run build" : false;

/** What the example in JSX imports beside three. */
const REACT = `
declare module "react" { export function useEffect(run: () => void, of: unknown[]): void; export function useMemo<T>(make: () => T, of: unknown[]): T; }
declare module "@react-three/fiber" {
    export const Canvas: (of: object) => null;
    export function extend(classes: object): void;
    export function useLoader<T>(loader: new () => { loadAsync(url: string): Promise<T> }, url: string, set: (loader: any) => void): T;
}
declare namespace JSX { interface IntrinsicElements { [name: string]: unknown } }
`;

test("the page and the examples compile", { skip: missing }, () => {
    const folder = mkdtempSync(join(tmpdir(), "rowland-types-"));
    try {
        writeFileSync(join(folder, "react.d.ts"), REACT);
        const examples = ["disc.js", "webgpu.js", "gltf.js", "fiber.jsx"].map((name) => `${top}content/web/three/examples/${name}`);
        writeFileSync(join(folder, "tsconfig.json"), JSON.stringify({
            extends: here + "tsconfig.json",
            compilerOptions: {
                noEmit: true, declaration: false, rootDir: "/", lib: ["ES2022", "DOM", "DOM.Iterable"], resolveJsonModule: true,
                allowJs: true, checkJs: true, jsx: "preserve", noImplicitAny: false, strictNullChecks: true, types: [],
                paths: { "@rowland/three": [here + "dist/index.d.ts"], "@rowland/three/webgpu": [here + "dist/webgpu.d.ts"],
                    "three": [here + "node_modules/@types/three"], "three/webgpu": [here + "node_modules/@types/three/build/three.webgpu"],
                    "three/tsl": [here + "node_modules/@types/three/build/three.tsl"], "three/*": [here + "node_modules/@types/three/*"] },
            },
            include: [], files: [join(folder, "react.d.ts"), `${top}content/web/page/page.ts`, ...examples],
        }));
        let said = "";
        try {
            execFileSync(process.execPath, [compiler, "-p", folder], { encoding: "utf8" });
        } catch (error) {
            said = error.stdout;
        }
        assert.equal(said, "");
    } finally {
        rmSync(folder, { recursive: true });
    }
});
