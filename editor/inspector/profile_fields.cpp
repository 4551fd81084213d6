#include "editor/inspector/profile_fields.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "modules/diffraction/model/profile.h"

namespace rowland::inspector {

namespace {

using diffraction::ProfileDescriptor;
using diffraction::ProfileMember;

/// A member as the profile starts with it; whole numbers are written without a fraction.
Json initial_value(const ProfileMember& member) {
    if (member.value == nullptr) return "";
    if (member.initial == std::floor(member.initial)) return static_cast<std::int64_t>(member.initial);
    return member.initial;
}

bool is_table(const ProfileDescriptor& descriptor) {
    return std::holds_alternative<diffraction::EfficiencyTable>(descriptor.empty);
}

Choice choice_of_profile(const ProfileDescriptor& descriptor) {
    Json profile = {{"type", descriptor.name}};
    for (const ProfileMember& member : descriptor.members) profile[member.key] = initial_value(member);
    return {std::string(descriptor.name), profile};
}

Field profile_field(const Field& choice, const ProfileMember& member) {
    Field field{.pointer = choice.pointer + "/" + member.key,
                .label = member.label,
                .unit = member.unit,
                .default_value = initial_value(member),
                .required = true,
                .only_with = choice.pointer,
                .help = member.help,
                .source = member.source};
    if (member.value == nullptr) {
        field.kind = FieldKind::Name;
    } else {
        field.minimum = member.slider_least;
        field.maximum = member.slider_most;
    }
    return field;
}

}  // namespace

std::vector<Field> profile_fields(Field choice, bool with_table) {
    std::vector<Field> result = {choice};
    for (const ProfileDescriptor& descriptor : diffraction::profile_descriptors()) {
        if (is_table(descriptor) && !with_table) continue;
        result.front().choices.push_back(choice_of_profile(descriptor));
        for (const ProfileMember& member : descriptor.members) {
            Field field = profile_field(choice, member);
            const auto known = std::find_if(result.begin(), result.end(),
                                            [&](const Field& other) { return other.pointer == field.pointer; });
            Field& shown = known != result.end() ? *known : result.emplace_back(std::move(field));
            shown.only_for.emplace_back(descriptor.name);
        }
    }
    if (result.front().default_value.is_null()) result.front().default_value = result.front().choices.front().value;
    return result;
}

}  // namespace rowland::inspector
