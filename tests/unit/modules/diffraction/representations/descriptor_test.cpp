// A representation is described once. The page, which is written by hand, agrees with the descriptors.

#include <map>
#include <string>

#include "engine/core/file.h"
#include "modules/diffraction/representations/representation.h"
#include "tests/support/files.h"

namespace rowland::diffraction {
namespace {

std::string read_module_file(const std::string& path) {
    return read_text_file(rowland::test::source_path("modules/diffraction/" + path), 1 << 20);
}

/// The row of the page's table of representations: "| `arc` | … | `bands` 5, `rank` 8 … |".
std::string key_row(const std::string& page, const std::string& name) {
    const std::size_t table = page.find("| name | light it evaluates | cost | settings (defaults) |");
    EXPECT_NE(table, std::string::npos);
    const std::size_t row = page.find("\n| `" + name + "`", table);
    return row == std::string::npos ? "" : page.substr(row + 1, page.find('\n', row + 1) - row - 1);
}

TEST(RepresentationDescriptors, HaveARowWithTheirDefaultsInThePage) {
    const std::string page = read_module_file("README.md");
    for (const RepresentationInfo* info : representations()) {
        const std::string row = key_row(page, info->name);
        EXPECT_FALSE(row.empty()) << info->name;
        for (const SettingInfo& setting : info->settings) {
            if (!setting.default_value.is_number()) continue;
            const std::string expected = std::string("`") + setting.key + "` " + setting.default_value.dump();
            EXPECT_NE(row.find(expected), std::string::npos) << info->name << " lacks " << expected;
        }
    }
}

/// The number before the tables of a cooked file names one representation.
TEST(RepresentationDescriptors, HaveUniqueFileNumbers) {
    std::map<int, std::string> taken = {{1, "one that no longer exists"}};
    for (const RepresentationInfo* info : representations()) {
        const auto [entry, is_new] = taken.try_emplace(info->file_number, info->name);
        EXPECT_TRUE(is_new) << info->file_number << " is that of " << info->name << " and of " << entry->second;
    }
}

TEST(RepresentationDescriptors, HaveDefaultsWithinTheirLimits) {
    for (const RepresentationInfo* info : representations()) {
        EXPECT_EQ(find_representation(info->name), info);
        for (const SettingInfo& setting : info->settings) {
            EXPECT_EQ(info->find(setting.key), &setting);
            if (!setting.default_value.is_number()) continue;
            EXPECT_GE(setting.default_value, setting.minimum);
            EXPECT_LE(setting.default_value, setting.maximum);
        }
    }
}

}  // namespace
}  // namespace rowland::diffraction
