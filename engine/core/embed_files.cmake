# cmake -D OUTPUT=<cpp> -D FUNCTION=<qualified name> -D TOP=<folder> -D LIST=<file with a list of paths> -P embed_files.cmake
# Writes a C++ file that holds the files as raw string literals. See EmbedFiles.cmake.
file(READ ${LIST} paths)
list(LENGTH paths count)
string(REGEX REPLACE "::[^:]*$" "" namespace "${FUNCTION}")
string(REGEX REPLACE "^.*::" "" name "${FUNCTION}")

set(text "// Generated from the files it holds.\n#include <array>\n#include <span>\n\n")
string(APPEND text "#include \"engine/core/text.h\"\n\n")
string(APPEND text "namespace ${namespace} {\n\n")
string(APPEND text "std::span<const ::rowland::EmbeddedFile> ${name}() {\n")
string(APPEND text "    static constexpr std::array<::rowland::EmbeddedFile, ${count}> files{{\n")
foreach(path IN LISTS paths)
  file(READ "${path}" content)
  cmake_path(RELATIVE_PATH path BASE_DIRECTORY "${TOP}" OUTPUT_VARIABLE relative)
  string(APPEND text "        {\"${relative}\", R\"embedded(${content})embedded\"},\n")
endforeach()
string(APPEND text "    }};\n    return files;\n}\n\n}  // namespace ${namespace}\n")
file(WRITE ${OUTPUT} "${text}")
