#include "editor/trade/sweep_plan.h"

#include "editor/trade/sweep.h"
#include "engine/core/file.h"
#include "modules/diffraction/evaluate/error_measure.h"
#include "tests/support/files.h"
#include "tests/unit/editor/trade/trade_run.h"

namespace rowland::trade {
namespace {

std::set<std::string> names(const std::vector<diffraction::Method>& plan) {
    std::set<std::string> result;
    for (const diffraction::Method& setting : plan) result.insert(method_name(setting));
    return result;
}

std::set<int> values(const std::vector<diffraction::Method>& plan, const std::string& representation, const char* key) {
    std::set<int> result;
    for (const diffraction::Method& setting : plan)
        if (info(setting).name == representation && setting.quality.contains(key))
            result.insert(setting.quality[key].get<int>());
    return result;
}

TEST(SweepPlan, HoldsEachSettingOnceAndAboutAHundredAndTwenty) {
    const auto plan = sweep_plan(diffraction::FlatLobe{});
    EXPECT_EQ(names(plan).size(), plan.size());
    EXPECT_GE(plan.size(), 100U);
    EXPECT_LE(plan.size(), 150U);
}

TEST(SweepPlan, StartsWithOneSettingForEachRepresentation) {
    for (const diffraction::GrooveLobe& lobe :
         {diffraction::GrooveLobe(diffraction::FlatLobe{}), diffraction::GrooveLobe(diffraction::GaussianLobe{})}) {
        const auto plan = sweep_plan(lobe);
        const auto first = first_settings(lobe);
        for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(plan[i], diffraction::parse_method(first[i]));
    }
}

TEST(SweepPlan, CoversTheAxes) {
    const auto plan = sweep_plan(diffraction::FlatLobe{});
    const std::set<int> bands = values(plan, "spikes", "bands");
    EXPECT_EQ(*bands.begin(), 2);
    EXPECT_EQ(*bands.rbegin(), 16);
    const std::set<int> spikes = values(plan, "spikes", "spikes");
    EXPECT_EQ(*spikes.begin(), 1);
    EXPECT_EQ(*spikes.rbegin(), 16);
    EXPECT_GE(values(plan, "arc", "rank").size(), 5U);
    EXPECT_GE(values(plan, "planar", "map_resolution").size(), 5U);
    EXPECT_GE(values(plan, "circle", "map_resolution").size(), 5U);
    std::set<int> key_lights;
    std::set<math::SphericalWindow> windows;
    std::set<std::string> storages;
    std::set<std::string> mappings;
    for (const diffraction::Method& setting : plan) {
        key_lights.insert(setting.key_lights);
        windows.insert(setting.window);
        if (setting.quality.contains("storage")) storages.insert(setting.quality["storage"]);
        if (setting.quality.contains("view_mapping")) mappings.insert(setting.quality["view_mapping"]);
    }
    EXPECT_EQ(*key_lights.begin(), 0);
    EXPECT_EQ(*key_lights.rbegin(), 64);
    EXPECT_EQ(windows.size(), 3U);
    EXPECT_EQ(storages.size(), 4U);
    EXPECT_EQ(mappings.size(), 3U);
}

/// What a material file takes for a grating is what the plan may ask for; baking all of it is the sweep's.
TEST(SweepPlan, LeavesOutWhatALobeCannotBeShadedBy) {
    for (const diffraction::Method& setting : sweep_plan(diffraction::GaussianLobe{})) {
        const std::string representation = info(setting).name;
        EXPECT_NE(representation, "circle") << method_name(setting);
        EXPECT_NE(setting.quality.value("view_mapping", ""), "one-dimensional");
    }
    const auto flat = names(sweep_plan(diffraction::FlatLobe{}));
    EXPECT_TRUE(std::none_of(flat.begin(), flat.end(), [](const auto& name) { return name.starts_with("streak"); }));
}

/// The same whichever of the two the material has, and what two references say.
TEST(Sweep, MeasuresWhatItsTheoryIsOff) {
    const test::TemporaryFolder folder;
    test::write_sweep_inputs(folder.path());
    const auto material = [&](const std::string& name, const std::string& profile, const std::string& theory) {
        write_file_atomic(folder.path() / name, R"({"grating": {"pitch_nm": 900, "profile": )" + profile + theory +
                                                    R"(, "orders": [1]}, "metal": "Ag"})");
        return folder.path() / name;
    };
    const std::string sine = R"({"type": "sinusoidal", "depth_nm": 150})";
    SweepInputs inputs;
    inputs.materials = {material("default.json", sine, ""), material("scalar.json", sine, R"(, "theory": "scalar")"),
                        material("slit.json", R"({"type": "slit", "width_nm": 300})", "")};
    inputs.probes = {{folder.path() / "sky.hdr"}};
    inputs.settings = {diffraction::parse_method("direct")};
    inputs.folder = folder.path() / "results";
    std::filesystem::create_directory(inputs.folder);
    Sweep sweep(inputs);
    std::vector<diffraction::Surface> surfaces = tilted_cd_frames().surfaces;
    surfaces.resize(1);
    const FrameSet set{"some", surfaces};
    const auto error = sweep.theory_error(0, 0, set);
    ASSERT_TRUE(error);
    EXPECT_EQ(error, sweep.theory_error(1, 0, set));
    EXPECT_FALSE(sweep.theory_error(2, 0, set));
    const auto& rigorous = sweep.scene(0, 0, set).reference;
    const auto& scalar = sweep.scene(1, 0, set).reference;
    EXPECT_EQ(*error, diffraction::relative_rms(scalar, rigorous));
    EXPECT_GT(*error, 0.02);
}

}  // namespace
}  // namespace rowland::trade
