#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <string>
#include <vector>

#include "content/demo/session.h"

namespace rowland::test {

/// How well pixels average what they cover of one object, in one view under one probe.
struct PixelAverage {
    std::size_t pixels = 0;  ///< of the object, without those at its edges
    /// Fraction of them that change by more than a tenth when the camera moves by half a pixel around the object.
    double jumping = 0.0;
    double change = 0.0;  ///< by that step: relative RMS, components cut off at 1
    /// `jumping` of pictures of 16 samples per pixel: what the content itself does. Measured where `jumping` is not
    /// small.
    double content_jumping = 0.0;
    /// Relative RMS of the linear picture against one of 16 samples per pixel, each shaded for its own footprint: what
    /// shading per pixel costs, and within an object its outline against itself. Not in it: the object's edges, the
    /// four samples that resolve them, and what both pictures share (probe, maps, shadows, half floats).
    double error = 0.0;
    double displayed = 0.0;  ///< the same with components cut off at 1, diffuse white
};

/// Measures the gratings of the demo's scene.
class Shimmer {
 public:
    Shimmer(const demo::Options& options, glm::ivec2 size);

    /// Fraction of pixels whose jumping is small.
    static constexpr double kCalm = 0.04;

    /// By the objects' names. `with_error`: draws pictures of 16 samples as well.
    std::map<std::string, PixelAverage> measure(const scene::Camera& camera, bool with_error);

    demo::Session& session() { return session_; }

 private:
    using Pixels = std::vector<glm::vec4>;
    /// An object in the picture.
    struct Seen {
        std::vector<std::size_t> pixels;  ///< without those at its edges
        glm::vec3 sum{0.0F};              ///< of their points in the world
    };

    Pixels draw(const scene::Camera& camera);
    Pixels draw_supersampled(const scene::Camera& camera);
    std::map<std::string, Seen> see(const scene::Camera& camera);

    glm::ivec2 size_;
    demo::Session session_;
};

}  // namespace rowland::test
