// A page in headless Chromium, served from this package on the loopback address.
import { spawn } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { extname, join, normalize } from "node:path";
import { fileURLToPath } from "node:url";

export const packageFolder = fileURLToPath(new URL("..", import.meta.url));
const TYPES = { ".html": "text/html", ".js": "text/javascript", ".mjs": "text/javascript", ".wasm": "application/wasm",
    ".json": "application/json", ".css": "text/css" };

export function chromium() {
    return ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"].find((path) => existsSync(path));
}

/** Starts a server; `task` is what the page fetches, `files` maps further paths to files. */
function serve(task, files, folder, onResult) {
    const server = createServer((request, response) => {
        const path = new URL(request.url, "http://localhost").pathname;
        if (path === "/task") return response.end(JSON.stringify(task));
        if (path === "/result") {
            const parts = [];
            request.on("data", (part) => parts.push(part));
            request.on("end", () => {
                response.end();
                onResult(JSON.parse(Buffer.concat(parts).toString()));
            });
            return;
        }
        const file = files[path] ?? join(folder, normalize(path));
        if (!existsSync(file)) {
            response.statusCode = 404;
            return response.end();
        }
        response.setHeader("content-type", TYPES[extname(file)] ?? "application/octet-stream");
        response.end(readFileSync(file));
    });
    return new Promise((resolve) => server.listen(0, "127.0.0.1", () => resolve(server)));
}

/** What the page posts to /result. */
export async function resultOf(page, task, { files = {}, folder = packageFolder, seconds = 240 } = {}) {
    let server, browser, timer;
    const profile = mkdtempSync(join(tmpdir(), "rowland-chromium-"));
    try {
        return await new Promise(async (resolve, reject) => {
            server = await serve(task, files, folder, resolve);
            timer = setTimeout(() => reject(new Error(`no result of ${page} in ${seconds} s`)), 1000 * seconds);
            browser = spawn(chromium(), ["--headless=new", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader",
                "--enable-unsafe-swiftshader", `--user-data-dir=${profile}`,
                `http://127.0.0.1:${server.address().port}/${page}`], { stdio: "ignore" });
            browser.on("error", reject);
        });
    } finally {
        clearTimeout(timer);
        const ended = new Promise((resolve) => (browser ? browser.once("exit", resolve) : resolve()));
        browser?.kill("SIGKILL");
        await ended;
        server?.close();
        server?.closeAllConnections();
        rmSync(profile, { recursive: true, force: true, maxRetries: 5 });
    }
}
