#include "content/demo/looks/look.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "engine/core/log.h"
#include "modules/diffraction/asset/quality.h"

namespace rowland::demo {

namespace {

/// Settings by name, each at coarse, medium and fine detail.
using SettingsByDetail = std::map<std::string, std::array<int, 3>>;

/// The settings that the detail changes. Others keep their defaults, as do all settings of a representation without an
/// entry.
const SettingsByDetail& details_of(const std::string& representation) {
    static const std::map<std::string, SettingsByDetail> all{{"spikes", {{"bands", {3, 5, 8}}, {"spikes", {4, 4, 8}}}},
                                                             {"arc", {{"bands", {3, 5, 8}}, {"rank", {4, 8, 16}}}},
                                                             {"planar", {{"map_resolution", {32, 128, 256}}}},
                                                             {"circle", {{"map_resolution", {16, 48, 104}}}},
                                                             {"streak", {{"map_resolution", {128, 192, 320}}}}};
    static const SettingsByDetail none;
    const auto found = all.find(representation);
    return found != all.end() ? found->second : none;
}

nlohmann::json settings_of(const Look& look) {
    nlohmann::json settings = {{"representation", look.representation}};
    for (const auto& [key, values] : details_of(look.representation))
        settings[key] = values[static_cast<std::size_t>(look.detail)];
    return settings;
}

}  // namespace

const char* detail_name(Detail detail) {
    constexpr std::array kNames = {"coarse", "medium", "fine"};
    return kNames[static_cast<std::size_t>(detail)];
}

std::string look_name(const Look& look) {
    if (look.own()) return "as cooked";
    if (details_of(look.representation).empty()) return look.representation;
    return look.representation + ", " + detail_name(look.detail);
}

std::optional<Look> parse_look(std::string name) {
    if (name == look_name({})) return Look{};
    if (const auto old = name.find(", usual"); old != std::string::npos)
        name.replace(old, std::string::npos, ", medium");
    for (const auto* info : diffraction::representations())
        for (const Detail detail : {Detail::Medium, Detail::Coarse, Detail::Fine})
            if (const Look look{info->name, detail}; look_name(look) == name) return look;
    return std::nullopt;
}

std::optional<diffraction::Material> apply_look(const LookSubject& subject, const Look& look) {
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
    if (diffraction::groove_refusal(material, subject.grooves->pitches())) return std::nullopt;
    return diffraction::suited_to_grooves(std::move(material), subject.grooves->pitches());
}

std::vector<Look> suitable_looks(const LookSubject& subject, Detail detail) {
    std::vector<Look> looks{Look{.representation = {}, .detail = detail}};
    for (const auto* info : diffraction::representations()) {
        Look look{.representation = info->name, .detail = detail};
        if (apply_look(subject, look)) looks.push_back(std::move(look));
    }
    return looks;
}

Look next_representation(const LookSubject& subject, const Look& look) {
    const std::vector<Look> looks = suitable_looks(subject, look.detail);
    const auto at = std::find(looks.begin(), looks.end(), look);
    return at == looks.end() || at + 1 == looks.end() ? looks.front() : *(at + 1);
}

Look next_detail(const Look& look) {
    Look next = look;
    next.detail = static_cast<Detail>((static_cast<int>(look.detail) + 1) % 3);
    return next;
}

GpuMaterialPointer Variants::find_or_bake(const GpuMaterialPointer& own,
                                          const std::shared_ptr<const diffraction::GrooveMap>& grooves, bool flat,
                                          const Look& look) {
    if (look.own()) return own;
    for (const auto& variant : variants_)
        if (variant->own.lock() == own && variant->grooves == grooves && variant->look == look)
            return variant->uploaded;
    const LookSubject subject{.material = own->cooked()->material, .flat = flat, .grooves = grooves};
    variants_.push_back(std::make_shared<Variant>(
        Variant{.own = own, .grooves = grooves, .look = look, .material = apply_look(subject, look), .uploaded = {}}));
    return nullptr;
}

void Variants::poll() {
    const auto change = baked_.poll();
    if (change.value) running_->uploaded = diffraction::make_gpu_material(*baked_.value(), xyz_to_working_);
    if (!change.failure.empty()) log_error("{}: {}", look_name(running_->look), change.failure);
    if (change.value || !change.failure.empty()) running_ = nullptr;
    std::erase_if(variants_, [](const auto& variant) { return variant->own.expired(); });
    if (running_) return;
    const auto next = std::ranges::find_if(variants_, [](const auto& v) { return v->material.has_value(); });
    if (next == variants_.end()) return;
    running_ = *next;
    baked_.want(running_, [material = *std::exchange(running_->material, std::nullopt)](const auto&, const auto&) {
        return std::optional(diffraction::bake_material(material));
    });
}

bool Variants::baking() const {
    return running_ != nullptr ||
           std::ranges::any_of(variants_, [](const auto& variant) { return variant->material.has_value(); });
}

}  // namespace rowland::demo
