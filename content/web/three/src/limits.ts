import type { WebGLProgramParametersWithUniforms } from "three";

/** Maps of MeshPhysicalMaterial, the layer beneath the grooves: those come first that are missed least. */
const MAPS = ["diffuseRoughnessMap", "specularIntensityMap", "specularColorMap", "sheenRoughnessMap", "sheenColorMap", "iridescenceThicknessMap",
    "iridescenceMap", "thicknessMap", "transmissionMap", "anisotropyMap", "clearcoatRoughnessMap", "clearcoatNormalMap", "clearcoatMap", "aoMap",
    "lightMap", "bumpMap", "emissiveMap", "metalnessMap", "roughnessMap", "alphaMap", "normalMap", "map"];

/** What a grating adds to a program of MeshPhysicalMaterial. */
export interface Additions {
    textures: number;
    /** Of a table: each is three vectors between the stages. */
    layers: number;
    grooveTexture: boolean;
}

type Parameters = Record<string, number | boolean | undefined>;
const sum = (parameters: Parameters, ...names: string[]) => names.reduce((all, name) => all + Number(parameters[name] ?? 0), 0);
const present = (parameters: Parameters) => MAPS.filter((name) => parameters[name]);
const shadows = (parameters: Parameters) =>
    sum(parameters, "numSunLightShadows", "numDirLightShadows", "numSpotLightShadows", "numPointLightShadows", "numSpotLightMaps");

/** Of both stages, as three counts them. */
function texturesOf(parameters: Parameters, added: Additions): number {
    const lookUpTable = 1;
    return present(parameters).length + sum(parameters, "displacementMap", "envMap", "transmission", "skinning", "morphTargets", "batchingColor",
        "instancingMorph", "numLightProbeGrids") + 2 * sum(parameters, "batching") + (parameters.numRectAreaLights ? 2 : 0) + shadows(parameters) +
        lookUpTable + added.textures;
}

/** Rows of four components that the varyings are packed into (GLSL ES 3.00, appendix A.7): pairs share a row, single ones fill gaps. */
function varyingsOf(parameters: Parameters, { layers, grooveTexture }: Additions): number {
    const vectors = 3 + sum(parameters, "transmission") + 2 * sum(parameters, "vertexTangents") + shadows(parameters) +
        (parameters.vertexColors || parameters.instancingColor || parameters.batchingColor ? 1 : 0);
    const pairs = present(parameters).length + sum(parameters, "displacementMap") + (parameters.vertexUv1s ? 1 : 0) + (grooveTexture ? 1 : 0);
    return vectors + 3 * layers + Math.ceil(pairs / 2);
}

/**
 * Leaves out maps, then layers of a table, until a program has at most these texture units and varying vectors: WebGL 2
 * promises 16 and 15. The parameters of onBeforeCompile are changed.
 */
export function fit(
    given: WebGLProgramParametersWithUniforms, added: Additions, maxTextures: number, maxVaryings: number,
): { leftOut: string[]; layers: number } {
    const parameters = given as unknown as Parameters;
    const leftOut: string[] = [];
    const fits = (layers: number) => texturesOf(parameters, added) <= maxTextures && varyingsOf(parameters, { ...added, layers }) <= maxVaryings;
    if (!fits(added.layers)) parameters.vertexTangents = false; // three then has tangents from derivatives of the texture's coordinates
    for (const name of present(parameters)) {
        if (fits(added.layers)) break;
        parameters[name] = false;
        if (name === "normalMap") parameters.normalMapTangentSpace = parameters.normalMapObjectSpace = false;
        leftOut.push(name);
    }
    let { layers } = added;
    while (layers > 1 && !fits(layers)) layers -= 1;
    return { leftOut, layers };
}
