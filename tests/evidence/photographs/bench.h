#pragma once

#include <cstddef>
#include <filesystem>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/gpu/framebuffer.h"
#include "engine/lighting/light_probe.h"
#include "engine/platform/gl_context.h"
#include "engine/render/renderer.h"
#include "engine/render/scene_instance.h"
#include "engine/scene/imported_scene.h"
#include "modules/diffraction/asset/material.h"
#include "modules/diffraction/runtime/gpu_material.h"
#include "tests/evidence/photographs/disc_line.h"

namespace rowland::evidence {

/// A drawn picture, and where its camera puts the points of the disc.
class DrawnPicture {
 public:
    /// `xyz`: size² pixels, rows from the top. The camera looks from `eye` at the origin, +Y up.
    DrawnPicture(const glm::dvec3& eye, double tangent, int size, std::vector<glm::dvec3> xyz);

    int size() const { return size_; }
    const std::vector<glm::dvec3>& xyz() const { return xyz_; }
    double greatest_brightness() const;
    /// In pixels from the upper left corner: (column + ½, row + ½) is a pixel's centre.
    glm::dvec2 position_of(const glm::dvec3& point) const;
    /// X + Y + Z, bilinear between pixel centres, 0 outside.
    double brightness(const glm::dvec3& point) const;

 private:
    double brightness_at(int column, int row) const;

    glm::dvec3 eye_;
    glm::dvec3 forward_;
    glm::dvec3 right_;
    glm::dvec3 up_;
    double tangent_;  ///< of half the field of view
    int size_;
    std::vector<glm::dvec3> xyz_;
    std::vector<float> brightness_;
};

/// What is changed to see what the measurement notices.
struct Disturbance {
    double pitch_factor = 1.0;
    double groove_rotation_deg = 0.0;
    double lobe_factor = 1.0;
};

/// Standard deviation of a lamp of one colour. Its spectrum is a normal distribution of the wavelength.
inline constexpr double kBandDeviation_nm = 3.0;

/// content/scenes/bench.glb on the GPU: two discs, a lamp and a camera, in the dark. Makes a context of its own.
class Bench {
 public:
    explicit Bench(const std::filesystem::path& scene);

    /// Lays a disc, by its node's name, under the camera, and chooses the lamp: of the mean wavelength `band_nm`, or
    /// white (D65). The pitch that the disc's material states, nm, is returned.
    double show(const std::string& disc, std::optional<double> band_nm = {}, const Disturbance& disturbance = {});

    /// Moves the scene's lamp and camera. The disc fills the picture.
    DrawnPicture draw(const LampAndEye& setup, int size);

    const std::string& device() const { return context_.renderer(); }

 private:
    scene::ImportedScene load(const std::filesystem::path& path);
    ecs::Entity node(const std::string& name) const;

    platform::HeadlessContext context_{{.debug = false}};
    render::Renderer renderer_;
    glm::dmat3 working_to_xyz_;
    lighting::LightProbe darkness_;  ///< in place of surroundings
    ecs::World world_;
    std::map<std::string, diffraction::Material> materials_;  ///< by the name of the disc
    scene::ImportedScene scene_;
    render::SceneInstance instance_;
    /// By disc, band (0: white) and disturbance.
    using Key = std::tuple<std::string, double, double, double>;
    std::map<Key, std::shared_ptr<const diffraction::GpuMaterial>> uploaded_;
    std::optional<gpu::Framebuffer> target_;
};

}  // namespace rowland::evidence
