#include "editor/inspector/foil_studio.h"

#include <gmock/gmock.h>

#include <algorithm>

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
        draw(1);  // the studio sees what was edited
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
    FoilWall& wall = foil().wall();
    const auto pictures = [&](const glm::quat& tilt) {
        wall.draw(tilt);
        std::vector<std::vector<glm::vec4>> all;
        for (std::size_t i = 0; i < diffraction::foil::foil_type_names().size(); ++i) {
            EXPECT_NE(wall.picture(i), nullptr);
            if (wall.picture(i) != nullptr) all.push_back(wall.picture(i)->read());
        }
        return all;
    };
    const auto facing = pictures(glm::quat(1.0F, 0.0F, 0.0F, 0.0F));
    for (std::size_t i = 0; i < facing.size(); ++i)
        EXPECT_EQ(std::ranges::count(facing, facing[i]), 1) << diffraction::foil::foil_type_names()[i];
    EXPECT_NE(pictures(hand_tilt(0.2)), facing);
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
    // Under an even sky all types look the same; a rainbow has one direction of grooves.
    const auto surface = foil().card().surfaces.front();
    foil().recipe().set_type("rainbow");
    finish_card();
    EXPECT_TRUE(surface->grooves);
    EXPECT_FALSE(foil().card().surfaces.front()->grooves);
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
