#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace rowland::evidence {

using Json = nlohmann::ordered_json;

/// What the sections read and how fine they measure.
struct Inputs {
    std::filesystem::path data;  ///< folder of the measured data and captured probes
};

/// A part of the page. `measure` returns
///
///     title       heading
///     text        paragraphs: sources, conditions, stated errors, what follows
///     tables      [{caption, columns: [text], rows: [[text or number]]}]
///     plots       [{caption, x: {label, from, to}, y: {label, from, to},
///                   series: [{name, kind: "line" | "points" | "band", points: [[x, y] or, of a band, [x, low,
///                   high]]}]}]
///     pictures    [{caption, image: a data URL}]
///     figures     {name: number}: the numbers that tests hold and other pages quote
///
/// each optional but the title. It throws Error (input) for data that is missing or wrong.
struct Section {
    const char* name;         ///< on the command line
    bool on_request = false;  ///< takes long or needs more than the others: only if it is named
    Json (*measure)(const Inputs& inputs) = nullptr;
};

/// The sections in the page's order.
const std::vector<Section>& sections();

/// The page: one HTML file that needs no other. `measured`: what sections returned, each with its "name".
std::string page_html(const Json& measured);

/// Efficiencies of ruled gratings: a manufacturer's curves, scalar theory, and Maxwell's equations.
Json curves(const Inputs& inputs);
/// Where the line of a disc lies and which wavelengths stand along it: drawn, and by the formula.
Json photographs(const Inputs& inputs);
/// Reflectances of metals by several authors' refractive indices.
Json metals(const Inputs& inputs);
/// What others would use, on the same disc.
Json peers(const Inputs& inputs);
/// A disc whose pits repeat at many spacings, after Sun's disc.
Json pit_sequence(const Inputs& inputs);

/// What a frame budget makes of a walk through the demo's rooms: errors and representations against time.
Json level(const Inputs& inputs);

/// `value` with so many significant digits, for tables.
inline std::string digits(double value, int count = 3) {
    return fmt::format("{:.{}g}", value, count);
}

}  // namespace rowland::evidence
