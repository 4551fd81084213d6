#include "modules/diffraction/runtime/surface_light.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtx/component_wise.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vector_relational.hpp>
#include <numbers>
#include <utility>
#include <vector>

#include "engine/math/spherical_harmonics.h"
#include "modules/diffraction/bake/arc_moments.h"
#include "modules/diffraction/representations/direct/lobe_table.h"
#include "modules/diffraction/runtime/bindings.h"
#include "modules/diffraction/runtime/key_lobe.h"
#include "modules/diffraction/shaders/light_blocks.h"

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

void add_distant_lights(std::span<const render::DistantLight> lights, lighting::ShLight& sh) {
    std::vector<double> basis(sh.coefficients.size());
    for (const render::DistantLight& light : lights) {
        math::evaluate_sh(glm::dvec3(light.direction), sh.bands, basis);
        for (std::size_t i = 0; i < basis.size(); ++i) sh.coefficients[i] += basis[i] * glm::dvec3(light.irradiance);
    }
}

static_assert(lighting::kMaximumKeyLights <= ROWLAND_MAXIMUM_KEY_LOBES);
static_assert(kLobeTableOctaves == ROWLAND_LOBE_TABLE_OCTAVES && kLobeTableStart == ROWLAND_LOBE_TABLE_START);

void SurfaceLight::set_light_colours(std::span<const glm::vec3> strengths) {
    constexpr float kSameColour = 1e-4F;
    light_colours_.clear();
    colour_block_ = {};
    colours_changed_ = true;
    for (std::size_t i = 0; i < strengths.size(); ++i) {
        const float largest = std::max({strengths[i].r, strengths[i].g, strengths[i].b});
        const glm::vec3 colour = largest > 0.0F ? strengths[i] / largest : glm::vec3(1.0F);
        const auto same = std::find_if(light_colours_.begin(), light_colours_.end(), [&](const glm::vec3& other) {
            return glm::all(glm::lessThan(glm::abs(other - colour), glm::vec3(kSameColour)));
        });
        colour_block_.light_layer_scale[i] =
            glm::vec4(static_cast<float>(kFirstColourLayer + (same - light_colours_.begin())), largest, 0.0F, 0.0F);
        if (same == light_colours_.end()) light_colours_.push_back(colour);
    }
}

void SurfaceLight::set(const render::FrameLight& frame) {
    const bool same_strengths = frame_.light_strengths == frame.light_strengths;
    const bool same_light = frame_.probe && frame_.version == frame.version;
    const bool same_probe = frame_.probe == frame.probe && frame_.analytic_key_lights == frame.analytic_key_lights;
    frame_ = frame;
    if (!same_strengths) set_light_colours(frame.light_strengths);
    if (same_light) return;
    version_ = std::make_shared<const std::uint64_t>(frame.version);
    whole_.clear();
    if (same_probe) return;
    without_key_lights_.clear();
    samples_.clear();
    for (auto& [count, lights] : key_lights_) lights.changed = true;
}

lighting::ShLight SurfaceLight::windowed(const lighting::ShLight& light, int bands) const {
    return lighting::limit_bands(light, bands, window_ ? *window_ : weakest_window(light, bands));
}

const lighting::ShLight& SurfaceLight::whole_harmonics(int bands) {
    if (const auto found = whole_.find(bands); found != whole_.end()) return found->second;
    lighting::ShLight whole = frame_.probe->sh;
    add_distant_lights(frame_.distant_lights, whole);
    return whole_.emplace(bands, windowed(whole, bands)).first->second;
}

const lighting::ShLight& SurfaceLight::probe_harmonics(int bands, int key_light_limit) {
    const std::span<const lighting::KeyLight> keys = key_lights(key_light_limit);
    const std::pair key(bands, keys.size());
    if (const auto found = without_key_lights_.find(key); found != without_key_lights_.end()) return found->second;
    const lighting::ShLight& probe = frame_.probe->sh;
    return without_key_lights_
        .emplace(key, windowed(keys.empty() ? probe : lighting::residual(probe, keys, probe.bands), bands))
        .first->second;
}

const std::shared_ptr<const lighting::LightSamples>& SurfaceLight::probe_samples(int key_light_limit) const {
    const std::span<const lighting::KeyLight> keys = key_lights(key_light_limit);
    std::shared_ptr<const lighting::LightSamples>& samples = samples_[keys.size()];
    const lighting::PackedLight& light = frame_.probe->light;
    if (!samples && light.face_size > 0)
        samples = std::make_shared<const lighting::LightSamples>(lighting::unpack(light, keys));
    return samples;
}

std::span<const lighting::KeyLight> SurfaceLight::key_lights(int most) const {
    const std::span<const lighting::KeyLight> all = frame_.key_lights();
    return all.first(std::min(all.size(), static_cast<std::size_t>(most)));
}

void SurfaceLight::bind_light_colours() const {
    if (std::exchange(colours_changed_, false))
        colour_buffer_.write_values(std::span<const LightColourBlock>(&colour_block_, 1));
    colour_buffer_.bind_uniform(kLightColourBinding);
}

void SurfaceLight::bind_key_lights(int most) const {
    const std::span<const lighting::KeyLight> lights = key_lights(most);
    KeyLightBuffer& bound = key_lights_[lights.size()];
    if (std::exchange(bound.changed, false)) {
        KeyLobeBlock block = {};
        block.key_lobe_count.x = static_cast<float>(lights.size());
        std::transform(lights.begin(), lights.end(), block.key_lobes, key_lobe);
        bound.buffer.write_values(std::span<const KeyLobeBlock>(&block, 1));
    }
    bound.buffer.bind_uniform(kKeyLobeBinding);
}

}  // namespace rowland::diffraction
