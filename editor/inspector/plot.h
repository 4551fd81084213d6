#pragma once

#include <imgui.h>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

namespace rowland::inspector {

/// Colours that differ for all kinds of colour vision [Okabe & Ito 2008]; lines also differ in their dashes.
ImU32 series_colour(std::size_t index, float alpha = 1.0F);

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
    /// As wide as the window. `name` is unique in it.
    Plot(const char* name, float height, const PlotAxis& x, const PlotAxis& y);

    /// Screen coordinates of a point, clamped to the plot.
    ImVec2 at(double x, double y) const;
    /// A line with a gap at points that are not finite. `series` gives colour and dashes.
    void line(std::span<const glm::dvec2> points, std::size_t series) const;
    void marker(double x, double y, std::size_t series) const;
    void vertical(double x, ImU32 colour) const;
    /// A filled rectangle from the lower edge to y.
    void bar(double begin, double end, double y, ImU32 colour) const;
    /// A name with its line's colour and dashes, to the right of the last one, along the plot's upper edge.
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

}  // namespace rowland::inspector
