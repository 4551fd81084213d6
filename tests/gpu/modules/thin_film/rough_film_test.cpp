// Pixels of rough films under captured light against the sum over every microfacet, each with its own light and the
// exact sum over wavelengths: all that a frame leaves out, the engine's prefiltered environment and the split sum
// included.

#include "modules/thin_film/evaluate/drawn_film.h"
#include "modules/thin_film/module.h"
#include "modules/thin_film/reference/film_reference.h"
#include "modules/thin_film/runtime/film_surface.h"
#include "tests/gpu/render_test.h"
#include "tests/support/files.h"
#include "tests/support/light.h"

namespace rowland::thin_film {
namespace {

using rowland::test::Facing;
using rowland::test::random_facings;

constexpr int kFacings = 24;

class RoughFilmPixel : public rowland::test::RenderTest {
 protected:
    RoughFilmPixel() { register_module(renderer_); }

    void light_by(const std::filesystem::path& path) {
        const lighting::ProbeImage image = lighting::load_probe_image(path, lighting::Mapping::Auto);
        samples_ = lighting::light_samples(image);
        environment_ = lighting::prefilter(image);
        lighting::LightProbeSettings settings;
        settings.key_lights = 0;
        renderer_.set_probe(lighting::build_light_probe(image, settings));
    }

    /// Relative RMS error over the facings of a surface of one look-up, and of one of four.
    struct Errors {
        double one;
        double four;
    };
    Errors errors(nlohmann::json material, double roughness) {
        const auto [film, entity] = add_rough(std::move(material), roughness);
        const RoughReference reference(film.material.film, colour::LightSpectra{});
        Errors off{};
        double whole = 0.0;
        for (const Facing& facing : random_facings(kFacings)) {
            const glm::dvec3 expected = glm::inverse(colour::rec709_to_xyz()) *
                                        reference.reflected(samples_, facing.n, facing.v, roughness).xyz;
            turn(entity, facing);
            for (const bool four : {false, true}) {
                const glm::dvec3 difference = pixel(four) - expected;
                (four ? off.four : off.one) += glm::dot(difference, difference);
            }
            whole += glm::dot(expected, expected);
        }
        world_.destroy(entity);
        return {std::sqrt(off.one / whole), std::sqrt(off.four / whole)};
    }

    static nlohmann::json anodised_titanium() {
        return {{"film", {{"ior", 2.4}, {"thickness_nm", 110}}}, {"base", {{"ior", 2.5}, {"k", 3.3}}}};
    }
    static nlohmann::json soap_on_glass() {
        return {{"film", {{"ior", 1.33}, {"thickness_nm", 400}}}, {"base", {{"ior", 1.5}}}};
    }

    /// Relative RMS of the pixels' distance from drawn_radiance().
    double distance_from_formula(double roughness) {
        const auto [film, entity] = add_rough(soap_on_glass(), roughness);
        double off = 0.0;
        double whole = 0.0;
        for (const Facing& facing : random_facings(6)) {
            turn(entity, facing);
            for (const Reflections reflections : {Reflections::OneLookUp, Reflections::FourLookUps}) {
                const glm::dvec3 expected = glm::inverse(colour::rec709_to_xyz()) *
                                            drawn_radiance(film.table, film.material.range.thickest_nm, roughness,
                                                           environment_, facing.n, facing.v, reflections);
                const glm::dvec3 difference = pixel(reflections == Reflections::FourLookUps) - expected;
                off += glm::dot(difference, difference);
                whole += glm::dot(expected, expected);
            }
        }
        world_.destroy(entity);
        return std::sqrt(off / whole);
    }

 private:
    std::pair<CookedFilm, ecs::Entity> add_rough(nlohmann::json material, double roughness) {
        material["roughness"] = roughness;
        CookedFilm film = cook_film(material, "film.json");
        const ecs::Entity entity = add(square(), {.base_colour = glm::vec3(0.0F)});
        add_film(world_, entity, film, glm::inverse(colour::rec709_to_xyz()));
        return {std::move(film), entity};
    }

    /// At the square's centre.
    glm::dvec3 pixel(bool rough_reflections) {
        renderer_.set_effects({.rough_reflections = rough_reflections});
        return glm::dvec3(draw()[kSize / 2 * kSize + kSize / 2]);
    }

    /// The square's normal and the camera, which looks at its centre.
    void turn(ecs::Entity entity, const Facing& facing) {
        const glm::dvec3 tangent = glm::normalize(glm::cross(facing.n, facing.v));
        world_.get<scene::WorldMatrix>(entity).matrix =
            glm::mat4(glm::mat3(glm::dmat3(tangent, glm::cross(facing.n, tangent), facing.n)));
        camera_.eye = glm::vec3(facing.v * double{kEye});
    }

    lighting::LightSamples samples_;
    lighting::EnvironmentMap environment_;
};

TEST_F(RoughFilmPixel, IsWhatTheFormulaOnTheCpuGives) {
    ROWLAND_TEST_DATA(path, "probes/ennis_probulator.hdr");
    light_by(path);
    // 1 % for the cell of the engine's table of albedos, and cells of the environment in halves.
    for (const double roughness : {0.1, 0.5}) EXPECT_LE(distance_from_formula(roughness), 0.02) << roughness;
}

TEST_F(RoughFilmPixel, OfFourLookUpsIsNearerToTheSumOverMicrofacets) {
    ROWLAND_TEST_DATA(path, "probes/ennis_probulator.hdr");
    light_by(path);
    const Errors titanium = errors(anodised_titanium(), 0.6);
    EXPECT_LE(titanium.four, 0.08);
    EXPECT_LE(titanium.four, 0.6 * titanium.one);
    const Errors soap = errors(soap_on_glass(), 0.4);
    EXPECT_LE(soap.four, 0.04);
    EXPECT_LE(soap.four, 0.3 * soap.one);
}

TEST_F(RoughFilmPixel, UnderFourCapturedProbesIsAsFarOffAsThePageSays) {
    struct Row {
        const char* probe;
        std::array<double, 3> titanium;  ///< four look-ups, at roughness .2, .4 and .6
        std::array<double, 3> soap;
    };
    const std::array<Row, 4> measured = {{{"grace_probe.hdr", {0.14, 0.09, 0.10}, {0.57, 0.30, 0.15}},
                                          {"ennis_probulator.hdr", {0.06, 0.06, 0.08}, {0.06, 0.03, 0.08}},
                                          {"royal_esplanade_1k.hdr", {0.10, 0.13, 0.09}, {0.13, 0.13, 0.08}},
                                          {"blender_sunset.exr", {0.03, 0.08, 0.07}, {0.04, 0.04, 0.08}}}};
    for (const Row& row : measured) {
        ROWLAND_TEST_DATA(path, std::string("probes/") + row.probe);
        light_by(path);
        for (std::size_t i = 0; i < 3; ++i) {
            const double roughness = 0.2 * static_cast<double>(i + 1);
            const Errors titanium = errors(anodised_titanium(), roughness);
            const Errors soap = errors(soap_on_glass(), roughness);
            EXPECT_LE(titanium.four, row.titanium.at(i) + 0.01) << row.probe << " " << roughness;
            EXPECT_LE(soap.four, row.soap.at(i) + 0.01) << row.probe << " " << roughness;
            // At small roughness the lobe's shape matters little.
            EXPECT_LE(titanium.four, (roughness < 0.45 ? 1.0 : 0.6) * titanium.one + 0.015) << row.probe;
            EXPECT_LE(soap.four, (roughness < 0.25 ? 1.0 : 0.6) * soap.one + 0.015) << row.probe << " " << roughness;
        }
    }
}

}  // namespace
}  // namespace rowland::thin_film
