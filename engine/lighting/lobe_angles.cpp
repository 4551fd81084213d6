#include "engine/lighting/lobe_angles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rowland::lighting {

namespace {

constexpr int kHeights = 256;  ///< of half vectors
constexpr int kTurns = 64;     ///< about the normal, over half a turn: the other half mirrors it

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
        for (int j = 0; j < kTurns; ++j) {
            const double v_h = view_sine * h_x * std::cos(std::numbers::pi * (j + 0.5) / kTurns) + n_v * h_z;
            const double n_l = 2.0 * v_h * h_z - n_v;
            if (n_l <= 0.0 || v_h <= 0.0) continue;
            f(std::min(v_h, 1.0), shadowing(n_l, n_v, a2) * v_h / (h_z * n_v) / (kHeights * kTurns));
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

}  // namespace rowland::lighting
