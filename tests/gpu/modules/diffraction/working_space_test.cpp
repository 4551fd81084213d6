// What a grating adds is XYZ in the working space, whichever that is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/scene/light.h"
#include "tests/gpu/modules/diffraction/grating_picture.h"

namespace rowland::diffraction {
namespace {

const glm::dmat3 kWorking = glm::transpose(glm::dmat3(1.7, -0.4, -0.2, -0.6, 1.5, 0.1, 0.05, -0.2, 0.9));
constexpr const char* kNarrow = R"({"pitch_nm": 1300, "profile": {"type": "slit", "width_nm": 600},
                                    "groove_lobe": {"sigma": 0.1}})";
constexpr const char* kZeroOrder =
    R"({"pitch_nm": 1601, "profile": {"type": "slit", "width_nm": 700}, "orders": [-1, 0, 1]})";

class WorkingSpace : public GratingPicture {
 protected:
    WorkingSpace() { mesh_ = flat_triangle(); }
    std::vector<glm::vec4> drawn_in(const glm::dmat3& xyz_to_working, const CookedMaterial& cooked) {
        xyz_to_working_ = xyz_to_working;
        light_ = light_of(smooth_probe(), three_keys(), ++version_);
        world_ = ecs::World();
        show(cooked, 0.5);
        world_.add(entity_, render::StandardMaterial{.base_colour = glm::vec3(0.0F), .roughness = 1.0F});
        world_.add(world_.create(), scene::DirectionalLight{.direction = glm::normalize(glm::vec3(0.3F, 0.2F, 0.9F)),
                                                            .irradiance = glm::vec3(0.5F, 0.3F, 0.2F)});
        return draw();
    }

    std::uint64_t version_ = 0;
};

/// 3e-3: half floats, which are rounded in the space that they are in, by values that partly cancel.
TEST_F(WorkingSpace, EveryRepresentationDrawsInIt) {
    const std::pair<const char*, const char*> materials[] = {
        {kSlitCd, R"({"representation": "spikes"})"},
        {kSlitCd, R"({"representation": "arc", "lights_at": "vertices"})"},
        {kSlitCd, R"({"representation": "planar", "map_resolution": 32})"},
        {kBlazed, R"({"representation": "circle", "map_resolution": 8})"},
        {kNarrow, R"({"representation": "streak", "map_resolution": 64})"},
        {kPits, R"({"representation": "direct"})"},
        {kPits, R"({"representation": "direct", "lights_at": "vertices"})"},
        {kZeroOrder, R"({"representation": "direct"})"}};
    for (const auto& [grating, quality] : materials) {
        const CookedMaterial cooked = cook(grating, quality);
        const std::vector<glm::vec4> xyz = drawn_in(glm::dmat3(1.0), cooked);
        const std::vector<glm::vec4> working = drawn_in(kWorking, cooked);
        double difference = 0.0;
        double largest = 0.0;
        for (std::size_t i = 0; i < xyz.size(); ++i)
            for (int o = 0; o < 3; ++o) {
                const double expected = (kWorking * glm::dvec3(glm::vec3(xyz[i])))[o];
                largest = std::max(largest, std::abs(expected));
                difference = std::max(difference, std::abs(static_cast<double>(working[i][o]) - expected));
            }
        EXPECT_GT(largest, 0.01) << grating << quality;
        EXPECT_LT(difference / largest, 3e-3) << grating << quality;
    }
}

}  // namespace
}  // namespace rowland::diffraction
