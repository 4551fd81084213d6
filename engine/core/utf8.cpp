#include "engine/core/utf8.h"

#include <nlohmann/json.hpp>

#include "engine/core/error.h"

namespace rowland {

std::string valid_utf8(std::string_view text) {
    using Json = nlohmann::json;
    return Json::parse(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace)).get<std::string>();
}

std::string require_utf8(const std::filesystem::path& path, const std::string& remedy) {
    std::string text = path.string();
    if (valid_utf8(text) != text) refuse_input(text, {}, "a name that is not UTF-8", "one that JSON can hold", remedy);
    return text;
}

}  // namespace rowland
