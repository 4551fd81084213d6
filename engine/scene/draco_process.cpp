#include "engine/scene/draco_process.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "engine/core/check.h"

namespace rowland::scene {

namespace {

using Exchange = ChildProcess::Exchange;
using std::chrono::steady_clock;

// Streams of 2 million triangles with 48 bytes a vertex take 1 to 4 bytes, 0.5 µs and 175 bytes of memory a triangle,
// so that these leave room for ones that compress better, and for a machine that is ten times busier.
constexpr std::chrono::microseconds kTimePerByte{3};
constexpr std::uint64_t kMemoryPerByte = 192;

std::span<std::byte> bytes_of(DracoReply& reply) {
    return std::as_writable_bytes(std::span(&reply, 1));
}

}  // namespace

/// Counts the time of an exchange against the file's.
class DracoProcess::Timed {
 public:
    explicit Timed(DracoProcess& owner) : owner_(owner) { owner_.begin_ = steady_clock::now(); }
    ~Timed() { owner_.used_ += steady_clock::now() - owner_.begin_; }
    Timed(const Timed&) = delete;
    Timed& operator=(const Timed&) = delete;

 private:
    DracoProcess& owner_;
};

/// Why an exchange that is not Done was not. Whatever the process still does is of no use any more.
std::string DracoProcess::reason(Exchange exchange) {
    std::string why = exchange == Exchange::Ended
                          ? fmt::format("the decoder {}", process_->ending())
                          : fmt::format("not decoded within {} ms",
                                        std::chrono::duration_cast<std::chrono::milliseconds>(allowed_).count());
    process_.reset();
    return why;
}

std::string DracoProcess::ask(const DracoRequest& request, std::span<const std::byte> sent, DracoReply& reply) {
    Exchange exchange = process_->send(std::as_bytes(std::span(&request, 1)), deadline());
    if (exchange == Exchange::Done) exchange = process_->send(sent, deadline());
    if (exchange == Exchange::Done) exchange = process_->receive(bytes_of(reply), deadline());
    if (exchange != Exchange::Done) return reason(exchange);
    if (reply.done != 0) return {};
    std::string why(reply.reason.data(), strnlen(reply.reason.data(), reply.reason.size()));
    return why.empty() ? "no reason given" : why;
}

DracoProcess::Decoded DracoProcess::decode(std::span<const std::byte> stream) {
    if (!process_) process_.emplace(helper_program(std::string(kDracoHelper)));
    const Timed timed(*this);
    allowed_ += kTimePerByte * stream.size();
    const DracoRequest request{.ask = DracoAsk::Decode,
                               .size = stream.size(),
                               .memory = std::max<std::uint64_t>(memory_, kMemoryPerByte * stream.size())};
    DracoReply reply;
    Decoded decoded;
    decoded.refused = ask(request, stream, reply);
    if (!decoded.refused.empty()) return decoded;
    decoded.points = reply.points;
    decoded.faces = reply.faces;
    // Every attribute has a head of some bytes in the stream.
    if (reply.attributes > stream.size()) {
        decoded.refused = fmt::format("{} attributes", reply.attributes);
        return decoded;
    }
    decoded.attributes.resize(reply.attributes);
    const Exchange exchange = process_->receive(std::as_writable_bytes(std::span(decoded.attributes)), deadline());
    if (exchange != Exchange::Done) decoded.refused = reason(exchange);
    return decoded;
}

std::string DracoProcess::fetch(const DracoRequest& request, std::span<std::byte> result) {
    ROWLAND_CHECK(process_.has_value(), "something decoded");
    const Timed timed(*this);
    DracoReply reply;
    if (std::string why = ask(request, {}, reply); !why.empty()) return why;
    const Exchange exchange = process_->receive(result, deadline());
    return exchange == Exchange::Done ? std::string() : reason(exchange);
}

std::string DracoProcess::indices(std::span<std::uint32_t> result) {
    return fetch({.ask = DracoAsk::Indices}, std::as_writable_bytes(result));
}

std::string DracoProcess::values(const DracoAttribute& attribute, std::span<float> result) {
    return fetch({.ask = DracoAsk::Values,
                  .attribute = attribute.unique_id,
                  .components = attribute.components,
                  .element = DracoElement::Float},
                 std::as_writable_bytes(result));
}

std::string DracoProcess::values(const DracoAttribute& attribute, std::span<std::uint16_t> result) {
    return fetch({.ask = DracoAsk::Values,
                  .attribute = attribute.unique_id,
                  .components = attribute.components,
                  .element = DracoElement::UnsignedShort},
                 std::as_writable_bytes(result));
}

}  // namespace rowland::scene
