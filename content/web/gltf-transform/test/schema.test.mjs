// The extension's schema: it is the parser's, and samples satisfy it. ROWLAND_TRADE names the program rowland-trade, beside
// which rowland-cook lies.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { basename, dirname, join } from "node:path";
import test from "node:test";
import { pathToFileURL } from "node:url";
import Ajv2020 from "ajv/dist/2020.js";
import validator from "gltf-validator";
import { extensionFolder, NAME, samples, cabinet, io } from "./samples.mjs";

const file = `${extensionFolder}schema/material.${NAME}.schema.json`;
const text = readFileSync(file, "utf8");
const cook = process.env.ROWLAND_TRADE && join(dirname(process.env.ROWLAND_TRADE), "rowland-cook");

test("the schema is what make_schema.mjs makes of the parser's", { skip: cook ? false : "needs ROWLAND_TRADE" }, async () => {
    const { extensionSchema, textOf } = await import(pathToFileURL(extensionFolder + "schema/make_schema.mjs"));
    const recorded = JSON.parse(execFileSync(cook, ["schema", NAME], { encoding: "utf8" }));
    assert.equal(text, textOf(extensionSchema(recorded)) + "\n");
});

/** What the two schemas of glTF that it refers to ask for, by the specification of glTF 2.0. */
const glTFProperty = { $id: "glTFProperty.schema.json", type: "object",
    properties: { extensions: { type: "object", additionalProperties: { type: "object" } }, extras: {} } };
const textureInfo = { $id: "textureInfo.schema.json", type: "object", allOf: [{ $ref: "glTFProperty.schema.json" }],
    properties: { index: { type: "integer", minimum: 0 }, texCoord: { type: "integer", minimum: 0, default: 0 } }, required: ["index"] };
const satisfies = new Ajv2020({ schemas: [glTFProperty, textureInfo], strict: true, strictRequired: false, allowUnionTypes: true })
    .compile(JSON.parse(text));

for (const path of [...samples, cabinet])
    test(`${basename(path)} satisfies the schema and Khronos' validator`, async () => {
        const { json } = await io.readAsJSON(path);
        assert.ok(json.extensionsUsed.includes(NAME) && !json.extensionsRequired?.includes(NAME));
        const objects = json.materials.map(({ extensions }) => extensions?.[NAME]).filter(Boolean);
        assert.ok(objects.length > 0);
        for (const object of objects) assert.ok(satisfies(object), JSON.stringify(satisfies.errors));
        const { issues } = await validator.validateBytes(new Uint8Array(readFileSync(path)),
            { externalResourceFunction: async (uri) => new Uint8Array(readFileSync(join(dirname(path), uri))) });
        assert.deepEqual(issues.messages.filter(({ severity }) => severity <= 1), []);
    });

const CD = { grating: { pitch_nm: 1600, profile: { type: "lamellar", duty: 0.35, depth_nm: 90 } } };
for (const [what, object] of [
    ["no grating", {}],
    ["a member that no version knows", { ...CD, pitch: 3 }],
    ["a pitch of nothing", { grating: { ...CD.grating, pitch_nm: 0 } }],
    ["a profile without its depth", { grating: { pitch_nm: 1600, profile: { type: "sinusoidal" } } }],
    ["a texture without an index", { ...CD, grooveTexture: { sparkle: true } }],
    ["extensions of a texture that are no objects", { ...CD, grooveTexture: { index: 0, extensions: { TEST_a: 1 } } }],
])
    test(`the schema refuses ${what}`, () => {
        assert.ok(satisfies(CD), JSON.stringify(satisfies.errors));
        assert.ok(!satisfies(object));
    });
