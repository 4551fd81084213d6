#include "tests/benchmark/markdown_reporter.h"

#include <fmt/format.h>

namespace rowland::microbenchmark {

namespace {

std::string counters_of(const ::benchmark::UserCounters& counters) {
    std::string text;
    for (const auto& [name, counter] : counters)
        text += fmt::format("{}{} {:.3g}", text.empty() ? "" : ", ", name, counter.value);
    return text;
}

}  // namespace

void MarkdownReporter::ReportRuns(const std::vector<Run>& runs) {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs)
        rows_ += fmt::format("| {} | {:.4g} {} | {} |\n", run.benchmark_name(), run.GetAdjustedRealTime(),
                             ::benchmark::GetTimeUnitString(run.time_unit), counters_of(run.counters));
}

std::string MarkdownReporter::table() const {
    return "| part | time | |\n| --- | --- | --- |\n" + rows_;
}

}  // namespace rowland::microbenchmark
