#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "editor/trade/difference_image.h"
#include "editor/trade/film_methods.h"
#include "editor/trade/sweep.h"

namespace rowland::trade {

/// A frame counts as real time if it takes at most this many times the plain material's.
inline constexpr double kRealTimeRatio = 3.0;

/// A setting's picture beside the reference's.
struct DifferencePicture {
    std::size_t material = 0;
    std::size_t probe = 0;
    std::string setting;
    MethodError error{};
    RgbPicture picture;
};

/// How a report was made, under what light, and what it says of thin films.
struct ReportOrigin {
    std::string date;     ///< UTC, ISO 8601
    std::string command;  ///< as it was typed
    std::vector<ProbeStatistics> probes{};
    std::vector<std::vector<FilmRow>> films{};  ///< for each probe
};

/// Everything the report draws, as its script reads it; materials are read from the inputs' files. `paper`:
/// paper_evidence().
nlohmann::ordered_json report_data(const SweepResults& results, const SweepInputs& inputs,
                                   const std::vector<DifferencePicture>& differences,
                                   const nlohmann::ordered_json& paper, const ReportOrigin& origin);

/// The report: one HTML file that needs no other.
std::string report_html(const nlohmann::ordered_json& data);

/// The settings that are pictured: the most exact one in real time (of all, if no frames were timed), and the first,
/// which is the paper's where the plan was swept.
std::vector<std::size_t> pictured_settings(const SweepResults& results, std::size_t material, std::size_t probe);

}  // namespace rowland::trade
