# shoal_room(NAME [OF_COMMAND] [ROOMS ...] [LIBRARIES ...] [PRIVATE_LIBRARIES ...])
# Makes the library shoal_NAME (alias Shoal::NAME) of every *.cpp in src/NAME and the folders below it.
# OF_COMMAND: the room is a part of the command, and the package has it not.
# Files named forward*.cpp define symbols that other shared libraries look up (OpenGL forwarding): they
# become an object library, so that the linker cannot leave them out of whoever links the room.

add_library(shoal_options INTERFACE)
target_compile_options(shoal_options INTERFACE
    $<BUILD_INTERFACE:-Wall -Wextra -Wpedantic -Wconversion -Wno-sign-conversion
    -Wnon-virtual-dtor -Woverloaded-virtual
    # Clang warns as well of names that other sources of the same unity build use.
    $<$<CXX_COMPILER_ID:GNU>:-Wshadow>
    # GCC 12 warns of its own std::string (its bug 105651), with precompiled headers in these words as well,
    # and of types without a name elsewhere in sources that are compiled as one. GCC 13 and later take what a
    # function returns by reference for dangling wherever a text was made for its argument.
    $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict -Wno-array-bounds -Wno-stringop-overflow -Wno-subobject-linkage>
    $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_GREATER_EQUAL:$<CXX_COMPILER_VERSION>,13>>:-Wno-dangling-reference>>
    $<BUILD_INTERFACE:$<$<BOOL:${SHOAL_WERROR}>:-Werror>>)
if(NOT SHOAL_CONTRACTS)
  target_compile_definitions(shoal_options INTERFACE SHOAL_NO_CONTRACTS)
endif()
if(SHOAL_SANITIZE)
  target_compile_options(shoal_options INTERFACE -fsanitize=address,undefined
      -fno-sanitize-recover=undefined -fno-omit-frame-pointer -g)
  target_link_options(shoal_options INTERFACE -fsanitize=address,undefined)
  # GCC 12 takes what its own std::regex and std::function hold for uninitialised there.
  target_compile_options(shoal_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
endif()

# cmake/precompiled.h, parsed once for all of src. Sources with flags of their own leave it out.
add_library(shoal_precompiled OBJECT ${CMAKE_CURRENT_SOURCE_DIR}/cmake/precompiled.cpp)
target_compile_features(shoal_precompiled PRIVATE cxx_std_20)
target_link_libraries(shoal_precompiled PRIVATE shoal_options glm::glm)
target_precompile_headers(shoal_precompiled PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/cmake/precompiled.h)

set(SHOAL_ROOMS "" CACHE INTERNAL "")          # of the package
set(SHOAL_COMMAND_ROOMS "" CACHE INTERNAL "")

function(shoal_room name)
  cmake_parse_arguments(ROOM "OF_COMMAND" "" "ROOMS;LIBRARIES;PRIVATE_LIBRARIES" ${ARGN})
  set(directory ${CMAKE_CURRENT_SOURCE_DIR}/src/${name})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${directory}/*.cpp)
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS ${directory}/*.h)
  set(forwarders ${sources})
  list(FILTER forwarders INCLUDE REGEX "/forward[^/]*\\.cpp$")
  list(FILTER sources EXCLUDE REGEX "/forward[^/]*\\.cpp$")
  list(TRANSFORM ROOM_ROOMS PREPEND shoal_)

  if(sources)
    set(scope PUBLIC)
    add_library(shoal_${name} STATIC ${sources} ${headers})
    target_link_libraries(shoal_${name} PRIVATE $<BUILD_INTERFACE:shoal_options>)
    target_precompile_headers(shoal_${name} REUSE_FROM shoal_precompiled)
    # Header-only packages end at the build; what must be linked reaches whoever links the archive.
    foreach(library ${ROOM_PRIVATE_LIBRARIES})
      if(library MATCHES "^(RapidJSON|GLHeaders|Lib3MFHeaders|TinyObjHeader|Eigen3::Eigen)$")
        set(library $<BUILD_INTERFACE:${library}>)
      endif()
      target_link_libraries(shoal_${name} PRIVATE ${library})
    endforeach()
  else()
    set(scope INTERFACE)
    add_library(shoal_${name} INTERFACE)
  endif()
  target_compile_features(shoal_${name} ${scope} cxx_std_20)
  add_library(Shoal::${name} ALIAS shoal_${name})
  set_target_properties(shoal_${name} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(shoal_${name} ${scope}
      $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/src> $<INSTALL_INTERFACE:include/shoal> $<INSTALL_INTERFACE:include>)
  target_link_libraries(shoal_${name} ${scope} ${ROOM_ROOMS} ${ROOM_LIBRARIES})

  if(forwarders)
    add_library(shoal_${name}_forward OBJECT ${forwarders})
    set_target_properties(shoal_${name}_forward PROPERTIES UNITY_BUILD OFF)  # installed by its name
    target_include_directories(shoal_${name}_forward PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src)
    target_link_libraries(shoal_${name}_forward PRIVATE $<BUILD_INTERFACE:shoal_options>
        ${ROOM_LIBRARIES})
    target_sources(shoal_${name} INTERFACE
        $<BUILD_INTERFACE:$<TARGET_OBJECTS:shoal_${name}_forward>>
        $<INSTALL_INTERFACE:$<INSTALL_PREFIX>/${CMAKE_INSTALL_LIBDIR}/shoal/forward.cpp.o>)
  endif()
  set(list SHOAL_ROOMS)
  if(ROOM_OF_COMMAND)
    set(list SHOAL_COMMAND_ROOMS)
  endif()
  set(${list} ${${list}} ${name} CACHE INTERNAL "")
endfunction()
