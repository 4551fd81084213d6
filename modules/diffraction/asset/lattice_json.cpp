// A material's lattice, and the picture of its heights.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "engine/core/error.h"
#include "engine/image/byte_image.h"
#include "modules/diffraction/asset/material.h"

namespace rowland::diffraction {

namespace {

constexpr double kShortestSide_nm = 300.0;
constexpr double kLongestSide_nm = 1e7;
/// Between a and b: flatter cells have their orders closer together than any picture of them resolves.
constexpr double kLeastAngle_degrees = 2.0;

glm::dvec2 parse_side(JsonReader& json, const char* key) {
    const NumberRange range{.minimum = -kLongestSide_nm, .maximum = kLongestSide_nm};
    const auto vector = read_vector<glm::dvec2>(json, key, range);
    if (json.is_recording_schema()) return vector;
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
    if (angle_degrees < kLeastAngle_degrees && !json.is_recording_schema())
        json.fail("b_nm", fmt::format("{:.3g} degrees between a and b", angle_degrees),
                  fmt::format("at least {} degrees", kLeastAngle_degrees),
                  "for grooves of one direction give pitch_nm instead");
    json.finish();
}

LatticeProfile parse_height_map(JsonReader& json, int orders, const ReadNamed& read) {
    const double depth_nm = json.number("depth_nm", {.minimum = 0.0, .exclusive_minimum = true});
    const std::string name = json.file_name("file", "a PNG of the heights of one cell");
    if (json.is_recording_schema()) return HeightMap{};
    HeightMap map = read_height_map(read(name));
    map.depth_nm = depth_nm;
    // A picture of n texels has n distinct orders.
    if (2 * orders >= std::min(map.columns, map.rows))
        json.fail("file", fmt::format("{} x {} texels with {} orders", map.columns, map.rows, orders),
                  fmt::format("more than {} texels on each side", 2 * orders), "or list fewer orders");
    return map;
}

LatticeProfile parse_lattice_profile(JsonReader json, const Lattice& lattice, const ReadNamed& read) {
    const auto length = [&](const glm::dvec2& side) {
        return json.is_recording_schema() ? std::numeric_limits<double>::infinity() : glm::length(side);
    };
    const double a_nm = length(lattice.a_nm);
    const double b_nm = length(lattice.b_nm);
    const auto within = [](double side_nm) {
        return NumberRange{.minimum = 0.0, .maximum = side_nm, .exclusive_minimum = true};
    };
    LatticeProfile profile;
    json.variant("type", {"crossed", "aperture", "height_map"}, [&](JsonReader& reader, std::size_t type) {
        if (type == 0)
            profile = CrossedProfile{.along_a = parse_profile(reader.object("along_a"), a_nm, {}),
                                     .along_b = parse_profile(reader.object("along_b"), b_nm, {})};
        else if (type == 1)
            profile = ApertureProfile{.width_nm = reader.number("width_nm", within(a_nm)),
                                      .height_nm = reader.number("height_nm", within(b_nm))};
        else
            profile = parse_height_map(reader, lattice.orders, read);
    });
    json.finish();
    return profile;
}

}  // namespace

Grating parse_lattice_grating(JsonReader& json, const ReadNamed& read) {
    for (const char* member : {"pitch_nm", "grooves", "normalization", "groove_lobe"})
        json.refuse_if_there(member, fmt::format("{} beside a lattice", member), "no such member",
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

HeightMap read_height_map(const NamedText& png) {
    const std::span<const std::byte> bytes = std::as_bytes(std::span(png.text));
    if (!image::is_png(bytes)) refuse_input(png.file, {}, "another format", "a PNG of the heights of one cell");
    const image::ByteImageSize size = image::byte_image_size(bytes, png.file);
    if (size.width > kLargestHeightMap || size.height > kLargestHeightMap)
        refuse_input(png.file, {}, fmt::format("{} x {} texels", size.width, size.height),
                     fmt::format("at most {0} x {0} for the heights of one cell", kLargestHeightMap),
                     "scale the picture down");
    const image::ByteImage picture = image::decode_byte_image(bytes, png.file);
    HeightMap map{.columns = picture.width, .rows = picture.height, .heights = {}, .depth_nm = 0.0};
    for (std::size_t texel = 0; texel < picture.rgba.size(); texel += 4) map.heights.push_back(picture.rgba[texel]);
    return map;
}

std::string write_height_map(const HeightMap& map) {
    std::vector<std::uint8_t> rgb;
    for (const std::uint8_t height : map.heights) rgb.insert(rgb.end(), 3, height);
    const std::vector<std::byte> png = image::encode_png(map.columns, map.rows, 3, rgb);
    return {reinterpret_cast<const char*>(png.data()), png.size()};
}

}  // namespace rowland::diffraction
