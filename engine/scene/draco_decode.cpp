#include "engine/scene/draco_decode.h"

#include <draco/compression/decode.h>
#include <draco/mesh/mesh.h>
#include <fmt/format.h>

#include <chrono>
#include <exception>
#include <future>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <thread>
#include <type_traits>

#include "engine/core/error.h"
#include "engine/scene/draco_header.h"

namespace rowland::scene {

namespace {

/// What makes one of an attribute's normalised integers; 1 if the decoder does it itself, or if there is nothing to do.
float normalising_factor(const draco::PointAttribute& attribute) {
    if (attribute.normalized()) return 1.0F;
    switch (attribute.data_type()) {
        case draco::DT_INT8:
            return 1.0F / 127.0F;
        case draco::DT_UINT8:
            return 1.0F / 255.0F;
        case draco::DT_INT16:
            return 1.0F / 32767.0F;
        case draco::DT_UINT16:
            return 1.0F / 65535.0F;
        default:
            return 1.0F;
    }
}

/// One decoding, shared with the thread that does it.
struct Job {
    std::vector<char> stream;
    std::promise<void> finished;
    std::unique_ptr<draco::Mesh> mesh;  ///< null: failed, for `reason`
    std::string reason;
};

void decode(Job& job) {
    try {
        draco::DecoderBuffer buffer;
        buffer.Init(job.stream.data(), job.stream.size());
        draco::Decoder decoder;
        auto result = decoder.DecodeMeshFromBuffer(&buffer);
        if (result.ok())
            job.mesh = std::move(result).value();
        else
            job.reason = result.status().error_msg_string();
    } catch (const std::exception& error) {
        job.reason = error.what();
    }
}

/// Decodes within `limit`; a null mesh and a reason if it fails. The decoder cannot be interrupted, and a few damaged
/// bytes can keep it busy for a quarter of a minute (it takes a count of up to 2^31 bits on trust), so it runs in a
/// thread of its own that is left behind if it takes too long. That thread owns all it touches and ends by itself.
std::shared_ptr<Job> decode_within(std::span<const std::byte> stream, std::chrono::milliseconds limit) {
    auto job = std::make_shared<Job>();
    const auto* characters = reinterpret_cast<const char*>(stream.data());
    job->stream.assign(characters, characters + stream.size());
    std::future<void> finished = job->finished.get_future();
    std::thread([job] {
        decode(*job);
        job->finished.set_value();
    }).detach();
    if (finished.wait_for(limit) == std::future_status::ready) return job;
    auto late = std::make_shared<Job>();
    late->reason = fmt::format("not decoded within {} ms", limit.count());
    return late;
}

}  // namespace

struct DracoMesh::Decoded {
    std::unique_ptr<draco::Mesh> mesh;
    std::string file;
    std::string place;
    MemoryBudget* budget;

    [[noreturn]] void fail(std::string found, std::string expected) const {
        throw Error({.file = file,
                     .place = place,
                     .found = std::move(found),
                     .expected = std::move(expected),
                     .remedy = "export the mesh again"});
    }
    const draco::PointAttribute& attribute(std::uint32_t id, const std::string& name) const {
        const draco::PointAttribute* found = mesh->GetAttributeByUniqueId(id);
        if (!found) fail(fmt::format("no Draco attribute {} for {}", id, name), "one");
        return *found;
    }
};

DracoMesh::DracoMesh(std::span<const std::byte> stream, const std::string& file, const std::string& place,
                     MemoryBudget& budget)
    : decoded_(std::make_unique<Decoded>(Decoded{nullptr, file, place, &budget})) {
    const DracoCounts counts = read_draco_counts(stream, file + ": " + place);
    // What the decoder's corner table takes: two indices a corner, and the face's vertices.
    constexpr std::uint64_t kBytesPerFace = 9 * sizeof(std::uint32_t);
    budget.spend(counts.faces, kBytesPerFace, place);
    // Decoding takes 1 to 2 µs a face; thirty times that, and time for a machine that is busy with other things.
    const auto limit = std::chrono::milliseconds(3000 + counts.faces / 20);
    const std::shared_ptr<Job> job = decode_within(stream, limit);
    if (!job->mesh) decoded_->fail(fmt::format("a broken Draco stream ({})", job->reason), "a whole one");
    decoded_->mesh = std::move(job->mesh);
    if (decoded_->mesh->num_points() == 0 || decoded_->mesh->num_faces() == 0)
        decoded_->fail("an empty Draco mesh", "triangles");
}

DracoMesh::~DracoMesh() = default;

std::size_t DracoMesh::vertex_count() const {
    return decoded_->mesh->num_points();
}

std::vector<std::uint32_t> DracoMesh::indices() const {
    const draco::Mesh& mesh = *decoded_->mesh;
    decoded_->budget->spend(mesh.num_faces(), 3 * sizeof(std::uint32_t), decoded_->place);
    std::vector<std::uint32_t> indices;
    indices.reserve(std::size_t{mesh.num_faces()} * 3);
    for (draco::FaceIndex face(0); face < mesh.num_faces(); ++face) {
        for (const draco::PointIndex& point : mesh.face(face)) {
            if (point.value() >= mesh.num_points())
                decoded_->fail(fmt::format("index {}", point.value()),
                               fmt::format("below the {} vertices", mesh.num_points()));
            indices.push_back(point.value());
        }
    }
    return indices;
}

int DracoMesh::component_count(std::uint32_t id, const std::string& name) const {
    return decoded_->attribute(id, name).num_components();
}

template <typename Vector>
std::vector<Vector> DracoMesh::vectors(std::uint32_t id, const std::string& name, bool normalised) const {
    using Component = typename Vector::value_type;
    const draco::Mesh& mesh = *decoded_->mesh;
    const draco::PointAttribute& attribute = decoded_->attribute(id, name);
    if (attribute.num_components() != Vector::length())
        decoded_->fail(fmt::format("{} components of {}", attribute.num_components(), name),
                       fmt::format("{}", Vector::length()));
    if (!attribute.is_mapping_identity() && attribute.indices_map_size() < mesh.num_points())
        decoded_->fail(fmt::format("values of {} for {} vertices", name, attribute.indices_map_size()),
                       fmt::format("{}", mesh.num_points()));
    decoded_->budget->spend(mesh.num_points(), sizeof(Vector), decoded_->place);
    std::vector<Vector> vectors(mesh.num_points());
    for (std::uint32_t i = 0; i < mesh.num_points(); ++i) {
        const draco::AttributeValueIndex value = attribute.mapped_index(draco::PointIndex(i));
        if (value.value() >= attribute.size() ||
            !attribute.ConvertValue<Component>(value, static_cast<int8_t>(Vector::length()), &vectors[i][0]))
            decoded_->fail(fmt::format("value {} of {}", value.value(), name),
                           fmt::format("one below {}, the number of values, that fits", attribute.size()));
    }
    if constexpr (std::is_floating_point_v<Component>) {
        const float factor = normalised ? normalising_factor(attribute) : 1.0F;
        // Signed types have two codes for −1 (glTF 2.0, 3.6.2.2).
        if (factor != 1.0F)
            for (Vector& vector : vectors) vector = glm::max(vector * factor, Vector(-1.0F));
    }
    return vectors;
}
template std::vector<glm::vec2> DracoMesh::vectors<glm::vec2>(std::uint32_t, const std::string&, bool) const;
template std::vector<glm::vec3> DracoMesh::vectors<glm::vec3>(std::uint32_t, const std::string&, bool) const;
template std::vector<glm::vec4> DracoMesh::vectors<glm::vec4>(std::uint32_t, const std::string&, bool) const;
template std::vector<glm::u16vec4> DracoMesh::vectors<glm::u16vec4>(std::uint32_t, const std::string&, bool) const;

}  // namespace rowland::scene
