/** The worker of the foil studio: cards by foil.wasm, which is the foil library of the C++ tree. Holds one card: its page
 *  asks for one after the other. */
import { BakeModule } from "../three/src/module.js";
import { encodePng } from "./png.js";

/** As part_of() of content/web/bake/foil.cpp numbers them. */
const GROOVES = 2;
const FILE = 4;
const THUMBNAIL = 5;

/** RGBA. */
export interface Thumbnail {
    rgba: Uint8ClampedArray<ArrayBuffer>;
    width: number;
    height: number;
}

async function load(): Promise<BakeModule> {
    const url = new URL("./foil.wasm", import.meta.url);
    const response = await fetch(url);
    if (!response.ok) throw new Error(`${url}: ${response.status} ${response.statusText}; expected foil.wasm beside the page`);
    return BakeModule.load(await response.arrayBuffer());
}

const loading = load();
loading.catch(() => {}); // each task says so
let card = 0;
let size = [0, 0];

async function opened(): Promise<BakeModule> {
    const foil = await loading;
    card ||= foil.call("make_room");
    return foil;
}

/** Copies a part out of the module's memory. */
function part(foil: BakeModule, number: number): Uint8Array<ArrayBuffer> {
    const begin = foil.call("part_begin", card, number);
    return new Uint8Array(foil["memory"].buffer, begin, foil.call("part_size", card, number)).slice();
}

function withText<Result>(foil: BakeModule, text: string, call: (begin: number, length: number) => Result): Result {
    const bytes = new TextEncoder().encode(text);
    const address = foil.put(bytes);
    try {
        return call(address, bytes.length);
    } finally {
        foil.call("give_back", address);
    }
}

const tasks = {
    /** A picture for recipes that name it: straight RGBA. */
    async picture(name: string, rgba: Uint8ClampedArray, width: number, height: number): Promise<void> {
        const foil = await opened();
        withText(foil, name, (begin, length) => foil.call("set_picture", card, begin, length, width, height, foil.put(new Uint8Array(rgba.buffer))));
    },

    /** Draws a recipe's card; then encode() its parts and finish() it. */
    async draw(recipe: string): Promise<void> {
        const foil = await opened();
        size = withText(foil, recipe, (begin, length) => [...foil.numbers("draw_card", card, begin, length)]);
    },

    async encode(number: number): Promise<void> {
        const foil = await opened();
        const bytes = part(foil, number);
        if (bytes.length === 0) return;
        const png = await encodePng(number === GROOVES ? new Uint16Array(bytes.buffer) : bytes, size[0], size[1]);
        foil.call("set_texture", card, number, foil.put(png), png.length);
    },

    async finish(): Promise<Uint8Array> {
        const foil = await opened();
        foil.call("finish_card", card);
        return part(foil, FILE);
    },

    /** A small picture of a recipe's card, for choosing. */
    async thumbnail(recipe: string, height: number): Promise<Thumbnail> {
        const foil = await opened();
        const [width, rows] = withText(foil, recipe, (begin, length) => foil.numbers("draw_thumbnail", card, begin, length, height));
        return { rgba: new Uint8ClampedArray(part(foil, THUMBNAIL).buffer), width, height: rows };
    },
};

addEventListener("message", async ({ data: { id, task, args } }: MessageEvent) => {
    try {
        const run = tasks[task as keyof typeof tasks] as (...all: unknown[]) => Promise<unknown>;
        postMessage({ id, result: await run(...args) });
    } catch (error) {
        postMessage({ id, error: (error as Error).message });
    }
});
