#pragma once

#include "modules/diffraction/asset/method.h"

namespace rowland::trade {

using Setting = diffraction::Method;
using diffraction::cook;
using diffraction::to_json;

inline Setting parse_setting(const std::string& text) {
    return diffraction::parse_method(text);
}
inline std::string setting_name(const Setting& setting) {
    return diffraction::method_name(setting);
}
inline Setting setting_from_json(const nlohmann::json& json, const std::string& file) {
    return diffraction::method_from_json(json, file);
}
inline std::string representation_of(const Setting& setting) {
    return diffraction::info(setting).name;
}

}  // namespace rowland::trade
