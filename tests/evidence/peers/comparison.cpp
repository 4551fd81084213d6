#include "tests/evidence/peers/comparison.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <nlohmann/json.hpp>

#include "engine/colour/illuminant.h"
#include "engine/core/log.h"
#include "engine/image/image.h"
#include "engine/scene/camera.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/asset/quality.h"
#include "modules/diffraction/evaluate/point_shader.h"
#include "modules/diffraction/evaluate/search.h"
#include "modules/diffraction/reference/reference.h"
#include "modules/diffraction/representations/direct/direct.h"

namespace rowland::evidence {

namespace {

constexpr int kWidth = 80;
constexpr int kHeight = 60;
constexpr int kLamps = 16;
constexpr double kLampDeviation = 0.25 * glm::pi<double>() / 180.0;

/// All combinations of values of the four parameters.
std::vector<glm::vec4> combinations(const std::vector<float>& x, const std::vector<float>& y,
                                    const std::vector<float>& z, const std::vector<float>& w) {
    std::vector<glm::vec4> result;
    for (const float a : x)
        for (const float b : y)
            for (const float c : z)
                for (const float d : w) result.emplace_back(a, b, c, d);
    return result;
}

std::vector<float> steps(float from, float to, float step) {
    std::vector<float> values;
    for (float value = from; value < to + 0.5F * step; value += step) values.push_back(value);
    return values;
}

std::vector<Subject> make_subjects() {
    std::vector<Subject> result;
    const auto add = [&](const std::string& name, const std::string& title, const char* peer, glm::vec4 published,
                         std::vector<glm::vec4> candidates) {
        result.push_back({name,
                          title,
                          {.peer = &peer_named(peer), .parameters = published, .highlight = true},
                          std::move(candidates)});
    };
    const auto published = [](const char* peer) { return peer_named(peer).published; };
    const std::vector<float> spacings = steps(1.4F, 3.4F, 0.05F);
    add("stam", "Stam, GPU Gems: along the tracks, as printed", "stam", published("stam"),
        combinations(spacings, {50.0F}, {0.0F}, {1.0F}));
    add("stam_across", "Stam, GPU Gems: turned across the tracks", "stam", {10.0F, 50.0F, 0.0F, 0.0F},
        combinations(spacings, {50.0F}, {0.0F}, {0.0F}));
    const std::vector<float> pitches = steps(1000.0F, 2400.0F, 50.0F);
    add("zucconi", "Zucconi: as published", "zucconi", published("zucconi"),
        combinations(pitches, {0.0F}, {0.0F}, {1.0F}));
    add("zucconi_repaired", "Zucconi: sign and axis repaired", "zucconi", {1600.0F, 0.0F, 0.0F, 0.0F},
        combinations(pitches, {0.0F}, {0.0F}, {0.0F}));
    add("egholm", "Egholm & Christensen, after Sun", "egholm", published("egholm"),
        combinations(steps(1400.0F, 1800.0F, 50.0F), {0.02F, 0.035F, 0.05F, 0.07F, 0.1F, 0.15F}, {0.0F},
                     {0.0F, 0.5F, 1.0F}));
    add("projected", "projected angles, a wave-optics path tracer", "projected", published("projected"),
        combinations(steps(1400.0F, 1900.0F, 50.0F), steps(60.0F, 180.0F, 20.0F), {0.0F}, {0.0F}));
    add("three_lobes", "three shifted lobes", "three_lobes", published("three_lobes"),
        combinations(steps(0.1F, 0.3F, 0.01F), {0.01F, 0.02F, 0.03F, 0.05F, 0.1F}, {0.1F, 0.3F, 0.6F, 1.0F, 2.0F},
                     {0.0F}));
    add("iridescence", "KHR_materials_iridescence", "iridescence", published("iridescence"),
        combinations(steps(100.0F, 1200.0F, 50.0F), {1.3F, 1.6F, 2.0F}, {0.2F, 0.4F, 0.7F, 1.0F}, {0.1F, 0.4F, 0.91F}));
    // Where a repair or a setting of the peer allows it, the orders of the disc.
    for (Subject& subject : result)
        if (subject.name == "stam_across" || subject.name == "zucconi_repaired" || subject.name == "projected")
            subject.orders = {1, 2};
    return result;
}

std::string material_file() {
    return ROWLAND_SOURCE_FOLDER "/content/materials/cd_paper.json";
}

nlohmann::json material_json(std::optional<double> sigma) {
    nlohmann::json json = diffraction::load_material_json(material_file());
    if (sigma) json["grating"]["groove_lobe"] = {{"sigma", *sigma}};
    return json;
}

diffraction::CookedMaterial cooked(std::optional<double> sigma, const std::string& method) {
    return diffraction::cook(material_json(sigma), material_file(), diffraction::parse_method(method));
}

std::vector<glm::dvec3> reference(std::optional<double> sigma, const diffraction::IncidentLight& light,
                                  const trade::PictureFrames& frames) {
    diffraction::Material material = diffraction::parse_material(material_json(sigma), material_file());
    material.grating.orders = {-1, 1};  // a slit of half the pitch sends nothing into even orders
    return reference_radiance(material.grating, light, colour::LightSpectra(material.quality.illuminant),
                              all_frames(frames.frames));
}

/// The probe on 512 × 256 texels, means of 3 × 3 samples; an equirectangular one stays as it is.
lighting::ProbeImage resampled(const lighting::ProbeImage& probe) {
    if (probe.mapping() == lighting::Mapping::Equirectangular) return probe;
    constexpr int kRows = 256;
    constexpr int kSamples = 3;
    const image::Image blank = image::make_image(2 * kRows, kRows);
    const lighting::ProbeImage grid(blank, lighting::Mapping::Equirectangular);
    image::Image result = blank;
    for (int row = 0; row < kRows; ++row)
        for (int column = 0; column < 2 * kRows; ++column) {
            glm::dvec3 sum(0.0);
            for (int j = 0; j < kSamples; ++j)
                for (int i = 0; i < kSamples; ++i)
                    sum += probe.radiance(
                        glm::normalize(grid.direction(column + (i + 0.5) / kSamples, row + (j + 0.5) / kSamples)));
            result.at(column, row) = glm::vec3(sum / static_cast<double>(kSamples * kSamples));
        }
    return lighting::ProbeImage(result, lighting::Mapping::Equirectangular);
}

diffraction::DirectMaterial direct_material(const diffraction::CookedMaterial& disc) {
    return {.pitch_nm = disc.material.grating.pitch_nm,
            .zero_order_xyz = disc.zero_order_xyz,
            .lobe = disc.material.grating.lobe};
}

/// Light by light; `Light`: diffraction::DirectLight or lighting::KeyLight.
template <typename Light>
std::vector<glm::dvec3> by_direct(const diffraction::CookedMaterial& disc, const std::vector<Light>& lights,
                                  std::span<const diffraction::ShadingPoint> points) {
    const diffraction::DirectMaterial material = direct_material(disc);
    std::vector<glm::dvec3> xyz;
    for (const diffraction::ShadingPoint& point : points)
        xyz.push_back(direct_radiance(disc.kernel, material, std::span<const Light>(lights), point));
    return xyz;
}

/// The factor of least squared error in XYZ, at least 0.
double best_exposure(const std::vector<glm::dvec3>& xyz, const std::vector<glm::dvec3>& reference) {
    double product = 0.0;
    double square = 0.0;
    for (std::size_t i = 0; i < xyz.size(); ++i) {
        product += glm::dot(xyz[i], reference[i]);
        square += glm::dot(xyz[i], xyz[i]);
    }
    return square > 0.0 ? std::max(product / square, 0.0) : 0.0;
}

Shown shown(const std::string& name, const std::string& title, std::vector<glm::dvec3> xyz, const LightCase& light,
            const trade::PictureFrames& frames, bool exposed) {
    Shown result{.name = name, .title = title, .xyz = std::move(xyz)};
    if (exposed) {
        result.exposure = best_exposure(result.xyz, light.reference);
        for (glm::dvec3& value : result.xyz) value *= result.exposure;
    }
    result.error = compare_pictures(frames, result.xyz, light.reference);
    return result;
}

/// The candidate of the least error after exposure.
PeerSetting best_setting(const Subject& subject, const std::vector<glm::dvec3>& reference,
                         std::span<const render::DistantLight> lights, PointPass& pass) {
    PeerSetting best = subject.published;
    best.highlight = false;
    double least = std::numeric_limits<double>::infinity();
    for (const int orders : subject.orders)
        for (const glm::vec4& candidate : subject.candidates) {
            const PeerSetting setting{.peer = subject.published.peer, .parameters = candidate, .orders = orders};
            const std::vector<glm::dvec3> xyz = xyz_of(pass.draw(setting, lights));
            const double exposure = best_exposure(xyz, reference);
            double error = 0.0;
            for (std::size_t i = 0; i < xyz.size(); ++i) {
                const glm::dvec3 difference = exposure * xyz[i] - reference[i];
                error += glm::dot(difference, difference);
            }
            if (!(error < least)) continue;
            least = error;
            best = setting;
        }
    return best;
}

void add_peer(const Subject& subject, const PeerSetting& setting, std::span<const render::DistantLight> lights,
              const trade::PictureFrames& frames, PointPass& pass, LightCase& light) {
    light.peers.push_back(shown(subject.name, subject.title, xyz_of(pass.draw(setting, lights)), light, frames, true));
    light.peers.back().setting = setting;
}

render::DistantLight distant(const lighting::KeyLight& light) {
    return {glm::vec3(light.direction), glm::vec3(light.flux)};
}

}  // namespace

const std::vector<Subject>& subjects() {
    static const std::vector<Subject> all = make_subjects();
    return all;
}

trade::PictureFrames disc_picture() {
    scene::Camera camera;
    camera.eye = {0.0F, 0.15F, 0.13F};
    camera.target = {0.0F, 0.0F, 0.007F};
    camera.vertical_field_of_view = 0.5F;
    return trade::disc_frames(camera, kWidth, kHeight);
}

lighting::KeyLight lamp() {
    return {.direction = glm::normalize(glm::dvec3(0.45, 1.0, -0.35)),
            .flux = glm::dvec3(1.0),
            .concentration = 1.0 / (kLampDeviation * kLampDeviation)};
}

LightCase lamp_case(const std::string& name, std::optional<double> sigma, const trade::PictureFrames& frames,
                    PointPass& pass) {
    const lighting::KeyLight key = lamp();
    const lighting::ShLight none{.bands = 1, .coefficients = {glm::dvec3(0.0)}};
    diffraction::IncidentLight light(none);
    const double edge = std::cos(7.0 * kLampDeviation);
    light.radiance = [&](const glm::dvec3& s) {
        return glm::dot(s, key.direction) < edge ? glm::dvec3(0.0) : key.flux * lobe_density(key, s);
    };
    light.panel_angle = 1.3 * kLampDeviation;  // midpoints of a normal distribution: error 2e-5
    light.nodes_per_panel = 1;
    LightCase result{.name = name,
                     .title = sigma ? fmt::format("one lamp, groove lobe of sigma {}", *sigma) : "one lamp",
                     .reference = reference(sigma, light, frames),
                     .ours = {},
                     .peers = {}};
    log_info("{}: reference done", name);
    const std::vector<lighting::KeyLight> lights{key};
    result.ours.push_back(shown("direct", "ours: direct",
                                by_direct(cooked(sigma, "direct"), lights, all_frames(frames.frames)), result, frames,
                                false));
    const std::vector<render::DistantLight> directional{distant(key)};
    for (Subject subject : subjects()) {
        if (sigma && subject.name == "projected")
            for (glm::vec4& candidate : subject.candidates) candidate.z = static_cast<float>(*sigma);
        add_peer(subject, best_setting(subject, result.reference, directional, pass), directional, frames, pass,
                 result);
    }
    return result;
}

LightCase probe_case(const std::string& name, const std::string& title, const std::filesystem::path& file,
                     const std::string& mapping, const LightCase& fitted, const trade::PictureFrames& frames,
                     PointPass& pass) {
    const lighting::ProbeImage probe = resampled(trade::read_probe(file, mapping));
    LightCase result{.name = name, .title = title, .reference = reference({}, probe, frames), .ours = {}, .peers = {}};
    log_info("{}: reference done", name);
    const diffraction::EvaluationLight with_keys(probe, kLamps, math::SphericalWindow::None);
    const diffraction::EvaluationLight whole = with_keys.with_first(0);
    const auto add_ours = [&](const std::string& row, const std::string& label, const std::string& method,
                              const diffraction::EvaluationLight& light) {
        result.ours.push_back(
            shown(row, label, trade::shaded(cooked({}, method), light, frames.frames), result, frames, false));
    };
    add_ours("planar", "ours: planar", "planar", whole);
    add_ours("arc", "ours: arc, 8 bands", "arc/bands=8/rank=12", whole);
    add_ours("arc_key_lights", "ours: arc, 5 bands, and 16 key lights", "arc/bands=5/rank=8", with_keys);
    const std::span<const lighting::KeyLight> keys = with_keys.key_lights();
    std::vector<render::DistantLight> directional;
    std::vector<diffraction::DirectLight> points;
    for (const lighting::KeyLight& key : keys) {
        directional.push_back(distant(key));
        points.push_back({.direction = key.direction, .flux = key.flux});
    }
    result.ours.push_back(shown("direct", fmt::format("ours: direct, the {} lamps of the peers", points.size()),
                                by_direct(cooked({}, "direct"), points, all_frames(frames.frames)), result, frames,
                                true));
    for (std::size_t i = 0; i < subjects().size(); ++i)
        add_peer(subjects()[i], *fitted.peers[i].setting, directional, frames, pass, result);
    return result;
}

double returned_by_disc() {
    const diffraction::LayerWeights weights =
        layer_weights(diffraction::parse_material(material_json({}), material_file()).grating);
    return weights.reflected.y - weights.mirror.y;
}

std::vector<glm::dvec3> disc_by_direct(std::span<const diffraction::ShadingPoint> points, const glm::dvec3& light) {
    static const diffraction::CookedMaterial disc = cooked({}, "direct");
    return by_direct(disc, std::vector<diffraction::DirectLight>{{.direction = light, .flux = glm::dvec3(1.0)}},
                     points);
}

}  // namespace rowland::evidence
