# rowland_embed_files(<target> <function> FILES <file>...)
# Builds text files into <target>, so that programs need no paths at run time, and defines
#   std::span<const rowland::EmbeddedFile> <function>();
# <function> is qualified ("rowland::render::shader_files"); whoever calls it declares it. A file's name is its path from
# the top of the source tree. <target> must link rowland_core.
set(ROWLAND_EMBED_SCRIPT ${CMAKE_CURRENT_LIST_DIR}/embed_files.cmake CACHE INTERNAL "")

function(rowland_embed_files target function)
  cmake_parse_arguments(ARG "" "" "FILES" ${ARGN})
  set(paths)
  foreach(file IN LISTS ARG_FILES)
    cmake_path(ABSOLUTE_PATH file BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} NORMALIZE OUTPUT_VARIABLE path)
    list(APPEND paths ${path})
  endforeach()
  string(REPLACE "::" "_" output_name ${function})
  set(output ${CMAKE_CURRENT_BINARY_DIR}/${output_name}.cpp)
  # The output depends on a file that lists the names, so that adding or removing one rebuilds it.
  set(list_file ${CMAKE_CURRENT_BINARY_DIR}/${output_name}.txt)
  file(CONFIGURE OUTPUT ${list_file} CONTENT "${paths}" @ONLY)
  add_custom_command(
    OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -D OUTPUT=${output} -D FUNCTION=${function} -D TOP=${CMAKE_SOURCE_DIR} -D LIST=${list_file}
            -P ${ROWLAND_EMBED_SCRIPT}
    DEPENDS ${paths} ${list_file} ${ROWLAND_EMBED_SCRIPT}
    COMMENT "Embedding the files of ${function}"
    VERBATIM)
  target_sources(${target} PRIVATE ${output})
endfunction()
