// A profile is described once. The schema and the page, which are written by hand, agree with the descriptors.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "engine/core/file.h"
#include "modules/diffraction/model/profile.h"
#include "tests/support/source_tree.h"

namespace rowland::diffraction {
namespace {

using nlohmann::json;

std::string read_module_file(const std::string& path) {
    return read_text_file(test::source_path("modules/diffraction/" + path), 1 << 20);
}

/// What the schema says of a member. That a width is at most the pitch, a schema cannot say.
json member_schema(const ProfileMember& member) {
    if (member.value == nullptr) return {{"type", "string"}, {"minLength", 1}};
    json schema = {{"type", "number"}, {"exclusiveMinimum", 0}};
    if (!member.within_pitch && std::isfinite(member.less_than)) schema["exclusiveMaximum"] = member.less_than;
    return schema;
}

json profile_schema(const ProfileDescriptor& descriptor) {
    json required = {"type"};
    json properties = {{"type", {{"const", descriptor.name}}}};
    for (const ProfileMember& member : descriptor.members) {
        required.push_back(member.key);
        properties[member.key] = member_schema(member);
    }
    return {{"type", "object"}, {"required", required}, {"additionalProperties", false}, {"properties", properties}};
}

TEST(ProfileDescriptor, SchemaHasEveryProfileAndItsMembers) {
    const json schema = json::parse(read_module_file("asset/material.schema.json"));
    json expected = json::array();
    for (const ProfileDescriptor& descriptor : profile_descriptors()) expected.push_back(profile_schema(descriptor));
    EXPECT_EQ(schema["$defs"]["grating"]["properties"]["profile"]["oneOf"], expected);
}

TEST(ProfileDescriptor, PageHasEveryProfileAndItsMembers) {
    const std::string page = read_module_file("README.md");
    for (const ProfileDescriptor& descriptor : profile_descriptors()) {
        const auto begin = page.find("\n| `" + std::string(descriptor.name) + "` |");
        ASSERT_NE(begin, std::string::npos) << descriptor.name;
        const std::string row = page.substr(begin, page.find('\n', begin + 1) - begin);
        for (const ProfileMember& member : descriptor.members)
            EXPECT_NE(row.find(std::string("`") + member.key + "`"), std::string::npos) << row;
    }
}

TEST(ProfileDescriptor, FollowTheVariantAndHaveNamesOfTheirOwn) {
    std::set<std::string_view> names;
    for (std::size_t i = 0; i < profile_descriptors().size(); ++i) {
        EXPECT_EQ(profile_descriptors()[i].empty.index(), i);
        EXPECT_TRUE(names.insert(profile_descriptors()[i].name).second) << profile_descriptors()[i].name;
    }
    EXPECT_EQ(names.size(), std::variant_size_v<Profile>);
}

TEST(ProfileDescriptor, EveryNumberChangesTheEfficiencies) {
    for (const ProfileDescriptor& descriptor : profile_descriptors()) {
        for (const ProfileMember& changed : descriptor.members) {
            if (changed.value == nullptr) continue;
            Profile profile = descriptor.empty;
            for (const ProfileMember& member : descriptor.members) member.value(profile) = member.initial;
            const double before = profile_efficiency(profile, 1600.0, 1, 550.0);
            changed.value(profile) *= 0.9;
            EXPECT_NE(profile_efficiency(profile, 1600.0, 1, 550.0), before) << descriptor.name << " " << changed.key;
        }
    }
}

TEST(ProfileDescriptor, InitialValuesAndSlidersAreInRange) {
    for (const ProfileDescriptor& descriptor : profile_descriptors()) {
        for (const ProfileMember& member : descriptor.members) {
            if (member.value == nullptr) continue;
            EXPECT_GT(member.slider_least, 0.0) << member.key;
            EXPECT_LE(member.slider_least, member.initial) << member.key;
            EXPECT_LE(member.initial, member.slider_most) << member.key;
            EXPECT_TRUE(member.within_pitch || member.slider_most < member.less_than) << member.key;
        }
    }
}

/// User interfaces show one control for a key that several profiles have.
TEST(ProfileDescriptor, MembersOfOneKeyMeanTheSame) {
    std::map<std::string, ProfileMember> known;
    for (const ProfileDescriptor& descriptor : profile_descriptors()) {
        for (const ProfileMember& member : descriptor.members) {
            const ProfileMember& first = known.emplace(member.key, member).first->second;
            EXPECT_STREQ(member.label, first.label);
            EXPECT_STREQ(member.unit, first.unit);
            EXPECT_STREQ(member.help, first.help);
            EXPECT_EQ(member.less_than, first.less_than) << member.key;
            EXPECT_EQ(member.within_pitch, first.within_pitch) << member.key;
            EXPECT_EQ(member.slider_least, first.slider_least) << member.key;
            EXPECT_EQ(member.slider_most, first.slider_most) << member.key;
        }
    }
}

}  // namespace
}  // namespace rowland::diffraction
