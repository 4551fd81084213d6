// A page in headless Chromium, served from this package on the loopback address.
import { spawn } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { extname, join, normalize } from "node:path";
import { fileURLToPath } from "node:url";
import { DevTools } from "./devtools.mjs";

export const packageFolder = fileURLToPath(new URL("..", import.meta.url));
const TYPES = { ".html": "text/html", ".js": "text/javascript", ".mjs": "text/javascript", ".wasm": "application/wasm",
    ".json": "application/json", ".css": "text/css" };

export function chromium() {
    return ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"].find((path) => existsSync(path));
}

async function bodyOf(request) {
    const parts = [];
    for await (const part of request) parts.push(part);
    return JSON.parse(Buffer.concat(parts).toString());
}

/** A page's text with scripts of this folder before its own, and the paths that the text fetches them from. */
export function withDrivers(text, ...drivers) {
    const tags = drivers.map((name) => `<script src="${name}"></script>\n`).join("");
    return {
        text: text.replace('<script type="module"', tags + "$&"),
        files: Object.fromEntries(drivers.map((name) => ["/" + name, packageFolder + "test/" + name])),
    };
}

/**
 * Starts a server; `task` is what the page fetches, `files` maps further paths to files. A page posts its result to
 * /result, and to /devtools what a hand would do, as commands of the DevTools protocol.
 */
function serve(task, files, folder, headers, requests, onResult, onCommand) {
    const server = createServer(async (request, response) => {
        const path = new URL(request.url, "http://localhost").pathname;
        requests.push(path);
        if (path === "/task") return response.end(JSON.stringify(task));
        if (path === "/result") {
            onResult(await bodyOf(request));
            return response.end();
        }
        if (path === "/devtools") return response.end(JSON.stringify(await onCommand(await bodyOf(request))));
        const file = files[path] ?? join(folder, normalize(path));
        if (!existsSync(file)) {
            response.statusCode = 404;
            return response.end();
        }
        for (const [name, value] of Object.entries(headers(path))) response.setHeader(name, value);
        response.setHeader("content-type", TYPES[extname(file)] ?? "application/octet-stream");
        response.end(readFileSync(file));
    });
    return new Promise((resolve) => server.listen(0, "127.0.0.1", () => resolve(server)));
}

/** Chromium's flags for WebGPU without a GPU. */
const WEBGPU = ["--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader", "--enable-features=Vulkan", "--use-vulkan=swiftshader"];

/**
 * What the page posts to /result. `headers`: those of a path, beside its type; `requests` gets the paths that are asked for;
 * `webgpu`: the page may use it; `flags`: further ones of Chromium.
 */
export async function resultOf(page, task, { files = {}, folder = packageFolder, headers = () => ({}), seconds = 240, size = "800,600",
    requests = [], webgpu = false, flags = [] } = {}) {
    let server, browser, tools, timer;
    const profile = mkdtempSync(join(tmpdir(), "rowland-chromium-"));
    try {
        return await new Promise(async (resolve, reject) => {
            server = await serve(task, files, folder, headers, requests, resolve, (command) => tools.command(command));
            timer = setTimeout(() => reject(new Error(`no result of ${page} in ${seconds} s`)), 1000 * seconds);
            browser = spawn(chromium(), ["--headless=new", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader",
                "--enable-unsafe-swiftshader", ...(webgpu ? WEBGPU : []), ...flags, "--remote-debugging-pipe", `--window-size=${size}`, `--user-data-dir=${profile}`,
                `http://127.0.0.1:${server.address().port}/${page}`], { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"], detached: true });
            tools = new DevTools(browser);
            browser.on("error", reject);
        });
    } finally {
        clearTimeout(timer);
        if (browser?.pid && browser.exitCode === null) {
            const ended = new Promise((resolve) => browser.once("exit", resolve));
            process.kill(-browser.pid, "SIGKILL"); // its helper processes write into the profile
            await ended;
        }
        server?.close();
        server?.closeAllConnections();
        rmSync(profile, { recursive: true, force: true, maxRetries: 10 });
    }
}
