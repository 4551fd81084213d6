#include "modules/diffraction/runtime/light_window.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <numbers>
#include <vector>

#include "engine/math/sh_basis.h"
#include "engine/math/sh_rotation.h"
#include "modules/diffraction/bake/arc_coefficients.h"

namespace rowland::diffraction {

namespace {

constexpr int kNormals = 64;
constexpr int kTurns = 4;  ///< grating vectors per normal
constexpr int kArcs = 15;

/// Rows (g, h, n) of frames spread over all orientations: normals on a Fibonacci spiral, g turned about them.
std::vector<glm::dmat3> spread_frames() {
    std::vector<glm::dmat3> frames;
    for (int i = 0; i < kNormals; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / kNormals;
        const double azimuth = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
        const double r = std::sqrt(1.0 - z * z);
        const glm::dvec3 n(r * std::cos(azimuth), r * std::sin(azimuth), z);
        const glm::dvec3 east(-std::sin(azimuth), std::cos(azimuth), 0.0);
        for (int turn = 0; turn < kTurns; ++turn) {
            const double angle = std::numbers::pi * (turn + 0.5) / kTurns;
            const glm::dvec3 g = std::cos(angle) * east + std::sin(angle) * glm::cross(n, east);
            frames.push_back(glm::transpose(glm::dmat3(g, glm::cross(n, g), n)));
        }
    }
    return frames;
}

/// C_i(a) of evenly spaced arcs, arc by arc.
std::vector<std::vector<double>> arc_rows(int bands) {
    const ArcCoefficients coefficients(bands, FlatLobe{});
    const auto count = static_cast<std::size_t>(math::sh_count(bands));
    std::vector<std::vector<double>> rows;
    for (int i = 0; i < kArcs; ++i) {
        std::vector<double> arc_frame(count);
        std::vector<double> row(count);
        coefficients.accumulate((2.0 * i + 1.0) / kArcs - 1.0, 0.0, 550.0, 1.0, arc_frame);
        coefficients.to_tangent_frame(arc_frame, row);
        rows.push_back(std::move(row));
    }
    return rows;
}

/// The negative fraction of the light that the arcs of one frame gather; the light is rotated into the frame.
double negative_fraction(const std::vector<std::vector<double>>& rows, const std::vector<glm::dvec3>& rotated) {
    double negative = 0.0;
    double all = 0.0;
    for (const std::vector<double>& row : rows) {
        glm::dvec3 light(0.0);
        for (std::size_t i = 0; i < row.size(); ++i) light += row[i] * rotated[i];
        for (int c = 0; c < 3; ++c) {
            negative += std::max(0.0, -light[c]);
            all += std::abs(light[c]);
        }
    }
    return all > 0.0 ? negative / all : 0.0;
}

}  // namespace

double ringing(const lighting::ShLight& light) {
    const std::vector<std::vector<double>> rows = arc_rows(light.bands);
    const std::vector<glm::dmat3> frames = spread_frames();
    std::vector<glm::dvec3> rotated(light.coefficients.size());
    double sum = 0.0;
    for (const glm::dmat3& frame : frames) {
        math::ShRotation(frame, light.bands).apply(std::span<const glm::dvec3>(light.coefficients), rotated);
        sum += negative_fraction(rows, rotated);
    }
    return sum / static_cast<double>(frames.size());
}

math::SphericalWindow weakest_window(const lighting::ShLight& light, int bands) {
    for (const auto window : {math::SphericalWindow::None, math::SphericalWindow::Lanczos})
        if (ringing(lighting::limit_bands(light, bands, window)) <= kTolerableRinging) return window;
    return math::SphericalWindow::Hann;
}

}  // namespace rowland::diffraction
