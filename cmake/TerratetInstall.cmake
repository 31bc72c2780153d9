# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# The CMake package: find_package(terratet) gives terratet::tess, terratet::interp, terratet::io.
include(CMakePackageConfigHelpers)

set(TERRATET_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/terratet)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/terratetConfig.cmake.in
                              ${PROJECT_BINARY_DIR}/terratetConfig.cmake
                              INSTALL_DESTINATION ${TERRATET_PACKAGE_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/terratetConfigVersion.cmake COMPATIBILITY SameMinorVersion)

install(EXPORT terratet NAMESPACE terratet:: FILE terratetTargets.cmake DESTINATION ${TERRATET_PACKAGE_DIR})
install(FILES ${PROJECT_BINARY_DIR}/terratetConfig.cmake ${PROJECT_BINARY_DIR}/terratetConfigVersion.cmake
              ${CMAKE_CURRENT_LIST_DIR}/TerratetDependencies.cmake
        DESTINATION ${TERRATET_PACKAGE_DIR})
install(FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/CHANGELOG.md
        DESTINATION ${CMAKE_INSTALL_DOCDIR})
