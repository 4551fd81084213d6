# rowland_embed_shaders(<target> <function> FILES <file>...)
# Puts text files into <target> at build time, so that programs need no paths at run time, and defines
#   std::span<const rowland::gpu::EmbeddedFile> <function>();
# with <function> qualified ("rowland::render::shader_files"); the part that calls it declares it in a header of its own.
# A file's name is its path from the top of the source tree. Serves shaders and any other small text file. <target> must
# link rowland_gpu.
set(ROWLAND_EMBED_SCRIPT ${CMAKE_CURRENT_LIST_DIR}/embed_files.cmake CACHE INTERNAL "")

function(rowland_embed_shaders target function)
  cmake_parse_arguments(ARG "" "" "FILES" ${ARGN})
  set(paths)
  foreach(file IN LISTS ARG_FILES)
    cmake_path(ABSOLUTE_PATH file BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} NORMALIZE OUTPUT_VARIABLE path)
    list(APPEND paths ${path})
  endforeach()
  string(REPLACE "::" "_" output_name ${function})
  set(output ${CMAKE_CURRENT_BINARY_DIR}/${output_name}.cpp)
  # The list of files is written out, so that adding or removing one rebuilds the output as changing one does.
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
