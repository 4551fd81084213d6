#include "tests/evidence/peers/picture_grid.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>

#include "editor/trade/measure_error.h"
#include "modules/diffraction/evaluate/error_measure.h"

namespace rowland::evidence {

namespace {

constexpr int kMagnified = 3;
constexpr int kGap = 2;  ///< pixels between panels, before they are magnified
constexpr std::uint8_t kGapGrey = 128;

}  // namespace

std::vector<glm::vec3> panel(const trade::PictureFrames& frames, std::span<const glm::dvec3> xyz,
                             float exposure_stops) {
    return trade::displayed(diffraction::picture(frames, xyz), exposure_stops);
}

std::vector<glm::vec3> raw_panel(const trade::PictureFrames& frames, std::span<const glm::dvec3> rgb) {
    std::vector<glm::vec3> pixels;
    for (const glm::dvec3& value : diffraction::picture(frames, rgb))
        pixels.push_back(glm::clamp(glm::vec3(value), 0.0F, 1.0F));
    return pixels;
}

std::string panel_grid(const trade::PictureFrames& frames, const std::vector<std::vector<glm::vec3>>& panels,
                       int columns) {
    const int rows = (static_cast<int>(panels.size()) + columns - 1) / columns;
    trade::RgbPicture grid{.width = (columns * (frames.width + kGap) - kGap) * kMagnified,
                           .height = (rows * (frames.height + kGap) - kGap) * kMagnified,
                           .rgb = {}};
    const auto width = static_cast<std::size_t>(grid.width);
    grid.rgb.assign(3 * width * static_cast<std::size_t>(grid.height), kGapGrey);
    for (std::size_t i = 0; i < panels.size(); ++i) {
        const int left = static_cast<int>(i) % columns * (frames.width + kGap) * kMagnified;
        const int top = static_cast<int>(i) / columns * (frames.height + kGap) * kMagnified;
        for (int y = 0; y < frames.height * kMagnified; ++y)
            for (int x = 0; x < frames.width * kMagnified; ++x) {
                const glm::vec3 colour =
                    panels[i][static_cast<std::size_t>(y / kMagnified * frames.width + x / kMagnified)];
                for (int c = 0; c < 3; ++c)
                    grid.rgb[3 * (static_cast<std::size_t>(top + y) * width + static_cast<std::size_t>(left + x)) +
                             static_cast<std::size_t>(c)] =
                        static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(colour[c], 0.0F, 1.0F)));
            }
    }
    return trade::data_url(grid);
}

}  // namespace rowland::evidence
