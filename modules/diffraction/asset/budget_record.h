#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/core/json_reader.h"
#include "modules/diffraction/asset/material.h"

namespace rowland::diffraction {

/// The measurements by which a material's representation was chosen for its max_error.
struct BudgetRecord {
    struct OfProbe {
        std::string probe;   ///< as the material names it
        int key_lights = 0;  ///< taken out of it at most, and shaded one by one
        double error = 0.0;  ///< as `measure` says, ≤ max_error
    };

    double max_error = 0.0;
    ErrorMeasure measure = ErrorMeasure::RelativeRms;
    SurfaceShape surface = SurfaceShape::Flat;
    int frames = 0;      ///< points that each error is measured over
    double price = 0.0;  ///< shading_price() of the chosen representation
    std::vector<OfProbe> probes;
};

/// "flat" or "curved".
const char* surface_shape_name(SurfaceShape surface);

/// "relative_rms", "delta_e" or "hdr_flip".
const char* error_measure_name(ErrorMeasure measure);
/// Reads the member "measure"; the default is "relative_rms". Throws Error (input).
ErrorMeasure read_error_measure(JsonReader& json);

/// Compact JSON; equal bytes for equal records.
std::string write_budget_record(const BudgetRecord& record);
/// Inverse of write_budget_record() for untrusted text. Throws Error (input) naming `file`.
BudgetRecord parse_budget_record(std::string_view text, const std::string& file);

}  // namespace rowland::diffraction
