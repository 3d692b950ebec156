# Writes the commit of the sources into a header, where it differs from what stands there.
# Run as: cmake -DSOURCE_DIR=... -DHEADER=... -P commit.cmake
cmake_minimum_required(VERSION 3.22)
set(commit unknown)
find_program(git git)
if(git)
  execute_process(COMMAND ${git} -C ${SOURCE_DIR} describe --always --dirty --exclude=* --abbrev=7
      RESULT_VARIABLE code OUTPUT_VARIABLE text ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(code EQUAL 0)
    set(commit ${text})
  endif()
endif()
file(CONFIGURE OUTPUT ${HEADER} CONTENT "#define SHOAL_COMMIT \"@commit@\"\n" @ONLY)
