# Whether the Python module can be built: the first python3 that has its headers, pybind11 (whose headers alone are
# needed) and NumPy. Sets SHOAL_PYTHON3_MODULE (its interpreter; empty: none, as with sanitizers, which must be loaded first), SHOAL_PYTHON3_INCLUDE and
# SHOAL_PYTHON3_SUFFIX (of module files).
set(SHOAL_PYTHON3_MODULE "")
find_path(PYBIND11_INCLUDE pybind11/pybind11.h)
if(SHOAL_PYTHON AND PYBIND11_INCLUDE AND NOT SHOAL_SANITIZE)
  foreach(candidate python3 /usr/bin/python3)
    execute_process(COMMAND ${candidate} -c "import numpy, sysconfig as s; print(s.get_path('include') + ';' + s.get_config_var('EXT_SUFFIX') + ';' + s.get_python_version())"
        OUTPUT_VARIABLE found ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE failed)
    if(NOT failed)
      list(GET found 0 SHOAL_PYTHON3_INCLUDE)
      if(EXISTS ${SHOAL_PYTHON3_INCLUDE}/Python.h)
        list(GET found 1 SHOAL_PYTHON3_SUFFIX)
        list(GET found 2 SHOAL_PYTHON3_VERSION)
        set(SHOAL_PYTHON3_MODULE ${candidate})
        break()
      endif()
    endif()
  endforeach()
endif()
if(SHOAL_PYTHON AND NOT SHOAL_PYTHON3_MODULE AND NOT SHOAL_SANITIZE)
  message(STATUS "python3-dev, pybind11-dev or python3-numpy is not installed: no Python module")
endif()
if(SHOAL_PYTHON3_MODULE)
  message(STATUS "Python module: for ${SHOAL_PYTHON3_MODULE}, ${SHOAL_PYTHON3_VERSION}")
  # The module is a shared library. The same for programs, whose precompiled headers are those of the rooms. Nothing of
  # ours is replaced from outside, so nothing is called through tables.
  add_compile_options(-fPIC -fno-semantic-interposition)
endif()
