#include "engine/core/program.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>

#include "engine/core/error.h"
#include "engine/core/log.h"

namespace rowland {

int run_program(const std::function<int()>& body) {
    try {
        const int code = body();
        // A full disk or a closed pipe is noticed only when the buffer is written.
        if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
            fail_system("standard output", fmt::format("writing failed: {}", std::strerror(errno)));
        return code;
    } catch (const Error& error) {
        log_error("{}", error.what());
        return error.info().fault == Fault::Input ? 2 : 1;
    } catch (const std::bad_alloc&) {
        log_error("out of memory");
        return 1;
    } catch (const std::exception& error) {
        log_error("{}", error.what());
        return 1;
    }
}

}  // namespace rowland
