# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# cmake -DBUILD_DIR=… -DSOURCE_DIR=… -DWORK_DIR=… -P run.cmake: installs the build, then builds and runs the user's
# project against the installation.
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGV}\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE "${WORK_DIR}")
file(MAKE_DIRECTORY "${WORK_DIR}")
run(${CMAKE_COMMAND} --install "${BUILD_DIR}" --prefix "${WORK_DIR}/prefix with blank")
run(${CMAKE_COMMAND} -S "${SOURCE_DIR}" -B "${WORK_DIR}/build" -G Ninja -DCMAKE_BUILD_TYPE=Release
    "-DCMAKE_PREFIX_PATH=${WORK_DIR}/prefix with blank")
run(${CMAKE_COMMAND} --build "${WORK_DIR}/build")

set(rows "x,y,z,grade\n")
foreach(i RANGE 0 124)
  math(EXPR x "525000 + 10 * (${i} % 5)")
  math(EXPR y "6792000 + 10 * (${i} / 5 % 5)")
  math(EXPR z "-10 * (${i} / 25)")
  string(APPEND rows "${x},${y},${z},${i}\n")
endforeach()
file(WRITE "${WORK_DIR}/samples.csv" "${rows}")
run("${WORK_DIR}/build/first_model" "${WORK_DIR}/samples.csv" "${WORK_DIR}/first.vtu")
file(READ "${WORK_DIR}/first.vtu" head LIMIT 200)
if(NOT head MATCHES "UnstructuredGrid")
  message(FATAL_ERROR "first.vtu is no VTU: ${head}")
endif()
run("${WORK_DIR}/prefix with blank/bin/terratet" --version)
