# Writes ${OUTPUT}, which defines the versions of journal.h. REFERENCE and METHODS: files that hold a path a line;
# RELEASE: the version number.
function(hash_of list result)
  file(STRINGS ${list} paths)
  set(hashes "")
  foreach(path IN LISTS paths)
    file(SHA256 ${path} hash)
    string(APPEND hashes ${hash})
  endforeach()
  string(SHA256 all "${hashes}")
  string(SUBSTRING ${all} 0 32 short)
  set(${result} ${short} PARENT_SCOPE)
endfunction()

hash_of(${REFERENCE} reference)
hash_of(${METHODS} methods)
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT [[
#include "editor/trade/journal.h"

namespace rowland::trade {

std::string reference_version() {
    return "@reference@";
}
std::string method_version() {
    return "@methods@";
}
std::string release_version() {
    return "@RELEASE@";
}

}  // namespace rowland::trade
]] @ONLY)
