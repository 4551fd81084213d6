#include "engine/scene/draco_decode.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "engine/core/check.h"
#include "engine/core/error.h"
#include "engine/core/program.h"

namespace rowland::scene {

namespace {

using Exchange = ChildProcess::Exchange;
using std::chrono::steady_clock;

// Streams of 2 million triangles with 48 bytes per vertex were measured to take, per triangle, 1 to 4 bytes, 0.5 µs and
// 175 bytes of memory. The limits leave room for better compression and for a machine that is ten times slower.
constexpr std::chrono::microseconds kTimePerByte{3};
constexpr std::uint64_t kMemoryPerByte = 192;

}  // namespace

/// Adds the time from its construction to its destruction to the owner's used_.
class DracoProcess::Timed {
 public:
    explicit Timed(DracoProcess& owner) : owner_(owner) { owner_.begin_ = steady_clock::now(); }
    ~Timed() { owner_.used_ += steady_clock::now() - owner_.begin_; }
    Timed(const Timed&) = delete;
    Timed& operator=(const Timed&) = delete;

 private:
    DracoProcess& owner_;
};

/// Ends the process if the exchange failed: its later answers would be out of step.
void DracoProcess::require_done(Exchange exchange) {
    if (exchange == Exchange::Done) return;
    const std::string why = exchange == Exchange::Ended
                                ? fmt::format("the decoder {}", process_->ending())
                                : fmt::format("not decoded within {} ms",
                                              std::chrono::duration_cast<std::chrono::milliseconds>(allowed_).count());
    process_.reset();
    throw DracoRefusal(why);
}

DracoReply DracoProcess::ask(const DracoRequest& request, std::span<const std::byte> sent) {
    require_done(process_->send(std::as_bytes(std::span(&request, 1)), deadline()));
    require_done(process_->send(sent, deadline()));
    DracoReply reply;
    require_done(process_->receive(std::as_writable_bytes(std::span(&reply, 1)), deadline()));
    if (reply.done == 0)
        throw DracoRefusal(std::string(reply.reason.data(), strnlen(reply.reason.data(), reply.reason.size())));
    return reply;
}

DracoProcess::Decoded DracoProcess::decode(std::span<const std::byte> stream) {
    if (!process_) process_.emplace(helper_program(std::string(kDracoHelper)));
    const Timed timed(*this);
    allowed_ += kTimePerByte * stream.size();
    const DracoReply reply = ask({.ask = DracoAsk::Decode,
                                  .size = stream.size(),
                                  .memory = std::max<std::uint64_t>(memory_, kMemoryPerByte * stream.size())},
                                 stream);
    // Every attribute has a header of several bytes in the stream.
    if (reply.attributes > stream.size()) throw DracoRefusal(fmt::format("{} attributes", reply.attributes));
    Decoded decoded{reply.points, reply.faces, std::vector<DracoAttribute>(reply.attributes)};
    require_done(process_->receive(std::as_writable_bytes(std::span(decoded.attributes)), deadline()));
    return decoded;
}

void DracoProcess::fetch(const DracoRequest& request, std::span<std::byte> result) {
    ROWLAND_CHECK(process_.has_value(), "results are fetched after decode()");
    const Timed timed(*this);
    ask(request, {});
    require_done(process_->receive(result, deadline()));
}

DracoMesh::DracoMesh(std::span<const std::byte> stream, const std::string& file, const std::string& pointer,
                     DracoProcess& decoder, MemoryBudget& budget)
    : file_(file), pointer_(pointer), decoder_(decoder), budget_(budget) {
    try {
        decoded_ = decoder.decode(stream);
    } catch (const DracoRefusal& refusal) {
        fail(fmt::format("a broken Draco stream ({})", refusal.what()), "a whole one");
    }
    if (decoded_.points == 0 || decoded_.faces == 0) fail("an empty Draco mesh", "triangles");
}

void DracoMesh::fail(std::string found, std::string expected) const {
    refuse_input(file_, pointer_, std::move(found), std::move(expected), "export the mesh again");
}

std::vector<std::uint32_t> DracoMesh::indices() const {
    budget_.spend(decoded_.faces, 3 * sizeof(std::uint32_t), pointer_);
    std::vector<std::uint32_t> indices(decoded_.faces * 3);
    try {
        decoder_.indices(indices);
    } catch (const DracoRefusal& refusal) {
        fail(fmt::format("no indices ({})", refusal.what()), "those of the faces");
    }
    for (const std::uint32_t index : indices)
        if (index >= decoded_.points)
            fail(fmt::format("index {}", index), fmt::format("below the {} vertices", decoded_.points));
    return indices;
}

const DracoAttribute& DracoMesh::attribute(std::uint32_t id, const std::string& name) const {
    const auto found = std::find_if(decoded_.attributes.begin(), decoded_.attributes.end(),
                                    [&](const DracoAttribute& attribute) { return attribute.unique_id == id; });
    if (found == decoded_.attributes.end()) fail(fmt::format("no Draco attribute {} for {}", id, name), "one");
    return *found;
}

int DracoMesh::component_count(std::uint32_t id, const std::string& name) const {
    return static_cast<int>(attribute(id, name).components);
}

template <typename Vector>
std::vector<Vector> DracoMesh::vectors(std::uint32_t id, const std::string& name, bool normalised) const {
    constexpr auto kLength = static_cast<std::size_t>(Vector::length());
    static_assert(sizeof(Vector) == kLength * sizeof(float), "vectors lie one behind another");
    const DracoAttribute& source = attribute(id, name);
    if (source.components != kLength)
        fail(fmt::format("{} components of {}", source.components, name), fmt::format("{}", kLength));
    budget_.spend(decoded_.points, sizeof(Vector), pointer_);
    std::vector<Vector> vectors(decoded_.points);
    try {
        decoder_.values(source, std::span(&vectors[0][0], vectors.size() * kLength));
    } catch (const DracoRefusal& refusal) {
        fail(fmt::format("no values of {} ({})", name, refusal.what()), "one per vertex");
    }
    // Signed types have two codes for −1 (glTF 2.0, 3.6.2.2).
    const float factor = normalised ? 1.0F / static_cast<float>(source.largest_code) : 1.0F;
    if (factor != 1.0F)
        for (Vector& vector : vectors) vector = glm::max(vector * factor, Vector(-1.0F));
    return vectors;
}
template std::vector<glm::vec2> DracoMesh::vectors<glm::vec2>(std::uint32_t, const std::string&, bool) const;
template std::vector<glm::vec3> DracoMesh::vectors<glm::vec3>(std::uint32_t, const std::string&, bool) const;
template std::vector<glm::vec4> DracoMesh::vectors<glm::vec4>(std::uint32_t, const std::string&, bool) const;

}  // namespace rowland::scene
