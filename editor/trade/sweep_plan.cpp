#include "editor/trade/sweep_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "engine/math/spherical_harmonics.h"
namespace rowland::trade {

namespace {

using Values = std::vector<nlohmann::json>;

/// A member of a method, "key_lights" and "window" among them, and the values that it takes in turn.
struct Axis {
    const char* key;
    Values values;
};

/// The plan of one representation.
struct Variations {
    const char* representation;
    const char* first;                   ///< members of its first setting
    std::vector<Axis> axes;              ///< each is varied from the first setting
    std::vector<std::string> further{};  ///< members of further settings
};

std::vector<std::string> arc_combinations() {
    std::vector<std::string> settings;
    for (const int bands : {3, 8, 16})
        for (const int rank : {4, 8, 16})
            for (const int key_lights : {0, 16, 64})
                settings.push_back(fmt::format("bands={}/rank={}/storage=fp16/key_lights={}", bands, rank, key_lights));
    return settings;
}

const std::vector<Variations>& plans() {
    static const Values bands = {2, 3, 4, 6, 8, 10, 12, 16};
    static const Axis windows = {"window", {"lanczos", "hann"}};
    static const std::vector<Variations> all = {
        {"spikes",
         "bands=5/spikes=4/view_resolution=32/storage=unorm16/view_mapping=spherical",
         {{"bands", bands},
          {"spikes", {1, 2, 3, 6, 8, 12, 16}},
          {"view_resolution", {8, 16, 64, 128}},
          {"storage", {"fp32", "fp16", "unorm8"}},
          {"key_lights", {4, 8, 16, 32, 64}},
          windows},
         {"bands=5/spikes=4/view_resolution=64/storage=unorm16/view_mapping=parabolic",
          "bands=5/spikes=4/view_resolution=256/storage=unorm16/view_mapping=one-dimensional"}},
        {"arc",
         "bands=5/rank=8/storage=fp16/key_lights=16",
         {{"bands", bands},
          {"rank", {2, 4, 6, 12, 16}},
          {"storage", {"fp32", "unorm16", "unorm8"}},
          {"key_lights", {0, 4, 8, 32, 64}},
          windows},
         arc_combinations()},
        {"planar",
         "map_resolution=128/key_lights=16",
         {{"map_resolution", {16, 32, 64, 256, 512}}, {"key_lights", {0, 4, 32}}},
         {"map_resolution=64", "map_resolution=256", "map_resolution=512"}},
        {"circle",
         "map_resolution=104/key_lights=16",
         {{"map_resolution", {16, 24, 32, 48, 64, 80}}, {"angles", {0, 8, 20}}, {"key_lights", {0, 1, 2, 4, 8, 32}}}},
        {"streak", "", {{"map_resolution", {128, 192, 256}}}},
        {"direct", "key_lights=16", {{"key_lights", {4, 16, 64}}}}};
    return all;
}

/// A representation without a plan has its defaults alone.
Variations plan_of(const diffraction::RepresentationInfo& info) {
    const auto found = std::ranges::find(plans(), std::string_view(info.name), &Variations::representation);
    return found != plans().end() ? *found : Variations{info.name, "", {}};
}

std::string method_text(const std::string& representation, const std::string& members) {
    return members.empty() ? representation : representation + '/' + members;
}

diffraction::Method with_member(diffraction::Method method, const std::string& key, const nlohmann::json& value) {
    if (key == "key_lights")
        method.key_lights = value;
    else if (key == "window")
        method.window = math::parse_window(value.get<std::string>());
    else
        method.quality[key] = value;
    return method;
}

}  // namespace

std::vector<std::string> first_settings(const diffraction::GrooveLobe& lobe) {
    std::vector<std::string> result;
    for (const auto* info : diffraction::representations()) {
        const std::string text = method_text(info->name, plan_of(*info).first);
        if (!refusal(diffraction::parse_method(text), diffraction::Grating{.lobe = lobe})) result.push_back(text);
    }
    return result;
}

diffraction::Method paper_setting() {
    return diffraction::parse_method("spikes/bands=5/spikes=4");
}

std::vector<diffraction::Method> sweep_plan(const diffraction::GrooveLobe& lobe) {
    const diffraction::Grating grating{.lobe = lobe};
    std::vector<diffraction::Method> plan;
    const auto add = [&](const diffraction::Method& method) {
        if (!refusal(method, grating) && std::ranges::find(plan, method) == plan.end()) plan.push_back(method);
    };
    for (const std::string& text : first_settings(lobe)) add(diffraction::parse_method(text));
    for (const auto* info : diffraction::representations()) {
        const Variations variations = plan_of(*info);
        const auto first = diffraction::parse_method(method_text(info->name, variations.first));
        for (const Axis& axis : variations.axes)
            for (const nlohmann::json& value : axis.values) add(with_member(first, axis.key, value));
        for (const std::string& members : variations.further)
            add(diffraction::parse_method(method_text(info->name, members)));
    }
    return plan;
}

}  // namespace rowland::trade
