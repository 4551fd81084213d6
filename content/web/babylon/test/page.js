// What the tests draw, of the part that the task names: what they compare is posted to /result.
import { Engine } from "@babylonjs/core/Engines/engine.js";
import * as THREE from "../../three/node_modules/three/build/three.module.js";
import { FilmMaterial, Rowland as ThreeRowland } from "../../three/dist/index.js";
import { shown as filmByThree } from "../../three/test/film_points.js";
import { PointMaterial, radiance as radianceByThree } from "../../three/test/points.js";
import { readPanorama, Rowland } from "../dist/index.js";
import { comparisons } from "./instances.js";
import { filmReflectance, panoramaOf, panoramaOfDirections, radiance } from "./points.js";
import { byBabylon, byThree } from "./scene.js";

const post = (value) => fetch("/result", { method: "POST", body: JSON.stringify(value) });
const pixelsOfUrl = async (url) => {
    const image = Object.assign(new Image(), { src: url });
    await image.decode();
    return [...pixelsOf(image, image.width, image.height)];
};

async function rowlandUnder(Class, probe, keys) {
    const rowland = new Class();
    rowland.onError = (error) => errors.push(error.message);
    await rowland.setProbe({ ...probe, texels: probe.texels.slice() }, { keyLights: "later" });
    const found = keys ?? await rowland.fitKeyLights(16);
    await rowland.setKeyLights(found);
    return { rowland, keys: found };
}

const started = performance.now();
const times = {};
const took = (name) => (times[name] = Math.round(performance.now() - started));

async function points({ cases, mirrors, films }, { rowland, three }) {
    const engine = new Engine(document.createElement("canvas"), false);
    const results = [];
    for (const one of cases) results.push(await radiance(engine, rowland, one));
    took("points");
    const url = URL.createObjectURL(panoramaOfDirections(128, 64));
    const mirrored = [];
    for (const one of mirrors) mirrored.push(await radiance(engine, rowland, { ...one, mirrors: url }));
    took("mirrors");
    const renderer = new THREE.WebGLRenderer();
    const byThree = [];
    for (const one of cases) byThree.push(one.three ? await radianceByThree({ renderer, Material: PointMaterial }, three.rowland, one) : null);
    took("three's points");
    const white = URL.createObjectURL(panoramaOf(32, 16, () => [128, 128, 128, 129]));
    const filmResults = [];
    for (const one of films) {
        const views = one.views.filter((_, i) => i % 5 === 0);
        filmResults.push({ babylon: await filmReflectance(engine, rowland, white, one), three: await filmByThree([renderer, FilmMaterial], three.rowland, { ...one, views }) });
    }
    took("films");
    return { results, mirrored, byThree, films: filmResults };
}

async function scenes({ kinds }, { rowland, three, panorama }) {
    const compared = await comparisons(rowland, pixelsOfUrl);
    took("instances and cameras");
    const drawn = { babylon: await byBabylon(rowland, "light.hdr", kinds), three: await byThree(three.rowland, panorama, kinds) };
    took("scenes");
    const pictures = Object.fromEntries(compared.flatMap(({ name, urls }) => Object.entries(urls).map(([of, url]) => [`${name}_${of}`, url])));
    const diffracted = {};
    for (const [name, { pictures: kinds }] of Object.entries(drawn)) {
        diffracted[name] = await pixelsOfUrl(kinds.diffracted);
        for (const [of, picture] of Object.entries(kinds)) pictures[`${name}_${of}`] = picture;
    }
    await import("../examples/disc.js");
    const canvas = document.querySelector("canvas");
    const begun = performance.now();
    let green = 0; // fraction of the pixels, which neither the sky nor a disc without grooves has
    while (green < 0.0005 && errors.length === 0 && performance.now() < begun + 120000) {
        await new Promise(requestAnimationFrame);
        const pixels = pixelsOf(canvas, canvas.width, canvas.height);
        green = 0;
        for (let i = 0; i < pixels.length; i += 4)
            if (pixels[i + 1] > Math.max(pixels[i], pixels[i + 2]) + 20) green += 4 / pixels.length;
    }
    took("example");
    pictures.disc = canvas.toDataURL("image/png");
    return { compared, diffracted, gltfFilm: drawn.babylon.film, pictures, green };
}

try {
    const task = await (await fetch("/task")).json();
    const panorama = await readPanorama("light.hdr");
    const { rowland, keys } = await rowlandUnder(Rowland, panorama);
    const under = { panorama, rowland, three: await rowlandUnder(ThreeRowland, panorama, keys) };
    took("light");
    const drawn = await { points, scenes }[task.part](task, under);
    await post({ errors, times, ...drawn });
} catch (error) {
    await post({ errors: [...errors, error.message + "\n" + error.stack] });
}
