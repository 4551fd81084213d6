// Standard terms: private usages of common words, which outsiders stumbled over, stay out of comments, names, messages
// and pages.
#include <gtest/gtest.h>

#include <cctype>
#include <regex>
#include <string>
#include <vector>

#include "tests/unit/tree_text.h"

namespace rowland::test {
namespace {

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
        if (file.path == "tests/unit/words_test.cpp") continue;
        ++files;
        for (const std::string& usage : usages(file)) ADD_FAILURE() << usage;
    }
    EXPECT_GT(files, 1000U);
}

}  // namespace
}  // namespace rowland::test
