#include "engine/app/unused_file.h"

#include <fmt/format.h>

namespace rowland::app {

std::filesystem::path unused_file(const std::filesystem::path& folder, const std::string& stem,
                                  const std::string& extension) {
    for (int number = 0;; ++number) {
        std::filesystem::path path = folder / fmt::format("{}_{:04}{}", stem, number, extension);
        // A broken link is a name that is taken.
        if (std::error_code unknown; !std::filesystem::exists(std::filesystem::symlink_status(path, unknown)))
            return path;
    }
}

}  // namespace rowland::app
