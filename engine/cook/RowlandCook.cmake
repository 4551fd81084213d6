# rowland_cook_assets(<target> ASSETS <source> <output> [<source> <output>]...)
#
# Cooks each source, a path relative to the current source folder, to ${ROWLAND_COOKED_DIR}/<output> whenever the
# source, a file it names or the cooker has changed, and nothing else. <target>, part of `all`, builds them.
# Cooks only the listed assets, so list what a scene uses. The output is named, not derived, because what a source
# becomes is the cooker's knowledge.
#
#   rowland_cook_assets(cooked_disc ASSETS materials/cd.json cd.material  meshes/disc.json disc.glb)
#
# CMake (3.25) loses the characters # and $ when it passes dependency files on, so a source that names a file with one of
# them is cooked at every build.
#
# rowland_attach(<target> SCENE <source> OUTPUT <output> GRATINGS <material> <grating> [<material> <grating>]...)
#
# Writes a scene, a .glb or a .gltf that names no files, to ${ROWLAND_COOKED_DIR}/<output>, with gratings on materials that
# it names: whenever the scene is exported again, a grating or a file that this names has changed, or the cooker.
#
#   rowland_attach(truck SCENE truck.glb OUTPUT truck.glb GRATINGS Chrome materials/dvd.json  Badge materials/foil.json)
#
# The cooker is the target `rowland-cook`. An asset may be listed once in the whole build; who shares it depends on the
# target that lists it. A build for another system, whose cooker does not run here, uses the assets that another build has
# cooked: ROWLAND_COOKED_FROM is the folder.
set(ROWLAND_COOKED_FROM "" CACHE PATH "Cooked assets of another build, to use instead of cooking")
if(ROWLAND_COOKED_FROM)
  file(CREATE_LINK "${ROWLAND_COOKED_FROM}" "${ROWLAND_COOKED_DIR}" SYMBOLIC)
endif()

function(rowland_cook_assets target)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "" "" "ASSETS")
  if(ARG_UNPARSED_ARGUMENTS OR NOT ARG_ASSETS)
    message(FATAL_ERROR "rowland_cook_assets(${target} ...): expected ASSETS <source> <output>...")
  endif()
  if(ROWLAND_COOKED_FROM)
    add_custom_target(${target})
    return()
  endif()
  set(outputs)
  while(ARG_ASSETS)
    list(LENGTH ARG_ASSETS left)
    if(left EQUAL 1)
      message(FATAL_ERROR "rowland_cook_assets(${target} ...): \"${ARG_ASSETS}\" has no output; expected pairs")
    endif()
    list(POP_FRONT ARG_ASSETS source output)
    _rowland_cook_asset(${target} "${source}" "${output}")
    list(APPEND outputs "${ROWLAND_COOKED_DIR}/${output}")
  endwhile()
  add_custom_target(${target} ALL DEPENDS ${outputs})
endfunction()

# Refuses a second owner of an output.
function(_rowland_own_output function target output)
  get_property(owner GLOBAL PROPERTY "ROWLAND_COOKED_BY_${output}")
  if(owner)
    message(FATAL_ERROR "${function}(${target} ...): ${output} is cooked by ${owner}; depend on that instead")
  endif()
  set_property(GLOBAL PROPERTY "ROWLAND_COOKED_BY_${output}" ${target})
endfunction()

function(_rowland_cook_asset target source output)
  _rowland_own_output(rowland_cook_assets ${target} "${output}")
  cmake_path(ABSOLUTE_PATH source OUTPUT_VARIABLE source_path)
  set(output_path "${ROWLAND_COOKED_DIR}/${output}")
  # Beside the build's own files, not beside the assets: those are shipped.
  set(depfile "${CMAKE_CURRENT_BINARY_DIR}/cook/${output}.d")
  add_custom_command(
    OUTPUT "${output_path}"
    COMMAND rowland-cook cook "${source_path}" -o "${output_path}" --depfile "${depfile}"
    DEPENDS rowland-cook "${source_path}"
    DEPFILE "${depfile}"
    COMMENT "Cooking ${output}"
    VERBATIM)
endfunction()

function(rowland_attach target)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "" "SCENE;OUTPUT" "GRATINGS")
  list(LENGTH ARG_GRATINGS count)
  math(EXPR odd "${count} % 2")
  if(ARG_UNPARSED_ARGUMENTS OR NOT ARG_SCENE OR NOT ARG_OUTPUT OR count EQUAL 0 OR odd)
    message(FATAL_ERROR
      "rowland_attach(${target} ...): expected SCENE <source> OUTPUT <output> GRATINGS <material> <grating>...")
  endif()
  if(ROWLAND_COOKED_FROM)
    add_custom_target(${target})
    return()
  endif()
  _rowland_own_output(rowland_attach ${target} "${ARG_OUTPUT}")
  cmake_path(ABSOLUTE_PATH ARG_SCENE OUTPUT_VARIABLE scene)
  set(output "${ROWLAND_COOKED_DIR}/${ARG_OUTPUT}")
  set(depfile "${CMAKE_CURRENT_BINARY_DIR}/cook/${ARG_OUTPUT}.d")
  set(materials)
  set(gratings)
  while(ARG_GRATINGS)
    list(POP_FRONT ARG_GRATINGS material grating)
    cmake_path(ABSOLUTE_PATH grating)
    list(APPEND materials --material "${material}" "${grating}")
    list(APPEND gratings "${grating}")
  endwhile()
  add_custom_command(
    OUTPUT "${output}"
    COMMAND rowland-cook attach "${scene}" ${materials} -o "${output}" --depfile "${depfile}"
    DEPENDS rowland-cook "${scene}" ${gratings}
    DEPFILE "${depfile}"
    COMMENT "Attaching gratings to ${ARG_OUTPUT}"
    VERBATIM)
  add_custom_target(${target} ALL DEPENDS "${output}")
endfunction()
