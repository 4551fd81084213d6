import type { Data3DTexture, DataArrayTexture, Matrix3, Texture, Vector2, Vector3, Vector4 } from "three";
import { float, int, ivec2, Loop, texture, texture3D, textureSize, uniform, uniformArray, vec2 } from "three/tsl";
import type { GratingState } from "../grating_state.js";
import type { Node, TextureNode, UniformNode } from "three/webgpu";

export type Float = Node<"float">;
export type Int = Node<"int">;
export type Uint = Node<"uint">;
export type Bool = Node<"bool">;
export type Vec2 = Node<"vec2">;
export type Vec3 = Node<"vec3">;
export type Vec4 = Node<"vec4">;
/** Columns. */
export type Mat3 = readonly [Vec3, Vec3, Vec3];

type Value = Texture | Vector2 | Vector3 | Vector4 | Matrix3 | number;

/** A numeric uniform's node, or a texture's. */
interface Slot {
    readonly kind: string;
    readonly node: { value: unknown };
}

const kindOf = (value: Value) =>
    (value as Data3DTexture).isData3DTexture ? "volume" : (value as DataArrayTexture).isDataArrayTexture ? "array"
        : (value as Texture).isTexture ? "plane" : "numbers";

/** for (int name = start; name < end; ++name) body(name). Loops within loops need names of their own. */
export function loop(name: string, start: number, end: number | Int, body: (i: Int) => void): void {
    Loop({ name, start, end, type: "int", condition: "<" } as never, ((inputs: Record<string, Int>) => body(inputs[name])) as never);
}

/**
 * The defines and uniforms of the GLSL for the functions of this folder, which are its functions by the same names: an
 * option is read when the graph is built, and a uniform's node follows its value.
 */
export class Program {
    private readonly slots = new Map<string, Slot>();
    private lobes?: { from?: unknown; array: Vector4[]; node: ReturnType<typeof uniformArray> };

    constructor(private readonly state: Pick<GratingState, "values" | "options">) {}

    has(option: string): boolean {
        return this.state.options.has(option);
    }
    text(option: string): string | undefined {
        return this.state.options.get(option);
    }
    number(option: string): number {
        return Number(this.text(option));
    }

    /** Whether the value has come, for those that come with a mesh. Graphs are built again when it does. */
    knows(name: string): boolean {
        return name in this.state.values;
    }

    /** What distinguishes graphs. */
    get key(): string {
        return this.has("ROWLAND") ? [...this.state.options].map((option) => option.join("=")).sort().join() : "";
    }

    private node<Of>(name: string, make: (value: never) => { value: unknown }): Of {
        const value = this.state.values[name].value as Value;
        const kind = kindOf(value);
        let slot = this.slots.get(name);
        if (slot?.kind !== kind) this.slots.set(name, (slot = { kind, node: make(value as never) }));
        return slot.node as Of;
    }

    private numbers<Type extends string>(name: string): Node<Type> {
        return this.node<UniformNode<Type, unknown>>(name, (value) => uniform(value).setName(name));
    }
    float = (name: string) => this.numbers<"float">(name);
    vec2 = (name: string) => this.numbers<"vec2">(name);
    vec3 = (name: string) => this.numbers<"vec3">(name);
    vec4 = (name: string) => this.numbers<"vec4">(name);
    mat3 = (name: string) => this.numbers<"mat3">(name);

    private texture(name: string): TextureNode {
        return this.node(name, (value) =>
            (kindOf(value) === "volume" ? texture3D(value) : texture(value)).setName(name) as never);
    }
    /** textureLod() of sampler2D and, with three coordinates, of sampler3D. */
    textureLod(name: string, uv: Vec2 | Vec3, level: Float = float(0)): Vec4 {
        return this.texture(name).sample(uv).level(level);
    }
    /** Width and height in texels, of a level. */
    size(name: string, level: Int = int(0)): Vec2 {
        return vec2(textureSize(this.texture(name), level) as never);
    }
    /** textureLod() at level 0 of sampler2DArray. */
    textureLayer(name: string, uv: Vec2, layer: number): Vec4 {
        return this.texture(name).sample(uv).depth(int(layer)).level(float(0));
    }
    textureGrad(name: string, uv: Vec2, [across, down]: readonly [Vec2, Vec2]): Vec4 {
        return this.texture(name).sample(uv).grad(across, down);
    }
    /** STORED_VEC4 of dialect.glsl. */
    stored_vec4(name: string, at: Int): Vec4 {
        return this.texture(name).load(ivec2(at.bitAnd(1023), at.shiftRight(10)));
    }

    /** KeyLobe of light_blocks.h. */
    key_lobe(i: Int): KeyLobe {
        const array = this.lobeVectors();
        if (this.lobes?.array.length !== array.length) this.lobes = { array, node: uniformArray(array, "vec4") };
        const { node } = this.lobes;
        const at = (member: number) => (node.element(i.mul(MEMBERS.length).add(member)) as unknown as Vec4).toVar();
        return Object.fromEntries(MEMBERS.map((name, member) => [name, at(member)])) as unknown as KeyLobe;
    }
    private lobeVectors(): Vector4[] {
        const lobes = this.state.values.key_lobes.value as Record<string, Vector4>[];
        return lobes.flatMap((lobe) => MEMBERS.map((name) => lobe[name]));
    }

    /** Gives the nodes the uniforms' present values. */
    update(): void {
        for (const [name, { kind, node }] of this.slots) {
            const value = this.state.values[name].value as Value;
            if (kindOf(value) === kind) node.value = value;
        }
        const { value } = this.state.values.key_lobes;
        if (!this.lobes || this.lobes.from === value) return;
        this.lobes.from = value;
        const array = this.lobeVectors();
        if (array.length === this.lobes.array.length) array.forEach((vector, i) => this.lobes!.array[i].copy(vector));
    }
}

const MEMBERS = ["direction", "flux", "moments", "turns", "variance"] as const;

/** What key_light_windows.glsl reads of it. */
export type KeyLobe = Readonly<Record<(typeof MEMBERS)[number], Vec4>>;
