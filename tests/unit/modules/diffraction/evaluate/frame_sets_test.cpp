#include "modules/diffraction/evaluate/frame_sets.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "tests/support/csv.h"
#include "tests/support/test_data.h"

namespace rowland::diffraction {
namespace {

void expect_set(const std::vector<ShadingPoint>& frames, const std::filesystem::path& path) {
    const test::Csv csv = test::read_csv(path);
    ASSERT_EQ(frames.size(), csv.rows.size());
    for (std::size_t i = 0; i < frames.size(); ++i) {
        EXPECT_EQ(frames[i].view, glm::dvec3(csv.number(i, "vx"), csv.number(i, "vy"), csv.number(i, "vz")));
        EXPECT_EQ(frames[i].normal, glm::dvec3(csv.number(i, "nx"), csv.number(i, "ny"), csv.number(i, "nz")));
        EXPECT_EQ(frames[i].grating, glm::dvec3(csv.number(i, "gx"), csv.number(i, "gy"), csv.number(i, "gz")));
    }
}

TEST(FrameSets, AreTheNamedOnes) {
    ROWLAND_TEST_DATA(disc, "oracle/frames_tilted_cd.csv");
    expect_set(measured_frames(SurfaceShape::Flat), disc);
    ROWLAND_TEST_DATA(sphere, "oracle/frames_sphere.csv");
    expect_set(measured_frames(SurfaceShape::Curved), sphere);
}

TEST(FrameSets, FlatIsOnePlaneAndCurvedMany) {
    const std::vector<ShadingPoint> flat = measured_frames(SurfaceShape::Flat);
    for (const ShadingPoint& frame : flat) EXPECT_EQ(frame.normal, flat.front().normal);
    const std::vector<ShadingPoint> curved = measured_frames(SurfaceShape::Curved);
    EXPECT_LT(glm::dot(curved.front().normal, curved.back().normal), 0.99);
}

}  // namespace
}  // namespace rowland::diffraction
