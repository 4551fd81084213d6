// Posts the radiance of the points of a test.
import * as THREE from "three";
import { EXRLoader } from "three/examples/jsm/loaders/EXRLoader.js";
import { HDRLoader } from "three/examples/jsm/loaders/HDRLoader.js";
import { Rowland } from "../dist/index.js";
import { radiance, reference } from "./points.js";

const post = (value) => fetch("/result", { method: "POST", body: JSON.stringify(value) });

try {
    const { probe, keyLights, cases } = await (await fetch("/task")).json();
    const renderer = new THREE.WebGLRenderer();
    const rowland = new Rowland();
    rowland.onError = (error) => post({ error: error.message });
    const loader = probe.endsWith(".exr") ? new EXRLoader() : new HDRLoader();
    loader.setDataType(THREE.FloatType);
    const light = await loader.loadAsync(probe);
    // three takes a byte of a Radiance mantissa as n/255; the format and Rowland as n/256.
    if (probe.endsWith(".hdr")) light.image.data = light.image.data.map((x) => (x * 255) / 256);
    await rowland.setProbe(light, { keyLights });
    const results = [];
    for (const one of cases)
        results.push(await (one.representation === "reference" ? reference(rowland, one) : radiance(renderer, rowland, one)));
    await post({ results });
} catch (error) {
    await post({ error: error.message + "\n" + error.stack });
}
