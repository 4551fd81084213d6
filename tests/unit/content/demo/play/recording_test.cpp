#include "content/demo/play/recording.h"

#include <gmock/gmock.h>

#include "engine/core/file.h"
#include "tests/support/expect.h"
#include "tests/support/files.h"
#include "tests/unit/content/demo/play/small_world.h"

namespace rowland::demo {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr const char* kHead =
    "{\"rowland_play\":1,\"steps_per_second\":120,\"scene\":\"cabinet.glb\",\"window\":[640,360]}\n";

class DemoRecording : public ::testing::Test {
 protected:
    Recording read(const std::string& text) const {
        write_file_atomic(path(), text);
        return load_recording(path());
    }
    std::string refusal(const std::string& text) const {
        return test::message_of([&] { read(text); });
    }
    std::filesystem::path path() const { return folder_.path() / "play.jsonl"; }

    test::TemporaryFolder folder_;
};

std::vector<PlayEvent> one_of_each() {
    platform::GamepadEvent pad{.connected = true, .axes = {}, .buttons = {}};
    pad.axes[2] = -0.3F;
    pad.buttons[4] = true;
    return {test::key(platform::Key::RightBracket, true),
            test::button(true),
            test::mouse({0.1, 1.0 / 3.0}),
            test::wheel(-2.5),
            platform::InputEvent(platform::FocusEvent{false}),
            platform::InputEvent(platform::CursorCaptureEvent{true}),
            platform::InputEvent(pad),
            ResizeEvent{{800, 600}},
            ActionEvent{Action::AutoExposure},
            SettingEvent{Setting::Exposure, -1.0 / 3.0},
            SettingEvent{Setting::Probe, "night \"1\""},
            SettingEvent{Setting::LeftLook, "arc, fine", "disc"},
            SettingEvent{Setting::Rung, 2.0, "17"}};
}

TEST_F(DemoRecording, EveryKindOfEventComesBackExactly) {
    {
        Recorder recorder(path(), {.scene = "a \"b\".glb", .window = {640, 360}});
        recorder.add(3, one_of_each());
        recorder.add(7, std::vector{test::key(platform::Key::A, false)});
        recorder.finish(12);
    }
    const Recording recording = load_recording(path());
    EXPECT_EQ(recording.head.scene, "a \"b\".glb");
    EXPECT_EQ(recording.head.window, glm::ivec2(640, 360));
    EXPECT_EQ(recording.step_count, 12U);
    EXPECT_TRUE(recording.events_at(2).empty());
    const auto events = recording.events_at(3);
    ASSERT_EQ(events.size(), one_of_each().size());
    const auto input = [&](std::size_t i) { return std::get<platform::InputEvent>(events[i]); };
    EXPECT_EQ(std::get<platform::KeyEvent>(input(0)).key, platform::Key::RightBracket);
    EXPECT_TRUE(std::get<platform::KeyEvent>(input(0)).down);
    EXPECT_TRUE(std::get<platform::MouseButtonEvent>(input(1)).down);
    EXPECT_EQ(std::get<platform::MouseMoveEvent>(input(2)).position, glm::dvec2(0.1, 1.0 / 3.0));
    EXPECT_EQ(std::get<platform::ScrollEvent>(input(3)).offset, glm::dvec2(0.0, -2.5));
    EXPECT_FALSE(std::get<platform::FocusEvent>(input(4)).focused);
    EXPECT_TRUE(std::get<platform::CursorCaptureEvent>(input(5)).captured);
    EXPECT_EQ(std::get<platform::GamepadEvent>(input(6)).axes[2], -0.3F);
    EXPECT_TRUE(std::get<platform::GamepadEvent>(input(6)).buttons[4]);
    EXPECT_EQ(std::get<ResizeEvent>(events[7]).size, glm::ivec2(800, 600));
    EXPECT_EQ(std::get<ActionEvent>(events[8]).action, Action::AutoExposure);
    for (const std::size_t i : {9U, 10U, 11U, 12U})
        EXPECT_EQ(std::get<SettingEvent>(events[i]), std::get<SettingEvent>(one_of_each()[i])) << i;
    EXPECT_FALSE(std::get<platform::KeyEvent>(std::get<platform::InputEvent>(recording.events_at(7)[0])).down);
}

TEST_F(DemoRecording, OneThatWasCutOffBetweenLinesIsAllThatHappened) {
    const Recording recording = read(std::string(kHead) + "{\"step\":5,\"mouse\":[1,2]}\n");
    EXPECT_EQ(recording.step_count, 6U);
}

TEST_F(DemoRecording, ForeignAndOldFilesAreRefusedByTheirFirstLine) {
    EXPECT_THAT(refusal(""), AllOf(HasSubstr("play.jsonl"), HasSubstr("empty")));
    EXPECT_THAT(refusal("{\"asset\":{}}\n"), HasSubstr("--record"));
    EXPECT_THAT(refusal("[]\n"), HasSubstr("--record"));
    EXPECT_THAT(refusal("{\"rowland_play\":2,\"anything\":true}\n"),
                AllOf(HasSubstr("version 2"), HasSubstr("version 1")));
    EXPECT_THAT(refusal("{\"rowland_play\":1,\"steps_per_second\":60,\"scene\":\"s\",\"window\":[1,1]}\n"),
                HasSubstr("60 steps"));
    EXPECT_THAT(refusal("{\"rowland_play\":1,\"steps_per_second\":120,\"scene\":\"s\",\"window\":[0,1]}\n"),
                HasSubstr("window"));
}

TEST_F(DemoRecording, DamagedLinesAreRefusedByTheirNumber) {
    const auto with = [&](const std::string& line) { return refusal(kHead + line); };
    EXPECT_THAT(with("{\"step\":1,\"key\":\"A\""), HasSubstr("line 2"));
    EXPECT_THAT(with("{\"step\":1,\"key\":\"A\",\"down\":tr\n"), HasSubstr("line 2"));
    EXPECT_THAT(with("{\"step\":1,\"key\":\"Any\",\"down\":true}\n"), AllOf(HasSubstr("line 2"), HasSubstr("Any")));
    EXPECT_THAT(with("{\"step\":1,\"key\":\"A\"}\n"), HasSubstr("down"));
    EXPECT_THAT(with("{\"step\":1}\n"), HasSubstr("no event"));
    EXPECT_THAT(with("{\"step\":-1,\"mouse\":[1,2]}\n"), HasSubstr("step"));
    EXPECT_THAT(with("{\"step\":1,\"mouse\":[1,1e999]}\n"), HasSubstr("line 2"));
    EXPECT_THAT(with("{\"step\":1,\"mouse\":[1,2],\"moose\":1}\n"), HasSubstr("moose"));
    EXPECT_THAT(with("{\"step\":1,\"button\":\"fourth\",\"down\":true}\n"), HasSubstr("fourth"));
    EXPECT_THAT(with("{\"step\":1,\"action\":\"fly\"}\n"), HasSubstr("fly"));
    EXPECT_THAT(with("{\"step\":1,\"set\":\"mood\",\"to\":1}\n"), HasSubstr("mood"));
    EXPECT_THAT(with("{\"step\":1,\"set\":\"exposure\",\"to\":13}\n"), HasSubstr("[-12, 12]"));
    EXPECT_THAT(with("{\"step\":1,\"set\":\"exposure\",\"to\":\"1\"}\n"), HasSubstr("to"));
    EXPECT_THAT(with("{\"step\":1,\"set\":\"probe\",\"to\":1}\n"), HasSubstr("to"));
    EXPECT_THAT(with("{\"step\":1,\"pad\":{\"connected\":true,\"axes\":[0],\"buttons\":[]}}\n"), HasSubstr("axes"));
    EXPECT_THAT(with("{\"step\":5,\"mouse\":[1,2]}\n{\"step\":4,\"mouse\":[1,2]}\n"), HasSubstr("line 3"));
    EXPECT_THAT(with("{\"step\":5,\"end\":true}\n{\"step\":6,\"mouse\":[1,2]}\n"), HasSubstr("after the end"));
}

TEST_F(DemoRecording, AFileThatCannotBeWrittenIsAFailureOfTheSystem) {
    try {
        const Recorder recorder(folder_.path(), {.scene = "s", .window = {1, 1}});
        FAIL() << "a folder was written";
    } catch (const Error& error) {
        EXPECT_EQ(error.info().fault, Fault::System);
    }
}

}  // namespace
}  // namespace rowland::demo
