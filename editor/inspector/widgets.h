#pragma once

#include <imgui.h>

#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/gpu/framebuffer.h"
#include "engine/gpu/texture.h"

namespace rowland::inspector {

/// Colours that all kinds of colour vision distinguish [Okabe & Ito 2008]; lines also differ in their dashes.
ImU32 series_colour(std::size_t index, float alpha = 1.0F);

/// Puts the next control on the line of the label that was just drawn: at `column`, in heights of the font, or behind a
/// longer label. Room stays for a button behind the control.
void begin_control(float column);
/// The colour of what is refused.
inline const ImVec4 kRefused(0.95F, 0.60F, 0.15F, 1.0F);
/// Draws the message of a refusal.
void draw_refusal(const std::string& message);

/// For ImDrawList::AddImage(). The first row of a framebuffer is its lowest.
ImTextureID texture_of(const gpu::Framebuffer& picture);
ImTextureID texture_of(const gpu::Texture& picture);

/// Draws a name and its value in two columns.
void draw_row(const char* name, const std::string& value);

/// Continues the line of the last control if `letters` more fit; a narrow tile has several lines of tools.
void continue_line(float letters);

inline constexpr ImU32 kPlotWords = IM_COL32(205, 205, 205, 255);

struct PlotAxis {
    double minimum = 0.0;
    double maximum = 1.0;
    const char* label = "";
    bool logarithmic = false;
};

/// A rectangle with axes, drawn with ImGui's own draw lists.
class Plot {
 public:
    /// As wide as the current ImGui window, in which `name` is unique; `height` in pixels.
    Plot(const char* name, float height, const PlotAxis& x, const PlotAxis& y);

    /// Screen coordinates of a point, clamped to the plot.
    ImVec2 at(double x, double y) const;
    /// A line with a gap at points that are not finite. `series` gives colour and dashes.
    void line(std::span<const glm::dvec2> points, std::size_t series) const;
    void marker(double x, double y, std::size_t series) const;
    void vertical(double x, ImU32 colour) const;
    /// A filled rectangle from the lower edge to y.
    void bar(double begin, double end, double y, ImU32 colour) const;
    /// A name with the colour and dashes of its line, right of the last legend at the plot's upper edge.
    void legend(const std::string& name, std::size_t series);
    void text(double x, double y, const char* words, ImU32 colour) const;

    bool hovered() const { return hovered_; }
    /// The mouse's position on the x axis.
    double mouse_x() const;
    ImVec2 minimum() const { return minimum_; }
    ImVec2 maximum() const { return maximum_; }
    ImDrawList& draw() const { return *draw_; }

 private:
    void draw_axes() const;
    double fraction(double value, const PlotAxis& axis) const;

    ImDrawList* draw_;
    PlotAxis x_;
    PlotAxis y_;
    ImVec2 minimum_;
    ImVec2 maximum_;
    float legend_x_ = 0.0F;
    bool hovered_ = false;
};

/// About `count` round numbers within the axis.
std::vector<double> ticks(const PlotAxis& axis, int count);

// Colours of plots are sRGB without a view transform.

/// The sRGB of XYZ: mixed with white until it is in the gamut, and scaled to at most 1.
glm::vec3 screen_colour(const glm::dvec3& xyz);
ImU32 screen_colour_u32(const glm::dvec3& xyz);

/// The colour of one wavelength, as bright as the screen can show it; darker toward the ends of the spectrum.
ImU32 wavelength_colour(double wavelength_nm, float alpha = 1.0F);

/// Writes the rectangles of the last frame's controls, by name, to a file, for programs that drive the inspector
/// (tests, screen readers). Does nothing without a file.
class ControlMap {
 public:
    explicit ControlMap(std::optional<std::filesystem::path> file) : file_(std::move(file)) {}

    /// Adds the rectangle of ImGui's last control.
    void mark(const std::string& name);
    /// Adds a named value.
    void note(const std::string& name, const std::string& value);
    /// Writes the file if its content changed, and the number of frames to a file of the same name with ".frames": two
    /// frames after an input the program has seen it. A failure is logged and ends the writing.
    void end_frame();

 private:
    std::optional<std::filesystem::path> file_;
    std::map<std::string, std::string> entries_;
    std::string written_;
    std::uint64_t frames_ = 0;
};

}  // namespace rowland::inspector
