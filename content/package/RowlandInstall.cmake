# What `cmake --install` gives to other projects, which take it by find_package(Rowland): libraries with their headers,
# shaders, and the programs that cook and check. Included by the root after all targets.
#
# Components: `library`, all that needs no GPU; `runtime`, the engine and the modules' drawing, on top of it; `tools`.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(headers_folder ${CMAKE_INSTALL_INCLUDEDIR}/rowland)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/Rowland)
set(shaders_folder ${CMAKE_INSTALL_DATADIR}/rowland/shaders)
set(helpers_folder ${CMAKE_INSTALL_LIBEXECDIR}/rowland)

# rowland_export(<component> [<target> <name>]...)
# Installs the targets and the headers of their folders; outside they are called Rowland::<name>. Headers keep their
# paths, so that #include <engine/math/spherical_harmonics.h> is the same inside and outside.
function(rowland_export component)
  set(pairs ${ARGN})
  while(pairs)
    list(POP_FRONT pairs target name)
    set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
    target_include_directories(${target} INTERFACE $<INSTALL_INTERFACE:${headers_folder}>)
    install(TARGETS ${target} EXPORT ${component} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${component})
    get_target_property(folder ${target} SOURCE_DIR)
    rowland_install_headers(${component} ${folder})
  endwhile()
  install(EXPORT ${component} FILE Rowland-${component}.cmake NAMESPACE Rowland:: DESTINATION ${package_folder}
          COMPONENT ${component})
endfunction()

# The headers of folders without their subfolders. How assets are cooked needs the cooker, which is of the runtime.
function(rowland_install_headers component)
  foreach(folder IN LISTS ARGN)
    cmake_path(RELATIVE_PATH folder BASE_DIRECTORY ${PROJECT_SOURCE_DIR})
    file(GLOB headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*.h)
    if(component STREQUAL "library")
      list(FILTER headers EXCLUDE REGEX "/cook\\.h$")
    endif()
    install(FILES ${headers} DESTINATION ${headers_folder}/${folder} COMPONENT ${component})
  endforeach()
endfunction()

rowland_export(library
  rowland_core Core
  rowland_math SphericalHarmonics
  rowland_colour Colour
  rowland_image Image
  rowland_lighting Lighting
  rowland_asset Asset
  rowland_diffraction_model DiffractionModel
  rowland_diffraction_rigorous DiffractionRigorous
  rowland_diffraction_bake DiffractionBake
  rowland_diffraction_representations DiffractionRepresentations
  rowland_diffraction_asset DiffractionAsset
  rowland_thin_film_model ThinFilmModel
  rowland_thin_film_bake ThinFilmBake)
file(GLOB representations ${PROJECT_SOURCE_DIR}/modules/diffraction/representations/*)
list(FILTER representations EXCLUDE REGEX "\\.[a-z]+$")
rowland_install_headers(library ${representations})
install(DIRECTORY modules/diffraction/representations DESTINATION ${shaders_folder}/modules/diffraction
        COMPONENT library FILES_MATCHING PATTERN "*.glsl")
foreach(folder IN ITEMS engine/gpu engine/render modules/diffraction modules/thin_film)
  install(DIRECTORY ${folder}/shaders DESTINATION ${shaders_folder}/${folder} COMPONENT library
          FILES_MATCHING PATTERN "*.glsl" PATTERN "*_blocks.h")
endforeach()
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT library)

rowland_export(runtime
  rowland_ecs Ecs
  rowland_cook Cook
  rowland_scene Scene
  rowland_scene_cook SceneCook
  rowland_lighting_cook LightingCook
  rowland_module Module
  rowland_live Live
  rowland_platform Platform
  rowland_gpu Gpu
  rowland_post Post
  rowland_render Render
  rowland_view View
  rowland_diffraction_reference DiffractionReference
  rowland_diffraction_evaluate DiffractionEvaluate
  rowland_diffraction_foil DiffractionFoil
  rowland_diffraction_cook DiffractionCook
  rowland_diffraction Diffraction
  rowland_thin_film_asset ThinFilmAsset
  rowland_thin_film_cook ThinFilmCook
  rowland_thin_film ThinFilm)
rowland_install_headers(runtime
  ${PROJECT_SOURCE_DIR}/engine/render/shaders ${PROJECT_SOURCE_DIR}/modules/diffraction/shaders
  ${PROJECT_SOURCE_DIR}/modules/thin_film/shaders)
foreach(module IN ITEMS diffraction thin_film)
  install(FILES modules/${module}/cook.h modules/${module}/module.h DESTINATION ${headers_folder}/modules/${module} COMPONENT runtime)
endforeach()

install(TARGETS rowland-cook rowland-trade RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT tools)
install(TARGETS rowland-capture RUNTIME DESTINATION ${helpers_folder} COMPONENT tools)  # of rowland-cook
install(FILES ${ROWLAND_COMMIT_FILE} DESTINATION ${helpers_folder} COMPONENT tools)
# What Scene and the tools run beside them; engine/core/program.h says where it is looked for.
foreach(component IN ITEMS runtime tools)
  install(TARGETS rowland-decode-draco RUNTIME DESTINATION ${helpers_folder} COMPONENT ${component})
endforeach()

configure_package_config_file(content/package/RowlandConfig.cmake.in ${PROJECT_BINARY_DIR}/RowlandConfig.cmake
  INSTALL_DESTINATION ${package_folder} PATH_VARS shaders_folder helpers_folder)
# Before 1.0 a minor version may change any interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/RowlandConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/RowlandConfig.cmake ${PROJECT_BINARY_DIR}/RowlandConfigVersion.cmake
        DESTINATION ${package_folder} COMPONENT library)
