#include "engine/core/embedded_file.h"

#include "engine/core/check.h"

namespace rowland {

std::string_view embedded_text(std::span<const EmbeddedFile> files, std::string_view name) {
    for (const EmbeddedFile& file : files)
        if (file.name == name) return file.text;
    check_failed(__FILE__, __LINE__, fmt::format("no embedded file \"{}\"", name));
}

}  // namespace rowland
