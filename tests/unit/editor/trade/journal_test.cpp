#include "editor/trade/journal.h"

#include <gmock/gmock.h>

#include <fstream>

#include "tests/support/expect.h"
#include "tests/support/files.h"

namespace rowland::trade {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class JournalFile : public ::testing::Test {
 protected:
    std::filesystem::path path() const { return folder_.path() / "results" / "journal.jsonl"; }
    void append(const std::string& text) { std::ofstream(path(), std::ios::app) << text; }
    std::string text() const { return read_text_file(path(), 1 << 20); }

    test::TemporaryFolder folder_;
};

TEST_F(JournalFile, EntriesAreThereAgainWhenItIsOpenedAgain) {
    {
        Journal journal(path());
        EXPECT_EQ(journal.find("a"), nullptr);
        journal.add("a", {{"error", 0.125}});
        journal.add("b", 3);
        EXPECT_EQ(*journal.find("b"), 3);
    }
    const Journal journal(path());
    EXPECT_EQ(journal.size(), 2U);
    EXPECT_EQ(journal.find("a")->at("error"), 0.125);
}

/// Written when added, not when closed: that is what a killed program leaves.
TEST_F(JournalFile, AnEntryIsInTheFileAtOnce) {
    Journal journal(path());
    journal.add("a", 1);
    EXPECT_THAT(text(), HasSubstr("\"a\""));
}

TEST_F(JournalFile, ATornLastLineIsCutOffAndTheRestKept) {
    { Journal(path()).add("a", 1); }
    const std::string whole = text();
    append(R"({"key":"b","val)");
    {
        Journal journal(path());
        EXPECT_EQ(journal.size(), 1U);
        EXPECT_EQ(text(), whole);
        journal.add("c", 2);
    }
    const Journal journal(path());
    EXPECT_EQ(journal.size(), 2U);
    EXPECT_EQ(*journal.find("c"), 2);
}

TEST_F(JournalFile, ABrokenLineBeforeTheLastIsRefusedByNumber) {
    { Journal(path()).add("a", 1); }
    append("nonsense\n");
    {
        EXPECT_THAT(test::message_of([&] { Journal again(path()); }),
                    AllOf(HasSubstr("line 2"), HasSubstr("journal.jsonl")));
    }
}

TEST_F(JournalFile, TwoAtATimeAreRefused) {
    const Journal first(path());
    EXPECT_THAT(test::message_of([&] { Journal second(path()); }), HasSubstr("another process"));
}

}  // namespace
}  // namespace rowland::trade
