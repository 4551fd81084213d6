#include "editor/inspector/measurement.h"

#include <gmock/gmock.h>

#include "engine/lighting/procedural_probe.h"
#include "modules/diffraction/evaluate/budget.h"
#include "modules/diffraction/evaluate/error_measure.h"
#include "tests/support/files.h"
#include "tests/support/program.h"

namespace rowland::inspector {
namespace {

const std::filesystem::path kPricedMaterials = test::content_path("materials");

/// A small probe with a sun.
lighting::ProbeImage sky() {
    return {lighting::render_clear_sky({}, 64), lighting::Mapping::Equirectangular, "sky"};
}

std::string info(const std::filesystem::path& source, const std::filesystem::path& folder) {
    const std::string baked = (folder / "m.material").string();
    const test::Ended cooked = test::run({ROWLAND_COOK, "cook", source.string(), "--output", baked});
    EXPECT_EQ(cooked.code, 0) << cooked.err;
    return test::run({ROWLAND_COOK, "info", baked}).out;
}

/// Prices a material's own settings and stops.
PricedChoice present_choice(const Document& document, const lighting::ProbeImage& probe) {
    std::stop_source stop;
    PricedChoice found;
    price_choices(
        {.material = document.material(),
         .quality = nlohmann::json::parse(document.json()["quality"].dump()),
         .probe = probe},
        [&](const PriceList& list) {
            found = list.choices.front();
            stop.request_stop();
        },
        stop.get_token());
    return found;
}

TEST(Price, CountsAreWhatCookInfoPrints) {
    const test::TemporaryFolder folder;
    const std::filesystem::path material = kPricedMaterials / "cd.json";
    const PricedChoice choice = present_choice(Document::open(material), sky());
    EXPECT_TRUE(choice.present);
    EXPECT_GT(choice.error, 0.0);
    const std::string printed = info(material, folder.path());
    for (const auto& [key, value] :
         {std::pair{"table_bytes", choice.cost.table_bytes},
          std::pair{"fetches_per_pixel", std::size_t(choice.cost.fetches_per_pixel)},
          std::pair{"multiply_adds_per_vertex", std::size_t(choice.cost.multiply_adds_per_vertex)}})
        EXPECT_THAT(printed, testing::HasSubstr(fmt::format("\n{}: {}\n", key, value)));
}

TEST(Price, TheCheapestWithinAnErrorIsWhatTheCookerChooses) {
    Document document = Document::open(kPricedMaterials / "cd.json");
    const lighting::ProbeImage probe = sky();
    document.set_choice(field_at("/quality"), "by budget");
    document.set_value(field_at("/quality/max_error"), 0.1);
    PriceList last;
    price_choices({.material = document.material(), .quality = nullptr, .probe = probe},
                  [&](const PriceList& list) { last = list; }, {});
    EXPECT_EQ(last.done, last.total);
    EXPECT_EQ(3 * last.choices.size(), last.total);  // each is baked and measured at the first views, and at all
    const auto cheapest = cheapest_within(last, 0.1);
    const std::vector<diffraction::BudgetProbe> probes = {{.name = "sky", .image = probe, .key_lights = 16}};
    const std::vector<diffraction::MeasuredViews> views = {diffraction::drawn_views(document.material(), probe)};
    const diffraction::BudgetChoice chosen =
        diffraction::choose_representation(document.material(), probes, views, "cd.json");
    ASSERT_TRUE(cheapest);
    EXPECT_EQ(cheapest->settings, chosen.settings);
    EXPECT_EQ(cheapest->price, chosen.cooked.measured->price);
    EXPECT_LE(cheapest->error, chosen.cooked.measured->probes[0].error + 1e-12);  // which also counts the checks
    EXPECT_FALSE(cheapest_within(last, 1e-9));
    document.replace_quality(Json::parse(cheapest->settings.dump()));
    EXPECT_FALSE(document.refusal());

    // Along the front errors fall as prices rise.
    double price = -1.0;
    double error = 1e9;
    for (const PricedChoice& choice : last.choices) {
        if (!choice.on_front || choice.price == price) continue;
        EXPECT_GT(choice.price, price);
        EXPECT_LT(choice.error, error);
        price = choice.price;
        error = choice.error;
    }
}

TEST(Price, StopsBetweenTwoSettings) {
    Document document = Document::open(kPricedMaterials / "cd.json");
    document.set_choice(field_at("/quality"), "by budget");
    const lighting::ProbeImage probe = sky();
    std::stop_source stop;
    int reports = 0;
    price_choices(
        {.material = document.material(), .quality = nullptr, .probe = probe},
        [&](const PriceList& list) {
            EXPECT_GT(list.total, 20U);
            if (++reports == 2) stop.request_stop();
        },
        stop.get_token());
    EXPECT_EQ(reports, 2);
}

}  // namespace
}  // namespace rowland::inspector
