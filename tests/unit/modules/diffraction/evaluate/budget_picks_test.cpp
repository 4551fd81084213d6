// What a budget picks for a compact disc keeps its promises.
#include <fmt/format.h>

#include <array>
#include <glm/geometric.hpp>
#include <random>

#include "engine/core/error.h"
#include "engine/image/image.h"
#include "modules/diffraction/asset/material.h"
#include "modules/diffraction/evaluate/budget.h"
#include "modules/diffraction/evaluate/error_measure.h"
#include "modules/diffraction/evaluate/point_shader.h"
#include "modules/diffraction/reference/reference.h"
#include "tests/support/files.h"

namespace rowland::diffraction {
namespace {

constexpr std::size_t kMostBytes = std::size_t{64} << 20;

BudgetProbe captured_light(const std::filesystem::path& path) {
    const std::string name = path.filename().string();
    const bool ball = name == "grace_probe.hdr" || name == "beach_probe.hdr";
    return {.name = name,
            .image = {image::load_image(path), ball ? lighting::Mapping::Angular : lighting::Mapping::Equirectangular,
                      path.string()}};
}

Material paper_disc(double max_error, SurfaceShape surface) {
    Material material = load_material(test::source_path("content/materials/cd_paper.json"));
    material.quality = Quality();
    material.quality.max_error = max_error;
    material.quality.surface = surface;
    return material;
}

/// 200 points of an object in 40 poses, drawn apart from those that the budget draws.
std::vector<ShadingPoint> other_views() {
    std::mt19937 random(11);
    std::normal_distribution<double> normal;
    const auto direction = [&] { return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random))); };
    std::vector<ShadingPoint> views;
    glm::dvec3 n = direction();
    while (views.size() < 200) {
        const glm::dvec3 across = direction();
        // On the sphere around n: as much of a surface as the eye sees of it.
        const glm::dvec3 view = glm::normalize(n + direction());
        if (glm::dot(view, n) < 0.1) continue;
        views.push_back({.view = view, .normal = n, .grating = glm::normalize(across - glm::dot(across, n) * n)});
        if (views.size() % 5 == 0) n = direction();
    }
    return views;
}

/// Asks for less and less error. Every choice is within it at other views too, has at most 64 MB, and with its key
/// lights is no worse than the same tables without; what is asked for less error is never cheaper.
void expect_kept_promises(const BudgetProbe& probe, SurfaceShape surface, std::span<const double> budgets) {
    const std::vector<ShadingPoint> views = other_views();
    const auto reference =
        reference_radiance(paper_disc(1.0, surface).grating, probe.image, colour::LightSpectra(), views);
    ProbeLights lights(probe.image, 0, probe.key_lights);
    double price = 0.0;
    for (const double max_error : budgets) {
        std::optional<BudgetChoice> choice;
        try {
            const Material material = paper_disc(max_error, surface);
            const std::vector<MeasuredViews> drawn = {drawn_views(material, probe.image)};
            choice = choose_representation(material, {&probe, 1}, drawn, "cd.json");
        } catch (const Error& error) {
            fmt::print("{:24} {:6} {:4} {}\n", probe.name, surface_shape_name(surface), max_error, error.what());
            continue;
        }
        const BudgetRecord& record = *choice->cooked.measured;
        const int keys = record.probes[0].key_lights;
        const auto error_with = [&](int count) {
            return relative_rms(
                evaluate_baked(choice->cooked, lights.split(count), views,
                               surface == SurfaceShape::Flat ? GrooveLayout::Flat : GrooveLayout::Curved),
                reference);
        };
        const double error = error_with(keys);
        const std::size_t bytes = shading_cost(choice->cooked.tables).table_bytes;
        fmt::print("{:24} {:6} {:4} {:90} error {:.4f}, other views {:.4f}, {} bytes, price {:.1f}\n", probe.name,
                   surface_shape_name(surface), max_error, choice->settings.dump(), record.probes[0].error, error,
                   bytes, record.price);
        EXPECT_LE(error, 1.5 * max_error) << probe.name << choice->settings;
        EXPECT_LE(bytes, kMostBytes) << probe.name << choice->settings;
        EXPECT_GE(record.price, price) << probe.name << max_error;
        price = record.price;
        if (keys > 0) {
            EXPECT_LT(error, error_with(0)) << probe.name << choice->settings;
        }
    }
}

TEST(BudgetPicks, KeepTheirPromisesUnderALamp) {
    image::Image room{.width = 64, .height = 32, .texels = std::vector(std::size_t{64} * 32, glm::vec3(0.2F))};
    room.texels[8 * 64 + 40] = glm::vec3(60.0F, 50.0F, 40.0F);
    const BudgetProbe probe{
        .name = "lamp", .image = {std::move(room), lighting::Mapping::Equirectangular, "lamp"}, .key_lights = 8};
    expect_kept_promises(probe, SurfaceShape::Flat, std::array{0.2, 0.05});
}

/// Small images, whose reference takes seconds: soft light, and one very bright doorway.
TEST(BudgetPicks, KeepTheirPromisesUnderCapturedProbes) {
    ROWLAND_TEST_DATA(venice, "probes/venice_sunset_256.hdr");
    ROWLAND_TEST_DATA(ennis, "probes/ennis_probulator.hdr");
    ROWLAND_TEST_DATA(sunset, "probes/blender_sunset.exr");
    // Chosen by 120 views of one pose, the sphere's representation is .032 off here.
    expect_kept_promises(captured_light(sunset), SurfaceShape::Curved, std::array{0.02});
    expect_kept_promises(captured_light(venice), SurfaceShape::Flat, std::array{0.02});
    expect_kept_promises(captured_light(venice), SurfaceShape::Curved, std::array{0.02});
    expect_kept_promises(captured_light(ennis), SurfaceShape::Flat, std::array{0.02});
}

}  // namespace
}  // namespace rowland::diffraction
