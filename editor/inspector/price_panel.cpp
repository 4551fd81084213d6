#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "editor/inspector/panels.h"
#include "modules/diffraction/asset/quality.h"

namespace rowland::inspector {

namespace {

constexpr std::size_t kFrontSeries = 0;
constexpr std::size_t kPresentSeries = 1;

/// The choices on the front, sorted by price.
std::vector<PricedChoice> front(const PriceList& list) {
    std::vector<PricedChoice> result;
    for (const PricedChoice& choice : list.choices)
        if (choice.on_front && choice.candidate) result.push_back(choice);
    std::ranges::stable_sort(result, {}, &PricedChoice::price);
    return result;
}

std::string description_of(const PricedChoice& choice) {
    std::string text = choice.settings.value("representation", "?");
    for (const auto& [key, value] : choice.settings.items())
        if (key != "representation" && key != "illuminant" && key != "max_error" && key != "measure")
            text += fmt::format("  {} {}", key, value.dump());
    return text;
}

const char* measure_label(diffraction::ErrorMeasure measure) {
    return measure == diffraction::ErrorMeasure::RelativeRms ? "relative RMS"
           : measure == diffraction::ErrorMeasure::DeltaE    ? "ΔE2000"
                                                             : "HDR-FLIP";
}

std::string byte_count(std::size_t bytes) {
    const auto size = static_cast<double>(bytes);
    if (size < 1024.0) return fmt::format("{} B", bytes);
    return size < 1024.0 * 1024.0 ? fmt::format("{:.1f} KiB", size / 1024.0)
                                  : fmt::format("{:.1f} MiB", size / 1024.0 / 1024.0);
}

void draw_frame_time(double frame_ms) {
    if (frame_ms > 0.0) draw_row("Frame time", fmt::format("{:.1f} ms, the median", frame_ms));
}

void draw_numbers(const PriceList& list, bool is_current, const OpenDocument& opened, View& view, double frame_ms,
                  ControlMap& controls) {
    const DrawnAs* drawn = view.drawn_as();
    if (drawn == nullptr) return;
    const diffraction::ShadingCost& cost = drawn->cost;
    const std::string cooked = info(opened.cooked()->tables).name;
    const auto present = std::ranges::find(list.choices, true, &PricedChoice::present);
    const bool measured = present != list.choices.end() && is_current;
    const std::string waiting = opened.document().material().quality.pinned ? "measuring…" : "chosen by the cooker";
    const std::string name =
        drawn->representation == cooked ? cooked : fmt::format("{} in place of {}", drawn->representation, cooked);
    draw_row("Representation", name);
    controls.note("representation", name);
    draw_row("Measured error",
             measured ? fmt::format("{:.4g} {}, on a {} surface", present->error, measure_label(list.measure),
                                    diffraction::surface_shape_name(view.surface_shape()))
                      : waiting);
    draw_row("Price", measured ? fmt::format("{:.4g} fetches per pixel", present->price) : waiting);
    draw_row("Tables", fmt::format("{} ({} B)", byte_count(cost.table_bytes), cost.table_bytes));
    draw_row("Per pixel",
             fmt::format("{} fetches, {} multiply-adds", cost.fetches_per_pixel, cost.multiply_adds_per_pixel));
    draw_row("Per vertex",
             fmt::format("{} fetches, {} multiply-adds", cost.fetches_per_vertex, cost.multiply_adds_per_vertex));
    draw_row("Per light",
             fmt::format("{} fetches, {} multiply-adds", cost.fetches_per_light, cost.multiply_adds_per_light));
    draw_frame_time(frame_ms);
}

void draw_plot(const PriceList& list, float height) {
    double cheapest = std::numeric_limits<double>::infinity();
    double most_expensive = 0.0;
    double best = std::numeric_limits<double>::infinity();
    double worst = 0.0;
    for (const PricedChoice& choice : list.choices) {
        cheapest = std::min(cheapest, choice.price);
        most_expensive = std::max(most_expensive, choice.price);
        if (choice.error > 0.0) best = std::min(best, choice.error);
        if (std::isfinite(choice.error)) worst = std::max(worst, choice.error);
    }
    if (!(most_expensive > 0.0 && worst > 0.0)) {
        cheapest = best = 0.1;
        most_expensive = worst = 1.0;
    }
    Plot plot("##prices", height, {0.7 * cheapest, 1.4 * most_expensive, "price: fetches per pixel", true},
              {0.6 * best, 1.7 * worst, measure_label(list.measure), true});
    std::vector<glm::dvec2> line;
    for (const PricedChoice& choice : list.choices)
        if (choice.candidate && !choice.on_front) plot.marker(choice.price, choice.error, 6);
    for (const PricedChoice& choice : front(list)) {
        line.emplace_back(choice.price, choice.error);
        plot.marker(choice.price, choice.error, kFrontSeries);
    }
    plot.line(line, kFrontSeries);
    const float font = ImGui::GetFontSize();
    for (const PricedChoice& choice : list.choices) {
        const ImVec2 at = plot.at(choice.price, choice.error);
        if (choice.present) plot.draw().AddCircle(at, 0.5F * font, series_colour(kPresentSeries), 0, 2.0F);
        const ImVec2 mouse = ImGui::GetIO().MousePos;
        if (plot.hovered() && std::hypot(mouse.x - at.x, mouse.y - at.y) < 0.4F * font)
            ImGui::SetTooltip("%s\nerror %.4f, %.4g fetches per pixel, %s", description_of(choice).c_str(),
                              choice.error, choice.price, byte_count(choice.cost.table_bytes).c_str());
    }
    plot.legend("front", kFrontSeries);
    plot.legend("present", kPresentSeries);
}

/// The index of the choice that the material pins; -1 if it pins none of them.
int present_index(const std::vector<PricedChoice>& choices, const Document& document) {
    nlohmann::json pinned = nlohmann::json::object();
    if (document.json().contains("quality")) pinned = nlohmann::json::parse(document.json()["quality"].dump());
    pinned.erase("max_error");
    for (std::size_t i = 0; i < choices.size(); ++i)
        if (choices[i].settings == pinned) return static_cast<int>(i);
    return -1;
}

void draw_slider(Measurement& measurement, const Document& document, const PriceList& list, ControlMap& controls) {
    const std::vector<PricedChoice> choices = front(list);
    if (choices.empty()) return;
    int index = present_index(choices, document);
    const std::string name =
        index < 0 ? "as the material says" : description_of(choices[static_cast<std::size_t>(index)]);
    ImGui::TextDisabled("cheaper");
    ImGui::SameLine();
    const float font = ImGui::GetFontSize();
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - 7.0F * font);
    int wanted = std::max(index, 0);
    if (ImGui::SliderInt("##front", &wanted, 0, static_cast<int>(choices.size()) - 1, "", ImGuiSliderFlags_NoInput) &&
        wanted != index)
        measurement.choose(choices[static_cast<std::size_t>(wanted)]);
    controls.mark("cheaper or more accurate");
    ImGui::SameLine();
    ImGui::TextDisabled("more accurate");
    ImGui::PushTextWrapPos();
    ImGui::TextUnformatted(name.c_str());
    ImGui::PopTextWrapPos();
}

void draw_film(const thin_film::FilmTable& table, double frame_ms, ControlMap& controls) {
    draw_row("Representation", "table over angle, thickness and roughness");
    draw_row("Nodes", fmt::format("{} × {} × {}", table.columns, table.rows, table.layers));
    draw_row("Tables", fmt::format("{} ({} B)", byte_count(table.bytes()), table.bytes()));
    const std::string error =
        fmt::format("{:.2g} % RMS, {:.2g} % at most", 100.0 * table.error.rms, 100.0 * table.error.largest);
    draw_row("Measured error", error);
    draw_frame_time(frame_ms);
    controls.note("film's error", error);
}

}  // namespace

void PricePanel::draw(Measurement& measurement, const OpenDocument& opened, View& view, double frame_ms,
                      ControlMap& controls) {
    if (opened.document().has_film()) {
        if (const auto film = opened.film()) draw_film(film->table, frame_ms, controls);
        return;
    }
    const PriceList list = measurement.prices();
    const bool is_current = measurement.prices_are_current();
    const float font = ImGui::GetFontSize();
    if (measurement.pricing()) {
        if (ImGui::Button("Stop")) measurement.stop_pricing();
        ImGui::SameLine();
        const float done = list.total == 0 ? 0.0F : static_cast<float>(list.done) / static_cast<float>(list.total);
        ImGui::ProgressBar(done, {-1.0F, 0.0F},
                           list.total == 0 ? "the reference" : fmt::format("{} of {}", list.done, list.total).c_str());
    } else {
        if (ImGui::Button("Measure all choices")) measurement.measure_all();
        controls.mark("measure");
        ImGui::SameLine();
        ImGui::SetNextItemWidth(7.0F * font);
        ImGui::DragFloat("##budget", &budget_, 0.001F, 0.002F, 20.0F, "error ≤ %.3f", ImGuiSliderFlags_Logarithmic);
        controls.mark("budget");
        const float right = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
        if (ImGui::GetItemRectMax().x + 8.5F * font <= right) ImGui::SameLine();
        if (ImGui::Button("Cook to budget")) measurement.cook_to_budget(static_cast<double>(budget_));
        controls.mark("cook to budget");
    }
    if (!list.choices.empty() && !is_current) ImGui::TextDisabled("Measured before the last edit; measure again.");
    const bool wide = ImGui::GetContentRegionAvail().x > 32.0F * font;
    if (wide) {
        ImGui::Columns(2, "##price", false);
        ImGui::SetColumnWidth(0, 20.0F * font);
    }
    draw_numbers(list, is_current, opened, view, frame_ms, controls);
    if (wide) ImGui::NextColumn();
    draw_plot(list, std::max(7.0F * font, ImGui::GetContentRegionAvail().y - 3.6F * font));
    draw_slider(measurement, opened.document(), list, controls);
    ImGui::Columns(1);
}

}  // namespace rowland::inspector
