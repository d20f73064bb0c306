# The headers that most files include, compiled once for libraries, for those of the tests and for programs of GoogleTest: half of a compiler's
# work on most files. For builds that are tested; the others show whether each file includes what it needs.
set(headers <algorithm> <array> <bit> <cassert> <cmath> <cstdint> <cstdio> <cstdlib> <cstring> <filesystem> <fstream> <functional>
            <iostream> <limits> <map> <memory> <numbers> <numeric> <optional> <random> <span> <sstream> <string> <string_view> <utility>
            <vector> <glm/glm.hpp>)
find_package(glm REQUIRED)
find_package(GTest REQUIRED)
file(WRITE ${PROJECT_BINARY_DIR}/precompiled.cpp "")

# add_precompiled(NAME FOLDER): as the libraries of a folder are compiled.
function(add_precompiled name folder)
  get_property(options DIRECTORY ${folder} PROPERTY COMPILE_OPTIONS)
  add_library(${name} OBJECT ${PROJECT_BINARY_DIR}/precompiled.cpp)
  set_target_properties(${name} PROPERTIES COMPILE_OPTIONS "${options}")
  target_link_libraries(${name} PRIVATE glm::glm)
  target_precompile_headers(${name} PRIVATE ${headers})
endfunction()
add_precompiled(precompiled ${PROJECT_SOURCE_DIR})
add_precompiled(precompiled_test_libraries ${PROJECT_SOURCE_DIR}/tests)
add_precompiled(precompiled_tests ${PROJECT_SOURCE_DIR}/tests)
target_link_libraries(precompiled_tests PRIVATE GTest::gtest)
target_precompile_headers(precompiled_tests PRIVATE <gtest/gtest.h>)
# As programs are compiled.
set_target_properties(precompiled_tests PROPERTIES POSITION_INDEPENDENT_CODE OFF)
target_compile_options(precompiled_tests PRIVATE -fPIE)

# Those of a target's files that have options of their own include their headers themselves.
function(skip_options_of_files target)
  get_target_property(sources ${target} SOURCES)
  get_target_property(folder ${target} SOURCE_DIR)
  foreach(source ${sources})
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${folder})
    get_source_file_property(options ${source} TARGET_DIRECTORY ${target} COMPILE_OPTIONS)
    if(options)
      set_source_files_properties(${source} TARGET_DIRECTORY ${target} PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
    endif()
  endforeach()
endfunction()

# All targets of a folder and those below that are compiled as the folder's, not with options of their own.
function(use_precompiled folder of_libraries)
  get_property(options DIRECTORY ${folder} PROPERTY COMPILE_OPTIONS)
  get_property(targets DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target ${targets})
    get_target_property(type ${target} TYPE)
    get_target_property(own ${target} COMPILE_OPTIONS)
    get_target_property(links ${target} LINK_LIBRARIES)
    list(FILTER own EXCLUDE REGEX "CONFIG:Release")  # such builds have no sanitizers and precompile nothing
    if(target MATCHES "^precompiled|^splatray_shaders$" OR NOT own STREQUAL options)  # shaders: arrays, which include little
      continue()
    elseif(type MATCHES "(STATIC|SHARED|MODULE|OBJECT)_LIBRARY")
      skip_options_of_files(${target})
      target_precompile_headers(${target} REUSE_FROM ${of_libraries})
    elseif(type STREQUAL EXECUTABLE AND links MATCHES "GTest::gtest")
      skip_options_of_files(${target})
      target_precompile_headers(${target} REUSE_FROM precompiled_tests)
    endif()
  endforeach()
  get_property(subfolders DIRECTORY ${folder} PROPERTY SUBDIRECTORIES)
  foreach(subfolder ${subfolders})
    cmake_path(GET subfolder FILENAME name)
    if(name STREQUAL tests)
      use_precompiled(${subfolder} precompiled_test_libraries)
    else()
      use_precompiled(${subfolder} ${of_libraries})
    endif()
  endforeach()
endfunction()

use_precompiled(${PROJECT_SOURCE_DIR} precompiled)
# With the tests' options, where these are their own.
get_target_property(of_gpu splatray_gpu COMPILE_OPTIONS)
get_property(of_tests DIRECTORY ${PROJECT_SOURCE_DIR}/tests PROPERTY COMPILE_OPTIONS)
if(of_gpu STREQUAL of_tests)
  skip_options_of_files(splatray_gpu)
  target_precompile_headers(splatray_gpu REUSE_FROM precompiled_test_libraries)
endif()
# With options of its own, but many files.
skip_options_of_files(splatray_preprocess)
target_precompile_headers(splatray_preprocess PRIVATE ${headers} <tbb/parallel_for.h> <tbb/parallel_reduce.h> <tbb/parallel_sort.h>)
