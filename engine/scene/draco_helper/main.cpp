// Decodes Draco streams for the importer. A few damaged bytes make Draco's decoder hang or take gigabytes; here that
// does no harm, because the importer ends this process and refuses the file.
#include <draco/compression/decode.h>
#include <draco/mesh/mesh.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/core/helper_process.h"
#include "engine/scene/draco_exchange.h"

namespace {

using rowland::scene::DracoAsk;
using rowland::scene::DracoAttribute;
using rowland::scene::DracoReply;
using rowland::scene::DracoRequest;

// receive() and send() exchange bytes with the importer. If it has ended, they end this process.
void receive(void* data, std::size_t size) {
    if (!rowland::receive_from_starter(data, size)) std::_Exit(0);
}

void send(const void* data, std::size_t size) {
    if (!rowland::send_to_starter(data, size)) std::_Exit(0);
}

template <typename Value>
void send(const std::vector<Value>& values) {
    send(values.data(), values.size() * sizeof(Value));
}

std::unique_ptr<draco::Mesh> decode(const DracoRequest& request) {
    rowland::limit_memory(request.memory);
    std::vector<char> stream(request.size);
    receive(stream.data(), stream.size());
    draco::DecoderBuffer buffer;
    buffer.Init(stream.data(), stream.size());
    draco::Decoder decoder;
    auto result = decoder.DecodeMeshFromBuffer(&buffer);
    if (!result.ok()) throw std::runtime_error(result.status().error_msg_string());
    return std::move(result).value();
}

/// The integer that means 1; 1 for floats and for integers that the decoder normalises itself.
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

std::vector<float> values(const draco::Mesh& mesh, const DracoRequest& request) {
    const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(request.attribute);
    const std::size_t components = request.components;
    if (!attribute || components != attribute->num_components()) throw std::runtime_error("no such attribute");
    if (!attribute->is_mapping_identity() && attribute->indices_map_size() < mesh.num_points())
        throw std::runtime_error("fewer values than vertices");
    std::vector<float> result(mesh.num_points() * components);
    for (std::uint32_t i = 0; i < mesh.num_points(); ++i) {
        const draco::AttributeValueIndex value = attribute->mapped_index(draco::PointIndex(i));
        if (value.value() >= attribute->size() ||
            !attribute->ConvertValue<float>(value, static_cast<std::int8_t>(components), &result[i * components]))
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
            reply_done(list.size());
            send(list);
        } else if (request.ask == DracoAsk::Indices) {
            reply_with(indices(*mesh_));
        } else {
            reply_with(values(*mesh_, request));
        }
    }

    void reply_done(std::size_t attributes) {
        const DracoReply reply{.done = 1,
                               .points = mesh_->num_points(),
                               .faces = mesh_->num_faces(),
                               .attributes = static_cast<std::uint32_t>(attributes),
                               .reason = {}};
        send(&reply, sizeof reply);
    }

    template <typename Value>
    void reply_with(const std::vector<Value>& list) {
        reply_done(0);
        send(list);
    }

    static void refuse(std::string reason) {
        DracoReply reply;
        if (reason.empty()) reason = "no reason given";
        reason.resize(std::min(reason.size(), reply.reason.size() - 1));
        std::copy(reason.begin(), reason.end(), reply.reason.begin());
        send(&reply, sizeof reply);
    }

    std::unique_ptr<draco::Mesh> mesh_;
};

}  // namespace

int main() {
    rowland::prepare_helper();
    Helper().run();
}
