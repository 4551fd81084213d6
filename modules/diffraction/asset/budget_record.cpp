#include "modules/diffraction/asset/budget_record.h"

#include <algorithm>
#include <array>
#include <limits>
#include <nlohmann/json.hpp>

#include "engine/core/json_reader.h"
#include "engine/lighting/key_lights.h"

namespace rowland::diffraction {

namespace {

constexpr std::array<const char*, 3> kMeasureNames = {"relative_rms", "delta_e", "hdr_flip"};

constexpr NumberRange kNonNegative{.minimum = 0.0, .maximum = std::numeric_limits<double>::max()};

BudgetRecord::OfProbe parse_probe(JsonReader& json) {
    BudgetRecord::OfProbe probe;
    probe.probe = json.text("probe");
    probe.key_lights = static_cast<int>(json.integer("key_lights", 0, lighting::kMaximumKeyLights));
    probe.error = json.number("error", kNonNegative);
    json.finish();
    return probe;
}

}  // namespace

const char* surface_shape_name(SurfaceShape surface) {
    return surface == SurfaceShape::Flat ? "flat" : "curved";
}

const char* error_measure_name(ErrorMeasure measure) {
    return kMeasureNames[static_cast<std::size_t>(measure)];
}

ErrorMeasure read_error_measure(JsonReader& json) {
    const std::string name = json.choice_or("measure", kMeasureNames[0], {kMeasureNames.begin(), kMeasureNames.end()});
    return static_cast<ErrorMeasure>(std::ranges::find(kMeasureNames, name) - kMeasureNames.begin());
}

std::string write_budget_record(const BudgetRecord& record) {
    nlohmann::json json = {{"max_error", record.max_error},
                           {"measure", error_measure_name(record.measure)},
                           {"surface", surface_shape_name(record.surface)},
                           {"frames", record.frames},
                           {"price", record.price},
                           {"probes", nlohmann::json::array()}};
    for (const BudgetRecord::OfProbe& probe : record.probes)
        json["probes"].push_back({{"probe", probe.probe}, {"key_lights", probe.key_lights}, {"error", probe.error}});
    return json.dump();
}

BudgetRecord parse_budget_record(std::string_view text, const std::string& file) {
    const nlohmann::json document = parse_json(text, file);
    JsonReader json(document, file);
    BudgetRecord record;
    record.max_error = json.number("max_error", kNonNegative);
    record.measure = read_error_measure(json);
    if (json.choice("surface", {"flat", "curved"}) == "curved") record.surface = SurfaceShape::Curved;
    record.frames = static_cast<int>(json.integer("frames", 0, std::numeric_limits<int>::max()));
    record.price = json.number("price", kNonNegative);
    for (JsonReader& probe : json.objects("probes")) record.probes.push_back(parse_probe(probe));
    json.finish();
    return record;
}

}  // namespace rowland::diffraction
