// Keeps the walls between the parts: reads every #include of the tree.

#include <fstream>
#include <vector>

#include "tests/support/files.h"

namespace rowland {
namespace {

struct Wall {
    std::string folder;                  ///< files under it ...
    std::vector<std::string> forbidden;  ///< ... include nothing whose path begins so
};

const std::vector<std::string> kGraphics = {
    "engine/gpu/", "engine/platform/", "engine/render/", "engine/post/", "epoxy/", "GL/", "GLFW/", "EGL/"};

std::vector<std::string> with_graphics(std::vector<std::string> folders) {
    folders.insert(folders.end(), kGraphics.begin(), kGraphics.end());
    return folders;
}

std::vector<Wall> walls() {
    return {
        {"engine/", {"modules/", "content/", "editor/", "tests/"}},
        {"modules/", {"content/", "editor/", "tests/"}},
        {"editor/", {"content/", "tests/"}},
        {"content/", {"editor/", "tests/"}},
        {"modules/diffraction/model/", with_graphics({"modules/diffraction/bake/", "modules/diffraction/reference/"})},
        {"modules/diffraction/reference/", with_graphics({"modules/diffraction/bake/"})},
        {"modules/diffraction/rigorous/",
         with_graphics({"modules/diffraction/bake/", "modules/diffraction/reference/", "modules/diffraction/asset/",
                        "modules/diffraction/representations/", "engine/lighting/"})},
        {"modules/diffraction/bake/", with_graphics({"modules/diffraction/reference/"})},
        {"modules/diffraction/asset/", with_graphics({"modules/diffraction/reference/"})},
        {"modules/diffraction/evaluate/", kGraphics},
        {"modules/diffraction/representations/",
         with_graphics({"modules/diffraction/runtime/", "modules/diffraction/reference/"})},
        {"modules/diffraction/foil/", with_graphics({"modules/diffraction/reference/", "modules/diffraction/bake/",
                                                     "modules/diffraction/evaluate/", "engine/cook/"})},
        {"modules/diffraction/portable/", with_graphics({"modules/diffraction/reference/"})},
        {"modules/diffraction/runtime/", {"modules/diffraction/reference/", "modules/diffraction/evaluate/"}},
        {"modules/thin_film/", {"modules/diffraction/"}},
        {"modules/diffraction/", {"modules/thin_film/"}},
        {"modules/thin_film/model/", with_graphics({"modules/thin_film/bake/", "modules/thin_film/asset/"})},
        {"modules/thin_film/reference/", with_graphics({"modules/thin_film/bake/", "modules/thin_film/asset/"})},
        {"modules/thin_film/bake/", with_graphics({"modules/thin_film/asset/"})},
        {"modules/thin_film/asset/", kGraphics},
        {"modules/thin_film/cook.", kGraphics},
        {"engine/math/", with_graphics({"engine/lighting/", "engine/scene/", "engine/cook/"})},
        {"engine/lighting/", kGraphics},
        {"engine/scene/", kGraphics},
        {"engine/cook/", with_graphics({"engine/lighting/", "engine/scene/"})},
        {"engine/live/", kGraphics},
        {"engine/module.", kGraphics},
        {"modules/asset_types.", kGraphics},
        {"modules/diffraction/cook.", kGraphics},
    };
}

bool begins_with(const std::string& text, const std::string& prefix) {
    return text.compare(0, prefix.size(), prefix) == 0;
}

bool is_source(const std::filesystem::path& path) {
    const std::string extension = path.extension().string();
    return extension == ".h" || extension == ".cpp" || extension == ".glsl";
}

/// The path of an #include line, or nothing.
std::string included(const std::string& line) {
    const std::size_t hash = line.find_first_not_of(" \t");
    if (hash == std::string::npos || line[hash] != '#') return "";
    const std::size_t word = line.find_first_not_of(" \t", hash + 1);
    if (word == std::string::npos || line.compare(word, 7, "include") != 0) return "";
    const std::size_t open = line.find_first_of("\"<", word);
    const std::size_t close = line.find_first_of("\">", open + 1);
    if (open == std::string::npos || close == std::string::npos) return "";
    return line.substr(open + 1, close - open - 1);
}

std::vector<std::string> includes_of(const std::filesystem::path& path) {
    std::vector<std::string> result;
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);)
        if (const std::string name = included(line); !name.empty()) result.push_back(name);
    return result;
}

TEST(IncludeWalls, NoPartIncludesWhatItMustNotKnow) {
    const std::filesystem::path top = rowland::test::source_path("");
    std::size_t includes_read = 0;
    for (const char* part : {"engine", "modules", "editor", "content", "tests"}) {
        for (const auto& entry : std::filesystem::recursive_directory_iterator(top / part)) {
            if (!entry.is_regular_file() || !is_source(entry.path())) continue;
            const std::string file = entry.path().lexically_relative(top).string();
            for (const std::string& include : includes_of(entry.path())) {
                ++includes_read;
                for (const Wall& wall : walls())
                    for (const std::string& forbidden : wall.forbidden)
                        EXPECT_FALSE(begins_with(file, wall.folder) && begins_with(include, forbidden))
                            << file << " includes " << include;
            }
        }
    }
    EXPECT_GT(includes_read, 500U);  // the scan reads the tree, not an empty folder
}

}  // namespace
}  // namespace rowland
