#include "editor/trade/inputs.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "engine/core/file.h"

namespace rowland::trade {
namespace {

TEST(FrameSets, AreValidAndSeenFromAbove) {
    for (const FrameSet& set : {tilted_cd_frames(), sphere_frames()}) {
        EXPECT_EQ(all_frames(set).size(), 120U) << set.name;
        for (const diffraction::ShadingPoint& frame : all_frames(set)) {
            EXPECT_TRUE(is_valid(frame)) << set.name;
            EXPECT_GE(glm::dot(frame.view, frame.normal), 0.1) << set.name;
            EXPECT_NEAR(glm::dot(frame.grating, frame.normal), 0.0, 1e-12) << set.name;
            EXPECT_NEAR(glm::length(frame.view), 1.0, 1e-12) << set.name;
        }
    }
}

TEST(FrameSets, TheDiscIsFlatAndTiltedBy35DegreesAndTheSphereIsNot) {
    const FrameSet disc = tilted_cd_frames();
    EXPECT_TRUE(is_flat(disc.surfaces.front()));
    EXPECT_NEAR(disc.surfaces.front().front().normal.y, 0.819152, 1e-6);  // cos 35°
    EXPECT_FALSE(is_flat(sphere_frames().surfaces.front()));
}

/// From its front to 84° from the normal, where rainbows are.
TEST(FrameSets, TheSphereIsSeenUpToItsRim) {
    double least = 1.0;
    double most = 0.0;
    for (const diffraction::ShadingPoint& frame : all_frames(sphere_frames())) {
        least = std::min(least, glm::dot(frame.view, frame.normal));
        most = std::max(most, glm::dot(frame.view, frame.normal));
    }
    EXPECT_LT(least, 0.15);
    EXPECT_GT(most, 0.98);
}

TEST(PictureScene, PointsAreValidAndPixelsDifferent) {
    const PictureFrames seen = picture_frames(far_camera(), 64, 36);
    const std::vector<diffraction::ShadingPoint> frames = all_frames(seen.frames);
    ASSERT_EQ(frames.size(), seen.pixels.size());
    ASSERT_EQ(seen.frames.surfaces.size(), 2U);
    EXPECT_GT(seen.frames.surfaces[0].size(), 200U);
    EXPECT_GT(seen.frames.surfaces[1].size(), 20U);
    EXPECT_TRUE(is_flat(seen.frames.surfaces[0]));
    EXPECT_EQ(std::set<std::size_t>(seen.pixels.begin(), seen.pixels.end()).size(), seen.pixels.size());
    for (const diffraction::ShadingPoint& frame : frames) {
        EXPECT_TRUE(is_valid(frame));
        EXPECT_GT(glm::dot(frame.view, frame.normal), 0.0);
    }
}

/// A mesh's vertex that nothing hides falls into a pixel whose point has the vertex's frame, within a pixel's width.
TEST(PictureScene, ExactSurfacesLieWhereTheMeshesDo) {
    constexpr int kWidth = 320;
    constexpr int kHeight = 180;
    const scene::Camera camera = far_camera();
    const PictureFrames seen = picture_frames(camera, kWidth, kHeight);
    const std::vector<diffraction::ShadingPoint> frames = all_frames(seen.frames);
    std::vector<const diffraction::ShadingPoint*> at(static_cast<std::size_t>(kWidth * kHeight), nullptr);
    for (std::size_t i = 0; i < frames.size(); ++i) at[seen.pixels[i]] = &frames[i];
    const glm::mat4 to_clip = camera.projection(16.0F / 9.0F) * camera.view();
    const auto check = [&](const scene::Mesh& mesh, const glm::vec3& offset, float least_view_cosine, bool flat) {
        int compared = 0;
        for (std::size_t v = 0; v < mesh.positions.size(); v += 37) {
            const glm::vec3 world = mesh.positions[v] + offset;
            if (glm::dot(glm::normalize(camera.eye - world), mesh.normals[v]) < least_view_cosine) continue;
            const glm::vec4 clip = to_clip * glm::vec4(world, 1.0F);
            const auto column = static_cast<int>((clip.x / clip.w + 1.0F) * 0.5F * kWidth);
            const auto row = static_cast<int>((1.0F - clip.y / clip.w) * 0.5F * kHeight);
            const diffraction::ShadingPoint* frame = at.at(static_cast<std::size_t>(row * kWidth + column));
            if (frame == nullptr || (flat != (frame->normal.y == 1.0))) continue;  // the rim; what the sphere hides
            EXPECT_GT(glm::dot(frame->normal, glm::dvec3(mesh.normals[v])), 0.98);
            if (flat || std::abs(mesh.normals[v].y) < 0.9F) {  // meridians turn fast at a pole
                EXPECT_GT(glm::dot(frame->grating, glm::dvec3(mesh.tangents[v])), 0.97);
            }
            ++compared;
        }
        EXPECT_GT(compared, 50);
    };
    check(disc_mesh(), glm::vec3(0.0F), 0.0F, true);
    check(sphere_mesh(), kSphereCentre, 0.5F, false);
}

TEST(PictureScene, RadianceGoesBackToItsPixels) {
    const PictureFrames seen = picture_frames(far_camera(), 32, 18);
    std::vector<glm::dvec3> radiance(seen.pixels.size());
    for (std::size_t i = 0; i < radiance.size(); ++i) radiance[i] = glm::dvec3(static_cast<double>(i) + 1.0);
    const std::vector<glm::dvec3> pixels = picture(seen, radiance);
    ASSERT_EQ(pixels.size(), 32U * 18U);
    for (std::size_t i = 0; i < radiance.size(); ++i) EXPECT_EQ(pixels[seen.pixels[i]], radiance[i]);
    EXPECT_EQ(static_cast<std::size_t>(std::count(pixels.begin(), pixels.end(), glm::dvec3(0.0))),
              pixels.size() - radiance.size());
}

}  // namespace
}  // namespace rowland::trade
