#include "modules/diffraction/asset/lattice_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "modules/diffraction/asset/height_map_png.h"
#include "modules/diffraction/asset/profile_json.h"

namespace rowland::diffraction {

namespace {

constexpr double kShortestSide_nm = 300.0;
constexpr double kLongestSide_nm = 1e7;
/// Between a and b: flatter cells have their orders closer together than any picture of them resolves.
constexpr double kLeastAngle_degrees = 2.0;

glm::dvec2 parse_side(JsonReader& json, const char* key) {
    const std::vector<double> side = json.numbers(key, 2, {.minimum = -kLongestSide_nm, .maximum = kLongestSide_nm});
    const glm::dvec2 vector(side[0], side[1]);
    const double length = glm::length(vector);
    if (!(length >= kShortestSide_nm && length <= kLongestSide_nm))
        json.fail(key, fmt::format("a length of {} nm", length),
                  fmt::format("a length in [{}, {}] nm", kShortestSide_nm, kLongestSide_nm));
    return vector;
}

void parse_sides(JsonReader json, Lattice& lattice) {
    lattice.a_nm = parse_side(json, "a_nm");
    lattice.b_nm = parse_side(json, "b_nm");
    const double area = std::abs(lattice.a_nm.x * lattice.b_nm.y - lattice.a_nm.y * lattice.b_nm.x);
    const double sine = std::min(1.0, area / (glm::length(lattice.a_nm) * glm::length(lattice.b_nm)));
    const double angle_degrees = std::asin(sine) * 180.0 / std::numbers::pi;
    if (angle_degrees < kLeastAngle_degrees)
        json.fail("b_nm", fmt::format("{:.3g} degrees between a and b", angle_degrees),
                  fmt::format("at least {} degrees", kLeastAngle_degrees),
                  "for grooves of one direction give pitch_nm instead");
    json.finish();
}

Profile parse_grooves(JsonReader& json, const char* key, double pitch_nm) {
    const ReadNamed no_table = [&](const std::string&) -> NamedText {
        json.fail(std::string(key) + "/type", "a table of efficiencies",
                  "slit, lamellar, sinusoidal or blazed in a crossed profile");
    };
    return parse_profile(json.object(key), pitch_nm, no_table);
}

LatticeProfile parse_height_map(JsonReader& json, int orders, const ReadNamed& read) {
    const double depth_nm = json.number("depth_nm", {.minimum = 0.0, .minimum_open = true});
    const std::string name = json.text("file");
    if (name.empty()) json.fail("file", "an empty name", "a PNG of the heights of one cell");
    HeightMap map = read_height_map(read(name));
    map.depth_nm = depth_nm;
    // A picture of n texels has n distinct orders.
    if (2 * orders >= std::min(map.columns, map.rows))
        json.fail("file", fmt::format("{} x {} texels with {} orders", map.columns, map.rows, orders),
                  fmt::format("more than {} texels on each side", 2 * orders), "or list fewer orders");
    return map;
}

LatticeProfile parse_lattice_profile(JsonReader json, const Lattice& lattice, const ReadNamed& read) {
    const double a_nm = glm::length(lattice.a_nm);
    const double b_nm = glm::length(lattice.b_nm);
    const auto within = [](double side_nm) {
        return NumberRange{.minimum = 0.0, .maximum = side_nm, .minimum_open = true};
    };
    LatticeProfile profile;
    const std::string type = json.choice("type", {"crossed", "aperture", "height_map"});
    if (type == "crossed") {
        CrossedProfile crossed;
        crossed.along_a = parse_grooves(json, "along_a", a_nm);
        crossed.along_b = parse_grooves(json, "along_b", b_nm);
        profile = std::move(crossed);
    } else if (type == "aperture") {
        profile = ApertureProfile{.width_nm = json.number("width_nm", within(a_nm)),
                                  .height_nm = json.number("height_nm", within(b_nm))};
    } else {
        profile = parse_height_map(json, lattice.orders, read);
    }
    json.finish();
    return profile;
}

}  // namespace

Grating parse_lattice_grating(JsonReader& json, const ReadNamed& read) {
    for (const char* member : {"pitch_nm", "grooves", "normalization", "groove_lobe"})
        if (json.has(member))
            json.fail(member, fmt::format("{} beside a lattice", member), "no such member",
                      "it is for grooves of one direction");
    Lattice lattice;
    parse_sides(json.object("lattice"), lattice);
    lattice.orders = static_cast<int>(json.integer_or("orders", lattice.orders, 1, kHighestLatticeOrder));
    lattice.profile = parse_lattice_profile(json.object("profile"), lattice, read);
    Grating grating;
    grating.pitch_nm = std::min(glm::length(lattice.a_nm), glm::length(lattice.b_nm));
    grating.orders.clear();
    grating.lattice = std::move(lattice);
    return grating;
}

}  // namespace rowland::diffraction
