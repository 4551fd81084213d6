// When maps are filled, and which is shown meanwhile.
#include "modules/diffraction/runtime/gpu_map.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <memory>
#include <semaphore>
#include <stdexcept>
#include <vector>

#include "engine/core/error.h"
#include "tests/gpu/gl_test.h"
#include "tests/support/replaced_function.h"

namespace rowland::diffraction {
namespace {

/// Maps of one texel; a test says when a full one may be filled.
class MapFillingTest : public rowland::test::GlTest {
 protected:
    ~MapFillingTest() override { full_maps_.release(1000); }

    void update(double normal, MapPace pace = MapPace::Incremental) {
        filling_.update({.texels = texels_, .normal = {normal, 0.0, 0.0}}, fill_, pace);
    }
    void update_until_complete(double normal) {
        while (!filling_.is_complete()) update(normal);
    }

    std::shared_ptr<const lighting::LightSamples> texels_ = std::make_shared<const lighting::LightSamples>();
    std::atomic<int> coarse_count_ = 0;
    std::counting_semaphore<> full_maps_{0};
    std::shared_ptr<const FillMap> fill_ =
        std::make_shared<const FillMap>([this](const MapInput&, MapDetail detail, const std::stop_token&) -> FilledMap {
            if (detail == MapDetail::Full)
                full_maps_.acquire();
            else
                ++coarse_count_;
            const std::array<std::vector<glm::vec3>, 1> levels{std::vector<glm::vec3>{glm::vec3(1.0F)}};
            return {.texels = pack(levels, {}, {}), .set_uniforms = nullptr};
        });
    MapFilling filling_;  ///< last member: it waits for the thread
};

TEST_F(MapFillingTest, TheFirstFrameHasACoarseMapAndDoesNotWaitForTheFullOne) {
    update(1.0);
    EXPECT_TRUE(filling_.has_map());
    EXPECT_FALSE(filling_.is_complete());
    for (int frame = 0; frame < 10; ++frame) update(1.0);
    EXPECT_FALSE(filling_.is_complete());
    full_maps_.release();
    update_until_complete(1.0);
    EXPECT_EQ(filling_.fills_begun(), 1);
    EXPECT_EQ(filling_.maps_shown(), 2);
    EXPECT_EQ(coarse_count_, 1);
}

TEST_F(MapFillingTest, CoarseMapsFollowAnObjectThatTurnsInEveryFrame) {
    update(0.0);
    double normal = 0.0;
    full_maps_.release(1000);
    while (filling_.maps_shown() < 10) update(normal += 1.0);
    EXPECT_GT(coarse_count_, 1);
    update_until_complete(normal);
    EXPECT_TRUE(filling_.has_map());
}

int textures_created = 0;
void APIENTRY create_textures(GLenum target, GLsizei count, GLuint* names) {
    textures_created += count;
    rowland::test::ReplacedFunction<&epoxy_glCreateTextures>::driver(target, count, names);
}

/// The one that is shown, and the one that the next map goes to.
TEST_F(MapFillingTest, MapsOfOneSizeTakeTurnsInTwoTextures) {
    const rowland::test::ReplacedFunction<&epoxy_glCreateTextures> counted("glCreateTextures", create_textures);
    full_maps_.release(1000);
    textures_created = 0;
    double normal = 0.0;
    while (filling_.maps_shown() < 10) update(normal += 1.0);
    EXPECT_EQ(textures_created, 2);
}

TEST_F(MapFillingTest, UnderNewLightNoFrameShowsTheOldOneNorWaitsForTheFullMap) {
    update(1.0);
    texels_ = std::make_shared<const lighting::LightSamples>();
    update(1.0);  // the old light's full map is still being filled
    EXPECT_EQ(coarse_count_, 2);
    EXPECT_EQ(filling_.maps_shown(), 2);
    EXPECT_FALSE(filling_.is_complete());
    full_maps_.release(2);
    update_until_complete(1.0);
    EXPECT_EQ(filling_.maps_shown(), 3);
    EXPECT_EQ(coarse_count_, 2);
}

TEST_F(MapFillingTest, AStillWaitsForTheFullMapOfEveryInput) {
    for (const double normal : {1.0, 2.0, 2.0}) {
        full_maps_.release();
        update(normal, MapPace::Whole);
        EXPECT_TRUE(filling_.is_complete());
    }
    EXPECT_EQ(filling_.fills_begun(), 2);
    EXPECT_EQ(coarse_count_, 0);
}

TEST_F(MapFillingTest, AMapThatCannotBeFilledIsAnError) {
    fill_ = std::make_shared<const FillMap>(
        [inner = fill_](const MapInput& input, MapDetail detail, const std::stop_token& stop) {
            if (detail == MapDetail::Full) throw std::runtime_error("no room");
            return (*inner)(input, detail, stop);
        });
    EXPECT_THROW(update_until_complete(1.0), Error);
}

}  // namespace
}  // namespace rowland::diffraction
