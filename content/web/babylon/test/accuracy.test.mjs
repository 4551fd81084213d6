// Pixels of Babylon against `rowland-trade evaluate`. ROWLAND_TRADE names the program, ROWLAND_DATA the test data.
import assert from "node:assert/strict";
import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import test from "node:test";
import { CASES, evaluate, KEY_LIGHTS, trade } from "../../three/test/accuracy_cases.mjs";
import { missing as missingHere, resultOfScript } from "./pages.mjs";

const probe = join(process.env.ROWLAND_DATA ?? "../../../../shared", "probes/venice_sunset_256.hdr");
const missing = missingHere || (!trade ? "needs ROWLAND_TRADE, the program rowland-trade" : !existsSync(probe) && `needs ${probe}`);

const TOLERANCE = 2e-3;
const NAMES = ["planar", "arc", "direct", "arc, lobe and cover", "direct, lobe and cover"];
const named = (name) => CASES.find((one) => one.name === name);
const cases = [...NAMES.map((name) => ({ ...named(name), hand: "left" })), ...["planar", "arc"].map((name) => ({ ...named(name), hand: "right" }))];

test("pixels equal rowland-trade evaluate", { skip: missing }, async (t) => {
    const folder = mkdtempSync(join(tmpdir(), "rowland-accuracy-"));
    try {
        const { results, error } = await resultOfScript("test/accuracy_page.js", { probe: "/probe.hdr", keyLights: KEY_LIGHTS, cases }, { "/probe.hdr": probe });
        assert.equal(error, undefined);
        for (const [i, one] of cases.entries())
            await t.test(`${one.name}, ${one.hand}-handed`, () => {
                const expected = evaluate(folder, probe, one);
                const largest = Math.max(...expected.flat().map(Math.abs));
                const worst = Math.max(...expected.map((rgb, point) => Math.max(...rgb.map((x, c) => Math.abs(x - results[i][point][c])))));
                t.diagnostic(`${one.name}, ${one.hand}-handed: ${(worst / largest).toExponential(2)} of the largest component`);
                assert.ok(largest > 0 && worst < TOLERANCE * largest, `${worst / largest} of the largest component: ${results[i][0]} for ${expected[0]}`);
            });
    } finally {
        rmSync(folder, { recursive: true });
    }
});
