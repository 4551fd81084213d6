import { MeshPhysicalMaterial, type IUniform, type WebGLProgramParametersWithUniforms } from "three";
import { FILM, FILM_TABLE } from "./generated/shaders.js";
import type { FilmValues } from "./film_table.js";
import { withFilm } from "./with_film.js";

/**
 * MeshPhysicalMaterial of WebGLRenderer whose reflection is that of thin layers, summed over wavelengths and both
 * polarisations. Until its table arrives, three's own iridescence shows.
 */
export class FilmMaterial extends withFilm(MeshPhysicalMaterial) {
    private readonly uniforms: Record<string, IUniform> = {};

    /** @internal */
    override filmChanged(): void {
        for (const [name, value] of Object.entries(this.filmValues as FilmValues)) (this.uniforms[name] ??= { value }).value = value;
        this.premultipliedAlpha = true;
        const { FILM_LINE: _, FILM_ROUGHNESSES: __, FILM_PATHS: ___, ...others } = this.defines ?? {};
        this.defines = { ...others, ROWLAND_FILM: "1", [this.filmRows!]: "1" };
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
        put("lights_physical_pars_fragment", "", `${FILM_TABLE}\n${FILM}`);
        put("lights_physical_fragment", "",
            "prepare_film(material, saturate(dot(normal, normalize(vViewPosition))), roughnessFactor);");
        // Where the base is clear the film still reflects, and passes the rest. Colours are multiplied by alpha already.
        put("opaque_fragment", "#ifndef OPAQUE\noutgoingLight = diffuseColor.a * totalDiffuse + totalSpecular + totalEmissiveRadiance;\n" +
            "vec3 behind = (1.0 - diffuseColor.a) * film_transmitted;\n" +
            "diffuseColor.a = 1.0 - (behind.r + behind.g + behind.b) / 3.0;\n#endif", "");
        put("premultiplied_alpha_fragment", "#undef PREMULTIPLIED_ALPHA", "");
    }
}
