#include "engine/asset/container.h"

#include <gmock/gmock.h>
#include <zstd.h>

#include <regex>

#include "engine/core/byte_stream.h"
#include "tests/support/expect.h"
#include "tests/support/files.h"

namespace rowland::asset {
namespace {

using test::bytes_of;
using test::message_of;
using testing::HasSubstr;
using testing::StartsWith;

constexpr const char* kRecook = "cook it again: ./rowland cook";

CookedAsset sample() {
    return {.header = {.type = "probe", .type_version = 3, .content_hash = {.low = 0x1234, .high = 0xabcd}},
            .payload = bytes_of("a payload that repeats, repeats, repeats, repeats")};
}

void expect_equal(const CookedAsset& a, const CookedAsset& b) {
    EXPECT_EQ(a.header.type, b.header.type);
    EXPECT_EQ(a.header.type_version, b.header.type_version);
    EXPECT_EQ(a.header.content_hash, b.header.content_hash);
    EXPECT_EQ(a.payload, b.payload);
}

std::string unpack_message(std::span<const std::byte> bytes) {
    return message_of([&] { unpack(bytes, "a.probe"); });
}

/// A container written by hand, with a right checksum, to say what pack never would.
struct Forgery {
    std::uint32_t container_version = 1;
    std::string type = "probe";
    std::uint64_t payload_size = 0;
    std::vector<std::byte> stored;
    std::uint64_t stored_size_excess = 0;

    std::vector<std::byte> bytes() const {
        ByteWriter writer;
        for (const char c : std::string_view("ROWLAND\x1a")) writer.value(c);
        writer.value(container_version);
        writer.text(type);
        writer.value<std::uint32_t>(3);
        writer.value<std::uint64_t>(0);
        writer.value<std::uint64_t>(0);
        writer.value(payload_size);
        writer.value<std::uint64_t>(stored.size() + stored_size_excess);
        const Hash128 sum = Hasher().bytes(writer.data()).bytes(stored).digest();
        writer.value(sum.low);
        writer.value(sum.high);
        std::vector<std::byte> result = writer.take();
        result.insert(result.end(), stored.begin(), stored.end());
        return result;
    }
};

std::vector<std::byte> zstd_frame(const std::vector<std::byte>& payload) {
    std::vector<std::byte> frame(ZSTD_compressBound(payload.size()));
    frame.resize(ZSTD_compress(frame.data(), frame.size(), payload.data(), payload.size(), 1));
    return frame;
}

TEST(Container, UnpackInvertsPack) {
    expect_equal(unpack(pack(sample()), "a"), sample());
    CookedAsset empty = sample();
    empty.payload.clear();
    expect_equal(unpack(pack(empty), "a"), empty);
    CookedAsset large = sample();
    for (std::uint32_t i = 0; i < 3'000'000; ++i) large.payload.push_back(static_cast<std::byte>(i * i >> 7));
    expect_equal(unpack(pack(large), "a"), large);
}

TEST(Container, PayloadIsCompressed) {
    CookedAsset asset = sample();
    asset.payload.assign(1'000'000, std::byte{7});
    EXPECT_LT(pack(asset).size(), 1000u);
}

TEST(Container, DensestPayloadIsNotTakenForAHostileOne) {
    CookedAsset asset = sample();
    asset.payload.assign(std::size_t{8} << 20, std::byte{0});
    EXPECT_EQ(unpack(pack(asset), "a").payload, asset.payload);
}

TEST(Container, IsKnownByItsMagic) {
    EXPECT_TRUE(is_cooked(pack(sample())));
    EXPECT_FALSE(is_cooked(bytes_of("ROWLAND")));
    EXPECT_FALSE(is_cooked(bytes_of("glTF\x02 and so on")));
    EXPECT_FALSE(is_cooked({}));
}

TEST(Container, EveryFlippedBitIsRefused) {
    const std::vector<std::byte> original = pack(sample());
    for (std::size_t i = 0; i < original.size(); ++i) {
        for (int bit = 0; bit < 8; ++bit) {
            std::vector<std::byte> bytes = original;
            bytes[i] ^= static_cast<std::byte>(1 << bit);
            EXPECT_THROW(unpack(bytes, "a"), Error) << "byte " << i << ", bit " << bit;
        }
    }
}

TEST(Container, EveryTruncationIsRefused) {
    const std::vector<std::byte> bytes = pack(sample());
    for (std::size_t size = 0; size < bytes.size(); ++size)
        EXPECT_THAT(unpack_message(std::span(bytes.data(), size)), HasSubstr(kRecook)) << size;
}

TEST(Container, TruncationSaysWhereAndHowMuchIsMissing) {
    std::vector<std::byte> bytes = pack(sample());
    bytes.pop_back();
    const std::string message = unpack_message(bytes);
    EXPECT_THAT(message, StartsWith("a.probe: byte "));
    EXPECT_THAT(message, HasSubstr("bytes left; expected "));
}

TEST(Container, TrailingBytesAreRefused) {
    std::vector<std::byte> bytes = pack(sample());
    bytes.push_back(std::byte{0});
    EXPECT_THAT(unpack_message(bytes), HasSubstr("1 bytes too many; expected the end of the file; "));
}

TEST(Container, ChecksumErrorNamesBothSums) {
    std::vector<std::byte> bytes = pack(sample());
    bytes.back() ^= std::byte{1};
    const std::string message = unpack_message(bytes);
    const std::regex form("a.probe: checksum: [0-9a-f]{32}; expected [0-9a-f]{32}; cook it again: ./rowland cook");
    EXPECT_TRUE(std::regex_match(message, form)) << message;
}

TEST(Container, OtherContainerVersionsNameBothAndTheCommand) {
    Forgery forgery;
    forgery.stored = zstd_frame({});
    EXPECT_NO_THROW(unpack(forgery.bytes(), "a.probe"));
    forgery.container_version = 2;
    EXPECT_EQ(unpack_message(forgery.bytes()),
              "a.probe: header: container version 2, newer than this program's; expected version 1; "
              "cook it again: ./rowland cook");
    forgery.container_version = 0;
    EXPECT_THAT(unpack_message(forgery.bytes()), HasSubstr("container version 0, older than this program's"));
}

TEST(Container, HostileSizesAreRefusedBeforeTheyAreAllocated) {
    Forgery too_large;
    too_large.payload_size = (std::uint64_t{1} << 30) + 1;
    too_large.stored.assign(100'000, std::byte{0});
    EXPECT_THAT(unpack_message(too_large.bytes()), HasSubstr("expected at most 1073741824 bytes"));

    // Within the limit, but 20 bytes cannot hold it.
    Forgery implausible;
    implausible.payload_size = std::uint64_t{1} << 30;
    implausible.stored = zstd_frame(bytes_of("x"));
    EXPECT_THAT(unpack_message(implausible.bytes()), HasSubstr("no more than zstd can hold"));

    Forgery past_the_end;
    past_the_end.stored_size_excess = ~std::uint64_t{0} - 10;
    EXPECT_THAT(unpack_message(past_the_end.bytes()), HasSubstr("bytes left"));
}

TEST(Container, PayloadSizeMustBeWhatTheFrameHolds) {
    Forgery forgery;
    forgery.stored = zstd_frame(bytes_of("12345"));
    forgery.payload_size = 5;
    EXPECT_NO_THROW(unpack(forgery.bytes(), "a"));
    forgery.payload_size = 4;
    EXPECT_THAT(unpack_message(forgery.bytes()), HasSubstr("payload: "));
    forgery.payload_size = 6;
    EXPECT_THAT(unpack_message(forgery.bytes()), HasSubstr("payload: 5 bytes; expected 6 bytes"));
}

TEST(Container, PayloadThatIsNoFrameIsRefused) {
    Forgery forgery;
    forgery.stored = bytes_of("this is no zstd frame");
    forgery.payload_size = 5;
    EXPECT_THAT(unpack_message(forgery.bytes()), HasSubstr("expected a zstd frame"));
}

TEST(Container, TypeNamesAreShort) {
    Forgery forgery;
    forgery.stored = zstd_frame({});
    forgery.type = std::string(65, 'x');
    EXPECT_THAT(unpack_message(forgery.bytes()), HasSubstr("a type name of 65 characters"));
    forgery.type = "";
    EXPECT_THAT(unpack_message(forgery.bytes()), HasSubstr("a type name of 0 characters"));
}

class ContainerFile : public testing::Test {
 protected:
    ContainerFile() : path_(folder_.path() / "a.probe") { write_file_atomic(path_, pack(sample())); }

    test::TemporaryFolder folder_;
    std::filesystem::path path_;
};

TEST_F(ContainerFile, LoadsWhatWasPacked) {
    expect_equal(load(path_, "probe", 3), sample());
}

TEST_F(ContainerFile, WrongTypeNamesFileFoundExpectedAndTheCommand) {
    EXPECT_EQ(
        message_of([&] { load(path_, "material", 3); }),
        path_.string() + ": header: an asset of type \"probe\"; expected \"material\"; cook it again: ./rowland cook");
}

TEST_F(ContainerFile, WrongVersionNamesFileFoundExpectedAndTheCommand) {
    EXPECT_EQ(message_of([&] { load(path_, "probe", 4); }),
              path_.string() +
                  ": header: probe version 3, older than this program's; expected version 4; "
                  "cook it again: ./rowland cook");
    EXPECT_THAT(message_of([&] { load(path_, "probe", 2); }), HasSubstr("probe version 3, newer than"));
}

}  // namespace
}  // namespace rowland::asset
