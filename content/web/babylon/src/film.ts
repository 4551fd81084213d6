import { Constants } from "@babylonjs/core/Engines/constants.js";
import { Color3 } from "@babylonjs/core/Maths/math.color.js";
import { PBRMaterial } from "@babylonjs/core/Materials/PBR/pbrMaterial.js";
import type { SubMesh } from "@babylonjs/core/Meshes/subMesh.js";
import type { Scene } from "@babylonjs/core/scene.js";
import { definitions, only, ValuesPlugin } from "./plugin.js";
import { filmRows, filmSource, filmValues, type FilmFile } from "./shared/film_table.js";
import { FILM_TABLE } from "./shared/generated/shaders.js";
import type { Rowland } from "./shared/rowland.js";
import type { FilmTable } from "./shared/tasks.js";

export interface FilmSettings {
    rowland?: Rowland;
    /** A film material file's JSON: { film: { ior, thickness_nm }, base: { ior } or metal, roughness }. */
    film?: object;
}

const FILM = "defined(ROWLAND_FILM) && defined(IRIDESCENCE)";
const CODE: Record<string, Record<string, string>> = {
    fragment: {
        CUSTOM_FRAGMENT_DEFINITIONS: only(FILM, `${definitions(FILM_TABLE)}
float film_thickness_nm;
mat3x4 film_seen; // M of the lobe that the view sees
vec3 film_transmitted; // fraction of white light
#ifdef SPECULARTERM
vec3 film_specular(preLightingInfo info, vec3 normal, vec3 f0, vec3 fresnel, float roughness, vec3 colour) {
vec3 lobe = computeSpecularLighting(info, normal, vec3(1.0), vec3(1.0), roughness, colour);
vec3 film = (film_matrix(info.VdotH, film_thickness_nm, 0.0) * lobe).rgb;
return mix(fresnel * lobe, max(film, 0.0), info.iridescenceIntensity);
}
#define computeSpecularLighting film_specular
#endif`),
        "!specularEnvironmentR0=iridescenceOut\\.specularEnvironmentR0;":
            `\n# if !(${FILM})\nspecularEnvironmentR0=iridescenceOut.specularEnvironmentR0;\n# endif\n` +
            only(FILM, `film_thickness_nm = iridescenceOut.iridescenceThickness;
film_seen = film_lobe(NdotV, film_thickness_nm, film_rough * roughness);
film_transmitted = clamp(1.0 - iridescenceIntensity * vec3(film_seen[0].w, film_seen[1].w, film_seen[2].w), 0.0, 1.0);
surfaceAlbedo *= film_transmitted;
// Under the film the layer loses no light by a Fresnel term of its own.
reflectanceF0 *= 1.0 - iridescenceIntensity;
reflectivityOut.reflectanceF90 *= 1.0 - iridescenceIntensity;
specularEnvironmentR90 *= 1.0 - iridescenceIntensity;`),
        CUSTOM_FRAGMENT_BEFORE_FINALCOLORCOMPOSITION: only(`${FILM} && !defined(UNLIT)`, `
#if defined(SPECULARTERM) && defined(ENVIRONMENTBRDF) && defined(MS_BRDF_ENERGY_CONSERVATION)
finalSpecularScaled /= mix(vec3(1.0), coloredEnergyConservationFactor, iridescenceIntensity);
#endif
#ifdef REFLECTION
vec3 film_mirrored = max((film_seen * reflectionOut.environmentRadiance.rgb).rgb, 0.0) * vLightingIntensity.z;
#ifdef ENVIRONMENTBRDF
if (film_rough > 0.0) film_mirrored *= environmentBrdf.y; // Babylon's least roughness would darken a mirror
#ifdef RADIANCEOCCLUSION
film_mirrored *= seo;
#endif
#endif
#ifdef CLEARCOAT
film_mirrored *= clearcoatOut.conservationFactor;
#endif
finalRadianceScaled = mix(finalRadianceScaled, film_mirrored, iridescenceIntensity);
#endif
#ifdef ALPHABLEND
// Where the base is clear the film still reflects, and passes the rest. Colours are multiplied by alpha.
#ifdef REFLECTION
finalIrradiance *= albedoOpacityOut.alpha;
#endif
finalDiffuse *= albedoOpacityOut.alpha;
finalAmbient *= albedoOpacityOut.alpha;
alpha = 1.0 - (1.0 - albedoOpacityOut.alpha) * dot(film_transmitted, vec3(1.0 / 3.0));
#endif`),
    },
};

/**
 * A thin film over a PBRMaterial, exact in spectrum and polarisation, in place of its `iridescence`, whose intensity and
 * textures hold. Without base and metal the film lies on the material's colour, metalness and index of refraction.
 */
export class FilmPlugin extends ValuesPlugin {
    /** Resolves when the table is there; rejects for a bad film. Until then Babylon's own iridescence shows. */
    ready: Promise<void> = Promise.resolve();
    /** The table's largest error, of the largest reflectance at that angle. */
    tableError?: number;
    protected values: Record<string, { value: unknown }> = {};
    protected options: ReadonlyMap<string, string> = new Map();
    private bakes = 0;

    constructor(material: PBRMaterial, { rowland, film }: FilmSettings) {
        super(material, "RowlandFilm");
        material.iridescence.isEnabled = true;
        if (rowland && film) this.bake(rowland, film);
    }

    override getClassName(): string {
        return "FilmPlugin";
    }

    override getCustomCode(shader: string): Record<string, string> | null {
        return CODE[shader] ?? null;
    }

    /** Sets the film, also another one, as sliders do. Textures that vary it must be there. */
    bake(rowland: Rowland, film: object): void {
        const bake = ++this.bakes;
        this.ready = this.table(rowland, film as FilmFile).then((table) => {
            if (bake !== this.bakes) return;
            this.take(table);
            rowland.onUpdate();
        });
        this.ready.catch((error: Error) => rowland.onError(error));
    }

    private async table(rowland: Rowland, file: FilmFile): Promise<FilmTable> {
        const { material, material: { iridescence } } = this;
        const [{ ior = 1.3, thickness_nm } = {}] = [file.film].flat();
        const least_nm = iridescence.thicknessTexture ? iridescence.minimumThickness : undefined;
        const source = filmSource(file, { ior: material.indexOfRefraction, colour: material.albedoColor.asArray(), metalness: material.metallic ?? 0,
            least_nm, roughnessVaries: Boolean(material.metallicTexture ?? material.microSurfaceTexture) });
        if (thickness_nm !== undefined) Object.assign(iridescence, { minimumThickness: least_nm ?? thickness_nm, maximumThickness: thickness_nm });
        iridescence.indexOfRefraction = ior;
        material.roughness = file.roughness ?? 0;
        return rowland.filmTable(source);
    }

    private take(table: FilmTable): void {
        this.dispose();
        this.values = Object.fromEntries(Object.entries(filmValues(table, this.material.roughness!)).map(([name, value]) => [name, { value }]));
        this.valueAdded("film_table");
        this.options = new Map([["ROWLAND_FILM", "1"], [filmRows(table), "1"]]);
        this.tableError = table.error;
        this.material.alphaMode = Constants.ALPHA_PREMULTIPLIED;
        this.optionsChanged();
    }

    override hardBindForSubMesh(_: unknown, scene: Scene, __: unknown, subMesh: SubMesh): void {
        this.bind(subMesh.effect, scene);
    }

    override dispose(): void {
        (this.values.film_table?.value as { dispose(): void } | undefined)?.dispose();
    }
}

/** A material of a film that covers all of it. */
export function filmMaterial(name: string, scene: Scene, settings: FilmSettings): PBRMaterial {
    const material = Object.assign(new PBRMaterial(name, scene), { albedoColor: Color3.Black(), metallic: 0, roughness: 0 });
    new FilmPlugin(material, settings);
    return material;
}
