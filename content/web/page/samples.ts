import { BufferGeometry, PlaneGeometry, RingGeometry, SphereGeometry } from "three";
import bluRay from "../../materials/blu_ray.json";
import cd from "../../materials/cd.json";
import foil from "../../materials/holographic_foil.json";
import ruled from "../../materials/ruled_1200.json";
import vinyl from "../../materials/ruled_600.json";

/** A slider on a number of a material, at a path of its JSON. */
export interface Slider {
    label: string;
    path: string[];
    from: number;
    to: number;
    step: number;
}

/** Of the samples of rigorous theory, by build.mjs: what Tasks.solve() gives, its values rounded, in efficiencies.bin. */
declare const BUILT_IN_EFFICIENCIES: Record<string, { header: number[]; first: number; count: number }>;
export const EFFICIENCY_UNIT = 1 / 65535;

/** So that nothing is solved when the page opens. */
export async function builtInEfficiencies(): Promise<(name: string) => Float32Array | undefined> {
    const values = new Uint16Array(await (await fetch("efficiencies.bin")).arrayBuffer());
    return (name) => {
        const solved = BUILT_IN_EFFICIENCIES[name];
        if (!solved) return undefined;
        const own = Array.from(values.subarray(solved.first, solved.first + solved.count), (x) => x * EFFICIENCY_UNIT);
        return Float32Array.from([...solved.header, ...own]);
    };
}

export interface Sample {
    name: string;
    material: object;
    geometry: () => BufferGeometry;
    position: [number, number, number];
}

/** Without what the page chooses itself. */
function bare(material: object): object {
    const { quality, ...rest } = material as { quality?: unknown };
    return rest;
}

const disc = () => new RingGeometry(0.023, 0.058, 160, 24).rotateX(-Math.PI / 2);

/** A plate whose grooves run along its height. */
function plate(width: number, height: number): BufferGeometry {
    const geometry = new PlaneGeometry(width, height).rotateX(-Math.PI / 2);
    geometry.computeTangents();
    return geometry;
}

function sphere(): BufferGeometry {
    const geometry = new SphereGeometry(0.035, 96, 64);
    geometry.computeTangents();
    return geometry;
}

export const SAMPLES: Sample[] = [
    { name: "CD", material: bare(cd), geometry: disc, position: [-0.07, 0, 0] },
    { name: "Blu-ray", material: bare(bluRay), geometry: disc, position: [0.07, 0, 0] },
    { name: "Ruled grating, 1200 / mm", material: bare(ruled), geometry: () => plate(0.05, 0.05), position: [-0.07, 0, 0.1] },
    { name: "Ruled grating, 600 / mm", material: bare(vinyl), geometry: () => plate(0.05, 0.05), position: [0.005, 0, 0.1] },
    { name: "Foil ball", material: bare(foil), geometry: sphere, position: [0.085, 0.035, 0.1] },
];

const SLIDERS: Slider[] = [
    { label: "Pitch, nm", path: ["grating", "pitch_nm"], from: 300, to: 4000, step: 10 },
    { label: "Depth, nm", path: ["grating", "profile", "depth_nm"], from: 10, to: 600, step: 1 },
    { label: "Duty", path: ["grating", "profile", "duty"], from: 0.05, to: 0.95, step: 0.01 },
    { label: "Slit, nm", path: ["grating", "profile", "width_nm"], from: 50, to: 2000, step: 10 },
    { label: "Thickness, nm", path: ["film", "thickness_nm"], from: 0, to: 1200, step: 5 },
    { label: "Film's index", path: ["film", "ior"], from: 1, to: 3, step: 0.01 },
    { label: "Cover's index", path: ["cover", "ior"], from: 1, to: 2.5, step: 0.01 },
];

type Json = { [key: string]: Json | number };

export function numberAt(material: object, path: string[]): number | undefined {
    let at: Json | number | undefined = material as Json;
    for (const key of path) at = typeof at === "object" ? at[key] : undefined;
    return typeof at === "number" ? at : undefined;
}

export function withNumber(material: object, path: string[], value: number): object {
    const copy = structuredClone(material) as Json;
    let at = copy;
    for (const key of path.slice(0, -1)) at = at[key] as Json;
    at[path[path.length - 1]] = value;
    return copy;
}

export function slidersOf(material: object): Slider[] {
    return SLIDERS.flatMap((slider) => {
        const value = numberAt(material, slider.path);
        return value === undefined ? [] : [{ ...slider, to: Math.max(slider.to, 2 * value) }];
    });
}
