import { ARTWORK_NAMES, isBuiltIn, PAIR } from "./artworks.js";
import { CARD_STEPS, FoilMaker } from "./foil_maker.js";
import { checkedRecipe, CORNERS, FIRST, numberAt, picturesOf, positionOf, POSITIONS, TYPES, typeOf, valueOf, withoutPicture, withPicture, withType, withValue, type Knob, type Recipe } from "./recipe.js";
import { FoilStudio } from "./studio.js";

/** Texels along the card's longer side while a slider moves, and of the file. */
const LIVE_TEXELS = 512;
const FILE_TEXELS = 2048;
/** As many as the screen shows; the dithered cells of two pictures would beat with fewer. */
const shownTexels = (recipe: Recipe) => (recipe.foil.type === "two_pictures" || 0.75 * innerHeight * devicePixelRatio > 1100 ? FILE_TEXELS : 1024);
const REST_MS = 350;
const THUMBNAIL_HEIGHT = 134;
/** Of an artwork that goes along in a link. */
const LINK_SIDE = 420;
const LINK_PICTURE = "artwork of the link";

const THREE_LINES = `import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { GratingExtension, Rowland } from "@rowland/three";
const rowland = new Rowland();
const loader = new GLTFLoader().register((parser) => new GratingExtension(parser, rowland));
scene.add((await loader.loadAsync("card.glb")).scene);
await rowland.setProbe(panorama); // as of HDRLoader; scene.environment as well`;

type Made<Tag extends keyof HTMLElementTagNameMap> = HTMLElementTagNameMap[Tag];

function make<Tag extends keyof HTMLElementTagNameMap>(tag: Tag, set: Partial<Made<Tag>> = {}, ...inside: (Node | string)[]): Made<Tag> {
    const element = Object.assign(document.createElement(tag), set);
    element.append(...inside);
    return element;
}

const group = (legend: string, ...inside: Node[]) => make("fieldset", {}, make("legend", { textContent: legend }), ...inside);
const row = (label: string, ...inside: Node[]) => make("label", {}, label, ...inside);

/** One of several pictures. */
function tile(name: string, value: string, label: string, checked: boolean): HTMLLabelElement {
    return make("label", { className: "tile" }, make("input", { type: "radio", name, value, checked }), make("canvas", { width: 96, height: 96 }), label);
}

function drawInto(label: HTMLLabelElement, picture: CanvasImageSource & { width: number; height: number }): void {
    const canvas = label.querySelector("canvas")!;
    const context = canvas.getContext("2d")!;
    const side = Math.min(picture.width, picture.height);
    context.imageSmoothingQuality = "high";
    context.clearRect(0, 0, canvas.width, canvas.height);
    context.drawImage(picture, (picture.width - side) / 2, (picture.height - side) / 4, side, side, 0, 0, canvas.width, canvas.height);
}

const toHex = (tint: number[] = [1, 1, 1]) =>
    "#" + tint.map((x) => Math.round(255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055)).toString(16).padStart(2, "0")).join("");
const toTint = (hex: string) => [1, 3, 5].map((at) => {
    const x = parseInt(hex.slice(at, at + 2), 16) / 255;
    return Number((x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4).toFixed(4));
});

const base64 = async (blob: Blob) => btoa(Array.from(new Uint8Array(await blob.arrayBuffer()), (byte) => String.fromCharCode(byte)).join(""));

export interface Page {
    report(error: unknown): void;
    /** No message is of use any more. */
    clear(): void;
    /** With StudioPanel.settings. */
    address(): string;
    /** The address has changed. */
    changed(): void;
}

/** The controls of the foil studio. */
export class StudioPanel {
    recipe: Recipe = FIRST;
    private readonly maker = new FoilMaker();
    private readonly artworks = make("div", { className: "tiles" });
    private readonly types = make("div", { className: "tiles" });
    private readonly pictures = make("div");
    private readonly knobs = make("div");
    private readonly removes = new Map<"mask" | "back", HTMLButtonElement>();
    private readonly said = make("output", { id: "studio-said" });
    private readonly withArt = make("input", { id: "with-art", type: "checkbox" });
    private readonly artLabel = make("label", { className: "wide" }, this.withArt, "");
    private wanted?: { recipe: Recipe; texels: number };
    private working = false;
    private resting = 0;
    private typesOf = ""; // what the tiles of types show
    private linked?: string; // the artwork of the address that was opened
    private shared?: string; // the user's artwork for a link

    constructor(private readonly root: HTMLElement, private readonly studio: FoilStudio, private readonly page: Page) {}

    /** Opens the recipe of an address; its artwork, if it is in there: WebP as base64. */
    async open(given?: object, art?: string): Promise<void> {
        try {
            if (given) this.recipe = checkedRecipe(given);
            if (art) await this.takeLinked(art);
        } catch (error) {
            this.page.report(error);
        }
        if (!picturesOf(this.recipe).every((name) => this.maker.has(name))) {
            this.page.report(new Error("The link names pictures that are not in it, so that others stand here: drop or choose your own."));
            this.recipe = this.portable();
        }
        const { recipe } = this;
        this.build();
        await this.work(recipe, shownTexels(recipe));
        await this.showTypes();
    }

    /** Draws the types on the artwork, unless it stands there. */
    private async showTypes(): Promise<void> {
        const { recipe } = this;
        const artwork = JSON.stringify([recipe.artwork, recipe.mask, recipe.ink]);
        if (artwork === this.typesOf) return;
        this.typesOf = artwork;
        this.root.dataset.thumbnails = "false";
        for (const label of this.types.querySelectorAll<HTMLLabelElement>(".tile")) {
            const { rgba, width, height } = await this.maker.thumbnail(recipe, label.querySelector("input")!.value, THUMBNAIL_HEIGHT);
            if (this.typesOf !== artwork) return;
            drawInto(label, await createImageBitmap(new ImageData(rgba, width, height)));
        }
        this.root.dataset.thumbnails = "true";
    }

    private async takeLinked(art: string): Promise<void> {
        const bytes = Uint8Array.from(atob(art), (letter) => letter.charCodeAt(0));
        this.recipe = { ...this.recipe, artwork: await this.maker.take(new Blob([bytes], { type: "image/webp" }), LINK_PICTURE) };
        this.linked = art;
        this.withArt.checked = true;
    }

    /** Shows a recipe. `live`: more of its kind will follow in a moment. */
    private edit(recipe: Recipe, live = false): void {
        this.recipe = recipe;
        this.said.value = "";
        clearTimeout(this.resting);
        void this.work(recipe, LIVE_TEXELS).catch(() => {});
        this.resting = window.setTimeout(() => {
            this.page.changed();
            this.work(recipe, shownTexels(recipe)).then(() => this.showTypes()).catch(this.page.report);
        }, live ? REST_MS : 0);
    }

    /** Makes and shows one card after the other; of those that wait the last. */
    private async work(recipe: Recipe, texels: number): Promise<void> {
        this.wanted = { recipe, texels };
        if (this.working) return;
        this.working = true;
        this.root.dataset.busy = "true";
        try {
            while (this.wanted) {
                const { recipe, texels } = this.wanted;
                this.wanted = undefined;
                try {
                    await this.studio.show(await this.maker.card(recipe, texels));
                    if (!this.wanted) this.page.clear();
                } catch (error) {
                    if (!this.wanted) this.page.report(error);
                }
            }
        } finally {
            this.working = false;
            this.root.dataset.busy = "false";
        }
    }

    /** Takes a picture of the user's for a key of the recipe: "artwork", "mask", or one of the type's. */
    async take(file: File, key = "artwork"): Promise<void> {
        this.page.clear();
        this.edit(withPicture(this.recipe, key, await this.maker.take(file, file.name)));
        this.build();
    }

    private fileRow(label: string, key: string): HTMLElement {
        const input = make("input", { id: "foil-" + key, type: "file", accept: "image/*" });
        input.addEventListener("change", () => {
            if (input.files?.[0]) this.take(input.files[0], key).catch(this.page.report);
            input.value = ""; // the same file may be chosen again
        });
        return row(label, input);
    }

    /** For a picture that a card can be without. */
    private removableRow(label: string, key: "mask" | "back"): HTMLElement {
        const remove = make("button", { id: "remove-" + key, type: "button", textContent: "×", title: `Remove the ${key}` });
        remove.setAttribute("aria-label", remove.title);
        remove.addEventListener("click", () => {
            this.edit(withoutPicture(this.recipe, key));
            this.build();
            document.getElementById("foil-" + key)?.focus();
        });
        this.removes.set(key, remove);
        return make("div", { className: "removable" }, this.fileRow(label, key), remove);
    }

    private slider(knob: Knob, value: number, change: (value: number, live: boolean) => void): HTMLLabelElement {
        if (knob.choices) {
            const select = make("select", { id: "foil-" + knob.key }, ...knob.choices.map((choice) => new Option(choice)));
            select.selectedIndex = value;
            select.addEventListener("change", () => change(select.selectedIndex, false));
            return row(knob.label, select);
        }
        const [min, max, step] = knob.logarithmic ? [0, POSITIONS, 1] : [knob.from, knob.to, knob.step];
        const input = make("input", { id: `foil-${knob.key}${knob.index ?? ""}`, type: "range", min: String(min), max: String(max), step: String(step) });
        input.value = String(knob.logarithmic ? positionOf(knob, value) : value);
        const output = make("output");
        const say = (number: number) => {
            output.value = String(number);
            input.setAttribute("aria-valuetext", output.value);
        };
        say(value);
        input.addEventListener("input", () => {
            const number = knob.logarithmic ? numberAt(knob, Number(input.value)) : Number(input.value);
            say(number);
            change(number, true);
        });
        return row(knob.label, input, output);
    }

    private choice(label: string, id: string, options: [string, string][], value: string, change: (value: string) => void): HTMLLabelElement {
        const select = make("select", { id }, ...options.map(([key, text]) => new Option(text, key)));
        select.value = value;
        select.addEventListener("change", () => change(select.value));
        return row(label, select);
    }

    /** The controls for the recipe as it is. */
    private build(): void {
        const focused = document.activeElement?.id;
        this.fillArtworks();
        this.fillTypes();
        this.fillKnobs();
        if (this.root.childElementCount === 0) {
            this.root.append(
                group("Artwork", this.artworks, this.fileRow("Your own", "artwork"), this.removableRow("Mask", "mask"), this.pictures),
                group("Foil", this.types, this.knobs), this.cardGroup(), this.shareGroup());
        }
        this.showRemoves();
        if (focused) document.getElementById(focused)?.focus();
    }

    /** Buttons that remove a picture are there for one that there is. */
    private showRemoves(): void {
        const { mask, card } = this.recipe;
        for (const [key, remove] of this.removes) remove.hidden = !(key === "mask" ? mask : card?.back);
    }

    private fillArtworks(): void {
        const { artwork } = this.recipe;
        const names = isBuiltIn(artwork) ? ARTWORK_NAMES : [...ARTWORK_NAMES, artwork];
        this.artworks.replaceChildren(...names.map((name) => {
            const label = tile("artwork", name, isBuiltIn(name) ? name : "Yours", name === artwork);
            label.querySelector("input")!.id = "artwork-" + name;
            drawInto(label, this.maker.picture(name));
            label.addEventListener("change", () => {
                const { mask, ...others } = this.recipe; // which is for one artwork
                const follows = others.foil.drawing === others.artwork;
                this.edit({ ...others, artwork: name, foil: follows ? { ...others.foil, drawing: name } : others.foil });
                this.showRemoves();
            });
            return label;
        }));
        void this.sizeArt();
    }

    private fillTypes(): void {
        if (this.types.childElementCount > 0) return;
        this.types.append(...TYPES.map(({ name, label }) => {
            const one = tile("foil", name, label, name === this.recipe.foil.type);
            one.querySelector("input")!.id = "type-" + name;
            one.addEventListener("change", () => {
                this.edit(withType(this.recipe, name));
                this.fillKnobs();
            });
            return one;
        }));
    }

    private fillKnobs(): void {
        const { knobs, pictures } = typeOf(this.recipe);
        this.knobs.replaceChildren(...knobs.map((knob) => this.slider(knob, valueOf(this.recipe, knob), (value, live) =>
            this.edit(withValue(this.recipe, knob, value, knobs), live))));
        this.pictures.replaceChildren(...pictures.map(({ key, label }) => this.fileRow(label, key)));
    }

    private cardGroup(): HTMLElement {
        const { ink = "", under = "", lacquer, card } = this.recipe;
        const change = (key: "ink" | "under") => (value: string) => {
            const { [key]: before, ...others } = this.recipe;
            this.edit(value === "" ? others : { ...others, [key]: value });
        };
        const gloss = make("input", { id: "foil-gloss", type: "checkbox", checked: lacquer?.gloss ?? true });
        const tint = make("input", { id: "foil-tint", type: "color", value: toHex(lacquer?.tint), disabled: !gloss.checked });
        const coat = () => {
            tint.disabled = !gloss.checked;
            this.edit({ ...this.recipe, lacquer: gloss.checked ? { tint: toTint(tint.value) } : { gloss: false } }, true);
        };
        gloss.addEventListener("change", coat);
        tint.addEventListener("input", coat);
        const corners = this.slider(CORNERS, card?.corner_mm ?? CORNERS.value, (corner_mm, live) =>
            this.edit({ ...this.recipe, card: { ...this.recipe.card, corner_mm } }, live));
        const side = this.choice("Side", "foil-side", [["front", "Front"], ["back", "Back"]], "front", (value) => this.studio.showSide(value === "back"));
        return group("Card", side, this.removableRow("Back", "back"), corners,
            this.choice("Ink", "foil-ink", [["", "As the artwork is"], ["covers", "Covers the foil"], ["lets_through", "Lets the foil through"]], ink, change("ink")),
            this.choice("Under it", "foil-under", [["", "As the ink is"], ["metal", "Metal"], ["paper", "Paper"]], under, change("under")),
            row("Glossy coat", gloss), row("Tint", tint), ...this.motion());
    }

    private motion(): HTMLElement[] {
        const reduced = matchMedia("(prefers-reduced-motion: reduce)");
        const moves = make("input", { id: "foil-motion", type: "checkbox", checked: !reduced.matches });
        moves.addEventListener("change", () => this.studio.move(moves.checked));
        reduced.addEventListener("change", () => this.studio.move((moves.checked = !reduced.matches)));
        this.studio.move(moves.checked);
        const phone = make("button", { id: "foil-phone", type: "button", textContent: "Tilt with the phone" });
        phone.addEventListener("click", () => this.studio.askForPhone().catch(this.page.report));
        return [row("Gentle motion", moves), ...(FoilStudio.asksForPhone ? [phone] : [])];
    }

    /** A link shows what the page has; of the user's pictures at most the artwork goes along. */
    private portable(): Recipe {
        const { mask, ...recipe } = structuredClone(this.recipe);
        if (!isBuiltIn(recipe.artwork)) recipe.artwork = this.art ? LINK_PICTURE : FIRST.artwork;
        if (recipe.card?.back) delete recipe.card.back;
        typeOf(recipe).pictures.forEach(({ key }, i) => {
            if (!isBuiltIn(String(recipe.foil[key]))) recipe.foil[key] = recipe.foil.type === "own" ? recipe.artwork : PAIR[i];
        });
        return recipe;
    }

    private get art(): string | undefined {
        return this.withArt.checked ? this.shared : undefined;
    }

    /** What the page's address holds of the studio. */
    get settings(): { foil: object; art?: string } {
        return { foil: this.portable(), art: this.art };
    }

    private async sizeArt(): Promise<void> {
        const { artwork } = this.recipe;
        this.artLabel.hidden = isBuiltIn(artwork);
        this.shared = undefined;
        if (this.artLabel.hidden) return;
        const art = (artwork === LINK_PICTURE && this.linked) || (await base64(await this.maker.small(artwork, LINK_SIDE)));
        if (artwork !== this.recipe.artwork) return;
        this.shared = art;
        this.artLabel.lastChild!.textContent = `With my artwork, small: ${Math.ceil(art.length / 1000)} kB of address`;
    }

    private async copy(text: string, what: string): Promise<void> {
        await navigator.clipboard.writeText(text);
        this.said.value = what;
    }

    private shareGroup(): HTMLElement {
        const button = (id: string, textContent: string, click: () => Promise<void>) => {
            const made = make("button", { id, type: "button", textContent });
            made.addEventListener("click", () => click().catch(this.page.report));
            return made;
        };
        this.withArt.addEventListener("change", () => {
            this.said.value = "";
            this.page.changed();
        });
        const link = button("copy-link", "Copy link", async () => {
            await this.copy(new URL(this.page.address(), location.href).href,
                this.art || this.artLabel.hidden ? "The link is copied." : "The link is copied, without your pictures.");
        });
        const lines = make("pre", { tabIndex: 0, textContent: THREE_LINES });
        lines.setAttribute("aria-label", "Lines for three.js");
        const download = button("download", "Download .glb", () => this.download(download));
        return group("Take it along", link, this.artLabel, download, this.said,
            make("details", {}, make("summary", { textContent: "Lines for three.js" }), lines, button("copy-lines", "Copy lines", () => this.copy(THREE_LINES, "The lines are copied."))),
            make("p", { className: "hint", textContent: "Nothing is uploaded: the card is made in this browser." }));
    }

    private async download(button: HTMLButtonElement): Promise<void> {
        button.disabled = true;
        try {
            const glb = await this.maker.card(this.recipe, FILE_TEXELS, (step) => (this.said.value = `Making the card: ${Math.round((100 * step) / CARD_STEPS)} %`));
            const href = URL.createObjectURL(new Blob([glb], { type: "model/gltf-binary" }));
            make("a", { href, download: "card.glb" }).click();
            setTimeout(() => URL.revokeObjectURL(href), 60_000);
            this.said.value = `card.glb, ${(glb.length / 1e6).toFixed(1)} MB`;
        } finally {
            button.disabled = false;
        }
    }
}
