#include "engine/image/exr.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringVectorAttribute.h>
#include <ImfTileDescriptionAttribute.h>
#include <ImfTiledOutputFile.h>
#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "engine/core/file.h"
#include "tests/support/expect.h"
#include "tests/support/files.h"
#include "tests/unit/engine/image/image_bytes.h"

namespace rowland::image {
namespace {

using ::testing::HasSubstr;

/// Values of every size, with what HDR files really hold besides.
Image made_image(int width, int height) {
    Image image{width, height, {}};
    for (int i = 0; i < width * height; ++i)
        image.texels.emplace_back(std::ldexp(1.5f, i % 40 - 20), -1.0f * static_cast<float>(i), 0.25f);
    image.texels[0] = {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN(), 1e30f};
    return image;
}

bool same_bits(const Image& a, const Image& b) {
    return a.width == b.width && a.height == b.height && a.texels.size() == b.texels.size() &&
           std::memcmp(a.texels.data(), b.texels.data(), a.texels.size() * sizeof(glm::vec3)) == 0;
}

std::string refusal(std::span<const std::byte> bytes) {
    return test::message_of([&] { read_exr(bytes, "made.exr"); });
}

/// A 4 × 2 file whose channels all hold 0.5, 1.5, 2.5, ...
std::vector<std::byte> made_file(Imf::Header header, const std::vector<std::string>& channels, Imf::PixelType type,
                                 const std::filesystem::path& path, bool tiled = false) {
    const std::vector<float> floats = {0.5f, 1.5f, 2.5f, 3.5f, 4.5f, 5.5f, 6.5f, 7.5f};
    std::vector<half> halves(floats.begin(), floats.end());
    std::vector<unsigned> integers(8, 7);
    Imf::FrameBuffer buffer;
    for (const std::string& name : channels) {
        header.channels().insert(name, Imf::Channel(type));
        const void* data = type == Imf::FLOAT  ? static_cast<const void*>(floats.data())
                           : type == Imf::HALF ? static_cast<const void*>(halves.data())
                                               : static_cast<const void*>(integers.data());
        buffer.insert(name, Imf::Slice::Make(type, data, header.dataWindow()));
    }
    if (tiled) {
        header.setTileDescription(Imf::TileDescription(3, 2, Imf::ONE_LEVEL));
        Imf::TiledOutputFile file(path.string().c_str(), header);
        file.setFrameBuffer(buffer);
        file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
    } else {
        Imf::OutputFile file(path.string().c_str(), header);
        file.setFrameBuffer(buffer);
        file.writePixels(2);
    }
    return read_file(path, 1 << 20);
}

TEST(Exr, RoundTripKeepsEveryBit) {
    const test::TemporaryFolder folder;
    for (const auto& [width, height] : {std::pair{1, 1}, {7, 5}, {64, 600}}) {
        const Image image = made_image(width, height);
        write_exr(folder.path() / "a.exr", image);
        EXPECT_TRUE(same_bits(load_image(folder.path() / "a.exr"), image)) << width << " x " << height;
    }
}

TEST(Exr, WritingIsDeterministic) {
    const test::TemporaryFolder folder;
    write_exr(folder.path() / "a.exr", made_image(33, 21));
    write_exr(folder.path() / "b.exr", made_image(33, 21));
    EXPECT_EQ(read_file(folder.path() / "a.exr", 1 << 20), read_file(folder.path() / "b.exr", 1 << 20));
}

TEST(Exr, AlphaIsIgnored) {
    const test::TemporaryFolder folder;
    const auto file = made_file(Imf::Header(4, 2), {"R", "G", "B", "A"}, Imf::FLOAT, folder.path() / "a.exr");
    const Image image = read_exr(file, "a.exr");
    EXPECT_EQ(image.at(0, 0), glm::vec3(0.5f));
    EXPECT_EQ(image.at(3, 1), glm::vec3(7.5f));
}

TEST(Exr, HalfFloatLuminanceLayersAndTilesAreRead) {
    const test::TemporaryFolder folder;
    const auto path = folder.path() / "a.exr";
    for (const auto type : {Imf::HALF, Imf::FLOAT})
        for (const bool tiled : {false, true})
            for (const std::vector<std::string>& channels :
                 {std::vector<std::string>{"R", "G", "B"}, {"Y"}, {"View.R", "View.G", "View.B", "Depth.Z"}}) {
                const auto bytes = made_file(Imf::Header(4, 2), channels, type, path, tiled);
                const Image image = read_exr(bytes, "a.exr");
                ASSERT_EQ(image.width, 4);
                ASSERT_EQ(image.height, 2);
                for (int i = 0; i < 8; ++i)
                    EXPECT_EQ(image.at(i % 4, i / 4), glm::vec3(static_cast<float>(i) + 0.5f)) << channels[0];
            }
}

TEST(Exr, WindowAwayFromTheOriginIsRead) {
    const test::TemporaryFolder folder;
    const Imath::Box2i window({-5, 100}, {-2, 101});
    const auto bytes = made_file(Imf::Header(window, window), {"R", "G", "B"}, Imf::FLOAT, folder.path() / "a.exr");
    EXPECT_EQ(read_exr(bytes, "a.exr").at(3, 1).x, 7.5f);
}

TEST(Exr, ChromaticitiesAreConvertedToRec709) {
    const test::TemporaryFolder folder;
    Imf::Header header(4, 2);
    Imf::addChromaticities(header, Imf::Chromaticities({0.713f, 0.293f}, {0.165f, 0.830f}, {0.128f, 0.044f},
                                                       {0.32168f, 0.33767f}));  // ACEScg
    const auto bytes = made_file(header, {"R", "G", "B"}, Imf::FLOAT, folder.path() / "a.exr");
    const Image image = read_exr(bytes, "a.exr");
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(image.at(2, 0)[c], 2.5f, 1e-5f);  // neutral stays neutral
}

/// X, Y and Z of 0.5, 1.5, … each: the equal-energy white, with the rows of XYZ → Rec.709 summed [IEC 61966-2-1].
TEST(Exr, TristimulusValuesAreConvertedToRec709) {
    const test::TemporaryFolder folder;
    const auto path = folder.path() / "a.exr";
    for (const auto type : {Imf::HALF, Imf::FLOAT}) {
        const Image image = read_exr(made_file(Imf::Header(4, 2), {"X", "Y", "Z"}, type, path), "a.exr");
        EXPECT_NEAR(image.at(2, 0).r, 2.5F * 1.2048F, 2e-3F);
        EXPECT_NEAR(image.at(2, 0).g, 2.5F * 0.9483F, 2e-3F);
        EXPECT_NEAR(image.at(2, 0).b, 2.5F * 0.9088F, 2e-3F);
    }
    // R, G and B are preferred, and X, Y and Z without one of them mean nothing.
    const auto both = made_file(Imf::Header(4, 2), {"R", "G", "B", "X", "Y", "Z"}, Imf::HALF, path);
    EXPECT_EQ(read_exr(both, "a.exr").at(2, 0), glm::vec3(2.5F));
    EXPECT_THAT(refusal(made_file(Imf::Header(4, 2), {"X", "Y"}, Imf::HALF, path)), HasSubstr("channels X, Y"));
    EXPECT_THAT(refusal(made_file(Imf::Header(4, 2), {"X", "Y", "Z"}, Imf::UINT, path)), HasSubstr("integers"));
}

TEST(Exr, CubeMapsAreRefused) {
    const test::TemporaryFolder folder;
    Imf::Header header(4, 2);
    Imf::addEnvmap(header, Imf::ENVMAP_LATLONG);
    EXPECT_NO_THROW(read_exr(made_file(header, {"R", "G", "B"}, Imf::HALF, folder.path() / "a.exr"), "a.exr"));
    Imf::addEnvmap(header, Imf::ENVMAP_CUBE);
    EXPECT_THAT(refusal(made_file(header, {"R", "G", "B"}, Imf::HALF, folder.path() / "a.exr")), HasSubstr("cube map"));
}

TEST(Exr, OtherChannelsAndWindowsAreRefused) {
    const test::TemporaryFolder folder;
    const auto path = folder.path() / "a.exr";
    EXPECT_THAT(refusal(made_file(Imf::Header(4, 2), {"R", "G"}, Imf::HALF, path)), HasSubstr("channels G, R"));
    EXPECT_THAT(refusal(made_file(Imf::Header(4, 2), {"Y", "RY", "BY"}, Imf::HALF, path)), HasSubstr("R, G and B"));
    EXPECT_THAT(refusal(made_file(Imf::Header(4, 2), {"R", "G", "B"}, Imf::UINT, path)), HasSubstr("half or float"));
    const Imf::Header cropped(Imath::Box2i({0, 0}, {9, 9}), Imath::Box2i({0, 0}, {3, 1}));
    EXPECT_THAT(refusal(made_file(cropped, {"R", "G", "B"}, Imf::HALF, path)), HasSubstr("display window"));
}

TEST(Exr, HugeClaimsAreRefusedBeforeAllocating) {
    const test::TemporaryFolder folder;
    auto bytes = made_file(Imf::Header(4, 2), {"R", "G", "B"}, Imf::HALF, folder.path() / "a.exr");
    const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const std::size_t window = text.find(std::string("dataWindow\0box2i\0", 17)) + 17 + 4;
    const auto claim = [&](std::int32_t width, std::int32_t height) {
        const std::int32_t corner[2] = {width - 1, height - 1};
        auto changed = bytes;
        std::memcpy(changed.data() + window + 8, corner, sizeof corner);
        return changed;
    };
    EXPECT_NO_THROW(read_exr(claim(4, 2), "a.exr"));
    EXPECT_THAT(refusal(claim(2147483647, 2147483647)), HasSubstr("sides in"));
    EXPECT_THAT(refusal(claim(16384, 8192)), HasSubstr("at least"));  // possible, but not in a file of this size
    EXPECT_THAT(refusal(claim(0, 2)), HasSubstr("sides in"));

    const std::size_t channels = text.find(std::string("channels\0chlist\0", 16)) + 16;
    auto changed = bytes;
    const std::uint32_t size = 0x7fffffff;
    std::memcpy(changed.data() + channels, &size, sizeof size);
    EXPECT_THAT(refusal(changed), HasSubstr("attribute \"channels\""));
}

/// The library would take something else for the attributes that follow than what has been checked.
TEST(Exr, AttributesOfAnotherSizeThanTheirTypeAreRefused) {
    const test::TemporaryFolder folder;
    Imf::Header header(4, 2);
    header.insert("notes", Imf::StringVectorAttribute({"one", "two"}));
    const auto bytes = made_file(header, {"R", "G", "B"}, Imf::HALF, folder.path() / "a.exr");
    EXPECT_NO_THROW(read_exr(bytes, "a.exr"));
    const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const auto changed_at = [&](const std::string& name_and_type, std::size_t after, std::uint32_t size) {
        auto changed = bytes;
        std::memcpy(changed.data() + text.find(name_and_type) + name_and_type.size() + after, &size, sizeof size);
        return changed;
    };
    EXPECT_THAT(refusal(changed_at(std::string("pixelAspectRatio\0float\0", 23), 0, 8)),
                HasSubstr("of type float in 8 bytes"));
    EXPECT_THAT(refusal(changed_at(std::string("channels\0chlist\0", 16), 0, 56)), HasSubstr("a list of channels"));
    EXPECT_THAT(refusal(changed_at(std::string("notes\0stringvector\0", 19), 4, 0x20000000)),
                HasSubstr("a text of 536870912 bytes"));
}

TEST(Exr, EveryTruncationIsRefused) {
    const test::TemporaryFolder folder;
    const auto bytes = made_file(Imf::Header(4, 2), {"R", "G", "B"}, Imf::HALF, folder.path() / "a.exr");
    for (std::size_t size = 0; size < bytes.size(); ++size)
        EXPECT_THROW(read_exr(std::span(bytes).first(size), "cut.exr"), Error) << size;
}

}  // namespace
}  // namespace rowland::image
