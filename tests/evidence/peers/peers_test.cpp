// What the page says of other shaders: their errors beside ours, and that the measures notice a wrong formula.
#include <gtest/gtest.h>

#include <algorithm>

#include "engine/platform/gl_context.h"
#include "tests/evidence/peers/comparison.h"
#include "tests/evidence/peers/properties.h"

namespace rowland::evidence {
namespace {

class Peers : public testing::Test {
 protected:
    static const Subject& subject(const std::string& name) {
        return *std::ranges::find(subjects(), name, &Subject::name);
    }
    /// The published setting with another first parameter, the pitch, and nothing but its orders.
    static PeerSetting with_pitch(const std::string& name, float pitch) {
        PeerSetting setting = subject(name).published;
        setting.parameters.x = pitch;
        setting.highlight = false;
        return setting;
    }

    platform::HeadlessContext context_{{.debug = false}};
};

TEST_F(Peers, OrdersLieWhereTheirFormulasPutThem) {
    EXPECT_LT(direction_error_of_direct().across.value(), 0.1);
    EXPECT_LT(direction_error(with_pitch("zucconi_repaired", 1650.0F)).across.value(), 0.5);
    EXPECT_FALSE(direction_error(with_pitch("zucconi", 1650.0F)).across.has_value());
    EXPECT_FALSE(direction_error(subject("iridescence").published).across.has_value());
    // Sines of projected angles are other angles only outside the plane across the grooves.
    EXPECT_GT(direction_error(with_pitch("projected", 1600.0F)).along.value(), 2.0);
}

TEST_F(Peers, AWrongPitchIsNoticed) {
    const DirectionError right = direction_error(with_pitch("zucconi_repaired", 1650.0F));
    const DirectionError wrong = direction_error(with_pitch("zucconi_repaired", 1485.0F));
    EXPECT_GT(wrong.across.value(), 1.0);
    EXPECT_GT(wrong.across.value(), 3.0 * right.across.value());
}

TEST_F(Peers, ReturnNoMoreThanTheyPublish) {
    const ReturnedEnergy published = returned_energy(subject("stam").published);
    EXPECT_GT(published.most, 0.8);
    EXPECT_LT(published.most, 1.0);
    // Half the efficiency of a slit of half the pitch, less aluminium's absorption, in the two first orders.
    EXPECT_NEAR(returned_by_disc(), 0.19, 0.01);
}

TEST_F(Peers, UnderOneLampOursIsTheReferencesAndTheirsAreFarOff) {
    const trade::PictureFrames frames = disc_picture();
    PointPass pass(frames.frames.surfaces.front());
    const LightCase lamp = lamp_case("lamp", {}, frames, pass);
    ASSERT_EQ(lamp.peers.size(), subjects().size());
    EXPECT_LT(lamp.ours.front().error.relative_rms, 0.002);
    const auto error = [&](const std::string& name) {
        return std::ranges::find(lamp.peers, name, &Shown::name)->error.relative_rms;
    };
    for (const Shown& peer : lamp.peers) EXPECT_GT(peer.error.relative_rms, 0.3) << peer.name;
    EXPECT_LT(error("stam_across"), error("stam") - 0.1);
    EXPECT_LT(error("zucconi_repaired"), error("zucconi") - 0.05);
    EXPECT_NEAR(error("three_lobes"), 0.48, 0.05);
    EXPECT_NEAR(error("egholm"), 0.75, 0.08);
}

}  // namespace
}  // namespace rowland::evidence
