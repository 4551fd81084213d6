#include "tests/gpu/modules/diffraction/drawn_triangle.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "modules/diffraction/runtime/vertex_light.h"

namespace rowland::diffraction {

scene::Mesh crooked_triangle() {
    scene::Mesh mesh;
    mesh.positions = {{-1.0F, -0.8F, 0.1F}, {1.1F, -0.9F, -0.2F}, {0.0F, 1.0F, 0.3F}};
    for (const glm::vec3 normal :
         {glm::vec3(-0.2F, 0.1F, 1.0F), glm::vec3(0.3F, 0.0F, 1.0F), glm::vec3(0.0F, 0.3F, 1.0F)})
        mesh.normals.push_back(glm::normalize(normal));
    const glm::vec3 along[] = {{1.0F, 0.2F, 0.0F}, {0.6F, -1.0F, 0.0F}, {0.9F, 0.6F, 0.0F}};
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::vec3 n = mesh.normals[i];
        mesh.tangents.emplace_back(glm::normalize(along[i] - n * glm::dot(n, along[i])), -1.0F);
    }
    mesh.uvs.resize(3);
    mesh.indices = {0, 1, 2};
    return mesh;
}

scene::Mesh flat_triangle() {
    scene::Mesh mesh = crooked_triangle();
    const glm::vec3 n(0.0F, 0.0F, 1.0F);
    for (std::size_t i = 0; i < 3; ++i) {
        mesh.positions[i].z = 0.0F;
        mesh.normals[i] = n;
        const glm::vec3 g(mesh.tangents[i]);
        mesh.tangents[i] = glm::vec4(glm::normalize(g - n * glm::dot(n, g)), 1.0F);
    }
    return mesh;
}

double footprint(const Point& point, const glm::dvec3& toward) {
    const auto change = [&](const Point::Change& more) { return glm::dot(toward, more.g) + more.view.x; };
    return 0.5 * std::hypot(change(point.beside), change(point.below));
}

double footprint_of_lamp(const Point& point, const glm::dvec3& lamp) {
    const glm::dvec3 g = glm::transpose(point.to_tangent)[0];
    const auto change = [&](const Point::Change& more) {
        const glm::dvec3 here = glm::normalize(lamp - point.position);
        const glm::dvec3 there = glm::normalize(lamp - point.position - more.position);
        return glm::dot(there, g + more.g) - glm::dot(here, g) + more.view.x;
    };
    return 0.5 * std::hypot(change(point.beside), change(point.below));
}

DrawnTriangle::DrawnTriangle() {
    transform_.rotation = glm::angleAxis(0.4F, glm::normalize(glm::vec3(1.0F, 2.0F, 0.5F)));
    camera_.eye = {0.4F, 0.5F, 3.0F};
}

glm::dmat3 DrawnTriangle::vertex_frame(std::size_t vertex) const {
    return tangent_frame(mesh_.normals[vertex], mesh_.tangents[vertex], transform_.matrix(), rotation_);
}

lighting::ShLight DrawnTriangle::vertex_light(std::size_t vertex, const lighting::ShLight& light, int bands) const {
    const lighting::ShLight limited = lighting::limit_bands(light, bands);
    lighting::ShLight rotated = limited;
    math::ShRotation(vertex_frame(vertex), bands)
        .apply(std::span<const glm::dvec3>(limited.coefficients), rotated.coefficients);
    return rotated;
}

glm::dvec3 DrawnTriangle::vertex_view(std::size_t vertex) const {
    const glm::dvec3 position(transform_.matrix() * glm::vec4(mesh_.positions[vertex], 1.0F));
    return vertex_frame(vertex) * glm::normalize(glm::dvec3(camera_.eye) - position);
}

glm::dvec3 DrawnTriangle::mix(const Point& point, const std::vector<glm::dvec3>& vertices) {
    return point.weights.x * vertices[0] + point.weights.y * vertices[1] + point.weights.z * vertices[2];
}

Point DrawnTriangle::point_at(int column, int row) const {
    Point point = single_point_at(column, row);
    // Shaders take differences within two by two pixels.
    const auto change = [&](const Point& next) {
        const glm::dmat3 more = glm::transpose(next.to_tangent) - glm::transpose(point.to_tangent);
        return Point::Change{.g = more[0],
                             .h = more[1],
                             .view = glm::dvec2(next.view) - glm::dvec2(point.view),
                             .position = next.position - point.position};
    };
    point.beside = change(single_point_at(column ^ 1, row));
    point.below = change(single_point_at(column, row ^ 1));
    return point;
}

Point DrawnTriangle::single_point_at(int column, int row) const {
    const glm::mat4 matrix = transform_.matrix();
    const glm::dvec2 ndc(2.0 * (column + 0.5) / kSize - 1.0, 1.0 - 2.0 * (row + 0.5) / kSize);
    const glm::dmat4 to_world = glm::inverse(glm::dmat4(camera_.projection(1.0F)) * glm::dmat4(camera_.view()));
    const glm::dvec4 far = to_world * glm::dvec4(ndc, 1.0, 1.0);
    const glm::dvec3 eye(camera_.eye);
    const glm::dvec3 direction = glm::dvec3(far) / far.w - eye;
    glm::dvec3 p[3];
    for (std::size_t i = 0; i < 3; ++i) p[i] = glm::dvec3(matrix * glm::vec4(mesh_.positions[i], 1.0F));
    // eye + t direction = w0 p0 + w1 p1 + w2 p2, w0 + w1 + w2 = 1
    const glm::dvec3 solution = glm::inverse(glm::dmat3(p[1] - p[0], p[2] - p[0], -direction)) * (eye - p[0]);
    Point point;
    point.weights = {1.0 - solution.x - solution.y, solution.x, solution.y};
    point.position = eye + solution.z * direction;
    glm::dvec3 g(0.0);
    glm::dvec3 n(0.0);
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dmat3 axes = glm::transpose(vertex_frame(i));
        g += point.weights[static_cast<int>(i)] * axes[0];
        n += point.weights[static_cast<int>(i)] * axes[2];
    }
    n = glm::normalize(n);
    g = glm::normalize(g - n * glm::dot(n, g));
    point.to_tangent = glm::transpose(glm::dmat3(g, glm::cross(n, g), n));
    point.view = point.to_tangent * glm::normalize(eye - point.position);
    return point;
}

}  // namespace rowland::diffraction
