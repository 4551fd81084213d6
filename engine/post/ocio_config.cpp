#include "engine/post/ocio_config.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <sstream>
#include <string_view>
#include <system_error>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/json_reader.h"
#include "engine/post/shipped_config.h"

namespace OCIO = OCIO_NAMESPACE;

namespace rowland::post {

namespace {

constexpr std::uint64_t max_config_bytes = 64U << 20U;
constexpr const char* other_config_remedy =
    "name another configuration, or unset OCIO to use the one shipped with Rowland";

/// Takes a number off the front of the text.
std::optional<unsigned> take_number(std::string_view& text) {
    unsigned value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc()) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return value;
}

/// "ocio_profile_version: 2.1" → (2, 1); nothing if the text does not say.
std::optional<std::pair<unsigned, unsigned>> profile_version(std::string_view text) {
    constexpr std::string_view key = "ocio_profile_version";
    const std::size_t start = text.find(key);
    if (start == std::string_view::npos) return std::nullopt;
    text.remove_prefix(start + key.size());
    text.remove_prefix(std::min(text.find_first_not_of(" \t:"), text.size()));
    const std::optional<unsigned> major = take_number(text);
    if (!major) return std::nullopt;
    if (!text.starts_with('.')) return std::pair{*major, 0U};
    text.remove_prefix(1);
    return std::pair{*major, take_number(text).value_or(0)};
}

/// OpenColorIO gives a new configuration the latest version it knows.
std::pair<unsigned, unsigned> latest_version() {
    const OCIO::ConfigRcPtr config = OCIO::Config::Create();
    return {config->getMajorVersion(), config->getMinorVersion()};
}

void require_readable_version(const std::string& text, const std::string& source) {
    const auto version = profile_version(text);
    const auto latest = latest_version();
    if (!version || *version <= latest) return;
    throw Error({.file = source,
                 .place = {},
                 .found = fmt::format("a configuration of version {}.{}", version->first, version->second),
                 .expected = fmt::format("at most version {}.{}, the latest OpenColorIO {} reads", latest.first,
                                         latest.second, OCIO::GetVersion()),
                 .remedy =
                     "use a configuration made for it (of the ACES configurations, one named …_ocio-v2.1 or older), "
                     "or a later OpenColorIO"});
}

[[noreturn]] void fail_to_load(const std::string& source, const OCIO::Exception& exception) {
    throw Error({.file = source,
                 .place = {},
                 .found = exception.what(),
                 .expected = "a valid OpenColorIO configuration",
                 .remedy = other_config_remedy});
}

[[noreturn]] void fail_builtin_name(const std::string& source) {
    throw Error({.file = source,
                 .place = {},
                 .found = "the name of a configuration built into OpenColorIO",
                 .expected = fmt::format("a file: OpenColorIO {} has none built in", OCIO::GetVersion()),
                 .remedy = other_config_remedy});
}

std::vector<std::string> views_of(const OCIO::ConstConfigRcPtr& config, const std::string& display) {
    std::vector<std::string> names;
    for (int i = 0; i < config->getNumViews(display.c_str()); ++i) {
        names.emplace_back(config->getView(display.c_str(), i));
    }
    return names;
}

}  // namespace

OcioConfig::OcioConfig(OCIO::ConstConfigRcPtr config, std::string source)
    : config_(std::move(config)), source_(std::move(source)) {
    try {
        config_->validate();
    } catch (const OCIO::Exception& exception) {
        fail_to_load(source_, exception);
    }
}

OcioConfig OcioConfig::shipped() {
    std::istringstream text{std::string(shipped_config_file().front().text)};
    try {
        return {OCIO::Config::CreateFromStream(text), "rowland.ocio (built in)"};
    } catch (const OCIO::Exception& exception) {
        fail_to_load("rowland.ocio (built in)", exception);
    }
}

OcioConfig OcioConfig::from_named_file(const std::filesystem::path& path, const std::string& source) {
    const bool is_builtin_name = path.string().starts_with("ocio:");
    if (is_builtin_name && latest_version() < std::pair{2U, 2U}) fail_builtin_name(source);
    if (!is_builtin_name) {
        if (!std::filesystem::is_regular_file(path)) {
            throw Error({.file = source,
                         .place = {},
                         .found = "no such file",
                         .expected = "an OpenColorIO configuration",
                         .remedy = other_config_remedy});
        }
        require_readable_version(read_text_file(path, max_config_bytes), source);
    }
    try {
        return {OCIO::Config::CreateFromFile(path.c_str()), source};
    } catch (const OCIO::Exception& exception) {
        fail_to_load(source, exception);
    }
}

OcioConfig OcioConfig::from_file(const std::filesystem::path& path) {
    return from_named_file(path, path.string());
}

OcioConfig OcioConfig::choose(const std::optional<std::filesystem::path>& path) {
    if (path) return from_file(*path);
    const char* variable = std::getenv("OCIO");
    if (variable != nullptr && *variable != '\0') {
        return from_named_file(variable, fmt::format("{} (named by $OCIO)", variable));
    }
    return shipped();
}

std::vector<std::string> OcioConfig::displays() const {
    std::vector<std::string> names;
    for (int i = 0; i < config_->getNumDisplays(); ++i) names.emplace_back(config_->getDisplay(i));
    return names;
}

std::string OcioConfig::default_display() const {
    return config_->getDefaultDisplay();
}

std::vector<std::string> OcioConfig::views(const std::string& display) const {
    const std::vector<std::string> names = displays();
    if (std::find(names.begin(), names.end(), display) == names.end()) {
        const std::optional<std::string> nearest = nearest_word(display, names);
        throw Error({.file = source_,
                     .place = {},
                     .found = fmt::format("no display \"{}\"", display),
                     .expected = fmt::format("one of {}", names),
                     .remedy = nearest ? fmt::format("did you mean \"{}\"?", *nearest) : ""});
    }
    return views_of(config_, display);
}

std::string OcioConfig::default_view(const std::string& display) const {
    return config_->getDefaultView(display.c_str());
}

}  // namespace rowland::post
