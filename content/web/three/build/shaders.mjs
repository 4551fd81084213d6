// Writes src/generated/shaders.ts: the GLSL of the tree with its includes pasted in, for three. Uniform blocks become
// plain uniforms, as three gives blocks to ShaderMaterial alone. Branches of defines that this package never makes are
// left out. src/generated/sparkle.ts has what takes the line "#include GROOVE_SPARKLE".
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { here, top } from "./places.mjs";

/// Without the lines of C++ in a header that both languages read, as engine/gpu/shader_library.cpp.
function glslLines(text) {
    let group = "both";
    let nested = 0;
    return text.split("\n").filter((line) => {
        if (group === "both" && line.startsWith("#ifdef __cplusplus")) {
            group = "cpp";
            return false;
        }
        if (group === "both") return true;
        const wasCpp = group === "cpp";
        if (line.startsWith("#if")) nested += 1;
        else if (line.startsWith("#endif") && nested > 0) nested -= 1;
        else if (line.startsWith("#else") && nested === 0) {
            group = "glsl";
            return false;
        } else if (line.startsWith("#endif")) {
            group = "both";
            return false;
        }
        return !wasCpp;
    });
}

/** Whether defines of the engine are made here. */
const MADE = new Map([["GL_ES", true], ...["VERTEX_STAGE", "PUNCTUAL_LIGHTS", "DIRECTIONAL_LIGHTS", "SEVERAL_DIRECTIONAL_LIGHTS", "LIGHTS_AT_VERTICES", "VERTEX_SHADED",
    "SHADOWS", "HAS_UV", "HAS_UV1", "HAS_COLOURS", "NORMAL_MAP", "TRANSMISSION", "LATTICE", "STREAK", "TURNS", "LOBE_PIT_SEQUENCE",
    "SMALL_LIGHTS", "LIGHTS_FROM_VERTICES", "SHADOWED_AT_PIXELS", "FINE_GROOVE_PARTS"].map((name) => [name, false])]);

/** A condition without what is known of it: true, false, or the text of the rest. */
function conditionOf(words, made) {
    let at = 0;
    const binary = (operator, operand, absorbing) => () => {
        const rest = [];
        let absorbed = false;
        do {
            const value = operand();
            if (value === absorbing) absorbed = true;
            else if (value !== !absorbing) rest.push(value);
        } while (words[at] === operator && ++at);
        return absorbed ? absorbing : rest.length === 0 ? !absorbing : rest.length === 1 ? rest[0] : `(${rest.join(` ${operator} `)})`;
    };
    const unary = () => {
        const word = words[at++];
        if (word === "!") {
            const value = unary();
            return typeof value === "boolean" ? !value : `!${value}`;
        }
        if (word === "(") {
            const value = either();
            ++at;
            return value;
        }
        if (word !== "defined") throw new Error(`${words.join(" ")}: found ${word}; expected defined(NAME), as another condition is kept whole`);
        at += 3;
        return made.get(words[at - 2]) ?? `defined(${words[at - 2]})`;
    };
    const both = binary("&&", unary, false);
    const either = binary("||", both, true);
    const value = either();
    return typeof value === "string" && value.startsWith("(") ? value.slice(1, -1) : value;
}

function valueOf(directive, rest, made) {
    if (directive === "ifdef" || directive === "ifndef") {
        const value = made.get(rest) ?? `defined(${rest})`;
        return directive === "ifdef" ? value : typeof value === "boolean" ? !value : `!${value}`;
    }
    return /^[\w\s()!&|]*$/.test(rest) && /defined/.test(rest) ? conditionOf(rest.match(/\w+|&&|\|\||[!()]/g), made) : rest;
}

/** Lines without branches that are known not to be taken, and without the conditions of those that are. */
function taken(lines) {
    const made = new Map(MADE);
    const groups = []; // outer ones first
    const result = [];
    for (const line of lines.join("\n").replace(/\\\n\s*/g, " ").split("\n")) {
        const [, directive, rest] = /^#\s*(ifdef|ifndef|if|elif|else|endif)\b\s*(.*?)\s*$/.exec(line) ?? [];
        const group = groups.at(-1);
        const outer = groups.slice(0, -1).every(({ shown }) => shown);
        const shown = outer && (group?.shown ?? true);
        if (!directive) {
            if (!shown) continue;
            result.push(line);
            const [, name] = /^#\s*define (\w+)/.exec(line) ?? [];
            if (name && groups.some(({ open }) => open)) made.delete(name); // the compiler knows
            else if (name) made.set(name, true);
        } else if (directive.startsWith("if")) {
            const value = valueOf(directive, rest, made);
            groups.push({ shown: value !== false, done: value === true, open: typeof value === "string" });
            if (typeof value === "string" && shown) result.push(`#if ${value}`.replace(/^#if (!?)defined\((\w+)\)$/, (_, not, name) => `#if${not && "n"}def ${name}`));
        } else if (directive === "endif") {
            groups.pop();
            if (group.open && outer) result.push(line);
        } else {
            const value = group.done ? false : directive === "else" ? true : valueOf(directive, rest, made);
            group.shown = value !== false;
            group.done ||= value === true;
            if (value === false || !outer) {
                if (typeof value === "string") group.open = true;
            } else if (value === true) {
                if (group.open) result.push("#else");
            } else {
                result.push(`#${group.open ? "elif" : "if"} ${value}`);
                group.open = true;
            }
        }
    }
    return result;
}

function paste(text, pasted) {
    return glslLines(text).flatMap((line) => {
        const include = /^\s*#\s*include\s*"([^"]*)"/.exec(line);
        if (!include) return [line];
        if (pasted.has(include[1])) return [];
        pasted.add(include[1]);
        return paste(readFileSync(top + include[1], "utf8"), pasted);
    });
}

const plainUniforms = (text) =>
    text.replace(/ROWLAND_BLOCK\(\d+, \w+\) \{([^}]*)\};/g, (_, members) =>
        members.replace(/^\s*(\w[^;]*;)/gm, "uniform $1"))
        .replace(/^#define (ROWLAND_MAXIMUM_\w+) (\d+)$/gm, "#ifndef $1\n#define $1 $2\n#endif");

function shader(file) {
    const text = paste(readFileSync(file, "utf8"), new Set()).join("\n");
    const bare = text.replace(/\/\*[^]*?\*\//g, "").replace(/\/\/.*/g, "");
    return taken(plainUniforms(bare).split("\n"))
        .map((line) => line.trim())
        .map((line) => (/^#|\\$/.test(line) ? line : line.replace(/ *([=<>,;:?{}()*]|&&|\|\|) */g, "$1").replace(/(\w|\)) ?([-+/]) ?(?=\w|\()/g, "$1$2")))
        .filter((line) => line !== "" && !line.startsWith("precision "))
        .join("\n")
        .replace(/^(?!#)(.*[;{}])\n(?!#)/gm, "$1"); // a directive has a line of its own
}

const own = (name) => JSON.stringify(shader(here + "src/glsl/" + name));
mkdirSync(here + "src/generated", { recursive: true });
writeFileSync(
    here + "src/generated/shaders.ts",
    `// Generated by build/shaders.mjs.\nexport const VERTEX = ${own("surface.vert.glsl")};\n` +
        `export const FRAGMENT = ${own("surface.frag.glsl")};\n` +
        `export const FILM_TABLE = ${own("film_table.frag.glsl")};\n` +
        `export const FILM = ${own("film.frag.glsl")};\n`);
writeFileSync(
    here + "src/generated/sparkle.ts",
    "// Generated by build/shaders.mjs.\nexport const SPARKLE = " +
        `${JSON.stringify(`#ifdef GROOVE_SPARKLE\n${shader(top + "modules/diffraction/shaders/sparkle.glsl")}\n#endif`)};\n`);
