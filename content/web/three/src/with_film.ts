import { Vector4, type Material, type MeshPhysicalMaterial, type MeshPhysicalMaterialParameters, type Texture } from "three";
import type { Rowland } from "./rowland.js";
import type { FilmTable } from "./tasks.js";
import { planeTexture } from "./textures.js";

export interface FilmParameters extends MeshPhysicalMaterialParameters {
    rowland?: Rowland;
    /**
     * A film material file's JSON: { film: { ior, thickness_nm }, base: { ior } or metal, roughness }. Without base and
     * metal the film lies on the material's colour, metalness and ior. A texture, `iridescenceThicknessMap`, varies the
     * outermost layer's thickness from iridescenceThicknessRange[0] to the film's; `iridescence` and `iridescenceMap` are
     * the fraction that the film covers.
     */
    film?: object;
}

export interface Layer {
    readonly ior: number;
    readonly thickness_nm: number;
}

/** Members of a film material file that the material follows. */
export interface FilmFile {
    readonly film: Layer | readonly Layer[];
    readonly roughness?: number;
    readonly base?: object;
    readonly metal?: string;
}

/** What film_lookup.glsl reads. */
export interface FilmValues {
    readonly film_table: Texture;
    readonly film_path: Vector4;
    readonly film_axes: Vector4;
    readonly film_rough: number; // 1 if the table is for the material's roughness
}

/** Which of its looks a table has: a line of texels, rows of roughnesses, or of path differences. */
export type FilmRows = "FILM_LINE" | "FILM_ROUGHNESSES" | "FILM_PATHS";

/** A class of physical materials: MeshPhysicalMaterial, or that of another renderer. TypeScript wants `any` of mixins. */
type Physical = new (...parameters: any[]) => Material & Pick<MeshPhysicalMaterial,
    "color" | "ior" | "iridescenceIOR" | "iridescenceThicknessMap" | "iridescenceThicknessRange" | "metalness" | "roughness" | "roughnessMap">;

/** The class with a film's table. A subclass draws it. */
export function withFilm<Base extends Physical>(base: Base) {
    return class extends base {
        readonly isFilmMaterial = true;
        /** Resolves when the table is there; rejects for a bad film. */
        ready: Promise<void> = Promise.resolve();
        /** The table's largest error, of the largest reflectance at that angle. */
        tableError?: number;

        rowland?: Rowland;
        /** What bake() was called with. */
        film?: object;
        filmBakes = 0;
        filmValues?: FilmValues;
        filmRows?: FilmRows;

        constructor(...[parameters = {}]: any[]) {
            const { rowland, film, iridescenceThicknessRange, ...physical } = parameters as FilmParameters;
            super({ color: 0x000000, iridescence: 1, ...physical });
            if (iridescenceThicknessRange) this.setThicknesses(...(iridescenceThicknessRange as [number, number]));
            if (rowland && film) this.bake(rowland, film);
        }

        override copy(source: this): this {
            super.copy(source);
            if (source.rowland && source.film) this.bake(source.rowland, source.film);
            return this;
        }

        /** Sets the film, also another one, as sliders do. Textures that vary it must be there. */
        bake(rowland: Rowland, film: object): void {
            Object.assign(this, { rowland, film });
            const bake = ++this.filmBakes;
            this.ready = this.table(film as FilmFile).then((table) => {
                if (bake === this.filmBakes) this.take(table);
            });
            this.ready.catch((error: Error) => rowland.onError(error));
        }

        /** @internal */
        async table({ film, roughness = 0, ...rest }: FilmFile): Promise<FilmTable> {
            const layers = [film].flat();
            const varies = this.iridescenceThicknessMap !== null;
            if (varies && this.roughnessMap)
                throw new Error("the film: iridescenceThicknessMap beside roughnessMap; expected one of them: a table varies one");
            const { ior = 1.3, thickness_nm } = layers[0] ?? {};
            const least = this.leastThickness_nm;
            if (thickness_nm !== undefined) this.setThicknesses(varies ? least : thickness_nm, thickness_nm);
            this.iridescenceIOR = ior;
            this.roughness = roughness;
            const known = rest.base !== undefined || rest.metal !== undefined;
            const named = known ? rest : { ...rest, base: { ior: this.ior } };
            const range = varies ? [least, thickness_nm].sort((a, b) => a - b) : [-1, thickness_nm];
            const outermost = { ...layers[0], thickness_nm: range[1] };
            return this.rowland!.filmTable({
                json: JSON.stringify({ film: [outermost, ...layers.slice(1)], roughness, ...named }),
                thinnest_nm: range[0], smoothest: this.roughnessMap ? 0 : -1, base: known ? [-1, -1, -1] : this.normalReflectance,
            });
        }

        /** @internal three 0.187 has two numbers in place of the pair. */
        get leastThickness_nm(): number {
            const { iridescenceThicknessMinimum } = this as { iridescenceThicknessMinimum?: number };
            return iridescenceThicknessMinimum ?? this.iridescenceThicknessRange[0];
        }
        /** @internal */
        setThicknesses(iridescenceThicknessMinimum: number, iridescenceThicknessMaximum: number): void {
            if ("iridescenceThicknessMinimum" in this) Object.assign(this, { iridescenceThicknessMinimum, iridescenceThicknessMaximum });
            else this.iridescenceThicknessRange = [iridescenceThicknessMinimum, iridescenceThicknessMaximum];
        }

        /** Of the layer beneath the film. */
        get normalReflectance(): number[] {
            const dielectric = ((this.ior - 1) / (this.ior + 1)) ** 2;
            return this.color.toArray().map((metal) => dielectric + (metal - dielectric) * this.metalness);
        }

        /** @internal */
        take({ path, axes, byRoughness, error, table }: FilmTable): void {
            this.filmValues?.film_table.dispose();
            this.filmValues = { film_table: planeTexture(table, false), film_path: new Vector4(...path), film_axes: new Vector4(...axes),
                film_rough: this.roughness > 0 ? 1 : 0 };
            this.filmRows = byRoughness ? "FILM_ROUGHNESSES" : table.height === 1 ? "FILM_LINE" : "FILM_PATHS";
            this.tableError = error;
            this.filmChanged();
            this.needsUpdate = true;
            this.rowland!.onUpdate();
        }

        /** @internal There is another table. */
        filmChanged(): void {}

        /** Whether the picture has the film's table. */
        get lit(): boolean {
            return this.tableError !== undefined;
        }

        /** Texture look-ups per pixel for the light of the environment, and for each light. */
        get price(): { map: number } {
            return { map: 3 };
        }

        override dispose(): void {
            this.filmValues?.film_table.dispose();
            super.dispose();
        }
    };
}
