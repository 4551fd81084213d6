#include "engine/scene/draco_process.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "engine/core/check.h"

namespace rowland::scene {

namespace {

using Exchange = ChildProcess::Exchange;
using std::chrono::steady_clock;

// Measured on streams of 2 million triangles with 48 bytes per vertex, per triangle: 1 to 4 bytes of stream, 0.5 µs and
// 175 bytes of memory. The limits leave room for better compression and for a machine that is ten times slower.
constexpr std::chrono::microseconds kTimePerByte{3};
constexpr std::uint64_t kMemoryPerByte = 192;

}  // namespace

/// Counts the time of an exchange.
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
    ROWLAND_CHECK(process_.has_value(), "something decoded");
    const Timed timed(*this);
    ask(request, {});
    require_done(process_->receive(result, deadline()));
}

}  // namespace rowland::scene
