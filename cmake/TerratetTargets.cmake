# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# What every target of the project shares.
include(GNUInstallDirs)

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release)
endif()

find_program(TERRATET_CCACHE ccache)
if(TERRATET_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${TERRATET_CCACHE})
endif()

function(terratet_configure target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
  # Fused multiply-adds would make results depend on the compiler's mood; determinism is promised.
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -ffp-contract=off)
  # GCC 12 takes some string concatenations at -O3 for overlapping copies (its bug 105651).
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(${target} PRIVATE -Wno-restrict)
  endif()
  # CGAL's own checks cost a factor of ten; ours follow NDEBUG as usual.
  target_compile_definitions(${target} PRIVATE CGAL_NDEBUG)
  if(TERRATET_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(TERRATET_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=${TERRATET_SANITIZE} -fno-omit-frame-pointer)
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")  # instrumented code hides initialisations from GCC 12
      target_compile_options(${target} PRIVATE -Wno-maybe-uninitialized)
    endif()
    target_link_options(${target} PUBLIC -fsanitize=${TERRATET_SANITIZE})
    get_target_property(type ${target} TYPE)
    if(type STREQUAL "EXECUTABLE" AND TERRATET_SANITIZE MATCHES "address")
      target_sources(${target} PRIVATE ${PROJECT_SOURCE_DIR}/cmake/leak_suppressions.cpp)
    endif()
  endif()
endfunction()

# terratet_add_floor(NAME SOURCES … HEADERS … PUBLIC … PRIVATE …): one of the four static libraries.
function(terratet_add_floor name)
  cmake_parse_arguments(ARG "" "" "SOURCES;HEADERS;PUBLIC;PRIVATE" ${ARGN})
  set(target terratet_${name})
  add_library(${target} STATIC ${ARG_SOURCES})
  add_library(terratet::${name} ALIAS ${target})
  terratet_configure(${target})
  target_sources(${target} PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${ARG_HEADERS})
  target_link_libraries(${target} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} VERIFY_INTERFACE_HEADER_SETS ON)
  install(TARGETS ${target} EXPORT terratet ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library
          FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/terratet COMPONENT library)
endfunction()
