#include <gmock/gmock.h>
#include <png.h>

#include <array>
#include <cstring>

#include "engine/core/file.h"
#include "engine/image/byte_image.h"
#include "tests/support/expect.h"
#include "tests/support/files.h"
#include "tests/unit/engine/image/image_bytes.h"

namespace rowland::image {

namespace {

using testing::HasSubstr;

/// A PNG as libpng writes it from values of libpng's `format`.
std::vector<std::byte> encoded_png(std::uint32_t width, std::uint32_t height, std::uint32_t format, const void* values,
                                   const void* colour_map = nullptr, std::uint32_t colours = 0) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = width;
    image.height = height;
    image.format = format;
    image.colormap_entries = colours;
    png_alloc_size_t size = 0;
    EXPECT_NE(png_image_write_get_memory_size(image, size, 0, values, 0, colour_map), 0) << image.message;
    std::vector<std::byte> bytes(size);
    EXPECT_NE(png_image_write_to_memory(&image, bytes.data(), &size, 0, values, 0, colour_map), 0) << image.message;
    bytes.resize(size);
    return bytes;
}

/// A chunk put between a PNG's header and the rest.
std::vector<std::byte> with_chunk(const std::vector<std::byte>& png, const std::string& type, const std::string& data) {
    const auto big_endian = [](std::uint32_t x) {
        return std::string{static_cast<char>(x >> 24U), static_cast<char>(x >> 16U), static_cast<char>(x >> 8U),
                           static_cast<char>(x)};
    };
    std::uint32_t crc = 0xFFFFFFFFU;  // PNG specification, annex D
    for (const char c : type + data) {
        crc ^= static_cast<std::uint8_t>(c);
        for (int i = 0; i < 8; ++i) crc = (crc & 1U) != 0 ? 0xEDB88320U ^ (crc >> 1U) : crc >> 1U;
    }
    const std::string chunk =
        big_endian(static_cast<std::uint32_t>(data.size())) + type + data + big_endian(crc ^ 0xFFFFFFFFU);
    constexpr std::size_t kHeaderEnd = 8 + 25;
    std::vector<std::byte> bytes(png.begin(), png.begin() + kHeaderEnd);
    for (const char c : chunk) bytes.push_back(static_cast<std::byte>(c));
    bytes.insert(bytes.end(), png.begin() + kHeaderEnd, png.end());
    return bytes;
}

/// The 3 × 2 picture of these tests.
std::array<std::uint8_t, 18> picture() {
    return {255, 0, 0, 0, 255, 0, 0, 0, 255, 10, 20, 30, 128, 128, 128, 255, 255, 255};
}

TEST(ByteImage, PngKeepsItsBytesAndGetsOpaqueAlpha) {
    const test::TemporaryFolder folder;
    const auto rgb = picture();
    write_png(folder.path() / "a.png", 3, 2, rgb);
    const auto bytes = read_file(folder.path() / "a.png", 1 << 20);
    const ByteImage image = decode_byte_image(bytes, "a.png");
    EXPECT_EQ(image.width, 3);
    EXPECT_EQ(image.height, 2);
    ASSERT_EQ(image.rgba.size(), 24U);
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(image.rgba[4 * i + c], rgb[3 * i + c]);
        EXPECT_EQ(image.rgba[4 * i + 3], 255);
    }
    const ByteImageSize size = byte_image_size(bytes, "a.png");
    EXPECT_EQ(size.width, 3);
    EXPECT_EQ(size.height, 2);
}

TEST(ByteImage, AlphaIsStraight) {
    const std::array<std::uint8_t, 8> rgba = {200, 100, 50, 128, 9, 8, 7, 0};
    const ByteImage image = decode_byte_image(encoded_png(2, 1, PNG_FORMAT_RGBA, rgba.data()), "a.png");
    EXPECT_THAT(image.rgba, testing::ElementsAreArray(rgba));
}

TEST(ByteImage, GreyAndPaletteBecomeColours) {
    const std::array<std::uint8_t, 2> grey = {7, 250};
    EXPECT_THAT(decode_byte_image(encoded_png(2, 1, PNG_FORMAT_GRAY, grey.data()), "a.png").rgba,
                testing::ElementsAre(7, 7, 7, 255, 250, 250, 250, 255));
    const std::array<std::uint8_t, 6> palette = {1, 2, 3, 40, 50, 60};
    const std::array<std::uint8_t, 2> indices = {1, 0};
    EXPECT_THAT(
        decode_byte_image(encoded_png(2, 1, PNG_FORMAT_RGB_COLORMAP, indices.data(), palette.data(), 2), "a.png").rgba,
        testing::ElementsAre(40, 50, 60, 255, 1, 2, 3, 255));
}

TEST(ByteImage, SixteenBitsAreCutNotReencoded) {
    // libpng's writer takes 16 bits for linear and says so in a gAMA chunk.
    const std::array<std::uint16_t, 1> grey = {static_cast<std::uint16_t>(0x8080)};
    const auto bytes = encoded_png(1, 1, PNG_FORMAT_LINEAR_Y, grey.data());
    ASSERT_EQ(bytes.at(24), std::byte{16}) << "bits a channel";
    EXPECT_THAT(decode_byte_image(bytes, "a.png").rgba, testing::ElementsAre(0x80, 0x80, 0x80, 255));
}

TEST(ByteImage, SixteenBitsAreKeptWhereTheyAreAskedFor) {
    std::vector<std::uint16_t> rgb(std::size_t{300} * 5 * 3);
    for (std::size_t i = 0; i < rgb.size(); ++i) rgb[i] = static_cast<std::uint16_t>(i * 40503);
    for (const PngEffort effort : {PngEffort::Small, PngEffort::Fast}) {
        const std::vector<std::byte> bytes = encode_png(300, 5, 3, rgb, effort);
        EXPECT_EQ(bytes, encode_png(300, 5, 3, rgb, effort));
        const ByteImage image = decode_byte_image(bytes, "a.png", Depth::OfFile);
        ASSERT_EQ(image.rgba16.size(), std::size_t{300} * 5 * 4);
        for (std::size_t i = 0; i < rgb.size(); ++i) {
            ASSERT_EQ(image.rgba16[i / 3 * 4 + i % 3], rgb[i]);
            ASSERT_EQ(image.value(i / 3 * 4 + i % 3), rgb[i] / 65535.0);
        }
        EXPECT_EQ(image.rgba16[3], 65535);
        // The 8 bits are the same, whether 16 were asked for or not.
        const ByteImage cut = decode_byte_image(bytes, "a.png");
        EXPECT_EQ(cut.rgba, image.rgba);
        EXPECT_TRUE(cut.rgba16.empty());
    }
}

TEST(ByteImage, EightBitsStayEightWhereSixteenAreAskedFor) {
    const auto rgb = picture();
    const ByteImage image = decode_byte_image(encoded_png(3, 2, PNG_FORMAT_RGB, rgb.data()), "a.png", Depth::OfFile);
    EXPECT_TRUE(image.rgba16.empty());
    EXPECT_EQ(image.value(4), 0.0);
    EXPECT_EQ(image.value(5), 1.0);
    EXPECT_EQ(image.value(12), 10 / 255.0);
}

TEST(ByteImage, InterlacedPicturesAreWhole) {
    std::vector<std::uint8_t> bytes;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_set_write_fn(
        png, &bytes,
        [](png_structp of, png_bytep data, std::size_t size) {
            auto* to = static_cast<std::vector<std::uint8_t>*>(png_get_io_ptr(of));
            to->insert(to->end(), data, data + size);
        },
        nullptr);
    png_set_IHDR(png, info, 3, 2, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_ADAM7, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, info);
    auto rgb = picture();
    std::array<png_bytep, 2> rows = {rgb.data(), rgb.data() + 9};
    png_write_image(png, rows.data());
    png_write_end(png, nullptr);
    png_destroy_write_struct(&png, &info);
    const ByteImage image = decode_byte_image(std::as_bytes(std::span(bytes)), "a.png");
    for (std::size_t i = 0; i < rgb.size(); ++i) EXPECT_EQ(image.rgba[i / 3 * 4 + i % 3], rgb[i]);
}

TEST(ByteImage, JpegsOfInksAreRefusedByName) {
    const std::vector<std::uint8_t> cmyk(std::size_t{16} * 16 * 4, 90);
    EXPECT_THAT(test::message_of([&] { decode_byte_image(test::encoded_cmyk_jpeg(16, 16, cmyk), "a.jpg"); }),
                HasSubstr("a.jpg: a JPEG in CMYK; expected RGB or grey; convert the image to sRGB"));
}

TEST(ByteImage, GammaOfTheFileIsIgnored) {
    const auto rgb = picture();
    const auto plain = encoded_png(3, 2, PNG_FORMAT_RGB, rgb.data());
    // Linear, gamma 1.0: libpng would encode it.
    const auto linear = with_chunk(plain, "gAMA", std::string("\x00\x01\x86\xA0", 4));
    ASSERT_NE(plain, linear);
    EXPECT_EQ(decode_byte_image(linear, "a.png").rgba, decode_byte_image(plain, "a.png").rgba);
}

TEST(ByteImage, JpegIsReadWithinItsQuantisation) {
    std::vector<std::uint8_t> rgb;
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x)
            for (const int c : {x * 16, y * 16, 100}) rgb.push_back(static_cast<std::uint8_t>(c));
    const ByteImage image = decode_byte_image(test::encoded_jpeg(16, 16, rgb), "a.jpg");
    ASSERT_EQ(image.rgba.size(), 16U * 16U * 4U);
    for (std::size_t i = 0; i < 256; ++i) {
        // Quality 100 divides by 1: half a step of each transform coefficient and of each conversion of colours.
        for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(image.rgba[4 * i + c], rgb[3 * i + c], 3) << i;
        EXPECT_EQ(image.rgba[4 * i + 3], 255);
    }
}

TEST(ByteImage, CutFilesAreRefused) {
    ROWLAND_TEST_DATA(path, "gltf/valid/Duck/glTF/DuckCM.png");
    const auto png = read_file(path, 1 << 20);
    std::vector<std::uint8_t> noise(std::size_t{64} * 64 * 3);
    for (std::size_t i = 0; i < noise.size(); ++i) noise[i] = static_cast<std::uint8_t>(i * i * 31 >> 3U);
    const auto jpeg = test::encoded_jpeg(64, 64, noise);
    for (const auto& whole : {png, jpeg}) {
        EXPECT_NO_THROW(decode_byte_image(whole, "a"));
        // The end of a JPEG is its marker, without which nothing is lost.
        for (std::size_t length = 0; length + 16 < whole.size(); length += whole.size() / 50)
            EXPECT_THROW(decode_byte_image(std::span(whole).first(length), "a"), Error) << length;
    }
}

TEST(ByteImage, SizesAreCheckedBeforeAnythingIsAllocated) {
    const auto rgb = picture();
    std::vector<std::byte> png = encoded_png(3, 2, PNG_FORMAT_RGB, rgb.data());
    // The width, in the first chunk, made 2^31 - 1.
    for (std::size_t i = 0; i < 4; ++i) png[16 + i] = static_cast<std::byte>(i == 0 ? 0x7F : 0xFF);
    EXPECT_THAT(test::message_of([&] { decode_byte_image(png, "a.png"); }), HasSubstr("2147483647 x 2 texels"));
    std::vector<std::byte> jpeg = test::encoded_jpeg(3, 2, rgb);
    const std::string marker = "\xFF\xC0";
    for (std::size_t i = 0; i + 9 < jpeg.size(); ++i) {
        if (std::memcmp(&jpeg[i], marker.data(), 2) != 0) continue;
        for (const std::size_t side : {5U, 7U}) {  // the height and the width, 60000
            jpeg[i + side] = std::byte{0xEA};
            jpeg[i + side + 1] = std::byte{0x60};
        }
    }
    EXPECT_THAT(test::message_of([&] { decode_byte_image(jpeg, "a.jpg"); }), HasSubstr("60000 x 60000 texels"));
}

TEST(ByteImage, ImageThatItsBytesCannotHoldIsRefused) {
    const auto rgb = picture();
    std::vector<std::byte> png = encoded_png(3, 2, PNG_FORMAT_RGB, rgb.data());
    png[18] = std::byte{0x20};  // 8195 texels wide
    png[22] = std::byte{0x20};  // and 8194 high: 64 MiB from a hundred bytes
    EXPECT_THAT(test::message_of([&] { decode_byte_image(png, "a.png"); }), HasSubstr("8195 x 8194 texels in"));
    // The best that deflate can do is let through.
    const std::vector<std::uint8_t> blank(std::size_t{2048} * 2048, 255);
    const auto best = encoded_png(2048, 2048, PNG_FORMAT_GRAY, blank.data());
    EXPECT_EQ(decode_byte_image(best, "a.png").width, 2048);
    const std::vector<std::uint8_t> blank_rgb(std::size_t{1024} * 1024 * 3, 128);
    EXPECT_EQ(decode_byte_image(test::encoded_jpeg(1024, 1024, blank_rgb), "a.jpg").width, 1024);
}

TEST(ByteImage, OtherFormatsAreRefusedByName) {
    EXPECT_THAT(test::message_of([] { decode_byte_image({}, "a"); }), HasSubstr("a: an empty image"));
    EXPECT_THAT(test::message_of([] { decode_byte_image(test::bytes_of("RIFF....WEBP"), "a"); }),
                HasSubstr("expected PNG or JPEG"));
    EXPECT_THAT(test::message_of([] { byte_image_size(test::bytes_of("\xABKTX 20\xBB"), "a"); }),
                HasSubstr("expected PNG or JPEG"));
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

}  // namespace

}  // namespace rowland::image
