#pragma once

#include <string>

#include "engine/core/json_reader.h"
#include "modules/diffraction/asset/material_json.h"
#include "tests/support/message_of.h"

namespace rowland::diffraction::test {

/// The material file of this text.
inline Material parse(const std::string& text) {
    return parse_material(parse_json(text, "m.json"), "m.json");
}

/// The message that refuses it.
inline std::string refusal(const std::string& text) {
    return rowland::test::message_of([&] { parse(text); });
}

/// A material of a slit grating with more members.
inline std::string grating(const std::string& more) {
    return R"({"grating": {"pitch_nm": 1600, "profile": {"type": "slit", "width_nm": 800})" + more + "}}";
}

}  // namespace rowland::diffraction::test
