#include "editor/trade/report.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <string_view>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "editor/trade/journal.h"
#include "editor/trade/stage.h"
#include "editor/trade/sweep_plan.h"
#include "engine/colour/colour_space.h"
#include "engine/core/check.h"
#include "engine/core/text.h"
#include "modules/diffraction/asset/material.h"

namespace rowland::trade {

/// report.html: the page of the report without its data.
std::span<const EmbeddedFile> report_files();

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

struct Texel {
    double luminance;
    double solid_angle;
};

/// The light of the brightest texels within a total solid angle; the last texel counts in part.
double brightest(const std::vector<Texel>& descending, double solid_angle) {
    double light = 0.0;
    for (const Texel& texel : descending) {
        const double counted = std::min(texel.solid_angle, solid_angle);
        light += counted * texel.luminance;
        solid_angle -= counted;
        if (solid_angle <= 0.0) break;
    }
    return light;
}

constexpr std::size_t kDiscVertices = 25000;

nlohmann::ordered_json representation_names() {
    nlohmann::ordered_json names;
    for (const auto* info : diffraction::representations()) names.push_back(info->name);
    return names;
}

/// A row of the sweep's table, with "memory" (bytes of its tables and of the light at the disc's vertices), and "paper"
/// if it is the paper's setting.
nlohmann::ordered_json panel_row(const SweepResults& results, const ErrorRow& error) {
    const CostRow& cost = cost_of(results, error);
    nlohmann::ordered_json row = sweep_row(results, error);
    row["memory"] = cost.cost.table_bytes + cost.cost.vertex_bytes * kDiscVertices;
    if (results.settings[error.material][error.setting] == paper_setting()) row["paper"] = true;
    return row;
}

void mark_front(const char* cost, const char* mark, nlohmann::ordered_json& rows) {
    std::vector<TradePoint> points;
    for (const auto& row : rows)
        points.push_back({row[cost].is_null() ? std::numeric_limits<double>::infinity() : row[cost].get<double>(),
                          row["relative_rms"].get<double>()});
    for (const std::size_t i : pareto_front(points)) rows[i][mark] = true;
}

/// The material for the page in a browser, without "quality", with the theory that it has here; null if its
/// efficiencies come from a table.
nlohmann::json browser_material(const std::filesystem::path& path) {
    nlohmann::json json = diffraction::load_material_json(path);
    const diffraction::Material material = diffraction::parse_material(json, path.string());
    if (std::holds_alternative<diffraction::EfficiencyTable>(material.grating.profile)) return nullptr;
    json.erase("quality");
    if (material.grating.theory == diffraction::Theory::Rigorous) json["grating"]["theory"] = "rigorous";
    return json;
}

nlohmann::ordered_json panels(const SweepResults& results, const SweepInputs& inputs,
                              const std::vector<TheoryError>& theories) {
    std::vector<nlohmann::json> materials(results.materials.size());
    std::ranges::transform(inputs.materials, materials.begin(), browser_material);
    std::map<std::tuple<std::size_t, std::size_t, std::string>, nlohmann::ordered_json> panels;
    std::vector<std::tuple<std::size_t, std::size_t, std::string>> order;  // sets as they were measured
    for (const ErrorRow& error : results.errors) {
        const auto key = std::tuple(error.material, error.probe, error.set);
        if (!panels.contains(key)) order.push_back(key);
        panels[key].push_back(panel_row(results, error));
    }
    std::ranges::stable_sort(order, {}, [](const auto& key) { return std::pair(std::get<0>(key), std::get<1>(key)); });
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const auto& key : order) {
        const auto& [material, probe, set] = key;
        mark_front("frame_ratio", "front_speed", panels[key]);
        mark_front("memory", "front_memory", panels[key]);
        const auto theory = std::ranges::find_if(
            theories, [&](const TheoryError& of) { return std::tuple(of.material, of.probe, of.set) == key; });
        list.push_back({{"material", results.materials[material]},
                        {"probe", results.probes[probe]},
                        {"set", set},
                        {"theory_error",
                         theory == theories.end() ? nlohmann::ordered_json() : nlohmann::ordered_json(theory->error)},
                        {"browser_material", materials[material]},
                        {"rows", panels[key]}});
    }
    return list;
}

nlohmann::ordered_json probes(const SweepResults& results, const std::vector<ProbeStatistics>& statistics) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < statistics.size(); ++i) {
        const ProbeStatistics& probe = statistics[i];
        list.push_back({{"name", results.probes[i]},
                        {"size", {probe.width, probe.height}},
                        {"mean", probe.mean},
                        {"peak_over_mean", probe.peak_over_mean},
                        {"brightest_fraction", probe.brightest_fraction}});
    }
    return list;
}

nlohmann::ordered_json films(const SweepResults& results, const std::vector<std::vector<FilmRow>>& of_probes) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (std::size_t probe = 0; probe < of_probes.size(); ++probe)
        for (const FilmRow& row : of_probes[probe])
            list.push_back({{"probe", results.probes[probe]},
                            {"film", row.film},
                            {"roughness", row.roughness},
                            {"method", row.method},
                            {"relative_rms", row.relative_rms},
                            {"table_bytes", row.table_bytes},
                            {"fetches", row.fetches},
                            {"multiply_adds", row.multiply_adds},
                            {"functions", row.functions}});
    return list;
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

std::vector<std::size_t> pareto_front(std::span<const TradePoint> points) {
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::erase_if(order,
                  [&](std::size_t i) { return !std::isfinite(points[i].cost) || !std::isfinite(points[i].error); });
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        if (points[a].cost != points[b].cost) return points[a].cost < points[b].cost;
        return points[a].error < points[b].error;
    });
    std::vector<std::size_t> front;
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t i : order)
        if (points[i].error < least) {
            least = points[i].error;
            front.push_back(i);
        }
    return front;
}

ProbeStatistics statistics_of(const lighting::ProbeImage& probe) {
    constexpr double kSphere = 4.0 * std::numbers::pi;
    const image::Image& image = probe.image();
    std::vector<Texel> texels;
    double light = 0.0;
    for (int row = 0; row < image.height; ++row)
        for (int column = 0; column < image.width; ++column) {
            const auto index = static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) +
                               static_cast<std::size_t>(column);
            const Texel texel{colour::luminance(image.texels[index]), probe.solid_angle(column, row)};
            if (texel.solid_angle <= 0.0) continue;
            texels.push_back(texel);
            light += texel.luminance * texel.solid_angle;
        }
    std::ranges::sort(texels, std::ranges::greater(), &Texel::luminance);
    ProbeStatistics result{.width = image.width, .height = image.height, .mean = light / kSphere};
    if (light <= 0.0) return result;
    result.peak_over_mean = texels.front().luminance / result.mean;
    result.brightest_fraction = brightest(texels, 1e-3 * kSphere) / light;
    return result;
}

std::vector<std::size_t> pictured_settings(const SweepResults& results, std::size_t material, std::size_t probe) {
    const ErrorRow* best = nullptr;
    for (const ErrorRow& row : results.errors) {
        if (row.material != material || row.probe != probe || row.set != "picture") continue;
        const CostRow& cost = cost_of(results, row);
        if (cost.time && cost.time->ratio() > kRealTimeRatio) continue;
        if (best == nullptr || row.error.relative_rms < best->error.relative_rms) best = &row;
    }
    std::vector<std::size_t> settings = {0};
    if (best != nullptr && best->setting != 0) settings.insert(settings.begin(), best->setting);
    return settings;
}

nlohmann::ordered_json report_data(const SweepResults& results, const SweepInputs& inputs,
                                   const std::vector<DifferencePicture>& differences,
                                   const nlohmann::ordered_json& paper, const ReportOrigin& origin) {
    nlohmann::ordered_json json = {{"date", origin.date},
                                   {"command", origin.command},
                                   {"version", release_version() + ", " + method_version().substr(0, 8)},
                                   {"probes", probes(results, origin.probes)},
                                   {"device", results.device},
                                   {"frame_size", {inputs.frame_size.x, inputs.frame_size.y}},
                                   {"vertices", kDiscVertices},
                                   {"real_time_ratio", kRealTimeRatio},
                                   {"full_difference", kFullDifference},
                                   {"representations", representation_names()},
                                   {"panels", panels(results, inputs, origin.theories)},
                                   {"differences", nlohmann::ordered_json::array()},
                                   {"films", films(results, origin.films)},
                                   {"paper", paper}};
    for (const DifferencePicture& difference : differences)
        json["differences"].push_back(
            {{"group", results.materials[difference.material] + " under " + results.probes[difference.probe]},
             {"setting", difference.setting},
             {"error", difference.error.relative_rms},
             {"flip", difference.error.flip.value_or(0.0)},
             {"image", data_url(difference.picture)}});
    return json;
}

std::string page_with_data(std::string_view page, const nlohmann::ordered_json& data) {
    constexpr std::string_view kMark = "/*DATA*/";
    std::string text = data.dump();
    // Nothing in the data may end the script element that holds it.
    for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos;) text.replace(at, 1, "\\u003c");
    const std::size_t mark = page.find(kMark);
    ROWLAND_CHECK(mark != std::string_view::npos, "the template has a mark for the data");
    return std::string(page).replace(mark, kMark.size(), text);
}

std::string report_html(const nlohmann::ordered_json& data) {
    return page_with_data(report_files().front().text, data);
}

}  // namespace rowland::trade
