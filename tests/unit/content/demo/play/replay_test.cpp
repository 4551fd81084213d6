// A play knows nothing of frames.

#include <cmath>

#include "content/demo/play/recording.h"
#include "tests/support/files.h"
#include "tests/unit/content/demo/play/small_world.h"

namespace rowland::demo {
namespace {

using std::chrono::nanoseconds;
using test::SmallWorld;

TEST(DemoReplay, AFramesEventsFallOnItsStepsEvenlyAndInOrder) {
    std::vector<PlayEvent> events;
    for (int i = 0; i < 10; ++i) events.push_back(test::mouse({i, 0.0}));
    for (const int steps : {1, 3, 10, 25}) {
        std::vector<double> dealt;
        for (int step = 0; step < steps; ++step) {
            const auto of_step = events_of_step(events, step, steps);
            EXPECT_LE(of_step.size(), static_cast<std::size_t>(std::ceil(10.0 / steps))) << steps;
            for (const PlayEvent& event : of_step)
                dealt.push_back(std::get<platform::MouseMoveEvent>(std::get<platform::InputEvent>(event)).position.x);
        }
        EXPECT_EQ(dealt, (std::vector<double>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9})) << steps;
    }
}

TEST(DemoReplay, AMouseButtonComesUpWithWhatWasBeforeIt) {
    const std::vector<PlayEvent> events = {test::button(false), test::mouse({1, 0}), test::button(false),
                                           test::mouse({2, 0})};
    for (const int steps : {1, 4, 30}) {
        std::vector<std::size_t> sizes;
        for (int step = 0; step < steps; ++step)
            if (const std::size_t size = events_of_step(events, step, steps).size(); size > 0) sizes.push_back(size);
        EXPECT_EQ(sizes, steps == 1 ? (std::vector<std::size_t>{4}) : (std::vector<std::size_t>{1, 2, 1})) << steps;
    }
}

/// What a user does in the seconds from `begin` to `end`: takes the right square, throws it, lights, walks.
std::vector<PlayEvent> user(double begin, double end) {
    std::vector<PlayEvent> events;
    const auto at = [&](double time, const PlayEvent& event) {
        if (time >= begin && time < end) events.push_back(event);
    };
    at(0.10, test::mouse(test::kOnRight));
    at(0.20, test::button(true));
    for (int i = 0; i < 60; ++i) at(0.21 + 0.005 * i, test::mouse(test::kOnRight + glm::dvec2(1.5 * i, 0.7 * i)));
    at(0.515, test::button(false));
    at(0.7, test::key(platform::Key::G, true));
    at(0.8, test::key(platform::Key::G, false));
    at(0.9, ResizeEvent{{500, 300}});
    at(1.0, test::mouse({100.0, 20.0}));
    at(1.0, test::button(true));
    for (int i = 0; i < 30; ++i) at(1.05 + 0.01 * i, test::mouse({100.0 + i, 20.0}));
    at(1.5, test::button(false));
    at(1.6, test::key(platform::Key::Period, true));
    at(2.6, test::key(platform::Key::Period, false));
    at(2.7, test::key(platform::Key::C, true));
    at(2.7, test::key(platform::Key::C, false));
    at(2.8, test::key(platform::Key::W, true));
    at(3.3, test::key(platform::Key::W, false));
    at(3.4, test::key(platform::Key::C, true));
    at(3.4, test::key(platform::Key::C, false));
    return events;
}

struct Outcome {
    std::vector<glm::mat4> positions;
    std::vector<BodyState> states;
    glm::vec3 eye;
    std::uint64_t steps;
    std::size_t lights;

    friend bool operator==(const Outcome&, const Outcome&) = default;
};

Outcome outcome_of(SmallWorld& small, Play& play) {
    Outcome outcome{{}, {}, play.camera().eye, play.steps(), light_count(small.world)};
    small.world.view<scene::Transform>().each([&](ecs::Entity entity, const scene::Transform&) {
        outcome.positions.push_back(object_to_world(small.world, entity));
    });
    for (const Body& body : play.bodies()) outcome.states.push_back(body.state);
    return outcome;
}

/// Plays the user live for 5 s at frames of uneven lengths around `mean_frame_s`; records it if there is a recorder.
Outcome live(double mean_frame_s, Recorder* recorder) {
    SmallWorld small;
    Play play = small.play();
    PlayClock clock;
    double time = 0.0;
    for (int frame = 0; time < 5.0; ++frame) {
        const double length = mean_frame_s * (1.0 + 0.6 * std::sin(1.7 * frame));
        clock.live(play, nanoseconds(std::llround(1e9 * length)), user(time, time + length), recorder);
        time += length;
    }
    if (recorder != nullptr) recorder->finish(play.steps());
    return outcome_of(small, play);
}

Outcome replayed(const Recording& recording, nanoseconds frame) {
    SmallWorld small;
    Play play = small.play();
    PlayClock clock;
    while (clock.replay(play, frame, recording)) {
    }
    return outcome_of(small, play);
}

TEST(DemoReplay, ARecordingGivesTheSameStateToTheBitAtAnyFrameRate) {
    const test::TemporaryFolder folder;
    const std::filesystem::path path = folder.path() / "play.jsonl";
    Recorder recorder(path, {.scene = "small", .window = test::kWindow});
    const Outcome recorded = live(0.02, &recorder);
    ASSERT_GT(glm::length(recorded.states[1].spin), 0.5);  // it was thrown
    ASSERT_EQ(recorded.lights, 1U);
    const Recording recording = load_recording(path);
    for (const double frame_ms : {3.0, 16.7, 33.3, 250.0, 900.0})
        EXPECT_EQ(replayed(recording, nanoseconds(std::llround(1e6 * frame_ms))), recorded) << frame_ms;
}

TEST(DemoReplay, AThrowIsAboutAsFastAtTwoFramesASecondAsAtSixty) {
    const Outcome fluent = live(1.0 / 60.0, nullptr);
    const Outcome slow = live(0.5, nullptr);
    const double fast_spin = glm::length(fluent.states[1].spin);
    const double slow_spin = glm::length(slow.states[1].spin);
    ASSERT_GT(fast_spin, 0.5);
    // A slow frame spreads its events evenly over its time, whenever they came.
    EXPECT_GT(slow_spin, 0.2 * fast_spin);
    EXPECT_LT(slow_spin, 3.0 * fast_spin);
}

TEST(DemoReplay, APadAtRestIsNoEvent) {
    const test::TemporaryFolder folder;
    const std::filesystem::path path = folder.path() / "play.jsonl";
    Recorder recorder(path, {.scene = "small", .window = test::kWindow});
    SmallWorld small;
    Play play = small.play();
    PlayClock clock;
    platform::GamepadEvent pad;
    for (int frame = 0; frame < 8; ++frame) {
        if (frame == 2) pad.connected = true;
        if (frame == 5) pad.axes[0] = 0.5F;
        clock.live(play, std::chrono::milliseconds(50), {platform::InputEvent(pad)}, &recorder);
    }
    recorder.finish(play.steps());
    const Recording recording = load_recording(path);
    ASSERT_EQ(recording.steps.size(), 2U);
    EXPECT_EQ(recording.steps[0].step, 12U);
    EXPECT_EQ(recording.steps[1].step, 30U);
}

TEST(DemoReplay, AReleaseInTheNextFrameStillThrows) {
    // At five frames per second: ten movements in one frame, the release in the next.
    SmallWorld small;
    Play play = small.play();
    PlayClock clock;
    const auto frame = std::chrono::milliseconds(200);
    clock.live(play, frame, {test::mouse(test::kOnRight), test::button(true)}, nullptr);
    std::vector<PlayEvent> moves;
    for (int i = 1; i <= 10; ++i) moves.push_back(test::mouse(test::kOnRight + glm::dvec2(3.0 * i, 0.0)));
    clock.live(play, frame, moves, nullptr);
    clock.live(play, frame, {test::button(false)}, nullptr);
    // 30 points, 0.75 radians, in 0.2 s.
    EXPECT_GT(glm::length(play.bodies()[1].state.spin), 2.0);
    EXPECT_LT(glm::length(play.bodies()[1].state.spin), 6.0);
}

TEST(DemoReplay, FramesShorterThanAStepLoseNothing) {
    SmallWorld small;
    Play play = small.play();
    PlayClock clock;
    for (int i = 0; i < 10; ++i)
        clock.live(play, std::chrono::microseconds(1), {ActionEvent{Action::NextProbe}}, nullptr);
    EXPECT_EQ(play.steps(), 0U);
    clock.live(play, std::chrono::milliseconds(9), {}, nullptr);
    EXPECT_EQ(play.steps(), 1U);
    EXPECT_EQ(play.take_commands().size(), 10U);
}

}  // namespace
}  // namespace rowland::demo
