export { Diffraction } from "./diffraction.js";
export { RowlandMaterialsDiffraction } from "./extension.js";
export { withGratings } from "./with_gratings.js";
export type { CellProfile, GrooveLobe, Grooves, Lattice, Members, Profile } from "./members.js";
