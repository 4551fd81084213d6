#include "engine/post/glare.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/mat2x2.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "engine/core/check.h"

namespace rowland::post {

namespace {

/// The uniform quadratic B-spline.
float spline(float distance) {
    const float d = std::abs(distance);
    if (d < 0.5F) return 0.75F - d * d;
    return d < 1.5F ? 0.5F * (1.5F - d) * (1.5F - d) : 0.0F;
}

void add_point(const glm::vec2& position, const glm::mat3& weight, const GlareGrid& grid,
               std::vector<glm::mat3>& kernel) {
    const glm::ivec2 nearest(glm::round(position));
    for (int y = nearest.y - 1; y <= nearest.y + 1; ++y) {
        if (std::abs(y) >= grid.cells.y) continue;
        const float up = spline(position.y - static_cast<float>(y));
        for (int x = nearest.x - 1; x <= nearest.x + 1; ++x) {
            if (std::abs(x) >= grid.cells.x) continue;
            const glm::ivec2 at = (glm::ivec2(x, y) + grid.period) % grid.period;
            kernel[static_cast<std::size_t>(at.y * grid.period.x + at.x)] +=
                up * spline(position.x - static_cast<float>(x)) * weight;
        }
    }
}

}  // namespace

glm::vec2 reach_of(const GlarePattern& pattern, const glm::mat2& rotation) {
    glm::vec2 reach(0.0F);
    for (const GlarePattern::Point& point : pattern.points) reach = glm::max(reach, glm::abs(rotation * point.offset));
    return reach;
}

std::vector<glm::mat3> glare_kernel(const GlarePattern& pattern, const glm::mat2& rotation, const GlareGrid& grid) {
    std::vector<glm::mat3> kernel(static_cast<std::size_t>(grid.period.x) * static_cast<std::size_t>(grid.period.y),
                                  glm::mat3(0.0F));
    for (const GlarePattern::Point& point : pattern.points) {
        const glm::vec2 position = rotation * point.offset / grid.cell;
        if (std::abs(position.x) < static_cast<float>(grid.cells.x + 1) &&
            std::abs(position.y) < static_cast<float>(grid.cells.y + 1))
            add_point(position, point.weight, grid, kernel);
    }
    return kernel;
}

namespace {

constexpr float kFinestCell = 2.0F;    ///< pixels; finer ones would be sampled unevenly by the pixels
constexpr float kCoarsestCell = 3.0F;  ///< pixels, as far as the transforms allow
constexpr int kMargin = 6;             ///< cells, for the width of the splines and the picture's edges
constexpr int kShortestPeriod = 32;

int period_for(float cells, int largest) {
    const auto needed = static_cast<unsigned>(std::ceil(std::min(cells, static_cast<float>(largest))));
    return std::clamp(static_cast<int>(std::bit_ceil(needed)), kShortestPeriod, largest);
}

}  // namespace

GlareGrid glare_grid(glm::ivec2 picture, glm::vec2 tan_half_fov, glm::vec2 reach) {
    const float pixel = 2.0F * tan_half_fov.y / static_cast<float>(picture.y);
    GlareGrid grid{.cell = kFinestCell * pixel};
    glm::vec2 extent;
    for (int axis = 0; axis < 2; ++axis) {
        extent[axis] = 2.0F * tan_half_fov[axis] / std::sqrt(1.0F + tan_half_fov[axis] * tan_half_fov[axis]);
        // Offsets above the picture's size move all light out of it.
        const float filled = extent[axis] + std::min(reach[axis], extent[axis]);
        grid.period[axis] =
            period_for(filled / (kCoarsestCell * pixel) + static_cast<float>(kMargin), kLargestGlarePeriod[axis]);
        grid.cell = std::max(grid.cell, filled / static_cast<float>(grid.period[axis] - kMargin));
    }
    for (int axis = 0; axis < 2; ++axis) grid.cells[axis] = static_cast<int>(std::ceil(extent[axis] / grid.cell)) + 2;
    return grid;
}

namespace {

gpu::Program fourier(const gpu::ShaderLibrary& library, const char* compute, int length, int channels,
                     bool of_kernel = false) {
    return {library,
            {.compute = compute,
             .defines = {{"LENGTH", std::to_string(length)},
                         {"CHANNELS", std::to_string(channels)},
                         {"OF_KERNEL", of_kernel ? "1" : "0"}}}};
}

constexpr const char* rows_shader = "engine/post/shaders/glare_rows.comp.glsl";
constexpr const char* columns_shader = "engine/post/shaders/glare_columns.comp.glsl";
constexpr const char* rows_back_shader = "engine/post/shaders/glare_rows_back.comp.glsl";

/// exp(−2πi k / length) for k < length / 2.
gpu::Texture twiddles(int length) {
    std::vector<float> values;
    for (int k = 0; k < length / 2; ++k) {
        const double angle = -2.0 * std::numbers::pi * k / length;
        values.push_back(static_cast<float>(std::cos(angle)));
        values.push_back(static_cast<float>(std::sin(angle)));
    }
    gpu::Texture texture({.kind = gpu::TextureKind::Line, .format = gpu::Format::RG32F, .width = length / 2},
                         {.filter = gpu::Filter::Nearest});
    texture.upload(values);
    return texture;
}

/// Layers for spectra of real pictures, which half of the frequencies along x determine.
gpu::Texture layers_of_spectra(glm::ivec2 period, int layers) {
    return gpu::Texture({.kind = gpu::TextureKind::PlaneArray,
                         .format = gpu::Format::RG32F,
                         .width = period.x / 2 + 1,
                         .height = period.y,
                         .depth = layers},
                        {.filter = gpu::Filter::Nearest});
}

glm::mat2 rotation_by(float angle) {
    return {std::cos(angle), std::sin(angle), -std::sin(angle), std::cos(angle)};
}

void set_grid(const gpu::Program& program, const GlareGrid& grid, glm::vec2 tan_half_fov) {
    program.set("tan_half_fov", tan_half_fov);
    program.set("cells", grid.cells);
    program.set("cell", grid.cell);
}

}  // namespace

GlarePass::Transform::Transform(const gpu::ShaderLibrary& library, glm::ivec2 size)
    : period(size),
      rows(fourier(library, rows_shader, size.x, 1)),
      columns(fourier(library, columns_shader, size.y, 3)),
      columns_of_kernel(fourier(library, columns_shader, size.y, 3, true)),
      rows_back(fourier(library, rows_back_shader, size.x, 1)),
      row_twiddles(twiddles(size.x)),
      column_twiddles(twiddles(size.y)),
      spectrum(layers_of_spectra(size, 3)),
      kernel(layers_of_spectra(size, 9)) {}

GlarePass::GlarePass(const gpu::ShaderLibrary& library)
    : library_(&library),
      bright_(library, gpu::full_screen_pass("engine/post/shaders/glare_bright.frag.glsl")),
      add_(library, gpu::full_screen_pass("engine/post/shaders/glare_add.frag.glsl")) {}

void GlarePass::transform_rows(const gpu::Texture& cells) const {
    cells.bind(0);
    transform_->row_twiddles.bind(1);
    transform_->spectrum.bind_image(0);
    transform_->rows.dispatch(static_cast<unsigned>((cells.size().y + 1) / 2));
}

void GlarePass::transform_kernel(const GlareGrid& grid) {
    const std::vector<glm::mat3> kernel = glare_kernel(*sheet_->pattern, rotation_by(sheet_->angle), grid);
    gpu::Texture of_channel({.format = gpu::Format::RGBA32F, .width = grid.period.x, .height = grid.period.y});
    std::vector<glm::vec3> out(kernel.size());
    for (int channel = 0; channel < 3; ++channel) {
        for (std::size_t i = 0; i < kernel.size(); ++i) out[i] = kernel[i][channel];
        of_channel.upload(std::span<const glm::vec3>(out));
        transform_rows(of_channel);
        transform_->column_twiddles.bind(1);
        transform_->kernel.bind_image(1);
        transform_->columns_of_kernel.set("rows", grid.period.y);
        transform_->columns_of_kernel.set("channel_in", channel);
        transform_->columns_of_kernel.dispatch(static_cast<unsigned>(grid.period.x / 2 + 1));
    }
}

void GlarePass::hold(const GlareSettings& settings) {
    if (sheet_ && sheet_->pattern == settings.pattern && sheet_->angle == settings.angle) return;
    sheet_ = Sheet{settings.pattern, settings.angle, reach_of(*settings.pattern, rotation_by(settings.angle))};
    grid_.reset();
}

void GlarePass::prepare(const GlareGrid& grid) {
    if (grid_ == grid) return;
    grid_.reset();
    if (!transform_ || transform_->period != grid.period) transform_.emplace(*library_, grid.period);
    transform_kernel(grid);
    bright_cells_ =
        gpu::Framebuffer({.width = grid.cells.x, .height = grid.cells.y, .colours = {gpu::Format::RGBA32F}});
    glare_cells_ = gpu::Texture({.format = gpu::Format::RGBA32F, .width = grid.cells.x, .height = grid.cells.y});
    grid_ = grid;
}

void GlarePass::draw(const gpu::Texture& source, const GlareSettings& settings, float threshold,
                     const gpu::Framebuffer& target) {
    require_valid(settings);
    ROWLAND_CHECK(source.size() == target.size(), "the target of glare must have the source's size");
    const glm::vec2 size(source.size());
    const glm::vec2 tan_half_fov = std::tan(0.5F * settings.vertical_fov) * glm::vec2(size.x / size.y, 1.0F);
    hold(settings);
    const GlareGrid grid = glare_grid(source.size(), tan_half_fov, sheet_->reach);
    prepare(grid);

    source.bind(0);
    set_grid(bright_, grid, tan_half_fov);
    bright_.set("threshold", threshold);
    triangle_.draw(bright_, bright_cells_);

    transform_rows(bright_cells_.colour());
    transform_->column_twiddles.bind(1);
    transform_->kernel.bind(2);
    transform_->columns.set("rows", grid.cells.y);
    transform_->columns.dispatch(static_cast<unsigned>(grid.period.x / 2 + 1));
    transform_->row_twiddles.bind(1);
    glare_cells_.bind_image(1);
    transform_->rows_back.set("scale", 1.0F / static_cast<float>(grid.period.x * grid.period.y));
    transform_->rows_back.dispatch(static_cast<unsigned>((grid.cells.y + 1) / 2));

    source.bind(0);
    glare_cells_.bind(1);
    set_grid(add_, grid, tan_half_fov);
    add_.set("threshold", threshold);
    add_.set("straight", settings.pattern->straight);
    add_.set("into_halves", target.holds_halves() ? 1 : 0);
    triangle_.draw(add_, target);
}

bool has_effect(const GlareSettings& settings) {
    return settings.pattern && !(settings.pattern->points.empty() && settings.pattern->straight == glm::mat3(1.0F));
}

void require_valid(const GlareSettings& settings) {
    ROWLAND_CHECK_OP(settings.vertical_fov, >, 0.0F);
    ROWLAND_CHECK_OP(settings.vertical_fov, <, std::numbers::pi_v<float>);
    ROWLAND_CHECK(std::isfinite(settings.angle), "a sheet's angle is a number");
    ROWLAND_CHECK_OP(settings.threshold, >=, 0.0F);
}

}  // namespace rowland::post
