import { Canvas, extend, useLoader } from "@react-three/fiber";
import { useEffect, useMemo } from "react";
import { FloatType } from "three";
import { HDRLoader } from "three/examples/jsm/loaders/HDRLoader.js";
import { GratingMaterial, Rowland } from "@rowland/three";

extend({ GratingMaterial });
const rowland = new Rowland();
const cd = { grating: { pitch_nm: 1600, profile: { type: "lamellar", duty: 0.35, depth_nm: 130 } }, metal: "Al" };

function Disc() {
    const light = useLoader(HDRLoader, "light.hdr", (loader) => loader.setDataType(FloatType));
    useEffect(() => void rowland.setProbe(light), [light]);
    const args = useMemo(() => [{ rowland, grating: cd }], []);
    return <mesh><ringGeometry args={[0.2, 0.6, 128, 8]} /><gratingMaterial args={args} /></mesh>;
}

export const App = () => <Canvas camera={{ position: [0, 0, 2] }}><Disc /></Canvas>;
