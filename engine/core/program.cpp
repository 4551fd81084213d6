#include "engine/core/program.h"

#include <exception>
#include <new>

#include "engine/core/error.h"
#include "engine/core/log.h"

namespace rowland {

int run_program(const std::function<int()>& body) {
    try {
        return body();
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
