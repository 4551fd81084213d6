#include "content/demo/looks/look.h"

#include <algorithm>
#include <array>

#include "modules/diffraction/asset/quality_json.h"

namespace rowland::demo {

namespace {

/// Whether the representation has settings that the demo varies.
bool has_details(const diffraction::RepresentationInfo& info) {
    return std::any_of(info.settings.begin(), info.settings.end(),
                       [](const diffraction::SettingInfo& setting) { return !setting.details.empty(); });
}

nlohmann::json settings_of(const Look& look) {
    nlohmann::json settings = {{"representation", look.representation}};
    for (const diffraction::SettingInfo& setting : diffraction::find_representation(look.representation)->settings)
        if (!setting.details.empty()) settings[setting.key] = setting.details[static_cast<std::size_t>(look.detail)];
    return settings;
}

/// What the demo offers: not bins, which transfer tables beat.
std::vector<const diffraction::RepresentationInfo*> shown_representations() {
    std::vector<const diffraction::RepresentationInfo*> shown;
    for (const auto* info : diffraction::representations())
        if (info->in_demo) shown.push_back(info);
    return shown;
}

}  // namespace

const char* detail_name(Detail detail) {
    constexpr std::array kNames = {"coarse", "medium", "fine"};
    return kNames[static_cast<std::size_t>(detail)];
}

std::string look_name(const Look& look) {
    if (look.own()) return "as cooked";
    if (!has_details(*diffraction::find_representation(look.representation))) return look.representation;
    return look.representation + ", " + detail_name(look.detail);
}

std::optional<Look> look_named(std::string name) {
    if (name == look_name({})) return Look{};
    if (const auto old = name.find(", usual"); old != std::string::npos)
        name.replace(old, std::string::npos, ", medium");
    for (const auto* info : shown_representations())
        for (const Detail detail : {Detail::Medium, Detail::Coarse, Detail::Fine})
            if (const Look look{info->name, detail}; look_name(look) == name) return look;
    return std::nullopt;
}

std::optional<diffraction::Material> with_look(const LookSubject& subject, const Look& look) {
    if (look.own()) return subject.material;
    diffraction::Material material = subject.material;
    if (diffraction::find_representation(look.representation)->needs_flat_surface && !subject.flat) return std::nullopt;
    auto suited = diffraction::suited_quality(settings_of(look), material.grating);
    auto* quality = std::get_if<diffraction::Quality>(&suited);
    if (quality == nullptr) return std::nullopt;
    quality->max_error = material.quality.max_error;
    quality->illuminant = material.quality.illuminant;
    material.quality = std::move(*quality);
    if (!subject.grooves) return material;
    if (diffraction::groove_refusal(material, *subject.grooves)) return std::nullopt;
    return diffraction::suited_to_grooves(std::move(material), *subject.grooves);
}

std::vector<Look> looks_of(const LookSubject& subject, Detail detail) {
    std::vector<Look> looks{Look{.representation = {}, .detail = detail}};
    for (const auto* info : shown_representations()) {
        Look look{.representation = info->name, .detail = detail};
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
