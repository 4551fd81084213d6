#include <gmock/gmock.h>

#include <new>

#include "engine/core/child_process.h"
#include "engine/core/program.h"
#include "engine/core/system.h"
#include "tests/support/environment.h"
#include "tests/support/expect.h"

namespace rowland {

namespace {

using std::chrono::steady_clock;

/// Exit code of a body that throws `exception`; `message` receives what was printed.
template <typename Exception>
int code_of(const Exception& exception, std::string& message) {
    testing::internal::CaptureStderr();
    const int code = run_program([&]() -> int { throw exception; });
    message = testing::internal::GetCapturedStderr();
    return code;
}

TEST(Program, ReturnsWhatItsBodyReturns) {
    EXPECT_EQ(run_program([] { return 0; }), 0);
    EXPECT_EQ(run_program([] { return 2; }), 2);
}

TEST(Program, BadInputIsCodeTwoAndOneLine) {
    std::string message;
    const Error error({.file = "a.json", .location = {}, .found = "a\nb", .expected = {}, .remedy = {}});
    EXPECT_EQ(code_of(error, message), 2);
    EXPECT_EQ(message, "error: a.json: a\\x0ab\n");
}

TEST(Program, AnyOtherFailureIsCodeOne) {
    std::string message;
    const Error error(
        {.file = "a", .location = {}, .found = "disk full", .expected = {}, .remedy = {}, .fault = Fault::System});
    EXPECT_EQ(code_of(error, message), 1);
    EXPECT_EQ(message, "error: a: disk full\n");
    EXPECT_EQ(code_of(std::bad_alloc(), message), 1);
    EXPECT_EQ(message, "error: out of memory\n");
    EXPECT_EQ(code_of(std::runtime_error("odd"), message), 1);
    EXPECT_EQ(message, "error: odd\n");
}

using Exchange = ChildProcess::Exchange;

/// Far more than anything here takes; only what is Late waits this long.
ChildProcess::Deadline soon() {
    return steady_clock::now() + std::chrono::seconds(60);
}

Exchange tell(ChildProcess& process, char command) {
    return process.send(std::as_bytes(std::span(&command, 1)), soon());
}

TEST(ChildProcess, TakesAndGivesMoreThanASocketHolds) {
    ChildProcess process(ROWLAND_MISBEHAVING_PROGRAM);
    std::vector<std::byte> sent(std::size_t{4} << 20);
    for (std::size_t i = 0; i < sent.size(); ++i) sent[i] = static_cast<std::byte>(i * 31 >> 3);
    const std::size_t size = sent.size();
    ASSERT_EQ(tell(process, 'e'), Exchange::Done);
    ASSERT_EQ(process.send(std::as_bytes(std::span(&size, 1)), soon()), Exchange::Done);
    ASSERT_EQ(process.send(sent, soon()), Exchange::Done);
    std::vector<std::byte> received(size);
    ASSERT_EQ(process.receive(received, soon()), Exchange::Done);
    EXPECT_TRUE(received == sent);
}

TEST(ChildProcess, TellsHowAProgramEnded) {
    std::byte answer{};
    ChildProcess killed(ROWLAND_MISBEHAVING_PROGRAM);
    ASSERT_EQ(tell(killed, 'k'), Exchange::Done);
    EXPECT_EQ(killed.receive(std::span(&answer, 1), soon()), Exchange::Ended);
    EXPECT_EQ(killed.ending(), ROWLAND_ENDING_BY_ABORT);

    ChildProcess finished(ROWLAND_MISBEHAVING_PROGRAM);
    ASSERT_EQ(tell(finished, 'x'), Exchange::Done);
    EXPECT_EQ(finished.receive(std::span(&answer, 1), soon()), Exchange::Ended);
    EXPECT_EQ(finished.ending(), "ended with code 3");
}

TEST(ChildProcess, SendingToOneThatIsGoneIsNoSignal) {
    ChildProcess process(ROWLAND_MISBEHAVING_PROGRAM);
    std::byte answer{};
    ASSERT_EQ(tell(process, 'x'), Exchange::Done);
    ASSERT_EQ(process.receive(std::span(&answer, 1), soon()), Exchange::Ended);
    EXPECT_EQ(tell(process, 'e'), Exchange::Ended);
}

TEST(ChildProcess, OneThatHangsIsLateAndGoneWithItsScope) {
    {
        ChildProcess process(ROWLAND_MISBEHAVING_PROGRAM);
        std::byte answer{};
        ASSERT_EQ(tell(process, 'h'), Exchange::Done);
        EXPECT_EQ(process.receive(std::span(&answer, 1), steady_clock::now() + std::chrono::milliseconds(20)),
                  Exchange::Late);
        // More than the socket holds, which nobody takes.
        const std::vector<std::byte> flood(std::size_t{8} << 20);
        EXPECT_EQ(process.send(flood, steady_clock::now() + std::chrono::milliseconds(20)), Exchange::Late);
    }
    EXPECT_TRUE(test::has_no_child());
}

TEST(ChildProcess, ThatCannotBeStartedIsTheSystemsFault) {
    EXPECT_THAT(test::message_of([] { ChildProcess process("/nowhere/program"); }, Fault::System),
                testing::AllOf(testing::HasSubstr("/nowhere/program"), testing::HasSubstr(": cannot be started")));
}

TEST(HelperProgram, IsFoundBesideTheRunningProgram) {
    const std::filesystem::path running = program_file();
    EXPECT_EQ(helper_program(running.filename().string()), running);
}

TEST(HelperProgram, ThatIsMissingIsNamedWithWhereItWasLookedFor) {
    EXPECT_THAT(
        test::message_of([] { helper_program("rowland-none"); }, Fault::System),
        testing::AllOf(testing::HasSubstr("rowland-none: not in "), testing::HasSubstr("ROWLAND_HELPER_FOLDER")));
}

}  // namespace

}  // namespace rowland
