#include "engine/scene/draco_decode.h"

#include <gmock/gmock.h>

#include <cstdlib>

#include "engine/core/file.h"
#include "engine/scene/glb_write.h"
#include "engine/scene/mesh_recipe.h"
#include "tests/support/environment.h"
#include "tests/support/expect.h"
#include "tests/support/files.h"

namespace rowland::scene {
namespace {

using testing::HasSubstr;

Mesh disc() {
    return build_mesh(DiscRecipe{.inner_radius = 0.02, .outer_radius = 0.06, .rings = 8, .segments = 32});
}

std::vector<std::byte> stream_of(const Mesh& mesh) {
    const std::vector<char> bytes = encode_draco(mesh).bytes;
    const auto* begin = reinterpret_cast<const std::byte*>(bytes.data());
    return {begin, begin + bytes.size()};
}

/// A stream that fuzzing found.
std::vector<std::byte> found(const std::string& name) {
    return read_file(rowland::test::source_path("tests/fuzz/corpus/draco") / name, 1 << 20);
}

/// Why a stream is refused; empty if it is decoded.
std::string refusal(DracoProcess& process, const std::vector<std::byte>& stream) {
    try {
        process.decode(stream);
        return {};
    } catch (const DracoRefusal& refusal) {
        return refusal.what();
    }
}

TEST(DracoProcess, GivesBackWhatWasEncoded) {
    const Mesh mesh = disc();
    DracoProcess process;
    const DracoProcess::Decoded decoded = process.decode(stream_of(mesh));
    ASSERT_EQ(decoded.points, mesh.positions.size());
    ASSERT_EQ(decoded.faces, mesh.indices.size() / 3);
    std::vector<std::uint32_t> indices(mesh.indices.size());
    process.indices(indices);
    EXPECT_EQ(indices, mesh.indices);
    ASSERT_EQ(decoded.attributes.size(), 4U);
    const DracoAttribute& position = decoded.attributes.at(DracoIds::kPosition);
    ASSERT_EQ(position.components, 3U);
    std::vector<float> values(decoded.points * 3);
    process.values(position, values);
    // A step of 16 bits over the largest extent, 12 cm.
    constexpr double kStep = 0.12 / 65535;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        for (int k = 0; k < 3; ++k)
            ASSERT_NEAR(values[3 * i + static_cast<std::size_t>(k)], mesh.positions[i][k], kStep) << "vertex " << i;
}

TEST(DracoProcess, StreamThatRunsOnIsRefusedInTime) {
    DracoProcess process({.time = std::chrono::milliseconds(100)});  // it runs for 2.4 s
    EXPECT_EQ(refusal(process, found("runs_on.drc")), "not decoded within 100 ms");
    // The time is for all streams; each of 295 bytes adds 0.9 ms.
    EXPECT_EQ(refusal(process, found("runs_on.drc")), "not decoded within 101 ms");
}

TEST(DracoProcess, StreamThatTakesMuchMemoryIsRefusedAndTheNextIsDecoded) {
    if (rowland::test::under_wine()) GTEST_SKIP() << "Wine limits no job's memory";
    DracoProcess process({.memory = 64U << 20});  // it takes 270 MB
    EXPECT_EQ(refusal(process, found("takes_much_memory.drc")), "it takes too much memory");
    EXPECT_EQ(refusal(process, stream_of(disc())), "");
}

TEST(DracoProcess, AttributeThatIsNotThereIsRefused) {
    DracoProcess process;
    const DracoProcess::Decoded decoded = process.decode(stream_of(disc()));
    std::vector<float> values(decoded.points * 3);
    try {
        process.values(DracoAttribute{.unique_id = 77, .components = 3}, values);
        ADD_FAILURE() << "found";
    } catch (const DracoRefusal& refusal) {
        EXPECT_STREQ(refusal.what(), "no such attribute");
    }
}

TEST(DracoProcess, MissingHelperIsTheSystemsFault) {
    const rowland::test::TemporaryFolder empty;
    rowland::test::set_variable("ROWLAND_HELPER_FOLDER", empty.path().string());
    EXPECT_THAT(rowland::test::message_of([] { DracoProcess().decode(stream_of(disc())); }, Fault::System),
                HasSubstr("rowland-decode-draco: not in"));
    rowland::test::set_variable("ROWLAND_HELPER_FOLDER", std::nullopt);
}

}  // namespace
}  // namespace rowland::scene
