// A picture that is shown instead of a representation.
#include "modules/diffraction/runtime/gpu_material.h"

#include "modules/diffraction/module.h"
#include "modules/diffraction/runtime/diffraction_surface.h"
#include "tests/gpu/render_test.h"

namespace rowland::diffraction {
namespace {

class PictureTest : public test::RenderTest {
 protected:
    PictureTest() { register_module(renderer_); }

    void show(const std::vector<glm::vec4>& texels, int width) {
        const auto json = nlohmann::json::parse(
            R"({"grating": {"pitch_nm": 1600, "profile": {"type": "slit", "width_nm": 800}},
                "quality": {"representation": "direct"}})");
        auto texture = std::make_shared<gpu::Texture>(
            gpu::TextureDesc{
                .format = gpu::Format::RGBA32F, .width = width, .height = static_cast<int>(texels.size()) / width},
            gpu::Sampling{.filter = gpu::Filter::Nearest});
        texture->upload(std::span<const glm::vec4>(texels));
        const ecs::Entity entity = add(square(), {.base_colour = glm::vec3(0.0F)});
        world_.add(entity, DiffractionSurface{.material = std::make_shared<const GpuPicture>(
                                                  cook_material(json, "test"), texture, renderer_.xyz_to_working())});
    }
    /// XYZ of a pixel.
    glm::vec3 xyz_at(float x, float y) { return glm::mat3(colour::rec709_to_xyz()) * glm::vec3(at(draw(), x, y)); }

    static void expect_near(const glm::vec3& value, const glm::vec3& expected) {
        // Two matrices in 32 bits.
        EXPECT_LT(glm::length(value - expected), 1e-5F) << value.x << ", " << value.y << ", " << value.z;
    }
};

TEST_F(PictureTest, EachPixelShowsItsOwnTexelFromTheBottomUp) {
    show({{1.0F, 0.0F, 0.0F, 1.0F}, {0.0F, 2.0F, 0.0F, 1.0F}, {0.0F, 0.0F, 3.0F, 1.0F}, {1.0F, 1.0F, 1.0F, 1.0F}}, 2);
    expect_near(xyz_at(-0.6F, -0.6F), {1.0F, 0.0F, 0.0F});
    expect_near(xyz_at(0.6F, -0.6F), {0.0F, 2.0F, 0.0F});
    expect_near(xyz_at(-0.6F, 0.6F), {0.0F, 0.0F, 3.0F});
    expect_near(xyz_at(0.6F, 0.6F), {1.0F, 1.0F, 1.0F});
}

TEST_F(PictureTest, WhatIsNotKnownYetIsDarkAndPartsCountAsWhole) {
    show({{0.0F, 0.0F, 0.0F, 0.0F}, {0.5F, 0.25F, 0.5F, 0.5F}}, 2);
    expect_near(xyz_at(-0.6F, 0.0F), glm::vec3(0.0F));
    expect_near(xyz_at(0.6F, 0.0F), {1.0F, 0.5F, 1.0F});
}

}  // namespace
}  // namespace rowland::diffraction
