// On a pseudo terminal.
#include <gtest/gtest.h>
#include <pty.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <string>

#include "engine/core/log.h"

namespace rowland {

namespace {

TEST(Progress, DrawsShareOnATerminalAndErasesItsLine) {
    int master = -1;
    int terminal = -1;
    if (::openpty(&master, &terminal, nullptr, nullptr, nullptr) != 0) GTEST_SKIP() << "no pseudo terminals";
    std::fflush(stderr);
    const int saved = ::dup(STDERR_FILENO);
    ASSERT_GE(::dup2(terminal, STDERR_FILENO), 0);
    {
        Progress progress("baking", 4);
        Progress part("one table", 2);
        part.advance(1);
        progress.advance(1);
    }
    ASSERT_GE(::dup2(saved, STDERR_FILENO), 0);
    ::close(saved);

    // With its other end closed, reading ends with an error once everything has come through.
    ::close(terminal);
    std::string text;
    std::array<char, 256> buffer = {};
    while (true) {
        const ssize_t count = ::read(master, buffer.data(), buffer.size());
        if (count <= 0) break;
        text.append(buffer.data(), static_cast<std::size_t>(count));
    }
    ::close(master);
    EXPECT_NE(text.find("baking [######..................]  25 %, "), std::string::npos) << text;
    EXPECT_EQ(text.find("one table"), std::string::npos) << "work within work has no line of its own";
    EXPECT_TRUE(text.ends_with("\r\033[K")) << text;
}

}  // namespace

}  // namespace rowland
