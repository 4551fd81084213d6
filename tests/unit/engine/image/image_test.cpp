#include <gmock/gmock.h>

#include <array>
#include <cstdlib>
#include <cstring>

#include "engine/core/file.h"
#include "engine/image/byte_image.h"
#include "engine/image/exr.h"
#include "engine/image/image.h"
#include "tests/support/environment.h"
#include "tests/support/expect.h"
#include "tests/support/files.h"
#include "tests/unit/engine/image/image_bytes.h"

namespace rowland::image {

namespace {

using test::message_of;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr std::uint64_t kMebibyte = 1 << 20;
const auto kRefused = AllOf(HasSubstr("MiB to decode"), HasSubstr("ROWLAND_IMAGE_MEMORY"));

/// Sets the variable while it lives.
class MemoryVariable {
 public:
    explicit MemoryVariable(const char* value) { test::set_variable("ROWLAND_IMAGE_MEMORY", value); }
    ~MemoryVariable() { test::set_variable("ROWLAND_IMAGE_MEMORY", std::nullopt); }
    MemoryVariable(const MemoryVariable&) = delete;
    MemoryVariable& operator=(const MemoryVariable&) = delete;
};

/// A Radiance picture of one radiance in the old encoding, which repeats a texel any number of times: 12 bytes per row.
std::string old_runs(int width, int height) {
    const auto texel = [](int count) { return std::string{1, 1, 1, static_cast<char>(count)}; };
    std::string row = "\x80\x80\x80\x80";
    for (int left = width - 1; left > 0; left >>= 8) row += texel(left & 0xff);
    std::string file =
        "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) + " +X " + std::to_string(width) + "\n";
    for (int y = 0; y < height; ++y) file += row;
    return file;
}

/// What SECURITY.md promises of a file of up to 2 MB is 512 MB; a program takes some of that anyway.
TEST(ImageLimits, MemoryIsInProportionToTheFile) {
    EXPECT_EQ(decoded_limit(0), 400 * kMebibyte);
    EXPECT_EQ(decoded_limit(2 * kMebibyte), 400 * kMebibyte);
    EXPECT_EQ(decoded_limit(8 * kMebibyte), std::uint64_t{192} * 8 * kMebibyte);
    EXPECT_THAT(message_of([] { check_decoded_bytes(16384, 8192, 12 * kMaximumTexels, 801'000, "a.exr"); }),
                AllOf(HasSubstr("a.exr: an image of 16384 x 8192 texels in 801000 bytes, which takes 1536 MiB"),
                      HasSubstr("at most 400 MiB"), kRefused));
}

TEST(ImageLimits, VariableRaisesTheMemory) {
    const MemoryVariable raised("2000");
    EXPECT_EQ(decoded_limit(0), 2000 * kMebibyte);
    EXPECT_NO_THROW(check_decoded_bytes(16384, 8192, 12 * kMaximumTexels, 801'000, "a.exr"));
}

TEST(ImageLimits, VariableThatIsNoSizeIsRefused) {
    for (const char* value : {"", "x", "4x", "-1", "0", "399", "1e9", "nan", "99999999999999999999"}) {
        if (*value == '\0' && !rowland::test::has_posix_files()) continue;  // no variable there is empty
        const MemoryVariable bad(value);
        EXPECT_THAT(message_of([] { decoded_limit(0); }), HasSubstr("ROWLAND_IMAGE_MEMORY")) << value;
    }
}

TEST(ImageLimits, RadianceOldRunsAreRefusedByTheMemoryTheyTake) {
    const std::string largest = old_runs(32768, 4096);
    EXPECT_LT(largest.size(), 50'000U);
    EXPECT_THAT(message_of([&] { read_radiance_hdr(test::as_bytes(largest), "a.hdr"); }), kRefused);
    const std::string small = old_runs(32768, 16);
    const Image image = read_radiance_hdr(test::as_bytes(small), "a.hdr");
    EXPECT_EQ(image.at(32767, 15), image.at(0, 0));
    EXPECT_GT(image.at(0, 0).x, 0.0F);
}

/// A small file whose header claims a large image, made so long that all its chunks could be in it.
TEST(ImageLimits, ExrIsRefusedByTheMemoryItTakes) {
    const test::TemporaryFolder folder;
    write_exr(folder.path() / "a.exr", Image{2, 1, {glm::vec3(1), glm::vec3(2)}});
    auto bytes = read_file(folder.path() / "a.exr", 1 << 20);
    const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    for (const char* name : {"dataWindow", "displayWindow"}) {
        const std::string attribute = std::string(name) + std::string("\0box2i\0", 7);
        const std::array<std::int32_t, 2> corner{16383, 8191};
        std::memcpy(bytes.data() + text.find(attribute) + attribute.size() + 4 + 8, corner.data(), sizeof corner);
    }
    bytes.resize(bytes.size() + 801'000);
    EXPECT_THAT(message_of([&] { read_exr(bytes, "a.exr"); }), kRefused);
}

TEST(ImageLimits, PngIsRefusedByTheMemoryItTakes) {
    auto bytes = encode_png(1, 1, 3, std::array<std::uint8_t, 3>{1, 2, 3});
    for (const std::size_t side : {16U, 20U}) {
        bytes[side + 2] = std::byte{0x2c};  // 11264 + 1
        bytes[side + 3] = std::byte{0x01};
    }
    bytes.resize(20'000);
    EXPECT_THAT(message_of([&] { decode_byte_image(bytes, "a.png"); }), kRefused);
}

TEST(ImageLimits, JpegIsRefusedByTheMemoryThatAProgressiveOneTakes) {
    auto bytes = test::encoded_jpeg(1, 1, std::array<std::uint8_t, 3>{1, 2, 3});
    for (std::size_t i = 0; i + 9 < bytes.size(); ++i)
        if (bytes[i] == std::byte{0xff} && bytes[i + 1] == std::byte{0xc0})
            for (const std::size_t side : {5U, 7U}) bytes[i + side] = std::byte{0x1b};  // 6912 + 1
    bytes.resize(60'000);
    EXPECT_THAT(message_of([&] { decode_byte_image(bytes, "a.jpg"); }), kRefused);
}

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
    EXPECT_THAT(message_of([] { decode_image(test::as_bytes("\x89PNG\r\n"), "photo.png"); }),
                AllOf(::testing::StartsWith("photo.png: "), HasSubstr("OpenEXR")));
    EXPECT_THROW(decode_image({}, "empty"), Error);
    EXPECT_THROW(load_image("/nonexistent/x.hdr"), Error);
}

}  // namespace

}  // namespace rowland::image
