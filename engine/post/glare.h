#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>

#include "engine/gpu/framebuffer.h"
#include "engine/gpu/full_screen_pass.h"
#include "engine/gpu/program.h"
#include "engine/gpu/shader_library.h"
#include "engine/gpu/texture.h"
#include "engine/post/glare_grid.h"
#include "engine/post/glare_pattern.h"

namespace rowland::post {

/// A sheet with a diffraction pattern held before the camera: diffraction glasses, a screen door, a curtain.
struct GlareSettings {
    std::shared_ptr<const GlarePattern> pattern;  ///< null, or one that changes nothing: no pass runs
    float vertical_fov = 0.7F;                    ///< the camera's, radians, in (0, π)
    float angle = 0.0F;                           ///< radians by which the sheet is turned, counterclockwise
    /// What the sheet diffracts of a pixel is max(0, 1 − threshold / its brightest channel) of its light; 0: all. As
    /// exposed: 1 is near the brightest that a display shows.
    float threshold = 1.0F;
};

/// Replaces the bright light B of a scene-linear picture L by what passes the sheet straight and what it diffracts:
///     L − B + straight · B + Σ_points weight · B(direction cosines − offset).
/// Diffraction moves light by the same direction cosines wherever it comes from [Harvey & Vernold 1998]. So the bright
/// light is resampled to a grid that is even in them (glare_grid.h), and convolved with the pattern by the Fourier
/// transform: the cost does not depend on the number of points.
///
/// Energy, pixels weighted by cos⁴ of their angle to the axis (their area in direction cosines), is kept to 1e-2; light
/// that leaves the picture is lost, and light from outside is missing. The grid blurs diffracted light by 0.87 cells
/// (standard deviation). Components that are not finite count as 0, others are clamped to the half floats' ±65504.
/// Colours of single wavelengths may have negative components.
class GlarePass {
 public:
    /// `library` must hold post::shader_files() and outlive the pass.
    explicit GlarePass(const gpu::ShaderLibrary& library);

    /// Writes the picture with glare; alpha is kept. `threshold` is that of the picture as it is, not exposed. Source
    /// (RGBA16F or RGBA32F) and target have the same size, else it is a logic error. Transforms the pattern when it,
    /// the sheet's angle, the field of view or the size changes, and compiles programs when that changes the period.
    void draw(const gpu::Texture& source, const GlareSettings& settings, float threshold,
              const gpu::Framebuffer& target);

    static constexpr int passes() { return 5; }

 private:
    /// What a period needs.
    struct Transform {
        Transform(const gpu::ShaderLibrary& library, glm::ivec2 size);

        glm::ivec2 period;
        gpu::Program rows;
        gpu::Program columns;
        gpu::Program columns_of_kernel;
        gpu::Program rows_back;
        gpu::Texture row_twiddles;
        gpu::Texture column_twiddles;
        gpu::Texture spectrum;  ///< a layer per channel: after rows only, then after both
        gpu::Texture kernel;    ///< spectrum; layer 3 · channel in + channel out
    };
    /// A pattern as it is held.
    struct Sheet {
        std::shared_ptr<const GlarePattern> pattern;
        float angle = 0.0F;
        glm::vec2 reach{0.0F};
    };

    void hold(const GlareSettings& settings);
    void prepare(const GlareGrid& grid);
    void transform_kernel(const GlareGrid& grid);
    void transform_rows(const gpu::Texture& cells) const;

    const gpu::ShaderLibrary* library_;
    gpu::Program bright_;
    gpu::Program add_;
    gpu::FullScreenTriangle triangle_;
    std::optional<Transform> transform_;
    std::optional<Sheet> sheet_;
    std::optional<GlareGrid> grid_;  ///< for which the rest is made
    gpu::Framebuffer bright_cells_;
    gpu::Texture glare_cells_;
};

/// False if the pattern is null or lets all light pass straight.
bool has_effect(const GlareSettings& settings);

/// A logic error if a setting is out of range.
void require_valid(const GlareSettings& settings);

}  // namespace rowland::post
