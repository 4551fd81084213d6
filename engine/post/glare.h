#pragma once

#include <array>
#include <glm/mat2x2.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "engine/gpu/framebuffer.h"
#include "engine/gpu/program.h"
#include "engine/gpu/shader_library.h"
#include "engine/gpu/texture.h"

namespace rowland::post {

/// Diffraction pattern of a flat periodic sheet that faces the camera: light from direction cosines d (x right, y up in
/// the picture) also appears at d + offset for each point. Colours are linear and of the picture's space, in and out.
/// Energy is conserved if `straight` and the weights of all points sum to at most the identity.
struct GlarePattern {
    struct Point {
        glm::vec2 offset{0.0F};
        glm::mat3 weight{0.0F};
    };
    glm::mat3 straight{1.0F};  ///< weight of undiffracted light
    std::vector<Point> points;
};

/// The square cells that glare is computed on. They are uniform in direction cosines, in which a diffraction pattern is
/// shift-invariant. Cell (i, j) is centred at ((i, j) − (cells − 1) / 2) · cell.
struct GlareGrid {
    glm::ivec2 cells{0};   ///< that cover the picture
    glm::ivec2 period{0};  ///< of the Fourier transform, powers of two; large enough that light that leaves the picture
                           ///< does not wrap around
    float cell = 0.0F;     ///< side in direction cosines

    friend bool operator==(const GlareGrid&, const GlareGrid&) = default;
};

/// The longest transforms, within the 1024 invocations and the 32 KiB of shared memory that OpenGL guarantees: a row is
/// transformed in one colour channel at a time, a column in all three.
inline constexpr glm::ivec2 kLargestGlarePeriod{2048, 1024};

/// Cells of 2 to 3 pixels, or larger ones where the transforms would be too long. `tan_half_fov`: of the horizontal and
/// the vertical field of view. `reach`: the largest offset of a pattern in x and y.
GlareGrid glare_grid(glm::ivec2 picture, glm::vec2 tan_half_fov, glm::vec2 reach);

/// Largest |x| and |y| of a pattern's offsets after a rotation.
glm::vec2 reach_of(const GlarePattern& pattern, const glm::mat2& rotation);

/// The rotated pattern on the grid: element [y · period.x + x] is the weight of a shift by (x, y) cells, modulo the
/// period. A quadratic B-spline distributes each point over the nine nearest cells. Shifts larger than the picture are
/// omitted.
std::vector<glm::mat3> glare_kernel(const GlarePattern& pattern, const glm::mat2& rotation, const GlareGrid& grid);

/// A sheet with a diffraction pattern held before the camera: diffraction glasses, a screen door, a curtain.
struct GlareSettings {
    std::shared_ptr<const GlarePattern> pattern;  ///< null, or one that changes nothing: no pass runs
    float vertical_fov = 0.7F;                    ///< the camera's, radians, in (0, π)
    float angle = 0.0F;                           ///< rotation of the sheet in radians, counterclockwise
    /// Diffracted fraction of a pixel's light: max(0, 1 − threshold / brightest channel); 0: all. In exposed units: 1
    /// is near the brightest that a display shows.
    float threshold = 1.0F;
};

/// Replaces the bright light B of a scene-linear picture L by its undiffracted and its diffracted part:
///     L − B + straight · B + Σ_points weight · B(direction cosines − offset).
/// Diffraction shifts direction cosines by the same amount everywhere [Harvey & Vernold 1998]. So the bright light is
/// resampled to a grid that is uniform in them (GlareGrid), and convolved with the pattern by the Fourier transform:
/// the cost does not depend on the number of points.
///
/// Energy, with pixels weighted by cos⁴ of their angle to the axis (their area in direction cosines), is kept to 1e-2;
/// light that leaves the picture is lost, and light from outside is missing. The grid blurs diffracted light by 0.87
/// cells (standard deviation). Components that are not finite count as 0, others are clamped to the half floats'
/// ±65504. Colours of single wavelengths may have negative components.
class GlarePass {
 public:
    /// `library` must hold post::shader_files() and outlive the pass.
    explicit GlarePass(const gpu::ShaderLibrary& library);

    /// Writes the picture with glare; alpha is kept. `threshold`, in units of the picture before exposure, is used in
    /// place of settings.threshold. Source (RGBA16F or RGBA32F) and target have the same size, else it is a logic
    /// error. Transforms the pattern when the pattern, the sheet's angle, the field of view or the size changes, and
    /// compiles programs when that changes the period.
    void draw(const gpu::Texture& source, const GlareSettings& settings, float threshold,
              const gpu::Framebuffer& target);

    static constexpr int passes() { return 5; }

 private:
    /// Programs and textures for one period.
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
    /// The pattern, and how the sheet is held.
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
    std::optional<GlareGrid> grid_;  ///< that the other members are built for
    gpu::Framebuffer bright_cells_;
    gpu::Texture glare_cells_;
};

/// False if the pattern is null or lets all light pass straight.
bool has_effect(const GlareSettings& settings);

/// A logic error if a setting is out of range.
void require_valid(const GlareSettings& settings);

}  // namespace rowland::post
