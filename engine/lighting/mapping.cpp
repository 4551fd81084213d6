#include "engine/lighting/mapping.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/core/error.h"

namespace rowland::lighting {

namespace {

constexpr std::array kNames{std::pair("equirect", Mapping::Equirectangular), std::pair("angular", Mapping::Angular),
                            std::pair("auto", Mapping::Auto)};

/// Whether the image is black outside its inscribed circle.
bool black_outside_circle(const image::Image& image) {
    constexpr double kBlack = 0.01;   // of the mean radiance inside
    constexpr double kCaption = 0.1;  // of the texels outside
    double inside = 0.0;
    std::size_t inside_count = 0;
    std::vector<double> outside;
    for (int row = 0; row < image.height; ++row)
        for (int column = 0; column < image.width; ++column) {
            const glm::vec3& texel = image.at(column, row);
            const double sum = static_cast<double>(texel.x) + texel.y + texel.z;
            const double radiance = std::isfinite(sum) ? sum : 0.0;
            // The rim crosses texels up to a diagonal away.
            const double radius = std::hypot(2 * column + 1 - image.width, 2 * row + 1 - image.height);
            if (radius <= image.width) {
                inside += radiance;
                ++inside_count;
            } else if (radius > image.width + 3) {
                outside.push_back(radiance);
            }
        }
    if (outside.empty()) return false;
    const double limit = kBlack * inside / static_cast<double>(inside_count);
    std::size_t bright = 0;
    for (const double radiance : outside) bright += radiance > limit ? 1 : 0;
    return static_cast<double>(bright) <= kCaption * static_cast<double>(outside.size());
}

}  // namespace

Mapping parse_mapping(const std::string& name) {
    for (const auto& [known, mapping] : kNames)
        if (name == known) return mapping;
    refuse_input("probe mapping", "", fmt::format("\"{}\"", name.substr(0, 40)), "equirect, angular or auto");
}

const char* mapping_name(Mapping mapping) {
    return kNames.at(static_cast<std::size_t>(mapping)).first;
}

Mapping recognised_mapping(const image::Image& image, const std::string& file) {
    if (image.width != image.height || image.width <= 1) return Mapping::Equirectangular;
    if (black_outside_circle(image)) return Mapping::Angular;
    refuse_input(
        file, "",
        fmt::format("a square image of {} x {} texels with light outside its circle", image.width, image.height),
        "an angular map, black outside its circle, or a panorama twice as wide as high",
        "say which it is: the mapping \"angular\" or \"equirect\"");
}

}  // namespace rowland::lighting
