#include "modules/diffraction/evaluate/budget.h"

#include <gmock/gmock.h>

#include <cstdlib>

#include "modules/diffraction/evaluate/point_shader.h"
#include "modules/diffraction/reference/reference.h"
#include "tests/support/expect.h"
#include "tests/support/files.h"

namespace rowland::diffraction {
namespace {

nlohmann::json compact_disc() {
    return nlohmann::json::parse(R"({"grating": {"pitch_nm": 1600, "profile": {"type": "slit", "width_nm": 800}}})");
}

Material with_budget(double max_error, SurfaceShape surface = SurfaceShape::Flat) {
    Material material = parse_material(compact_disc(), "cd.json");
    material.quality.max_error = max_error;
    material.quality.surface = surface;
    return material;
}

/// Every so many of the named frames, for speed.
std::vector<ShadingPoint> some_frames(SurfaceShape surface, std::size_t step) {
    std::vector<ShadingPoint> some;
    const std::vector<ShadingPoint> all = measured_frames(surface);
    for (std::size_t i = 0; i < all.size(); i += step) some.push_back(all[i]);
    return some;
}

/// The same frames under each of so many probes, as one part.
std::vector<MeasuredViews> one_part(std::size_t probes, const std::vector<ShadingPoint>& frames) {
    return std::vector(probes, MeasuredViews{.layout = layout_of(frames), .parts = {frames}});
}

BudgetProbe captured(const std::filesystem::path& path, lighting::Mapping mapping) {
    return {.name = path.filename().string(), .image = {image::load_image(path), mapping, path.string()}};
}

/// A lamp in a dim room.
BudgetProbe made_up() {
    image::Image image{.width = 64, .height = 32, .texels = std::vector(std::size_t{64} * 32, glm::vec3(0.2F))};
    for (const std::size_t texel : {std::size_t{8 * 64 + 40}, std::size_t{8 * 64 + 41}, std::size_t{9 * 64 + 40}})
        image.texels[texel] = glm::vec3(60.0F, 50.0F, 40.0F);
    return {
        .name = "made up", .image = {std::move(image), lighting::Mapping::Equirectangular, "made up"}, .key_lights = 4};
}

/// The error of a cooked material as anyone can compute it: through its bytes, under the lights of its record.
double error_of(const CookedMaterial& cooked, const nlohmann::json& settings, const BudgetProbe& probe,
                std::span<const ShadingPoint> frames, std::span<const glm::dvec3> reference) {
    nlohmann::json json = compact_disc();
    json["quality"] = settings;
    const CookedMaterial read = read_cooked_material(write_cooked_material(json, cooked), "cd.material");
    const EvaluationLight light(probe.image, read.measured->probes.front().key_lights, math::SphericalWindow::None);
    return relative_rms(evaluate_baked(read, light, frames), reference);
}

TEST(Budget, OfRealProbesPicksDearerSettingsForSmallerErrors) {
    ROWLAND_TEST_DATA(ennis, "probes/ennis_probulator.hdr");
    ROWLAND_TEST_DATA(sunset, "probes/blender_sunset.exr");
    const std::vector<BudgetProbe> probes = {captured(ennis, lighting::Mapping::Equirectangular),
                                             captured(sunset, lighting::Mapping::Equirectangular)};
    const std::vector<ShadingPoint> frames = some_frames(SurfaceShape::Flat, 20);
    std::vector<std::vector<glm::dvec3>> references;
    for (const BudgetProbe& probe : probes)
        references.push_back(reference_radiance(with_budget(1.0).grating, probe.image, colour::LightSpectra(), frames));
    std::set<std::string> settings;
    double price = 0.0;
    for (const double max_error : {0.30, 0.05, 0.02}) {
        const BudgetChoice choice =
            choose_representation(with_budget(max_error), probes, one_part(probes.size(), frames), "cd.json");
        ASSERT_EQ(choice.cooked.measured->probes.size(), probes.size());
        EXPECT_GE(choice.cooked.measured->price, price) << max_error;
        price = choice.cooked.measured->price;
        settings.insert(choice.settings.dump());
        for (std::size_t i = 0; i < probes.size(); ++i) {
            const double error = error_of(choice.cooked, choice.settings, probes[i], frames, references[i]);
            EXPECT_LE(error, max_error) << probes[i].name << choice.settings;
            EXPECT_DOUBLE_EQ(choice.cooked.measured->probes[i].error, error) << probes[i].name;
        }
    }
    EXPECT_GE(settings.size(), 2U) << ::testing::PrintToString(settings);
}

/// Every candidate is baked and measured apart from the search: none that costs less is within the budget.
TEST(Budget, NothingCheaperWouldHaveDone) {
    const std::vector<BudgetProbe> probes = {made_up()};
    const std::vector<ShadingPoint> frames = some_frames(SurfaceShape::Curved, 12);
    const Material material = with_budget(0.05, SurfaceShape::Curved);
    const BudgetChoice choice = choose_representation(material, probes, one_part(probes.size(), frames), "cd.json");
    const auto reference = reference_radiance(material.grating, probes[0].image, colour::LightSpectra(), frames);
    int cheaper = 0;
    for (const nlohmann::json& settings :
         budget_candidates(material.grating, SurfaceShape::Curved, probes[0].key_lights)) {
        nlohmann::json json = compact_disc();
        json["quality"] = settings;
        CookedMaterial other;
        try {
            other = cook_material(json, "other.json");
        } catch (const Error&) {
            continue;
        }
        const int keys = other.material.quality.key_lights;
        if (shading_price(shading_cost(other.tables), keys) >= choice.cooked.measured->price) continue;
        ++cheaper;
        const EvaluationLight light(probes[0].image, keys, math::SphericalWindow::None);
        EXPECT_GT(relative_rms(evaluate_baked(other, light, frames), reference), 0.05) << settings;
    }
    EXPECT_GT(cheaper, 3);
}

/// What a frame may draw instead of the choice: each rung cheaper and worse than the next, with the errors that it
/// has.
TEST(Budget, KeepsTheCheaperRungsWithTheirErrors) {
    const std::vector<BudgetProbe> probes = {made_up()};
    const std::vector<ShadingPoint> frames = some_frames(SurfaceShape::Curved, 12);
    const Material material = with_budget(0.05, SurfaceShape::Curved);
    const BudgetChoice choice = choose_representation(material, probes, one_part(probes.size(), frames), "cd.json");
    const auto reference = reference_radiance(material.grating, probes[0].image, colour::LightSpectra(), frames);
    const std::vector<CookedRung>& rungs = choice.cooked.cheaper;
    ASSERT_GE(rungs.size(), 2U);
    EXPECT_LT(rungs.size(), kMostRungs);
    EXPECT_EQ(rungs.front().settings, (nlohmann::json{{"representation", "direct"}, {"key_lights", 0}}));
    double price = -1.0;
    double error = 1e9;
    for (const CookedRung& rung : rungs) {
        EXPECT_GT(rung.measured.price, price) << rung.settings;
        EXPECT_LT(rung.measured.largest_error(), error) << rung.settings;
        price = rung.measured.price;
        error = rung.measured.largest_error();
        EXPECT_GT(error, 0.05);
        EXPECT_DOUBLE_EQ(error, error_of(as_rung(choice.cooked, rung), rung.settings, probes[0], frames, reference));
    }
    EXPECT_LT(price, 0.85 * choice.cooked.measured->price);
}

/// Of efficiencies that depend on the view, the errors are those of what is drawn, at every view.
TEST(Budget, OfRigorousEfficienciesMeasuresWhatIsDrawn) {
    nlohmann::json json = compact_disc();
    json["metal"] = "Al";
    json["grating"] = {{"pitch_nm", 740},
                       {"profile", {{"type", "lamellar"}, {"duty", 0.43}, {"depth_nm", 103}}},
                       {"theory", "rigorous"},
                       {"orders", {-1, 1}}};
    json["quality"] = {{"max_error", 0.05}};
    const Material material = with_efficiencies(parse_material(json, "dvd.json"), "dvd.json");
    const std::vector<BudgetProbe> probes = {made_up()};
    const std::vector<ShadingPoint> frames = some_frames(SurfaceShape::Flat, 12);
    const BudgetChoice choice = choose_representation(material, probes, one_part(probes.size(), frames), "dvd.json");
    const auto reference = reference_radiance(material.grating, probes[0].image, colour::LightSpectra(), frames);
    json["quality"] = choice.settings;
    const CookedMaterial drawn = cook_material(json, "dvd.json");
    const EvaluationLight light(probes[0].image, drawn.material.quality.key_lights, math::SphericalWindow::None);
    const double error = relative_rms(shade_surfaces(drawn, light, std::vector<Surface>{frames}), reference);
    EXPECT_LE(error, 0.05) << choice.settings;
    EXPECT_NEAR(choice.cooked.measured->largest_error(), error, 1e-3 * error);
}

TEST(Budget, OutOfReachIsRefusedWithTheBestThatIsNot) {
    const std::vector<BudgetProbe> probes = {made_up()};
    const std::vector<ShadingPoint> frames = some_frames(SurfaceShape::Flat, 24);
    // Arcs alone, as a search through all representations takes long.
    const ChoiceRules rules{.pointer = {}, .allows = [](const Quality& quality) {
                                return std::holds_alternative<ArcSettings>(*quality.pinned);
                            }};
    const auto choose = [&](double max_error) {
        return choose_representation(with_budget(max_error), probes, one_part(probes.size(), frames), "folder/cd.json",
                                     rules);
    };
    const std::string message = rowland::test::message_of([&] { choose(1e-7); });
    EXPECT_THAT(message,
                ::testing::AllOf(::testing::HasSubstr("folder/cd.json"), ::testing::HasSubstr("/quality/max_error"),
                                 ::testing::HasSubstr("\"representation\"")));
    const std::string mark = "at least ";
    const double best = std::strtod(message.c_str() + message.find(mark) + mark.size(), nullptr);
    EXPECT_NO_THROW(choose(best));
    EXPECT_THROW(choose(0.98 * best), Error);
}

/// The record holds the largest error, also of the part that checks the choice.
TEST(Budget, RecordsTheLargestErrorOfAllParts) {
    const std::vector<BudgetProbe> probes = {made_up()};
    const std::vector<ShadingPoint> frames = some_frames(SurfaceShape::Flat, 10);
    const Material material = with_budget(0.1);
    const auto reference = reference_radiance(material.grating, probes[0].image, colour::LightSpectra(), frames);
    std::vector<double> recorded;
    for (const bool swapped : {false, true}) {  // so that the largest is once of the part that checks
        MeasuredViews views{.layout = GrooveLayout::Flat,
                            .parts = {{frames.begin(), frames.begin() + 6}, {frames.begin() + 6, frames.end()}}};
        if (swapped) std::swap(views.parts[0], views.parts[1]);
        const BudgetChoice choice = choose_representation(
            material, probes, {&views, 1}, "cd.json",
            {.pointer = {},
             .allows = [](const Quality& quality) { return std::holds_alternative<PlanarSettings>(*quality.pinned); }});
        recorded.push_back(choice.cooked.measured->probes[0].error);
        EXPECT_EQ(choice.cooked.measured->frames, 12);
        const auto of_part = [&](std::size_t begin) {
            return error_of(choice.cooked, choice.settings, probes[0], std::span(frames).subspan(begin, 6),
                            std::span(reference).subspan(begin, 6));
        };
        EXPECT_NEAR(recorded.back(), std::max(of_part(0), of_part(6)), 1e-12);
    }
}

TEST(Budget, ChoiceDoesNotDependOnTheNumberOfThreads) {
    const std::vector<BudgetProbe> probes = {made_up()};
    const std::vector<ShadingPoint> frames = some_frames(SurfaceShape::Flat, 24);
    const auto bytes = [&](unsigned threads) {
        const ThreadLimit limit(threads);
        const BudgetChoice choice =
            choose_representation(with_budget(0.03), probes, one_part(probes.size(), frames), "cd.json");
        nlohmann::json json = compact_disc();
        json["quality"] = choice.settings;
        return write_cooked_material(json, choice.cooked);
    };
    EXPECT_EQ(bytes(1), bytes(2));
}

/// `circle` needs the flat lobe, and `streak` one that is not.
TEST(Budget, CandidatesOfALobeAreThoseThatShadeIt) {
    const auto names = [](const GrooveLobe& lobe) {
        Material material = with_budget(0.5);
        material.grating.lobe = lobe;
        std::set<std::string> found;
        for (const nlohmann::json& candidate : budget_candidates(material.grating, SurfaceShape::Curved, 4)) {
            EXPECT_TRUE(std::holds_alternative<Quality>(suited_quality(candidate, material.grating))) << candidate;
            found.insert(candidate["representation"]);
        }
        return found;
    };
    EXPECT_EQ(names(FlatLobe{}), (std::set<std::string>{"spikes", "arc", "direct", "circle"}));
    EXPECT_EQ(names(GaussianLobe{0.3}), (std::set<std::string>{"spikes", "arc", "direct", "streak"}));
}

/// Maps are for flat lattices.
TEST(Budget, ACurvedLatticeIsDrawnByHarmonics) {
    Material material = with_budget(0.5, SurfaceShape::Curved);
    material.grating = Grating{.pitch_nm = 1000.0, .orders = {}};
    material.grating.lattice =
        Lattice{.a_nm = {1000.0, 0.0},
                .b_nm = {0.0, 1000.0},
                .profile = CrossedProfile{.along_a = SinusoidalProfile{110.0}, .along_b = SinusoidalProfile{110.0}},
                .orders = 2};
    const std::vector<BudgetProbe> probes = {made_up()};
    const std::vector<ShadingPoint> frames = some_frames(SurfaceShape::Curved, 40);
    const BudgetChoice choice = choose_representation(material, probes, one_part(probes.size(), frames), "foil.json");
    EXPECT_TRUE(find_representation(choice.settings["representation"].get<std::string>())->takes_harmonics);
    const EvaluationLight light(probes[0].image, choice.cooked.measured->probes.front().key_lights,
                                math::SphericalWindow::None);
    const auto reference = reference_radiance(material.grating, probes[0].image, colour::LightSpectra(), frames);
    EXPECT_LE(relative_rms(evaluate_baked(choice.cooked, light, frames), reference), 0.5);
}

TEST(Budget, PriceCountsWhatEveryPixelPays) {
    const ShadingCost arc{.fetches_per_pixel = 2, .multiply_adds_per_pixel = 32, .table_bytes = 1 << 20};
    EXPECT_DOUBLE_EQ(shading_price(arc, 0), 2.0 + 32.0 / 8.0 + 0.25);
    const ShadingCost lights{.fetches_per_light = 9, .multiply_adds_per_light = 80};
    EXPECT_DOUBLE_EQ(shading_price(lights, 16), 16.0 * 19.0);
    const ShadingCost spikes{.fetches_per_vertex = 40};
    EXPECT_DOUBLE_EQ(shading_price(spikes, 16), 40.0 * 25000.0 / 460800.0);
}

}  // namespace
}  // namespace rowland::diffraction
