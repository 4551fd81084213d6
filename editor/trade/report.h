#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "editor/trade/film_methods.h"
#include "editor/trade/measure_error.h"
#include "editor/trade/sweep.h"
#include "engine/lighting/probe_image.h"

namespace rowland::trade {

/// The columns of one setting's row: its parts, errors, times, fixed counts and bytes; null where a column does not
/// apply.
nlohmann::ordered_json sweep_row(const SweepResults& results, const ErrorRow& row);

/// A header line, then a line per error row. Cells that do not apply are empty.
std::string sweep_csv(const SweepResults& results);

/// The same rows as JSON lines, without the columns that do not apply.
std::string sweep_json_lines(const SweepResults& results);

/// The cost of an error's material and setting.
const CostRow& cost_of(const SweepResults& results, const ErrorRow& row);

/// Cost and error of a setting; less is better.
struct TradePoint {
    double cost = 0.0;
    double error = 0.0;
};

/// Indices of the Pareto front, sorted by cost: no other point has at most their cost and error and is better in one.
/// Of equal points the first is taken. Points that are not finite are ignored.
std::vector<std::size_t> pareto_front(std::span<const TradePoint> points);

/// Statistics of a probe that affect the errors of methods.
struct ProbeStatistics {
    int width = 0;  ///< texels
    int height = 0;
    double mean = 0.0;                ///< luminance over the sphere, in the image's unit
    double peak_over_mean = 0.0;      ///< of luminance; 0 if the probe is black
    double brightest_fraction = 0.0;  ///< of the light, from the brightest thousandth of the sphere
};

ProbeStatistics statistics_of(const lighting::ProbeImage& probe);

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

/// Sweep::theory_error() of a material under a probe.
struct TheoryError {
    std::size_t material = 0;
    std::size_t probe = 0;
    std::string set;
    double error = 0.0;
};

/// Date and command of a report, statistics of its probes, and its rows for thin films.
struct ReportOrigin {
    std::string date;     ///< UTC, ISO 8601
    std::string command;  ///< as it was typed
    std::vector<ProbeStatistics> probes{};
    std::vector<std::vector<FilmRow>> films{};  ///< for each probe
    std::vector<TheoryError> theories{};        ///< of gratings that rigorous theory knows
};

/// The data of the report's script. Reads the materials from the files of `inputs`. `paper`: paper_evidence().
nlohmann::ordered_json report_data(const SweepResults& results, const SweepInputs& inputs,
                                   const std::vector<DifferencePicture>& differences,
                                   const nlohmann::ordered_json& paper, const ReportOrigin& origin);

/// A page of HTML that needs no other file: `page` with its mark /*DATA*/, in a script element, replaced by the data.
std::string page_with_data(std::string_view page, const nlohmann::ordered_json& data);

/// The report: one HTML file that needs no other.
std::string report_html(const nlohmann::ordered_json& data);

/// The settings with pictures: the one with the smallest error in real time (of all, if no frames were timed), and the
/// first, which is the paper's in the sweep plan.
std::vector<std::size_t> pictured_settings(const SweepResults& results, std::size_t material, std::size_t probe);

}  // namespace rowland::trade
