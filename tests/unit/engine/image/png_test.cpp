#include "engine/image/png.h"

#include <gtest/gtest.h>
#include <stb_image.h>

#include <vector>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/image/byte_image.h"
#include "tests/support/temporary_folder.h"

namespace rowland::image {
namespace {

TEST(Png, HoldsTheBytesItWasGiven) {
    const test::TemporaryFolder folder;
    std::vector<std::uint8_t> rgb(std::size_t{5} * 3 * 3);
    for (std::size_t i = 0; i < rgb.size(); ++i) rgb[i] = static_cast<std::uint8_t>(i * 37);
    const auto path = folder.path() / "a.png";
    write_png(path, 5, 3, rgb);
    int width = 0;
    int height = 0;
    int channels = 0;
    std::uint8_t* read = stbi_load(path.c_str(), &width, &height, &channels, 0);
    ASSERT_NE(read, nullptr);
    EXPECT_EQ(width, 5);
    EXPECT_EQ(height, 3);
    EXPECT_EQ(channels, 3);
    EXPECT_EQ(std::vector<std::uint8_t>(read, read + rgb.size()), rgb);
    stbi_image_free(read);
}

TEST(Png, EncodedAlphaComesBack) {
    std::vector<std::uint8_t> rgba(std::size_t{7} * 2 * 4);
    for (std::size_t i = 0; i < rgba.size(); ++i) rgba[i] = static_cast<std::uint8_t>(i * 41);
    const std::vector<std::byte> bytes = encode_png(7, 2, 4, rgba);
    EXPECT_EQ(bytes, encode_png(7, 2, 4, rgba));
    const ByteImage read = decode_byte_image(bytes, "a.png");
    EXPECT_EQ(read.width, 7);
    EXPECT_EQ(read.height, 2);
    EXPECT_EQ(read.rgba, rgba);
}

TEST(Png, FailingToWriteIsASystemError) {
    const test::TemporaryFolder folder;
    write_file_atomic(folder.path() / "file", std::string_view("x"));
    const std::vector<std::uint8_t> rgb(3);
    try {
        write_png(folder.path() / "file" / "a.png", 1, 1, rgb);
        FAIL() << "was written below a file";
    } catch (const Error& error) {
        EXPECT_EQ(error.info().fault, Fault::System);
    }
}

}  // namespace
}  // namespace rowland::image
