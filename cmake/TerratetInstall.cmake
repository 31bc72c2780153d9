# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# What is installed, in two components: the program, and what a CMake project needs, whose find_package(terratet) gives
# terratet::tess, terratet::interp, terratet::io. `cpack -G DEB` makes a Debian package of each.
include(CMakePackageConfigHelpers)

set(TERRATET_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/terratet)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/terratetConfig.cmake.in
                              ${PROJECT_BINARY_DIR}/terratetConfig.cmake
                              INSTALL_DESTINATION ${TERRATET_PACKAGE_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/terratetConfigVersion.cmake COMPATIBILITY SameMinorVersion)

install(EXPORT terratet NAMESPACE terratet:: FILE terratetTargets.cmake DESTINATION ${TERRATET_PACKAGE_DIR}
        COMPONENT library)
install(FILES ${PROJECT_BINARY_DIR}/terratetConfig.cmake ${PROJECT_BINARY_DIR}/terratetConfigVersion.cmake
              ${CMAKE_CURRENT_LIST_DIR}/TerratetDependencies.cmake
        DESTINATION ${TERRATET_PACKAGE_DIR} COMPONENT library)
install(FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/CHANGELOG.md
        DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)

set(CPACK_PACKAGE_NAME terratet)
set(CPACK_PACKAGE_CONTACT "The Terratet authors <terratet@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "boreholes and faults to adaptive 3D tessellations")
set(CPACK_COMPONENTS_ALL program library)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME terratet)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS proj-data)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libterratet-dev)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
# What terratetConfig.cmake looks for: static libraries hand their private dependencies on.
string(JOIN ", " CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS
       libgdal-dev libproj-dev libsqlite3-dev libcgal-dev libopenvdb-dev libboost-iostreams-dev libtbb-dev libmeshoptimizer-dev libcairo2-dev zlib1g-dev
       libssl-dev libnetcdf-dev libdeflate-dev nlohmann-json3-dev libspdlog-dev libfmt-dev libeigen3-dev pkg-config)
if(TERRATET_MPI)
  string(APPEND CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS ", libopenmpi-dev")
endif()
include(CPack)
