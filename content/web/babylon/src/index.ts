export { registerGratings } from "./gltf.js";
export { readPanorama } from "./panorama.js";
export { GratingPlugin, gratingMaterial, type GratingOptions } from "./plugin.js";
export { Rowland, type Efficiencies, type Panorama } from "../../three/src/rowland.js";
export type { Representation } from "../../three/src/grating_state.js";
export type { Grooves } from "./surface.js";
