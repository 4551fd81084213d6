#include "engine/image/image.h"

#include <gmock/gmock.h>

#include "engine/core/file.h"
#include "tests/support/expect.h"
#include "tests/support/files.h"
#include "tests/unit/engine/image/image_bytes.h"

namespace rowland::image {
namespace {

using ::testing::HasSubstr;

Image read(const std::string& text) {
    return read_radiance_hdr(test::as_bytes(text), "made.hdr");
}

const std::string kStart = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";

std::string texel(int r, int g, int b, int e) {
    return {static_cast<char>(r), static_cast<char>(g), static_cast<char>(b), static_cast<char>(e)};
}

/// Six texels told apart by their red mantissa, in the file's order, with exponent 136: red is the mantissa.
std::string six_texels() {
    std::string text;
    for (int i = 10; i < 16; ++i) text += texel(i, 2, 3, 136);
    return text;
}

std::string refusal(const std::string& text) {
    return test::message_of([&] { read(text); });
}

TEST(RadianceHdr, FlatTexelsAreMantissaTimesPowerOfTwo) {
    const Image image =
        read(kStart + "-Y 1 +X 3\n" + texel(255, 0, 7, 136) + texel(128, 64, 32, 129) + texel(9, 9, 9, 0));
    ASSERT_EQ(image.width, 3);
    ASSERT_EQ(image.height, 1);
    EXPECT_EQ(image.at(0, 0), glm::vec3(255, 0, 7));
    EXPECT_EQ(image.at(1, 0), glm::vec3(1, 0.5f, 0.25f));
    EXPECT_EQ(image.at(2, 0), glm::vec3(0.0f));  // exponent 0 is black
}

TEST(RadianceHdr, OldRunsRepeatTheTexelBefore) {
    // 1, then 3 repeats; a second count directly after the first is its higher byte: 2 + (1 << 8) repeats.
    const Image image = read(kStart + "-Y 1 +X 263\n" + texel(5, 6, 7, 136) + texel(1, 1, 1, 3) + texel(8, 6, 7, 136) +
                             texel(1, 1, 1, 2) + texel(1, 1, 1, 1));
    EXPECT_EQ(image.at(0, 0).x, 5);
    EXPECT_EQ(image.at(3, 0).x, 5);
    EXPECT_EQ(image.at(4, 0).x, 8);
    EXPECT_EQ(image.at(262, 0).x, 8);
}

TEST(RadianceHdr, NewRunsAndDumpsFillEachChannel) {
    std::string scanline = texel(2, 2, 0, 8);
    scanline += texel(128 + 5, 77, 3, 10) + "\x0b\x0c";  // red: five times 77, then the dump 10, 11, 12
    for (const int value : {20, 30, 136}) scanline += std::string{static_cast<char>(128 + 8), static_cast<char>(value)};
    const Image image = read(kStart + "-Y 1 +X 8\n" + scanline);
    EXPECT_EQ(image.at(4, 0), glm::vec3(77, 20, 30));
    EXPECT_EQ(image.at(5, 0).x, 10);
    EXPECT_EQ(image.at(7, 0).x, 12);
}

TEST(RadianceHdr, EveryOrientationPutsTexelsWhereTheyBelong) {
    // Red of the top row, left to right, then of the second: 3 × 2 texels.
    const struct {
        const char* resolution;
        int red[6];
    } cases[] = {
        {"-Y 2 +X 3", {10, 11, 12, 13, 14, 15}}, {"-Y 2 -X 3", {12, 11, 10, 15, 14, 13}},
        {"+Y 2 +X 3", {13, 14, 15, 10, 11, 12}}, {"+Y 2 -X 3", {15, 14, 13, 12, 11, 10}},
        {"+X 3 -Y 2", {10, 12, 14, 11, 13, 15}}, {"-X 3 -Y 2", {14, 12, 10, 15, 13, 11}},
        {"+X 3 +Y 2", {11, 13, 15, 10, 12, 14}}, {"-X 3 +Y 2", {15, 13, 11, 14, 12, 10}},
    };
    for (const auto& c : cases) {
        const Image image = read(kStart + c.resolution + "\n" + six_texels());
        ASSERT_EQ(image.width, 3) << c.resolution;
        ASSERT_EQ(image.height, 2) << c.resolution;
        for (int i = 0; i < 6; ++i)
            EXPECT_EQ(image.at(i % 3, i / 3).x, static_cast<float>(c.red[i])) << c.resolution << ", texel " << i;
    }
}

TEST(RadianceHdr, ExposureLinesMultiplyAndAreDividedOut) {
    const Image image = read("#?RGBE\r\n# a comment\nEXPOSURE=2\nEXPOSURE= 4.0\nCOLORCORR=1 0.5 0.25\n\n-Y 1 +X 1\n" +
                             texel(7, 7, 7, 136));
    EXPECT_EQ(image.at(0, 0), glm::vec3(7) / glm::vec3(8, 4, 2));
}

TEST(RadianceHdr, PrimariesAreConvertedToRec709) {
    // Wide red: its (1,0,0) is outside Rec.709, so green goes negative; white stays white.
    const std::string start = "#?RADIANCE\nPRIMARIES=0.708 0.292 0.170 0.797 0.131 0.046 0.3127 0.3290\n\n-Y 1 +X 2\n";
    const Image image = read(start + texel(99, 99, 99, 136) + texel(200, 0, 0, 136));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(image.at(0, 0)[c], 99, 1e-3f);
    EXPECT_LT(image.at(1, 0).y, 0);
}

TEST(RadianceHdr, HugeClaimsAreRefusedBeforeAllocating) {
    EXPECT_THAT(refusal(kStart + "-Y 2147483647 +X 2147483647\n"), HasSubstr("sides in"));
    EXPECT_THAT(refusal(kStart + "-Y 99999999999999999999 +X 4\n"), HasSubstr("resolution line"));
    EXPECT_THAT(refusal(kStart + "-Y 30000 +X 30000\n"), HasSubstr("texels"));
    EXPECT_THAT(refusal(kStart + "-Y 8192 +X 16384\nabcd"), HasSubstr("at least"));
    EXPECT_THAT(refusal(kStart + "-Y 0 +X 4\n"), HasSubstr("sides in"));
    EXPECT_THAT(refusal(kStart + "-Y -3 +X 4\n"), HasSubstr("made.hdr"));
}

TEST(RadianceHdr, MalformedFilesAreRefusedWithTheirPlace) {
    EXPECT_THAT(refusal(""), HasSubstr("#?RADIANCE"));
    EXPECT_THAT(refusal("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\nabcd"), HasSubstr("xyze"));
    EXPECT_THAT(refusal("#?RADIANCE\nEXPOSURE=0\n\n-Y 1 +X 1\nabcd"), HasSubstr("positive exposure"));
    EXPECT_THAT(refusal("#?RADIANCE\nEXPOSURE=nan\n\n-Y 1 +X 1\nabcd"), HasSubstr("numbers"));
    EXPECT_THAT(refusal("#?RADIANCE\nPRIMARIES=1 1 1 1 1 1 1 1\n\n-Y 1 +X 1\nabcd"), HasSubstr("triangle"));
    EXPECT_THAT(refusal("#?RADIANCE\n" + std::string(5000, 'x')), HasSubstr("does not end"));
    EXPECT_THAT(refusal(kStart + "-Y 1 +Y 1\nabcd"), HasSubstr("resolution line"));
    EXPECT_THAT(refusal(kStart + "-Y 1 +X 1 \nabc"), HasSubstr("byte"));
    EXPECT_THAT(refusal(kStart + "-Y 1 +X 4\n" + texel(1, 1, 1, 3) + "abcd"), HasSubstr("start of a scanline"));
    EXPECT_THAT(refusal(kStart + "-Y 1 +X 4\n" + texel(9, 1, 1, 3) + texel(1, 1, 1, 200)), HasSubstr("beyond"));
    EXPECT_THAT(refusal(kStart + "-Y 1 +X 8\n" + texel(2, 2, 0, 9) + "abcdefgh"), HasSubstr("9 texels"));
    EXPECT_THAT(refusal(kStart + "-Y 1 +X 8\n" + texel(2, 2, 0, 8) + texel(128 + 9, 7, 0, 0)), HasSubstr("beyond"));
    EXPECT_THAT(refusal(kStart + "-Y 1 +X 8\n" + texel(2, 2, 0, 8) + std::string(4, '\0')), HasSubstr("beyond"));
}

TEST(RadianceHdr, EveryTruncationIsRefused) {
    ROWLAND_TEST_DATA(path, "probes/simple-rle.hdr");
    const auto bytes = read_file(path, 1 << 20);
    for (std::size_t size = 0; size < bytes.size(); ++size)
        EXPECT_THROW(read_radiance_hdr(std::span(bytes).first(size), "cut.hdr"), Error) << size;
    EXPECT_NO_THROW(read_radiance_hdr(bytes, "whole.hdr"));
}

}  // namespace
}  // namespace rowland::image
