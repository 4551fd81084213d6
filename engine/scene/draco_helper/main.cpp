// Decodes Draco streams for the importer, which cannot trust the decoder with files from anywhere: a few damaged bytes
// make it run on or take gigabytes. Here it may; the importer ends this process and refuses the file.
#include <draco/compression/decode.h>
#include <draco/mesh/mesh.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/scene/draco_exchange.h"

namespace {

using rowland::scene::DracoAsk;
using rowland::scene::DracoAttribute;
using rowland::scene::DracoElement;
using rowland::scene::DracoReply;
using rowland::scene::DracoRequest;

/// From and to the importer. There is nobody to tell if it is gone.
void receive(void* data, std::size_t size) {
    auto* at = static_cast<std::byte*>(data);
    while (size > 0) {
        const ssize_t count = read(STDIN_FILENO, at, size);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) std::_Exit(0);
        at += count;
        size -= static_cast<std::size_t>(count);
    }
}

void send(const void* data, std::size_t size) {
    const auto* at = static_cast<const std::byte*>(data);
    while (size > 0) {
        const ssize_t count = ::send(STDIN_FILENO, at, size, MSG_NOSIGNAL);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) std::_Exit(0);
        at += count;
        size -= static_cast<std::size_t>(count);
    }
}

template <typename Value>
void send(const std::vector<Value>& values) {
    send(values.data(), values.size() * sizeof(Value));
}

void limit(int resource, rlim_t most) {
    const rlimit limits{most, RLIM_INFINITY};
    if (setrlimit(static_cast<__rlimit_resource>(resource), &limits) != 0) std::_Exit(1);
}

std::unique_ptr<draco::Mesh> decode(const DracoRequest& request) {
    limit(RLIMIT_AS, request.memory);
    std::vector<char> stream(request.size);
    receive(stream.data(), stream.size());
    draco::DecoderBuffer buffer;
    buffer.Init(stream.data(), stream.size());
    draco::Decoder decoder;
    auto result = decoder.DecodeMeshFromBuffer(&buffer);
    if (!result.ok()) throw std::runtime_error(result.status().error_msg_string());
    return std::move(result).value();
}

/// The largest code of integers that the decoder leaves as they are, and that stand for fractions in a normalised
/// attribute.
std::uint32_t largest_code(const draco::PointAttribute& attribute) {
    if (attribute.normalized()) return 1;
    switch (attribute.data_type()) {
        case draco::DT_INT8:
            return 127;
        case draco::DT_UINT8:
            return 255;
        case draco::DT_INT16:
            return 32767;
        case draco::DT_UINT16:
            return 65535;
        default:
            return 1;
    }
}

std::vector<DracoAttribute> attributes(const draco::Mesh& mesh) {
    std::vector<DracoAttribute> result;
    for (int i = 0; i < mesh.num_attributes(); ++i) {
        const draco::PointAttribute& attribute = *mesh.attribute(i);
        result.push_back({attribute.unique_id(), attribute.num_components(), largest_code(attribute)});
    }
    return result;
}

std::vector<std::uint32_t> indices(const draco::Mesh& mesh) {
    std::vector<std::uint32_t> result;
    result.reserve(std::size_t{mesh.num_faces()} * 3);
    for (draco::FaceIndex face(0); face < mesh.num_faces(); ++face)
        for (const draco::PointIndex& point : mesh.face(face)) result.push_back(point.value());
    return result;
}

template <typename Component>
std::vector<Component> values(const draco::Mesh& mesh, const DracoRequest& request) {
    const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(request.attribute);
    const std::size_t components = request.components;
    if (!attribute || components != attribute->num_components()) throw std::runtime_error("no such attribute");
    if (!attribute->is_mapping_identity() && attribute->indices_map_size() < mesh.num_points())
        throw std::runtime_error("fewer values than vertices");
    std::vector<Component> result(mesh.num_points() * components);
    for (std::uint32_t i = 0; i < mesh.num_points(); ++i) {
        const draco::AttributeValueIndex value = attribute->mapped_index(draco::PointIndex(i));
        if (value.value() >= attribute->size() ||
            !attribute->ConvertValue<Component>(value, static_cast<std::int8_t>(components), &result[i * components]))
            throw std::runtime_error("a value that is not there or does not fit");
    }
    return result;
}

class Helper {
 public:
    [[noreturn]] void run() {
        while (true) {
            DracoRequest request;
            receive(&request, sizeof request);
            try {
                answer(request);
            } catch (const std::bad_alloc&) {
                refuse("it takes too much memory");
            } catch (const std::exception& error) {
                refuse(error.what());
            }
        }
    }

 private:
    void answer(const DracoRequest& request) {
        if (request.ask == DracoAsk::Decode) {
            mesh_.reset();
            mesh_ = decode(request);
            const auto list = attributes(*mesh_);
            agree(list.size());
            send(list);
        } else if (request.ask == DracoAsk::Indices) {
            agree_and_send(indices(*mesh_));
        } else if (request.element == DracoElement::Float) {
            agree_and_send(values<float>(*mesh_, request));
        } else {
            agree_and_send(values<std::uint16_t>(*mesh_, request));
        }
    }

    void agree(std::size_t attributes) {
        const DracoReply reply{.done = 1,
                               .points = mesh_->num_points(),
                               .faces = mesh_->num_faces(),
                               .attributes = static_cast<std::uint32_t>(attributes),
                               .reason = {}};
        send(&reply, sizeof reply);
    }

    template <typename Value>
    void agree_and_send(const std::vector<Value>& list) {
        agree(0);
        send(list);
    }

    static void refuse(std::string reason) {
        DracoReply reply;
        reason.resize(std::min(reason.size(), reply.reason.size() - 1));
        std::copy(reason.begin(), reason.end(), reply.reason.begin());
        send(&reply, sizeof reply);
    }

    std::unique_ptr<draco::Mesh> mesh_;
};

}  // namespace

int main() {
    // The importer's end of us may come while the decoder runs.
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    limit(RLIMIT_CORE, 0);
    Helper().run();
}
