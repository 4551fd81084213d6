// Bakes for tests that draw the same gratings and films many times, by one of three's renderers after the other.
import { Rowland } from "../dist/index.js";

/**
 * Bakes once what materials ask for with equal arguments: a grating, a light's map or table of it, a film. What differs in any
 * argument is baked for itself. Workers keep what they have, also when materials are disposed.
 */
export class SharedRowland extends Rowland {
    baked = new Map();
    ids = new Map(); // by which the workers know the grating that a material has at present

    once(task, of, bake) {
        const asked = task + JSON.stringify(of, (_, part) => (ArrayBuffer.isView(part) ? [...part] : part));
        if (!this.baked.has(asked)) this.baked.set(asked, bake());
        return this.baked.get(asked);
    }
    /** Of what depends on the light. */
    lit(task, of, bake) {
        return this.once(task, [this.lightVersion, ...of], bake);
    }

    material(id, ...of) {
        this.ids.set(id, this.once("id", of, () => this.baked.size));
        const known = this.ids.get(id);
        return this.once("material", [known], () => super.material(known, ...of));
    }
    release() {}
    solve(relief) {
        return this.once("solve", [relief], () => super.solve(relief, () => true));
    }
    keyLobes() {
        return this.lit("keyLobes", [], () => super.keyLobes());
    }
    plane(id, ...of) {
        const known = this.ids.get(id);
        return this.lit("plane", [known, ...of], () => super.plane(known, ...of));
    }
    arc(id, ...of) {
        const known = this.ids.get(id);
        return this.once("arc", [known, ...of], () => super.arc(known, ...of));
    }
    products(id, ...of) {
        const known = this.ids.get(id);
        return this.lit("products", [known, ...of], () => super.products(known, ...of));
    }
    reference(id, ...of) {
        return super.reference(this.ids.get(id), ...of);
    }
    grooveMoments(...of) {
        return this.once("grooveMoments", of, () => super.grooveMoments(...of));
    }
    filmTable(film) {
        return this.once("film", [film], () => super.filmTable(film));
    }
}
