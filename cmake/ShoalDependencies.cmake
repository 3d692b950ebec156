# Everything Shoal builds on comes from the system's packages; `./dev` installs them.
find_package(PkgConfig REQUIRED)
find_package(PNG REQUIRED)
find_package(ZLIB REQUIRED)
find_package(pugixml REQUIRED)
find_package(GLEW REQUIRED)
find_package(glfw3 3.3 REQUIRED)
find_package(assimp REQUIRED)
# lib3mf 1 has no CMake package; 2 has another interface.
find_path(LIB3MF_INCLUDE Model/COM/NMR_DLLInterfaces.h PATH_SUFFIXES lib3mf REQUIRED)
find_library(LIB3MF_LIBRARY 3MF REQUIRED)
add_library(Lib3MFHeaders INTERFACE IMPORTED)
target_include_directories(Lib3MFHeaders SYSTEM INTERFACE ${LIB3MF_INCLUDE})
find_package(Eigen3 REQUIRED NO_MODULE)

# Closest points on models. The headers of 4 go before those of 3 (geometry/closest_point.cpp).
find_package(embree 4 QUIET)
if(NOT embree_FOUND)
  find_package(embree 3 REQUIRED)
endif()
find_package(Threads REQUIRED)
find_package(meshoptimizer REQUIRED)  # simplifies meshes to molecules

pkg_check_modules(OPENEXR REQUIRED IMPORTED_TARGET OpenEXR)  # animation textures of floats
set_property(TARGET PkgConfig::OPENEXR PROPERTY INTERFACE_COMPILE_OPTIONS "")  # -pthread, which says nothing here

find_package(glm QUIET)
if(NOT TARGET glm::glm)
  add_library(glm::glm INTERFACE IMPORTED)
endif()

# Header-only packages without a usable CMake package on every system that we support.
find_path(RAPIDJSON_INCLUDE rapidjson/reader.h REQUIRED)
add_library(RapidJSON INTERFACE IMPORTED)
target_include_directories(RapidJSON SYSTEM INTERFACE ${RAPIDJSON_INCLUDE})

find_path(TINY_OBJ_INCLUDE tiny_obj_loader.h REQUIRED)  # its library may be built for floats only
add_library(TinyObjHeader INTERFACE IMPORTED)
target_include_directories(TinyObjHeader SYSTEM INTERFACE ${TINY_OBJ_INCLUDE})

# Headers of EGL and OSMesa only: the libraries are opened at run time.
find_path(EGL_INCLUDE EGL/egl.h REQUIRED)
add_library(GLHeaders INTERFACE IMPORTED)
target_include_directories(GLHeaders SYSTEM INTERFACE ${EGL_INCLUDE})

find_path(CLI11_INCLUDE CLI/CLI.hpp REQUIRED)
add_library(CLI11Headers INTERFACE IMPORTED)
target_include_directories(CLI11Headers SYSTEM INTERFACE ${CLI11_INCLUDE})

# Dear ImGui with its GLFW and OpenGL 3 backends.
pkg_check_modules(IMGUI REQUIRED IMPORTED_TARGET imgui)
find_package(Fontconfig REQUIRED)  # names the font of its letters

# Decodes the images of others' models.
pkg_check_modules(STB REQUIRED IMPORTED_TARGET stb)
