#include <gmock/gmock.h>

#include <limits>

#include "engine/core/byte_stream.h"
#include "engine/core/text.h"
#include "tests/support/expect.h"

namespace rowland {

namespace {

using test::message_of;
using testing::HasSubstr;

std::vector<std::byte> sample() {
    ByteWriter writer;
    writer.value<std::uint16_t>(0x1234);
    writer.value(-2.5);
    writer.value(true);
    writer.array<float>(std::vector{1.0f, 2.0f});
    writer.text("Rowland");
    return writer.take();
}

void read_sample(ByteReader& reader) {
    EXPECT_EQ(reader.value<std::uint16_t>(), 0x1234);
    EXPECT_EQ(reader.value<double>(), -2.5);
    EXPECT_TRUE(reader.value<bool>());
    EXPECT_EQ(reader.array<float>(), (std::vector{1.0f, 2.0f}));
    EXPECT_EQ(reader.text(), "Rowland");
}

TEST(ByteStream, ReadsBackWhatWasWritten) {
    const auto data = sample();
    ByteReader reader(data, "a.probe");
    read_sample(reader);
    EXPECT_EQ(reader.remaining(), 0u);
    EXPECT_EQ(reader.offset(), data.size());
}

TEST(ByteStream, ValuesAreLittleEndian) {
    ByteWriter writer;
    writer.value<std::uint32_t>(0x01020304);
    EXPECT_EQ(writer.data(), (std::vector{std::byte{4}, std::byte{3}, std::byte{2}, std::byte{1}}));
}

TEST(ByteStream, EveryTruncationIsRefused) {
    const auto data = sample();
    for (std::size_t size = 0; size < data.size(); ++size) {
        ByteReader reader(std::span<const std::byte>(data).first(size), "a.probe");
        EXPECT_THROW(read_sample(reader), Error) << size;
    }
}

TEST(ByteStream, TakesAllBytesThereAreAndNotOneMore) {
    const std::vector<std::byte> data(3);
    ByteReader reader(data, "a.probe");
    EXPECT_EQ(reader.take(3).size(), 3U);
    EXPECT_EQ(reader.remaining(), 0U);
    EXPECT_THROW(reader.take(1), Error);
    EXPECT_THROW(ByteReader(data, "a.probe").take(4), Error);
}

TEST(ByteStream, TruncationNamesFileOffsetAndWhatIsMissing) {
    const auto data = sample();
    ByteReader reader(std::span<const std::byte>(data).first(5), "a.probe");
    reader.value<std::uint16_t>();
    EXPECT_EQ(message_of([&] { reader.value<double>(); }), "a.probe: byte 2: 3 bytes left; expected 8 bytes");
}

TEST(ByteStream, HostileCountsAreRefusedBeforeTheyAreAllocated) {
    // The second count times the element size is 2^64, which wraps to 0.
    for (const std::uint64_t count : {std::numeric_limits<std::uint64_t>::max(), std::uint64_t{1} << 61}) {
        ByteWriter writer;
        writer.value(count);
        const auto data = writer.take();
        ByteReader reader(data, "a");
        EXPECT_THAT(message_of([&] { reader.array<double>(); }), HasSubstr(std::to_string(count) + " times 8 bytes"));
    }
}

TEST(ByteStream, TruthValuesAreZeroOrOne) {
    const std::vector data = {std::byte{0}, std::byte{1}, std::byte{2}};
    ByteReader reader(data, "a");
    EXPECT_FALSE(reader.value<bool>());
    EXPECT_TRUE(reader.value<bool>());
    EXPECT_EQ(message_of([&] { reader.value<bool>(); }), "a: byte 2: 2; expected 0 or 1");
}

TEST(ByteStream, EmptyArraysAndTextsSurvive) {
    ByteWriter writer;
    writer.array<double>({});
    writer.text("");
    const auto data = writer.take();
    ByteReader reader(data, "a");
    EXPECT_TRUE(reader.array<double>().empty());
    EXPECT_EQ(reader.text(), "");
    EXPECT_TRUE(reader.take(0).empty());
}

TEST(Utf8, WhatIsValidStaysAndTheRestIsReplaced) {
    for (const char* text : {"", "cd", "Größe \"1\"\\n\t", "\xf0\x9f\x92\xbf"}) EXPECT_EQ(valid_utf8(text), text);
    EXPECT_EQ(valid_utf8("b\xff.json"), "b\xef\xbf\xbd.json");
    EXPECT_EQ(valid_utf8("cut \xf0\x9f"), "cut \xef\xbf\xbd");
    EXPECT_EQ(valid_utf8(std::string_view("a\0b", 3)), std::string("a\0b", 3));
}

TEST(Utf8, APathThatIsNoTextIsRefusedWithTheRemedy) {
    EXPECT_EQ(require_utf8("Größe.json", "rename it"), "Größe.json");
    // Windows refuses to make such a path.
    EXPECT_THROW(require_utf8("b\xff.json", "rename it"), std::runtime_error);
}

}  // namespace

}  // namespace rowland
