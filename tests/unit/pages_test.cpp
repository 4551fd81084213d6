// Pages and comments refer to what exists (sections and formulas of PHYSICS.md, files, headings), and use standard
// terms: private usages of common words, which outsiders stumbled over, stay out of comments, names, messages and
// pages.

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string_view>
#include <vector>

#include "tests/support/files.h"

namespace rowland::test {
namespace {

constexpr const char* kThisFile = "tests/unit/pages_test.cpp";

/// A text file of the source tree, by its path from the top.
struct TreeFile {
    std::string path;
    std::string text;
};

bool is_text(const std::filesystem::path& path) {
    static const std::array<std::string_view, 8> extensions = {".h",  ".cpp", ".glsl",  ".md",
                                                               ".sh", ".py",  ".cmake", ".in"};
    const std::string extension = path.extension().string();
    for (const std::string_view known : extensions)
        if (extension == known) return true;
    return path.filename() == "CMakeLists.txt" || path.filename() == "rowland" ||
           path.filename() == "CMakePresets.json";
}

TreeFile read(const std::filesystem::path& top, const std::filesystem::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return {path.lexically_relative(top).generic_string(), text.str()};
}

/// Sources, pages, CMake files and scripts under engine, modules, editor, content, tests and at the top, but no data.
const std::vector<TreeFile>& tree_files() {
    static const std::vector<TreeFile> all = [] {
        const std::filesystem::path top = test::source_path("");
        std::vector<TreeFile> files;
        const auto add = [&](const std::filesystem::directory_entry& entry) {
            if (entry.is_regular_file() && is_text(entry.path())) files.push_back(read(top, entry.path()));
        };
        for (const auto& entry : std::filesystem::directory_iterator(top)) add(entry);
        for (const char* part : {"engine", "modules", "editor", "content", "tests"})
            for (const auto& entry : std::filesystem::recursive_directory_iterator(top / part)) add(entry);
        return files;
    }();
    return all;
}

/// Calls body(line, number) for each line; numbers begin at 1.
void for_each_line(const std::string& text, const std::function<void(const std::string& line, int number)>& body) {
    std::istringstream stream(text);
    int number = 0;
    for (std::string line; std::getline(stream, line);) body(line, ++number);
}

constexpr const char* kPhysics = "modules/diffraction/PHYSICS.md";
constexpr const char* kFilmPhysics = "modules/thin_film/PHYSICS.md";

/// The page that a file cites: that of the module it belongs to or tests.
std::string page_cited_by(const std::string& path) {
    return path.find("thin_film") == std::string::npos ? kPhysics : kFilmPhysics;
}

const std::string& text_of(const std::string& path) {
    static const std::string none;
    for (const TreeFile& file : tree_files())
        if (file.path == path) return file.text;
    ADD_FAILURE() << "no file " << path;
    return none;
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

/// Numbers of the formulas: "(n)", or "(section.n)" from the first section on, at the end of a line. They ascend.
std::set<std::string> formulas_of(const std::string& page) {
    std::set<std::string> formulas;
    std::string section;
    int last = 0;
    for_each_line(page, [&](const std::string& line, int) {
        static const std::regex heading("^## §(\\d+) .*");
        static const std::regex numbered(".*\\((\\d+(?:\\.\\d+)?)\\)$");
        std::smatch match;
        if (std::regex_match(line, match, heading)) {
            section = match[1].str() + ".";
            last = 0;
        } else if (std::regex_match(line, match, numbered)) {
            EXPECT_EQ(match[1].str(), section + std::to_string(++last)) << line;
            formulas.insert(match[1]);
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
    std::set<std::string> formulas;
};

void expect_cited(const Numbers& cited, const std::string& rest, const std::string& where) {
    static const std::regex citation("^PHYSICS" + kSpace + R"((?:§(\d+)|\((\d+(?:\.\d+)?)\))(?:,? "([^"]+)\")?)");
    std::smatch match;
    if (!std::regex_search(rest, match, citation)) {
        ADD_FAILURE() << where << ": PHYSICS without a section (§4) or a formula (4.1)";
        return;
    }
    if (match[2].matched) {
        EXPECT_TRUE(cited.formulas.contains(match[2])) << where << ": no formula (" << match[2] << ")";
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
        if (pages.contains(file.path) || file.path == kThisFile) continue;
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
        // §30 or (9.9) in the page's own text.
        for (const std::smatch& match : matches(numbers.page, std::regex("§(\\d+)")))
            EXPECT_TRUE(numbers.sections.contains(std::stoi(match[1]))) << match.str();
        for (const std::smatch& match : matches(numbers.page, std::regex(" \\((\\d\\d?(?:\\.\\d+)?)\\)")))
            EXPECT_TRUE(numbers.formulas.contains(match[1])) << match.str();
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
    EXPECT_NE(first_screen.find("](reference/incident_light.cpp)"), std::string::npos);
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
            const std::string linked = name.empty() ? file.path : path.generic_string();
            EXPECT_TRUE(std::filesystem::exists(top / linked)) << where << ": no file " << target;
            if (target.find('#') == std::string::npos || !linked.ends_with(".md")) continue;
            EXPECT_TRUE(anchors_of(text_of(linked)).contains(target.substr(target.find('#') + 1)))
                << where << ": no heading " << target;
        }
    }
    EXPECT_GT(links, 30);
}

/// `name()` or `Class::name()` in a page.
TEST(Pages, EveryFunctionThatTheyNameExists) {
    const std::regex word(R"(\w+)");
    std::set<std::string> words;
    for (const TreeFile& file : tree_files())
        if (!file.path.ends_with(".md") && file.path != kThisFile)
            words.insert(std::sregex_token_iterator(file.text.begin(), file.text.end(), word), {});
    const std::regex function(R"(`[\w:.]*?(\w+)\(\)`)");
    int functions = 0;
    for (const TreeFile& file : tree_files()) {
        if (!file.path.ends_with(".md") || file.path.starts_with("content/web/")) continue;
        for (const std::smatch& match : matches(file.text, function)) {
            ++functions;
            EXPECT_TRUE(words.contains(match[1]))
                << file.path << ":" << line_at(file.text, match.position()) << ": " << match.str();
        }
    }
    EXPECT_GT(functions, 40);
}

struct Term {
    const char* needle;   ///< in lower case: only lines that contain it are searched by `found`
    const char* found;    ///< regular expression of the usage, case-sensitive
    const char* write;    ///< what to write
    const char* allowed;  ///< regular expression of what is no such usage, removed from the line first; "" for none
};

const std::vector<Term>& terms() {
    static const std::vector<Term> all = {
        {"share", R"(\b([Aa]n?|[Tt]he|[Ii]ts|[Tt]heir|[Tt]his|[Tt]hat|[Ee]ach|[Nn]o|[Ww]hat|'s) (\w+ )?shares?\b)",
         "fraction, attenuation, visibility, part: what it is",
         R"((that|what|they|which|files?|programs?|they|two|both) share)"},
        {"share", R"(\bshares? (of|that)\b)", "fraction, attenuation, visibility, part: what it is", R"(\bshare that)"},
        {"share", R"([a-z0-9]_shares?\b|\bshares?_[a-z]|[a-z]Shares?\b|\bShares[A-Z]|[.>]shares?\b)",
         "a name that says what it is: attenuation, visibility, weight", ""},
        {"share", R"(\b(double|float|auto|vec[234]|int|T|float>|double>) shares?\b)",
         "a name that says what it is: fraction, weight", ""},
        {"place",
         R"([a-z0-9]_places?\b|\bplaces?_[a-z]|[.>]places?\b|\b(vec[234]|std::string|double|auto|pointer)&? places?\b)",
         "position; scale and bias; JSON pointer, location", "std::in_place"},
        {"place",
         R"(\b([Tt]he|[Ii]ts|[Aa]|[Ee]ach|[Ee]very|[Tt]hat|[Oo]ne|same|file and) places?\b|\bplaces (in|of|where|at|that)\b)",
         "position, location, point", R"(in (the )?place of|take[sn]? (the )?place|first place)"},
        {"twin", R"(\b[Tt]wins?\b)", "CPU reference", ""},
        {"yardstick", R"([Yy]ardstick)", "reference, ground truth", ""},
        {"of their own", R"(\blights? of (their|its) own)", "analytic lights, key lights", ""},
        {"by and by", R"(\b[Bb]y and by\b)", "incrementally", ""},
        {"now and then", R"(\b[Nn]ow and then\b)", "sometimes, and when", ""},
        {"dear", R"(\b[Dd]ear(er|est|ly)?\b)", "expensive", "Dear ImGui"},
        {"borne", R"(\bborne\b)", "tolerated, allowed", ""},
        {"bear", R"(\b(can|may|could) bear\b)", "tolerate, allow", ""},
        {" a",
         R"(\b([Ff]etch(es)?|[Ss]amples?|[Ll]ook-?ups?|[Dd]ots|products|multiply-adds|[Nn]odes|[Ss]teps|[Tt]exels|[Nn]umbers|matri(x|ces)|entries|[Ff]loats|[Bb]ytes|[Tt]aps|[Cc]oefficients|[Ff]rames|[Cc]ases|seconds|runs|lights|layers|[Dd]egrees|[Ww]avelengths|[Ww]eights?|look-ups) an? (pixel|vertex|texel|order|light|view|cell|channel|colour|second|frame|arc|panel|wave|octave|material|object|property|lobe|face|layer|bin|row|mesh|disc|sample|node|nanometre|metre|millimetre)\b)",
         "per pixel, per vertex, per …", ""},
        {"down", R"(\btakes? down what\b)", "updates the key, records", ""},
        {"told", R"(\btold_(by|of)\b|\btold by\b)", "discriminator; warned_…", ""},
        {"usual", R"(\b[Uu]sual\b|_usual\b|\busual_)", "default", R"(\busual")"},
        {"stands for", R"([Nn]othing stands for)", "nullopt", ""},
        {"texels", R"(\bLightTexels\b)", "LightSamples", ""},
        {"frame", R"(\bdiffraction::Frame\b)", "ShadingPoint", ""},
        {"order", R"(\bPlay::Order\b)", "Command", ""},
        {"up to date", R"(\b([Bb]ring|[Bb]rings|[Bb]rought|[Bb]ringing)\b.{0,24}\bup to date)", "update", ""},
        {"anew", R"(\b[Aa]new\b)", "again, rebuild", ""},
        {"gone", R"(\bgone\b|_gone\b|\bgone_)", "removed, missing, lost", ""},
        {"too", R"(, too\b|\b[Tt]oo[.;:)])", "also", ", too (many|slow)"},
        {"what is", R"(\b[Ww]hat is (\w+ ){1,2}(is|are|stays|goes)\b)", "the subject, then the verb", ""},
    };
    return all;
}

std::string lower_case(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

struct Compiled {
    std::regex found;
    std::regex allowed;
};

/// "file:line: found -> write ..." of each usage in a text.
std::vector<std::string> usages(const TreeFile& file) {
    static const std::vector<Compiled> compiled = [] {
        std::vector<Compiled> result;
        for (const Term& term : terms()) result.push_back({std::regex(term.found), std::regex(term.allowed)});
        return result;
    }();
    std::vector<std::string> result;
    for_each_line(file.text, [&](const std::string& line, int number) {
        const std::string lower = lower_case(line);
        for (std::size_t i = 0; i < terms().size(); ++i) {
            const Term& term = terms()[i];
            if (lower.find(term.needle) == std::string::npos) continue;
            const std::string searched =
                *term.allowed == '\0' ? line : std::regex_replace(line, compiled[i].allowed, "");
            std::smatch match;
            if (std::regex_search(searched, match, compiled[i].found))
                result.push_back(file.path + ":" + std::to_string(number) + ": \"" + match.str() +
                                 "\", write: " + term.write);
        }
    });
    return result;
}

TEST(Words, PrivateUsagesAreFoundAndOthersAreNot) {
    const auto count = [](const std::string& text) { return usages({"x", text}).size(); };
    for (const char* text :
         {"the share of light", "float punctual_share(Light light)", "double share = 1.0;", "table.shares[i]",
          "lights[0].place.xyz", "at its place in the file", "the shader and its twin", "two fetches a pixel",
          "filled by and by", "the dearest of them", "an error that can be borne", "map is made anew",
          "lights of their own", "brings the key up to date", "it is gone", "and this, too", "const Field usual;"})
        EXPECT_GE(count(text), 1U) << text;
    for (const char* text :
         {"two programs share nothing", "shared memory", "std::shared_ptr<int>", "the two share a table",
          "in place of it", "placeholder", "this takes place", "too many lights", "usually", "per pixel",
          "what is expected", "keep them up to date", "// The bearing", "undergone", "samples of a pixel"})
        EXPECT_EQ(count(text), 0U) << text;
}

TEST(Words, OfTheTreeAreStandardTerms) {
    std::size_t files = 0;
    for (const TreeFile& file : tree_files()) {
        if (file.path == kThisFile) continue;
        ++files;
        for (const std::string& usage : usages(file)) ADD_FAILURE() << usage;
    }
    EXPECT_GT(files, 500U);
}

}  // namespace
}  // namespace rowland::test
