// The programs that draw, when the GPU, the display or the disk for their pictures fails.
#include <gmock/gmock.h>

#include <algorithm>

#include "engine/core/file.h"
#include "tests/faults/small_disk.h"
#include "tests/support/virtual_display.h"

namespace rowland {
namespace {

using test::Command;
using test::Ended;
using test::Surroundings;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// The last of them; the programs say before what they do, and OpenGL's libraries what they miss.
std::string last_line(const std::string& text) {
    const std::string trimmed = text.substr(0, text.find_last_not_of('\n') + 1);
    return trimmed.substr(trimmed.rfind('\n') + 1);
}

class PictureFaults : public testing::Test {
 protected:
    std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

    /// A picture of the demo, and of the inspector's preview, at `picture`; of a material and light that load quickly.
    std::vector<Command> captures(const std::string& picture) const {
        return {{ROWLAND_DEMO, "--headless", "--disc", "--width", "64", "--height", "36", "--capture", picture},
                {ROWLAND_INSPECTOR, material(), "--probe", probe(), "--preview-only", "--size", "320x320", "--capture",
                 picture}};
    }
    std::string material() const {
        write_file_atomic(path("small.json"), std::string_view(R"({
            "grating": {"pitch_nm": 1600, "profile": {"type": "slit", "width_nm": 800}},
            "quality": {"representation": "spikes", "bands": 2, "view_resolution": 4}})"));
        return path("small.json");
    }
    /// All that draws without a window: the captures, and times of frames.
    std::vector<Command> drawers() const {
        std::vector<Command> commands = captures(path("picture.png"));
        commands.push_back({ROWLAND_DEMO, "--disc", "--width", "64", "--height", "36", "--frames", "2", "--benchmark",
                            path("times.json")});
        commands.push_back({ROWLAND_TRADE, "sweep", "--material", test::content_path("materials/cd.json"), "--probe",
                            probe(), "--setting", "arc/bands=3/rank=4", "--frame-size", "32", "18", "--picture-size",
                            "8", "8", "--output", path("results")});
        return commands;
    }
    /// A probe of 2 × 1 texels.
    std::string probe() const {
        write_file_atomic(path("small.hdr"), std::string_view("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n"
                                                              "\x80\x80\x80\x80\x40\x40\x40\x80"));
        return path("small.hdr");
    }
    /// The programs in windows; each closes by itself, or never.
    static std::vector<Command> windows() {
        return {{ROWLAND_DEMO, "--disc", "--width", "64", "--height", "36"}, {ROWLAND_INSPECTOR, "--preset", "cd"}};
    }

    test::TemporaryFolder folder_;
};

/// One line of what is wrong, and a failure that is not the input's (1), or is (2).
void expect_one_clear_line(const Ended& ended, const testing::Matcher<std::string>& line, int code = 1) {
    EXPECT_FALSE(ended.too_long) << "it hangs";
    EXPECT_EQ(ended.code, code) << ended.err;
    EXPECT_THAT(last_line(ended.err), AllOf(testing::StartsWith("error: "), line));
}

TEST_F(PictureFaults, LostContextEndsWithOneClearLineAndNoPicture) {
    for (const Command& command : drawers()) {
        SCOPED_TRACE(testing::PrintToString(command));
        // At once; before the last picture is read; and, as the control, after all is done.
        for (const char* frames : {"0", "1"}) {
            const Ended ended = test::run(
                command, {.environment = {{"ROWLAND_TEST_LOST_AFTER", frames}}, .preload = ROWLAND_LOST_CONTEXT});
            expect_one_clear_line(ended, AllOf(HasSubstr("the GPU was reset"), HasSubstr("its context is lost"),
                                               HasSubstr("start the program again")));
            for (const char* result : {"picture.png", "times.json", "results/sweep.csv"})
                EXPECT_FALSE(std::filesystem::exists(path(result)));
        }
        const Ended never = test::run(
            command, {.environment = {{"ROWLAND_TEST_LOST_AFTER", "1000000"}}, .preload = ROWLAND_LOST_CONTEXT});
        EXPECT_EQ(never.code, 0) << never.err;
        for (const char* result : {"picture.png", "times.json"}) std::filesystem::remove(path(result));
    }
}

TEST_F(PictureFaults, ContextLostInAWindowClosesItWithOneClearLine) {
    ROWLAND_NEEDS_VIRTUAL_DISPLAY();
    const test::VirtualDisplay display(400, 400);
    for (const Command& command : windows()) {
        const Ended ended =
            test::run(command, {.environment = {{"DISPLAY", display.name()}, {"ROWLAND_TEST_LOST_AFTER", "3"}},
                                .preload = ROWLAND_LOST_CONTEXT});
        expect_one_clear_line(ended, HasSubstr("its context is lost"));
    }
}

TEST_F(PictureFaults, TooOldOpenGlIsRefusedWithWhatIsNeeded) {
    const auto needed = AllOf(HasSubstr("OpenGL 4.5 core"), HasSubstr("expected a driver with"), HasSubstr("install"));
    for (const char* version : {"3.3", "4.4"}) {
        for (const Command& command : drawers())
            expect_one_clear_line(test::run(command, {.environment = {{"MESA_GL_VERSION_OVERRIDE", version}}}), needed);
        if (!test::has_virtual_display()) continue;
        const test::VirtualDisplay display(400, 400);
        for (const Command& command : windows())
            expect_one_clear_line(test::run(command, {.environment = {{"DISPLAY", display.name()},
                                                                      {"MESA_GL_VERSION_OVERRIDE", version}}}),
                                  needed);
    }
}

TEST_F(PictureFaults, MissingDriverIsRefusedWithWhatIsNeeded) {
    for (const Command& command : drawers())
        expect_one_clear_line(test::run(command, {.environment = {{"LIBGL_DRIVERS_PATH", "/nonexistent"},
                                                                  {"__EGL_VENDOR_LIBRARY_DIRS", "/nonexistent"}}}),
                              AllOf(HasSubstr("OpenGL 4.5 core"), HasSubstr("install")));
}

/// A display that is not there, and one that does not answer: no server has so high a number.
TEST_F(PictureFaults, WithoutADisplayTheDemoWritesPicturesAndTheInspectorSaysHow) {
    for (const auto& display : {std::optional<std::string>(), std::optional<std::string>(":4095")}) {
        const Surroundings surroundings{.environment = {{"DISPLAY", display}, {"WAYLAND_DISPLAY", std::nullopt}}};
        const Ended demo = test::run({ROWLAND_DEMO, "--disc", "--width", "64", "--height", "36", "--frames", "1",
                                      "--output-folder", path("flight")},
                                     surroundings);
        EXPECT_EQ(demo.code, 0) << demo.err;
        EXPECT_TRUE(!std::filesystem::is_empty(path("flight")));
        std::filesystem::remove_all(path("flight"));

        const Ended inspector = test::run({ROWLAND_INSPECTOR}, surroundings);
        expect_one_clear_line(inspector, AllOf(HasSubstr("no display"), HasSubstr("--capture")));

        const Ended record = test::run({ROWLAND_DEMO, "--disc", "--record", path("play.json")}, surroundings);
        EXPECT_EQ(record.code, 2) << record.err;
        EXPECT_THAT(record.err, HasSubstr("no window to play in"));
        EXPECT_FALSE(std::filesystem::exists(path("play.json")));
    }
}

TEST_F(PictureFaults, MissingOrTooNewOcioConfigIsRefusedByNameAndVersion) {
    write_file_atomic(path("new.ocio"), std::string_view("ocio_profile_version: 2.99\n"));
    for (const Command& command : captures(path("picture.png"))) {
        const auto refusal = [&](const std::string& config, bool as_option) {
            Command with_option = command;
            if (as_option) with_option.insert(with_option.end(), {"--ocio", config});
            const Ended ended =
                test::run(with_option, {.environment = {{"OCIO", as_option ? std::optional<std::string>() : config}}});
            EXPECT_EQ(ended.code, 2) << ended.err;
            EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
            EXPECT_FALSE(std::filesystem::exists(path("picture.png")));
            return ended.err;
        };
        for (const bool as_option : {true, false}) {
            EXPECT_THAT(refusal(path("none.ocio"), as_option),
                        AllOf(HasSubstr("none.ocio"), HasSubstr("no such file"), HasSubstr("name another")));
            EXPECT_THAT(refusal(path("new.ocio"), as_option),
                        AllOf(HasSubstr("new.ocio"), HasSubstr("version 2.99"), HasSubstr("expected at most version")));
        }
    }
}

TEST_F(PictureFaults, OnAFullDiskNoHalfPictureIsWritten) {
    const test::SmallDisk disk(64);
    ROWLAND_NEEDS_MOUNTED(disk);
    disk.fill_but(0);
    const std::string folder = disk.path().string();
    std::vector<Command> commands = captures(folder + "/picture.png");
    commands.push_back({ROWLAND_DEMO, "--headless", "--disc", "--width", "64", "--height", "36", "--capture-linear",
                        folder + "/picture.exr"});
    commands.push_back({ROWLAND_DEMO, "--headless", "--disc", "--width", "64", "--height", "36", "--frames", "1",
                        "--output-folder", folder});
    for (const Command& command : commands) {
        expect_one_clear_line(test::run(command), AllOf(HasSubstr(folder), HasSubstr("No space left on device")));
        EXPECT_EQ(std::distance(std::filesystem::directory_iterator(disk.path()), {}), 1) << "only what fills it";
    }
}

TEST_F(PictureFaults, IntoAReadOnlyFolderNoPictureIsWrittenAndTheMessageSaysWhy) {
    std::filesystem::create_directory(path("out"));
    std::filesystem::permissions(path("out"), std::filesystem::perms(0555));
    for (const Command& command : captures(path("out/picture.png")))
        expect_one_clear_line(test::run(command, {.obey_modes = true}),
                              AllOf(HasSubstr("out/picture.png"), HasSubstr("Permission denied")), 2);
    EXPECT_TRUE(std::filesystem::is_empty(path("out")));
}

}  // namespace
}  // namespace rowland
