#include "engine/image/load.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "engine/image/exr.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test_data.h"
#include "tests/unit/engine/image/bytes.h"

namespace rowland::image {
namespace {

TEST(LoadImage, ContentDecidesNotTheName) {
    const test::TemporaryFolder folder;
    const auto path = folder.path() / "really_exr.hdr";
    write_exr(path, Image{1, 1, {glm::vec3(1, 2, 3)}});
    EXPECT_EQ(load_image(path).at(0, 0), glm::vec3(1, 2, 3));
}

TEST(LoadImage, ReadsRadiance) {
    ROWLAND_TEST_DATA(path, "probes/simple-rle.hdr");
    EXPECT_EQ(load_image(path).width, 8);
}

TEST(LoadImage, OtherFormatsAreRefusedByName) {
    try {
        decode_image(test::as_bytes("\x89PNG\r\n"), "photo.png");
        FAIL() << "was decoded";
    } catch (const Error& error) {
        EXPECT_EQ(error.info().file, "photo.png");
        EXPECT_THAT(error.what(), ::testing::HasSubstr("OpenEXR"));
    }
    EXPECT_THROW(decode_image({}, "empty"), Error);
    EXPECT_THROW(load_image("/nonexistent/x.hdr"), Error);
}

}  // namespace
}  // namespace rowland::image
