#include "engine/lighting/lobe_nodes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "editor/lobe_nodes/fit_lobe_nodes.h"
#include "editor/lobe_nodes/gauss_nodes.h"

namespace rowland::lighting {
namespace {

double mean_by_nodes(const LobeNodes& nodes, const std::function<double(double)>& f) {
    double sum = 0.0;
    for (const LobeNode& node : nodes) sum += node.weight * f(node.cosine);
    return sum;
}

/// Slow and obvious: over every sampled half vector.
double mean_by_sampling(double view_cosine, double roughness, const std::function<double(double)>& f) {
    double sum = 0.0;
    double weights = 0.0;
    sample_lobe(view_cosine, roughness, [&](double cosine, double weight) {
        sum += weight * f(cosine);
        weights += weight;
    });
    return sum / weights;
}

/// A fringe that falls off as a Fresnel term does, like those of a film 400 nm thick.
double fringe(double cosine) {
    return std::pow(1.0 - cosine, 5.0) + 0.5 * std::cos(7.0 * cosine);
}

TEST(LobeNodes, AreExactForPolynomialsOfDegreeSeven) {
    for (const double roughness : {0.1, 0.4, 1.0})
        for (const double cosine : {0.05, 0.4, 0.98})
            for (int degree = 0; degree <= 7; ++degree) {
                const auto power = [&](double c) { return std::pow(c, 0.7 * degree); };
                EXPECT_NEAR(mean_by_nodes(gauss_nodes(cosine, roughness), power),
                            mean_by_sampling(cosine, roughness, power), 1e-9)
                    << roughness << " " << cosine << " " << degree;
            }
}

/// Of values up to 1.5. 0.0042 measured, at grazing incidence and roughness 0.52.
constexpr double kTolerance = 0.005;

TEST(LobeNodes, FromTheirTableGiveTheMeanOfAFringeOverTheLobe) {
    for (const double roughness : {0.03, 0.08, 0.15, 0.33, 0.52, 0.77, 0.95})
        for (const double cosine : {0.06, 0.11, 0.23, 0.45, 0.7, 0.9, 0.99})
            EXPECT_NEAR(mean_by_nodes(lobe_node_table().at(cosine, roughness), fringe),
                        mean_by_sampling(cosine, roughness, fringe), kTolerance)
                << roughness << " " << cosine;
}

TEST(LobeNodes, OfAMirrorAreTheMirror) {
    for (const double cosine : {0.0, 0.3, 1.0})
        for (const LobeNode& node : lobe_node_table().at(cosine, 0.0)) {
            EXPECT_NEAR(node.cosine, cosine, 1e-6);
            EXPECT_EQ(node.lean, 0.0);
            EXPECT_EQ(node.roughness, 0.0);
        }
}

TEST(LobeNodes, LookUpsAddUpToTheLobe) {
    // A look-up along the mirror's direction, as a surface without nodes has it, is 13 to 71 % off at these angles.
    for (const double roughness : {0.12, 0.25, 0.42, 0.6}) {
        EXPECT_LE(lobe_misfit(0.9, roughness, lobe_node_table().at(0.9, roughness)), 0.3) << roughness;
        EXPECT_LE(lobe_misfit(0.6, roughness, lobe_node_table().at(0.6, roughness)), 0.3) << roughness;
        EXPECT_LE(lobe_misfit(0.35, roughness, lobe_node_table().at(0.35, roughness)), 0.4) << roughness;
    }
}

TEST(LobeNodesOfTheFile, AreThoseOfAFit) {
    for (const int row : {2, 9, 16, 22})
        for (const int column : {2, 13, 27}) {
            const double cosine = column_view_cosine(column);
            const double roughness = row_roughness(row);
            LobeNodes exact = gauss_nodes(cosine, roughness);
            const LobeNodes read = texel_nodes(lobe_node_table(), column, row);
            for (std::size_t i = 0; i < exact.size(); ++i) {
                EXPECT_NEAR(read.at(i).cosine, exact.at(i).cosine, 1e-3) << row << " " << column;
                EXPECT_NEAR(read.at(i).weight, exact.at(i).weight, 1e-3) << row << " " << column;
                exact.at(i).lean = read.at(i).lean;
                exact.at(i).roughness = read.at(i).roughness;
            }
            const double misfit = lobe_misfit(cosine, roughness, exact);
            const double refined = lobe_misfit(cosine, roughness, refine_nodes(cosine, roughness, exact));
            EXPECT_LE(misfit, 1.08 * refined) << row << " " << column;
        }
}

}  // namespace
}  // namespace rowland::lighting
