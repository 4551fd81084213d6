// Fifteen seconds of play without a window: nothing piles up.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include "content/demo/play/recording.h"
#include "content/demo/session.h"
#include "engine/gpu/context.h"
#include "engine/platform/gl_context.h"
#include "modules/diffraction/runtime/diffraction_surface.h"
#include "tests/demo/demo_session.h"
#include "tests/support/environment.h"

namespace rowland {
namespace {

using demo::Action;
using demo::PlayEvent;
using test::button;
using test::mouse;

constexpr int kPlayFramesPerSecond = 10;
constexpr int kRounds = 3;  ///< ROWLAND_PLAY_ROUNDS asks for more: 120 are ten minutes
constexpr int kFramesPerRound = 50;
constexpr glm::ivec2 kPlayPixels{80, 45};
constexpr glm::ivec2 kPlayWindow{160, 90};  ///< in the mouse's units

int rounds() {
    const char* asked = std::getenv("ROWLAND_PLAY_ROUNDS");
    return asked == nullptr ? kRounds : std::max(kRounds, std::atoi(asked));
}

/// MiB of the C heap that somebody holds. Resident memory would depend on where the allocator found room:
/// one freed map of 28 MiB stays with the process or does not.
double held_mib() {
    return static_cast<double>(test::heap_bytes()) / (1024.0 * 1024.0);
}

/// What a player does in one frame of a round, which ends as it began but for what was turned.
std::vector<PlayEvent> events_of(int frame) {
    // On the CD, and dragged across; then beside the objects.
    if (frame == 2) return {mouse(58, 50), button(true)};
    if (frame > 2 && frame < 8) return {mouse(58 + 3 * (frame - 2), 50 + 2 * (frame - 2))};
    if (frame == 8) return {button(false)};
    if (frame == 10) return {mouse(10, 85), button(true)};
    if (frame > 10 && frame < 14) return {mouse(10 + 4 * (frame - 10), 85)};
    if (frame == 14) return {button(false)};
    if (frame >= 15 && frame < 19) return {demo::ActionEvent{Action::AddLight}};
    if (frame >= 25 && frame < 29) return {demo::ActionEvent{Action::RemoveLight}};
    constexpr std::array kOthers{
        Action::Bloom,        Action::NextProbe,    Action::Lamp,       Action::TurnEnvironmentLeft,
        Action::AutoExposure, Action::Lamp,         Action::Bloom,      Action::TurnEnvironmentLeft,
        Action::SlowMotion,   Action::AutoExposure, Action::SlowMotion, Action::Vignette,
        Action::Vignette};
    if (frame >= 30 && frame - 30 < static_cast<int>(kOthers.size()))
        return {demo::ActionEvent{kOthers[static_cast<std::size_t>(frame - 30)]}};
    return {};
}

bool all_finite(const gpu::Framebuffer& picture) {
    const std::vector<glm::vec4> pixels = picture.read_rgba_float();
    return std::all_of(pixels.begin(), pixels.end(), [](const glm::vec4& pixel) {
        return std::isfinite(pixel.r) && std::isfinite(pixel.g) && std::isfinite(pixel.b);
    });
}

TEST(DemoLongPlay, HoldsItsMemoryAndDrawsFinitePixelsWithoutAnOpenGlError) {
    // With threads of its own, llvmpipe keeps the deleted textures of as many frames as it once fell behind by.
    test::set_variable("LP_NUM_THREADS", "0");
    const platform::HeadlessContext context({.debug = true});
    gpu::enable_debug_output(true);  // an error ends the program
    const post::OcioConfig config = post::OcioConfig::choose(std::nullopt);
    // Without a wait every map has its stand-in from the first frame on, not from that which happens to be late.
    demo::Session session(test::cabinet_options(), config, kPlayPixels, kPlayWindow, demo::Pace::Fluent,
                          std::chrono::milliseconds(0));
    demo::PlayClock clock;
    const std::filesystem::path first_probe = session.probe_path();
    std::vector<double> held;  // after each round
    const int count = rounds();
    for (int round = 0; round < count; ++round) {
        for (int frame = 0; frame < kFramesPerRound; ++frame) {
            clock.live(session.play(), std::chrono::milliseconds(1000 / kPlayFramesPerSecond), events_of(frame),
                       nullptr);
            EXPECT_TRUE(session.carry_out().empty());
            session.draw(1.0F / kPlayFramesPerSecond);
            ASSERT_TRUE(frame % 10 != 0 || all_finite(session.picture().linear())) << round << ", " << frame;
        }
        session.use_probe(first_probe);  // probes differ in size
        // However long the round took, its maps are full when it is measured.
        for (int frame = 0; frame < 100000 && diffraction::maps_are_filling(session.play().world()); ++frame)
            session.draw(1.0F / kPlayFramesPerSecond);
        held.push_back(held_mib());
        RecordProperty("held_mib_" + std::to_string(round), std::to_string(held.back()));
    }
    EXPECT_EQ(session.play().steps(), static_cast<unsigned>(120 * count * kFramesPerRound / kPlayFramesPerSecond));
    EXPECT_GT(session.play().environment_turn(), 0.3);
    // Caches that are bounded fill in rounds that differ from run to run (6 to 19 MiB, once); what piles up does so in
    // every round. Measured of six rounds, in MiB: 776.75, 776.78, 782.81, 782.82, 782.82 and 782.82.
    double least_growth = held[1] - held[0];
    for (std::size_t i = 2; i < held.size(); ++i) least_growth = std::min(least_growth, held[i] - held[i - 1]);
    EXPECT_LT(least_growth, 0.5) << "MiB a round, to " << held.back();
}

}  // namespace
}  // namespace rowland
