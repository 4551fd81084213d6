#include <gmock/gmock.h>
#include <chrono>
#include <set>
#include <thread>

#include "content/demo/pixel/pixel_meter.h"
#include "engine/core/file.h"
#include "tests/support/expect.h"
#include "tests/support/files.h"
#include "tests/support/light.h"

namespace rowland::demo {

namespace {

constexpr const char* kStudio = R"({"probe": {"type": "studio", "width": 64, "key_lights": 2,
    "ceiling": [0.2, 0.2, 0.2], "wall": [0.1, 0.1, 0.1], "floor": [0.05, 0.05, 0.05], "boxes": [
    {"azimuth_deg": 160, "elevation_deg": 40, "half_size_deg": [20, 12], "radiance": [LAMP, 5, 4]}]}})";

class PixelMeterTest : public ::testing::Test {
 protected:
    PixelMeterTest() {
        write_recipe("warm.json", "9");
        write_recipe("cold.json", "1");
    }
    void write_recipe(const std::string& name, const std::string& lamp) const {
        std::string text = kStudio;
        text.replace(text.find("LAMP"), 4, lamp);
        write_file_atomic(folder_.path() / name, text);
    }
    static std::shared_ptr<const diffraction::CookedMaterial> material(int pitch_nm, const std::string& quality) {
        const std::string text = R"({"grating": {"pitch_nm": )" + std::to_string(pitch_nm) +
                                 R"(, "profile": {"type": "slit", "width_nm": 300}}, "quality": )" + quality + "}";
        return std::make_shared<const diffraction::CookedMaterial>(
            diffraction::cook_material(nlohmann::json::parse(text), "test"));
    }
    PixelQuery query(std::shared_ptr<const diffraction::CookedMaterial> cooked, const std::string& probe) const {
        return {.cooked = std::move(cooked),
                .frame = {.view = {0.2, 0.3, 0.9}, .normal = {0.0, 0.0, 1.0}, .grating = {1.0, 0.0, 0.0}},
                .layout = diffraction::GrooveLayout::FlatUniform,
                .window = math::SphericalWindow::None,
                .probe = {.path = folder_.path() / probe, .mapping = "equirect", .recipes = folder_.path()}};
    }
    /// Asks, and polls as frames do until there is an answer or a failure.
    PixelReading answer(PixelMeter& meter, const PixelQuery& asked) const {
        meter.ask(asked);
        const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
        while (std::chrono::steady_clock::now() < deadline) {
            meter.poll();
            if (meter.is_up_to_date() || !meter.failure().empty()) break;
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
        EXPECT_TRUE(meter.is_up_to_date()) << meter.failure();
        return meter.reading() ? *meter.reading() : PixelReading{};
    }
    /// What the module's own comparison says of it.
    diffraction::PointComparison direct(const PixelQuery& asked, math::SphericalWindow window) const {
        FullResolutionProbe probe =
            load_full_resolution_probe(asked.probe.path, asked.probe.mapping, asked.probe.recipes);
        return diffraction::PointComparer(probe.image, probe.key_lights)
            .compare(asked.cooked, window, asked.frame, asked.layout);
    }

    test::TemporaryFolder folder_;
    const std::shared_ptr<const diffraction::CookedMaterial> wide_ =
        material(1600, R"({"representation": "arc", "bands": 5})");
    const std::shared_ptr<const diffraction::CookedMaterial> narrow_ =
        material(740, R"({"representation": "spikes", "bands": 3})");
};

TEST_F(PixelMeterTest, SaysWhatTheModuleSaysForEachMaterialAndProbe) {
    PixelMeter meter;
    std::set<double> errors;
    for (const char* probe : {"warm.json", "cold.json"})
        for (const auto& cooked : {wide_, narrow_}) {
            const PixelQuery asked = query(cooked, probe);
            const PixelReading reading = answer(meter, asked);
            const diffraction::PointComparison expected = direct(asked, math::SphericalWindow::None);
            EXPECT_EQ(reading.point.shown, expected.shown);
            EXPECT_EQ(reading.point.reference, expected.reference);
            EXPECT_EQ(reading.point.error, expected.error);
            EXPECT_TRUE(errors.insert(reading.point.error).second) << "the same error twice";
        }
}

TEST_F(PixelMeterTest, AProbeWhoseFileChangedIsReadAgain) {
    PixelMeter meter;
    PixelQuery asked = query(wide_, "warm.json");
    const double warm = answer(meter, asked).point.reference.x;
    write_recipe("warm.json", "1");
    EXPECT_EQ(answer(meter, asked).point.reference.x, warm);
    asked.probe.version = 1;
    EXPECT_LT(answer(meter, asked).point.reference.x, warm);
}

TEST_F(PixelMeterTest, OfSeveralQueriesTheLastIsMeasured) {
    PixelMeter meter;
    meter.ask(query(wide_, "cold.json"));
    meter.poll();
    meter.ask(query(narrow_, "cold.json"));
    meter.poll();
    const PixelQuery last = query(narrow_, "warm.json");
    EXPECT_EQ(answer(meter, last).point.error, direct(last, math::SphericalWindow::None).error);
}

TEST_F(PixelMeterTest, TheKeyLightsAreTheProbesIfTheMaterialShadesThem) {
    PixelMeter meter;
    EXPECT_EQ(answer(meter, query(wide_, "warm.json")).key_lights, 2);
    EXPECT_EQ(answer(meter, query(narrow_, "warm.json")).key_lights, 0);
}

TEST_F(PixelMeterTest, WithoutTheUsersWindowTheWeakestSufficientOneIsTaken) {
    PixelMeter meter;
    PixelQuery asked = query(narrow_, "warm.json");
    asked.window.reset();
    const PixelReading reading = answer(meter, asked);
    EXPECT_EQ(reading.point.shown, direct(asked, reading.window).shown);
}

TEST_F(PixelMeterTest, AProbeThatIsNotThereIsSaidAndTheNextOneIsMeasured) {
    PixelMeter meter;
    meter.ask(query(wide_, "nowhere.probe"));
    while (meter.failure().empty()) meter.poll();
    EXPECT_NE(meter.failure().find("nowhere.json"), std::string::npos) << meter.failure();
    EXPECT_FALSE(meter.is_up_to_date());
    answer(meter, query(wide_, "warm.json"));
    EXPECT_TRUE(meter.failure().empty());
}

}  // namespace

namespace {

using ::testing::HasSubstr;

TEST(FullResolutionProbe, OfACookedProbeIsThatOfItsRecipe) {
    const test::TemporaryFolder folder;
    const auto path = [&](const char* name) { return folder.path() / name; };
    const std::filesystem::path probe = path("sky.probe");  // not read
    const auto load = [&] { return load_full_resolution_probe(probe, "auto", path("shipped")); };
    EXPECT_THAT(test::message_of(load), HasSubstr((path("shipped") / "sky.json").string()));
    std::filesystem::create_directory(path("recipes"));
    write_file_atomic(path("recipes") / "sky.json", test::small_sky(64));
    EXPECT_EQ(load().image.image().width, 64) << "what a build cooked from recipes that it wrote itself";
    std::filesystem::create_directory(path("shipped"));
    write_file_atomic(path("shipped") / "sky.json", test::small_sky(128));
    EXPECT_EQ(load().image.image().width, 128);
}

}  // namespace

}  // namespace rowland::demo
