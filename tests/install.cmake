# Installs into a scratch prefix, builds docs/library against the package there and runs it; also runs the
# installed command from another folder.
# Run as: cmake -DBUILD_DIR=... -DSOURCE_DIR=... -DSCRATCH=... -P install.cmake
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output
      WORKING_DIRECTORY ${SCRATCH})
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${ARGN} failed:\n${output}")
  endif()
  message("${output}")
endfunction()

file(REMOVE_RECURSE ${SCRATCH})
file(MAKE_DIRECTORY ${SCRATCH})
run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${SCRATCH}/prefix)
run(${CMAKE_COMMAND} -G Ninja -S ${SOURCE_DIR}/docs/library -B ${SCRATCH}/example
    -DCMAKE_PREFIX_PATH=${SCRATCH}/prefix -DCMAKE_BUILD_TYPE=Release)
run(${CMAKE_COMMAND} --build ${SCRATCH}/example)
foreach(example step draw share)
  run(${SCRATCH}/example/${example})
endforeach()
run(${SCRATCH}/prefix/bin/shoal explain hello)
file(GLOB module ${SCRATCH}/prefix/lib/python*/site-packages/shoal*.so)
if(module)
  get_filename_component(folder ${module} DIRECTORY)
  run(${CMAKE_COMMAND} -E env PYTHONPATH=${folder} ${PYTHON} -c
      "import shoal; s = shoal.Simulation(shoal.Scene('hello')); s.step(3); print(s.positions().shape)")
endif()
foreach(document man/man1/shoal.1 bash-completion/completions/shoal)
  file(STRINGS ${SCRATCH}/prefix/share/${document} found REGEX "from.*-mesh")
  if(NOT found)
    message(FATAL_ERROR "share/${document} is not installed, or empty")
  endif()
endforeach()
run(${SCRATCH}/prefix/bin/shoal explain prefix/share/shoal/models/hello/hello.scene.json)
file(REMOVE_RECURSE ${SCRATCH})
