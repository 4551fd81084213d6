#include "modules/thin_film/asset/film_material.h"

#include "engine/core/file.h"
#include "modules/thin_film/asset/gltf_iridescence.h"
#include "tests/support/expect.h"
#include "tests/support/files.h"

namespace rowland::thin_film {
namespace {

FilmMaterial parsed(const std::string& text) {
    return parse_film_material(parse_json(text, "film.json"), "film.json");
}

void expect_refused(const std::string& text, const std::vector<std::string>& parts) {
    const std::string message = rowland::test::message_of([&] { parsed(text); });
    for (const std::string& part : parts) EXPECT_NE(message.find(part), std::string::npos) << part << " in " << message;
}

TEST(FilmMaterial, ReadsFilmBaseAndRoughness) {
    const FilmMaterial soap =
        parsed(R"({"film": {"ior": 1.33, "thickness_nm": 400}, "base": {"ior": 1.5}, "roughness": 0.2})");
    EXPECT_EQ(soap.film, (Film{.layers = {{1.33, 400.0}}, .base = std::complex<double>(1.5)}));
    EXPECT_EQ(soap.range.thinnest_nm, 400.0);
    EXPECT_EQ(soap.range.roughest, 0.2);
    const FilmMaterial layers = parsed(
        R"({"film": [{"ior": 1.4, "thickness_nm": 90}, {"ior": 2.3, "k": 0.1, "thickness_nm": 60}], "metal": "Al"})");
    ASSERT_EQ(layers.film.layers.size(), 2U);
    EXPECT_EQ(layers.film.layers[1], (Layer{{2.3, 0.1}, 60.0}));
    EXPECT_EQ(layers.film.base, Base(colour::Metal::Al));
}

TEST(FilmMaterial, RefusesWhatIsNoFilmWithItsLocation) {
    expect_refused(R"({"film": {"ior": 0.9, "thickness_nm": 400}, "metal": "Al"})", {"film.json", "/film/ior", "0.9"});
    expect_refused(R"({"film": {"ior": 1.3, "thickness_nm": -1}, "metal": "Al"})", {"/film/thickness_nm", "-1"});
    expect_refused(R"({"film": {"ior": 1.3, "thickness_nm": 1}})", {"base"});
    expect_refused(R"({"film": {"ior": 1.3, "thickness_nm": 1}, "metal": "Al", "base": {"ior": 1.5}})", {"/base"});
    expect_refused(R"({"film": [], "metal": "Al"})", {"/film", "0 objects"});
    expect_refused(R"({"film": {"ior": 1.3, "thickness_nm": 1}, "metal": "Al", "roughnes": 1})", {"roughness"});
}

TEST(CookedFilm, IsReadAsItWasWritten) {
    const nlohmann::json json =
        parse_json(R"({"film": {"ior": 1.33, "thickness_nm": 400}, "metal": "Au", "roughness": 0.3})", "film.json");
    const CookedFilm cooked = cook_film(json, "film.json");
    const CookedFilm read = read_cooked_film(write_cooked_film(json, cooked), "film.film");
    EXPECT_EQ(read.table.values, cooked.table.values);
    EXPECT_EQ(read.table.error.largest, cooked.table.error.largest);
    EXPECT_EQ(read.table.at(0.7, 400.0, 0.3), cooked.table.at(0.7, 400.0, 0.3));
    EXPECT_NE(describe(read).find("table_error_largest: "), std::string::npos);
}

TEST(CookedFilm, RefusesATableOfAnotherSize) {
    const nlohmann::json json = parse_json(R"({"film": {"ior": 1.33, "thickness_nm": 400}, "metal": "Au"})", "f.json");
    CookedFilm cooked = cook_film(json, "f.json");
    cooked.table.values.pop_back();
    const std::vector<std::byte> bytes = write_cooked_film(json, cooked);
    EXPECT_NE(rowland::test::message_of([&] { read_cooked_film(bytes, "f.film"); }).find("128 nodes"),
              std::string::npos);
}

TEST(GltfIridescence, HasTheExtensionsDefaults) {
    const GltfIridescence read = parse_gltf_iridescence(parse_json("{}", "a.gltf"), "a.gltf", "");
    EXPECT_EQ(read.factor, 0.0);
    EXPECT_EQ(read.ior, 1.3);
    EXPECT_EQ(read.minimum_thickness_nm, 100.0);
    EXPECT_EQ(read.maximum_thickness_nm, 400.0);
    EXPECT_FALSE(read.factor_texture || read.thickness_texture || read.base);
}

TEST(GltfIridescence, ReadsTexturesTheirTransformsAndTheBaseOfItsExtras) {
    const GltfIridescence read = parse_gltf_iridescence(
        parse_json(R"({"iridescenceFactor": 0.7, "iridescenceTexture": {"index": 2, "texCoord": 1},
            "iridescenceThicknessTexture": {"index": 3, "extensions": {"KHR_texture_transform": {"scale": [2, 3]}}},
            "extras": {"base": {"ior": 2.5, "k": 3.3}, "note": "titanium"}, "extensions": {"OTHER": {}}})",
                   "a.gltf"),
        "a.gltf", "");
    ASSERT_TRUE(read.factor_texture && read.thickness_texture && read.base);
    EXPECT_EQ(read.factor_texture->uv_set, 1);
    EXPECT_EQ(read.thickness_texture->texture, 3U);
    EXPECT_EQ(read.thickness_texture->transform.scale, glm::vec2(2.0F, 3.0F));
    EXPECT_EQ(*read.base, Base(std::complex<double>(2.5, 3.3)));
}

TEST(GltfObject, HoldsTheFilmOfEveryShippedMaterial) {
    int films = 0;
    for (const auto& entry : std::filesystem::directory_iterator(rowland::test::content_path("materials"))) {
        if (entry.path().extension() != ".json") continue;
        const auto source = nlohmann::ordered_json::parse(read_text_file(entry.path(), 1 << 20));
        if (!source.contains("film")) continue;
        const FilmMaterial expected = parse_film_material(nlohmann::json(source), "m.json");
        const GltfIridescence held =
            parse_gltf_iridescence(nlohmann::json(gltf_object(source, "m.json")), "a.gltf", "");
        scene::MaterialDescription surface;
        surface.roughness = static_cast<float>(expected.range.roughest);
        const FilmMaterial film = film_material(held, surface, "a.gltf", "").value();
        EXPECT_EQ(film.film, expected.film) << entry.path();
        EXPECT_FLOAT_EQ(static_cast<float>(film.range.roughest), static_cast<float>(expected.range.roughest));
        ++films;
    }
    EXPECT_GE(films, 4);
}

}  // namespace
}  // namespace rowland::thin_film
