#include "modules/diffraction/evaluate/search.h"

#include <gtest/gtest.h>

#include "modules/diffraction/evaluate/point_shader.h"
#include "modules/diffraction/reference/reference.h"

namespace rowland::diffraction {
namespace {

Material searched_material() {
    return parse_material(
        nlohmann::json::parse(R"({"grating": {"pitch_nm": 1600, "profile": {"type": "slit", "width_nm": 800}}})"),
        "cd.json");
}

BudgetProbe lamp(std::size_t texel) {
    image::Image image{.width = 32, .height = 16, .texels = std::vector(std::size_t{32} * 16, glm::vec3(0.2F))};
    image.texels[texel] = glm::vec3(30.0F, 25.0F, 20.0F);
    return {.name = "lamp", .image = {std::move(image), lighting::Mapping::Equirectangular, "lamp"}, .key_lights = 2};
}

std::vector<ShadingPoint> six_frames() {
    std::vector<ShadingPoint> frames = measured_frames(SurfaceShape::Flat);
    frames.resize(6);
    return frames;
}

/// The six frames under each of two probes, as one part.
std::vector<MeasuredViews> six_views() {
    return std::vector(2, MeasuredViews{.layout = GrooveLayout::Flat, .parts = {six_frames()}});
}

const std::vector<nlohmann::json> kSearched = {
    {{"representation", "arc"}, {"bands", 8}, {"rank", 16}, {"key_lights", 64}},
    {{"representation", "arc"}, {"bands", 3}, {"rank", 4}, {"key_lights", 0}},
    {{"representation", "streak"}},  // does not suit a flat lobe
    {{"representation", "planar"}, {"map_resolution", 64}},
};

SearchState searched(const SearchQuery& query, int stop_after = 1000) {
    std::stop_source stop;
    int reports = 0;
    std::size_t done = 0;
    SearchState found = search(
        query,
        [&](const SearchState& state) {
            EXPECT_GT(state.done, done);
            done = state.done;
            if (++reports == stop_after) stop.request_stop();
        },
        stop.get_token());
    EXPECT_EQ(found.done, done);
    return found;
}

/// Every setting alone: it is on the front and is measured wholly.
std::vector<MeasuredChoice> each_alone(SearchQuery query) {
    std::vector<MeasuredChoice> choices;
    for (const nlohmann::json& settings : kSearched) {
        query.settings = {settings};
        for (MeasuredChoice& choice : searched(query).measured) choices.push_back(std::move(choice));
    }
    std::ranges::stable_sort(choices, {}, &MeasuredChoice::price);
    return choices;
}

/// Every suitable setting, by price, each with the error of evaluating it by itself.
TEST(Search, MeasuresWhatSuitsTheGratingTheCheapestFirst) {
    const Material material = searched_material();
    const std::vector<BudgetProbe> probes = {lamp(100), lamp(200)};
    const std::vector<ShadingPoint> frames = six_frames();
    const std::vector<MeasuredViews> views = six_views();
    const SearchState found = searched({.material = material, .probes = probes, .views = views, .settings = kSearched});
    ASSERT_EQ(found.measured.size(), 3U);
    EXPECT_EQ(found.done, found.total);
    EXPECT_TRUE(std::ranges::is_sorted(found.measured, {}, &MeasuredChoice::price));
    for (const MeasuredChoice& choice : found.measured) {
        EXPECT_TRUE(choice.errors.size() == probes.size() || !on_front(choice, found.measured));
        nlohmann::json json = {{"grating", {{"pitch_nm", 1600}, {"profile", {{"type", "slit"}, {"width_nm", 800}}}}},
                               {"quality", choice.settings}};
        const CookedMaterial alone = cook_material(json, "alone.json");
        for (std::size_t i = 0; i < choice.errors.size(); ++i) {
            const EvaluationLight light(probes[i].image, alone.material.quality.key_lights ? probes[i].key_lights : 0,
                                        math::SphericalWindow::None);
            const auto reference =
                reference_radiance(material.grating, probes[i].image, colour::LightSpectra(), frames);
            EXPECT_NEAR(choice.errors[i], relative_rms(evaluate_baked(alone, light, frames), reference), 1e-12)
                << choice.settings;
        }
    }
}

TEST(Search, EndsAtTheFirstThatIsGoodEnough) {
    const Material material = searched_material();
    const std::vector<BudgetProbe> probes = {lamp(100), lamp(200)};
    const std::vector<MeasuredViews> views = six_views();
    SearchQuery query{.material = material, .probes = probes, .views = views, .settings = kSearched};
    const std::vector<MeasuredChoice> all = each_alone(query);
    query.good_enough = all[1].error();
    const std::size_t first = all[0].error() <= *query.good_enough ? 0 : 1;
    const SearchState some = searched(query);
    ASSERT_EQ(some.measured.size(), first + 1);
    EXPECT_EQ(some.measured.back().settings, all[first].settings);
    EXPECT_EQ(some.measured.back().errors, all[first].errors);
    // 1 % short of it is not good enough.
    query.good_enough = 0.99 * all[first].error();
    EXPECT_GT(searched(query).measured.size(), first + 1);
    // Out of reach: the best of all is certain.
    query.good_enough = 1e-9;
    const SearchState none = searched(query);
    const auto best = std::ranges::min_element(none.measured, {}, &MeasuredChoice::error);
    EXPECT_EQ(best->settings, std::ranges::min_element(all, {}, &MeasuredChoice::error)->settings);
    EXPECT_EQ(best->errors.size(), probes.size());
}

/// The last part decides nothing; of the others the largest error counts.
TEST(Search, TheLargestErrorOfThePartsDecidesAndTheLastPartChecks) {
    const Material material = searched_material();
    const std::vector<BudgetProbe> probes = {lamp(100)};
    const std::vector<ShadingPoint> frames = measured_frames(SurfaceShape::Flat);
    std::vector<MeasuredViews> views = {{.layout = GrooveLayout::Flat, .parts = {}}};
    for (std::ptrdiff_t i = 0; i < 4; ++i)
        views[0].parts.emplace_back(frames.begin() + 4 * i, frames.begin() + 4 * i + 4);
    const std::vector<nlohmann::json> settings = {kSearched[1], kSearched[3]};
    const auto error_of = [&](const MeasuredChoice& choice, std::size_t part) {
        return relative_rms(
            evaluate_baked(*choice.baked, EvaluationLight(probes[0].image, 0, math::SphericalWindow::None),
                           views[0].parts[part]),
            reference_radiance(material.grating, probes[0].image, colour::LightSpectra(), views[0].parts[part]));
    };
    SearchQuery query{.material = material, .probes = probes, .views = views, .settings = {kSearched[1]}};
    const MeasuredChoice all = searched(query).measured[0];
    const double largest = std::max({error_of(all, 0), error_of(all, 1), error_of(all, 2)});
    EXPECT_NEAR(all.error(), largest, 1e-12);
    EXPECT_GT(largest, 1.05 * error_of(all, 0)) << "a part decides that is not the first";
    EXPECT_TRUE(all.checks.empty());
    query.good_enough = largest;
    const SearchState met = searched(query);
    ASSERT_EQ(met.measured[0].checks.size(), 1U);
    EXPECT_NEAR(met.measured[0].checks[0], error_of(all, 3), 1e-12);
    EXPECT_NEAR(met.measured[0].error(), largest, 1e-12);
}

/// What is off the front at the first views stays there, and its other views are not measured.
TEST(Search, MeasuresTheFrontWholly) {
    const Material material = searched_material();
    const std::vector<BudgetProbe> probes = {lamp(100), lamp(200)};
    const std::vector<MeasuredViews> views = six_views();
    const SearchQuery query{.material = material, .probes = probes, .views = views, .settings = kSearched};
    const std::vector<MeasuredChoice> alone = each_alone(query);
    const SearchState found = searched(query);
    ASSERT_EQ(found.measured.size(), alone.size());
    std::size_t partly = 0;
    for (std::size_t i = 0; i < alone.size(); ++i) {
        EXPECT_EQ(on_front(found.measured[i], found.measured), on_front(alone[i], alone)) << alone[i].settings;
        if (on_front(alone[i], alone))
            EXPECT_EQ(found.measured[i].errors, alone[i].errors);
        else
            partly += found.measured[i].errors.size() < probes.size() ? 1 : 0;
    }
    EXPECT_GT(partly, 0U) << "the settings of this test have one off the front";

    // As well for an error of which the best is good enough, if the cheaper ones are asked for.
    SearchQuery ladder = query;
    ladder.good_enough = std::ranges::min(alone, {}, &MeasuredChoice::error).error();
    ladder.cheaper = true;
    const SearchState rungs = searched(ladder);
    std::size_t cheaper = 0;
    for (const MeasuredChoice& rung : rungs.measured) {
        if (!on_front(rung, rungs.measured)) continue;
        const auto same = std::ranges::find(alone, rung.settings, &MeasuredChoice::settings);
        ASSERT_NE(same, alone.end());
        EXPECT_EQ(rung.errors, same->errors) << rung.settings;
        cheaper += rung.error() > *ladder.good_enough ? 1 : 0;
    }
    EXPECT_GT(cheaper, 0U);
}

TEST(Search, StopsBetweenTwoSteps) {
    const Material material = searched_material();
    const std::vector<BudgetProbe> probes = {lamp(100)};
    const std::vector<MeasuredViews> views = six_views();
    const SearchQuery query{.material = material, .probes = probes, .views = views, .settings = kSearched};
    const SearchState baking = searched(query, 2);
    EXPECT_EQ(baking.done, 2U);
    EXPECT_EQ(baking.total, 9U);
    EXPECT_TRUE(baking.measured.empty());
    EXPECT_EQ(searched(query, 4).measured.size(), 1U);
    // Before the first choice, which is pinned, is measured.
    SearchQuery pinned{.material = material, .probes = probes, .views = views, .settings = kSearched};
    pinned.first = kSearched[1];
    std::stop_source stop;
    stop.request_stop();
    EXPECT_TRUE(search(
                    pinned, [](const SearchState&) {}, stop.get_token())
                    .measured.empty());
}

/// Stopped between two parts, it continues where it was.
TEST(MeasuredScene, ItsReferenceCanBeStoppedAndContinued) {
    const BudgetProbe probe = lamp(100);
    const std::vector<ShadingPoint> frames = six_frames();
    std::stop_source stop;
    int parts = 0;
    MeasuredScene scene{
        "lamp", std::make_shared<ProbeLights>(probe.image), {frames}, 4, [&](std::span<const ShadingPoint> part) {
            ++parts;
            stop.request_stop();
            return std::vector<glm::dvec3>(part.size(), glm::dvec3(parts));
        }};
    EXPECT_FALSE(scene.prepare(stop.get_token()));
    EXPECT_EQ(parts, 1);
    EXPECT_TRUE(scene.prepare());
    const std::vector<glm::dvec3>& reference = scene.reference;
    ASSERT_EQ(reference.size(), frames.size());
    EXPECT_EQ(reference[3], glm::dvec3(1.0));
    EXPECT_EQ(reference[4], glm::dvec3(2.0));
    EXPECT_TRUE(scene.prepare(stop.get_token())) << "nothing is left to stop";
    EXPECT_EQ(parts, 2);
}

}  // namespace
}  // namespace rowland::diffraction
