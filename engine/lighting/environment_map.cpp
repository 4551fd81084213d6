#include "engine/lighting/environment_map.h"

#include <half.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/glm.hpp>
#include <numbers>

#include "engine/core/check.h"
#include "engine/core/parallel.h"
#include "engine/lighting/light_metric.h"

namespace rowland::lighting {

namespace {

/// Solid angle of the rectangle (0,0)–(s,t) of a cube face at distance 1 [Ström & Akenine-Möller; arctan form].
double corner_solid_angle(double s, double t) {
    return std::atan2(s * t, std::sqrt(s * s + t * t + 1));
}

}  // namespace

std::size_t CubeLayout::offset(int level) const {
    std::size_t sum = 0;
    for (int k = 0; k < level; ++k) {
        const auto side = static_cast<std::size_t>(size(k));
        sum += 6 * side * side;
    }
    return sum;
}

std::size_t CubeLayout::index(int level, int face, int column, int row) const {
    const auto side = static_cast<std::size_t>(size(level));
    return offset(level) + (static_cast<std::size_t>(face) * side + static_cast<std::size_t>(row)) * side +
           static_cast<std::size_t>(column);
}

glm::dvec3 cube_direction(int face, double s, double t) {
    switch (face) {
        case 0:
            return {1, -t, -s};
        case 1:
            return {-1, -t, s};
        case 2:
            return {s, 1, t};
        case 3:
            return {s, -1, -t};
        case 4:
            return {s, -t, 1};
        case 5:
            return {-s, -t, -1};
        default:
            ROWLAND_CHECK(false, "a cube has six faces");
            return {};
    }
}

CubePoint cube_point(const glm::dvec3& d) {
    const double x = std::abs(d.x);
    const double y = std::abs(d.y);
    const double z = std::abs(d.z);
    if (x >= y && x >= z) return d.x > 0 ? CubePoint{0, -d.z / x, -d.y / x} : CubePoint{1, d.z / x, -d.y / x};
    if (y >= z) return d.y > 0 ? CubePoint{2, d.x / y, d.z / y} : CubePoint{3, d.x / y, -d.z / y};
    return d.z > 0 ? CubePoint{4, d.x / z, -d.y / z} : CubePoint{5, -d.x / z, -d.y / z};
}

double cube_solid_angle(int size, int column, int row) {
    const double step = 2.0 / size;
    const double s = column * step - 1;
    const double t = row * step - 1;
    return corner_solid_angle(s, t) - corner_solid_angle(s + step, t) - corner_solid_angle(s, t + step) +
           corner_solid_angle(s + step, t + step);
}

float half_scale(double largest) {
    return largest > 0 ? std::ldexp(1.0F, std::max(std::ilogb(largest) + 1 - 15, -120)) : 1.0F;
}

std::uint16_t to_half(double value, float scale) {
    return half(static_cast<float>(value / static_cast<double>(scale))).bits();
}

float from_half(std::uint16_t bits) {
    half value;
    value.setBits(bits);
    return value;
}

PackedEnvironmentMap pack(const EnvironmentMap& map) {
    ROWLAND_CHECK_OP(map.texels.size(), ==, map.layout.offset(map.layout.levels));
    float largest = 0;
    for (const glm::vec3& texel : map.texels)
        for (int c = 0; c < 3; ++c) {
            ROWLAND_CHECK(std::isfinite(texel[c]) && texel[c] >= 0, "an environment map holds finite light");
            largest = std::max(largest, texel[c]);
        }
    PackedEnvironmentMap packed;
    packed.layout = map.layout;
    packed.scale = half_scale(largest);
    packed.halves.reserve(3 * map.texels.size());
    for (const glm::vec3& texel : map.texels)
        for (int c = 0; c < 3; ++c) packed.halves.push_back(to_half(texel[c], packed.scale));
    return packed;
}

EnvironmentMap unpack(const PackedEnvironmentMap& packed) {
    EnvironmentMap map;
    map.layout = packed.layout;
    map.texels.resize(packed.halves.size() / 3);
    for (std::size_t i = 0; i < map.texels.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c)
            map.texels[i][static_cast<int>(c)] = from_half(packed.halves[3 * i + c]) * packed.scale;
    return map;
}

namespace {

using std::numbers::pi;
constexpr int kSmallestFace = 16;
constexpr int kLargestFace = 1024;
constexpr int kLastLevelFace = 4;

/// Widths of two equirectangular images of 2:1: x of the one whose texels are as wide as the probe's, y of the one
/// whose texels are as high.
glm::ivec2 equivalent_width(const ProbeImage& probe) {
    const image::Image& image = probe.image();
    return {image.width, probe.mapping() == Mapping::Angular ? image.width : 2 * image.height};
}

/// Level 0 where the probe is not much finer than the cube map, or is an angular map: the mean of bilinear look-ups. In
/// each direction they are two or more per texel of the probe, but at least 4 and at most 16 per texel of the cube map.
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

/// Level 0 where an equirectangular probe is much finer: each quarter of its texels is added to the cube texel in which
/// it lies. Flux is kept exactly.
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
    const bool much_finer = std::min(width.x, width.y) >= kMuchFiner * 4 * map.layout.face_size;
    if (much_finer && probe.mapping() == Mapping::Equirectangular)
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
/// distance from the normal, or with the lobe's width. A node's light is weighted at the light's centroid, so a single
/// lamp in a node is exact; the weights are summed at the nodes' centres, so constant light stays constant.
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

namespace {

/// A texel of a face; for a column or row just beyond its edge, a texel of the adjacent face.
glm::dvec3 texel(const EnvironmentMap& map, int level, int face, int column, int row) {
    const int size = map.layout.size(level);
    if (std::min(column, row) < 0 || std::max(column, row) >= size) {
        const CubePoint beyond =
            cube_point(cube_direction(face, (2.0 * column + 1.0) / size - 1.0, (2.0 * row + 1.0) / size - 1.0));
        face = beyond.face;
        column = std::clamp(static_cast<int>((beyond.s + 1.0) / 2.0 * size), 0, size - 1);
        row = std::clamp(static_cast<int>((beyond.t + 1.0) / 2.0 * size), 0, size - 1);
    }
    return glm::dvec3(map.texels[map.layout.index(level, face, column, row)]);
}

glm::dvec3 between_texels(const EnvironmentMap& map, int level, const glm::dvec3& direction) {
    const CubePoint point = cube_point(direction);
    const int size = map.layout.size(level);
    const double x = (point.s + 1.0) / 2.0 * size - 0.5;
    const double y = (point.t + 1.0) / 2.0 * size - 0.5;
    const auto column = static_cast<int>(std::floor(x));
    const auto row = static_cast<int>(std::floor(y));
    const auto in_row = [&](int r) {
        return glm::mix(texel(map, level, point.face, column, r), texel(map, level, point.face, column + 1, r),
                        x - column);
    };
    return glm::mix(in_row(row), in_row(row + 1), y - row);
}

}  // namespace

glm::dvec3 environment_light(const EnvironmentMap& map, const glm::dvec3& direction, double roughness) {
    const int last = map.layout.levels - 1;
    const double linear = roughness * last;
    const double level = std::min(linear * std::min(linear, 1.0), static_cast<double>(last));
    const int first = std::min(static_cast<int>(level), std::max(last - 1, 0));
    const glm::dvec3 light = between_texels(map, first, direction);
    return last == 0 ? light : glm::mix(light, between_texels(map, first + 1, direction), level - first);
}

glm::dvec3 lobe_direction(const glm::dvec3& n, const glm::dvec3& v, double roughness) {
    return glm::mix(glm::reflect(-v, n), n, std::pow(roughness, 3.0));
}

}  // namespace rowland::lighting
