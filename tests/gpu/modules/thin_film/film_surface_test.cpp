// The film's shader against the table and the exact sum on the CPU.
#include "modules/thin_film/runtime/film_surface.h"

#include "modules/thin_film/module.h"
#include "tests/gpu/render_test.h"

namespace rowland::thin_film {
namespace {

/// White light comes with this colour, so that rows and columns of M show if exchanged.
const glm::dvec3 kLight(0.9, 0.5, 0.25);

class FilmPixel : public rowland::test::RenderTest {
 protected:
    FilmPixel() {
        register_module(renderer_);
        renderer_.set_probe(coloured_light());
    }

    static lighting::LightProbe coloured_light() {
        lighting::LightProbe probe = even_light(1.0F);
        for (std::size_t i = 0; i < probe.environment.halves.size(); ++i) {
            const std::uint16_t halves[] = {0x3B33, 0x3800, 0x3400};  // 0.9, 0.5, 0.25
            probe.environment.halves[i] = halves[i % 3];
        }
        return probe;
    }

    ecs::Entity add_film_square(const nlohmann::json& json) {
        const ecs::Entity entity = add(square(), {.base_colour = glm::vec3(0.0F)});
        cooked_ = cook_film(json, "film.json");
        add_film(world_, entity, cooked_, glm::inverse(colour::rec709_to_xyz()));
        return entity;
    }

    static constexpr double kRoughness = 0.35;
    static constexpr double kThickness_nm = 280.0;

    /// One thickness, and all roughnesses up to kRoughness, which it has.
    ecs::Entity add_film_of_all_roughnesses() {
        const ecs::Entity entity = add(square(), {.base_colour = glm::vec3(0.0F)});
        cooked_.material = parse_film_material(
            {{"film", {{"ior", 1.5}, {"thickness_nm", 400}}}, {"metal", "Cu"}, {"roughness", kRoughness}}, "film.json");
        cooked_.material.range.smoothest = 0.0;
        cooked_.material.range.roughest = 0.6;
        cooked_.table = bake_film(cooked_.material);
        add_film(world_, entity, cooked_, glm::inverse(colour::rec709_to_xyz()));
        world_.get<render::StandardMaterial>(entity).roughness = static_cast<float>(kRoughness);
        return entity;
    }

    /// 100 to 400 nm, of which a texture of 153/255 everywhere makes kThickness_nm.
    ecs::Entity add_textured_film(double smoothest) {
        const ecs::Entity entity = add(square(), {.base_colour = glm::vec3(0.0F)});
        cooked_.material = parse_film_material(
            {{"film", {{"ior", 1.5}, {"thickness_nm", 400}}}, {"metal", "Cu"}, {"roughness", kRoughness}}, "film.json");
        cooked_.material.range.thinnest_nm = 100.0;
        cooked_.material.range.smoothest = smoothest;
        cooked_.table = bake_film(cooked_.material);
        add_film(world_, entity, cooked_, glm::inverse(colour::rec709_to_xyz()));
        auto texel = std::make_shared<gpu::Texture>(gpu::TextureDesc{.format = gpu::Format::RGBA8});
        texel->upload(std::span<const std::uint8_t>(std::array<std::uint8_t, 4>{0, 153, 0, 255}));
        auto& surface = world_.get<FilmSurface>(entity);
        surface.minimum_thickness_nm = 100.0F;
        surface.thickness_texture.texture = std::move(texel);
        return entity;
    }

    glm::dvec3 view() const { return glm::normalize(glm::dvec3(camera_.eye)); }
    glm::dvec3 centre() { return glm::dvec3(draw()[kSize / 2 * kSize + kSize / 2]); }
    /// Rec.709 of what the table says.
    glm::dvec3 by_table(double cosine, double roughness, const glm::dvec3& light) const {
        const double thickness_nm = cooked_.material.range.thickest_nm;
        return glm::inverse(colour::rec709_to_xyz()) * (cooked_.table.at(cosine, thickness_nm, roughness) * light);
    }
    glm::dvec3 exact(double cosine, const glm::dvec3& light) const {
        const FilmColour colour(cooked_.material.film, colour::LightSpectra{});
        return glm::inverse(colour::rec709_to_xyz()) * (colour(cosine) * light);
    }

    CookedFilm cooked_;
};

void expect_near(const glm::dvec3& found, const glm::dvec3& expected, double tolerance) {
    const double scale = std::max({expected.r, expected.g, expected.b});
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], std::max(expected[c], 0.0), tolerance * scale) << c;
}

TEST_F(FilmPixel, OfASmoothFilmIsTheExactSumTimesTheLight) {
    for (const double thickness_nm : {0.0, 120.0, 470.0}) {
        const ecs::Entity entity = add_film_square(
            {{"film", {{"ior", 1.4}, {"thickness_nm", thickness_nm}}}, {"metal", "Cu"}, {"roughness", 0}});
        for (const glm::vec3& eye : {glm::vec3(0.0F, 0.0F, kEye), glm::vec3(2.6F, 1.0F, 0.9F)}) {
            camera_.eye = eye;
            // The engine's albedo of a smooth lobe is 1 to 5e-3.
            expect_near(centre(), exact(view().z, kLight), 6e-3);
        }
        world_.destroy(entity);
    }
}

TEST_F(FilmPixel, OfARoughFilmIsTheTablesMeanOverItsLobe) {
    const double roughness = 0.5;
    add_film_square(
        {{"film", {{"ior", 1.33}, {"thickness_nm", 500}}}, {"base", {{"ior", 1.5}}}, {"roughness", roughness}});
    const std::vector<glm::vec2> albedo = render::bake_brdf_table(64);
    camera_.eye = {1.5F, 0.4F, 1.2F};
    const double cosine = view().z;
    const auto column = static_cast<std::size_t>(cosine * 64.0);
    const glm::vec2 split = albedo[std::size_t{32} * 64 + column];
    // A cell of the engine's table of albedos, of which the nearest is taken, is 1 % wide here.
    expect_near(centre(), by_table(cosine, roughness, kLight) * static_cast<double>(split.x + split.y), 1e-2);
}

TEST_F(FilmPixel, OfAllRoughnessesReadsTheRowOfItsOwn) {
    add_film_of_all_roughnesses();
    camera_.eye = {2.0F, 0.0F, 1.5F};
    const double cosine = view().z;
    const glm::vec2 split = render::bake_brdf_table(
        64)[static_cast<std::size_t>(kRoughness * 64.0) * 64 + static_cast<std::size_t>(cosine * 64.0)];
    // A cell of the engine's table of albedos, of which the nearest is taken, is 1 % wide here.
    expect_near(centre(), by_table(cosine, kRoughness, kLight) * static_cast<double>(split.x + split.y), 1e-2);
}

TEST_F(FilmPixel, OfADirectionalLightIsSeenAtTheHalfVector) {
    renderer_.set_probe(even_light(0.0F));
    const double roughness = 0.35;
    add_film_square({{"film", {{"ior", 1.8}, {"thickness_nm", 300}}}, {"metal", "Ag"}, {"roughness", roughness}});
    const glm::dvec3 l = glm::normalize(glm::dvec3(-0.7, 0.2, 0.6));
    world_.add(world_.create(), scene::DirectionalLight{.direction = glm::vec3(l), .irradiance = {1.0F, 2.0F, 0.5F}});
    camera_.eye = {2.0F, 0.0F, 1.5F};
    const glm::dvec3 v = view();
    const double whole = rowland::test::reflected(l, {0.0, 0.0, 1.0}, v, glm::dvec3(1.0), 1.0, roughness).x;
    const glm::dvec3 light(1.0, 2.0, 0.5);
    // 1e-3 for each of the three columns of M that are stored in nine bits, and 1e-3 for the rest.
    expect_near(centre(), whole * exact(glm::dot(v, glm::normalize(l + v)), light), 4e-3);
}

TEST_F(FilmPixel, OfTexturedThicknessReadsTheLobeForTheProbeAndTheMirrorForADirectionalLight) {
    const glm::dvec3 l = glm::normalize(glm::dvec3(-0.7, 0.2, 0.6));
    camera_.eye = {2.0F, 0.0F, 1.5F};
    const glm::dvec3 v = view();
    for (const double smoothest : {kRoughness, 0.0}) {  // one roughness: its layer; several: the lobe's nodes
        const ecs::Entity entity = add_textured_film(smoothest);
        renderer_.set_probe(coloured_light());
        const glm::vec2 split = render::bake_brdf_table(
            64)[static_cast<std::size_t>(kRoughness * 64.0) * 64 + static_cast<std::size_t>(v.z * 64.0)];
        const glm::dmat3 to_rec709 = glm::inverse(colour::rec709_to_xyz());
        const double albedo = split.x + split.y;
        // A cell of the engine's table of albedos, of which the nearest is taken, is 1 % wide here.
        expect_near(centre(), to_rec709 * (cooked_.table.at(v.z, kThickness_nm, kRoughness) * kLight) * albedo, 1e-2);

        renderer_.set_probe(even_light(0.0F));
        const glm::dvec3 light(1.0, 2.0, 0.5);
        const ecs::Entity lamp = world_.create();
        world_.add(lamp, scene::DirectionalLight{.direction = glm::vec3(l), .irradiance = glm::vec3(light)});
        const double whole = rowland::test::reflected(l, {0.0, 0.0, 1.0}, v, glm::dvec3(1.0), 1.0, kRoughness).x;
        const glm::dmat3 mirror = cooked_.table.at(glm::dot(v, glm::normalize(l + v)), kThickness_nm, 0.0);
        expect_near(centre(), whole * (to_rec709 * (mirror * light)), 5e-3);
        world_.destroy(lamp);
        world_.destroy(entity);
    }
}

TEST_F(FilmPixel, NeverReflectsMoreThanAWhiteMetalWould) {
    for (const double roughness : {0.0, 0.3, 1.0}) {
        const ecs::Entity entity = add_film_square(
            {{"film", {{"ior", 2.4}, {"thickness_nm", 60}}}, {"metal", "Ag"}, {"roughness", roughness}});
        for (const glm::vec3& eye : {glm::vec3(0.0F, 0.0F, kEye), glm::vec3(2.9F, 0.0F, 0.25F)}) {
            camera_.eye = eye;
            const glm::dvec3 found = centre();
            EXPECT_LE(colour::luminance(found), colour::luminance(kLight) * 1.001) << roughness;
            EXPECT_GT(colour::luminance(found), 0.0);
        }
        world_.destroy(entity);
    }
}

}  // namespace
}  // namespace rowland::thin_film
