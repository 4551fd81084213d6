#include "tests/evidence/photographs/bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <utility>
#include <variant>

#include "engine/core/error.h"
#include "engine/gpu/context.h"
#include "engine/post/ocio_config.h"
#include "engine/scene/camera.h"
#include "engine/scene/gltf_import.h"
#include "engine/scene/transform.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/asset/gltf_extension.h"
#include "modules/diffraction/runtime/diffraction_surface.h"
#include "modules/material_types.h"

namespace rowland::evidence {

namespace {

constexpr double kShownRadius_m = 0.064;  ///< about the disc's centre: half of the picture's height
const glm::vec3 kOutOfSight(0.0F, -1000.0F, 0.0F);
const glm::dvec3 kUp(0.0, 1.0, 0.0);

lighting::LightProbe darkness() {
    const image::Image black{.width = 16, .height = 8, .texels = std::vector<glm::vec3>(std::size_t{16} * 8)};
    lighting::LightProbeSettings settings;
    settings.key_lights = 0;
    return lighting::build_light_probe({black, lighting::Mapping::Equirectangular}, settings);
}

colour::Illuminant band(double mean_nm) {
    std::vector<double> wavelengths_nm;
    std::vector<double> power;
    for (int nm = colour::kVisibleMin; nm <= colour::kVisibleMax; ++nm) {
        wavelengths_nm.push_back(nm);
        power.push_back(std::exp(-0.5 * std::pow((nm - mean_nm) / kBandDeviation_nm, 2)));
    }
    return {.name = fmt::format("{} nm", mean_nm),
            .power = colour::SampledSpectrum(std::move(wavelengths_nm), std::move(power), colour::Outside::Zero)};
}

}  // namespace

DrawnPicture::DrawnPicture(const glm::dvec3& eye, double tangent, int size, std::vector<glm::dvec3> xyz)
    : eye_(eye),
      forward_(-normalize(eye)),
      right_(normalize(cross(forward_, kUp))),
      up_(cross(right_, forward_)),
      tangent_(tangent),
      size_(size),
      xyz_(std::move(xyz)) {
    brightness_.reserve(xyz_.size());
    for (const glm::dvec3& pixel : xyz_) brightness_.push_back(static_cast<float>(pixel.x + pixel.y + pixel.z));
}

glm::dvec2 DrawnPicture::position_of(const glm::dvec3& point) const {
    const glm::dvec3 from_eye = point - eye_;
    const double scale = 1.0 / (tangent_ * dot(from_eye, forward_));
    return 0.5 * size_ * glm::dvec2(1.0 + scale * dot(from_eye, right_), 1.0 - scale * dot(from_eye, up_));
}

double DrawnPicture::greatest_brightness() const {
    return static_cast<double>(std::ranges::max(brightness_));
}

double DrawnPicture::brightness_at(int column, int row) const {
    if (column < 0 || row < 0 || column >= size_ || row >= size_) return 0.0;
    return static_cast<double>(brightness_[static_cast<std::size_t>(row * size_ + column)]);
}

double DrawnPicture::brightness(const glm::dvec3& point) const {
    const glm::dvec2 at = position_of(point) - 0.5;
    const int column = static_cast<int>(std::floor(at.x));
    const int row = static_cast<int>(std::floor(at.y));
    const double x = at.x - column;
    const double y = at.y - row;
    return std::lerp(std::lerp(brightness_at(column, row), brightness_at(column + 1, row), x),
                     std::lerp(brightness_at(column, row + 1), brightness_at(column + 1, row + 1), x), y);
}

Bench::Bench(const std::filesystem::path& scene)
    : renderer_(post::xyz_to_scene_linear(post::OcioConfig::shipped())),
      working_to_xyz_(inverse(renderer_.xyz_to_working())),
      darkness_(darkness()) {
    modules::register_material_types(renderer_);
    renderer_.set_probe(darkness_);
    scene_ = load(scene);
    instance_ = render::instantiate(world_, scene_, renderer_, scene.string());
}

/// Bakes the gratings as the scene pins them. Cooking it would also measure their errors under a sky, for half a
/// minute.
scene::ImportedScene Bench::load(const std::filesystem::path& path) {
    const std::vector<std::string> handled = {diffraction::kGltfExtension};
    scene::ImportedScene scene = scene::load_gltf(path, handled);
    for (const scene::ImportedInstance& instance : scene.instances) {
        scene::MaterialDescription& described = scene.materials.at(instance.material.value());
        const nlohmann::json& object = described.extensions.at(diffraction::kGltfExtension);
        const diffraction::Material material =
            diffraction::parse_gltf_extension(object, path.string(), path.parent_path()).material;
        described.tables[diffraction::kGltfExtension] =
            std::make_shared<const std::vector<std::byte>>(diffraction::write_gltf_tables(
                diffraction::material_members(object), diffraction::bake_material(material), {}));
        materials_[scene.nodes.at(instance.node).name] = material;
    }
    if (scene.cameras.empty() || scene.lights.empty())
        refuse_input(path.string(), "", "no camera or no lamp", "the bench: two discs, a lamp and a camera");
    return scene;
}

ecs::Entity Bench::node(const std::string& name) const {
    for (std::size_t i = 0; i < scene_.nodes.size(); ++i)
        if (scene_.nodes[i].name == name) return instance_.nodes[i];
    refuse_input("bench", "", "no node " + name, "CD-R, DVD-R, lamp and camera");
}

double Bench::show(const std::string& disc, std::optional<double> band_nm, const Disturbance& disturbance) {
    for (const auto& [name, material] : materials_)
        world_.get<scene::Transform>(node(name)).translation = name == disc ? glm::vec3(0.0F) : kOutOfSight;
    const double pitch_nm = materials_.at(disc).grating.pitch_nm;
    diffraction::Material material = materials_.at(disc);
    if (band_nm) material.quality.illuminant = band(*band_nm);
    darkness_.illuminant = material.quality.illuminant;
    renderer_.set_probe(darkness_);
    material.grating.pitch_nm *= disturbance.pitch_factor;
    std::get<diffraction::GaussianLobe>(material.grating.lobe).sigma *= disturbance.lobe_factor;
    auto& uploaded = uploaded_[{disc, band_nm.value_or(0.0), disturbance.pitch_factor, disturbance.lobe_factor}];
    if (!uploaded)
        uploaded = diffraction::make_gpu_material(diffraction::bake_material(material), renderer_.xyz_to_working());
    for (std::size_t i = 0; i < scene_.instances.size(); ++i)
        if (scene_.nodes.at(scene_.instances[i].node).name == disc)
            world_.add(instance_.drawn.at(i),
                       diffraction::DiffractionSurface{
                           .material = uploaded,
                           .groove_rotation = static_cast<float>(glm::radians(disturbance.groove_rotation_deg))});
    return pitch_nm;
}

DrawnPicture Bench::draw(const LampAndEye& setup, int size) {
    world_.get<scene::Transform>(node("lamp")).translation = glm::vec3(setup.lamp);
    auto& placement = world_.get<scene::Transform>(node("camera"));
    placement.translation = glm::vec3(setup.eye);
    placement.rotation = glm::quat(glm::quatLookAt(-normalize(setup.eye), kUp));
    scene::update_world_matrices(world_);

    const scene::ImportedCamera& lens = scene_.cameras.front();
    const glm::mat4& world = world_.get<scene::WorldMatrix>(instance_.nodes.at(lens.node)).matrix;
    const glm::vec3 eye(world[3]);
    const double tangent = kShownRadius_m / length(setup.eye);
    const scene::Camera camera{.eye = eye,
                               .target = eye - glm::vec3(world[2]),
                               .up = glm::vec3(world[1]),
                               .vertical_field_of_view = static_cast<float>(2.0 * std::atan(tangent)),
                               .near_plane = lens.near_plane};
    if (!target_ || target_->size().x != size)
        target_.emplace(
            gpu::FramebufferDesc{.width = size, .height = size, .colours = {gpu::Format::RGBA32F}, .depth = true});
    renderer_.render(world_, camera, *target_);
    std::vector<glm::dvec3> xyz;
    for (const glm::vec4& pixel : target_->read_rgba_float()) xyz.push_back(working_to_xyz_ * glm::dvec3(pixel));
    gpu::require_context();
    return {setup.eye, tangent, size, std::move(xyz)};
}

}  // namespace rowland::evidence
