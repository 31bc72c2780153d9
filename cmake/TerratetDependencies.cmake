# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Everything from the system, nothing downloaded. Also included by the installed package: static libraries hand their
# private dependencies on to whoever links them.
find_package(CGAL 5.5 REQUIRED)
find_package(Eigen3 3.4 REQUIRED CONFIG)
find_package(TBB REQUIRED)
find_package(GDAL 3.6 REQUIRED)
find_package(PROJ REQUIRED)
find_package(SQLite3 3.37 REQUIRED)
find_package(ZLIB REQUIRED)
if(TERRATET_MPI)
  find_package(MPI 3 REQUIRED COMPONENTS CXX)
endif()
find_package(meshoptimizer REQUIRED)
find_package(OpenSSL 3 REQUIRED COMPONENTS Crypto)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(spdlog REQUIRED)
find_package(fmt REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(cairo REQUIRED IMPORTED_TARGET cairo)
pkg_check_modules(NETCDF REQUIRED IMPORTED_TARGET GLOBAL netcdf hdf5)
pkg_check_modules(LIBDEFLATE REQUIRED IMPORTED_TARGET GLOBAL libdeflate)

# OpenVDB ships a find module, beside its library.
find_path(TERRATET_OPENVDB_MODULE FindOpenVDB.cmake
          PATHS /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/OpenVDB /usr/lib/cmake/OpenVDB NO_CACHE)
list(APPEND CMAKE_MODULE_PATH ${TERRATET_OPENVDB_MODULE})
find_package(OpenVDB 10 REQUIRED COMPONENTS openvdb)
