import {
    ExtensionProperty, PropertyType, TextureChannel, TextureInfo, type IProperty, type Nullable, type Texture,
} from "@gltf-transform/core";
import type { Members } from "./members.js";

export const NAME = "ROWLAND_materials_diffraction";

type Json = Record<string, unknown>;

interface Attributes extends IProperty {
    members: Members & Json;
    grooveRotation: number;
    grooveTexture: Texture;
    grooveTextureInfo: TextureInfo;
    sparkle: boolean;
    textureMembers: Json;
}

/** A copy without undefined members, so that neither a caller's object nor a document's is shared. */
const copied = <Value>(value: Value): Value => JSON.parse(JSON.stringify(value)) as Value;

/** The grating on a Material. Values that getters give are copies: change them with the setters. */
export class Diffraction extends ExtensionProperty<Attributes> {
    static EXTENSION_NAME: typeof NAME = NAME;
    declare extensionName: typeof NAME;
    declare propertyType: "Diffraction";
    declare parentTypes: [PropertyType.MATERIAL];

    protected init(): void {
        this.extensionName = NAME;
        this.propertyType = "Diffraction";
        this.parentTypes = [PropertyType.MATERIAL];
    }

    protected getDefaults(): Nullable<Attributes> {
        return Object.assign(super.getDefaults() as IProperty, {
            members: { grating: { pitch_nm: 1600, profile: { type: "lamellar", duty: 0.5, depth_nm: 150 } } } as Members & Json,
            grooveRotation: 0,
            grooveTexture: null,
            grooveTextureInfo: new TextureInfo(this.graph, "grooveTextureInfo"),
            sparkle: false,
            textureMembers: {},
        });
    }

    /** A member that is JSON alone, or one that this version does not know; undefined where the object has none. */
    getMember<Name extends keyof Members>(name: Name): Members[Name];
    getMember(name: string): unknown;
    getMember(name: string): unknown {
        const value = this.get("members")[name];
        return value === undefined ? undefined : copied(value);
    }

    /** Undefined removes the member. */
    setMember<Name extends keyof Members>(name: Name, value: Members[Name]): this {
        return this.setMembers({ ...this.get("members"), [name]: value });
    }

    getMembers(): Members & Json {
        return copied(this.get("members"));
    }

    /** All of them at once, as a material file has them; the rotation and the texture of the grooves stay. */
    setMembers(members: Members & Json): this {
        return this.set("members", copied(members));
    }

    getGrating(): Members["grating"] {
        return this.getMember("grating");
    }
    setGrating(grating: Members["grating"]): this {
        return this.setMember("grating", grating);
    }

    /** Of g, across the grooves, from the tangent toward the bitangent, in radians. */
    getGrooveRotation(): number {
        return this.get("grooveRotation");
    }
    setGrooveRotation(radians: number): this {
        return this.set("grooveRotation", radians);
    }

    /** R: further rotation / π; G: half the pitch over the grating's, 0 where there is no grating. Linear. */
    getGrooveTexture(): Texture | null {
        return this.getRef("grooveTexture");
    }
    setGrooveTexture(texture: Texture | null): this {
        return this.setRef("grooveTexture", texture, { channels: TextureChannel.R | TextureChannel.G });
    }
    /** Sampler and texture coordinates; null without a texture. */
    getGrooveTextureInfo(): TextureInfo | null {
        return this.getRef("grooveTexture") ? this.getRef("grooveTextureInfo") : null;
    }

    /** Whether a pixel shows the grooves of one texel. */
    getSparkle(): boolean {
        return this.get("sparkle");
    }
    setSparkle(sparkle: boolean): this {
        return this.set("sparkle", sparkle);
    }

    /** @internal Members of grooveTexture that this version does not know. */
    getTextureMembers(): Json {
        return copied(this.get("textureMembers"));
    }
    /** @internal */
    setTextureMembers(members: Json): this {
        return this.set("textureMembers", copied(members));
    }
}
