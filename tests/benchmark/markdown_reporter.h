#pragma once

#include <benchmark/benchmark.h>

#include <string>

namespace rowland::microbenchmark {

/// Prints to the console as Google Benchmark does, and keeps the runs as a Markdown table.
class MarkdownReporter final : public ::benchmark::ConsoleReporter {
 public:
    void ReportRuns(const std::vector<Run>& runs) override;
    std::string table() const;

 private:
    std::string rows_;
};

}  // namespace rowland::microbenchmark
