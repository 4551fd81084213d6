import { TaskWorker } from "../three/src/task_worker.js";
import { builtInArtwork, isBuiltIn } from "./artworks.js";
import type { Thumbnail } from "./foil_worker.js";
import { picturesOf, withType, type Recipe } from "./recipe.js";

/** Longer side of a picture as the card takes it. */
const MOST_TEXELS = 2048;
const PARTS = 4;
/** Steps that onStep() of card() counts. */
export const CARD_STEPS = PARTS + 2;

type Picture = ImageBitmap | OffscreenCanvas;

function drawnOn(picture: Picture, scale: number): OffscreenCanvas {
    const side = (texels: number) => Math.max(1, Math.round(texels * scale));
    const canvas = new OffscreenCanvas(side(picture.width), side(picture.height));
    const context = canvas.getContext("2d", { willReadFrequently: true })!;
    context.imageSmoothingQuality = "high";
    context.drawImage(picture, 0, 0, canvas.width, canvas.height);
    return canvas;
}

/** Pictures by name, and the worker that makes cards of them. */
export class FoilMaker {
    private readonly worker = new TaskWorker(new Worker(new URL("./foil_worker.js", import.meta.url), { type: "module" }), () => {});
    private readonly pictures = new Map<string, OffscreenCanvas>();
    private readonly sent = new Set<string>();
    private last: Promise<unknown> = Promise.resolve();

    /** One card or thumbnail after the other. */
    private inTurn<Result>(work: () => Promise<Result>): Promise<Result> {
        const done = this.last.then(work);
        this.last = done.catch(() => {});
        return done;
    }

    has(name: string): boolean {
        return this.pictures.has(name) || isBuiltIn(name);
    }

    /** A picture that recipes may name. Throws for one that is not there. */
    picture(name: string): OffscreenCanvas {
        const known = this.pictures.get(name);
        if (known) return known;
        if (!isBuiltIn(name)) throw new Error(`${name}: this picture is not in the link; choose it again, or take one of the page's`);
        const drawn = builtInArtwork(name);
        this.pictures.set(name, drawn);
        return drawn;
    }

    /** Takes a picture of the user's; resolves to the name under which recipes find it. */
    async take(file: Blob, name: string): Promise<string> {
        let bitmap: ImageBitmap;
        try {
            bitmap = await createImageBitmap(file);
        } catch {
            throw new Error(`${name}: no picture that this browser reads; expected a PNG, JPEG or WebP`);
        }
        const key = isBuiltIn(name) ? `${name} (mine)` : name;
        this.pictures.set(key, drawnOn(bitmap, Math.min(1, MOST_TEXELS / Math.max(bitmap.width, bitmap.height))));
        bitmap.close();
        this.sent.delete(key);
        return key;
    }

    /** A picture as WebP of at most `side` texels. */
    async small(name: string, side: number): Promise<Blob> {
        const picture = this.picture(name);
        return drawnOn(picture, Math.min(1, side / Math.max(picture.width, picture.height))).convertToBlob({ type: "image/webp", quality: 0.7 });
    }

    private async send(recipe: Recipe): Promise<void> {
        for (const name of picturesOf(recipe)) {
            const picture = this.picture(name);
            if (this.sent.has(name)) continue;
            this.sent.add(name);
            const { data, width, height } = picture.getContext("2d")!.getImageData(0, 0, picture.width, picture.height);
            await this.worker.run("picture", [name, data, width, height], [data as never]);
        }
    }

    /** The card as a .glb. `texels`: along its longer side. */
    card(recipe: Recipe, texels: number, onStep: (step: number) => void = () => {}): Promise<Uint8Array<ArrayBuffer>> {
        return this.inTurn(async () => {
            await this.send(recipe);
            onStep(0);
            await this.worker.run("draw", [JSON.stringify({ ...recipe, texture_px: texels })]);
            for (let part = 0; part < PARTS; ++part) {
                onStep(1 + part);
                await this.worker.run("encode", [part]);
            }
            onStep(1 + PARTS);
            return this.worker.run<Uint8Array<ArrayBuffer>>("finish", []);
        });
    }

    /** A picture of a type's foil on the recipe's artwork, for its button. `height`: in pixels. */
    thumbnail(recipe: Recipe, type: string, height: number): Promise<Thumbnail> {
        const typed = withType(recipe, type);
        if (type === "two_pictures") typed.foil.cell_mm = 0.4; // finer cells than its texels show nothing
        return this.inTurn(async () => {
            await this.send(typed);
            return this.worker.run<Thumbnail>("thumbnail", [JSON.stringify(typed), height]);
        });
    }
}
