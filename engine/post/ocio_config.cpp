#include "engine/post/ocio_config.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <optional>
#include <regex>
#include <sstream>
#include <string>

#include "engine/colour/colour_space.h"
#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/json_reader.h"
#include "engine/core/log.h"
#include "engine/core/system.h"
#include "engine/post/computed_views.h"

namespace OCIO = OCIO_NAMESPACE;

namespace rowland::post {

namespace {

constexpr std::uint64_t max_config_bytes = 64U << 20U;
constexpr const char* other_config_remedy =
    "name another configuration, or unset OCIO to use the one shipped with Rowland";

/// "ocio_profile_version: 2.1" → (2, 1); null if the text has none.
std::optional<std::pair<unsigned, unsigned>> profile_version(const std::string& text) {
    static const std::regex pattern(R"(ocio_profile_version[ \t:]*(\d{1,9})(?:\.(\d{1,9}))?)");
    const std::size_t start = std::min(text.find("ocio_profile_version"), text.size());
    std::cmatch match;
    if (!std::regex_search(text.c_str() + start, match, pattern, std::regex_constants::match_continuous))
        return std::nullopt;
    const auto number = [&](std::size_t i) { return match[i].matched ? std::stoul(match[i].str()) : 0UL; };
    return std::pair{static_cast<unsigned>(number(1)), static_cast<unsigned>(number(2))};
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
    refuse_input(source, {}, fmt::format("a configuration of version {}.{}", version->first, version->second),
                 fmt::format("at most version {}.{}, the latest OpenColorIO {} reads", latest.first, latest.second,
                             OCIO::GetVersion()),
                 "use a configuration made for it (of the ACES configurations, one named …_ocio-v2.1 or older), "
                 "or a later OpenColorIO");
}

[[noreturn]] void fail_to_load(const std::string& source, const OCIO::Exception& exception) {
    refuse_input(source, {}, exception.what(), "a valid OpenColorIO configuration", other_config_remedy);
}

[[noreturn]] void fail_builtin_name(const std::string& source) {
    refuse_input(source, {}, "the name of a configuration built into OpenColorIO",
                 fmt::format("a file: OpenColorIO {} has none built in", OCIO::GetVersion()), other_config_remedy);
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
    const ClassicLocale classic;
    std::istringstream text{std::string(shipped_config_file().front().text)};
    try {
        const OCIO::ConfigRcPtr config = OCIO::Config::CreateFromStream(text)->createEditableCopy();
        add_computed_views(*config);
        return {config, "rowland.ocio (built in)"};
    } catch (const OCIO::Exception& exception) {
        fail_to_load("rowland.ocio (built in)", exception);
    }
}

OcioConfig OcioConfig::from_named_file(const std::filesystem::path& path, const std::string& source) {
    const ClassicLocale classic;
    const bool is_builtin_name = path.string().starts_with("ocio:");
    if (is_builtin_name && latest_version() < std::pair{2U, 2U}) fail_builtin_name(source);
    if (!is_builtin_name) {
        if (!std::filesystem::is_regular_file(path)) {
            refuse_input(source, {}, "no such file", "an OpenColorIO configuration", other_config_remedy);
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
    const auto variable = environment_variable("OCIO");
    if (variable && !variable->empty())
        return from_named_file(*variable, fmt::format("{} (named by $OCIO)", *variable));
    return shipped();
}

void OcioConfig::prefer(const std::string& display, const std::string& view) {
    const std::string shown = display.empty() ? default_display() : display;
    require_view(shown, view.empty() ? default_view(shown) : view);
    if (!display.empty() && display != default_display()) preferred_view_.clear();
    preferred_display_ = shown;
    if (!view.empty()) preferred_view_ = view;
}

void OcioConfig::require_view(const std::string& display, const std::string& view) const {
    const std::vector<std::string> names = views(display);
    if (std::find(names.begin(), names.end(), view) != names.end()) return;
    const std::optional<std::string> nearest = nearest_word(view, names);
    refuse_input(source_, fmt::format("display \"{}\"", display), fmt::format("no view \"{}\"", view),
                 fmt::format("one of {}", names), nearest ? fmt::format("did you mean \"{}\"?", *nearest) : "");
}

std::vector<std::string> OcioConfig::displays() const {
    std::vector<std::string> names;
    for (int i = 0; i < config_->getNumDisplays(); ++i) names.emplace_back(config_->getDisplay(i));
    return names;
}

std::string OcioConfig::default_display() const {
    return preferred_display_.empty() ? config_->getDefaultDisplay() : preferred_display_;
}

std::vector<std::string> OcioConfig::views(const std::string& display) const {
    const std::vector<std::string> names = displays();
    if (std::find(names.begin(), names.end(), display) == names.end()) {
        const std::optional<std::string> nearest = nearest_word(display, names);
        refuse_input(source_, {}, fmt::format("no display \"{}\"", display), fmt::format("one of {}", names),
                     nearest ? fmt::format("did you mean \"{}\"?", *nearest) : "");
    }
    return views_of(config_, display);
}

std::string OcioConfig::default_view(const std::string& display) const {
    const bool preferred = !preferred_view_.empty() && display == default_display();
    return preferred ? preferred_view_ : config_->getDefaultView(display.c_str());
}

namespace {

constexpr const char* aces_interchange = "aces_interchange";
constexpr const char* xyz_interchange = "cie_xyz_d65_interchange";

OCIO::TransformRcPtr between_spaces(const char* from, const char* to) {
    const OCIO::ColorSpaceTransformRcPtr transform = OCIO::ColorSpaceTransform::Create();
    transform->setSrc(from);
    transform->setDst(to);
    return transform;
}

bool is_scene_space(const OcioConfig& config, const char* role) {
    if (!config.ocio()->hasRole(role)) return false;
    return config.ocio()->getColorSpace(role)->getReferenceSpaceType() == OCIO::REFERENCE_SPACE_SCENE;
}

/// ACEScg → scene_linear by OpenColorIO.
OCIO::GroupTransformRcPtr acescg_to_scene_linear_transform(const OcioConfig& config) {
    OCIO::GroupTransformRcPtr group = OCIO::GroupTransform::Create();
    group->appendTransform(builtin_transform("ACEScg_to_ACES2065-1"));
    if (is_scene_space(config, aces_interchange)) {
        group->appendTransform(between_spaces(aces_interchange, OCIO::ROLE_SCENE_LINEAR));
    } else if (is_scene_space(config, xyz_interchange)) {
        group->appendTransform(builtin_transform("UTILITY - ACES-AP0_to_CIE-XYZ-D65_BFD"));
        group->appendTransform(between_spaces(xyz_interchange, OCIO::ROLE_SCENE_LINEAR));
    } else {
        log_warning("{}: no role {}, so scene_linear is taken to be ACEScg; add the role if it is not", config.source(),
                    aces_interchange);
        return OCIO::GroupTransform::Create();
    }
    return group;
}

/// The processor as a matrix, found from the images of the unit vectors; null if it maps a further vector otherwise.
std::optional<glm::dmat3> as_matrix(const OCIO::ConstCPUProcessorRcPtr& processor) {
    const auto image = [&](glm::vec3 value) {
        processor->applyRGB(&value.x);
        return glm::dvec3(value);
    };
    const glm::dmat3 matrix(image({1, 0, 0}), image({0, 1, 0}), image({0, 0, 1}));
    const glm::vec3 probe(4.0F, -0.5F, 0.125F);
    const double difference = glm::length(matrix * glm::dvec3(probe) - image(probe));
    // A few float roundings of numbers near 4; a curve or an offset is off by far more.
    if (!(difference < 1e-4)) return std::nullopt;
    return matrix;
}

[[noreturn]] void fail(const OcioConfig& config, std::string found) {
    refuse_input(config.source(), "role scene_linear", std::move(found), "a colour space that is linear in XYZ",
                 "set the role scene_linear, to ACEScg for one");
}

}  // namespace

glm::dmat3 xyz_to_scene_linear(const OcioConfig& config) {
    if (!config.ocio()->hasRole(OCIO::ROLE_SCENE_LINEAR)) fail(config, "no such role");
    try {
        const OCIO::ConstProcessorRcPtr processor =
            config.ocio()->getProcessor(acescg_to_scene_linear_transform(config));
        if (const auto matrix = as_matrix(processor->getDefaultCPUProcessor()))
            return *matrix * colour::xyz_to_acescg();
    } catch (const OCIO::Exception& exception) {
        fail(config, exception.what());
    }
    fail(config, "a colour space that is not linear");
}

glm::vec3 luminance_weights(const OcioConfig& config) {
    return {glm::row(glm::inverse(xyz_to_scene_linear(config)), 1)};
}

}  // namespace rowland::post
