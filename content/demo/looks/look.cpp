#include "content/demo/looks/look.h"

#include <algorithm>
#include <array>

#include "engine/core/error.h"
#include "engine/core/json_reader.h"
#include "modules/diffraction/asset/quality_json.h"

namespace rowland::demo {

namespace {

constexpr std::array kRepresentations = {"spikes", "arc", "transfer", "planar", "circle", "streak", "direct"};

/// A member of "quality", and its value at each detail.
struct Step {
    const char* key;
    std::array<int, 3> values;
};

std::vector<Step> steps_of(const std::string& representation) {
    if (representation == "spikes") return {{"bands", {3, 5, 8}}, {"spikes", {4, 4, 8}}};
    if (representation == "arc") return {{"bands", {3, 5, 8}}, {"rank", {4, 8, 16}}};
    if (representation == "transfer") return {{"bands", {3, 5, 8}}};
    if (representation == "planar") return {{"map_resolution", {32, 128, 256}}};
    if (representation == "circle") return {{"map_resolution", {16, 32, 64}}};
    if (representation == "streak") return {{"nodes", {4, 8, 16}}, {"taps", {1, 3, 5}}};
    return {};
}

nlohmann::json settings_of(const Look& look) {
    nlohmann::json settings = {{"representation", look.representation}};
    for (const Step& step : steps_of(look.representation))
        settings[step.key] = step.values[static_cast<std::size_t>(look.detail)];
    return settings;
}

}  // namespace

const char* detail_name(Detail detail) {
    constexpr std::array kNames = {"coarse", "medium", "fine"};
    return kNames[static_cast<std::size_t>(detail)];
}

std::string look_name(const Look& look) {
    if (look.own()) return "as cooked";
    if (steps_of(look.representation).empty()) return look.representation;
    return look.representation + ", " + detail_name(look.detail);
}

std::optional<Look> look_named(std::string name) {
    if (name == look_name({})) return Look{};
    if (const auto old = name.find(", usual"); old != std::string::npos)
        name.replace(old, std::string::npos, ", medium");
    for (const char* representation : kRepresentations)
        for (const Detail detail : {Detail::Medium, Detail::Coarse, Detail::Fine})
            if (const Look look{representation, detail}; look_name(look) == name) return look;
    return std::nullopt;
}

std::optional<diffraction::Material> with_look(const LookSubject& subject, const Look& look) {
    if (look.own()) return subject.material;
    if (look.representation == "planar" && !subject.flat) return std::nullopt;
    diffraction::Material material = subject.material;
    try {
        material.quality = diffraction::parse_quality(JsonReader(settings_of(look), "look"), material.grating, {});
        material.quality.max_error = subject.material.quality.max_error;
        material.quality.illuminant = subject.material.quality.illuminant;
        if (subject.grooves) material = diffraction::suit_to_grooves(material, *subject.grooves, "look", "");
    } catch (const Error&) {
        return std::nullopt;
    }
    return material;
}

std::vector<Look> looks_of(const LookSubject& subject, Detail detail) {
    std::vector<Look> looks{Look{.representation = {}, .detail = detail}};
    for (const char* name : kRepresentations) {
        Look look{.representation = name, .detail = detail};
        if (with_look(subject, look)) looks.push_back(std::move(look));
    }
    return looks;
}

Look next_representation(const LookSubject& subject, const Look& look) {
    const std::vector<Look> looks = looks_of(subject, look.detail);
    const auto at = std::find(looks.begin(), looks.end(), look);
    return at == looks.end() || at + 1 == looks.end() ? looks.front() : *(at + 1);
}

Look next_detail(const Look& look) {
    Look next = look;
    next.detail = static_cast<Detail>((static_cast<int>(look.detail) + 1) % 3);
    return next;
}

}  // namespace rowland::demo
