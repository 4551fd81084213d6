// Ambient occlusion and contact shadows against rays.
#include <algorithm>

#include "tests/gpu/engine/render/traced_scene.h"

namespace rowland::render {
namespace {

class AmbientOcclusionTest : public test::TracedSceneTest {
 protected:
    AmbientOcclusionTest() { renderer_.set_probe(even_light(1.0F)); }

    void set_occlusion(bool on, float contact_m = 0.0F) {
        renderer_.set_effects(
            on ? Effects{.ambient_occlusion = AmbientOcclusionSettings{.radius_m = kRadius, .contact_m = contact_m}}
               : Effects{});
    }
    /// Of ambient light in each pixel: a picture's ratio to the one without the effect.
    std::vector<float> visibility() {
        set_occlusion(false);
        const std::vector<float> open = greens();
        set_occlusion(true);
        std::vector<float> result = greens();
        for (std::size_t i = 0; i < result.size(); ++i) result[i] /= open[i];
        return result;
    }
    /// The cosine-weighted visibility of a point within the effect's radius, whose last 40 % fade out.
    double traced_visibility(const Hit& point) const {
        constexpr int kSide = 16;
        const auto [x, y] = axes_across(point.normal);
        double sum = 0.0;
        for (int i = 0; i < kSide * kSide; ++i) {
            const int turn = i / kSide;
            const double radius2 = (i % kSide + 0.5) / kSide;
            const double angle = 2.0 * std::numbers::pi * (turn + 0.5) / kSide;
            const glm::dvec3 direction = std::sqrt(radius2) * (std::cos(angle) * x + std::sin(angle) * y) +
                                         std::sqrt(1.0 - radius2) * point.normal;
            const auto hit = trace(point.point + 1e-5 * point.normal, direction);
            sum += hit ? std::clamp((kRadius - hit->distance) / (0.4 * kRadius), 0.0, 1.0) : 0.0;
        }
        return 1.0 - sum / (kSide * kSide);
    }
    struct Errors {
        double mean = 0.0;
        double mean_occlusion = 0.0;
        double worst_of_99 = 0.0;  ///< 99th percentile
    };
    /// Over the pixels that see the scene and whose reference is below `below`.
    Errors errors_where_occluded(double below) {
        const std::vector<float> shown = visibility();
        std::vector<double> errors;
        Errors result;
        for (int row = 0; row < kHeight; row += 2)
            for (int column = 0; column < kWidth; column += 2) {
                const auto hit = seen(column, row);
                const double expected = hit ? traced_visibility(*hit) : 1.0;
                if (expected >= below) continue;
                errors.push_back(std::abs(shown[index(column, row)] - expected));
                result.mean += errors.back();
                result.mean_occlusion += 1.0 - expected;
            }
        EXPECT_GT(errors.size(), 100U);
        std::sort(errors.begin(), errors.end());
        const auto count = static_cast<double>(errors.size());
        result.mean /= count;
        result.mean_occlusion /= count;
        result.worst_of_99 = errors[errors.size() * 99 / 100];
        return result;
    }

    static constexpr float kRadius = 0.1F;
};

// What the depth does not show (how thick things are, what stands behind them) and the mean over 9 pixels remain as the
// error of the method: a fifth of the occlusion.
TEST_F(AmbientOcclusionTest, AtABoxItIsThatOfRays) {
    add_box({0.0F, 0.0F, 0.0F}, {0.1F, 0.06F, 0.08F});
    const Errors errors = errors_where_occluded(0.97);
    EXPECT_LT(errors.mean, 0.22 * errors.mean_occlusion);
    EXPECT_LT(errors.worst_of_99, 0.2);
}

// The depth does not show the underside, which occludes most where the sphere touches the floor.
TEST_F(AmbientOcclusionTest, UnderASphereItIsThatOfRays) {
    add_sphere({0.0F, 0.05F, 0.0F}, 0.05F);
    const Errors errors = errors_where_occluded(0.97);
    EXPECT_LT(errors.mean, 0.22 * errors.mean_occlusion);
    EXPECT_LT(errors.worst_of_99, 0.3);
}

TEST_F(AmbientOcclusionTest, AnOpenFloorIsBrightAtEveryAngle) {
    for (const float height : {0.05F, 0.2F, 1.0F}) {
        camera_.eye = {0.05F, height, 0.8F};
        camera_.target = {0.0F, 0.0F, 0.0F};
        const std::vector<float> shown = visibility();
        for (int row = kHeight / 2; row < kHeight; ++row)
            for (int column = 0; column < kWidth; ++column)
                // Measured: .86 at 3.6 degrees above the floor, at the edge of the picture.
                ASSERT_GT(shown[index(column, row)], 0.85F) << height << ' ' << column << ' ' << row;
    }
}

TEST_F(AmbientOcclusionTest, NoPatternMovesOverWhatStandsStill) {
    add_box({0.0F, 0.0F, 0.0F}, {0.1F, 0.06F, 0.08F});
    // Moves by half a pixel of the smaller picture, so that every texel has another part of the pattern.
    const std::vector<float> before = visibility();
    const float pixel = 0.7F * 2.0F * std::tan(0.25F) / kHeight;
    camera_.eye.x += pixel;
    camera_.target.x += pixel;
    const std::vector<float> after = visibility();
    double sum = 0.0;
    for (std::size_t i = 0; i < before.size(); ++i) sum += std::abs(before[i] - after[i]);
    EXPECT_LT(sum / static_cast<double>(before.size()), 0.01);
}

TEST_F(AmbientOcclusionTest, DirectLightIsNotOccluded) {
    renderer_.set_probe(even_light(0.0F));
    world_.add(world_.create(), scene::DirectionalLight{.direction = glm::normalize(glm::vec3(0.3F, 1.0F, 0.2F)),
                                                        .irradiance = glm::vec3(3.0F)});
    add_box({0.0F, 0.0F, 0.0F}, {0.1F, 0.06F, 0.08F});
    const std::vector<float> open = greens();
    set_occlusion(true, 0.02F);
    EXPECT_EQ(greens(), open);
}

/// Under a light from behind and above, whose map has texels of several centimetres.
TEST_F(AmbientOcclusionTest, AContactShadowBeginsAtItsCaster) {
    renderer_.set_probe(even_light(0.0F));
    renderer_.set_shadow_map_size(64);
    camera_.vertical_field_of_view = 0.25F;
    const glm::vec3 toward = glm::normalize(glm::vec3(-0.9F, 0.5F, -0.35F));
    world_.add(world_.create(),
               scene::DirectionalLight{.direction = toward, .irradiance = glm::vec3(3.0F), .casts_shadow = true});
    add_box({0.0F, 0.0F, 0.0F}, {0.1F, 0.03F, 0.08F});
    const auto greens_with = [&](bool on) {
        set_occlusion(on, 0.02F);
        return greens();
    };
    const std::vector<float> without = greens_with(false);
    const std::vector<float> with = greens_with(true);
    int shadowed = 0;
    int bright_before = 0;
    int bright = 0;
    int lit = 0;
    int darkened = 0;
    for (int row = 0; row < kHeight; ++row)
        for (int column = 0; column < kWidth; ++column) {
            const auto hit = seen(column, row);
            if (!hit || hit->normal.y < 0.5 || hit->point.y > 1e-6) continue;
            const auto blocker = trace(hit->point, glm::dvec3(toward));
            const std::size_t i = index(column, row);
            if (!blocker) {
                ++lit;
                darkened += with[i] < 0.5F * without[i] ? 1 : 0;
            } else if (blocker->distance < 0.015) {
                ++shadowed;
                bright_before += without[i] > 0.3F ? 1 : 0;
                bright += with[i] > 0.3F ? 1 : 0;
            }
        }
    ASSERT_GT(shadowed, 100);
    EXPECT_GT(bright_before, shadowed * 9 / 10);
    // A ray fades toward its end, where the map takes over.
    EXPECT_LT(bright, shadowed * 9 / 20);
    EXPECT_LT(darkened, lit / 200);
}

TEST_F(AmbientOcclusionTest, WhatBlendsTakesNothingFromWhatStandsBehind) {
    add_box({0.0F, 0.0F, 0.0F}, {0.1F, 0.06F, 0.08F});
    StandardMaterial glass = kWhite;
    glass.alpha_mode = scene::AlphaMode::Blend;
    add(scene::build_mesh(scene::PlaneRecipe{.width = 0.5, .depth = 0.5}), glass,
        glm::translate(glm::mat4(1.0F), {0.0F, 0.1F, 0.0F}));
    EXPECT_NEAR(visibility()[index(kWidth / 2, kHeight / 2)], 1.0F, 1e-5F);
}

TEST_F(AmbientOcclusionTest, OffItIsNoPassAndNoProgram) {
    gpu::PassTimes times;
    renderer_.set_pass_times(&times);
    const auto passes = [&] {
        times.begin_frame();
        greens();
        std::vector<std::string> names;
        for (const gpu::PassTime& pass : renderer_.report().passes) names.push_back(pass.name);
        return names;
    };
    EXPECT_EQ(passes(), (std::vector<std::string>{"opaque", "sky"}));
    const int programs = renderer_.report().programs;
    set_occlusion(true);
    EXPECT_EQ(passes(), (std::vector<std::string>{"occlusion", "opaque", "sky"}));
    // The surface's, its depth's and the two passes'.
    EXPECT_EQ(renderer_.report().programs, programs + 4);
    set_occlusion(false);
    EXPECT_EQ(passes(), (std::vector<std::string>{"opaque", "sky"}));
}

}  // namespace
}  // namespace rowland::render
