#include "content/demo/play/action.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace rowland::demo {
namespace {

TEST(DemoAction, EveryActionHasAKeyAndANameOfItsOwn) {
    std::set<platform::Key> keys;
    std::set<std::string> names;
    std::set<platform::GamepadButton> buttons;
    for (const ActionKey& row : action_keys()) {
        EXPECT_TRUE(keys.insert(row.key).second) << row.name;
        EXPECT_TRUE(names.insert(row.name).second) << row.name;
        EXPECT_TRUE(!row.button || buttons.insert(*row.button).second) << row.name;
        EXPECT_EQ(find_action(row.name), row.action);
        EXPECT_EQ(key_row(row.action).key, row.key);
    }
    for (const HeldKey& row : held_keys()) EXPECT_FALSE(keys.contains(row.key)) << row.help;
    EXPECT_FALSE(find_action("nothing of the kind"));
}

TEST(DemoAction, HelpHasALineForEveryKey) {
    const std::vector<HelpLine> lines = help_lines();
    const auto has = [&](platform::Key key, const char* help) {
        return std::any_of(lines.begin(), lines.end(), [&](const HelpLine& line) {
            return line.control == platform::name_of(key) && line.what == help;
        });
    };
    for (const ActionKey& row : action_keys()) EXPECT_TRUE(has(row.key, row.help)) << row.name;
    for (const HeldKey& row : held_keys()) EXPECT_TRUE(has(row.key, row.help)) << row.help;
}

TEST(DemoAction, HelpIsInGroupsThatFollowEachOther) {
    std::vector<std::string> groups;
    for (const HelpLine& line : help_lines())
        if (groups.empty() || groups.back() != line.group) groups.push_back(line.group);
    EXPECT_EQ(std::set(groups.begin(), groups.end()).size(), groups.size());
    EXPECT_GT(groups.size(), 4U);
}

TEST(DemoAction, KeysAreKnownByTheirNames) {
    EXPECT_EQ(platform::name_of(platform::Key::W), "W");
    EXPECT_EQ(platform::name_of(platform::Key::Digit3), "3");
    EXPECT_EQ(platform::name_of(platform::Key::F12), "F12");
    EXPECT_EQ(platform::name_of(platform::Key::Escape), "Esc");
    EXPECT_EQ(platform::name_of(platform::Key::RightAlt), "Right Alt");
    for (int i = 0; i < static_cast<int>(platform::Key::Count); ++i) {
        const auto key = static_cast<platform::Key>(i);
        EXPECT_EQ(platform::key_named(platform::name_of(key)), key) << platform::name_of(key);
    }
    EXPECT_FALSE(platform::key_named("Any"));
}

}  // namespace
}  // namespace rowland::demo
