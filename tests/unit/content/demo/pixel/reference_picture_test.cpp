// The reference's picture, beside a grating on a context without a window.
#include "content/demo/pixel/reference_picture.h"

#include "modules/diffraction/evaluate/error_measure.h"
#include "modules/diffraction/module.h"
#include "modules/diffraction/reference/reference.h"
#include "modules/diffraction/runtime/diffraction_surface.h"
#include "tests/gpu/render_test.h"
#include "tests/support/files.h"

namespace rowland::demo {
namespace {

constexpr glm::ivec2 kPixels{40, 40};

class ReferencePictureTest : public test::RenderTest {
 protected:
    ReferencePictureTest() {
        write_file_atomic(folder_.path() / "room.json", R"({"probe": {"type": "studio", "width": 64,
            "ceiling": [0.6, 0.5, 0.4], "wall": [0.3, 0.3, 0.3], "floor": [0.1, 0.1, 0.2], "boxes": [
            {"azimuth_deg": 160, "elevation_deg": 40, "half_size_deg": [40, 30], "soft_edge_deg": 20,
             "radiance": [3, 5, 4]}]}})");
        diffraction::register_module(renderer_);
        const FullResolutionProbe room = load_full_resolution_probe(probe_.path, probe_.mapping, probe_.recipes);
        renderer_.set_probe(lighting::build_light_probe(
            room.image, {.bands = 4, .key_lights = 0, .light_face = 16, .prefilter = {.face_size = 16}}));
        const auto json = nlohmann::json::parse(
            R"({"grating": {"pitch_nm": 1600, "profile": {"type": "slit", "width_nm": 800}},
                "quality": {"representation": "spikes", "bands": 2, "key_lights": 0}})");
        grating_ = add(square(), {.base_colour = glm::vec3(0.0F)});
        world_.add(grating_, diffraction::DiffractionSurface{
                                 .material = diffraction::make_gpu_material(diffraction::cook_material(json, "test"),
                                                                            renderer_.xyz_to_working())});
        camera_.eye = {0.8F, 0.5F, 2.6F};
        comparison_.set_wiping(true);
        comparison_.set_line(0.0F);
    }
    /// A frame, as the demo has it.
    void frame() {
        comparison_.update();
        reference_picture_.update(world_, comparison_, camera_, kPixels, probe_);
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    void finish() {
        const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(100);
        while (reference_picture_.progress() < 1.0 && reference_picture_.failure().empty() &&
               std::chrono::steady_clock::now() < deadline)
            frame();
        EXPECT_EQ(reference_picture_.progress(), 1.0) << reference_picture_.failure();
        frame();
        comparison_.update();
    }
    std::vector<glm::vec4> drawn() {
        const gpu::Framebuffer target(gpu::FramebufferDesc{
            .width = kPixels.x, .height = kPixels.y, .colours = {gpu::Format::RGBA32F}, .depth = true});
        comparison_.update();
        renderer_.render(world_, camera_, target);
        return target.read_rgba_float();
    }
    /// Of the diffraction term that is drawn, without what is under it and mirrored, against the reference: over the
    /// pixels at least `margin` inside of the square.
    double error_of_picture(int margin) {
        const std::vector<glm::vec4> with = drawn();
        auto black = std::make_shared<gpu::Texture>(gpu::TextureDesc{.format = gpu::Format::RGBA32F});
        black->upload(std::vector<float>{0.0F, 0.0F, 0.0F, 1.0F});
        comparison_.set_reference_picture(black);
        const std::vector<glm::vec4> without = drawn();
        const PlacedGrating place = placed_grating(world_, grating_).value();
        const auto points = visible_points(camera_, kPixels, {{place.mesh, place.to_world}});
        const auto inside = [&](int row, int column) {
            for (const int y : {row - margin, row + margin})
                for (const int x : {column - margin, column + margin})
                    if (x < 0 || y < 0 || x >= kPixels.x || y >= kPixels.y ||
                        !points[static_cast<std::size_t>(y * kPixels.x + x)])
                        return false;
            return true;
        };
        std::vector<diffraction::ShadingPoint> frames;
        std::vector<glm::dvec3> shown;
        for (int row = 0; row < kPixels.y; ++row)
            for (int column = 0; column < kPixels.x; ++column) {
                if (!inside(row, column)) continue;
                const auto at = static_cast<std::size_t>(row * kPixels.x + column);
                frames.push_back(frame_at(place, points[at]->hit, points[at]->point, camera_.eye).value());
                shown.push_back(colour::rec709_to_xyz() * glm::dvec3(glm::vec3(with[at] - without[at])));
            }
        EXPECT_GT(frames.size(), 100U);
        const auto& cooked = *comparison_.own(grating_)->cooked();
        const FullResolutionProbe room = load_full_resolution_probe(probe_.path, probe_.mapping, probe_.recipes);
        return diffraction::relative_rms(
            shown, diffraction::reference_radiance(cooked.material.grating, room.image,
                                                   colour::LightSpectra(cooked.material.quality.illuminant), frames));
    }

    test::TemporaryFolder folder_;
    PixelProbe probe_{.path = folder_.path() / "room.json", .mapping = "equirect", .recipes = {}};
    Comparison comparison_{world_, renderer_.xyz_to_working()};
    ReferencePicture reference_picture_;
    ecs::Entity grating_;
};

TEST_F(ReferencePictureTest, ShowsTheReferenceRightOfTheLine) {
    finish();
    EXPECT_TRUE(comparison_.shows_reference_picture());
    // Between texels four pixels apart the picture is interpolated: measured 0.0039.
    EXPECT_LT(error_of_picture(kReferenceTexelSide), 0.008);
}

TEST_F(ReferencePictureTest, WhatMovesHasNoPictureUntilItRests) {
    finish();
    camera_.eye.x += 0.01F;
    frame();
    EXPECT_FALSE(comparison_.shows_reference_picture());
    EXPECT_FALSE(reference_picture_.begun());
    finish();
    EXPECT_TRUE(comparison_.shows_reference_picture());
    world_.get<scene::WorldMatrix>(grating_).matrix[3][0] += 0.01F;
    frame();
    EXPECT_FALSE(comparison_.shows_reference_picture());
}

}  // namespace
}  // namespace rowland::demo
