// A capture on a dome is seen where a ray leaves the room, found by small steps.
#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>

#include "tests/gpu/render_test.h"

namespace rowland::render {
namespace {

constexpr lighting::CaptureDome kDome{.height_m = 1.5, .radius_m = 4.0};

class DomeTest : public test::RenderTest {
 protected:
    /// Each face of the cube has its own radiance, the face's number plus 1.
    static lighting::LightProbe numbered_faces() {
        lighting::LightProbe probe = even_light(1.0F);
        probe.environment.layout = {.face_size = 8, .levels = 1};
        auto& halves = probe.environment.halves;
        halves.resize(3 * probe.environment.layout.offset(1));
        for (std::size_t i = 0; i < halves.size(); ++i) {
            const std::size_t face = i / (halves.size() / 6);
            halves[i] = glm::packHalf1x16(1.0F + static_cast<float>(face));
        }
        return probe;
    }
    /// A quadratic spline's, at so many texels from the texel.
    static double spline_weight(double distance) {
        const double d = std::abs(distance);
        return d < 0.5 ? 0.75 - d * d : 0.5 * std::pow(std::max(1.5 - d, 0.0), 2.0);
    }
    static glm::dvec3 from_capture(const glm::dvec3& eye, const glm::dvec3& seen) {
        const glm::dvec3 capture(0.0, kDome.height_m, 0.0);
        constexpr double kStep_m = 1e-4;
        glm::dvec3 at = eye;
        while (at.y >= 0.0 && glm::length(at - capture) < kDome.radius_m) at += kStep_m * seen;
        return at - capture;
    }
    glm::dvec3 seen_by(std::size_t pixel) const {
        const std::size_t row = pixel / kSize;
        const glm::dvec2 at(static_cast<double>(pixel % kSize), static_cast<double>(row));
        const glm::dvec2 offset = (2.0 * (at + 0.5) / double{kSize} - 1.0) * double{kHalfView / kEye};
        const glm::dvec3 forward = glm::normalize(glm::dvec3(camera_.target - camera_.eye));
        const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0.0, 1.0, 0.0)));
        return glm::normalize(forward + offset.x * right - offset.y * glm::cross(right, forward));
    }
};

TEST_F(DomeTest, ShowsTheCaptureWhereARayLeavesTheRoom) {
    lighting::LightProbe probe = numbered_faces();
    probe.dome = kDome;
    renderer_.set_probe(probe);
    int compared = 0;
    int on_the_floor = 0;
    for (const glm::vec3& target : {glm::vec3(0.0F), glm::vec3(-2.0F, 0.0F, 1.0F), glm::vec3(1.5F, 3.0F, 0.0F)}) {
        camera_.eye = {1.0F, 0.9F, 2.0F};
        camera_.target = target;
        const std::vector<glm::vec4> pixels = draw();
        for (std::size_t i = 0; i < pixels.size(); i += 7) {
            const lighting::CubePoint point = lighting::cube_point(from_capture(camera_.eye, seen_by(i)));
            // Filtering mixes faces near their edges.
            if (std::max(std::abs(point.s), std::abs(point.t)) > 0.7) continue;
            ++compared;
            if (point.face == 3) ++on_the_floor;
            EXPECT_EQ(pixels[i].r, static_cast<float>(point.face + 1)) << "pixel " << i;
        }
    }
    EXPECT_GT(compared, 100);
    EXPECT_GT(on_the_floor, 20);
}

TEST_F(DomeTest, TheCaptureIsASplineBetweenItsTexels) {
    lighting::LightProbe probe = numbered_faces();
    probe.dome = kDome;
    constexpr int kFace = 3;  // the floor
    auto& halves = probe.environment.halves;
    std::ranges::fill(halves, std::uint16_t{0});
    const std::size_t lit = probe.environment.layout.index(0, kFace, 4, 3);
    std::fill_n(halves.begin() + static_cast<std::ptrdiff_t>(3 * lit), 3, glm::packHalf1x16(1.0F));
    renderer_.set_probe(probe);
    camera_.eye = {1.0F, 0.9F, 1.5F};
    camera_.target = {0.1F, 0.0F, -0.1F};
    const std::vector<glm::vec4> pixels = draw();
    double brightest = 0.0;
    for (std::size_t i = 0; i < pixels.size(); i += 3) {
        const lighting::CubePoint point = lighting::cube_point(from_capture(camera_.eye, seen_by(i)));
        if (point.face != kFace) continue;
        const double expected = spline_weight(4.0 * (point.s + 1.0) - 4.5) * spline_weight(4.0 * (point.t + 1.0) - 3.5);
        EXPECT_NEAR(pixels[i].r, expected, 0.005) << "pixel " << i;
        brightest = std::max(brightest, expected);
    }
    EXPECT_GT(brightest, 0.4);
}

TEST_F(DomeTest, WithoutADomeTheCaptureIsInfinitelyFarAway) {
    renderer_.set_probe(numbered_faces());
    camera_.target = {0.0F, 0.0F, 0.0F};
    const std::vector<glm::vec4> near = draw();
    camera_.eye += glm::vec3(0.0F, 2.0F, 0.0F);
    camera_.target = {0.0F, 2.0F, 0.0F};
    EXPECT_EQ(draw(), near);
}

}  // namespace
}  // namespace rowland::render
