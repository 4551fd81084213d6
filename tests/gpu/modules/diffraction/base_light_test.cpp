// The light on the layer under a grating.
#include <gtest/gtest.h>

#include "engine/colour/colour_space.h"
#include "engine/math/spherical_harmonics.h"
#include "modules/diffraction/asset/material.h"
#include "tests/gpu/modules/diffraction/grating_picture.h"

namespace rowland::diffraction {
namespace {

constexpr glm::vec3 kColour(0.8F, 0.6F, 0.4F);

class BaseLight : public GratingPicture {
 protected:
    /// A grating that no light reaches, on a base layer under ambient light alone.
    void show_under_ambient_light(bool double_sided) {
        light_ = black_light();
        cooked_ = cook(kSlitCd, R"({"representation": "arc", "key_lights": 0})");
        show(cooked_);
        lighting::LightProbe probe;
        probe.sh = {.bands = 3, .coefficients = std::vector<glm::dvec3>(9, glm::dvec3(0.0))};
        probe.ambient.coefficients = coefficients_;
        probe.environment.layout = {.face_size = 4, .levels = 1};
        probe.environment.halves.assign(3 * probe.environment.layout.offset(1), 0);
        renderer_->set_probe(probe);
        world_.add(entity_, render::StandardMaterial{.base_colour = kColour, .double_sided = double_sided});
    }
    glm::dvec3 reflected(const glm::dvec3& normal) const {
        std::array<double, 9> basis{};
        math::evaluate_sh(normal, 3, basis);
        glm::dvec3 ambient(0.0);
        for (std::size_t i = 0; i < 9; ++i) ambient += basis[i] * coefficients_[i];
        const glm::dmat3 to_xyz = colour::rec709_to_xyz();
        return layer_weights(cooked_.material.grating).base * (to_xyz * glm::dvec3(kColour)) * (to_xyz * ambient);
    }
    glm::dvec3 at_pixel(const Point& point) const { return reflected(glm::transpose(point.to_tangent)[2]); }
    glm::dvec3 from_vertices(const Point& point) const {
        std::vector<glm::dvec3> shaded;
        for (std::size_t vertex = 0; vertex < 3; ++vertex)
            shaded.push_back(reflected(glm::transpose(vertex_frame(vertex))[2]));
        return mix(point, shaded);
    }

    CookedMaterial cooked_;
    std::array<glm::dvec3, 9> coefficients_{glm::dvec3(3.0), glm::dvec3(0.3, 0.2, 0.1),  glm::dvec3(0.2),
                                            glm::dvec3(0.1), glm::dvec3(0.5, -0.5, 0.2), glm::dvec3(0.4),
                                            glm::dvec3(1.0), glm::dvec3(-0.6, 0.1, 0.3), glm::dvec3(0.7)};
};

TEST_F(BaseLight, AmbientLightIsInterpolatedBetweenTheVertices) {
    show_under_ambient_light(false);
    const std::vector<glm::vec4> pixels = draw();
    EXPECT_LT(largest_difference(pixels, [&](const Point& point) { return from_vertices(point); }), 1e-5);
    EXPECT_GT(largest_difference(pixels, [&](const Point& point) { return at_pixel(point); }), 1e-3);
    EXPECT_GT(brightest_, 1e-3);
}

TEST_F(BaseLight, OfADoubleSidedSurfaceIsThatOfEachPixel) {
    show_under_ambient_light(true);
    EXPECT_LT(largest_difference(draw(), [&](const Point& point) { return at_pixel(point); }), 1e-5);
    EXPECT_GT(brightest_, 1e-3);
}

}  // namespace
}  // namespace rowland::diffraction
