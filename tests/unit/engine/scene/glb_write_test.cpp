#include "engine/scene/glb_write.h"

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>

#include "engine/scene/mesh_recipe.h"
#include "tests/unit/engine/scene/mesh_sanity.h"

namespace rowland::scene {
namespace {

Mesh compact_disc() {
    return build_mesh(DiscRecipe{.inner_radius = 0.0235, .outer_radius = 0.06});
}

Mesh read_back(const Mesh& mesh) {
    const ImportedScene scene = load_glb(write_glb(mesh, "written"), "written.glb");
    EXPECT_EQ(scene.meshes.size(), 1U);
    EXPECT_TRUE(scene.warnings.empty());
    return scene.meshes.at(0);
}

TEST(GlbWrite, EveryVertexAndTriangleSurvivesInOrder) {
    for (const MeshRecipe& recipe : {MeshRecipe(DiscRecipe{.inner_radius = 0.0235, .outer_radius = 0.06}),
                                     MeshRecipe(SphereRecipe{.radius = 0.05}),
                                     MeshRecipe(PlaneRecipe{.width = 1.0, .depth = 2.0, .subdivisions = 3})}) {
        const Mesh mesh = build_mesh(recipe);
        const Mesh back = read_back(mesh);
        EXPECT_EQ(back.positions.size(), mesh.positions.size());
        EXPECT_EQ(back.indices, mesh.indices);
        EXPECT_TRUE(test::is_sane(back));
    }
}

TEST(GlbWrite, UnusedVerticesSurvive) {
    Mesh mesh = build_mesh(PlaneRecipe{.width = 1.0, .depth = 1.0, .subdivisions = 3});
    mesh.indices.resize(18);
    EXPECT_EQ(read_back(mesh).positions.size(), 16U);
}

TEST(GlbWrite, ValuesAreWithinTheStatedQuantisation) {
    const Mesh mesh = build_mesh(SphereRecipe{.radius = 0.05});
    const Mesh back = read_back(mesh);
    // Half a step of extent / (2^16 − 1), and a fiftieth of that for float rounding.
    const float position_step = 0.1F / 65535.0F;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(back.positions[i][c], mesh.positions[i][c], 0.51F * position_step);
        for (int c = 0; c < 2; ++c) EXPECT_NEAR(back.uvs[i][c], mesh.uvs[i][c], 0.51F / 65535.0F);
        // Half a step of 2 / (2^16 − 2) in both coordinates of the octahedron moves the third by their sum, and in the
        // middle of a face the sphere is √3 as far out: √6 · √3 half steps.
        EXPECT_LT(glm::distance(back.normals[i], mesh.normals[i]), std::sqrt(18.0F) / 65534.0F);
        EXPECT_EQ(back.tangents[i].w, mesh.tangents[i].w);
    }
}

TEST(GlbWrite, DiscTangentsStayRadial) {
    const Mesh back = read_back(compact_disc());
    double largest = 0.0;
    for (std::size_t i = 0; i < back.positions.size(); ++i) {
        const glm::dvec3 radial = glm::normalize(glm::dvec3(back.positions[i]));
        const glm::dvec3 g = glm::normalize(glm::dvec3(back.tangents[i]));
        largest = std::max(largest, glm::length(glm::cross(radial, g)));
        EXPECT_EQ(back.normals[i], glm::vec3(0.0F, 1.0F, 0.0F));
    }
    // Tangent: half a step of 2/65535 in two components, 2.2e-5. Position: half a step of 0.12/65535 in two components
    // over the inner radius, 5.5e-5. Floats add less than 1e-6.
    EXPECT_LT(largest, 7.8e-5);
    EXPECT_GT(largest, 0.0);
}

TEST(GlbWrite, MixedHandednessSurvives) {
    Mesh mesh = build_mesh(SphereRecipe{.radius = 1.0, .rings = 8, .segments = 8});
    for (std::size_t i = 0; i < mesh.tangents.size(); i += 2) mesh.tangents[i].w = -1.0F;
    const Mesh back = read_back(mesh);
    for (std::size_t i = 0; i < mesh.tangents.size(); ++i) EXPECT_EQ(back.tangents[i].w, mesh.tangents[i].w) << i;
}

TEST(GlbWrite, CompressesToLessThanHalf) {
    // 48 bytes per vertex and 12 per triangle without compression.
    EXPECT_LT(write_glb(compact_disc()).size(), 25000U * 48U / 2U);
}

TEST(GlbWrite, BoundsInTheFileAreThoseOfItsVertices) {
    const std::vector<std::byte> bytes = write_glb(compact_disc());
    std::uint32_t json_length = 0;
    std::memcpy(&json_length, bytes.data() + 12, sizeof json_length);
    const auto json = nlohmann::json::parse(std::string(reinterpret_cast<const char*>(bytes.data()) + 20, json_length));
    const Bounds box = bounds(read_back(compact_disc()));
    for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_EQ(json["accessors"][0]["min"][c].get<float>(), box.minimum[static_cast<int>(c)]);
        EXPECT_EQ(json["accessors"][0]["max"][c].get<float>(), box.maximum[static_cast<int>(c)]);
    }
    EXPECT_EQ(json["accessors"][0]["count"], 25000);
    EXPECT_EQ(bytes.size() % 4, 0U);
}

TEST(GlbWrite, LargeRegularMeshLoadsAgain) {
    // The most regular mesh there is compresses best; the reader must not take it for a hostile stream.
    const Mesh mesh = build_mesh(PlaneRecipe{.width = 1.0, .depth = 1.0, .subdivisions = 512});
    EXPECT_EQ(read_back(mesh).positions.size(), mesh.positions.size());
}

}  // namespace
}  // namespace rowland::scene
