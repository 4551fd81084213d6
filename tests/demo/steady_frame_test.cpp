// What a frame asks of the driver once everything is loaded.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <thread>
#include <vector>

#include "content/demo/play/recording.h"
#include "content/demo/session.h"
#include "engine/gpu/buffer.h"
#include "engine/gpu/context.h"
#include "engine/platform/gl_context.h"
#include "modules/diffraction/runtime/diffraction_surface.h"
#include "tests/demo/demo_session.h"
#include "tests/gpu/call_counts.h"

namespace rowland {
namespace {

using demo::PlayEvent;
using test::button;
using test::mouse;

constexpr glm::ivec2 kSteadySize{96, 54};
constexpr int kSteadyFramesPerSecond = 30;

class SteadyFrame : public testing::Test {
 protected:
    SteadyFrame() {
        gpu::enable_debug_output(true);
        options_.sun = true;
        options_.auto_exposure = true;
        options_.bloom = 0.05F;
        options_.dither = true;
        options_.glare = options_.content_folder / "materials/screen_door.json";
    }

    void open() {
        session_.emplace(options_, post::OcioConfig::choose(std::nullopt), kSteadySize, kSteadySize,
                         demo::Pace::Fluent);
    }
    /// After the frames before it, as a window's are: otherwise it would wait for a GPU that is three frames behind.
    void frame(std::vector<PlayEvent> events = {}) {
        const gpu::Fence before;
        glFlush();
        while (!before.passed()) std::this_thread::yield();
        clock_.live(session_->play(), std::chrono::milliseconds(1000 / kSteadyFramesPerSecond), std::move(events),
                    nullptr);
        session_->carry_out();
        session_->draw(1.0F / kSteadyFramesPerSecond);
    }
    /// The first frame links all programs and shows coarse maps. Between the next ones, the cores fill the full maps.
    void load() {
        for (frame(); diffraction::maps_are_filling(session_->play().world()); frame())
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        test::CallCounts calls;
        for (int i = 0; i < 2; ++i) frame();
        EXPECT_EQ(calls.take().compiled, 0);
    }

    static void expect_steady(const test::CallCounts::Counts& counts) {
        EXPECT_GT(counts.draws, 10);
        EXPECT_EQ(counts.waits, 0);
        EXPECT_EQ(counts.made, 0);
        EXPECT_EQ(counts.compiled, 0);
        EXPECT_EQ(counts.copied, 0);
        EXPECT_LE(counts.redundant, 0.05 * counts.set) << counts.redundant << " of " << counts.set;
        if (!HasNonfatalFailure()) return;
        for (const auto& [name, count] : counts.which) ADD_FAILURE() << count << " " << name;
    }

    platform::HeadlessContext context_{{.debug = true}};
    demo::Options options_ = test::session_options();
    std::optional<demo::Session> session_;
    demo::PlayClock clock_;
};

TEST_F(SteadyFrame, OfTheCabinetNeitherWaitsNorMakesAnything) {
    options_.scene = options_.cooked_folder / "cabinet.scene";
    open();
    load();
    test::CallCounts calls;
    for (int i = 0; i < 6; ++i) {
        frame();
        expect_steady(calls.take());
    }
}

TEST_F(SteadyFrame, OfTheThrownDiscNeitherWaitsNorMakesAnything) {
    options_.disc = true;
    open();
    load();
    frame({mouse(48, 27), button(true)});
    for (int i = 1; i < 5; ++i) frame({mouse(48 + 5 * i, 27)});
    frame({button(false)});
    frame();
    const auto turned = [&] {
        std::map<std::uint32_t, glm::mat4> matrices;
        session_->play().world().view<diffraction::DiffractionSurface, scene::WorldMatrix>().each(
            [&](ecs::Entity entity, const diffraction::DiffractionSurface&, const scene::WorldMatrix& matrix) {
                matrices[entity.index] = matrix.matrix;
            });
        return matrices;
    };
    test::CallCounts calls;
    for (int i = 0; i < 6; ++i) {
        const auto before = turned();
        frame();
        EXPECT_NE(turned(), before) << "it flies";
        expect_steady(calls.take());
    }
}

}  // namespace
}  // namespace rowland
