import { Extension, PropertyType, type GLTF, type ReaderContext, type WriterContext } from "@gltf-transform/core";
import { Diffraction, NAME } from "./diffraction.js";
import type { Members } from "./members.js";

interface TextureDef extends GLTF.ITextureInfo {
    sparkle?: boolean;
    [unknown: string]: unknown;
}

type Def = Members & GLTF.IProperty & { grooveRotation?: number; grooveTexture?: TextureDef; [unknown: string]: unknown };

/** ROWLAND_materials_diffraction: io.registerExtensions([RowlandMaterialsDiffraction]). */
export class RowlandMaterialsDiffraction extends Extension {
    static readonly EXTENSION_NAME: typeof NAME = NAME;
    readonly extensionName: typeof NAME = NAME;
    // Materials are there before meshes are. KHR_texture_transform, whose turn is after these, finds the grooves' texture.
    readonly prereadTypes = [PropertyType.MESH];
    readonly prewriteTypes = [PropertyType.MESH];

    createDiffraction(): Diffraction {
        return new Diffraction(this.document.getGraph());
    }

    preread(context: ReaderContext): this {
        const { materials = [], textures = [] } = context.jsonDoc.json;
        materials.forEach(({ extensions }, index) => {
            const def = extensions?.[NAME] as Def | undefined;
            if (!def) return;
            const { grooveRotation, grooveTexture, extras, ...members } = def;
            const diffraction = this.createDiffraction().setMembers(members);
            context.materials[index].setExtension(NAME, diffraction);
            if (extras) diffraction.setExtras(extras);
            if (grooveRotation !== undefined) diffraction.setGrooveRotation(grooveRotation);
            if (grooveTexture) this.readTexture(context, diffraction, grooveTexture, textures);
        });
        return this;
    }

    private readTexture(context: ReaderContext, diffraction: Diffraction, def: TextureDef, textures: GLTF.ITexture[]): void {
        const { index, texCoord: _, sparkle, extras: __, extensions: ___, ...unknown } = def;
        const texture = context.textures[textures[index]?.source ?? -1];
        if (!texture) throw new Error(`${NAME}: grooveTexture.index ${index} has no image; expected a texture with a source`);
        diffraction.setGrooveTexture(texture).setTextureMembers(unknown);
        if (sparkle !== undefined) diffraction.setSparkle(sparkle);
        context.setTextureInfo(diffraction.getGrooveTextureInfo()!, def); // KHR_texture_transform reads its part of it
    }

    prewrite(context: WriterContext): this {
        for (const material of this.document.getRoot().listMaterials()) {
            const diffraction = material.getExtension<Diffraction>(NAME);
            if (!diffraction) continue;
            const def: Def = { ...context.createPropertyDef(diffraction), ...diffraction.getMembers() };
            if (diffraction.getGrooveRotation() !== 0) def.grooveRotation = diffraction.getGrooveRotation();
            const texture = diffraction.getGrooveTexture();
            if (texture) {
                // The object itself goes into the document, as KHR_texture_transform adds to it.
                const textureDef = context.createTextureInfoDef(texture, diffraction.getGrooveTextureInfo()!) as TextureDef;
                def.grooveTexture = Object.assign(textureDef, diffraction.getTextureMembers());
                if (diffraction.getSparkle()) textureDef.sparkle = true;
            }
            const materialDef = context.jsonDoc.json.materials![context.materialIndexMap.get(material)!];
            materialDef.extensions = { ...materialDef.extensions, [NAME]: def };
        }
        return this;
    }

    read(): this {
        return this;
    }
    write(): this {
        return this;
    }
}
