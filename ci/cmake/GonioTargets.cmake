# How a target of gonio is built, named and installed.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
include(GonioSoci)

option(GONIO_BUILD_TESTS "Build tests and benchmarks" ${PROJECT_IS_TOP_LEVEL})
option(GONIO_WERROR "Treat warnings as errors" OFF)
option(GONIO_FUZZ "Build the fuzzers of tests/fuzz; needs clang" OFF)
set(GONIO_SANITIZE "" CACHE STRING "Sanitizers to build with, e.g. address,undefined or thread")

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()

if(GONIO_SANITIZE)
  # Not those checks of `undefined` that take a third of the time to build and whose errors end in
  # a report of `address` or in a signal anyway. (`vptr` would also look for type_info that SOCI
  # keeps for itself.)
  add_compile_options(-fsanitize=${GONIO_SANITIZE} -fno-sanitize-recover=all
                      -fno-sanitize=null,alignment,object-size,vptr -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${GONIO_SANITIZE})
endif()

# Warnings are private to gonio's own targets.
function(gonio_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion
                                           $<$<BOOL:${GONIO_WERROR}>:-Werror>)
endfunction()

# For sources that compute little: sanitizers take longer to optimise them than that saves.
function(gonio_plain_when_sanitized target)
  if(GONIO_SANITIZE)
    target_compile_options(${target} PRIVATE -O0)
  endif()
endfunction()

# gonio_module(<name> [DEPENDS <target>...] [PRIVATE <target>...])
# The library gonio::<name> from all sources of the current folder.
function(gonio_module name)
  cmake_parse_arguments(arg "" "" "DEPENDS;PRIVATE" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  file(GLOB headers CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.hpp)
  add_library(gonio_${name} ${sources})
  add_library(gonio::${name} ALIAS gonio_${name})
  gonio_warnings(gonio_${name})
  target_compile_features(gonio_${name} PUBLIC cxx_std_20)
  target_link_libraries(gonio_${name} PUBLIC ${arg_DEPENDS} PRIVATE ${arg_PRIVATE})
  target_include_directories(gonio_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                                  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/gonio>)
  set_target_properties(gonio_${name} PROPERTIES EXPORT_NAME ${name})
  install(TARGETS gonio_${name} EXPORT gonio)
  file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  install(FILES ${headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/gonio/${folder})
endfunction()

# Standalone Asio is headers without a package of their own: the target asio.
function(gonio_find_asio)
  find_path(ASIO_INCLUDE_DIR asio.hpp REQUIRED)
  find_package(Threads REQUIRED)
  add_library(asio INTERFACE IMPORTED GLOBAL)
  target_include_directories(asio SYSTEM INTERFACE ${ASIO_INCLUDE_DIR})
  # Else its memory functions would depend on what a source has included before.
  target_compile_definitions(asio INTERFACE ASIO_STANDALONE ASIO_NO_DEPRECATED
                                            ASIO_DISABLE_STD_ALIGNED_ALLOC)
  target_link_libraries(asio INTERFACE Threads::Threads)
endfunction()

# Mustache is one header without a package for CMake: the target mustache.
function(gonio_find_mustache)
  find_path(MUSTACHE_INCLUDE_DIR kainjow/mustache.hpp REQUIRED)
  add_library(mustache INTERFACE IMPORTED GLOBAL)
  target_include_directories(mustache SYSTEM INTERFACE ${MUSTACHE_INCLUDE_DIR})
endfunction()

# Random123 is headers without a package for CMake: the target random123.
function(gonio_find_random123)
  find_path(RANDOM123_INCLUDE_DIR Random123/philox.h REQUIRED)
  add_library(random123 INTERFACE IMPORTED GLOBAL)
  target_include_directories(random123 SYSTEM INTERFACE ${RANDOM123_INCLUDE_DIR})
endfunction()

# Data, and the package that find_package(gonio) reads.
function(gonio_install)
  install(DIRECTORY standards fixtures DESTINATION ${CMAKE_INSTALL_DATADIR}/gonio)
  set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/gonio)
  install(EXPORT gonio NAMESPACE gonio:: DESTINATION ${package_dir} FILE gonio-targets.cmake)
  configure_package_config_file(ci/cmake/gonio-config.cmake.in gonio-config.cmake
                                INSTALL_DESTINATION ${package_dir})
  write_basic_package_version_file(gonio-config-version.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/gonio-config.cmake
                ${CMAKE_CURRENT_BINARY_DIR}/gonio-config-version.cmake
                ci/cmake/GonioSoci.cmake DESTINATION ${package_dir})
endfunction()
