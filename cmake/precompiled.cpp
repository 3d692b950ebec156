// The one source with the precompiled header of a target that makes it for others
// (cmake/ShoalRooms.cmake, tests/CMakeLists.txt).
