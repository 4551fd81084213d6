#include "engine/lighting/mapping.h"

#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "engine/image/load.h"
#include "engine/lighting/probe_image.h"
#include "tests/support/test_data.h"

namespace rowland::lighting {
namespace {

/// A square image whose circle is bright, with a caption of `caption` rows in its upper left corner.
image::Image angular_map(int size, float corner, int caption = 0) {
    image::Image image = image::make_image(size, size);
    for (int row = 0; row < size; ++row)
        for (int column = 0; column < size; ++column) {
            const bool inside = std::hypot(2 * column + 1 - size, 2 * row + 1 - size) <= size;
            image.at(column, row) = glm::vec3(inside ? 0.5F : row < caption && column < size / 4 ? 1.0F : corner);
        }
    return image;
}

TEST(RecognisedMapping, ASquareImageThatIsBlackOutsideItsCircleIsAnAngularMap) {
    EXPECT_EQ(recognised_mapping(angular_map(64, 0.0F), "a.hdr"), Mapping::Angular);
    EXPECT_EQ(recognised_mapping(angular_map(64, 0.0F, 4), "a.hdr"), Mapping::Angular) << "a caption in a corner";
    EXPECT_EQ(ProbeImage(angular_map(64, 0.0F), Mapping::Auto).mapping(), Mapping::Angular);
}

TEST(RecognisedMapping, AnImageThatIsNotSquareIsEquirectangular) {
    for (const glm::ivec2 size : {glm::ivec2(64, 32), {1, 1}, {8, 2}, {63, 64}}) {
        const image::Image image = image::make_image(size.x, size.y);
        EXPECT_EQ(recognised_mapping(image, "a.hdr"), Mapping::Equirectangular) << size.x << " x " << size.y;
    }
}

TEST(RecognisedMapping, ASquareImageWithLightInItsCornersIsRefusedByName) {
    for (const int size : {2, 3, 64}) try {
            recognised_mapping(angular_map(size, 0.4F), "a.hdr");
            ADD_FAILURE() << size;
        } catch (const Error& error) {
            EXPECT_EQ(error.info().file, "a.hdr");
            EXPECT_NE(error.info().remedy.find("\"angular\""), std::string::npos);
        }
}

TEST(RecognisedMapping, PublishedProbesAreRecognised) {
    ROWLAND_TEST_DATA(grace, "probes/grace_probe.hdr");
    ROWLAND_TEST_DATA(beach, "probes/beach_probe.hdr");
    ROWLAND_TEST_DATA(venice, "probes/venice_sunset_256.hdr");
    EXPECT_EQ(recognised_mapping(image::load_image(grace), "grace"), Mapping::Angular);
    EXPECT_EQ(recognised_mapping(image::load_image(beach), "beach"), Mapping::Angular);
    EXPECT_EQ(recognised_mapping(image::load_image(venice), "venice"), Mapping::Equirectangular);
}

TEST(RecognisedMapping, NamesAreReadAsTheyAreWritten) {
    for (const Mapping mapping : {Mapping::Equirectangular, Mapping::Angular, Mapping::Auto})
        EXPECT_EQ(parse_mapping(mapping_name(mapping)), mapping);
}

}  // namespace
}  // namespace rowland::lighting
