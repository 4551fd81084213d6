// Pages and comments refer to what exists: sections and formulas of PHYSICS.md, files, headings.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/support/source_tree.h"
#include "tests/unit/tree_text.h"

namespace rowland::test {
namespace {

constexpr const char* kPhysics = "modules/diffraction/PHYSICS.md";
constexpr const char* kFilmPhysics = "modules/thin_film/PHYSICS.md";

/// The page that a file cites: that of the module it belongs to or tests.
std::string page_cited_by(const std::string& path) {
    return path.find("thin_film") == std::string::npos ? kPhysics : kFilmPhysics;
}

std::string text_of(const std::string& path) {
    for (const TreeFile& file : tree_files())
        if (file.path == path) return file.text;
    ADD_FAILURE() << "no file " << path;
    return {};
}

int line_at(const std::string& text, std::ptrdiff_t position) {
    return 1 + static_cast<int>(std::count(text.begin(), text.begin() + position, '\n'));
}

std::vector<std::smatch> matches(const std::string& text, const std::regex& pattern) {
    return {std::sregex_iterator(text.begin(), text.end(), pattern), std::sregex_iterator()};
}

/// Section number → its text. Sections begin with "## §n".
std::map<int, std::string> sections_of(const std::string& page) {
    std::map<int, std::string> sections;
    int current = 0;
    for_each_line(page, [&](const std::string& line, int) {
        static const std::regex heading("^## §(\\d+) .*");
        std::smatch match;
        if (std::regex_match(line, match, heading))
            current = std::stoi(match[1]);
        else if (line.starts_with("## "))
            current = 0;
        if (current != 0) sections[current] += line + "\n";
    });
    return sections;
}

/// Numbers of the formulas: "(n)" at the end of a line.
std::set<int> formulas_of(const std::string& page) {
    std::set<int> formulas;
    for_each_line(page, [&](const std::string& line, int) {
        static const std::regex numbered(".*\\((\\d+)\\)$");
        std::smatch match;
        if (std::regex_match(line, match, numbered)) {
            EXPECT_TRUE(formulas.insert(std::stoi(match[1])).second) << "twice: " << line;
        }
    });
    return formulas;
}

/// A comment's text may continue on the next line.
const std::string kSpace = R"((?:\s|///?|\*)+)";

/// Sections and formulas of a page.
struct Numbers {
    explicit Numbers(const std::string& path)
        : page(text_of(path)), sections(sections_of(page)), formulas(formulas_of(page)) {}

    std::string page;
    std::map<int, std::string> sections;
    std::set<int> formulas;
};

void expect_cited(const Numbers& cited, const std::string& rest, const std::string& where) {
    static const std::regex citation("^PHYSICS" + kSpace + R"((?:§(\d+)|\((\d+)\))(?:,? "([^"]+)\")?)");
    std::smatch match;
    if (!std::regex_search(rest, match, citation)) {
        ADD_FAILURE() << where << ": PHYSICS without a section (§4) or a formula (3)";
        return;
    }
    if (match[2].matched) {
        EXPECT_TRUE(cited.formulas.contains(std::stoi(match[2]))) << where << ": no formula (" << match[2] << ")";
        return;
    }
    const auto section = cited.sections.find(std::stoi(match[1]));
    ASSERT_NE(section, cited.sections.end()) << where << ": no section §" << match[1];
    if (match[3].matched) {
        EXPECT_NE(section->second.find(match[3].str()), std::string::npos)
            << where << ": §" << match[1] << " does not contain \"" << match[3] << "\"";
    }
}

TEST(Physics, EveryCitationOfThePageNamesASectionOrAFormulaThatExists) {
    const std::map<std::string, Numbers> pages = {{kPhysics, Numbers(kPhysics)}, {kFilmPhysics, Numbers(kFilmPhysics)}};
    const std::regex mention(R"(\bPHYSICS\b(?!\.md))");
    std::map<std::string, int> citations;
    for (const TreeFile& file : tree_files()) {
        if (pages.contains(file.path) || file.path == "tests/unit/pages_test.cpp") continue;
        if (file.text.find("PHYSICS") == std::string::npos) continue;
        const std::string page = page_cited_by(file.path);
        for (const std::smatch& found : matches(file.text, mention)) {
            ++citations[page];
            expect_cited(pages.at(page), file.text.substr(static_cast<std::size_t>(found.position()), 120),
                         file.path + ":" + std::to_string(line_at(file.text, found.position())));
        }
    }
    EXPECT_GT(citations[kPhysics], 40);
    EXPECT_GT(citations[kFilmPhysics], 5);
}

TEST(Physics, SectionsAndFormulasAreNumberedWithoutGaps) {
    for (const auto& [path, sections_at_least, formulas_at_least] :
         {std::tuple(kPhysics, 9U, 20U), std::tuple(kFilmPhysics, 5U, 5U)}) {
        const Numbers numbers(path);
        ASSERT_GE(numbers.sections.size(), sections_at_least);
        ASSERT_GE(numbers.formulas.size(), formulas_at_least);
        EXPECT_EQ(numbers.sections.rbegin()->first, static_cast<int>(numbers.sections.size()));
        EXPECT_EQ(*numbers.formulas.rbegin(), static_cast<int>(numbers.formulas.size()));
        // §30 or (99) in the page's own text.
        for (const std::smatch& match : matches(numbers.page, std::regex("§(\\d+)")))
            EXPECT_TRUE(numbers.sections.contains(std::stoi(match[1]))) << match.str();
        for (const std::smatch& match : matches(numbers.page, std::regex(" \\((\\d\\d?)\\)")))
            EXPECT_TRUE(numbers.formulas.contains(std::stoi(match[1]))) << match.str();
    }
}

/// README → PHYSICS.md → the code of k and A.
TEST(Physics, KernelAndArcProfileAreTwoClicksFromTheReadme) {
    EXPECT_NE(text_of("README.md").find("](modules/diffraction/PHYSICS.md)"), std::string::npos);
    EXPECT_NE(text_of("modules/diffraction/PORTING.md").find("](PHYSICS.md)"), std::string::npos);
    std::string first_screen;
    for_each_line(text_of(kPhysics), [&](const std::string& line, int number) {
        if (number <= 35) first_screen += line + "\n";
    });
    EXPECT_NE(first_screen.find("](model/colour_kernel.cpp)"), std::string::npos);
    EXPECT_NE(first_screen.find("](reference/arc_profile.cpp)"), std::string::npos);
}

/// The anchor that a heading gets on a forge: lower case, blanks as hyphens, neither punctuation nor symbols (in
/// pages: those with two bytes from C2 on and three from E2 on).
std::string anchor_of(const std::string& heading) {
    std::string anchor;
    for (std::size_t i = 0; i < heading.size(); ++i) {
        const char c = heading[i];
        const auto byte = static_cast<unsigned char>(c);
        if (byte == 0xE2)
            i += 2;
        else if (byte == 0xC2)
            i += 1;
        else if (c == ' ')
            anchor += '-';
        else if (std::isalnum(byte) != 0 || c == '-' || c == '_' || byte >= 0x80)
            anchor += static_cast<char>(std::tolower(byte));
    }
    return anchor;
}

std::set<std::string> anchors_of(const std::string& page) {
    std::set<std::string> anchors;
    for_each_line(page, [&](const std::string& line, int) {
        const std::size_t text = line.find_first_not_of('#');
        if (text != std::string::npos && text > 0 && line[text] == ' ')
            anchors.insert(anchor_of(line.substr(text + 1)));
    });
    return anchors;
}

TEST(Pages, EveryLinkLeadsToAFileAndAHeading) {
    const std::filesystem::path top = test::source_path("");
    const std::regex link(R"(\]\(([^)\s]+)\))");
    int links = 0;
    for (const TreeFile& file : tree_files()) {
        if (!file.path.ends_with(".md")) continue;
        for (const std::smatch& match : matches(file.text, link)) {
            const std::string target = match[1];
            if (target.find("://") != std::string::npos) continue;
            ++links;
            const std::string where = file.path + ":" + std::to_string(line_at(file.text, match.position()));
            const std::string name = target.substr(0, target.find('#'));
            const std::filesystem::path path =
                (std::filesystem::path(file.path).parent_path() / name).lexically_normal();
            const std::string linked = name.empty() ? file.path : path.string();
            EXPECT_TRUE(std::filesystem::exists(top / linked)) << where << ": no file " << target;
            if (target.find('#') == std::string::npos || !linked.ends_with(".md")) continue;
            EXPECT_TRUE(anchors_of(text_of(linked)).contains(target.substr(target.find('#') + 1)))
                << where << ": no heading " << target;
        }
    }
    EXPECT_GT(links, 30);
}

}  // namespace
}  // namespace rowland::test
