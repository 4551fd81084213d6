#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/core/json_reader.h"
#include "engine/math/spherical_harmonics.h"
#include "modules/diffraction/asset/material.h"

namespace rowland::diffraction {

/// A representation and its settings, within their limits.
struct ReadSettings {
    const RepresentationInfo& info;
    SettingValues values;
};
/// Reads "representation" and its settings from a "quality". Throws Error (input).
ReadSettings read_settings(JsonReader& json);

/// The quality that pins `settings` ("representation", its settings and "key_lights"), as a budget, an editor or the
/// demo proposes them, or the reason why a baked material of this grating cannot have it. Throws Error (input) for
/// unknown settings and for values outside their limits.
std::variant<Quality, Refusal> suited_quality(const nlohmann::json& settings, const Grating& grating);

/// The measured errors of a material's representation, which was chosen for max_error or pinned.
struct BudgetRecord {
    struct OfProbe {
        std::string probe;   ///< as the material names it
        int key_lights = 0;  ///< the most that are extracted from it and shaded one by one
        double error = 0.0;  ///< as `measure` says
    };

    double max_error = 0.0;  ///< 0: none, the representation is pinned
    ErrorMeasure measure = ErrorMeasure::RelativeRms;
    SurfaceShape surface = SurfaceShape::Flat;
    int frames = 0;      ///< points that each error is measured over
    double price = 0.0;  ///< shading_price() of the representation
    std::vector<OfProbe> probes;

    bool has_budget() const { return max_error > 0.0; }
    double largest_error() const;
};

/// "flat" or "curved".
const char* surface_shape_name(SurfaceShape surface);

/// "relative_rms", "delta_e" or "hdr_flip".
const char* error_measure_name(ErrorMeasure measure);
/// The max_error of a material that states none.
double default_max_error(ErrorMeasure measure);
/// Reads the member "measure"; the default is "relative_rms". Throws Error (input).
ErrorMeasure read_error_measure(JsonReader& json);

/// Compact JSON; equal bytes for equal records.
std::string write_budget_record(const BudgetRecord& record);
/// Inverse of write_budget_record() for untrusted text. Throws Error (input) naming `file`.
BudgetRecord parse_budget_record(std::string_view text, const std::string& file);

/// A representation with its settings, and how the probe's light is prepared for it: key lights and window. Written
/// "arc/bands=5/rank=8/key_lights=16/window=hann".
struct Method {
    /// A material file's "quality" but for key_lights: "representation" and the settings that are given. Keys ascend.
    nlohmann::json quality;
    int key_lights = 0;  ///< extracted from the probe and shaded one by one; default: 16 if required, else 0
    math::SphericalWindow window = math::SphericalWindow::None;

    friend bool operator==(const Method&, const Method&) = default;
};

/// Parses a representation, then any of its settings, key_lights and window, each once. Values must be within the
/// limits that material files have. Throws Error (input).
Method parse_method(const std::string& text);

/// Inverse of parse_method(): short, and different for different methods.
std::string method_name(const Method& method);

nlohmann::json to_json(const Method& method);

const RepresentationInfo& info(const Method& method);

/// The material file `json` with the method in place of its "quality". Settings that the method does not give are the
/// file's where it pins the same representation, else the defaults. The file's illuminant is kept.
nlohmann::json with_method(nlohmann::json json, const Method& method);

/// Why the method cannot shade a grating; nullopt if it can.
std::optional<Refusal> refusal(const Method& method, const Grating& grating);

}  // namespace rowland::diffraction
