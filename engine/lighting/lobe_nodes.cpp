#include "engine/lighting/lobe_nodes.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>
#include <span>

#include "engine/core/check.h"
#include "engine/core/text.h"

namespace rowland::lighting {

namespace {

constexpr int kHeights = 256;  ///< of half vectors
constexpr int kAzimuths = 64;  ///< over 180°; the lobe is symmetric

/// Smith's visibility × 4 n·l n·v, height-correlated [Heitz 2014].
double shadowing(double n_l, double n_v, double a2) {
    const double l = n_v * std::sqrt(n_l * n_l * (1.0 - a2) + a2);
    const double v = n_l * std::sqrt(n_v * n_v * (1.0 - a2) + a2);
    return 2.0 * n_l * n_v / (l + v);
}

}  // namespace

void sample_lobe(double view_cosine, double roughness, const std::function<void(double, double)>& f) {
    const double alpha = std::max(roughness * roughness, 1e-3);
    const double a2 = alpha * alpha;
    const double n_v = std::max(view_cosine, 1e-3);
    const double view_sine = std::sqrt(std::max(1.0 - n_v * n_v, 0.0));
    for (int i = 0; i < kHeights; ++i) {
        const double w = (i + 0.5) / kHeights;
        const double h_z = std::sqrt((1.0 - w) / (1.0 + (a2 - 1.0) * w));
        const double h_x = std::sqrt(1.0 - h_z * h_z);
        for (int j = 0; j < kAzimuths; ++j) {
            const double v_h = view_sine * h_x * std::cos(std::numbers::pi * (j + 0.5) / kAzimuths) + n_v * h_z;
            const double n_l = 2.0 * v_h * h_z - n_v;
            if (n_l <= 0.0 || v_h <= 0.0) continue;
            f(std::min(v_h, 1.0), shadowing(n_l, n_v, a2) * v_h / (h_z * n_v) / (kHeights * kAzimuths));
        }
    }
}

double lobe_albedo(double view_cosine, double roughness) {
    double sum = 0.0;
    sample_lobe(view_cosine, roughness, [&](double, double weight) { sum += weight; });
    return sum;
}

std::vector<double> lobe_angles(double view_cosine, double roughness, int steps) {
    std::vector<double> weights(static_cast<std::size_t>(steps) + 1, 0.0);
    double sum = 0.0;
    sample_lobe(view_cosine, roughness, [&](double cosine, double weight) {
        const double at = std::sqrt(cosine) * steps;
        const auto i = std::min(static_cast<std::size_t>(at), static_cast<std::size_t>(steps) - 1);
        const double t = at - static_cast<double>(i);
        weights[i] += (1.0 - t) * weight;
        weights[i + 1] += t * weight;
        sum += weight;
    });
    for (double& weight : weights) weight /= sum;
    return weights;
}

std::span<const EmbeddedFile> lobe_files();

const char* const kLobeNodesHeader =
    "column,row,root1,root2,root3,root4,weight1,weight2,weight3,weight4,lean1,lean2,lean3,lean4,"
    "roughness1,roughness2,roughness3,roughness4";

namespace {

double root_of(double cosine) {
    return std::sqrt(cosine + kLobeCosineOffset);
}

LobeNodeTable read_table() {
    const NumberTable numbers = parse_number_table(embedded_text(lobe_files(), "engine/lighting/lobe_nodes.csv"),
                                                   "lobe_nodes.csv", kLobeNodesHeader);
    constexpr auto kTexels = std::size_t{LobeNodeTable::kColumns} * LobeNodeTable::kRows;
    ROWLAND_CHECK_OP(numbers.rows.size(), ==, kTexels);
    LobeNodeTable table{.texels = std::vector<glm::vec4>(LobeNodeTable::kPlanes * kTexels)};
    for (const std::vector<double>& row : numbers.rows)
        for (std::size_t i = 0; i + 2 < row.size(); ++i)
            table.texels.at(LobeNodeTable::index(static_cast<int>(i) / kLobeNodes, static_cast<int>(row[0]),
                                                 static_cast<int>(row[1])))[static_cast<int>(i) % kLobeNodes] =
                static_cast<float>(row[i + 2]);
    return table;
}

}  // namespace

double lobe_column(double view_cosine) {
    const double root = (root_of(view_cosine) - root_of(0.0)) / (root_of(1.0) - root_of(0.0));
    return 0.5 * (root + 1.0 - std::sqrt(1.0 - view_cosine));
}

LobeNodes LobeNodeTable::nodes_of(const Planes& planes, double view_cosine, double roughness) {
    const double square = roughness * roughness;
    LobeNodes nodes;
    for (int i = 0; i < kLobeNodes; ++i) {
        const double root = root_of(view_cosine) + square * planes[0][i];
        nodes.at(static_cast<std::size_t>(i)) = {.cosine = std::clamp(root * root - kLobeCosineOffset, 0.0, 1.0),
                                                 .weight = planes[1][i],
                                                 .lean = square * planes[2][i],
                                                 .roughness = std::min(roughness * planes[3][i], 1.0)};
    }
    return nodes;
}

LobeNodes LobeNodeTable::at(double view_cosine, double roughness) const {
    const double cosine = std::clamp(view_cosine, 0.0, 1.0);
    const double rough = std::clamp(roughness, 0.0, 1.0);
    const double x = lobe_column(cosine) * (kColumns - 1);
    const double y = std::sqrt(rough) * (kRows - 1);
    const int column = std::min(static_cast<int>(x), kColumns - 2);
    const int row = std::min(static_cast<int>(y), kRows - 2);
    Planes planes;
    for (int plane = 0; plane < kPlanes; ++plane) {
        const auto value = [&](int c, int r) { return glm::dvec4(texels.at(index(plane, c, r))); };
        const auto in_row = [&](int r) { return glm::mix(value(column, r), value(column + 1, r), x - column); };
        planes.at(static_cast<std::size_t>(plane)) = glm::mix(in_row(row), in_row(row + 1), y - row);
    }
    return nodes_of(planes, cosine, rough);
}

const LobeNodeTable& lobe_node_table() {
    static const LobeNodeTable table = read_table();
    return table;
}

}  // namespace rowland::lighting
