#include "content/demo/hud/windows.h"

#include <gtest/gtest.h>

#include "engine/core/system.h"

namespace rowland::demo {
namespace {

TEST(Memory, BytesAreReadWithTheUnitThatKeepsThemShort) {
    EXPECT_EQ(format_bytes(0), "0 B");
    EXPECT_EQ(format_bytes(999), "999 B");
    EXPECT_EQ(format_bytes(1000), "1.0 KiB");
    EXPECT_EQ(format_bytes(137824), "135 KiB");
    EXPECT_EQ(format_bytes(std::size_t{56} << 20), "56 MiB");
    EXPECT_EQ(format_bytes(std::size_t{3} << 30), "3.0 GiB");
}

TEST(Memory, WhatIsTouchedIsResident) {
    constexpr std::size_t kMuch = std::size_t{64} << 20;
    const std::size_t before = resident_set_bytes();
    const std::vector<char> touched(kMuch, 'x');
    const volatile char* const seen = touched.data();  // or a compiler may do without the memory
    EXPECT_EQ(seen[kMuch - 1], 'x');
    EXPECT_GT(before, 0U);
    EXPECT_GT(resident_set_bytes(), before + kMuch / 2);
}

}  // namespace
}  // namespace rowland::demo
