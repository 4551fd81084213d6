// src/glsl/film.frag.glsl and modules/thin_film/shaders/film_lookup.glsl in TSL.
import { CustomBlending, OneFactor, OneMinusSrcAlphaFactor, type Texture } from "three";
import {
    BRDF_GGX, DFGLUT, diffuseColor, diffuseContribution, F_Schlick, float, log2, materialIridescence, materialIridescenceThickness,
    materialRoughness, metalness, min, mix, normalView, positionViewDirection, roughness, specularColor, specularColorBlended, specularF90,
    sqrt, texture, uniform, vec2, vec3,
} from "three/tsl";
import { MeshPhysicalNodeMaterial, PhysicalLightingModel, type NodeBuilder } from "three/webgpu";
import type { FilmRows, FilmValues } from "../film_table.js";
import { withFilm } from "../with_film.js";
import type { Float, Vec3, Vec4 } from "./program.js";

/** By columns: M, and in the fourth row what the film reflects of white. */
type Columns = readonly [Vec4, Vec4, Vec4];

/** A table's nodes. */
class FilmLookup {
    private readonly table;
    private readonly path;
    private readonly axes;
    readonly rough;

    constructor(private readonly rows: FilmRows, { film_table, film_path, film_axes, film_rough }: FilmValues) {
        this.table = texture(film_table);
        this.path = uniform(film_path);
        this.axes = uniform(film_axes);
        this.rough = uniform(film_rough);
    }

    take({ film_table, film_path, film_axes, film_rough }: FilmValues): void {
        this.table.value = film_table as Texture;
        this.path.value = film_path;
        this.axes.value = film_axes;
        this.rough.value = film_rough;
    }

    // The row of a lobe is that of its mean_square_cosine() in film_table.h.
    private film_row(cosine: Float, thickness_nm: Float, lobe: Float): Float {
        const spread = lobe.mul(lobe).mul(lobe).mul(3.1).add(1);
        const path_nm = sqrt(this.path.x.add(0.72).add(cosine.mul(cosine).sub(0.72).div(spread))).mul(thickness_nm).mul(2);
        return log2(path_nm.add(250)).mul(this.path.y).add(this.path.z) as Float;
    }

    film_matrix(cosine: Float, thickness_nm: Float, lobe: Float): Columns {
        const { axes, path } = this;
        const column = sqrt(cosine.add(0.02)).mul(axes.x).add(axes.y).toVar();
        const layer = lobe.greaterThan(0).select(axes.z, float(0));
        const at = (i: number) => axes.w.mul(i);
        const read = this.rows === "FILM_LINE"
            ? (i: number) => vec2(column.add(layer).add(at(i)), 0.5)
            : (i: number) => vec2(column, this.rows === "FILM_ROUGHNESSES"
                ? min(lobe, path.w).mul(path.y).add(path.z).add(at(i)) : this.film_row(cosine, thickness_nm, lobe).add(layer).add(at(i)));
        return [0, 1, 2].map((i) => this.table.sample(read(i)).level(float(0)).toVar()) as unknown as Columns;
    }
}

const reflected = (columns: Columns, light: Vec3): Vec3 =>
    columns[0].xyz.mul(light.x).add(columns[1].xyz.mul(light.y)).add(columns[2].xyz.mul(light.z)) as Vec3;

/** The layer beneath has three's light without its Fresnel term, and the film has its own. */
class FilmLightingModel extends PhysicalLightingModel {
    private seen!: Columns; // M of the lobe that the view sees
    private f0!: Vec3;
    private f90!: Float;
    private readonly thickness_nm = materialIridescenceThickness as unknown as Float;

    constructor(private readonly film: FilmLookup, private readonly clear: boolean, layer: MeshPhysicalNodeMaterial) {
        super(layer.useClearcoat, layer.useSheen, false, layer.useAnisotropy, layer.useTransmission, layer.useDispersion);
    }

    override start(builder: NodeBuilder): void {
        const n_v = normalView.dot(positionViewDirection).clamp().toVar() as unknown as Float;
        this.f0 = (specularColorBlended as unknown as Vec3).toVar() as Vec3;
        this.f90 = (specularF90 as unknown as Float).toVar() as Float;
        this.seen = this.film.film_matrix(n_v, this.thickness_nm, this.film.rough.mul(materialRoughness) as unknown as Float);
        const white = vec3(this.seen[0].w, this.seen[1].w, this.seen[2].w);
        const passing = white.mul(materialIridescence).oneMinus().clamp().toVar();
        diffuseContribution.mulAssign(passing);
        if (this.clear) {
            // Where the base is clear the film still reflects, and passes the rest. Colours are multiplied by alpha already.
            diffuseContribution.mulAssign(diffuseColor.a);
            diffuseColor.a.assign(diffuseColor.a.oneMinus().mul(passing.dot(vec3(1 / 3))).oneMinus());
        }
        for (const colour of [specularColor, specularColorBlended]) colour.assign(vec3(0));
        for (const number of [specularF90, metalness]) number.assign(float(0));
        super.start(builder);
    }

    private over(bare: Vec3, film: Vec3): Vec3 {
        return mix(bare, film.max(0), materialIridescence) as unknown as Vec3;
    }

    override direct(light: Parameters<PhysicalLightingModel["direct"]>[0], builder: NodeBuilder): void {
        super.direct(light, builder);
        const toward = light.lightDirection as unknown as Vec3;
        const brdf = BRDF_GGX({ lightDirection: toward, f0: vec3(1), f90: float(1), roughness } as never) as unknown as Vec3;
        const lobe = brdf.mul(light.lightColor as unknown as Vec3).mul(normalView.dot(toward).clamp()).toVar() as Vec3;
        const half = (toward.add(positionViewDirection) as Vec3).normalize() as Vec3;
        const v_h = positionViewDirection.dot(half).clamp().toVar() as unknown as Float;
        const film = reflected(this.film.film_matrix(v_h, this.thickness_nm, float(0)), lobe);
        const bare = lobe.mul(F_Schlick({ f0: this.f0, f90: this.f90, dotVH: v_h } as never) as unknown as Vec3) as Vec3;
        (light.reflectedLight.directSpecular as unknown as Vec3).addAssign(this.over(bare, film));
    }

    override indirectSpecular(builder: NodeBuilder): void {
        super.indirectSpecular(builder);
        const { radiance, reflectedLight } = builder.context as unknown as { radiance: Vec3; reflectedLight: { indirectSpecular: Vec3 } };
        const dfg = (DFGLUT({ roughness, dotNV: normalView.dot(positionViewDirection).clamp() } as never) as unknown as Vec3).toVar();
        // three's least roughness would darken a mirror.
        const albedo = this.film.rough.greaterThan(0).select(dfg.x.add(dfg.y), float(1));
        const film = reflected(this.seen, radiance).mul(albedo) as Vec3;
        const bare = this.f0.mul(dfg.x).add(this.f90.mul(dfg.y)).mul(radiance) as Vec3;
        reflectedLight.indirectSpecular.addAssign(this.over(bare, film));
    }
}

/** FilmMaterial for WebGPURenderer, on WebGPU and on its WebGL 2 back end, with its parameters. */
export class FilmNodeMaterial extends withFilm(MeshPhysicalNodeMaterial) {
    private _lookup?: FilmLookup;
    private _rows?: FilmRows;

    static override get type(): string {
        return "FilmNodeMaterial";
    }

    /** @internal */
    override filmChanged(): void {
        if (this._lookup && this._rows === this.filmRows) this._lookup.take(this.filmValues!);
        else this._lookup = new FilmLookup((this._rows = this.filmRows!), this.filmValues!);
        if (this.transparent) Object.assign(this, { blending: CustomBlending, blendSrc: OneFactor, blendDst: OneMinusSrcAlphaFactor });
    }

    override customProgramCacheKey(): string {
        return `${this.type} ${this.id} ${this.filmRows} ${super.customProgramCacheKey()}`;
    }

    override setupLightingModel(): PhysicalLightingModel {
        return this._lookup ? new FilmLightingModel(this._lookup, this.transparent, this) : super.setupLightingModel();
    }
}
