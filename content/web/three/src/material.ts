import {
    MeshPhysicalMaterial, type BufferGeometry, type Camera, type Object3D, type Scene,
    type WebGLProgramParametersWithUniforms, type WebGLRenderer,
} from "three";
import { FRAGMENT, VERTEX } from "./generated/shaders.js";
import { graded, type GratingParameters } from "./graded.js";

/**
 * MeshPhysicalMaterial of WebGLRenderer under a diffraction grating. The physical material is the layer beneath it.
 * `rowland`'s probe and three's lights light both; until the first map or table arrives, only the layer is drawn. Each
 * mesh needs a material for itself, since the map follows the mesh.
 */
export class GratingMaterial extends graded(MeshPhysicalMaterial) {
    private applied: string[] = []; // options that are defines

    constructor(parameters: GratingParameters = {}) {
        super(parameters);
    }

    /** @internal */
    override optionsChanged(): void {
        const { options } = this.state;
        const defines = (this.defines ??= {});
        for (const key of this.applied) delete defines[key];
        if (options.has("ROWLAND")) Object.assign(defines, Object.fromEntries(options));
        this.applied = options.has("ROWLAND") ? [...options.keys()] : [];
        this.needsUpdate = true;
    }

    override onBeforeRender(_: WebGLRenderer, scene: Scene, __: Camera, geometry: BufferGeometry, object: Object3D): void {
        this.state.see(scene, geometry, object);
    }

    override customProgramCacheKey(): string {
        return "@rowland/three";
    }

    override onBeforeCompile(shader: WebGLProgramParametersWithUniforms): void {
        Object.assign(shader.uniforms, this.state.values);
        const put = (text: string, chunk: string, before: string, after: string) =>
            text.replace(`#include <${chunk}>`, `${before}\n#include <${chunk}>\n${after}`);
        const only = (text: string) => `#ifdef ROWLAND\n${text}\n#endif`;
        shader.vertexShader = put(shader.vertexShader, "common", "",
            only("#ifndef USE_TANGENT\nin vec4 tangent;\n#endif\n" +
                `#if defined(ROWLAND_GROOVE_UV) && !defined(USE_UV1)\nin vec2 uv1;\n#endif\n${VERTEX}`));
        shader.vertexShader = put(shader.vertexShader, "project_vertex", "",
            only("pass_grooves_in_view(transformed, objectNormal, tangent, transformedNormal);"));
        let fragment = shader.fragmentShader;
        fragment = put(fragment, "lights_physical_pars_fragment", "", only(FRAGMENT));
        fragment = put(fragment, "lights_fragment_begin", only("prepare_grooves();"), "");
        fragment = put(fragment, "opaque_fragment",
            only("vec3 mirrored = vec3(0.0);\n#ifdef USE_ENVMAP\n" +
                "mirrored = getIBLRadiance(geometryViewDir, normal, 0.0);\n#endif\n" +
                "outgoingLight = grating_surface(totalDiffuse + totalSpecular, mirrored) + totalEmissiveRadiance;"),
            // Colours outside the screen's gamut are desaturated until no component is negative.
            "#if defined(ROWLAND) && !defined(ROWLAND_UNCOMPRESSED) && !defined(ROWLAND_DIFFRACTION_ONLY)\n" +
                "gl_FragColor.rgb -= min(min(gl_FragColor.r, gl_FragColor.g), min(gl_FragColor.b, 0.0));\n#endif");
        shader.fragmentShader = fragment;
    }
}
