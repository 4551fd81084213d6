#include "editor/trade/frame_sets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "engine/core/file.h"
#include "tests/support/temporary_folder.h"

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

TEST(FrameSets, FilesAreReadUnderTheirName) {
    const test::TemporaryFolder folder;
    write_file_atomic(folder.path() / "f.csv", "vx,vy,vz,nx,ny,nz,gx,gy,gz\n0,1,0,0,1,0,1,0,0\n0,1,1,0,1,0,0,0,1\n");
    const FrameSet set = frames_of_file("mine", folder.path() / "f.csv");
    EXPECT_EQ(set.name, "mine");
    EXPECT_EQ(all_frames(set).size(), 2U);
    EXPECT_TRUE(is_flat(set.surfaces.front()));
}

}  // namespace
}  // namespace rowland::trade
