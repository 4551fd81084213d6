import {
    MeshPhysicalMaterial, type BufferGeometry, type Camera, type IUniform, type Object3D, type Scene, type WebGLProgramParametersWithUniforms,
    type WebGLRenderer,
} from "three";
import { FRAGMENT, VERTEX } from "./generated/shaders.js";
import { fit } from "./limits.js";
import { withGrating, type GratingParameters } from "./with_grating.js";

const UNIFORMS = [...(VERTEX + FRAGMENT).matchAll(/\buniform \w+ (\w+)|\bSTORAGE\(\d+,\w+,\w+,(\w+)\)/g)]
    .map(([, plain, stored]) => plain ?? stored);

/** For "#include GROOVE_SPARKLE", once a grating has asked for it. */
let sparkle = "";

type Hooks = Pick<MeshPhysicalMaterial, "onBeforeCompile" | "onBeforeRender" | "customProgramCacheKey">;

/**
 * MeshPhysicalMaterial of WebGLRenderer under a diffraction grating. The physical material is the layer beneath it.
 * `rowland`'s probe and three's lights light both; until the first map or table arrives, only the layer is drawn.
 */
export class GratingMaterial extends withGrating(MeshPhysicalMaterial) {
    private applied: string[] = []; // options that are defines
    private stale = false; // values that the program in use may lack
    /** What a page sets: onBeforeCompile and others, which follow the material's own. Set before fields are. */
    declare private hooks?: Partial<Hooks>;

    constructor(parameters: GratingParameters = {}) {
        super(parameters);
        const { state } = this;
        // WebGPURenderer draws a copy of its own class with the members of this one, and calls this for the copy's graph.
        Object.assign(this, {
            setupOutgoingLight(this: object): unknown {
                state.refuse("WebGPURenderer", "GratingMaterial", "GratingNodeMaterial of @rowland/three/webgpu");
                return Object.getPrototypeOf(this).setupOutgoingLight.call(this);
            },
        });
    }

    /** @internal */
    override valueAdded(): void {
        this.stale = true;
    }

    /** @internal */
    override valueChanged(): void {
        this.stale = true;
    }

    /** @internal */
    override contentChanged(): void {
        this.stale = true;
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

    /** @internal */
    async loadSparkle(): Promise<void> {
        ({ SPARKLE: sparkle } = await import("./generated/sparkle.js"));
    }

    private render(renderer: WebGLRenderer, scene: Scene, geometry: BufferGeometry, object: Object3D): void {
        this.state.see(scene, geometry, object);
        // three uploads a material's uniforms once while it draws mesh after mesh with it, unless the program changes.
        if (this.stale) renderer.state.useProgram(null as unknown as WebGLProgram);
        this.stale = false;
    }

    /** How many layers of a table the program shows, once it is within the GPU's limits. */
    private fit(shader: WebGLProgramParametersWithUniforms, renderer?: WebGLRenderer): number {
        // A subclass may call onBeforeCompile without the renderer.
        const { maxTextures, maxVaryings } = renderer?.capabilities ?? { maxTextures: Infinity, maxVaryings: Infinity };
        const { options } = this.state;
        const grooveTexture = options.has("ROWLAND_GROOVE_UV");
        const layers = options.has("ROWLAND_ARC") ? Number(options.get("LAYERS")) : 0;
        const tables = layers > 0 ? 3 : options.has("ROWLAND_PLANAR") ? 1 : 0;
        const textures = (options.has("ROWLAND") ? 1 : 0) + tables + (grooveTexture ? 2 : 0) + (layers > 0 && shader.batching ? 1 : 0);
        const found = fit(shader, { textures, layers, grooveTexture }, maxTextures, maxVaryings);
        const lacking = [...found.leftOut, ...(found.layers < layers ? [`${layers - found.layers} of ${layers} layers of its table`] : [])];
        if (lacking.length > 0 && options.has("ROWLAND"))
            this.state.tell(`GratingMaterial "${this.name}": this GPU has ${maxTextures} texture units and ` +
                `${maxVaryings} varying vectors; left out: ${lacking.join(", ")}. Give it fewer maps or lights with shadows`);
        return found.layers;
    }

    private compile(shader: WebGLProgramParametersWithUniforms, renderer?: WebGLRenderer): void {
        const { values } = this.state;
        const shownLayers = `#define SHOWN_LAYERS ${this.fit(shader, renderer)}\n`;
        // Programs take their list of uniforms when they are compiled, and values may come later.
        for (const name of UNIFORMS) shader.uniforms[name] = { get value() { return values[name]?.value ?? null; } } as IUniform;
        const put = (text: string, chunk: string, before: string, after: string) =>
            text.replace(`#include <${chunk}>`, `${before}\n#include <${chunk}>\n${after}`);
        const only = (text: string) => `#ifdef ROWLAND\n${text}\n#endif`;
        let vertex = shader.vertexShader;
        vertex = put(vertex, "common", "",
            only("#ifndef USE_TANGENT\nin vec4 tangent;\n#endif\n" +
                `#if defined(ROWLAND_GROOVE_UV) && !defined(USE_UV1)\nin vec2 uv1;\n#endif\n${shownLayers}${VERTEX}`));
        vertex = put(vertex, "morphnormal_vertex", "", only("groove_normal = objectNormal;"));
        vertex = put(vertex, "morphtarget_vertex", "", only("groove_position = transformed;"));
        shader.vertexShader = put(vertex, "project_vertex", "", only(`mat3 groove_linear = mat3(modelMatrix);
int groove_instance = 0;
#ifdef USE_BATCHING
groove_linear *= mat3(batchingMatrix);
groove_instance = int(getIndirectIndex(gl_DrawID));
#elif defined(USE_INSTANCING)
groove_linear *= mat3(instanceMatrix);
groove_instance = gl_InstanceID;
#endif
#ifdef USE_SKINNING
groove_linear *= mat3(skinMatrix);
#endif
pass_grooves(normal, tangent, groove_linear, transformedNormal, groove_instance);`));
        let fragment = shader.fragmentShader;
        fragment = put(fragment, "lights_physical_pars_fragment", "", only(shownLayers + FRAGMENT.replace("#include GROOVE_SPARKLE", sparkle)));
        fragment = put(fragment, "lights_fragment_begin", only(`vec3 groove_side =
#ifdef FLAT_SHADED
faceDirection * nonPerturbedNormal;
#else
vNormal;
#endif
prepare_grooves(isOrthographic ? vec3(0.0, 0.0, 1.0) : vViewPosition, groove_side);`), "");
        // Before three's sheen and clearcoat, which lie over the grooves.
        fragment = put(fragment, "transmission_fragment", "",
            only("vec3 mirrored = vec3(0.0);\n#ifdef USE_ENVMAP\n" +
                "mirrored = getIBLRadiance(geometryViewDir, normal, 0.0);\n#endif\n" +
                "totalDiffuse = grating_surface(totalDiffuse + totalSpecular, mirrored);\ntotalSpecular = vec3(0.0);"));
        // Colours outside the screen's gamut are desaturated until no component is negative.
        shader.fragmentShader = put(fragment, "opaque_fragment", "",
            only("#if !defined(ROWLAND_UNCOMPRESSED) && !defined(ROWLAND_DIFFRACTION_ONLY)\n" +
                "gl_FragColor.rgb -= min(min(gl_FragColor.r, gl_FragColor.g), min(gl_FragColor.b, 0.0));\n#endif"));
    }

    /** What the material does itself, followed by what a page has set. */
    private hook<Name extends keyof Hooks>(name: Name): Hooks[Name] {
        const given = this.hooks?.[name] as ((...of: unknown[]) => unknown) | undefined;
        const own: Hooks = {
            onBeforeCompile: (...of) => {
                this.compile(of[0], of[1]);
                given?.apply(this, of);
            },
            onBeforeRender: (...of: unknown[]) => {
                const [renderer, scene, , geometry, object] = of as [WebGLRenderer, Scene, Camera, BufferGeometry, Object3D];
                this.render(renderer, scene, geometry, object);
                given?.apply(this, of);
            },
            customProgramCacheKey: () => "@rowland/three " + (given?.apply(this, []) ?? this.hooks?.onBeforeCompile ?? ""),
        };
        return own[name];
    }

    static {
        for (const name of ["onBeforeCompile", "onBeforeRender", "customProgramCacheKey"] as const)
            Object.defineProperty(this.prototype, name, {
                configurable: true,
                get(this: GratingMaterial) { return this.hook(name); },
                set(this: GratingMaterial, given: never) { this.hooks = { ...this.hooks, [name]: given }; },
            });
    }
}
