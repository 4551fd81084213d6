#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "editor/trade/difference_image.h"
#include "editor/trade/paper_figures.h"
#include "editor/trade/sweep.h"

namespace rowland::trade {

/// Frames of at most this many times the plain material's count as real time.
inline constexpr double kRealTimeRatio = 3.0;

/// A setting's picture beside the reference's.
struct DifferencePicture {
    std::size_t material = 0;
    std::size_t probe = 0;
    std::string setting;
    double error = 0.0;  ///< relative RMS over the picture
    RgbPicture picture;
};

/// What the report says of the paper. The last three need a GL device.
struct PaperEvidence {
    Figure2 figure_2;
    double grooves = 0.0;
    std::optional<Figure3> figure_3{};
    std::optional<Figure6> figure_6{};
    std::optional<PaperRates> rates{};
};

/// Everything the report draws, as its script reads it.
nlohmann::ordered_json report_data(const SweepResults& results, const SweepInputs& inputs,
                                   const std::vector<DifferencePicture>& differences, const PaperEvidence& paper);

/// One HTML file that needs no other.
std::string report_html(const nlohmann::ordered_json& data);

/// Of the settings measured: the most exact on the picture in real time (of all, if no frames were timed), and the
/// first, which is the paper's where the plan was swept.
std::vector<std::size_t> pictured_settings(const SweepResults& results, std::size_t material, std::size_t probe);

}  // namespace rowland::trade
