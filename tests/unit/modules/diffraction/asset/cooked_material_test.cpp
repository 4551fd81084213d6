#include "modules/diffraction/asset/cooked_material.h"

#include <gmock/gmock.h>

#include "engine/core/file.h"
#include "modules/diffraction/cook.h"
#include "tests/support/expect.h"
#include "tests/support/files.h"
#include "tests/support/threads.h"

namespace rowland::diffraction {
namespace {

nlohmann::json small_material() {
    return nlohmann::json::parse(R"({
        "grating": { "pitch_nm": 1600, "profile": { "type": "slit", "width_nm": 800 } },
        "quality": { "representation": "spikes", "bands": 3, "spikes": 2, "view_resolution": 4 } })");
}

std::vector<std::byte> cook(const nlohmann::json& json) {
    return write_cooked_material(json, cook_material(json, "m.json"));
}

nlohmann::json material_with(const char* quality) {
    nlohmann::json json = small_material();
    json["grating"]["orders"] = {0, 1};
    json["quality"] = nlohmann::json::parse(quality);
    if (json["quality"]["representation"] == "streak")
        json["grating"]["groove_lobe"] = {{"pits", {{"length_nm", 850}, {"coherent", 0.3}}}};
    return json;
}

constexpr const char* kQualities[] = {
    R"({"representation": "spikes", "bands": 2, "spikes": 3, "view_resolution": 4})",
    R"({"representation": "arc", "bands": 2, "rank": 3, "view_resolution": 8})",
    R"({"representation": "direct"})",
    R"({"representation": "planar", "bands": 2, "rank": 3, "map_resolution": 16})",
    R"({"representation": "circle", "map_resolution": 16})",
    R"({"representation": "streak", "map_resolution": 64, "bands": 2, "rank": 3, "view_resolution": 6})",
};

TEST(CookedMaterial, EveryRepresentationIsReadAsItWasWritten) {
    for (const char* quality : kQualities) {
        const nlohmann::json json = material_with(quality);
        const CookedMaterial original = cook_material(json, "m.json");
        const std::vector<std::byte> bytes = write_cooked_material(json, original);
        const CookedMaterial read = read_cooked_material(bytes, "m.material");
        EXPECT_EQ(read.tables.index(), representation(original.material).index()) << quality;
        EXPECT_EQ(write_cooked_material(json, read), bytes) << quality;
        EXPECT_EQ(describe(read), describe(original)) << quality;
        EXPECT_GT(original.zero_order_xyz[0].x, 0.0);
        for (const std::size_t missing : {std::size_t{1}, bytes.size() / 50, bytes.size() / 3})
            EXPECT_THROW(read_cooked_material(std::span(bytes).first(bytes.size() - missing), "m.material"), Error)
                << quality;
    }
}

TEST(CookedMaterial, CheaperRungsAreReadAsTheyWereWritten) {
    const nlohmann::json json =
        material_with(R"({"representation": "planar", "bands": 2, "rank": 3, "map_resolution": 16})");
    CookedMaterial original = cook_material(json, "m.json");
    const auto arc = std::make_shared<const CookedMaterial>(cook_material(
        material_with(R"({"representation": "arc", "bands": 2, "rank": 3, "view_resolution": 8})"), "m.json"));
    const auto add = [&](nlohmann::json settings, const std::shared_ptr<const CookedMaterial>& baked, double price) {
        const Quality quality = std::get<Quality>(suited_quality(settings, original.material.grating));
        BudgetRecord record{.price = price, .probes = {}};
        record.probes.push_back({.probe = "a", .key_lights = 2, .error = 1.0 / price});
        original.cheaper.push_back({std::move(settings), quality, baked, std::move(record)});
    };
    for (const int keys : {0, 4})
        add({{"representation", "arc"}, {"bands", 2}, {"rank", 3}, {"view_resolution", 8}, {"key_lights", keys}}, arc,
            2.0 + keys);
    add({{"representation", "planar"}, {"bands", 2}, {"rank", 3}, {"map_resolution", 16}, {"key_lights", 8}}, nullptr,
        9.0);
    const std::vector<std::byte> bytes = write_cooked_material(json, original);
    const CookedMaterial read = read_cooked_material(bytes, "m.material");
    EXPECT_EQ(write_cooked_material(json, read), bytes);
    ASSERT_EQ(read.cheaper.size(), 3U);
    EXPECT_EQ(read.cheaper[0].baked, read.cheaper[1].baked) << "tables are stored once";
    EXPECT_EQ(read.cheaper[2].baked, nullptr);
    const CookedMaterial rung = as_rung(read, read.cheaper[1]);
    EXPECT_EQ(rung.material.quality.key_lights, 4);
    EXPECT_EQ(rung.measured->price, 6.0);
    EXPECT_EQ(std::get<ArcTable>(rung.tables).rank, 3);
    EXPECT_EQ(as_rung(read, read.cheaper[2]).tables.index(), original.tables.index());
    for (std::size_t missing = 1; missing < bytes.size() / 3; missing += 97)
        EXPECT_THROW(read_cooked_material(std::span(bytes).first(bytes.size() - missing), "m.material"), Error);
    original.cheaper[2].baked = arc;  // which are not those of its representation
    EXPECT_THROW(read_cooked_material(write_cooked_material(json, original), "m.material"), Error);
}

/// Solved efficiencies are kept, and the kernel of all views follows from them.
TEST(CookedMaterial, EfficienciesOfRigorousTheoryAreReadAsTheyWereWritten) {
    nlohmann::json json = small_material();
    json["metal"] = "Al";
    json["grating"] = {{"pitch_nm", 500},
                       {"profile", {{"type", "sinusoidal"}, {"depth_nm", 100}}},
                       {"theory", "rigorous"},
                       {"orders", {-1, 1}}};
    const CookedMaterial original = cook_material(json, "m.json");
    const std::vector<std::byte> bytes = write_cooked_material(json, original);
    const CookedMaterial read = read_cooked_material(bytes, "m.material");
    EXPECT_EQ(read.material.grating.efficiencies->orders, (std::vector<int>{-2, -1, 0, 1, 2}));
    EXPECT_EQ(read.material.grating.efficiencies->values, original.material.grating.efficiencies->values);
    EXPECT_EQ(read.kernel.views, EfficiencyGrid::kViews);
    EXPECT_EQ(read.kernel.antiderivative, original.kernel.antiderivative);
    EXPECT_NE(read.kernel.average(500, 520, 0.6)[1][1], read.kernel.average(500, 520, 0.0)[1][1]);
    EXPECT_EQ(write_cooked_material(json, read), bytes);

    std::vector<std::byte> damaged = bytes;
    const auto* const sought =
        reinterpret_cast<const std::byte*>(original.material.grating.efficiencies->values.data());
    const auto at = std::search(damaged.begin(), damaged.end(), sought, sought + 64);
    ASSERT_NE(at, damaged.end());
    const float too_large = 1.5F;
    std::memcpy(&*at, &too_large, sizeof too_large);
    EXPECT_THAT(rowland::test::message_of([&] { read_cooked_material(damaged, "m.material"); }),
                ::testing::HasSubstr("an efficiency of 1.5"));
}

/// A fluorescent lamp's mercury line at 546 nm, order 1: the kernel has a peak there that daylight's has not.
TEST(CookedMaterial, IsBakedForTheIlluminantOfItsQuality) {
    const auto baked = [](const char* illuminant) {
        const nlohmann::json json = {
            {"grating", {{"pitch_nm", 1600}, {"profile", {{"type", "slit"}, {"width_nm", 800}}}}},
            {"quality", {{"representation", "arc"}, {"illuminant", illuminant}}}};
        return cook_material(json, "test");
    };
    const auto peak = [](const CookedMaterial& cooked) {
        const auto luminance = [&](double from, double to) { return cooked.kernel.average(from, to)[1][1]; };
        return luminance(541.0, 551.0) / luminance(556.0, 566.0);
    };
    const CookedMaterial fluorescent = baked("F11");
    EXPECT_GT(peak(fluorescent), 3.0 * peak(baked("D65")));
    EXPECT_NE(std::get<ArcTable>(fluorescent.tables).texels, std::get<ArcTable>(baked("D65").tables).texels);
    EXPECT_THAT(describe(fluorescent), testing::HasSubstr("illuminant: F11"));
}

TEST(CookedMaterial, TablesOfAnotherRepresentationThanTheMaterialsAreRefused) {
    const CookedMaterial arc = cook_material(material_with(kQualities[1]), "m.json");
    const std::vector<std::byte> bytes = write_cooked_material(material_with(kQualities[0]), arc);
    EXPECT_THAT(rowland::test::message_of([&] { read_cooked_material(bytes, "m.material"); }),
                ::testing::HasSubstr("spikes"));
}

/// Shaders are made for what the material's JSON says; its limits also hold for tables.
TEST(CookedMaterial, TablesOfOtherSettingsThanTheMaterialsAreRefused) {
    for (const char* quality : kQualities) {
        const nlohmann::json json = material_with(quality);
        nlohmann::json other = json;
        const CookedMaterial cooked = cook_material(json, "m.json");
        for (const char* key : {"bands", "spikes", "rank", "view_resolution", "storage"}) {
            if (!json["quality"].contains(key)) continue;
            other = json;
            other["quality"][key] = std::string(key) == "storage" ? nlohmann::json("fp16") : nlohmann::json(2);
            if (other == json) other["quality"][key] = 3;
            EXPECT_THROW(read_cooked_material(write_cooked_material(other, cooked), "m.material"), Error)
                << quality << key;
        }
    }
}

TEST(CookedMaterial, AStreakOfTooManySegmentsOrNoRestIsRefused) {
    const nlohmann::json json = material_with(kQualities[5]);
    const CookedMaterial cooked = cook_material(json, "m.json");
    CookedMaterial crowded = cooked;
    auto& segments = std::get<StreakTables>(crowded.tables).streak.segments;
    segments.resize(kMostStreakSegments, segments[0]);
    EXPECT_NO_THROW(read_cooked_material(write_cooked_material(json, crowded), "m.material"));
    segments.push_back(segments[0]);
    EXPECT_THROW(read_cooked_material(write_cooked_material(json, crowded), "m.material"), Error);
    CookedMaterial bare = cooked;
    std::get<StreakTables>(bare.tables).incoherent.reset();
    EXPECT_THROW(read_cooked_material(write_cooked_material(json, bare), "m.material"), Error);
    CookedMaterial broken = cooked;
    std::get<StreakTables>(broken.tables).streak.segments[0].weights[0][1][1] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THROW(read_cooked_material(write_cooked_material(json, broken), "m.material"), Error);
}

/// A look-up between two levels counts as two fetches; the view that sees most nodes pays for them.
TEST(CookedMaterial, TheDescriptionCountsAStreaksFetches) {
    nlohmann::json json = material_with(R"({"representation": "streak", "map_resolution": 128})");
    json["grating"]["orders"] = {-1, 1};
    json["grating"]["groove_lobe"] = {{"sigma", 0.05}};
    const std::string text = describe(cook_material(json, "m"));
    EXPECT_THAT(text, ::testing::HasSubstr("streak: 14 nodes, map 256 x 128 x 16\n"));
    // d = 1600 nm: a view straight from above sees both orders whole.
    EXPECT_THAT(text, ::testing::HasSubstr("fetches_per_pixel: " + std::to_string(14 * 2) + "\n"));
}

TEST(CookedMaterial, KernelsOfNoIntervalAreRefused) {
    const nlohmann::json json = material_with(R"({"representation": "direct"})");
    CookedMaterial cooked = cook_material(json, "m.json");
    const double reach = cooked.kernel.end_nm;
    for (const double end : {-1e6, 1e308, std::numeric_limits<double>::quiet_NaN()}) {
        cooked.kernel.end_nm = end;
        EXPECT_THROW(read_cooked_material(write_cooked_material(json, cooked), "m.material"), Error) << end;
    }
    cooked.kernel.end_nm = reach;
    EXPECT_NO_THROW(read_cooked_material(write_cooked_material(json, cooked), "m.material"));
}

TEST(CookedMaterial, TheDescriptionCountsWhatShadingCosts) {
    const std::string text = describe(cook_material(material_with(kQualities[1]), "m"));
    EXPECT_THAT(text, ::testing::HasSubstr("representation: arc\n"));
    EXPECT_THAT(text, ::testing::HasSubstr("rank: 3\n"));
    EXPECT_THAT(text, ::testing::HasSubstr("fetches_per_pixel: 1\n"));
    EXPECT_THAT(text, ::testing::HasSubstr("key_lights: all\n"));
    // 8 nodes of four halves, scale and bias of a layer, 3 · 3 matrices.
    EXPECT_THAT(text, ::testing::HasSubstr("table_bytes: " + std::to_string(8 * 8 + 2 * 16 + 9 * 36) + "\n"));
}

TEST(CookedMaterial, BytesDoNotDependOnTheNumberOfThreads) {
    rowland::test::expect_same_on_any_threads([] { return cook(small_material()); });
}

TEST(CookedMaterial, EveryTruncationAndTrailingBytesAreRefused) {
    std::vector<std::byte> bytes = cook(small_material());
    for (std::size_t size = 0; size < bytes.size(); size += size < 400 ? 1 : 97)
        EXPECT_THROW(read_cooked_material(std::span(bytes).first(size), "m.material"), Error) << size;
    bytes.push_back(std::byte{0});
    EXPECT_THROW(read_cooked_material(bytes, "m.material"), Error);
}

TEST(CookedMaterial, FewGroovesAreRefusedByFileAndPlace) {
    nlohmann::json json = small_material();
    json["grating"]["grooves"] = 7;
    EXPECT_THAT(rowland::test::message_of([&] { cook_material(json, "few.json"); }),
                ::testing::HasSubstr("few.json: /grating/grooves"));
}

/// A material in a folder of its own, with the two files that it can name.
class MaterialOfFiles : public ::testing::Test {
 protected:
    MaterialOfFiles() {
        nlohmann::json json = small_material();
        json["grating"]["profile"] = {{"type", "table"}, {"file", "t.csv"}};
        json["quality"]["illuminant"] = "sodium.csv";
        write_file_atomic(source(), json.dump());
        write_file_atomic(folder_.path() / "t.csv", "wavelength_nm,R-1,R+1\n400,0.1,0.4\n700,0.2,0.3\n");
        write_file_atomic(folder_.path() / "sodium.csv", "wavelength_nm,relative_power\n588,0\n589.3,1\n591,0\n");
        register_module(registry_);
        dependencies_ = {source(), folder_.path() / "t.csv", folder_.path() / "sodium.csv"};
    }

    std::filesystem::path source() const { return folder_.path() / "m.json"; }
    const cook::AssetType& type() const { return *registry_.find(kMaterialAssetType); }

    rowland::test::TemporaryFolder folder_;
    cook::Registry registry_;
    std::vector<std::filesystem::path> dependencies_;
};

TEST_F(MaterialOfFiles, CookedNeedsThemNoMore) {
    cook::Context context(source());
    const std::vector<std::byte> payload = type().cook(context);
    for (const char* name : {"t.csv", "sodium.csv"}) std::filesystem::remove(folder_.path() / name);
    const CookedMaterial cooked = read_cooked_material(payload, "m.material");
    EXPECT_DOUBLE_EQ(profile_efficiency(cooked.material.grating.profile, 1600.0, 1, 550.0), 0.35);
    EXPECT_DOUBLE_EQ(profile_efficiency(cooked.material.grating.profile, 1600.0, -1, 550.0), 0.15);
    const colour::Illuminant& lamp = cooked.material.quality.illuminant;
    EXPECT_EQ(lamp.name, "sodium.csv");
    EXPECT_THAT(lamp.power.wavelengths_nm(), ::testing::ElementsAre(588.0, 589.3, 591.0));
    EXPECT_THAT(lamp.power.values(), ::testing::ElementsAre(0.0, 1.0, 0.0));
    EXPECT_THAT(describe(cooked), ::testing::HasSubstr("illuminant: sodium.csv\n"));
}

TEST_F(MaterialOfFiles, CookingAndCheckingDependOnThem) {
    cook::Context cooked(source());
    type().cook(cooked);
    EXPECT_THAT(cooked.dependencies(), ::testing::UnorderedElementsAreArray(dependencies_));
    cook::Context checked(source());
    type().check(checked);
    EXPECT_THAT(checked.dependencies(), ::testing::UnorderedElementsAreArray(dependencies_));
}

TEST_F(MaterialOfFiles, ARefusedOneIsNamedAndAMissingOneIsStillADependency) {
    write_file_atomic(folder_.path() / "sodium.csv", "wavelength_nm,relative_power\n900,1\n901,1\n");
    cook::Context context(source());
    EXPECT_THAT(rowland::test::message_of([&] { type().cook(context); }), ::testing::HasSubstr("sodium.csv"));
    std::filesystem::remove(folder_.path() / "t.csv");
    cook::Context without(source());
    EXPECT_THROW(type().cook(without), Error);
    EXPECT_THAT(without.dependencies(), ::testing::Contains(folder_.path() / "t.csv"));
}

/// The promise about cooked files (content/README.md): version_10.material was written when version 10 was new.
constexpr const char* kSource = R"({
  "grating": { "pitch_nm": 1200, "profile": { "type": "lamellar", "duty": 0.4, "depth_nm": 120 }, "theory": "scalar",
    "orders": [-1, 1] },
  "metal": "Al",
  "quality": { "representation": "arc", "bands": 2, "rank": 3, "view_resolution": 8 }
})";

TEST(CookedVersion, AMaterialOfThisVersionIsReadAndIsWhatItsSourceStillBakesTo) {
    const CookedMaterial kept = load_cooked_material(ROWLAND_COOKED_MATERIAL);
    const CookedMaterial now = cook_material(nlohmann::json::parse(kSource), "source.json");
    EXPECT_EQ(kept.material.grating.pitch_nm, 1200.0);
    EXPECT_EQ(kept.material.grating.orders, (std::vector<int>{-1, 1}));
    ASSERT_EQ(kept.kernel.antiderivative.size(), now.kernel.antiderivative.size());
    // Single precision; another compiler's mathematics may round another way.
    constexpr double rounding = 1e-6;
    double difference = 0.0;
    double largest = 0.0;
    for (std::size_t i = 0; i < now.kernel.antiderivative.size(); ++i) {
        for (int column = 0; column < 3; ++column) {
            for (int row = 0; row < 3; ++row) {
                const float a = kept.kernel.antiderivative[i][column][row];
                const float b = now.kernel.antiderivative[i][column][row];
                difference = std::max(difference, static_cast<double>(std::abs(a - b)));
                largest = std::max(largest, static_cast<double>(std::abs(b)));
            }
        }
    }
    EXPECT_GT(largest, 0.01);
    EXPECT_LE(difference, rounding * largest) << "the bake has changed: raise kMaterialAssetVersion, keep a new file";
    const auto& table = std::get<ArcTable>(kept.tables);
    const auto& expected = std::get<ArcTable>(now.tables);
    EXPECT_EQ(table.rank, expected.rank);
    EXPECT_EQ(table.grid.columns, expected.grid.columns);
    ASSERT_EQ(table.texels.size(), expected.texels.size());
}

}  // namespace
}  // namespace rowland::diffraction
