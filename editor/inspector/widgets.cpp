#include "editor/inspector/widgets.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <glm/matrix.hpp>

#include "engine/colour/colour_space.h"
#include "engine/colour/spectrum.h"
#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/log.h"

namespace rowland::inspector {

namespace {

constexpr ImU32 kFrame = IM_COL32(255, 255, 255, 60);
constexpr ImU32 kGrid = IM_COL32(255, 255, 255, 22);

/// Lengths of dashes and gaps in pixels at scale 1; 0: a solid line.
constexpr std::array kDashes = {0.0F, 7.0F, 3.0F, 12.0F};

/// Draws a segment of a dashed polyline. `done`: the length of the segments before it; its own is added.
void dashed(ImDrawList& draw, const ImVec2& a, const ImVec2& b, ImU32 colour, float dash, float width, float& done) {
    const float length = std::hypot(b.x - a.x, b.y - a.y);
    if (dash <= 0.0F || length <= 0.0F) {
        draw.AddLine(a, b, colour, width);
        return;
    }
    const auto point = [&](float t) { return ImVec2(a.x + (b.x - a.x) * t / length, a.y + (b.y - a.y) * t / length); };
    float t = 0.0F;
    while (t < length) {
        const float phase = std::fmod(done, 2.0F * dash);
        const float step = std::min(length - t, (phase < dash ? dash : 2.0F * dash) - phase + 1e-3F);
        if (phase < dash) draw.AddLine(point(t), point(t + step), colour, width);
        t += step;
        done += step;
    }
}

float dash_of(std::size_t series) {
    return kDashes[series % kDashes.size()] * ImGui::GetFontSize() / 15.0F;
}

glm::vec3 encoded(const glm::dvec3& linear) {
    glm::vec3 result;
    for (int i = 0; i < 3; ++i) result[i] = static_cast<float>(colour::srgb_encoded(std::clamp(linear[i], 0.0, 1.0)));
    return result;
}

ImU32 packed(const glm::vec3& rgb, float alpha) {
    return ImGui::ColorConvertFloat4ToU32({rgb.r, rgb.g, rgb.b, alpha});
}

glm::dvec3 in_gamut(const glm::dvec3& xyz) {
    static const glm::dmat3 to_rgb = glm::inverse(colour::rec709_to_xyz());
    const glm::dvec3 rgb = to_rgb * xyz;
    return rgb - std::min({0.0, rgb.r, rgb.g, rgb.b});
}

}  // namespace

void begin_control(float column) {
    const float font = ImGui::GetFontSize();
    const float label = ImGui::GetItemRectMax().x - ImGui::GetWindowPos().x + ImGui::GetScrollX();
    ImGui::SameLine(std::max(column * font, label + 0.5F * font));
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - 2.0F * font);
}

void draw_refusal(const std::string& message) {
    ImGui::PushTextWrapPos();
    ImGui::TextColored(kRefused, "%s", message.c_str());
    ImGui::PopTextWrapPos();
}

ImTextureID texture_of(const gpu::Framebuffer& picture) {
    return texture_of(picture.colour());
}

ImTextureID texture_of(const gpu::Texture& picture) {
    return reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(picture.id()));
}

void draw_row(const char* name, const std::string& value) {
    ImGui::TextDisabled("%s", name);
    ImGui::SameLine(8.0F * ImGui::GetFontSize());
    ImGui::PushTextWrapPos();
    ImGui::TextUnformatted(value.c_str());
    ImGui::PopTextWrapPos();
}

void continue_line(float letters) {
    const float right = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
    const float end = ImGui::GetItemRectMax().x + ImGui::GetStyle().ItemSpacing.x + letters * ImGui::GetFontSize();
    if (end <= right) ImGui::SameLine();
}

ImU32 series_colour(std::size_t index, float alpha) {
    constexpr std::array<glm::vec3, 7> kColours = {{{0.34F, 0.71F, 0.91F},
                                                    {0.90F, 0.62F, 0.00F},
                                                    {0.00F, 0.72F, 0.52F},
                                                    {0.94F, 0.89F, 0.26F},
                                                    {0.84F, 0.47F, 0.67F},
                                                    {0.84F, 0.37F, 0.00F},
                                                    {0.85F, 0.85F, 0.85F}}};
    const glm::vec3& colour = kColours[index % kColours.size()];
    return ImGui::ColorConvertFloat4ToU32({colour.r, colour.g, colour.b, alpha});
}

std::vector<double> ticks(const PlotAxis& axis, int count) {
    std::vector<double> result;
    if (!(axis.maximum > axis.minimum)) return result;
    if (axis.logarithmic) {
        const double first = std::ceil(std::log10(axis.minimum) - 1e-9);
        const double step = std::max(1.0, std::round((std::log10(axis.maximum) - first) / count));
        for (double power = first; std::pow(10.0, power) <= axis.maximum * 1.0001; power += step)
            result.push_back(std::pow(10.0, power));
        return result;
    }
    const double rough = (axis.maximum - axis.minimum) / count;
    const double unit = std::pow(10.0, std::floor(std::log10(rough)));
    double step = 10.0 * unit;
    for (const double factor : {5.0, 2.0, 1.0})
        if (factor * unit >= rough) step = factor * unit;
    for (double at = std::ceil(axis.minimum / step - 1e-9) * step; at <= axis.maximum + 1e-9 * step; at += step)
        result.push_back(std::abs(at) < 1e-9 * step ? 0.0 : at);
    return result;
}

Plot::Plot(const char* name, float height, const PlotAxis& x, const PlotAxis& y)
    : draw_(ImGui::GetWindowDrawList()), x_(x), y_(y) {
    const float font = ImGui::GetFontSize();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = std::max(ImGui::GetContentRegionAvail().x, 8.0F * font);
    ImGui::InvisibleButton(name, {width, height});
    hovered_ = ImGui::IsItemHovered();
    minimum_ = {corner.x + 3.2F * font, corner.y + 1.5F * font};
    maximum_ = {corner.x + width - 0.6F * font, corner.y + height - 2.5F * font};
    legend_x_ = minimum_.x + std::max(0.2F * font, ImGui::CalcTextSize(y.label).x - 2.5F * font);
    draw_axes();
}

double Plot::fraction(double value, const PlotAxis& axis) const {
    if (!axis.logarithmic) return (value - axis.minimum) / (axis.maximum - axis.minimum);
    return std::log(std::max(value, axis.minimum) / axis.minimum) / std::log(axis.maximum / axis.minimum);
}

ImVec2 Plot::at(double x, double y) const {
    const double across = std::clamp(fraction(x, x_), 0.0, 1.0);
    const double up = std::clamp(fraction(y, y_), 0.0, 1.0);
    return {minimum_.x + static_cast<float>(across) * (maximum_.x - minimum_.x),
            maximum_.y - static_cast<float>(up) * (maximum_.y - minimum_.y)};
}

double Plot::mouse_x() const {
    const double t = (ImGui::GetIO().MousePos.x - minimum_.x) / (maximum_.x - minimum_.x);
    const double across = std::clamp(t, 0.0, 1.0);
    if (x_.logarithmic) return x_.minimum * std::pow(x_.maximum / x_.minimum, across);
    return x_.minimum + across * (x_.maximum - x_.minimum);
}

void Plot::draw_axes() const {
    const float font = ImGui::GetFontSize();
    draw_->AddRectFilled(minimum_, maximum_, IM_COL32(0, 0, 0, 90));
    const auto width = [](const std::string& words) { return ImGui::CalcTextSize(words.c_str()).x; };
    const int columns = std::max(2, static_cast<int>((maximum_.x - minimum_.x) / (4.5F * font)));
    for (const double tick : ticks(x_, columns)) {
        const float x = at(tick, y_.minimum).x;
        const std::string words = fmt::format("{:.4g}", tick);
        draw_->AddLine({x, minimum_.y}, {x, maximum_.y}, kGrid);
        const float left = std::min(x - width(words) / 2.0F, maximum_.x + 0.5F * font - width(words));
        draw_->AddText({left, maximum_.y + 0.1F * font}, kPlotWords, words.c_str());
    }
    const int rows = std::max(2, static_cast<int>((maximum_.y - minimum_.y) / (2.2F * font)));
    for (const double tick : ticks(y_, rows)) {
        const float y = at(x_.minimum, tick).y;
        const std::string words = fmt::format("{:.3g}", tick);
        draw_->AddLine({minimum_.x, y}, {maximum_.x, y}, kGrid);
        draw_->AddText({minimum_.x - width(words) - 0.3F * font, y - font / 2.0F}, kPlotWords, words.c_str());
    }
    draw_->AddRect(minimum_, maximum_, kFrame);
    draw_->AddText({maximum_.x - width(x_.label), maximum_.y + 1.2F * font}, kPlotWords, x_.label);
    draw_->AddText({minimum_.x - 3.0F * font, minimum_.y - 1.3F * font}, kPlotWords, y_.label);
}

void Plot::line(std::span<const glm::dvec2> points, std::size_t series) const {
    const float scale = ImGui::GetFontSize() / 15.0F;
    float done = 0.0F;
    for (std::size_t i = 1; i < points.size(); ++i) {
        if (!std::isfinite(points[i - 1].y) || !std::isfinite(points[i].y)) continue;
        dashed(*draw_, at(points[i - 1].x, points[i - 1].y), at(points[i].x, points[i].y), series_colour(series),
               dash_of(series), 1.6F * scale, done);
    }
}

void Plot::marker(double x, double y, std::size_t series) const {
    draw_->AddCircleFilled(at(x, y), 0.25F * ImGui::GetFontSize(), series_colour(series));
}

void Plot::vertical(double x, ImU32 colour) const {
    const float at_x = at(x, y_.minimum).x;
    draw_->AddLine({at_x, minimum_.y}, {at_x, maximum_.y}, colour, 1.5F);
}

void Plot::bar(double begin, double end, double y, ImU32 colour) const {
    draw_->AddRectFilled(at(begin, y), {at(end, y).x + 0.5F, maximum_.y}, colour);
}

void Plot::legend(const std::string& name, std::size_t series) {
    const float font = ImGui::GetFontSize();
    const float y = minimum_.y - 0.7F * font;
    float done = 0.0F;
    dashed(*draw_, {legend_x_, y}, {legend_x_ + 1.2F * font, y}, series_colour(series), dash_of(series), 2.0F, done);
    draw_->AddText({legend_x_ + 1.5F * font, y - font / 2.0F}, kPlotWords, name.c_str());
    legend_x_ += 1.9F * font + ImGui::CalcTextSize(name.c_str()).x;
}

void Plot::text(double x, double y, const char* words, ImU32 colour) const {
    const ImVec2 size = ImGui::CalcTextSize(words);
    const ImVec2 anchor = at(x, y);
    const float left = std::clamp(anchor.x - size.x / 2.0F, minimum_.x, maximum_.x - size.x);
    draw_->AddText({left, std::max(anchor.y - size.y - 2.0F, minimum_.y)}, colour, words);
}

glm::vec3 screen_colour(const glm::dvec3& xyz) {
    const glm::dvec3 rgb = in_gamut(xyz);
    return encoded(rgb / std::max({1.0, rgb.r, rgb.g, rgb.b}));
}

ImU32 screen_colour_u32(const glm::dvec3& xyz) {
    return packed(screen_colour(xyz), 1.0F);
}

ImU32 wavelength_colour(double wavelength_nm, float alpha) {
    const glm::dvec3 rgb = in_gamut(colour::cie_xyz(wavelength_nm));
    const double brightest = std::max({rgb.r, rgb.g, rgb.b, 1e-9});
    // The ends of the spectrum fade with the eye's sensitivity, but stay visible.
    const double fade = std::clamp(std::pow(brightest, 0.4), 0.25, 1.0);
    return packed(encoded(fade / brightest * rgb), alpha);
}

void ControlMap::mark(const std::string& name) {
    const ImVec2 low = ImGui::GetItemRectMin();
    const ImVec2 high = ImGui::GetItemRectMax();
    if (file_) entries_[name] = fmt::format("{:.0f} {:.0f} {:.0f} {:.0f}", low.x, low.y, high.x, high.y);
}

void ControlMap::note(const std::string& name, const std::string& value) {
    if (file_) entries_[name] = value;
}

void ControlMap::end_frame() {
    if (!file_) return;
    std::string text;
    for (const auto& [name, entry] : entries_) text += fmt::format("{}\t{}\n", name, entry);
    entries_.clear();
    std::ofstream(std::filesystem::path(*file_) += ".frames") << ++frames_ << '\n';
    if (text == written_) return;
    try {
        write_file_atomic(*file_, text);
        written_ = std::move(text);
    } catch (const Error& error) {
        log_error("{}", error.what());
        file_.reset();
    }
}

}  // namespace rowland::inspector
