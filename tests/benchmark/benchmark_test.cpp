// The benchmark programs as a user runs them: they draw what they name and print what they measure. No time is judged.
#include <gmock/gmock.h>

#include <cctype>
#include <cmath>
#include <glm/vec2.hpp>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <stdexcept>

#include "engine/core/file.h"
#include "tests/support/files.h"
#include "tests/support/program.h"

namespace rowland {
namespace {

using nlohmann::json;

test::Ended run(test::Command arguments, const char* program = ROWLAND_BENCHMARK) {
    arguments.insert(arguments.begin(), program);
    return test::run(arguments, {.limit = std::chrono::minutes(15)});
}

std::vector<std::string> lines(const std::string& text) {
    std::vector<std::string> result;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) result.push_back(line);
    return result;
}

std::vector<std::string> names_of(const json& frames) {
    std::vector<std::string> names;
    for (const json& frame : frames) names.push_back(frame.at("name"));
    return names;
}

/// Draws frames of 64 × 36 pixels unless told otherwise; their results, and what was printed.
struct FrameRun {
    explicit FrameRun(test::Command arguments, const glm::ivec2& size = {64, 36}) {
        const test::TemporaryFolder folder;
        const std::filesystem::path path = folder.path() / "frames.json";
        arguments.insert(arguments.end(), {"--width", std::to_string(size.x), "--height", std::to_string(size.y),
                                           "--rounds", "1", "--json", path.string()});
        const test::Ended ended = run(arguments);
        EXPECT_EQ(ended.code, 0) << ended.err;
        output = ended.out;
        report = json::parse(read_text_file(path, 1 << 20));
    }
    const json& frame(const std::string& name) const {
        for (const json& one : report.at("frames"))
            if (one.at("name") == name) return one;
        throw std::runtime_error("no frame " + name);
    }
    double radiance(const std::string& name) const { return frame(name).at("mean_radiance"); }

    json report;
    std::string output;
};

void expect_positive(const json& number, const std::string& what) {
    ASSERT_TRUE(number.is_number()) << what;
    EXPECT_TRUE(std::isfinite(number.get<double>())) << what;
    EXPECT_GT(number.get<double>(), 0.0) << what;
}

TEST(FrameBenchmark, DrawsAndPrintsEveryVariant) {
    const FrameRun frames({});
    const std::vector<std::string> listed = lines(run({"--list"}).out);
    EXPECT_EQ(names_of(frames.report.at("frames")), listed);
    EXPECT_EQ(std::set<std::string>(listed.begin(), listed.end()).size(), listed.size());
    for (const json& frame : frames.report.at("frames")) {
        const std::string name = frame.at("name");
        EXPECT_THAT(frames.output, testing::HasSubstr("\n" + name + " "));
        for (const char* number : {"minimum_ms", "median_ms", "ratio", "work_ms", "work_ratio", "mean_radiance"})
            expect_positive(frame.at(number), name + ": " + number);
        EXPECT_LE(frame.at("minimum_ms"), frame.at("median_ms")) << name;
        const double baseline = frames.frame(frame.at("baseline")).at("minimum_ms");
        EXPECT_NEAR(frame.at("ratio"), frame.at("minimum_ms").get<double>() / baseline, 1e-9) << name;
    }
    const std::string renderer = frames.report.at("gl_renderer");
    EXPECT_FALSE(renderer.empty());
    EXPECT_THAT(frames.output, testing::HasSubstr(renderer));
    EXPECT_THAT(frames.output, testing::HasSubstr(frames.report.at("processor").get<std::string>()));

    // Half of the picture, as the product's figures say. Its edge pixels: one of 36 rows.
    EXPECT_NEAR(frames.report.at("coverage"), 0.5, 1.0 / 36.0);
    // The same light shaded in two ways: equal but for the kernel's smoothing over a pixel and for edge pixels
    // (measured: 1e-4 at 640 × 360, where pixels are a tenth as wide).
    for (const char* lights : {"1", "4", "16", "64"})
        EXPECT_NEAR(frames.radiance(std::string("light-loop/lights:") + lights) /
                        frames.radiance(std::string("direct/lights:") + lights),
                    1.0, 0.02)
            << lights;
    // The same SH light by tables that lose wavelengths or ranks alone: 4 spikes lose 10 %, ranks 2 %.
    EXPECT_NEAR(frames.radiance("spikes") / frames.radiance("arc"), 1.0, 0.12);
    // The whole light by two maps, and all of it with key lights taken out.
    for (const char* name : {"circle", "planar/key-lights:16", "circle/key-lights:16"})
        EXPECT_NEAR(frames.radiance(name) / frames.radiance("planar"), 1.0, 0.05) << name;
    EXPECT_GT(frames.radiance("planar"), 2.0 * frames.radiance("plain"));
    EXPECT_LT(frames.radiance("direct"), 0.8 * frames.radiance("planar"));
}

TEST(FrameBenchmark, DrawsTheChosenAndTheirBaselinesAlone) {
    const FrameRun arc({"--only", "arc"});
    EXPECT_THAT(names_of(arc.report.at("frames")), testing::ElementsAre("plain", "arc"));
    EXPECT_THAT(arc.output, testing::Not(testing::HasSubstr("planar")));
    const FrameRun two({"--only", "un*,plain/shadow"});
    EXPECT_THAT(names_of(two.report.at("frames")), testing::ElementsAre("plain", "unlit", "plain/shadow"));
    // Not the same numbers: these are measured, to a nanosecond.
    EXPECT_NE(arc.frame("plain").at("minimum_ms"), two.frame("plain").at("minimum_ms"));
}

TEST(FrameBenchmark, AFrameOfFourHundredTimesThePixelsTakesLonger) {
    const FrameRun small({"--only", "plain"});
    const FrameRun large({"--only", "plain"}, {1280, 720});
    EXPECT_GT(large.frame("plain").at("minimum_ms"), small.frame("plain").at("minimum_ms"));
}

TEST(FrameBenchmark, ResultFilesBearTheRenderersName) {
    const test::TemporaryFolder folder;
    const FrameRun frames({"--only", "unlit", "--output-folder", folder.path().string()});
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
        files.push_back(entry.path().filename().string());
    std::string first_word = frames.report.at("gl_renderer");
    first_word = first_word.substr(0, first_word.find(' '));
    for (char& c : first_word) c = static_cast<char>(std::tolower(c));
    EXPECT_THAT(files, testing::UnorderedElementsAre(testing::StartsWith("frames-" + first_word),
                                                     testing::StartsWith("frames-" + first_word)));
}

TEST(FrameBenchmark, WritesTheProgramOfEachDiscAndHowOftenItsLoopsRun) {
    const test::TemporaryFolder folder;
    ASSERT_EQ(run({"--width", "64", "--height", "36", "--only", "plain,planar,direct/lights:4", "--programs",
                   folder.path().string()})
                  .code,
              0);
    const json programs = json::parse(read_text_file(folder.path() / "programs.json", 1 << 20));
    std::map<std::string, std::string> fragments;
    for (const json& frame : programs.at("frames")) {
        const std::string name = frame.at("name");
        fragments[name] = read_text_file(folder.path() / (frame.at("program").get<std::string>() + ".frag"), 1 << 20);
        EXPECT_EQ(frame.at("lengths").at("light_counts.x"), name == "direct/lights:4" ? 4 : 1) << name;
    }
    EXPECT_EQ(fragments.size(), 4U);  // those named, and the baseline direct/lights:1
    EXPECT_THAT(fragments.at("plain"), testing::Not(testing::HasSubstr("planar_map")));
    EXPECT_THAT(fragments.at("planar"), testing::HasSubstr("planar_map"));
}

TEST(FrameBenchmark, RefusesANameThatIsNoneAndWhereNothingCanBeWritten) {
    EXPECT_EQ(run({"--only", "arcs"}).code, 2);
    EXPECT_EQ(run({"--rounds", "0"}).code, 2);
    for (const char* output : {"--json", "--programs", "--output-folder"})
        EXPECT_EQ(run({"--only", "unlit", output, "/dev/null/x"}).code, 2) << output;
}

TEST(Microbenchmark, TimesEveryPart) {
    const test::Ended ended = run({}, ROWLAND_MICROBENCHMARK);
    ASSERT_EQ(ended.code, 0) << ended.err;
    const json results = json::parse(ended.out);
    EXPECT_FALSE(results.at("processor").get<std::string>().empty());
    for (const auto& [map, time] : results.at("map_fill_ms").items()) expect_positive(time, map);
    const json& table = results.at("view_table");
    const auto error = [&](const char* bake) {
        expect_positive(table.at(bake).at("seconds"), bake);
        return table.at(bake).at("error").get<double>();
    };
    // Measured: 8e-5, by what is linear between whole nanometres; 4 % and .35 % by the samples' noise.
    EXPECT_LT(error("closed_form"), 2e-4);
    EXPECT_LT(error("15000_samples"), 0.1);
    EXPECT_LT(error("240000_samples"), 0.25 * error("15000_samples"));
    EXPECT_GT(error("240000_samples"), 10.0 * error("closed_form"));
    EXPECT_GT(table.at("slower_at_equal_error"), 1000.0);
}

}  // namespace
}  // namespace rowland
