#include "engine/ui/message_list.h"

#include <gmock/gmock.h>

namespace rowland::ui {
namespace {

using std::chrono_literals::operator""s;

std::vector<std::string> texts(const std::vector<const Message*>& messages) {
    std::vector<std::string> result;
    for (const Message* message : messages) result.push_back(message->text);
    return result;
}

TEST(UnreadMessages, NewsEndByThemselvesFailuresWhenTheyAreClosed) {
    const std::vector<Message> all{{"loaded", false, 0}, {"refused", true, 1}};
    UnreadMessages unread;
    UnreadMessages::Clock::time_point now{};
    EXPECT_THAT(texts(unread.unread(all, now)), testing::ElementsAre("loaded", "refused"));
    EXPECT_FALSE(unread.due(now + 2s));
    EXPECT_TRUE(unread.due(now + 20s));
    EXPECT_THAT(texts(unread.unread(all, now += 20s)), testing::ElementsAre("refused"));
    EXPECT_FALSE(unread.due(now + 1000s));
    EXPECT_THAT(texts(unread.unread(all, now += 100s)), testing::ElementsAre("refused"));
    unread.close(all[1]);
    EXPECT_TRUE(unread.unread(all, now).empty());
}

TEST(UnreadMessages, TheNewestFourAreShown) {
    std::vector<Message> all;
    for (std::size_t i = 0; i < 6; ++i) all.push_back({std::to_string(i), true, i});
    UnreadMessages unread;
    EXPECT_THAT(texts(unread.unread(all, {})), testing::ElementsAre("2", "3", "4", "5"));
}

TEST(UnreadMessages, AMessageThatIsSaidAgainIsShownAgain) {
    Messages messages;
    messages.add_logged("refused", true);
    UnreadMessages unread;
    unread.close(*unread.unread(messages.all(), {}).front());
    EXPECT_TRUE(unread.unread(messages.all(), {}).empty());
    messages.add_logged("refused", true);
    EXPECT_EQ(unread.unread(messages.all(), {}).size(), 1U);
}

}  // namespace
}  // namespace rowland::ui
