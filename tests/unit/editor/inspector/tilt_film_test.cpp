#include "editor/inspector/tilt_film.h"

#include <gmock/gmock.h>
#include <webp/demux.h>

#include <glm/geometric.hpp>

#include "engine/core/error.h"
#include "tests/support/folder_test.h"

namespace rowland::inspector {
namespace {

TEST(WebpAnimation, HoldsItsPicturesAndTimesAndRepeats) {
    WebpAnimation film(32, 24, 0.1);
    for (const int grey : {40, 120, 200})
        film.add(std::vector<std::uint8_t>(std::size_t{4} * 32 * 24, static_cast<std::uint8_t>(grey)));
    const std::vector<std::byte> bytes = film.finish();
    const WebPData data{reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
    const std::unique_ptr<WebPAnimDecoder, void (*)(WebPAnimDecoder*)> decoder(WebPAnimDecoderNew(&data, nullptr),
                                                                               WebPAnimDecoderDelete);
    ASSERT_TRUE(decoder);
    WebPAnimInfo info;
    ASSERT_TRUE(WebPAnimDecoderGetInfo(decoder.get(), &info));
    EXPECT_EQ(info.canvas_width, 32U);
    EXPECT_EQ(info.canvas_height, 24U);
    EXPECT_EQ(info.frame_count, 3U);
    EXPECT_EQ(info.loop_count, 0U);
    for (const int grey : {40, 120, 200}) {
        std::uint8_t* pixels = nullptr;
        int time_ms = 0;
        ASSERT_TRUE(WebPAnimDecoderGetNext(decoder.get(), &pixels, &time_ms));
        EXPECT_NEAR(pixels[std::ptrdiff_t{4} * 100], grey, 3);
        EXPECT_EQ(time_ms % 100, 0);
    }
}

TEST(HandTilt, IsClosedAndTurnsAFewTensOfDegreesToAllSides) {
    const auto normal = [](double phase) { return hand_tilt(phase) * glm::vec3(0.0F, 0.0F, 1.0F); };
    EXPECT_LT(glm::length(normal(0.0) - normal(1.0)), 1e-5F);
    const glm::vec3 rest = resting_tilt() * glm::vec3(0.0F, 0.0F, 1.0F);
    glm::vec3 least(1.0F);
    glm::vec3 most(-1.0F);
    for (int i = 0; i < 64; ++i) {
        const glm::vec3 away = glm::inverse(resting_tilt()) * normal(i / 64.0);
        least = glm::min(least, away);
        most = glm::max(most, away);
        EXPECT_LT(glm::length(normal(i / 64.0) - normal((i + 1) / 64.0)), 0.1F);
        EXPECT_GT(glm::dot(rest, normal(i / 64.0)), std::cos(glm::radians(26.0F)));
    }
    for (const int axis : {0, 1}) {
        EXPECT_GT(most[axis], std::sin(glm::radians(14.0F)));
        EXPECT_LT(least[axis], -std::sin(glm::radians(14.0F)));
    }
}

class FilmCheck : public test::FolderTest {};

TEST_F(FilmCheck, RefusesWhatNoFilmCanBe) {
    const FilmSettings good{.path = path("film.webp"), .pngs = true};
    EXPECT_NO_THROW(check_film(good));
    const auto expect_refused = [&](const auto& change) {
        FilmSettings bad = good;
        change(bad);
        EXPECT_THROW(check_film(bad), Error);
    };
    expect_refused([](FilmSettings& film) { film.width = 8; });
    expect_refused([](FilmSettings& film) { film.height = 100000; });
    expect_refused([](FilmSettings& film) { film.seconds = 0.0; });
    expect_refused([](FilmSettings& film) { film.pictures_per_second = 1000; });
    expect_refused([](FilmSettings& film) { film.path.replace_extension(".gif"); });
    std::filesystem::create_directory(path("film"));
    EXPECT_THROW(check_film(good), Error);
}

}  // namespace
}  // namespace rowland::inspector
