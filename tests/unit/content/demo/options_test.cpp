#include "content/demo/options.h"

#include <gmock/gmock.h>

#include "engine/core/file.h"
#include "tests/support/expect.h"
#include "tests/support/files.h"

namespace rowland::demo {
namespace {

using testing::HasSubstr;

class DemoOptions : public testing::Test {
 protected:
    std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
    /// The options as they are before work begins.
    static Options checked(const std::vector<std::string>& arguments) {
        std::vector<const char*> argv{"rowland-demo"};
        for (const std::string& argument : arguments) argv.push_back(argument.c_str());
        Options options = parse_options(static_cast<int>(argv.size()), argv.data()).value();
        check_outputs(options);
        return options;
    }
    static std::string refusal(const std::vector<std::string>& arguments) {
        return test::message_of([&] { checked(arguments); });
    }

    test::TemporaryFolder folder_;
};

TEST_F(DemoOptions, ANumberThatIsNotFiniteOrOutOfRangeIsRefused) {
    for (const char* option :
         {"--width", "--height", "--frames", "--exposure", "--bloom", "--vignette", "--f-number", "--focus", "--grain"})
        for (const char* value : {"nan", "-nan", "inf", "-inf", "1e300", "-33", "", "1e"})
            EXPECT_THAT(refusal({option, value}), HasSubstr(option)) << value;
    EXPECT_THAT(refusal({"--width", "0"}), HasSubstr("--width"));
    const Options options = checked({"--width", "8", "--exposure", "-2.5", "--bloom", "1", "--frames", "100000"});
    EXPECT_EQ(options.width, 8);
    EXPECT_EQ(options.exposure_stops, -2.5F);
    EXPECT_EQ(options.bloom, 1.0F);
    EXPECT_EQ(options.frames, 100000);
}

TEST_F(DemoOptions, ARoomIsWiderThanItsCameraIsHigh) {
    EXPECT_EQ(checked({}).dome_radius_m, 10.0);
    EXPECT_EQ(checked({"--dome", "0"}).dome_radius_m, 0.0);
    EXPECT_EQ(checked({"--dome", "3.5"}).dome_radius_m, 3.5);
    for (const char* radius : {"-1", "1.6", "nan", "1e6", "wide"})
        EXPECT_THAT(refusal({"--dome", radius}), HasSubstr("--dome")) << radius;
}

TEST_F(DemoOptions, AViewIsSixNumbersAndATurntableNeedsACapture) {
    EXPECT_EQ(checked({"--camera", "0,0.2,.5,-1,0,1e-1"}).camera, (std::array{0.0F, 0.2F, 0.5F, -1.0F, 0.0F, 0.1F}));
    for (const char* view :
         {"", "1,2,3,4,5", "1,2,3,4,5,6,", "1,2,3,4,5,x", "nan,0,0,0,0,1", "1,2,3,1,2,3", "1 2 3 4 5 6"})
        EXPECT_THAT(refusal({"--camera", view}), HasSubstr("--camera")) << view;
    EXPECT_THAT(refusal({"--turntable", "8"}), HasSubstr("--capture"));
    EXPECT_THAT(refusal({"--turntable", "0", "--capture", path("a.png")}), HasSubstr("--turntable"));
    write_file_atomic(path("a_0003.png"), "");
    EXPECT_EQ(checked({"--turntable", "8", "--capture", path("a.png")}).captured_frames(), 8);
}

TEST_F(DemoOptions, ACaptureIsNamedByItsFormatAndHasAFileOfItsOwn) {
    EXPECT_THAT(refusal({"--capture", path("a.jpg")}), HasSubstr(".png"));
    EXPECT_THAT(refusal({"--capture-linear", path("a.png")}), HasSubstr(".exr"));
    EXPECT_THAT(refusal({"--capture", path("a.png"), "--benchmark", path("./a.png")}), HasSubstr("--capture"));
    EXPECT_NO_THROW(checked({"--capture", path("new/a.PNG"), "--capture-linear", path("new/a.exr")}));
    EXPECT_FALSE(std::filesystem::exists(path("new")));
}

TEST_F(DemoOptions, NoOutputIsAnInput) {
    for (const char* name : {"probe.hdr", "picture_0001.exr", "scene.glb"}) write_file_atomic(path(name), "");
    EXPECT_THAT(refusal({"--probe", path("probe.hdr"), "--benchmark", path("probe.hdr")}), HasSubstr("an input"));
    EXPECT_THAT(refusal({"--scene", path("scene.glb"), "--record", path("./scene.glb")}), HasSubstr("an input"));
    EXPECT_THAT(
        refusal({"--probe", path("picture_0001.exr"), "--capture-linear", path("picture.exr"), "--frames", "3"}),
        HasSubstr("an input"));
    EXPECT_NO_THROW(checked({"--probe", path("picture_0001.exr"), "--capture-linear", path("picture.exr")}));
    const Options shipped = checked({});
    EXPECT_THAT(refusal({"--benchmark", (shipped.content_folder / "probes/night.json").string()}),
                HasSubstr("an input"));
}

TEST_F(DemoOptions, WhatCannotBeWrittenIsRefusedBeforeWork) {
    for (const char* option : {"--benchmark", "--record"})
        for (const std::string& name : {std::string("/dev/full"), std::string("/proc/nowhere/a"), path("")})
            EXPECT_THAT(refusal({option, name}), HasSubstr(option)) << name;
    EXPECT_THAT(refusal({"--capture", "/proc/nowhere/a.png"}), HasSubstr("--capture"));
}

}  // namespace
}  // namespace rowland::demo
