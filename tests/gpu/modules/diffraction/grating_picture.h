#pragma once

// Pictures of gratings against the CPU: what the tests of all representations share.

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "engine/render/renderer.h"
#include "modules/diffraction/module.h"
#include "tests/gpu/gl_test.h"
#include "tests/gpu/modules/diffraction/cook_grating.h"
#include "tests/gpu/modules/diffraction/drawn_triangle.h"
#include "tests/gpu/modules/diffraction/grating_light.h"
#include "tests/gpu/modules/diffraction/key_light_reference.h"

namespace rowland::diffraction {

inline constexpr const char* kSlitCd = R"({"pitch_nm": 1600, "profile": {"type": "slit", "width_nm": 800}})";
inline constexpr const char* kBlazed =
    R"({"pitch_nm": 1200, "profile": {"type": "blazed", "depth_nm": 250}, "orders": [-1, 1, 2]})";
inline constexpr const char* kFoil = R"({"pitch_nm": 1000, "profile": {"type": "sinusoidal", "depth_nm": 150},
                                         "groove_lobe": {"sigma": 0.3}})";

/// Of the picture's maximum. A real GPU filters textures with 8-bit weights, 2e-3 of a step between texels; tables of
/// halves are 5e-4 exact.
inline constexpr double kPictureTolerance = 2e-3;

/// One triangle with a grating, drawn as XYZ unless a test sets another working space.
class GratingPicture : public rowland::test::GlTest, protected DrawnTriangle {
 protected:
    /// Builds the scene, from the mesh and the light as they are.
    void show(const CookedMaterial& cooked, double groove_rotation = 0.0, int slices_per_frame = 1 << 20);
    /// Gives the triangle another material.
    void use(const CookedMaterial& cooked);
    /// Rows from the top down.
    std::vector<glm::vec4> draw();

    /// Draws a material whose map is looked up at the vertices, which `map_xyz` does on the CPU, and its key lights at
    /// the vertices or at the pixels.
    void expect_map_at_vertices(const CookedMaterial& cooked, const std::function<glm::dvec3(const Point&)>& map_xyz);

    /// Largest difference between the picture and `expected`, over the picture's largest component.
    double largest_difference(const std::vector<glm::vec4>& pixels,
                              const std::function<glm::dvec3(const Point& point)>& expected);

    glm::dmat3 xyz_to_working_{1.0};
    std::optional<render::Renderer> renderer_;
    ecs::World world_;
    ecs::Entity entity_;
    LightParts light_ = light_of(smooth_probe(), {});
    std::shared_ptr<const GpuMaterial> material_;
    gpu::Framebuffer target_{
        gpu::FramebufferDesc{.width = kSize, .height = kSize, .colours = {gpu::Format::RGBA32F}, .depth = true}};
    double brightest_ = 0.0;
    int compared_ = 0;
};

}  // namespace rowland::diffraction
