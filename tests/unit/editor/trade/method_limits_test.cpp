// What a representation cannot do is refused alike wherever a method is named: by evaluate, compare, sweep and cook.
#include <fmt/format.h>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/asset/quality.h"
#include "tests/support/files.h"
#include "tests/unit/editor/trade/trade_run.h"

namespace rowland::diffraction {
namespace {

using nlohmann::json;

json material(const json& lobe, double grooves) {
    return {{"grating",
             {{"pitch_nm", 1600},
              {"grooves", grooves},
              {"groove_lobe", lobe},
              {"profile", {{"type", "slit"}, {"width_nm", 800}}}}}};
}

/// Values outside a setting's limits, and of another type.
std::vector<json> values_outside(const SettingInfo& setting) {
    if (!setting.words.empty()) return {"none of them", 3};
    return {setting.minimum - 1, setting.maximum + 1, -1, 2147483647, "many"};
}

std::vector<json> lobes() {
    return {"flat",
            {{"sigma", 0.1}},
            {{"pits", {{"length_nm", 850}, {"coherent", 0.3}}}},
            {{"pits", {{"length_nm", 850}, {"coherent", 0.0}}}},
            {{"pit_sequence", {{"spacings_nm", {900, 1200}}}}}};
}

/// Few grooves go with neither a table nor pits, whatever the method.
bool is_material(const json& file) {
    const json& lobe = file["grating"]["groove_lobe"];
    return !(lobe.contains("pits") || lobe.contains("pit_sequence")) || file["grating"]["grooves"] >= kManyGrooves;
}

/// One folder of inputs, and the programs run in it.
class MethodLimits : public ::testing::Test {
 protected:
    MethodLimits() {
        write_file_atomic(folder_.path() / "frames.csv", "vx,vy,vz,nx,ny,nz,gx,gy,gz\n0.3,0.9,0.2,0,1,0,1,0,0\n");
        write_file_atomic(folder_.path() / "probe.hdr", test::uniform_hdr(4, 2));
    }

    /// Runs every program that takes a method, with a material that pins it for the cooker.
    void expect_refused_everywhere(const json& plain, const std::string& method, const json& pinned) {
        write_file_atomic(folder_.path() / "plain.json", plain.dump());
        write_file_atomic(folder_.path() / "pinned.json", pinned.dump());
        const std::string material = "--material=plain.json";
        const std::string probe = "--probe=probe.hdr";
        expect_refused({ROWLAND_TRADE, "evaluate", material, probe, "--method", method, "--frames", "frames.csv"});
        expect_refused({ROWLAND_TRADE, "compare", material, probe, "--method", method, "--frames", "frames.csv"});
        expect_refused({ROWLAND_TRADE, "sweep", material, probe, "--setting", method, "--output", "out", "--no-times"});
        expect_refused({ROWLAND_COOK, "cook", "pinned.json", "-o", "x.material"});
        EXPECT_FALSE(std::filesystem::exists(folder_.path() / "x.material"));
    }

    void expect_refused(const test::Command& command) {
        const test::Ended ended = test::run(command, {.folder = folder_.path()});
        EXPECT_EQ(ended.code, 2) << fmt::format("{}\n{}{}", fmt::join(command, " "), ended.out, ended.err);
        EXPECT_TRUE(ended.out.empty()) << ended.out;
    }

    test::TemporaryFolder folder_;
};

TEST_F(MethodLimits, SettingsOutOfRangeAreRefusedByEveryProgram) {
    int cases = 0;
    for (const RepresentationInfo* info : representations())
        for (const SettingInfo& setting : info->settings) {
            const json lobe = info->lobes == Lobes::Mirroring ? json{{"sigma", 0.1}} : json("flat");
            for (const json& value : values_outside(setting)) {
                json pinned = material(lobe, 1500);
                pinned["quality"] = {{"representation", info->name}, {setting.key, value}};
                const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
                const std::string method = fmt::format("{}/{}={}", info->name, setting.key, text);
                EXPECT_THROW(parse_method(method), Error) << method;
                EXPECT_THROW(parse_material(pinned, "m.json"), Error) << pinned;
                if (value == values_outside(setting).front())
                    expect_refused_everywhere(material(lobe, 1500), method, pinned);
                ++cases;
            }
        }
    EXPECT_GT(cases, 80);
}

TEST_F(MethodLimits, MethodsThatDoNotSuitAGratingAreRefusedByEveryProgram) {
    int suited = 0;
    int refused = 0;
    for (const RepresentationInfo* info : representations())
        for (const json& lobe : lobes())
            for (const double grooves : {1.0, 10.0, 49.0, 50.0, 1500.0}) {
                const json plain = material(lobe, grooves);
                if (!is_material(plain)) continue;
                const Method method = parse_method(info->name);
                json pinned = plain;
                pinned["quality"] = {{"representation", info->name}};
                const auto why = refusal(method, parse_material(plain, "m.json").grating);
                EXPECT_EQ(std::holds_alternative<Refusal>(
                              suited_quality(pinned["quality"], parse_material(plain, "m.json").grating)),
                          why.has_value());
                const bool lobe_suits = info->lobes == Lobes::Any || (info->lobes == Lobes::Flat) == (lobe == "flat");
                if (grooves < kManyGrooves || !lobe_suits) {
                    EXPECT_TRUE(why.has_value()) << info->name << pinned;
                }
                why ? ++refused : ++suited;
                if (why && (grooves == 10.0 || grooves == 1500.0)) expect_refused_everywhere(plain, info->name, pinned);
            }
    EXPECT_GT(suited, 30);
    EXPECT_GT(refused, 40);
}

TEST_F(MethodLimits, FlagsThatAMethodIgnoresStillHaveALimit) {
    write_file_atomic(folder_.path() / "plain.json", material("flat", 1500).dump());
    for (const char* flag :
         {"--rank=x", "--rank=nan", "--rank=0", "--spikes=inf", "--bands=1e300", "--resolution=-1", "--storage=fp64"})
        for (const char* method : {"arc", "reference"})
            expect_refused({ROWLAND_TRADE, "evaluate", "--material=plain.json", "--probe=probe.hdr", "--method", method,
                            "--frames", "frames.csv", flag});
}

TEST_F(MethodLimits, UnknownAndRepeatedSettingsAreRefusedByEveryProgram) {
    const json plain = material("flat", 1500);
    json pinned = plain;
    pinned["quality"] = {{"representation", "arc"}, {"spikes", 4}};
    for (const char* method : {"arc/spikes=4", "arcs", "arc/bands=5/bands=6", "arc/bands", "arc/key_lights=65",
                               "arc/window=box", "arc/bands=5.5", "arc/bands=nan", ""})
        expect_refused_everywhere(plain, method, pinned);
}

}  // namespace
}  // namespace rowland::diffraction
