import type { Material, MeshPhysicalMaterial, MeshPhysicalMaterialParameters } from "three";
import { filmRows, filmSource, filmValues, type FilmFile, type FilmRows, type FilmValues } from "./film_table.js";
import type { Rowland } from "./rowland.js";
import type { FilmTable } from "./tasks.js";

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
        async table(file: FilmFile): Promise<FilmTable> {
            const { ior = 1.3, thickness_nm } = [file.film].flat()[0] ?? {};
            const least_nm = this.iridescenceThicknessMap === null ? undefined : this.leastThickness_nm;
            const source = filmSource(file, { ior: this.ior, colour: this.color.toArray(), metalness: this.metalness, least_nm,
                roughnessVaries: this.roughnessMap !== null });
            if (thickness_nm !== undefined) this.setThicknesses(least_nm ?? thickness_nm, thickness_nm);
            this.iridescenceIOR = ior;
            this.roughness = file.roughness ?? 0;
            return this.rowland!.filmTable(source);
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

        /** @internal */
        take(table: FilmTable): void {
            this.filmValues?.film_table.dispose();
            this.filmValues = filmValues(table, this.roughness);
            this.filmRows = filmRows(table);
            this.tableError = table.error;
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
