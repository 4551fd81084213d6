#include "editor/inspector/foil_studio.h"

#include <gmock/gmock.h>

#include "engine/image/byte_image.h"
#include "tests/unit/editor/inspector/small_session.h"

namespace rowland::inspector {
namespace {

class FoilSession : public SmallSession {
 protected:
    FoilSession() : SmallSession("") {
        write_picture("art.png", 48, 64);
        session_.open(path("art.png"));
    }

    void write_picture(const std::string& name, int width, int height) {
        const std::vector<std::uint8_t> rgba(std::size_t{4} * static_cast<std::size_t>(width * height), 60);
        write_file_atomic(path(name), image::encode_png(width, height, 4, rgba));
    }
    FoilStudio& foil() { return *session_.foil; }
    void finish_card() {
        draw_until([&] { return std::string_view(foil().shown()) == "full" && !session_.busy(); });
        draw(3);
    }
    const FilmSettings film_{
        .path = path("film.webp"), .width = 32, .height = 32, .seconds = 1.0, .pictures_per_second = 3, .pngs = true};
};

TEST_F(FoilSession, ADroppedPictureBecomesACardWithAllTypesBesideItWhichARefusedOneKeeps) {
    ASSERT_TRUE(session_.foil);
    foil().recipe().set(*std::ranges::find(foil().recipe().fields(), "/texture_px", &Field::pointer), 512);
    finish_card();
    const CookedSurfaces& wall = foil().wall().surfaces();
    ASSERT_EQ(wall.size(), diffraction::foil::foil_type_names().size());
    EXPECT_EQ(wall[3]->material, wall[4]->material) << "tiles and hexagons have the same grating";
    EXPECT_NE(wall[0]->material, wall[3]->material);
    const auto card = display();
    write_picture("dot.png", 1, 1);
    session_.open(path("dot.png"));
    draw_until([&] { return !foil().refusal().empty(); });
    const Field* refused = foil().recipe().field_of(foil().refusal());
    ASSERT_NE(refused, nullptr);
    EXPECT_EQ(refused->pointer, "/artwork");
    draw(3);
    EXPECT_EQ(display(), card);
    foil().recipe().undo();
    finish_card();
    EXPECT_EQ(foil().refusal(), "");
    // Under an even sky all types look the same.
    const auto surface = foil().card().surfaces.front();
    foil().recipe().set_type("rainbow");
    finish_card();
    EXPECT_NE(foil().card().surfaces.front()->material, surface->material);
    session_.open(path("m.json"));
    EXPECT_FALSE(session_.foil);
}

TEST_F(FoilSession, AFilmIsWrittenWholeOrNotAtAll) {
    finish_card();
    const auto begin = [&] {
        foil().begin_film(config_, film_, session_.view.card_inputs({1, 1}, card_camera(0.41F)));
        ASSERT_NE(foil().film(), nullptr);
        foil().film_step();
    };
    begin();
    foil().cancel_film();
    for (const char* name : {"film.webp", "film", "film.part"}) EXPECT_FALSE(std::filesystem::exists(path(name)));
    begin();
    foil().film_step();
    EXPECT_FALSE(std::filesystem::exists(path("film.webp")));
    foil().film_step();
    EXPECT_EQ(foil().film(), nullptr);
    EXPECT_TRUE(std::filesystem::exists(path("film.webp")));
    EXPECT_NE(text("film/0000.png"), text("film/0001.png"));
    EXPECT_FALSE(std::filesystem::exists(path("film.part")));
}

}  // namespace
}  // namespace rowland::inspector
