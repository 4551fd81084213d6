#include "engine/core/lazy.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace rowland {
namespace {

TEST(Lazy, IsComputedOnceWhenACopyIsAskedFor) {
    int computed = 0;
    const Lazy<std::string> lazy([&] {
        ++computed;
        return std::string("table");
    });
    const Lazy<std::string> copy = lazy;
    EXPECT_FALSE(lazy.is_computed());
    EXPECT_EQ(*copy, "table");
    EXPECT_EQ(lazy->size(), 5);
    EXPECT_TRUE(lazy.is_computed());
    EXPECT_EQ(computed, 1);
}

TEST(Lazy, TakesAValueThatIsThere) {
    const Lazy<int> lazy(3);
    EXPECT_TRUE(lazy.is_computed());
    EXPECT_EQ(*lazy, 3);
}

TEST(Lazy, AFailureMayBeTriedAgain) {
    bool fails = true;
    const Lazy<int> lazy([&]() -> int {
        if (fails) throw 1;
        return 4;
    });
    EXPECT_THROW(*lazy, int);
    fails = false;
    EXPECT_EQ(*lazy, 4);
}

}  // namespace
}  // namespace rowland
