#include "editor/trade/sweep_tables.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include "engine/core/check.h"

namespace rowland::trade {

namespace {

/// The settings that some representation has, each once.
std::vector<const char*> setting_columns() {
    std::vector<const char*> columns;
    for (const auto* info : diffraction::representations())
        for (const diffraction::SettingInfo& setting : info->settings)
            if (std::ranges::none_of(columns, [&](std::string_view known) { return known == setting.key; }))
                columns.push_back(setting.key);
    return columns;
}

/// A cell of a CSV file (RFC 4180).
std::string csv_cell(const nlohmann::ordered_json& value) {
    if (value.is_null()) return {};
    if (!value.is_string()) return value.dump();
    std::string text = value;
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    for (std::size_t at = 0; (at = text.find('"', at)) != std::string::npos; at += 2) text.insert(at, 1, '"');
    return '"' + text + '"';
}

}  // namespace

const CostRow& cost_of(const SweepResults& results, const ErrorRow& row) {
    const auto found = std::ranges::find_if(results.costs, [&](const CostRow& cost) {
        return cost.material == row.material && cost.setting == row.setting;
    });
    ROWLAND_CHECK(found != results.costs.end(), "every setting has its cost");
    return *found;
}

nlohmann::ordered_json sweep_row(const SweepResults& results, const ErrorRow& row) {
    const diffraction::Method& setting = results.settings[row.material][row.setting];
    nlohmann::ordered_json json = {{"material", results.materials[row.material]},
                                   {"probe", results.probes[row.probe]},
                                   {"set", row.set},
                                   {"setting", method_name(setting)},
                                   {"representation", info(setting).name}};
    for (const char* key : setting_columns()) json[key] = setting.quality.value(key, nlohmann::json());
    json["key_lights"] = setting.key_lights;
    json["window"] = math::window_name(setting.window);
    using Json = nlohmann::ordered_json;
    for (const auto& [name, value] : kErrorQuantities) json[name] = row.error.*value;
    json["hdr_flip"] = row.error.flip ? Json(*row.error.flip) : Json();
    const auto& [material, number, cost, time] = cost_of(results, row);
    json["frame_ms"] = time ? Json(time->ms) : Json();
    json["plain_ms"] = time ? Json(time->plain_ms) : Json();
    json["frame_ratio"] = time ? Json(time->ratio()) : Json();
    json["frame_spread"] = time && time->spread ? Json(*time->spread) : Json();
    json["other_load"] = time && time->other_load ? Json(*time->other_load) : Json();
    json["fetches_per_vertex"] = cost.fetches_per_vertex;
    json["multiply_adds_per_vertex"] = cost.multiply_adds_per_vertex;
    json["fetches_per_pixel"] = cost.fetches_per_pixel;
    json["multiply_adds_per_pixel"] = cost.multiply_adds_per_pixel;
    json["fetches_per_light"] = cost.fetches_per_light;
    json["table_bytes"] = cost.table_bytes;
    json["vertex_bytes"] = cost.vertex_bytes;
    return json;
}

std::string sweep_csv(const SweepResults& results) {
    std::string text;
    for (const ErrorRow& row : results.errors) {
        std::string names;
        std::string cells;
        const nlohmann::ordered_json columns = sweep_row(results, row);
        for (const auto& [name, value] : columns.items()) {
            names += (names.empty() ? "" : ",") + name;
            cells += (cells.empty() ? "" : ",") + csv_cell(value);
        }
        if (text.empty()) text = names + '\n';
        text += cells + '\n';
    }
    return text;
}

std::string sweep_json_lines(const SweepResults& results) {
    std::string text;
    for (const ErrorRow& row : results.errors) {
        const nlohmann::ordered_json columns = sweep_row(results, row);
        nlohmann::ordered_json json;
        for (const auto& [name, value] : columns.items())
            if (!value.is_null()) json[name] = value;
        text += json.dump() + '\n';
    }
    return text;
}

}  // namespace rowland::trade
