#include "engine/core/hash.h"

#include <gtest/gtest.h>

#include <span>
#include <string_view>

namespace rowland {
namespace {

std::span<const std::byte> bytes(std::string_view text) {
    return std::as_bytes(std::span(text.data(), text.size()));
}

TEST(Hash, EmptyInputHasThePublishedXxh3Digest) {
    // XXH3_128bits of no bytes with seed 0, from xxHash's own sanity checks.
    EXPECT_EQ(Hasher().digest().hex(), "99aa06d3014798d86001c324468d497f");
}

TEST(Hash, HexPrintsHighHalfFirstWithLeadingZeros) {
    EXPECT_EQ((Hash128{.low = 0xab, .high = 0x1}).hex(), "000000000000000100000000000000ab");
}

TEST(Hash, BytesInPiecesHashLikeBytesAtOnce) {
    EXPECT_EQ(Hasher().bytes(bytes("grat")).bytes(bytes("ing")).digest(), Hasher().bytes(bytes("grating")).digest());
}

TEST(Hash, TextsAreHashedWithTheirLengths) {
    EXPECT_NE(Hasher().text("ab").text("c").digest(), Hasher().text("a").text("bc").digest());
    EXPECT_NE(Hasher().text("").digest(), Hasher().digest());
    EXPECT_NE(Hasher().text("a").digest(), Hasher().bytes(bytes("a")).digest());
}

TEST(Hash, EveryBitChangesBothHalves) {
    const Hash128 original = Hasher().text("rowland").digest();
    for (std::size_t bit = 0; bit < 56; ++bit) {
        std::string text = "rowland";
        text[bit / 8] = static_cast<char>(text[bit / 8] ^ (1 << (bit % 8)));
        const Hash128 changed = Hasher().text(text).digest();
        EXPECT_NE(changed.low, original.low) << bit;
        EXPECT_NE(changed.high, original.high) << bit;
    }
}

TEST(Hash, DigestLeavesTheHasherUsable) {
    Hasher hasher;
    hasher.text("a");
    EXPECT_EQ(hasher.digest(), hasher.digest());
    EXPECT_EQ(hasher.text("b").digest(), Hasher().text("a").text("b").digest());
}

}  // namespace
}  // namespace rowland
