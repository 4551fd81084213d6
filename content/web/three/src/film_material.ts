import { MeshPhysicalMaterial, type IUniform, type MeshPhysicalMaterialParameters, type Texture, type WebGLProgramParametersWithUniforms, Vector4 } from "three";
import { FILM } from "./generated/shaders.js";
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

interface Layer {
    readonly ior: number;
    readonly thickness_nm: number;
}

/** Members of a film material file that the material follows. */
interface FilmFile {
    readonly film: Layer | readonly Layer[];
    readonly roughness?: number;
    readonly base?: object;
    readonly metal?: string;
}

/**
 * MeshPhysicalMaterial whose reflection is that of thin layers, summed over wavelengths and both polarisations. Until its
 * table arrives, three's own iridescence shows.
 */
export class FilmMaterial extends MeshPhysicalMaterial {
    readonly isFilmMaterial = true;
    /** Resolves when the table is there; rejects for a bad film. */
    ready: Promise<void> = Promise.resolve();
    /** The table's largest error, of the largest reflectance at that angle. */
    tableError?: number;

    private rowland?: Rowland;
    /** What bake() was called with. */
    film?: object;
    private bakes = 0;
    private readonly uniforms: Record<string, IUniform> = {};

    constructor({ rowland, film, ...physical }: FilmParameters = {}) {
        super({ color: 0x000000, iridescence: 1, ...physical });
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
        const bake = ++this.bakes;
        this.ready = this.table(film as FilmFile).then((table) => {
            if (bake === this.bakes) this.show(table);
        });
        this.ready.catch((error: Error) => rowland.onError(error));
    }

    private async table({ film, roughness = 0, ...rest }: FilmFile): Promise<FilmTable> {
        const layers = [film].flat();
        const varies = this.iridescenceThicknessMap !== null;
        if (varies && this.roughnessMap)
            throw new Error("the film: iridescenceThicknessMap beside roughnessMap; expected one of them: a table varies one");
        const { ior = 1.3, thickness_nm } = layers[0] ?? {};
        const least = this.iridescenceThicknessRange[0];
        if (thickness_nm !== undefined) this.iridescenceThicknessRange = [varies ? least : thickness_nm, thickness_nm];
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

    /** Of the layer beneath the film. */
    private get normalReflectance(): number[] {
        const dielectric = ((this.ior - 1) / (this.ior + 1)) ** 2;
        return this.color.toArray().map((metal) => dielectric + (metal - dielectric) * this.metalness);
    }

    private show({ path, axes, byRoughness, error, table }: FilmTable): void {
        (this.uniforms.film_table?.value as Texture | undefined)?.dispose();
        const rough = this.roughness > 0 ? 1 : 0;
        for (const [name, value] of Object.entries({ film_table: planeTexture(table, false), film_path: new Vector4(...path),
            film_axes: new Vector4(...axes), film_rough: rough }))
            (this.uniforms[name] ??= { value }).value = value;
        this.tableError = error;
        this.premultipliedAlpha = true;
        this.defines ??= {};
        this.defines.ROWLAND_FILM = "1";
        delete this.defines.FILM_LINE;
        delete this.defines.FILM_ROUGHNESSES;
        if (byRoughness) this.defines.FILM_ROUGHNESSES = "1";
        else if (table.height === 1) this.defines.FILM_LINE = "1";
        this.needsUpdate = true;
        this.rowland!.onUpdate();
    }

    /** Whether the picture has the film's table. */
    get lit(): boolean {
        return this.tableError !== undefined;
    }

    /** Texture look-ups per pixel for the light of the environment, and for each light. */
    get price(): { map: number } {
        return { map: 3 };
    }

    override dispose(): void {
        (this.uniforms.film_table?.value as Texture | undefined)?.dispose();
        super.dispose();
    }

    override customProgramCacheKey(): string {
        return "@rowland/three film";
    }

    override onBeforeCompile(shader: WebGLProgramParametersWithUniforms): void {
        Object.assign(shader.uniforms, this.uniforms);
        const put = (chunk: string, before: string, after: string) => {
            const only = (text: string) => text && `#if defined(ROWLAND_FILM) && defined(USE_IRIDESCENCE)\n${text}\n#endif\n`;
            shader.fragmentShader = shader.fragmentShader.replace(`#include <${chunk}>`, `${only(before)}#include <${chunk}>\n${only(after)}`);
        };
        put("lights_physical_pars_fragment", "", FILM);
        put("lights_physical_fragment", "",
            "prepare_film(material, saturate(dot(normal, normalize(vViewPosition))), roughnessFactor);");
        // Where the base is clear the film still reflects, and passes the rest. Colours are multiplied by alpha already.
        put("opaque_fragment", "#ifndef OPAQUE\noutgoingLight = diffuseColor.a * totalDiffuse + totalSpecular + totalEmissiveRadiance;\n" +
            "vec3 behind = (1.0 - diffuseColor.a) * film_transmitted;\n" +
            "diffuseColor.a = 1.0 - (behind.r + behind.g + behind.b) / 3.0;\n#endif", "");
        put("premultiplied_alpha_fragment", "#undef PREMULTIPLIED_ALPHA", "");
    }
}
