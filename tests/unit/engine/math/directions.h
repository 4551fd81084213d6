#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <random>
#include <vector>

namespace rowland::test {

/// `count` unit vectors, the same on every run, the six axes among them.
inline std::vector<glm::dvec3> scattered_directions(int count) {
    std::vector<glm::dvec3> directions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    for (int i = 0; i < count; ++i) {  // Fibonacci sphere
        const double z = 1 - (2 * i + 1.0) / count;
        const double phi = 2 * std::numbers::pi * i * std::numbers::phi;
        const double r = std::sqrt(1 - z * z);
        directions.emplace_back(r * std::cos(phi), r * std::sin(phi), z);
    }
    return directions;
}

/// Rotation by `angle` about `axis` (Rodrigues), to rounding.
inline glm::dmat3 rotation_about(const glm::dvec3& axis, double angle) {
    const glm::dvec3 a = glm::normalize(axis);
    const double s = std::sin(angle);
    const double h = std::sin(angle / 2);
    const double t = 2 * h * h;  // 1 − cos, without cancellation for small angles
    glm::dmat3 m(1.0);
    for (int column = 0; column < 3; ++column) {
        glm::dvec3 e(0.0);
        e[column] = 1;
        m[column] = e + s * glm::cross(a, e) + t * glm::cross(a, glm::cross(a, e));
    }
    return m;
}

/// Rotations that are hard on angle-based methods, and random ones.
inline std::vector<glm::dmat3> hard_rotations() {
    constexpr double pi = std::numbers::pi;
    std::vector<glm::dmat3> all = {glm::dmat3(1.0)};
    for (const glm::dvec3 axis : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)}) {
        glm::dmat3 half(-1.0);  // an exact rotation by 180°
        for (int i = 0; i < 3; ++i)
            if (axis[i] == 1) half[i][i] = 1;
        all.push_back(half);
        for (const double angle : {pi / 2, -pi / 2, pi, 1e-9}) all.push_back(rotation_about(axis, angle));
    }
    all.push_back(rotation_about({1, 2, 3}, 1e-9));
    all.push_back(rotation_about({1, 1, 0}, pi));
    std::mt19937_64 random(7);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> angle(-pi, pi);
    for (int i = 0; i < 8; ++i)
        all.push_back(rotation_about({normal(random), normal(random), normal(random)}, angle(random)));
    return all;
}

}  // namespace rowland::test
