#include <algorithm>
#include <nlohmann/json.hpp>

namespace nlohmann {

namespace {

/// The end of the string that begins at `at`.
std::size_t end_of_string(std::string_view text, std::size_t at) {
    for (++at; text[at] != '"'; ++at)
        if (text[at] == '\\') ++at;
    return at + 1;
}

}  // namespace

json json::parse(std::string_view text) {
    json value;
    if (text[0] != '{' && text[0] != '[') {
        value.text_ = text;
        return value;
    }
    std::size_t begin = 1;  // of the current element
    int depth = 0;
    for (std::size_t at = 1; at < text.size(); ++at) {
        const char c = text[at];
        const bool ends = depth == 0 && (c == ',' || c == '}' || c == ']');
        if (ends && at > begin) value.values_.push_back(parse(text.substr(begin, at - begin)));
        if (ends) begin = at + 1;
        if (c == '{' || c == '[') ++depth;
        if (c == '}' || c == ']') --depth;
        if (c != '"') continue;
        const std::size_t end = end_of_string(text, at);
        if (depth == 0 && text[end] == ':') {
            value.keys_.push_back(json(parse(text.substr(at, end - at))).string());
            begin = end + 1;
        }
        at = end - 1;
    }
    value.text_ = text;
    return value;
}

std::string json::string() const {
    std::string plain;
    for (std::size_t i = 1; i + 1 < text_.size(); ++i) {
        if (text_[i] != '\\') {
            plain += text_[i];
            continue;
        }
        constexpr std::string_view kShort = "bfnrt";
        const char c = text_[++i];
        const std::size_t which = kShort.find(c);
        plain += which != std::string_view::npos ? "\b\f\n\r\t"[which] : c == 'u' ? '?' : c;
        if (c == 'u') i += 4;  // no name or enumerated value of a material has such a character
    }
    return plain;
}

const json* json::find(std::string_view key) const {
    return begin() + (std::find(keys_.begin(), keys_.end(), key) - keys_.begin());
}

json& json::operator[](const char* key) {
    const auto at = static_cast<std::size_t>(find(key) - begin());
    if (at == values_.size()) {
        keys_.emplace_back(key);
        values_.emplace_back();
    }
    return values_[at];
}

std::vector<std::pair<std::string, json>> json::items() const {
    std::vector<std::pair<std::string, json>> all;
    for (std::size_t i = 0; i < keys_.size(); ++i) all.emplace_back(keys_[i], values_[i]);
    return all;
}

}  // namespace nlohmann
