#include "engine/lighting/prefilter.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "engine/core/check.h"
#include "engine/core/parallel.h"
#include "engine/lighting/cube_tree.h"

namespace rowland::lighting {

namespace {

using std::numbers::pi;
constexpr int kSmallestFace = 16;
constexpr int kLargestFace = 1024;
constexpr int kLastLevelFace = 4;

/// Columns of equirectangular images of 2:1 whose texels are as wide as this probe's, and as high.
glm::ivec2 equivalent_width(const ProbeImage& probe) {
    const image::Image& image = probe.image();
    return {image.width, probe.mapping() == Mapping::Angular ? image.width : 2 * image.height};
}

/// Level 0 where the probe is about as fine as the cube map, or coarser: the mean of bilinear look-ups, at least two a
/// texel of the probe in each direction (as long as that is 16 or fewer).
void gather_level0(const ProbeImage& probe, EnvironmentMap& map) {
    const int size = map.layout.face_size;
    const glm::ivec2 width = equivalent_width(probe);
    const double probe_texels = std::max(width.x, width.y) / (4.0 * size);
    const int steps = std::clamp(2 * static_cast<int>(std::ceil(probe_texels)), 4, 16);
    parallel_for(std::size_t{6} * static_cast<std::size_t>(size), [&](std::size_t task) {
        const int face = static_cast<int>(task) / size;
        const int row = static_cast<int>(task) % size;
        for (int column = 0; column < size; ++column) {
            glm::dvec3 sum(0.0);
            double total = 0;
            for (int j = 0; j < steps; ++j)
                for (int i = 0; i < steps; ++i) {
                    const double s = 2 * (column + (i + 0.5) / steps) / size - 1;
                    const double t = 2 * (row + (j + 0.5) / steps) / size - 1;
                    const glm::dvec3 d = cube_direction(face, s, t);
                    const double length = glm::length(d);
                    const double weight = 1 / (length * length * length);  // solid angle per area of the face
                    sum += weight * probe.radiance(d / length);
                    total += weight;
                }
            map.texels[map.layout.index(0, face, column, row)] = glm::vec3(sum / total);
        }
    });
}

/// Level 0 where an equirectangular probe is much finer: each of its texels, in four parts, is added to the cube texel
/// it lies in. Flux is kept exactly.
void scatter_level0(const ProbeImage& probe, EnvironmentMap& map) {
    const image::Image& image = probe.image();
    const int size = map.layout.face_size;
    std::vector<double> sine(2 * static_cast<std::size_t>(image.width));
    std::vector<double> cosine(sine.size());
    for (std::size_t i = 0; i < sine.size(); ++i) {
        const double phi = 2 * pi * ((static_cast<double>(i) + 0.5) / static_cast<double>(sine.size()) - 0.5);
        sine[i] = std::sin(phi);
        cosine[i] = std::cos(phi);
    }
    std::vector<glm::dvec4> sums(map.layout.offset(1), glm::dvec4(0.0));
    const auto cell = [size](double x) { return std::clamp(static_cast<int>((x + 1) / 2 * size), 0, size - 1); };
    for (int part = 0; part < 2 * image.height; ++part) {
        const double theta = pi * (part + 0.5) / (2 * image.height);
        const double r = std::sin(theta);
        const double y = std::cos(theta);
        for (std::size_t i = 0; i < sine.size(); ++i) {
            const CubePoint p = cube_point({r * sine[i], y, -r * cosine[i]});
            sums[map.layout.index(0, p.face, cell(p.s), cell(p.t))] +=
                r * glm::dvec4(image.at(static_cast<int>(i / 2), part / 2), 1.0);
        }
    }
    for (std::size_t i = 0; i < sums.size(); ++i) {
        ROWLAND_CHECK_OP(sums[i].w, >, 0.0);  // eight parts along each side of a cube texel: none is missed
        map.texels[i] = glm::vec3(glm::dvec3(sums[i]) / sums[i].w);
    }
}

void fill_level0(const ProbeImage& probe, EnvironmentMap& map) {
    constexpr int kMuchFiner = 4;
    const glm::ivec2 width = equivalent_width(probe);
    const bool finer = std::min(width.x, width.y) >= kMuchFiner * 4 * map.layout.face_size;
    if (finer && probe.mapping() == Mapping::Equirectangular)
        scatter_level0(probe, map);
    else
        gather_level0(probe, map);
}

/// Weight of light per solid angle: D(h) cos θ, the GGX distribution at the half vector [Walter et al. 2007, eq. 33]
/// without its constant; `cosine` = cos θ.
float lobe_weight(float cosine, float alpha_squared) {
    if (cosine <= 0) return 0;
    const float root = (1 + cosine) / 2 * (alpha_squared - 1) + 1;
    return cosine / (root * root);
}

/// Radiance under the lobe around the unit vector `normal`: a sum over nodes that are small compared with their
/// distance from the normal, or with the lobe's width. A node's light is weighted at its centroid, so a lamp alone in
/// its node counts exactly; the weights are summed at the nodes' centres, so constant light stays constant.
class LobeSum {
 public:
    LobeSum(const CubeTree& tree, double alpha)
        : tree_(tree), alpha_squared_(static_cast<float>(alpha * alpha)), width_(static_cast<float>(1.29 * alpha)) {}

    glm::vec3 operator()(const glm::vec3& normal) const {
        Sum sum;
        for (int face = 0; face < 6; ++face)
            for (int row = 0; row < CubeTree::kRootSide; ++row)
                for (int column = 0; column < CubeTree::kRootSide; ++column) add(normal, 0, face, column, row, sum);
        return sum.light / sum.weight;
    }

 private:
    /// Largest side of a node over its distance from the lobe's core.
    static constexpr float kNodeSize = 0.25f;

    struct Sum {
        glm::vec3 light{0.0f};
        float weight = 0;
    };

    void add(const glm::vec3& normal, int depth, int face, int column, int row, Sum& sum) const {
        const CubeTree::Node& node = tree_.node(depth, face, column, row);
        const float cosine = glm::dot(normal, node.centre);
        if (cosine < -node.size) return;  // wholly below the horizon
        const float distance = std::sqrt(std::max(0.0f, 2 - 2 * cosine));
        if (depth < tree_.leaf_depth() && node.size > kNodeSize * (distance + width_)) {
            for (int j = 0; j < 2; ++j)
                for (int i = 0; i < 2; ++i) add(normal, depth + 1, face, 2 * column + i, 2 * row + j, sum);
            return;
        }
        sum.light += lobe_weight(glm::dot(normal, node.source), alpha_squared_) * node.flux;
        sum.weight += lobe_weight(cosine, alpha_squared_) * node.solid_angle;
    }

    const CubeTree& tree_;
    float alpha_squared_;
    float width_;  ///< where the lobe has fallen to half: tan θ_h = 0.64 α, θ = 2 θ_h
};

void fill_level(int level, double alpha, const CubeTree& tree, EnvironmentMap& map) {
    const int size = map.layout.size(level);
    const LobeSum lobe(tree, alpha);
    parallel_for(std::size_t{6} * static_cast<std::size_t>(size), [&](std::size_t task) {
        const int face = static_cast<int>(task) / size;
        const int row = static_cast<int>(task) % size;
        for (int column = 0; column < size; ++column) {
            const double s = (2 * column + 1.0) / size - 1;
            const double t = (2 * row + 1.0) / size - 1;
            map.texels[map.layout.index(level, face, column, row)] =
                lobe(glm::vec3(glm::normalize(cube_direction(face, s, t))));
        }
    });
}

}  // namespace

CubeLayout environment_layout(const ProbeImage& probe, const PrefilterSettings& settings) {
    ROWLAND_CHECK(std::has_single_bit(static_cast<unsigned>(settings.face_size)), "face sizes are powers of two");
    ROWLAND_CHECK_OP(settings.face_size, >=, kSmallestFace);
    ROWLAND_CHECK_OP(settings.face_size, <=, kLargestFace);
    const image::Image& image = probe.image();
    const int fine = probe.mapping() == Mapping::Angular ? image.height / 4 : image.height / 2;
    // A probe a little short of a power of two, as Debevec's 1000 texels, is not worth half the resolution.
    const auto filled = static_cast<int>(std::bit_floor(static_cast<unsigned>(std::max(fine * 5 / 4, kSmallestFace))));
    CubeLayout layout;
    layout.face_size = std::min(settings.face_size, filled);
    for (int size = layout.face_size; size >= kLastLevelFace; size /= 2) ++layout.levels;
    return layout;
}

EnvironmentMap prefilter(const ProbeImage& probe, const PrefilterSettings& settings) {
    EnvironmentMap map;
    map.layout = environment_layout(probe, settings);
    map.texels.resize(map.layout.offset(map.layout.levels));
    fill_level0(probe, map);
    const CubeTree tree(std::span(map.texels).first(map.layout.offset(1)), map.layout.face_size);
    for (int level = 1; level < map.layout.levels; ++level) {
        const double roughness = static_cast<double>(level) / (map.layout.levels - 1);
        fill_level(level, roughness * roughness, tree, map);
    }
    return map;
}

}  // namespace rowland::lighting
