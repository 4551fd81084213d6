#include "modules/diffraction/asset/profile_json.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "modules/diffraction/asset/efficiency_csv.h"

namespace rowland::diffraction {

namespace {

EfficiencyTable parse_table(JsonReader& json, const char* key, const ReadNamed& read) {
    const std::string name = json.text(key);
    if (name.empty()) json.fail(key, "an empty name", "a CSV file of efficiencies");
    const NamedText table = read(name);
    return parse_efficiency_csv(table.text, table.file);
}

NumberRange range_of(const ProfileMember& member, double pitch_nm) {
    return {.minimum = 0.0,
            .maximum = member.within_pitch ? pitch_nm : member.less_than,
            .minimum_open = true,
            .maximum_open = !member.within_pitch && std::isfinite(member.less_than)};
}

}  // namespace

Profile parse_profile(JsonReader json, double pitch_nm, const ReadNamed& read) {
    const std::span<const ProfileDescriptor> descriptors = profile_descriptors();
    std::vector<std::string_view> names;
    for (const ProfileDescriptor& descriptor : descriptors) names.push_back(descriptor.name);
    const std::string type = json.choice("type", names);
    const auto named = std::find(names.begin(), names.end(), type) - names.begin();
    Profile profile = descriptors[static_cast<std::size_t>(named)].empty;
    for (const ProfileMember& member : descriptors[static_cast<std::size_t>(named)].members) {
        if (member.value == nullptr)
            profile = parse_table(json, member.key, read);
        else
            member.value(profile) = json.number(member.key, range_of(member, pitch_nm));
    }
    json.finish();
    return profile;
}

}  // namespace rowland::diffraction
