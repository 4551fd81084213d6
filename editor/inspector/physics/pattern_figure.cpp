#include "editor/inspector/physics/pattern_figure.h"

#include <algorithm>
#include <cstdlib>

#include "engine/colour/light_spectra.h"
#include "modules/diffraction/bake/pattern_picture.h"

namespace rowland::inspector {

namespace {

/// Texels of the whole picture, of which the figure shows the middle.
constexpr int kPictureSize = 512;
/// Luminance over that of the brightest texel. Fainter texels do not widen the figure.
constexpr double kFaintest = 1e-3;
/// Texels around the outermost order.
constexpr int kMargin = 4;

/// Half the side, in texels, of the middle square that holds what is brighter than `faintest`.
int lit_half(const std::vector<glm::dvec3>& xyz, int size, double faintest) {
    int half = 0;
    for (int row = 0; row < size; ++row)
        for (int column = 0; column < size; ++column)
            if (xyz[static_cast<std::size_t>(row * size + column)].y > faintest)
                half = std::max({half, std::abs(2 * row + 1 - size), std::abs(2 * column + 1 - size)});
    return std::min(half / 2 + 1 + kMargin, size / 2);
}

}  // namespace

const glm::dvec3& PatternFigure::at(double u_g, double u_h) const {
    const auto texel = [&](double u) {
        return std::clamp(static_cast<int>(0.5 * (u / half_width + 1.0) * size), 0, size - 1);
    };
    return xyz[static_cast<std::size_t>(texel(u_h) * size + texel(u_g))];
}

PatternFigure pattern_figure(const diffraction::Material& material) {
    const diffraction::PatternPicture picture =
        diffraction::pattern_picture(material.grating, colour::LightSpectra(material.quality.illuminant), kPictureSize);
    const diffraction::PatternPicture::Level& finest = picture.levels.front();
    std::vector<glm::dvec3> white;
    white.reserve(finest.density.size());
    double brightest = 0.0;
    for (const glm::mat3& density : finest.density) {
        white.push_back(glm::dmat3(density) * glm::dvec3(1.0));
        brightest = std::max(brightest, white.back().y);
    }
    PatternFigure figure;
    if (!(brightest > 0.0)) return figure;
    const int half = lit_half(white, finest.size, kFaintest * brightest);
    figure.size = 2 * half;
    figure.half_width = picture.half_width * figure.size / finest.size;
    double sum = 0.0;
    double sum_of_squares = 0.0;
    for (int row = finest.size / 2 - half; row < finest.size / 2 + half; ++row)
        for (int column = finest.size / 2 - half; column < finest.size / 2 + half; ++column) {
            const glm::dvec3& xyz = white[static_cast<std::size_t>(row * finest.size + column)];
            sum += xyz.y;
            sum_of_squares += xyz.y * xyz.y;
            figure.xyz.push_back(xyz);
        }
    for (glm::dvec3& xyz : figure.xyz) xyz *= sum / sum_of_squares;
    return figure;
}

}  // namespace rowland::inspector
