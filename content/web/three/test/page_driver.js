// Before the page's own script: a WebGL with the limits that the address names, and what a visitor does.
const limits = new URLSearchParams(location.search);
const gl = WebGL2RenderingContext.prototype;
const getExtension = gl.getExtension;
const getParameter = gl.getParameter;
if (limits.has("without")) {
    const any = HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = function (kind, ...settings) {
        return kind === "webgl2" ? null : any.call(this, kind, ...settings);
    };
}
if (limits.has("halves")) {
    gl.getExtension = function (name) {
        return name === "OES_texture_float_linear" ? null : getExtension.call(this, name);
    };
    for (const name of ["texImage2D", "texImage3D", "texSubImage2D", "texSubImage3D"]) {
        const upload = gl[name];
        gl[name] = function (...args) {
            upload.apply(this, args);
            const wide = args.includes(this.FLOAT) && this.getTexParameter(args[0], this.TEXTURE_MAG_FILTER) === this.LINEAR;
            if (wide) errors.push(`${name}: a texture of floats is filtered`);
        };
    }
}
if (limits.has("small")) {
    gl.getParameter = function (name) {
        const value = getParameter.call(this, name);
        return [this.MAX_TEXTURE_SIZE, this.MAX_3D_TEXTURE_SIZE, this.MAX_CUBE_MAP_TEXTURE_SIZE].includes(name) ? Math.min(value, 2048) : value;
    };
    for (const name of ["texStorage2D", "texStorage3D", "texImage2D", "texImage3D"]) {
        const allocate = gl[name];
        gl[name] = function (...args) {
            const sizes = name.startsWith("texStorage") ? args.slice(3) : args.slice(3, 5);
            if (sizes.some((size) => typeof size === "number" && size > 2048)) errors.push(`${name} of ${sizes}`);
            return allocate.apply(this, args);
        };
    }
}

const post = (value) => fetch("/result", { method: "POST", body: JSON.stringify(value, (name, part) => (name === "data" ? undefined : part)) });
const wait = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));
const frames = () => Number(document.documentElement.dataset.frames ?? 0);
const said = () => document.getElementById("message").textContent;
async function until(what, isSo) {
    for (let i = 0; i < 3000; ++i) {
        if (isSo()) return;
        await wait(100);
    }
    throw new Error(`waited five minutes for ${what}; the page says "${said()}"`);
}

/** Every table has arrived, and no frame was drawn for a second. */
async function settled() {
    for (let last = -1; last !== frames(); await wait(1000)) {
        last = frames();
        await until("the tables", () => document.documentElement.dataset.busy === "false");
    }
}

/** The canvas as a PNG, 320 x 180 of its pixels, and how colourful it is. */
async function look() {
    const url = document.getElementById("view").toDataURL("image/png");
    const image = await createImageBitmap(await (await fetch(url)).blob());
    const data = pixelsOf(image, 320, 180);
    return { url, data, colour: colourOf(data) };
}

/** Draws a frame of what the page shows now; the reference begins again. */
async function drawnAgain() {
    const drawn = frames();
    dispatchEvent(new Event("resize"));
    await until("a frame", () => frames() > drawn);
}

async function picture() {
    await drawnAgain();
    return look();
}

function pointer(type, x, y, buttons = 0) {
    document.getElementById("view").dispatchEvent(new PointerEvent(type, { clientX: x, clientY: y, buttons, pointerId: 1, bubbles: true }));
}
const pose = () => JSON.parse(document.documentElement.dataset.pose);

const devtools = async (method, params) => (await fetch("/devtools", { method: "POST", body: JSON.stringify({ method, params }) })).json();
/** Fingers along straight lines: [x, y] where each begins and ends. */
async function swipe(fingers) {
    const touch = (type, touchPoints) => devtools("Input.dispatchTouchEvent", { type, touchPoints });
    const at = (part) => fingers.map(([from, to], id) => ({ id, x: from[0] + part * (to[0] - from[0]), y: from[1] + part * (to[1] - from[1]) }));
    const before = pose();
    let lifted = 0;
    const lift = () => ++lifted;
    addEventListener("pointerup", lift);
    await touch("touchStart", at(0));
    for (const part of [0.25, 0.5, 0.75, 1]) await touch("touchMove", at(part));
    await touch("touchEnd", []);
    await until("the fingers to be lifted", () => lifted === fingers.length);
    removeEventListener("pointerup", lift);
    await drawnAgain(); // a frame under way may have been drawn before the last move
    return { before, after: pose() };
}

/** A point of the scene: from the picture's middle, in its heights where it is not narrow. */
function spot(right, down) {
    const { left, top, width, height } = document.getElementById("view").getBoundingClientRect();
    const unit = height / Math.max(1, (4 / 3) * (height / width));
    return [left + width / 2 + right * unit, top + height / 2 + down * unit];
}

/** A finger that turns a sample, one that orbits, and two that zoom. */
async function touches() {
    const sample = spot(-0.44, -0.05);
    const sky = spot(-0.35, -0.42);
    const beside = ([x, y], by) => [x + by, y];
    return {
        turn: await swipe([[sample, beside(sample, 80)]]),
        orbit: await swipe([[sky, beside(sky, 80)]]),
        pinch: await swipe([[beside(sky, -20), beside(sky, -70)], [beside(sky, 20), beside(sky, 70)]]),
    };
}

/** The names of the scene's pieces. */
const pieces = () => [...document.getElementById("sample").options].map(({ text }) => text);

/** The names in the cabinet, and the pose before and after a drag of its record. */
async function turnedRecord() {
    const record = spot(-0.33, -0.1);
    const before = pose();
    const drawn = frames();
    pointer("pointerdown", ...record);
    pointer("pointermove", record[0] + 50, record[1], 1);
    pointer("pointerup", record[0] + 50, record[1]);
    await until("a frame after the drag", () => frames() > drawn);
    return { pieces: pieces(), before, after: pose() };
}

/** The context is lost and comes back: what the page says meanwhile. */
async function lose() {
    const loss = document.getElementById("view").getContext("webgl2").getExtension("WEBGL_lose_context");
    loss.loseContext();
    await until("word of the loss", () => said() !== "");
    const lost = said();
    loss.restoreContext();
    await until("the context", () => said() === "");
    await settled();
    return lost;
}

async function pixelAt(x, y) {
    pointer("pointermove", x, y);
    return pixel();
}
async function pixel() {
    await until("the pixel's error", () => document.getElementById("pixel").textContent.includes("Difference"));
    return document.getElementById("pixel").textContent;
}

/** The whole picture as it is drawn and as the reference's largest blocks have it: means of a component where neither is black. */
async function wiped() {
    const line = document.getElementById("line");
    const upTo = async (part) => {
        const drawn = frames();
        line.value = part;
        line.dispatchEvent(new Event("input"));
        await until("a frame with the line elsewhere", () => frames() > drawn);
    };
    document.getElementById("reference").click();
    await until("the reference", () => Number(document.documentElement.dataset.reference) > 0);
    await upTo(1);
    const drawn = await look();
    await upTo(0);
    const reference = await look();
    document.getElementById("reference").click();
    const seen = [...reference.data.keys()].filter((i) => i % 4 < 3 && Math.min(reference.data[i], drawn.data[i]) > 8);
    const mean = ({ data }) => seen.reduce((sum, i) => sum + data[i], 0) / seen.length;
    return { pictures: { drawn, reference }, part: seen.length / reference.data.length, drawn: mean(drawn), reference: mean(reference) };
}

/** A phone, upright, whose pixels are few: half as many as those of CSS along each side. */
async function holdPhone() {
    await devtools("Emulation.setDeviceMetricsOverride", { width: 390, height: 844, deviceScaleFactor: 0.5, mobile: true });
    await devtools("Emulation.setTouchEmulationEnabled", { enabled: true, maxTouchPoints: 2 });
    await until("the phone", () => innerWidth === 390);
}

/** Where the controls are when each is scrolled to, and how far the page scrolls sideways. */
function layout() {
    const controls = [...document.querySelectorAll("#panel input, #panel select, #panel button, #panel summary")].filter((control) => control.checkVisibility());
    const boxes = controls.map((control) => {
        const target = control.type === "checkbox" ? control.closest("label") : control;
        target.scrollIntoView({ block: "nearest" });
        const { left, top, right, bottom } = target.getBoundingClientRect();
        return { id: control.id, left, top, right, bottom };
    });
    const wider = [document.documentElement, document.body, document.getElementById("panel")].map(({ scrollWidth, clientWidth }) => scrollWidth - clientWidth);
    return { boxes, wider, width: innerWidth, height: innerHeight };
}

async function key(name, code = name) {
    const codes = { Tab: 9, Enter: 13, ArrowRight: 39 };
    for (const type of ["keyDown", "keyUp"]) await devtools("Input.dispatchKeyEvent", { type, key: name, code, windowsVirtualKeyCode: codes[name] });
}

/** What Tab reaches, and whether its focus is seen. */
async function tabbed() {
    const expected = [...document.querySelectorAll("#view, #panel input, #panel select")].filter((one) => one.checkVisibility());
    const reached = [];
    document.activeElement.blur();
    for (let i = 0; i < expected.length; ++i) {
        await key("Tab");
        const { outlineStyle, outlineWidth } = getComputedStyle(document.activeElement);
        reached.push({ expected: document.activeElement === expected[i], id: document.activeElement.id, seen: outlineStyle !== "none" && parseFloat(outlineWidth) >= 2 });
    }
    return reached;
}

/** The keys on the picture: an arrow orbits, and Enter compares a pixel of the chosen sample. */
async function keys() {
    document.getElementById("view").focus();
    const [before, drawn] = [pose(), frames()];
    await key("ArrowRight");
    await until("a frame after the key", () => frames() > drawn);
    const after = pose();
    await key("Enter");
    return { before, after, pixel: await pixel() };
}

async function violations() {
    await new Promise((resolve, reject) => document.head.append(Object.assign(document.createElement("script"), { src: "/axe.js", onload: resolve, onerror: reject })));
    const { violations, passes } = await axe.run();
    return { passed: passes.length, found: violations.filter(({ impact }) => impact === "serious" || impact === "critical")
        .map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html).join(" ")}`) };
}

async function visit() {
    const result = { errors, pictures: {} };
    const show = async (name) => (result.pictures[name] = await picture());
    if (limits.has("without")) {
        await until("word of what lacks", () => said() !== "");
        const image = document.getElementById("view");
        await image.decode();
        return post({ ...result, said: said(), alt: image.alt, size: [image.naturalWidth, image.naturalHeight], errors: [] });
    }
    if (limits.has("phone")) await holdPhone();
    if (limits.has("link")) return post({ ...result, ...(await foilLinkVisit(result.pictures)) });
    if (limits.has("foil")) return post({ ...result, ...(await foilVisit(result.pictures)) });
    // Every flat sample; the ball's table takes seconds.
    await until("the first light", () => Number(document.documentElement.dataset.lit) >= 4);
    const { processInfo } = await devtools("SystemInfo.getProcessInfo");
    result.seconds = Object.fromEntries(processInfo.filter(({ cpuTime }) => cpuTime > 0.1).map(({ type, id, cpuTime }) => [type + id, cpuTime]));
    result.marks = Object.fromEntries(performance.getEntriesByType("mark").map(({ name, startTime }) => [name, Math.round(startTime)]));
    if (limits.has("cabinet")) {
        Object.assign(result, await turnedRecord());
        await settled();
        result.pixel = await pixelAt(...spot(-0.33, -0.1));
        const { pictures, ...wipe } = await wiped();
        Object.assign(result.pictures, pictures);
        result.wipe = wipe;
        await settled();
        await show("first");
        result.lost = await lose();
        await show("restored");
        return post(result);
    }
    await settled();
    result.settled = performance.now() - 1000;
    await show("first");
    if (limits.has("films")) {
        const { first } = result.pictures;
        const thickness = document.querySelector("#sliders input");
        thickness.value = 0.4 * thickness.value;
        thickness.dispatchEvent(new Event("input"));
        const drawn = frames();
        await until("the thinner film", () => frames() > drawn);
        await settled();
        const thinner = await show("thinner");
        const changed = [...first.data.keys()].filter((i) => Math.abs(first.data[i] - thinner.data[i]) > 8).length / first.data.length;
        return post({ ...result, pieces: pieces(), changed });
    }
    if (limits.has("halves")) return post(result);
    const before = frames();
    await wait(2000);
    result.framesAtRest = frames() - before;
    result.layout = layout();
    result.tabbed = await tabbed();
    result.keys = await keys();
    result.violations = await violations();
    result.touches = await touches();
    const dropped = new DataTransfer();
    dropped.items.add(new File(["#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 64 +X 128\n"], "broken.hdr"));
    dispatchEvent(new DragEvent("drop", { dataTransfer: dropped }));
    await until("word of the broken file", () => said() !== "");
    result.broken = said();
    await post(result);
}
visit().catch((error) => post({ errors: [error.message, ...errors] }));
