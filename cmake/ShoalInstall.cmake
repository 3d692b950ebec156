# The command, the rooms as libraries with a CMake package (find_package(Shoal)), and the data.
include(CMakePackageConfigHelpers)

set(targets "")
foreach(room ${SHOAL_ROOMS})
  list(APPEND targets shoal_${room})
  install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/src/${room}/ DESTINATION include/shoal/${room}
      FILES_MATCHING PATTERN "*.h")
endforeach()
install(FILES ${CMAKE_CURRENT_SOURCE_DIR}/src/shoal.h DESTINATION include/shoal)
install(TARGETS ${targets} EXPORT ShoalTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
# The forwarding symbols must be in whoever links gpu, not left behind in an archive (src/gpu/forward.cpp).
install(FILES $<TARGET_OBJECTS:shoal_gpu_forward> DESTINATION ${CMAKE_INSTALL_LIBDIR}/shoal)
install(EXPORT ShoalTargets NAMESPACE Shoal:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Shoal)

install(TARGETS shoal_app RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
# The manual page and the completion of bash, from the declarations of the command's options.
set(documents ${CMAKE_CURRENT_BINARY_DIR}/documents)
file(MAKE_DIRECTORY ${documents})
add_custom_command(OUTPUT ${documents}/shoal.1 ${documents}/shoal
    COMMAND shoal_app --man-page > ${documents}/shoal.1
    COMMAND shoal_app --bash-completion > ${documents}/shoal DEPENDS shoal_app VERBATIM)
add_custom_target(documents ALL DEPENDS ${documents}/shoal.1 ${documents}/shoal)
install(FILES ${documents}/shoal.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${documents}/shoal DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(DIRECTORY shaders molecules models DESTINATION ${CMAKE_INSTALL_DATADIR}/shoal
    PATTERN "*.py" EXCLUDE PATTERN "__pycache__" EXCLUDE)

file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/ShoalConfig.cmake.in [[
@PACKAGE_INIT@
# Where the shaders are: what Simulation and Renderer take as their shader root.
# Before the dependencies, some of which change the prefix that this hangs on.
set_and_check(SHOAL_SHADERS "@PACKAGE_SHOAL_SHADERS@")
include(CMakeFindDependencyMacro)
find_dependency(PNG)
find_dependency(ZLIB)
find_dependency(pugixml)
find_dependency(GLEW)
find_dependency(glfw3)
find_dependency(assimp)
find_dependency(embree)
find_dependency(meshoptimizer)
find_dependency(Threads)
find_dependency(PkgConfig)
pkg_check_modules(STB REQUIRED IMPORTED_TARGET stb)
pkg_check_modules(OPENEXR REQUIRED IMPORTED_TARGET OpenEXR)
find_package(glm QUIET)
if(NOT TARGET glm::glm)
  add_library(glm::glm INTERFACE IMPORTED)
endif()
include("${CMAKE_CURRENT_LIST_DIR}/ShoalTargets.cmake")
]])
set(SHOAL_SHADERS ${CMAKE_INSTALL_DATADIR}/shoal/shaders)
configure_package_config_file(${CMAKE_CURRENT_BINARY_DIR}/ShoalConfig.cmake.in
    ${CMAKE_CURRENT_BINARY_DIR}/ShoalConfig.cmake
    INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Shoal PATH_VARS SHOAL_SHADERS)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/ShoalConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/ShoalConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/ShoalConfigVersion.cmake
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Shoal)
